//! Looks, textures and lights of every kind, out and back.

use std::sync::Arc;

use antumbra::bsdf::{Facets, Metal, Principled};
use antumbra::light::{
    Directional, Disk, Environment, Light, Point, Rectangle, Sphere, Spot, SpotEdge, Sun, Triangle,
};
use antumbra::math::{DMat3, DVec3, Frame, Rgb, Transform, Vec3, real};
use antumbra::scene::{
    Alpha, BumpMap, Camera, Channel, Emission, Lens, Material, Mesh, NormalMap, Projection, Roughness,
    SceneBuilder, Surface, TextureId,
};
use antumbra::texture::{Image, Texels, Texture, Wrap};
use antumbra::trace::{Shape, Triangles};

use super::{Folder, back, picture};

fn image(texels: Texels) -> Arc<Image> {
    Arc::new(Image::new(4, 2, texels).unwrap())
}

fn codes(key: u8) -> Vec<[u8; 4]> {
    (0..8u8).map(|i| [i * 30, 255 - i * 20, key.wrapping_mul(i), if i % 3 == 0 { 0 } else { 255 }]).collect()
}

/// Two squares beside each other, with all that varies over them.
fn squares(scene: &mut SceneBuilder, colors: bool) -> u32 {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0f32]];
    let vertices = corners.iter().map(|[x, z]| [*x, 0.1 * x * z, -*z]).collect();
    scene.mesh(Mesh {
        name: "squares".into(),
        triangles: Triangles { vertices, indices: vec![[0, 1, 2], [0, 2, 3]] },
        normals: Some(vec![[0.0, 1.0, 0.0]; 4]),
        uvs: [Some(corners.to_vec()), Some(corners.map(|[u, v]| [2.0 * u, 0.5 - v]).to_vec())],
        colors: colors.then(|| (0..4).map(|i| [0.2 * i as f32, 1.0, 0.5, 1.0]).collect()),
        tangents: None,
    })
}

struct Pictures {
    screen: TextureId,
    turned: TextureId,
    plain: TextureId,
    float: TextureId,
}

fn pictures(scene: &mut SceneBuilder) -> Pictures {
    let screen = Texture::new(image(Texels::Srgb8(codes(3))));
    let (s, c) = (0.6f32, 0.8);
    let map = [2.0 * c, 3.0 * s, 0.25, -2.0 * s, 3.0 * c, -0.5];
    let turned = Texture { uv_set: 1, wrap: [Wrap::Mirror; 2], nearest: true, map, ..screen.clone() };
    let plain = Texture { wrap: [Wrap::Clamp; 2], ..Texture::new(image(Texels::Linear8(codes(7)))) };
    let float = Texture::new(image(Texels::Float((0..8).map(|i| [0.1 * i as f32, 0.3, 0.9]).collect())));
    let [screen, turned, plain, float] = [screen, turned, plain, float].map(|t| scene.texture(t));
    Pictures { screen, turned, plain, float }
}

fn materials(scene: &mut SceneBuilder) {
    let p = pictures(scene);
    let grey = Rgb::new(0.5, 0.25, 0.75);
    let gold = Metal::named("Au").unwrap();
    let rough = Some(Facets::isotropic(0.3));
    let channel = |texture, component| Channel { texture, component };
    let mixed = Material::metallic_roughness(grey, 0.5, 0.7);
    let both = Material {
        metallic: Some(channel(p.plain, 2)),
        roughness: Some(Roughness::new(channel(p.plain, 1), true)),
        normal: Some(NormalMap { texture: p.plain, scale: 0.5 }),
        color: Some(p.turned),
        ..mixed.clone()
    };
    let alone = Material { metallic: Some(channel(p.plain, 0)), color: Some(p.float), ..mixed.clone() };
    let cover =
        Material { alpha: Alpha::Blend, opacity: 0.8, cover: Some(p.plain), ..Material::diffuse(grey) };
    let mask = Material {
        alpha: Alpha::Mask { cutoff: 0.3 },
        color: Some(p.screen),
        ..Material::diffuse(Rgb::WHITE)
    };
    let bump = Material { bump: Some(BumpMap { texture: p.plain, scale: 0.1 }), ..Material::diffuse(grey) };
    let emission = Some(Emission { radiance: Rgb::new(7.0, 0.3, 11.0), both_sides: true });
    let varies = Some(Roughness::new(channel(p.plain, 0), false));
    let all = [
        Material::diffuse(grey),
        Material { one_sided: true, ..Material::diffuse(grey) },
        Material::mirror(grey),
        mixed.clone(),
        both,
        alone,
        cover,
        mask,
        bump,
        Material { emission, ..mixed },
        Material { surface: Surface::Unlit { color: grey }, ..Material::diffuse(Rgb::BLACK) },
        Material::conductor(gold, None),
        Material { roughness: varies, ..Material::conductor(gold, Some(Facets::beckmann(0.2, 0.2))) },
        Material::conductor(gold, Some(Facets::new(0.1, 0.4))),
        Material::dielectric(1.33, None),
        Material::dielectric(1.5, rough),
        Material::thin_dielectric(1.4, None),
        Material::thin_dielectric(1.4, rough),
        Material::plastic(grey, 1.49, None, true),
        Material { color: Some(p.screen), ..Material::plastic(Rgb::grey(0.5), 1.6, rough, false) },
        Material::blend(0, 2, 0.3),
        Material { back: Some(0), ..Material::diffuse(Rgb::WHITE) },
    ];
    for (i, material) in all.into_iter().chain(disneys(grey, p.plain)).chain(coats(grey, p.plain)).enumerate()
    {
        let id = scene.material(material.named(format!("look {i}")));
        let mesh = squares(scene, i == 3);
        scene.place("square", mesh, id, Transform::translation(DVec3::new(1.5 * i as f64, 0.0, 0.0)));
    }
}

