//! Mountains: a height field of 31,250 triangles under a sky and a sun.

use antumbra_math::{DVec3, Rgb, real};

use super::noise::{fractal, ridges};
use super::solids::{sheet, smooth_mesh};
use super::{Builtin, Values, sky::sky};
use crate::light::{Environment, Sun};
use crate::scene::{Camera, Material, Mesh, SceneBuilder};
use std::sync::Arc;

pub(super) const SCENE: Builtin = Builtin {
    name: "terrain",
    shows: "Mountains in the low sun and a blue sky: a height field of 31,250 triangles",
    parameters: &[],
    build,
};

/// Edge of the land [m].
const EDGE: f64 = 120.0;

fn build(_: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let land = scene.material(Material::diffuse(Rgb::WHITE).named("land"));
    let mesh = scene.mesh(painted());
    scene.place("land", mesh, land, antumbra_math::Transform::IDENTITY);

    let to_sun = DVec3::new(-0.72, 0.34, 0.08).normalize();
    let half_angle = 0.2666_f64.to_radians();
    // E = π L sin² of the half angle = 3.4.
    let radiance = 3.4 / (std::f64::consts::PI * half_angle * half_angle);
    let sunlight = Rgb::new(1.0, 0.86, 0.66) * radiance as f32;
    scene.light("sun", Sun::new(to_sun.as_vec3(), half_angle as f32, sunlight));
    scene.light("sky", Environment::image(Arc::new(sky(to_sun, 0.06, 1.0))));

    let eye = DVec3::new(4.0, 15.0, 66.0);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(-2.0, 6.5, 0.0), 36.0).sized(800, 450));
    scene
}

/// The land with its colours: meadow below, rock where it is steep, snow on the heights.
fn painted() -> Mesh {
    let mut mesh = smooth_mesh("land", sheet(125, 125, |u, v| at((u - 0.5) * EDGE, (0.5 - v) * EDGE)));
    let normals = mesh.normals.take().unwrap_or_default();
    let color = |(p, n): (&[f32; 3], &[f32; 3])| {
        let (meadow, rock, snow) =
            (Rgb::new(0.20, 0.24, 0.10), Rgb::new(0.34, 0.28, 0.23), Rgb::new(0.82, 0.84, 0.86));
        let steep = ((0.90 - n[1]) / 0.12).clamp(0.0, 1.0);
        let high = ((p[1] - 9.5) / 3.0 - 1.2 * steep).clamp(0.0, 1.0);
        let Rgb([r, g, b]) =
            meadow.lerp(rock, steep.max(((p[1] - 5.0) / 4.0).clamp(0.0, 1.0))).lerp(snow, high);
        [r, g, b, 1.0]
    };
    mesh.colors = Some(mesh.triangles.vertices.iter().zip(&normals).map(color).collect());
    mesh
}

/// The ground over (x, z): ridges that a slow noise bends, and a valley that opens toward the viewer.
fn at(x: f64, z: f64) -> DVec3 {
    let p = DVec3::new(x, 0.0, z) / 46.0;
    let bend = DVec3::new(fractal(p * 0.9, 2, 11), 0.0, fractal(p * 0.9 + DVec3::splat(7.3), 2, 12)) * 0.35;
    let valley = (x + 8.0 * real::sin(z / 17.0)).abs() / 46.0;
    let rise = (0.12 + 0.9 * valley + 0.75 * ((30.0 - z) / 90.0).max(0.0)).min(1.25);
    let height = 14.0 * ridges(p + bend, 4, 21) * rise + 2.0 * fractal(p * 1.7, 3, 31);
    DVec3::new(x, height - 4.0, z)
}
