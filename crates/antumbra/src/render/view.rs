//! The camera, size and crop that the settings ask for.

use antumbra_math::{DVec3, Vec3};
use antumbra_trace::{Hits, NO_PRIM, SegmentBuffer, Visibility};

use crate::scene::{Camera, Lens, Level, Message, Projection, Scene, SceneError};
use crate::sensor::View;
use crate::settings::{Masks, Settings};

/// Size of a picture whose scene names none.
const DEFAULT_SIZE: [u32; 2] = [640, 480];

/// The camera that the settings ask for: the scene's, one of its others, or one made from what is known.
pub(super) fn camera(scene: &Scene, s: &Settings, messages: &mut Vec<Message>) -> Result<Camera, SceneError> {
    let mut note = |text: String| messages.push(Message { level: Level::Note, place: String::new(), text });
    let mut camera = match (&s.camera, scene.cameras.first()) {
        (Some(name), _) => named(scene, name)?,
        (None, Some(camera)) => camera.clone(),
        (None, None) => {
            if s.eye.is_none() {
                note("no camera: made one that sees everything (`eye`, `look_at` to choose)".into());
            }
            all_seeing(scene)?
        }
    };
    let vector = |v: [f64; 3]| DVec3::from(v);
    camera.eye = s.eye.map_or(camera.eye, vector);
    camera.look_at = s.look_at.map_or(camera.look_at, vector);
    camera.up = s.up.map_or(camera.up, vector);
    if let Some(fov) = s.fov {
        camera.projection = Projection::Perspective { vertical_fov: fov.to_radians() };
    }
    let moved = s.eye.is_some() || s.look_at.is_some();
    if s.aperture.is_some() || (moved && camera.lens.is_some()) {
        let file = camera.lens.filter(|_| !moved);
        let focus = s.focus.or(file.map(|lens| lens.focus)).unwrap_or_else(|| middle(scene, &camera, s));
        let radius = s.aperture.or(camera.lens.map(|lens| lens.radius)).unwrap_or_default();
        camera.lens = Some(Lens { radius, focus });
    }
    match (s.focus, &mut camera.lens) {
        (Some(focus), Some(lens)) => lens.focus = focus,
        (Some(_), None) => note("focus has no effect without a lens (`aperture` to choose)".into()),
        _ => {}
    }
    if let Some(up) = camera.other_up() {
        let (was, x, y, z) = (camera.up, up.x, up.y, up.z);
        note(format!(
            "the camera looks straight along its up direction {}, {}, {}: {x}, {y}, {z} is up in the picture (`up` to \
             choose)",
            was.x, was.y, was.z
        ));
        camera.up = up;
    }
    match camera.fault() {
        Some(what) => Err(SceneError::new("camera", what, "Choose other values of `eye`, `look_at`, `up`.")),
        None => Ok(camera),
    }
}

fn named(scene: &Scene, name: &str) -> Result<Camera, SceneError> {
    let found = scene.cameras.iter().find(|c| c.name == *name);
    let known = || scene.cameras.iter().map(|c| c.name.as_str()).collect::<Vec<_>>();
    found.cloned().ok_or_else(|| SceneError::unknown("camera", name, &known()))
}

/// How far away is what the middle of the picture shows: the point asked for, what the ray there meets, or the point that
/// the camera looks at.
fn middle(scene: &Scene, camera: &Camera, s: &Settings) -> f64 {
    let toward = camera.look_at - camera.eye;
    let (eye, along) = (camera.eye.as_vec3(), toward.normalize_or_zero().as_vec3());
    let (mut rays, mut hits) = (SegmentBuffer::default(), Hits::default());
    rays.push_ray(eye.to_array(), along.to_array(), f32::INFINITY, NO_PRIM, 0);
    scene.visibility(s.masks == Masks::Opaque).nearest(rays.as_segments(), &mut hits);
    let met = (s.look_at.is_none() && hits.prim[0] != NO_PRIM).then_some(hits.t[0]);
    met.unwrap_or_else(|| toward.length())
}

/// A camera from which everything is seen.
fn all_seeing(scene: &Scene) -> Result<Camera, SceneError> {
    let [low, high] = match scene.bounds() {
        Some(bounds) => bounds,
        // Nothing but light: any camera sees it.
        None if !scene.lights().is_empty() => [Vec3::NEG_ONE, Vec3::ONE],
        None => {
            let what = "nothing to render: there is no geometry and no light";
            return Err(SceneError::new("", what, ""));
        }
    };
    Ok(Camera::seeing(low.as_dvec3(), high.as_dvec3()))
}

/// The size and the crop of the picture.
pub(super) fn view(camera: &Camera, s: &Settings) -> Result<View, SceneError> {
    let of_aspect =
        |a: f64| [DEFAULT_SIZE[0], ((f64::from(DEFAULT_SIZE[0]) / a).round() as u32).clamp(1, 1 << 14)];
    let size = s.size.or(camera.size).or(camera.aspect.map(of_aspect)).unwrap_or(DEFAULT_SIZE);
    let crop = s.crop.unwrap_or([0, 0, size[0], size[1]]);
    let fits = |from: u32, length: u32, all: u32| u64::from(from) + u64::from(length) <= u64::from(all);
    if !fits(crop[0], crop[2], size[0]) || !fits(crop[1], crop[3], size[1]) {
        let what = format!(
            "crop = {},{},{},{} does not lie in {} x {} pixels",
            crop[0], crop[1], crop[2], crop[3], size[0], size[1]
        );
        return Err(SceneError::new("", what, ""));
    }
    Ok(View { size, crop, viewing: s.viewing, filter: s.filter })
}
