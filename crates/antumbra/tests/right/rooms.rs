//! Small rooms to look into: several finite lights, occluders, textures, shading normals.

use std::sync::Arc;

use antumbra::light::{Disk, Environment, Rectangle, Sphere, Triangle};
use antumbra::math::{DVec3, Rgb, Vec3, real};
use antumbra::scene::{Camera, Material, Mesh, SceneBuilder};
use antumbra::texture::{Image, Texels, Texture};
use antumbra::trace::{Shape, Triangles};

use super::scenes::parallelogram;

/// A floor with a checker texture, two walls, a smooth ball, a shape, a slanted plate: no light yet.
pub fn unlit() -> SceneBuilder {
    let mut room = SceneBuilder::new("room");
    let checker = vec![[200, 120, 60, 255], [60, 140, 220, 255], [60, 140, 220, 255], [230, 230, 200, 255]];
    let image = Image::new(2, 2, Texels::Srgb8(checker)).unwrap();
    let texture = room.texture(Texture::new(Arc::new(image)));
    let tiles = Material { color: Some(texture), ..Material::diffuse(Rgb::grey(0.8)) };
    let tiles = room.material(tiles);
    let plaster = room.material(Material::diffuse(Rgb::new(0.7, 0.6, 0.5)));
    let glossy = room.material(Material::metallic_roughness(Rgb::new(0.9, 0.6, 0.3), 0.7, 0.45));
    let varnish = room.material(Material::metallic_roughness(Rgb::new(0.3, 0.5, 0.6), 0.0, 0.3));

    let at = Vec3::new;
    let floor = parallelogram(at(-3.0, 0.0, 3.0), at(6.0, 0.0, 0.0), at(0.0, 0.0, -6.0));
    let uvs = [Some(vec![[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]]), None];
    let floor = room.mesh(Mesh { triangles: floor, uvs, ..Mesh::default() });
    room.place("floor", floor, tiles, antumbra::math::Transform::IDENTITY);
    room.object("back", parallelogram(at(-3.0, 0.0, -3.0), at(6.0, 0.0, 0.0), at(0.0, 4.0, 0.0)), plaster);
    room.object("left", parallelogram(at(-3.0, 0.0, 3.0), at(0.0, 0.0, -6.0), at(0.0, 4.0, 0.0)), plaster);
    let plate = parallelogram(at(0.4, 0.3, -0.9), at(1.2, 0.7, 0.0), at(0.1, 0.1, 1.1));
    room.object("plate", plate, varnish);
    let (triangles, normals) = ball(at(-1.1, 0.75, 0.2), 0.7);
    let ball = room.mesh(Mesh { triangles, normals: Some(normals), ..Mesh::default() });
    room.place("ball", ball, glossy, antumbra::math::Transform::IDENTITY);
    room.shape("post", Shape::Cylinder { p: [1.6, 0.0, 0.8], q: [1.5, 1.4, 0.7], radius: 0.15 }, plaster);
    room.cameras.push(Camera::perspective(DVec3::new(0.6, 2.3, 5.2), DVec3::new(-0.1, 0.7, 0.0), 42.0));
    room
}

/// Six lights of every finite kind, each at least half a unit from what it lights.
pub fn lit() -> SceneBuilder {
    let mut room = unlit();
    let at = Vec3::new;
    let (u, v) = (at(1.6, 0.0, 0.0), at(0.0, 0.0, 1.2));
    room.light("ceiling", Rectangle::new(at(-0.8, 3.6, -0.8), u, v, Rgb::new(4.0, 3.6, 3.0)));
    room.light("lamp", Sphere::new(at(1.9, 2.2, -1.2), 0.35, Rgb::new(2.0, 4.0, 6.0)));
    let down = at(-0.4, -1.0, -0.2);
    room.light("spot", Disk::new(at(2.2, 3.0, 1.6), down, 0.4, Rgb::new(6.0, 6.0, 5.0)));
    let sail = Triangle::new(at(-2.2, 2.0, -1.0), at(-1.6, 2.9, -1.6), at(-2.1, 2.9, 0.1), Rgb::grey(3.0));
    room.light("sail", sail.both_sides(true));
    let screen = room.material(Material::light(Rgb::new(1.0, 3.0, 1.0)));
    room.object("screen", parallelogram(at(-0.4, 1.6, -2.2), at(0.9, 0.0, 0.0), at(0.0, 0.6, 0.0)), screen);
    room
}

/// The room under a sky that is bright on one side.
pub fn under_sky() -> SceneBuilder {
    let mut room = unlit();
    let (w, h) = (32, 16);
    let light = |i: u32| {
        let (x, y) = (f64::from(i % w), f64::from(i / w));
        let side = 1.0 + real::cos(0.2 * (x - 20.0));
        let l = (0.3 + side * real::exp(-0.1 * (y - 5.0) * (y - 5.0))) as f32;
        [l, 1.1 * l, 1.4 * l]
    };
    let image = Image::new(w, h, Texels::Float((0..w * h).map(light).collect())).unwrap();
    room.light("sky", Environment::image(Arc::new(image)));
    room.light("lamp", Sphere::new(Vec3::new(1.9, 2.2, -1.2), 0.35, Rgb::new(2.0, 4.0, 6.0)));
    room
}

/// A ball of latitude-longitude triangles with smooth normals.
pub fn ball(center: Vec3, radius: f32) -> (Triangles, Vec<[f32; 3]>) {
    const AROUND: u32 = 14;
    const DOWN: u32 = 8;
    let mut vertices = Vec::new();
    let mut normals = Vec::new();
    for j in 0..=DOWN {
        let theta = std::f64::consts::PI * f64::from(j) / f64::from(DOWN);
        for i in 0..AROUND {
            let phi = 2.0 * std::f64::consts::PI * f64::from(i) / f64::from(AROUND);
            let sin = real::sin(theta);
            let n = DVec3::new(real::cos(phi) * sin, real::cos(theta), real::sin(phi) * sin).as_vec3();
            normals.push(n.to_array());
            vertices.push((center + n * radius).to_array());
        }
    }
    let mut indices = Vec::new();
    for j in 0..DOWN {
        for i in 0..AROUND {
            let next = (i + 1) % AROUND;
            let [a, b] = [j * AROUND + i, j * AROUND + next];
            let [c, d] = [a + AROUND, b + AROUND];
            // The rows at the poles are points: one triangle each.
            if j > 0 {
                indices.push([a, b, c]);
            }
            if j + 1 < DOWN {
                indices.push([b, d, c]);
            }
        }
    }
    (Triangles { vertices, indices }, normals)
}