/// Disney's model: from both sides, from its front, with glass where a picture says so.
fn disneys(base: Rgb, picture: TextureId) -> [Material; 3] {
    let plain = Principled { base, metallic: 0.5, flatness: 0.125, ..Principled::default() };
    let channel = Channel { texture: picture, component: 1 };
    [
        Material::principled(Principled { eta: 1.7, sheen: 0.25, clearcoat: 0.5, ..plain }),
        Material { one_sided: true, ..Material::principled(plain) },
        Material {
            blend: Some(picture),
            roughness: Some(Roughness::new(channel, true)),
            ..Material::principled(Principled { spec_trans: 0.75, ..plain })
        },
    ]
}

/// Clear coats: all over, and where a picture says so.
fn coats(base: Rgb, picture: TextureId) -> [Material; 2] {
    let plain = Material::metallic_roughness(base, 0.25, 0.5);
    [plain.clone().coated(1.0, 0.25), Material { blend: Some(picture), ..plain.coated(0.75, 0.0) }]
}

fn lights(scene: &mut SceneBuilder) {
    let (p, d, light) = (Vec3::new(1.0, 4.0, 2.0), Vec3::new(0.1, -1.0, 0.3), Rgb::new(3.0, 2.5, 2.0));
    scene.light("point", Point { position: p, intensity: light });
    scene.light("spot", Spot::new(p, d, light, 0.2, 0.5, Some(30.0)));
    scene.light("edge", Spot { edge: SpotEdge::Linear, ..Spot::new(p, d, light, 0.2, 0.5, None) });
    scene.light("far", Directional::new(-d, light));
    scene.light("sun", Sun::new(-d, 0.005, light * 1e4));
    scene.light("triangle", Triangle::new(p, p + Vec3::X, p + Vec3::Z, light));
    scene.light("rectangle", Rectangle::new(p, Vec3::X, Vec3::new(0.0, 0.5, 1.0), light));
    scene.light("disk", Disk::new(p + Vec3::Y, d, 0.5, light));
    scene.light("sphere", Sphere::new(p - Vec3::X, 0.25, light));
    scene.light("sky", sky());
}

/// A sky that is turned, and whose axes are mirrored.
fn sky() -> Environment {
    let texels = (0..32 * 16).map(|i| [0.1 + (i % 7) as f32, (i % 5) as f32, 0.5]).collect();
    let picture = Image::new(32, 16, Texels::Float(texels)).unwrap();
    let (s, t) = (Vec3::new(0.6, 0.0, 0.8), Vec3::Y);
    Environment::image(Arc::new(picture))
        .oriented(Frame { s, t, n: s.cross(t) * -1.0 })
        .scaled(Rgb::grey(0.25))
}

