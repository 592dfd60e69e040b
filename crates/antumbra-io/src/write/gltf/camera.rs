//! Cameras at nodes.

use antumbra::scene::{Camera, Projection};
use antumbra_math::{DMat3, Transform};
use serde_json::json;

use super::Writer;
use super::mesh::matrix;

/// What is nearer than this part of the way to the point looked at need not be drawn: viewers ask for such a number.
const NEAR: f64 = 1e-3;

impl Writer<'_, '_> {
    /// A camera that looks along −z of its node with +y up.
    pub(super) fn camera(&mut self, camera: &Camera) {
        let place = format!("camera \"{}\"", camera.name);
        for (lost, what) in [
            (
                camera.lens.is_some_and(|l| l.radius > 0.0),
                "has a lens, which glTF does not know: written as a pinhole",
            ),
            (camera.shift != [0.0; 2], "looks past the middle of its picture: glTF cannot say so"),
            (camera.mirrored, "shows left as right: glTF cannot say so"),
        ] {
            if lost {
                self.warn(&place, what);
            }
        }
        let view = camera.look_at - camera.eye;
        let forward = view.normalize_or_zero();
        let right = forward.cross(camera.up).normalize_or_zero();
        let linear = DMat3::from_cols(right, right.cross(forward), -forward);
        let at = matrix(&Transform { linear, translation: camera.eye });
        let aspect = camera.size.map(|[w, h]| f64::from(w) / f64::from(h)).or(camera.aspect);
        let near = view.length() * NEAR;
        let mut written = match camera.projection {
            Projection::Perspective { vertical_fov } => {
                let mut view = json!({"yfov": vertical_fov, "znear": near});
                if let Some(aspect) = aspect {
                    view["aspectRatio"] = json!(aspect);
                }
                json!({"type": "perspective", "perspective": view})
            }
            Projection::Orthographic { height } => {
                let (x, y) = (0.5 * height * aspect.unwrap_or(4.0 / 3.0), 0.5 * height);
                let far = view.length() / NEAR;
                let view = json!({"xmag": x, "ymag": y, "znear": near, "zfar": far});
                json!({"type": "orthographic", "orthographic": view})
            }
        };
        if !camera.name.is_empty() {
            written["name"] = json!(camera.name);
        }
        self.cameras.push(written);
        let index = self.cameras.len() - 1;
        self.node(&camera.name, json!({"camera": index, "matrix": at}));
    }
}
