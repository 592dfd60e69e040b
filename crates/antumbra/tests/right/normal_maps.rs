//! A picture of normals bends the shading normal, whatever became of the mesh: turned, mirrored, stretched, drawn twice.

use std::sync::Arc;

use antumbra::estimator::EstimatorKind;
use antumbra::film::Planes;
use antumbra::light::Environment;
use antumbra::math::{DMat3, DVec3, Rgb, Transform, Vec3};
use antumbra::scene::{Camera, Material, Mesh, NormalMap, SceneBuilder, Surface};
use antumbra::settings::Settings;
use antumbra::texture::{Image, Texels, Texture};

use super::pictures::{look, plane, small};
use super::scenes::parallelogram;

/// A square in the plane z = 0 that faces +z, under a map of one normal, moved by `linear`; the normal that is seen.
fn seen(normal: [f32; 3], linear: DMat3, clay: Option<f32>) -> Vec3 {
    let mut builder = SceneBuilder::new("map");
    let image = Image::new(1, 1, Texels::Float(vec![normal.map(|c| 0.5 * c + 0.5)])).unwrap();
    let texture = builder.texture(Texture::new(Arc::new(image)));
    let material =
        Material { normal: Some(NormalMap { texture, scale: 1.0 }), ..Material::diffuse(Rgb::grey(0.5)) };
    let material = builder.material(material);
    let corner = Vec3::new(-1.0, -1.0, 0.0);
    let triangles = parallelogram(corner, Vec3::X * 2.0, Vec3::Y * 2.0);
    // v runs downwards in the picture.
    let uvs = [Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]), None];
    let mesh = builder.mesh(Mesh { triangles, uvs, ..Mesh::default() });
    builder.place("square", mesh, material, Transform { linear, translation: DVec3::ZERO });
    builder.light("sky", Environment::constant(Rgb::WHITE));
    builder.cameras.push(Camera::perspective(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 5.0));
    let scene = builder.build().unwrap();
    let settings = Settings { aov: Planes::NORMAL, viewing_rays: 1, clay, ..small(EstimatorKind::Area) };
    let picture = look(&scene, &settings);
    let values = plane(&picture, "normal");
    Vec3::new(values[0], values[1], values[2])
}

#[test]
fn maps_turn_with_their_surface() {
    let right = [0.6, 0.0, 0.8];
    let up = [0.0, 0.6, 0.8];
    let quarter = DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z);
    let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
    let stretch = DMat3::from_diagonal(DVec3::new(3.0, 0.5, 1.0));
    let cases = [
        (right, DMat3::IDENTITY, [0.6, 0.0, 0.8]),
        (up, DMat3::IDENTITY, [0.0, 0.6, 0.8]),
        (right, quarter, [0.0, 0.6, 0.8]),
        (up, quarter, [-0.6, 0.0, 0.8]),
        (right, mirror, [-0.6, 0.0, 0.8]),
        (up, mirror, [0.0, 0.6, 0.8]),
        (right, stretch, [0.6, 0.0, 0.8]),
        (up, stretch, [0.0, 0.6, 0.8]),
    ];
    for (map, linear, expected) in cases {
        // Texels and interpolation round a few times.
        let found = seen(map, linear, None);
        assert!((found - Vec3::from(expected)).length() < 1e-5, "{map:?} {linear:?}: {found}");
    }
}

/// Two objects of one mesh whose maps follow different texture coordinates: each is lit by its own, in any order.
#[test]
fn one_mesh_under_two_texture_coordinates() {
    let right = Image::new(1, 1, Texels::Float(vec![[0.8, 0.5, 0.9]])).unwrap();
    let right = Texture::new(Arc::new(right));
    for first in [0, 1] {
        let mut builder = SceneBuilder::new("two sets");
        let triangles = parallelogram(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0);
        // u along +x; u along +y with the top of the picture at −x.
        let along_x = vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        let along_y = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
        let mesh = builder.mesh(Mesh { triangles, uvs: [Some(along_x), Some(along_y)], ..Mesh::default() });
        for (nth, uv_set) in [first, 1 - first].into_iter().enumerate() {
            let texture = builder.texture(Texture { uv_set, ..right.clone() });
            let map = Some(NormalMap { texture, scale: 1.0 });
            let material = builder.material(Material { normal: map, ..Material::diffuse(Rgb::grey(0.5)) });
            let translation = DVec3::X * 100.0 * (1 - nth) as f64;
            builder.place("square", mesh, material, Transform { linear: DMat3::IDENTITY, translation });
        }
        builder.light("sky", Environment::constant(Rgb::WHITE));
        builder.cameras.push(Camera::perspective(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 5.0));
        let scene = builder.build().unwrap();
        let settings = Settings { aov: Planes::NORMAL, viewing_rays: 1, ..small(EstimatorKind::Area) };
        let picture = look(&scene, &settings);
        let values = plane(&picture, "normal");
        let expected = if first == 1 { Vec3::new(0.6, 0.0, 0.8) } else { Vec3::new(0.0, 0.6, 0.8) };
        let found = Vec3::new(values[0], values[1], values[2]);
        assert!((found - expected).length() < 1e-5, "{found} for {expected}");
    }
}

#[test]
fn clay_has_no_map() {
    assert_eq!(seen([0.6, 0.0, 0.8], DMat3::IDENTITY, Some(0.8)), Vec3::Z);
}

/// An unlit square shows its colour without any light, and lights nothing.
#[test]
fn unlit_is_seen_as_it_is() {
    let mut builder = SceneBuilder::new("unlit");
    let sign = Material {
        surface: Surface::Unlit { color: Rgb::new(0.2, 0.4, 0.6) },
        ..Material::diffuse(Rgb::BLACK)
    };
    let (sign, floor) = (builder.material(sign), builder.material(Material::diffuse(Rgb::grey(0.5))));
    let square = |y: f32| parallelogram(Vec3::new(-1.0, y, 0.0), Vec3::X * 2.0, Vec3::Y);
    builder.object("sign", square(0.0), sign);
    builder.object(
        "floor",
        parallelogram(Vec3::new(-1.0, -1.0, 2.0), Vec3::X * 2.0, Vec3::new(0.0, 1.0, -2.0)),
        floor,
    );
    builder.cameras.push(Camera::perspective(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, 15.0));
    let scene = builder.build().unwrap();
    let picture = look(&scene, &Settings { viewing_rays: 4, bounces: 3, ..small(EstimatorKind::Path) });
    let (top, bottom) = (picture.pixels[10], picture.pixels[picture.pixels.len() - 10]);
    assert_eq!((top, bottom), ([0.2, 0.4, 0.6], [0.0; 3]));
}
