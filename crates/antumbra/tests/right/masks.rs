//! Alpha: holes of a mask and thin veils let through what they should, in every kind of ray.

use std::sync::Arc;

use antumbra::estimator::EstimatorKind;
use antumbra::light::Rectangle;
use antumbra::math::{DVec3, Rgb, Transform, Vec3};
use antumbra::query;
use antumbra::sampler::SamplerKind;
use antumbra::scene::{Alpha, Camera, Material, Mesh, Scene, SceneBuilder};
use antumbra::schedule::Flow;
use antumbra::sensor::{Filter, Viewing};
use antumbra::settings::{Masks, Settings};
use antumbra::texture::{Image, Texels, Texture};

use super::closed::{irradiance, settings, trial};
use super::judge::{Judge, size};
use super::pictures::{look, small, whole};
use super::scenes::{parallelogram, receiver};

/// How alpha is read, the alphas of 2 × 2 texels, and what multiplies them.
type Veil = (Alpha, [u8; 4], f32);

/// A square light in y = 2 whose light all goes through squares in y = 1 (and 0.5 …) with these alphas.
fn veiled(veils: &[Veil]) -> Scene {
    let mut builder = SceneBuilder::new("veil");
    let light = Rectangle::new(Vec3::new(-0.5, 2.0, -0.5), Vec3::X, Vec3::Z, Rgb::WHITE);
    builder.light("light", light);
    for (i, (alpha, texels, opacity)) in veils.iter().enumerate() {
        // The pattern repeats 8 times over the light's shadow.
        let image = Image::new(2, 2, Texels::Linear8(texels.map(|a| [0, 0, 0, a]).to_vec())).unwrap();
        let texture = builder.texture(Texture { nearest: true, ..Texture::new(Arc::new(image)) });
        let white = Material::diffuse(Rgb::WHITE);
        let veil = Material { color: Some(texture), alpha: *alpha, opacity: *opacity, ..white };
        let veil = builder.material(veil);
        let half = 0.25 / (1 + i) as f32;
        let height = 1.0 / (1 + i) as f32;
        let corner = Vec3::new(-half, height, -half);
        let triangles = parallelogram(corner, Vec3::X * (2.0 * half), Vec3::Z * (2.0 * half));
        let uvs = [Some(vec![[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]]), None];
        let mesh = builder.mesh(Mesh { triangles, uvs, ..Mesh::default() });
        builder.place("veil", mesh, veil, Transform::IDENTITY);
    }
    let eye = DVec3::new(0.0, 0.0, 0.0);
    // Four periods of the pattern in each direction: two texels a pixel of 4 × 4.
    let fov = 2.0 * antumbra::math::real::atan2(0.125, 1.0).to_degrees();
    let up = Camera { up: DVec3::Z, ..Camera::perspective(eye, DVec3::Y, fov) };
    builder.cameras.push(up);
    builder.build().unwrap()
}

const MASK: Alpha = Alpha::Mask { cutoff: 0.5 };
const SOLID: [u8; 4] = [255; 4];

/// Veils and the share of light that they let through.
fn veils() -> Vec<(&'static str, Vec<Veil>, f64)> {
    vec![
        ("checker mask", vec![(MASK, [0, 255, 255, 0], 1.0)], 0.5),
        ("a hole in four", vec![(MASK, [255, 255, 0, 255], 1.0)], 0.25),
        ("mask at its cutoff", vec![(Alpha::Mask { cutoff: 0.3 }, SOLID, 0.3)], 0.0),
        ("mask below its cutoff", vec![(Alpha::Mask { cutoff: 0.3 }, SOLID, 0.29)], 1.0),
        ("opaque whatever its alpha", vec![(Alpha::Opaque, [0; 4], 0.0)], 0.0),
        ("veil", vec![(Alpha::Blend, SOLID, 0.3)], 0.7),
        ("two veils", vec![(Alpha::Blend, SOLID, 0.3), (Alpha::Blend, SOLID, 0.4)], 0.7 * 0.6),
        ("textured veil", vec![(Alpha::Blend, [0, 255, 51, 102], 1.0)], 0.25 * (1.0 + 0.0 + 0.8 + 0.6)),
        ("veil behind a mask", vec![(MASK, [0, 255, 255, 0], 1.0), (Alpha::Blend, SOLID, 0.4)], 0.5 * 0.6),
    ]
}

/// Shadow rays, rays that look for light and rays of the camera. α = 10⁻³ over all of them.
#[test]
fn veils_let_their_share_through() {
    let mut judge = Judge::default();
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    // A strip of the pattern is a strip of the light: random numbers, so that its strata do not matter.
    let random = |kind| Settings { sampler: SamplerKind::Random, ..settings(kind, size(1 << 14, 1 << 18)) };
    for (name, layers, share) in veils() {
        let scene = veiled(&layers);
        let found =
            query::visible_fraction(&scene, &[up], 0, &random(EstimatorKind::Area), &mut |_| Flow::Continue);
        judge.add(trial(format!("{name}, visible fraction"), &found, share, 1e-6));
        let opaque = Settings { masks: Masks::Opaque, ..random(EstimatorKind::Area) };
        let none = query::visible_fraction(&scene, &[up], 0, &opaque, &mut |_| Flow::Continue);
        assert_eq!(none.values[0][0], 0.0, "{name}");
        assert_eq!(irradiance(&scene, up, &opaque).values[0][0], 0.0, "{name}");
        let (viewing, filter) = (Viewing::Filter, Filter::Box);
        let view = Settings { viewing, filter, sampler: SamplerKind::Random, ..small(EstimatorKind::Path) };
        let rays = size(1024, 1 << 15);
        let view = Settings { size: Some([4, 4]), viewing_rays: rays, bounces: 0, ..view };
        let picture = look(&scene, &view);
        // All of the picture is the light behind the veil.
        let [estimate, error] = whole(&picture, 0);
        let (truth, slack) = (share, 1e-6);
        judge.add(super::judge::Trial {
            name: format!("{name}, seen"),
            estimate,
            error,
            dof: f64::INFINITY,
            truth,
            slack,
        });
    }
    judge.verdict("veils_let_their_share_through", 1e-3);
}