/// A scene with something of every kind.
pub fn everything() -> SceneBuilder {
    let mut scene = SceneBuilder::new("everything");
    materials(&mut scene);
    lights(&mut scene);
    let axis = DVec3::new(0.0, 2.0, 1.0);
    scene.shape("ball", Shape::Sphere { center: [0.0, 1.0, 3.0], radius: 0.5 }, 0);
    scene.shape("plate", Shape::Disk { center: [2.0, 1.0, 3.0], normal: [0.3, -2.0, 0.4], radius: 0.5 }, 3);
    scene.shape("rod", Shape::Cylinder { p: [4.0, 1.0, 3.0], q: [4.5, 2.0, 3.5], radius: 0.1 }, 4);
    let linear = DMat3::from_cols(DVec3::X, axis, DVec3::Z * 0.5);
    scene.place("sheared", 0, 0, Transform { linear, translation: DVec3::NEG_Z });
    let linear = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 2.0));
    scene.place("mirrored", 1, 4, Transform { linear, translation: DVec3::Z });
    let camera = Camera::perspective(DVec3::new(15.0, 12.0, 18.0), DVec3::new(15.0, 0.0, 0.0), 50.0);
    let lens = Some(Lens { radius: 0.1, focus: 20.0 });
    let parallel = Projection::Orthographic { height: 8.0 };
    scene.cameras.push(Camera { name: "first".into(), size: Some([64, 48]), ..camera.clone() });
    scene.cameras.push(Camera { lens, shift: [0.1, 0.0], mirrored: true, ..camera.clone() });
    scene.cameras.push(Camera { projection: parallel, aspect: Some(1.5), ..camera });
    scene
}

fn texel_of(scene: &SceneBuilder, id: TextureId, uv: [f32; 2]) -> [f32; 4] {
    scene.textures[id as usize].at(uv)
}

/// Metallic-roughness comes back from glTF as it was, its textures to the texel, its places on the surface to the roundings
/// of an angle.
#[test]
fn metallic_roughness_comes_back_from_gltf() {
    let folder = Folder::new("looks-glb");
    let scene = everything();
    let read = back(&folder, "a.glb", &scene);
    for i in [3, 4, 9, 25, 26] {
        let name = format!("look {i}");
        let [a, b] = [&scene, &read].map(|s| s.materials.iter().find(|m| m.name == name).unwrap());
        // 1.5 gives 0.04 to the last digits.
        let told = |m: &Material| {
            let mut surface = m.surface;
            match &mut surface {
                Surface::MetallicRoughness { f0, .. } | Surface::ClearCoat { f0, .. } => *f0 = 0.04,
                _ => panic!("{name}"),
            }
            surface
        };
        assert_eq!(told(a), told(b), "{name}");
        assert_eq!(a.emission, b.emission, "{name}");
        assert_eq!(a.normal.map(|n| n.scale), b.normal.map(|n| n.scale));
        for uv in [[0.1, 0.2], [0.7, 0.9], [1.4, -0.3]] {
            let of = |s: &SceneBuilder, m: &Material| {
                m.textures().map(|t| texel_of(s, t, uv)[..3].to_vec()).collect::<Vec<_>>()
            };
            assert_eq!(of(&scene, a), of(&read, b), "{name}");
        }
    }
}

/// So do diffuse looks, and glass by its index.
#[test]
fn other_looks_come_back_from_gltf() {
    let folder = Folder::new("others-glb");
    let scene = everything();
    let read = back(&folder, "a.glb", &scene);
    for i in [0, 8, 10, 14, 16] {
        let name = format!("look {i}");
        let [a, b] = [&scene, &read].map(|s| s.materials.iter().find(|m| m.name == name).unwrap().surface);
        assert_eq!(a, b, "{name}");
    }
    let kinds: Vec<_> = read.lights.iter().map(|(n, l)| format!("{n} {}", l.kind())).collect();
    let punctual = ["point Point", "spot Spot", "edge Spot", "far Directional", "sun Directional"];
    assert_eq!(kinds, punctual);
    let (Light::Spot(a), Light::Spot(b)) = (&scene.lights[1].1, &read.lights[1].1) else { panic!() };
    assert_eq!((a.intensity, a.inner, a.outer, a.range), (b.intensity, b.inner, b.outer, b.range));
    // A direction of three roundings.
    assert!((a.direction - b.direction).length() < 4.0 * f32::EPSILON);
    let seen: Vec<_> = read.cameras.iter().map(|c| (c.projection, c.aspect)).collect();
    assert_eq!(seen[0], (scene.cameras[0].projection, Some(64.0 / 48.0)));
    assert_eq!(seen[2], (Projection::Orthographic { height: 8.0 }, Some(1.5)));
}

