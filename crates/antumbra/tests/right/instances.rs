//! Instances: many copies of a mesh are the same scene as the mesh written out again and again.

use antumbra::estimator::EstimatorKind;
use antumbra::film::Planes;
use antumbra::light::{Environment, Rectangle};
use antumbra::math::{DVec3, Rgb, Transform, Vec3, real};
use antumbra::scene::{Camera, Emission, Material, Mesh, Scene, SceneBuilder};
use antumbra::settings::Settings;
use antumbra::trace::Triangles;

use super::judge::Judge;
use super::pictures::{compare, look, plane, small};
use super::rooms::ball;
use super::scenes::parallelogram;

/// Copies: together more triangles than are written out (2¹⁸).
const COPIES: u32 = 1500;

/// Where copy `i` stands: turned, stretched, every other one mirrored.
fn place(i: u32) -> Transform {
    let (x, z) = (f64::from(i % 40), f64::from(i / 40));
    let turn = 0.7 * f64::from(i);
    let q = [0.0, real::sin(0.5 * turn), 0.0, real::cos(0.5 * turn)];
    let mirror = if i % 2 == 1 { -1.0 } else { 1.0 };
    let size = DVec3::new(0.4 * mirror, 0.3 + 0.1 * f64::from(i % 3), 0.35);
    Transform::from_trs(DVec3::new(x - 20.0, 0.45, z - 30.0), q, size)
}

/// A field of smooth balls, as instances of one mesh or as meshes of their own.
fn field(instanced: bool) -> Scene {
    let mut builder = SceneBuilder::new("field");
    let plaster = builder.material(Material::diffuse(Rgb::new(0.7, 0.6, 0.5)));
    let glossy = builder.material(Material::metallic_roughness(Rgb::new(0.9, 0.7, 0.4), 0.5, 0.4));
    let floor = parallelogram(Vec3::new(-50.0, 0.0, 50.0), Vec3::X * 100.0, Vec3::Z * -100.0);
    builder.object("floor", floor, plaster);
    let mesh = || {
        let (triangles, normals) = ball(Vec3::ZERO, 1.0);
        Mesh { triangles, normals: Some(normals), ..Mesh::default() }
    };
    let shared = builder.mesh(mesh());
    for i in 0..COPIES {
        let mesh = if instanced { shared } else { builder.mesh(mesh()) };
        builder.place("ball", mesh, if i % 3 == 0 { glossy } else { plaster }, place(i));
    }
    builder.light("sky", Environment::constant(Rgb::new(0.4, 0.5, 0.7)));
    let lamp = Rectangle::new(Vec3::new(-3.0, 5.0, 4.0), Vec3::X * 4.0, Vec3::Z * 2.0, Rgb::grey(5.0));
    builder.light("lamp", lamp);
    builder.cameras.push(Camera::perspective(DVec3::new(0.0, 2.2, 12.0), DVec3::new(0.0, 0.3, 5.0), 40.0));
    builder.build().unwrap()
}

/// α = 10⁻³ over the blocks of pictures by path, by direct light and of openness; the first planes agree pixel by pixel.
#[test]
fn instances_look_like_copies() {
    let (instanced, written) = (field(true), field(false));
    let transforms = |s: &Scene| s.objects.iter().filter(|o| o.transform.is_some()).count() as u32;
    assert_eq!((transforms(&instanced), transforms(&written)), (COPIES, 0));
    assert_eq!(instanced.triangle_count(), written.triangle_count());
    let mut judge = Judge::default();
    for estimator in [EstimatorKind::Area, EstimatorKind::Path, EstimatorKind::AmbientOcclusion] {
        let of = |scene, seed| look(scene, &Settings { seed, bounces: 3, ..small(estimator) });
        compare(&mut judge, &format!("{estimator:?}"), &of(&instanced, 1), &of(&written, 2));
    }
    let aov = Planes::ALL;
    let of =
        |scene| look(scene, &Settings { aov, viewing_rays: 1, bounces: 1, ..small(EstimatorKind::Path) });
    let (a, b) = (of(&instanced), of(&written));
    for name in ["normal", "position", "depth", "albedo"] {
        let (a, b) = (plane(&a, name), plane(&b, name));
        // A copy's corners are rounded to f32 where it stands (20 units out: 2⁻²⁰); few pixels see an edge.
        let far = a.iter().zip(b).filter(|(x, y)| (*x - *y).abs() > 1e-3).count();
        assert!(far * 100 <= a.len(), "{name}: {far} of {} values differ", a.len());
    }
    judge.verdict("instances_look_like_copies", 1e-3);
}

/// A sheet of very many triangles that shines from its front, +y.
fn sheet(side: u32) -> Triangles {
    let at = |i: u32| -0.5 + i as f32 / side as f32;
    let vertices = (0..=side).flat_map(|z| (0..=side).map(move |x| [at(x), 0.0, at(z)])).collect();
    let row = side + 1;
    let cell = |x: u32, z: u32| {
        let a = z * row + x;
        [[a, a + row, a + row + 1], [a, a + row + 1, a + 1]]
    };
    let indices = (0..side).flat_map(|z| (0..side).flat_map(move |x| cell(x, z))).collect();
    Triangles { vertices, indices }
}

/// A front is a front, however its sheet is turned or mirrored, instance or not.
#[test]
fn mirrored_lights_shine_from_their_front() {
    // 2 · 260² · 2 sheets are more than 2¹⁸; of a small sheet, few.
    for (side, instanced) in [(4, false), (260, true)] {
        let mut builder = SceneBuilder::new("sheets");
        let emission = Some(Emission { radiance: Rgb::WHITE, both_sides: false });
        let glow = builder.material(Material { emission, ..Material::diffuse(Rgb::BLACK) });
        let mesh = builder.mesh(Mesh { triangles: sheet(side), ..Mesh::default() });
        let one = DVec3::ONE;
        // Upright and mirrored in x: both shine upwards. Mirrored in y: downwards.
        let scales =
            [DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, -1.0, 1.0), one, DVec3::new(-1.0, -1.0, -1.0)];
        for (i, scale) in scales.into_iter().enumerate() {
            let t = DVec3::new(3.0 * i as f64, 1.0, 0.0);
            builder.place("sheet", mesh, glow, Transform::from_trs(t, [0.0, 0.0, 0.0, 1.0], scale));
        }
        let scene = builder.build().unwrap();
        assert_eq!(scene.objects.iter().any(|o| o.transform.is_some()), instanced);
        for (i, upwards) in [true, false, true, false].into_iter().enumerate() {
            for from_above in [true, false] {
                let x = 3.0 * i as f64;
                let eye = DVec3::new(x + 0.01, if from_above { 3.0 } else { -1.0 }, 0.02);
                let (eye, to) = (Some(eye.to_array()), Some([x, 1.0, 0.0]));
                let up = Some([0.0, 0.0, 1.0]);
                let base = small(EstimatorKind::Hemisphere);
                let view = Settings { eye, look_at: to, up, fov: Some(15.0), viewing_rays: 1, ..base };
                let picture = look(&scene, &Settings { size: Some([4, 4]), bounces: 0, ..view });
                let truth = if upwards == from_above { 1.0 } else { 0.0 };
                assert!(
                    picture.pixels.iter().all(|p| p[0] == truth),
                    "sheet {i}, instanced {instanced}, from above {from_above}: {:?}",
                    picture.pixels[0]
                );
            }
        }
    }
}