/// Light through an even veil, by every direct estimator. α = 10⁻³.
#[test]
fn irradiance_through_a_veil() {
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    let corners = [[-0.5, 2.0, -0.5], [0.5, 2.0, -0.5], [0.5, 2.0, 0.5], [-0.5, 2.0, 0.5]].map(DVec3::from);
    let open = antumbra::math::closed::polygon(&corners, DVec3::Y).abs();
    let scene = veiled(&[(Alpha::Blend, SOLID, 0.3)]);
    let mut judge = Judge::default();
    for kind in [EstimatorKind::Area, EstimatorKind::Mis, EstimatorKind::Hemisphere, EstimatorKind::Surfaces]
    {
        let s = Settings { sampler: SamplerKind::Random, ..settings(kind, size(1 << 15, 1 << 18)) };
        judge.add(trial(format!("{kind:?}"), &irradiance(&scene, up, &s), 0.7 * open, 1e-6));
    }
    judge.verdict("irradiance_through_a_veil", 1e-3);
}

/// The shadow rays of one receiver decide each for themselves whether they pass.
#[test]
fn every_shadow_ray_throws_its_own_dice() {
    let mut builder = SceneBuilder::new("dice");
    let white = builder.material(Material::diffuse(Rgb::WHITE));
    let veil = Material { alpha: Alpha::Blend, opacity: 0.5, ..Material::diffuse(Rgb::BLACK) };
    let veil = builder.material(veil);
    builder.object("floor", parallelogram(Vec3::new(-1.0, 0.0, 1.0), Vec3::X * 2.0, Vec3::Z * -2.0), white);
    builder.object("veil", parallelogram(Vec3::new(-4.0, 1.0, -4.0), Vec3::X * 8.0, Vec3::Z * 8.0), veil);
    builder.light("light", Rectangle::new(Vec3::new(-0.5, 2.0, -0.5), Vec3::X, Vec3::Z, Rgb::WHITE));
    builder.cameras.push(Camera::perspective(DVec3::new(0.0, 0.7, 1.0), DVec3::ZERO, 30.0));
    let scene = builder.build().unwrap();
    let error = |shadow_rays| {
        let s = Settings { shadow_rays, sampler: SamplerKind::Random, ..small(EstimatorKind::Area) };
        whole(&look(&scene, &s), 0)[1]
    };
    let (one, sixteen) = (error(1), error(16));
    // Independent dice: a quarter; the error of the error of 300 pixels is a percent.
    assert!((sixteen / one - 0.25).abs() < 0.02, "{one} with one shadow ray, {sixteen} with sixteen");
}

/// A light with holes shines only where it is: all direct estimators agree, and the holes show what is behind.
/// α = 10⁻³.
#[test]
fn holes_of_a_light_do_not_shine() {
    let corners = [[-0.5, 2.0, -0.5], [0.5, 2.0, -0.5], [0.5, 2.0, 0.5], [-0.5, 2.0, 0.5]].map(DVec3::from);
    let open = antumbra::math::closed::polygon(&corners, DVec3::Y).abs();
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    let mut judge = Judge::default();
    for (name, alpha, texels, share) in
        [("checker", MASK, [0, 255, 255, 0], 0.5), ("veil", Alpha::Blend, [51; 4], 0.2)]
    {
        let mut builder = SceneBuilder::new(name);
        let image = Image::new(2, 2, Texels::Linear8(texels.map(|a| [0, 0, 0, a]).to_vec())).unwrap();
        let texture = builder.texture(Texture { nearest: true, ..Texture::new(Arc::new(image)) });
        let lamp = Material { color: Some(texture), alpha, ..Material::light(Rgb::WHITE) };
        let lamp = builder.material(lamp);
        // So fine a pattern that E over its texels is the share of the whole to 10⁻⁴ (64 periods, squared).
        let uvs = [Some(vec![[0.0, 0.0], [64.0, 0.0], [64.0, 64.0], [0.0, 64.0]]), None];
        let triangles = parallelogram(Vec3::new(-0.5, 2.0, -0.5), Vec3::X, Vec3::Z);
        let mesh = builder.mesh(Mesh { triangles, uvs, ..Mesh::default() });
        builder.place("lamp", mesh, lamp, Transform::IDENTITY);
        let scene = builder.build().unwrap();
        for kind in
            [EstimatorKind::Area, EstimatorKind::Mis, EstimatorKind::Hemisphere, EstimatorKind::Surfaces]
        {
            let s = Settings { sampler: SamplerKind::Random, ..settings(kind, size(1 << 14, 1 << 18)) };
            let found = irradiance(&scene, up, &s);
            judge.add(trial(format!("{name} {kind:?}"), &found, share * open, 1e-4 * open));
            let opaque = irradiance(&scene, up, &Settings { masks: Masks::Opaque, ..s });
            judge.add(trial(format!("{name} {kind:?}, opaque"), &opaque, open, 1e-5));
        }
    }
    judge.verdict("holes_of_a_light_do_not_shine", 1e-3);
}
