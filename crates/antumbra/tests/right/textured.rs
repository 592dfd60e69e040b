//! Textures on the numbers of a look: a texture that is the same everywhere is that number.

use std::sync::Arc;

use antumbra::bsdf::{Bsdf, Facets, Metal};
use antumbra::light::Environment;
use antumbra::math::{DMat3, DVec3, Local, Rgb, Transform, Vec3, real};
use antumbra::scene::{
    Alpha, BumpMap, Channel, Look, Material, Mesh, Met, Ray, Roughness, Scene, SceneBuilder, TextureId,
};
use antumbra::texture::{Image, Texels, Texture};
use antumbra::trace::{Hits, NO_PRIM, SegmentBuffer, Visibility};

use super::scenes::parallelogram;

/// The unit square in the plane z = 0 that faces +z, u = x and v = y, of what `look` makes of it, moved by `linear`.
pub(super) fn square(linear: DMat3, look: impl FnOnce(&mut SceneBuilder) -> Material) -> Scene {
    let mut builder = SceneBuilder::new("square");
    let made = look(&mut builder);
    let material = builder.material(made);
    let triangles = parallelogram(Vec3::ZERO, Vec3::X, Vec3::Y);
    let uvs = [Some(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), None];
    let mesh = builder.mesh(Mesh { triangles, uvs, ..Mesh::default() });
    builder.place("square", mesh, material, Transform { linear, translation: DVec3::ZERO });
    builder.light("sky", Environment::constant(Rgb::WHITE));
    builder.build().unwrap()
}

/// The ray from `o` along `d`, with what it meets.
pub(super) fn shot(scene: &Scene, o: Vec3, d: Vec3) -> Ray {
    let (mut rays, mut hits, number) = (SegmentBuffer::default(), Hits::default(), 7);
    rays.push_ray(o.to_array(), d.to_array(), f32::INFINITY, NO_PRIM, number);
    scene.visibility(false).nearest(rays.as_segments(), &mut hits);
    Ray { o, d, t: hits.t[0], prim: hits.prim[0], uv: hits.uv[0], number }
}

/// The ray straight down above (x, y).
fn down(scene: &Scene, x: f64, y: f64) -> Ray {
    shot(scene, Vec3::new(x as f32, y as f32, 1.0), Vec3::NEG_Z)
}

fn met(scene: &Scene, x: f64, y: f64) -> Met {
    scene.meet(&down(scene, x, y), &Look::default())
}

fn even(builder: &mut SceneBuilder, texel: [f32; 3]) -> TextureId {
    let image = Image::new(1, 1, Texels::Float(vec![texel])).unwrap();
    builder.texture(Texture { nearest: true, ..Texture::new(Arc::new(image)) })
}

/// Every kind with facets, of facets `f`.
fn faceted(f: Facets) -> Vec<Material> {
    let eta = [1.5, 1.0 / 1.5];
    let plastic = eta.map(|eta| Material::plastic(Rgb::new(0.9, 0.5, 0.1), eta, Some(f), true));
    let glass = eta.map(|eta| Material::dielectric(eta, Some(f)));
    let metal = Material::conductor(Metal::named("Cu").unwrap(), Some(f));
    [plastic, glass].into_iter().flatten().chain([metal, Material::thin_dielectric(1.5, Some(f))]).collect()
}

#[test]
fn an_even_roughness_is_that_roughness() {
    let direction = |cos: f32, phi: f32| {
        let sin = real::safe_sqrt((1.0 - cos) * (1.0 + cos));
        Local(Vec3::new(sin * real::cosf(phi), sin * real::sinf(phi), cos))
    };
    let slopes: [fn(f32) -> Facets; 3] =
        [Facets::isotropic, |a| Facets::beckmann(a, a), |a| Facets::new(a, 0.5 * a)];
    for facets in slopes {
        for (squared, texel) in [(false, 0.0f32), (false, 0.07), (true, 0.83)] {
            let alpha = if squared { texel * texel } else { texel };
            for (wide, plain) in faceted(facets(1.0)).into_iter().zip(faceted(facets(alpha))) {
                let by_texture = square(DMat3::IDENTITY, |builder| {
                    let channel = Channel { texture: even(builder, [0.9, texel, 0.9]), component: 1 };
                    Material { roughness: Some(Roughness::new(channel, squared)), ..wide }
                });
                let [a, b] = [by_texture, square(DMat3::IDENTITY, |_| plain)]
                    .map(|scene| met(&scene, 0.3, 0.6).receiver.bsdf);
                for cos in [0.02f32, 0.3, 0.8, 1.0] {
                    for (c, phi) in [(0.1, 0.3), (0.6, 2.0), (0.95, 3.0), (-0.4, 1.0)] {
                        let (wo, wi) = (direction(cos, 0.2), direction(c, phi));
                        let (f, g) = (a.eval(wo, wi), b.eval(wo, wi));
                        // The base of a plastic is seen through a share that is interpolated between widths, to 0.005
                        // of f/π on each way through; facets are what they are, α to a few roundings.
                        let base = if matches!(a, Bsdf::RoughPlastic(_)) { 1e-2 / real::PI } else { 0.0 };
                        let off = (f + g * -1.0).0.map(f32::abs);
                        let most = g.0.map(|g| 1e-4 * g + base);
                        assert!(
                            (0..3).all(|c| off[c] <= most[c]),
                            "{alpha} {a:?} {wo:?} {wi:?}: {f:?} {g:?}"
                        );
                    }
                }
                assert!((a.albedo().mean() - b.albedo().mean()).abs() < 0.02, "{a:?}");
            }
        }
    }
}