/// What Mitsuba has comes back from its XML with every bit: metals, glass, plastic, blends, both sides.
#[test]
fn mitsuba_looks_come_back_to_the_bit() {
    let folder = Folder::new("looks-xml");
    let scene = everything();
    let read = back(&folder, "a.xml", &scene);
    for i in [0, 1, 2, 11, 13, 14, 15, 16, 18, 22, 23] {
        let name = format!("look {i}");
        let a = &scene.materials[i];
        let b = read.materials.iter().find(|m| m.name == name.replace(' ', "_")).unwrap();
        assert_eq!((a.surface, a.one_sided), (b.surface, b.one_sided), "{name}");
    }
    let named = |name: &str| read.materials.iter().find(|m| m.name == name).unwrap();
    // Metallic-roughness is written as principled, and glass that a picture mixes in comes back place by place.
    let (Surface::Principled(mixed), Surface::Principled(glass)) =
        (named("look_3").surface, named("look_24").surface)
    else {
        panic!()
    };
    let meant = Principled { base: Rgb::new(0.5, 0.25, 0.75), metallic: 0.5, ..Principled::default() };
    assert_eq!(mixed, Principled { roughness: 0.7, ..meant });
    assert_eq!(glass, Principled { flatness: 0.125, spec_trans: 1.0, roughness: 1.0, ..meant });
    let [red, ..] = texel_of(&read, named("look_24").blend.unwrap(), [0.1, 0.2]);
    let [plain, ..] = texel_of(&scene, scene.materials[24].blend.unwrap(), [0.1, 0.2]);
    // The factor goes into a picture of bytes.
    assert!((red - 0.75 * plain).abs() < 0.5 / 255.0 + 1e-6, "{red} {plain}");
    assert!(
        named("look_4").normal.is_some() && named("look_8").bump.is_some() && named("look_21").back.is_some()
    );
    let part = |id: u32| read.materials[id as usize].surface;
    let Surface::Blend { first, second, weight } = named("look_20").surface else { panic!() };
    let blended = (part(first), part(second), weight);
    assert_eq!(blended, (scene.materials[0].surface, scene.materials[2].surface, 0.3));
    let seen: Vec<_> = read.cameras.iter().map(|c| (c.lens, c.mirrored, c.projection)).collect();
    assert_eq!(seen[0], (None, false, scene.cameras[0].projection));
    // The reader multiplies by the length of an axis, which is 1 to a rounding.
    let (Some(lens), true) = (seen[1].0, seen[1].1) else { panic!("{:?}", seen[1]) };
    assert!((lens.radius - 0.1).abs() < 1e-15 && (lens.focus - 20.0).abs() < 1e-13);
    let kinds =
        |s: &SceneBuilder| s.lights.iter().map(|(n, l)| format!("{n} {}", l.kind())).collect::<Vec<_>>();
    let lights = ["point Point", "spot Spot", "edge Spot", "far Directional", "sun Directional"];
    let kinds = kinds(&read);
    assert!(lights.iter().all(|l| kinds.iter().any(|k| k == l)), "{kinds:?}");
}

/// The picture of the sky lies at the same directions. Between rows that we read from Mitsuba's rows, and theirs, lie two
/// linear interpolations: 2 % of the largest step between texels.
#[test]
fn light_from_all_around_comes_back_from_where_it_was() {
    let folder = Folder::new("sky");
    let read = back(&folder, "a.xml", &everything());
    let environment = |s: &SceneBuilder| {
        s.lights
            .iter()
            .find_map(|(_, l)| if let Light::Environment(e) = l { Some(e.clone()) } else { None })
            .unwrap()
    };
    let (a, b) = (sky(), environment(&read));
    for i in 0..500 {
        let y = 2.0 * (i as f32 + 0.5) / 500.0 - 1.0;
        let (phi, r) = (i as f32 * 2.4, (1.0 - y * y).sqrt());
        let d = Vec3::new(r * real::cosf(phi), y, r * real::sinf(phi)).normalize();
        let (x, y) = (a.radiance_from(d), b.radiance_from(d));
        assert!((0..3).all(|c| (x.0[c] - y.0[c]).abs() < 0.02 * 6.0 * 0.25), "{d}: {x:?} {y:?}");
    }
}

/// A scene of everything is drawn after its way through both formats, about as bright.
#[test]
fn a_scene_of_everything_is_drawn_again() {
    let folder = Folder::new("everything");
    let scene = everything();
    let open = [("estimator", "ambient-occlusion"), ("masks", "opaque")];
    let mean = |s: &SceneBuilder| {
        let pixels = picture(s, &open).pixels;
        pixels.iter().map(|p| f64::from(p[0])).sum::<f64>() / pixels.len() as f64
    };
    let whole = mean(&scene);
    for name in ["a.glb", "a.gltf", "a.xml"] {
        let read = back(&folder, name, &scene);
        // Polygons for circles cover a thousandth less or more of a shape that covers a part of the picture.
        assert!((mean(&read) - whole).abs() < 1e-3, "{name} {whole}");
    }
}
