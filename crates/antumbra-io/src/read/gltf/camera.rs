//! Cameras of nodes.

use antumbra::scene::{Camera, Projection};
use antumbra_math::real;

use super::Reader;
use super::document::GltfCamera;
use super::material::named;
use super::node::Placed;
use crate::error::ReadError;

impl Reader<'_> {
    /// Adds the camera of a node; one that cannot see is left out with a warning.
    pub(super) fn place_camera(&mut self, at: &Placed, index: usize) -> Result<(), ReadError> {
        let node = &self.doc.nodes[at.node];
        let Some(camera) = self.doc.cameras.get(index) else {
            let what = format!("camera {index} is named; there are {}", self.doc.cameras.len());
            return Err(ReadError::new(format!("node {}", at.node), what));
        };
        let name = if node.name.is_empty() { &camera.name } else { &node.name };
        match projection(camera) {
            Ok((projection, aspect)) => {
                let seen = Camera::of_node(&at.world, projection);
                self.scene.cameras.push(Camera { name: name.clone(), aspect, ..seen });
            }
            Err(what) => {
                self.said.warn(format!("camera {}", named(index, name)), format!("{what}: left out"))
            }
        }
        Ok(())
    }
}

/// The projection and the aspect ratio, or why there is none.
fn projection(camera: &GltfCamera) -> Result<(Projection, Option<f64>), String> {
    if let Some(p) = &camera.perspective {
        let fov = p.yfov;
        if !(fov > 0.0 && fov < f64::from(real::PI)) {
            return Err(format!("yfov {fov} does not lie between 0 and π"));
        }
        return Ok((Projection::Perspective { vertical_fov: fov }, p.aspect_ratio.filter(|a| *a > 0.0)));
    }
    let Some(o) = &camera.orthographic else {
        return Err("it is neither perspective nor orthographic".into());
    };
    let (x, y) = (o.xmag.abs(), o.ymag.abs());
    if y == 0.0 {
        return Err("ymag is 0".into());
    }
    Ok((Projection::Orthographic { height: 2.0 * y }, (x > 0.0).then(|| x / y)))
}
