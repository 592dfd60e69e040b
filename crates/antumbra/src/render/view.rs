//! The camera, size and crop that the settings ask for.

use antumbra_math::{DVec3, Vec3};

use crate::scene::{Camera, Level, Message, Projection, Scene, SceneError};
use crate::sensor::View;
use crate::settings::Settings;

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
