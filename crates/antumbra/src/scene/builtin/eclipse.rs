//! Sun, moon and earth at true scale, in km, the origin at the earth's centre, where the receivers are.

use antumbra_math::{DVec3, Rgb};
use antumbra_trace::Shape;

use super::solids::{single, turned};
use super::{Builtin, Parameter, Values};
use crate::light::Sphere;
use crate::scene::{Camera, Material, Projection, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "eclipse",
    shows: "Sun, moon and earth at true scale: total or annular, as the moon's distance will have it",
    parameters: &[Parameter {
        name: "distance",
        default: 363_300.0,
        low: 356_500.0,
        high: 406_700.0,
        whole: false,
        help: "from the earth's centre to the moon's [km]: total when near, annular when far",
    }],
    build,
};

/// Mean radius of the earth [km] (IUGG).
pub(super) const EARTH: f64 = 6_371.0;
/// Mean radius of the moon [km].
pub(super) const MOON: f64 = 1_737.4;
/// Radius of the sun [km] (IAU 2015, nominal: 695,700).
pub(super) const SUN: f64 = 695_700.0;
/// One astronomical unit [km] (IAU 2012).
pub(super) const UNIT: f64 = 149_597_870.7;

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let ocean = scene.material(Material::diffuse(Rgb::new(0.22, 0.36, 0.55)).named("earth"));
    let dust = scene.material(Material::diffuse(Rgb::grey(0.12)).named("moon"));

    let to_sun = DVec3::X;
    let moon = to_sun * values.get("distance");
    scene.shape("earth", Shape::Sphere { center: [0.0; 3], radius: EARTH as f32 }, ocean);
    scene.shape("moon", Shape::Sphere { center: single(moon), radius: MOON as f32 }, dust);

    // E = π L (r/d)² = 4 where the sun stands overhead.
    let share = SUN / UNIT;
    let radiance = 4.0 / (std::f64::consts::PI * share * share);
    let center = (to_sun * UNIT).as_vec3();
    scene.light("sun", Sphere::new(center, SUN as f32, Rgb::new(1.0, 0.96, 0.90) * radiance as f32));

    // From 30° beside the sun and 12° above its plane.
    let ((c, s), (up_c, up_s)) = (turned(30.0 / 360.0), turned(12.0 / 360.0));
    let eye = DVec3::new(c * up_c, up_s, s * up_c) * 42_000.0;
    scene.cameras.push(Camera::perspective(eye, DVec3::ZERO, 19.5).sized(600, 600));
    scene.cameras.extend([shadow(to_sun), ground(to_sun)]);
    scene
}

/// 800 km of the earth around the point under the sun, seen from there: the umbra is some 100 km wide.
fn shadow(to_sun: DVec3) -> Camera {
    let below = to_sun * EARTH;
    let projection = Projection::Orthographic { height: 800.0 };
    let from_above = Camera::perspective(below + to_sun * 1000.0, below, 1.0);
    Camera { name: "shadow".into(), projection, ..from_above }.sized(480, 480)
}

/// From that point up to the sun, 0.53° wide, and the moon before it; a metre and a half above the ground.
fn ground(to_sun: DVec3) -> Camera {
    let up = Camera::perspective(to_sun * (EARTH + 0.0015), to_sun * UNIT, 0.8);
    Camera { name: "ground".into(), ..up }.sized(480, 480)
}