#[test]
fn an_even_gloss_is_that_gloss() {
    let half = Rgb::new(0.2, 0.5, 0.8);
    let rough = Some(Facets::isotropic(0.3));
    for facets in [None, rough] {
        let kinds = || [Material::plastic(Rgb::WHITE, 1.5, facets, true), Material::dielectric(1.5, facets)];
        let kinds = || kinds().into_iter().chain([Material::thin_dielectric(1.5, facets)]);
        for (mut plain, wide) in kinds().zip(kinds()) {
            assert!(plain.surface.set_gloss(half));
            let by_texture = square(DMat3::IDENTITY, |builder| {
                let gloss = Some(even(builder, half.0));
                Material { gloss, ..wide }
            });
            let plain = square(DMat3::IDENTITY, |_| plain);
            let [a, b] = [by_texture, plain].map(|scene| met(&scene, 0.3, 0.6).receiver.bsdf);
            assert_eq!(a, b);
        }
    }
    assert!(!Material::mirror(Rgb::WHITE).surface.set_gloss(half));
}

#[test]
fn metallic_and_roughness_may_come_from_two_textures() {
    let of = |one: bool| {
        square(DMat3::IDENTITY, |builder| {
            let both = even(builder, [0.1, 0.4, 0.7]);
            let (metal, rough) = match one {
                true => ((both, 2), (both, 1)),
                false => ((even(builder, [0.7; 3]), 0), (even(builder, [0.4; 3]), 0)),
            };
            let channel = |(texture, component)| Channel { texture, component };
            Material {
                metallic: Some(channel(metal)),
                roughness: Some(Roughness::new(channel(rough), true)),
                ..Material::metallic_roughness(Rgb::new(0.9, 0.6, 0.3), 0.5, 0.5)
            }
        })
    };
    let plain = square(DMat3::IDENTITY, |_| {
        Material::metallic_roughness(Rgb::new(0.9, 0.6, 0.3), 0.5 * 0.7, 0.5 * 0.4)
    });
    let plain = met(&plain, 0.5, 0.2).receiver.bsdf;
    assert_eq!([true, false].map(|one| met(&of(one), 0.5, 0.2).receiver.bsdf), [plain; 2]);
}

/// The red of a cover is alpha, whatever the colour texture is: its own coordinates, its own grid.
#[test]
fn a_cover_is_alpha() {
    let scene = square(DMat3::IDENTITY, |builder| {
        let color = even(builder, [0.2, 0.4, 0.6]);
        let image = Image::new(2, 1, Texels::Float(vec![[0.0; 3], [0.8, 0.0, 0.0]])).unwrap();
        let cover = builder.texture(Texture { nearest: true, ..Texture::new(Arc::new(image)) });
        let look = Material { color: Some(color), cover: Some(cover), ..Material::diffuse(Rgb::WHITE) };
        Material { alpha: Alpha::Mask { cutoff: 0.5 }, ..look }
    });
    for (x, there) in [(0.2, false), (0.45, false), (0.55, true), (0.9, true)] {
        assert_eq!(down(&scene, x, 0.4).prim != NO_PRIM, there, "{x}");
    }
    assert_eq!(met(&scene, 0.9, 0.4).receiver.bsdf.albedo(), Rgb([0.2, 0.4, 0.6]));
}

/// The heights h = a sin 2πu cos 2πv over the square bend its normal to (−∂h/∂x, −∂h/∂y, 1), however the square is turned,
/// mirrored or stretched: h is in scene units.
#[test]
fn heights_bend_the_normal_as_the_raised_surface_does() {
    let (n, a, scale) = (512u32, 0.05, 0.6);
    let tau = std::f64::consts::TAU;
    let height = |u: f64, v: f64| (0.5 + a * real::sin(tau * u) * real::cos(tau * v)) as f32;
    let place = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
    let texels = (0..n * n).map(|i| [height(place(i % n), place(i / n)), 0.0, 0.0]).collect();
    let image = Arc::new(Image::new(n, n, Texels::Float(texels)).unwrap());
    for stretch in
        [DVec3::ONE, DVec3::new(2.0, 0.5, 1.0), DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, -3.0, 2.0)]
    {
        // u grows along x, v along y; a part of the picture where it is laid out wider.
        let map = [0.5, 0.0, 0.2, 0.0, 1.0, 0.1];
        let scene = square(DMat3::from_diagonal(stretch), |builder| {
            let texture = builder.texture(Texture { map, ..Texture::new(Arc::clone(&image)) });
            Material { bump: Some(BumpMap { texture, scale }), ..Material::diffuse(Rgb::grey(0.5)) }
        });
        for k in 0..50u32 {
            let [u, v] = [0.7548776662, 0.5698402910].map(|g: f64| (0.5 + g * f64::from(k + 1)).fract());
            let found = met(&scene, u * stretch.x, v * stretch.y).receiver.frame.n;
            let (s, t) = (tau * (0.5 * u + 0.2), tau * (v + 0.1));
            let slope_x = f64::from(scale) * a * tau * 0.5 * real::cos(s) * real::cos(t) / stretch.x;
            let slope_y = -f64::from(scale) * a * tau * real::sin(s) * real::sin(t) / stretch.y;
            let expected = DVec3::new(-slope_x, -slope_y, 1.0).normalize();
            // Slopes between texels are those half a texel away: a (2π)² 0.6 / 1024 = 0.0012, over a side of 0.5.
            assert!((found.as_dvec3() - expected).length() < 3e-3, "{stretch} {u} {v}: {found} {expected}");
        }
    }
}
