//! Four glossy plates under four balls of light, after Veach and Guibas 1995, figure 2 ("Optimally Combining Sampling
//! Techniques for Monte Carlo Rendering"): small lights on rough plates need points of the light, large lights on smooth
//! plates need directions. Lengths in metres.

use antumbra_math::{DVec3, Rgb, Vec3};

use super::solids::{cuboid, moved, quad, turn};
use super::{Builtin, Parameter, Values};
use crate::bsdf::{Facets, Metal};
use crate::light::Sphere;
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "veach-mis",
    shows: "Four metal plates, each rougher than the one behind, mirror four balls of light of one power and growing \
            size: where points of the light fail, directions find it, and the other way round",
    parameters: &[Parameter {
        name: "roughness",
        default: 1.0,
        low: 0.0,
        high: 5.0,
        whole: false,
        help: "factor of the plates' α: 0.005, 0.02, 0.05 and 0.15 from back to front",
    }],
    build,
};

const EYE: DVec3 = DVec3::new(0.0, 3.2, 12.0);
/// The row of lights hangs across here.
const ROW: DVec3 = DVec3::new(0.0, 2.4, -1.0);
/// α of the plates, from back to front.
const ALPHA: [f64; 4] = [0.005, 0.02, 0.05, 0.15];
/// Radii of the lights; L = POWER / r² makes their power equal.
const RADII: [f64; 4] = [0.03, 0.09, 0.27, 0.6];
const POWER: f64 = 0.6;

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let grey = scene.material(Material::diffuse(Rgb::grey(0.25)).named("room"));
    scene.object("floor", quad(DVec3::new(-9.0, -0.6, 9.0), DVec3::X * 18.0, DVec3::Z * -12.0), grey);
    scene.object("wall", quad(DVec3::new(-9.0, -0.6, -3.0), DVec3::X * 18.0, DVec3::Y * 9.0), grey);
    let chromium = Metal::named("Cr").unwrap_or(Metal { eta: Rgb::grey(3.0), k: Rgb::grey(4.0) });
    for (i, alpha) in ALPHA.into_iter().enumerate() {
        let facets = Facets::isotropic((alpha * values.get("roughness")) as f32);
        let metal =
            scene.material(Material::conductor(chromium, Some(facets)).named(format!("plate {}", i + 1)));
        let at = DVec3::new(0.0, 0.75 - 0.33 * i as f64, -0.6 + 1.15 * i as f64);
        // Turned so that the middle of the plate mirrors the row of lights to the eye.
        let up = ((EYE - at).normalize() + (ROW - at).normalize()).normalize();
        let angle = antumbra_math::real::atan2(up.z, up.y);
        let plate = cuboid(DVec3::new(-3.4, -0.05, -0.42), DVec3::new(3.4, 0.0, 0.42));
        scene.object("plate", moved(plate, &turn(DVec3::X, angle, at)), metal);
    }
    for (i, radius) in RADII.into_iter().enumerate() {
        let center = ROW + DVec3::X * (1.6 * (i as f64 - 1.5));
        let radiance = Rgb::grey((POWER / (radius * radius)) as f32);
        scene.light(
            "lamp",
            Sphere::new(
                Vec3::new(center.x as f32, center.y as f32, center.z as f32),
                radius as f32,
                radiance,
            ),
        );
    }
    scene.cameras.push(Camera::perspective(EYE, DVec3::new(0.0, 0.9, 0.6), 26.0).sized(640, 480));
    scene
}
