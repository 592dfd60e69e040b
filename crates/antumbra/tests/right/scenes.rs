//! Scenes of the table as scenes of ours: lights, two-sided black occluders, an environment, and a bare receiver.

use antumbra::light::{Directional, Disk, Point, Rectangle, Sphere, Spot, Sun, Triangle};
use antumbra::math::{DVec3, Rgb, Vec3, real};
use antumbra::scene::{Material, MaterialId, Scene, SceneBuilder};
use antumbra::sensor::Query;
use antumbra::trace::{Shape, Triangles};
use serde_json::Value;

use super::sky;
use super::table::{list, number, numbers};

/// Half the side of the square that stands for a plane: 10⁷ times the distance at which the table looks at one.
const PLANE: f64 = 1e4;

/// A scene with the receiver that looks at it.
pub struct Built {
    /// Lights and occluders.
    pub scene: Scene,
    /// p and n.
    pub query: Query,
    /// ∫ (stored − true radiance of the environment) cos⁺ dω: what the texels of its picture add to E.
    pub texels: f64,
}

/// A bare receiver.
pub fn receiver(p: [f64; 3], n: [f64; 3]) -> Query {
    let n = DVec3::from(n).normalize().to_array();
    Query { p, n, start: None }
}

/// A point of the table, in f32.
pub fn vec3(v: &Value) -> Vec3 {
    DVec3::from(numbers::<3>(v)).as_vec3()
}

/// Builds a scene of the table.
pub fn build(scene: &Value) -> Built {
    build_with(scene, |_, _| {})
}

/// The same with more in it; `more` gets the builder and the black material of occluders.
pub fn build_with(scene: &Value, more: impl FnOnce(&mut SceneBuilder, MaterialId)) -> Built {
    let mut builder = SceneBuilder::new("closed form");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    list(&scene["lights"]).iter().for_each(|light| add_light(&mut builder, light));
    list(&scene["occluders"]).iter().for_each(|o| add_occluder(&mut builder, o, black));
    let at = &scene["receiver"];
    let query = receiver(numbers(&at["p"]), numbers(&at["n"]));
    let mut texels = 0.0;
    if !scene["env"].is_null() && scene["ao"].is_null() {
        let sky = sky::Sky::of(&scene["env"]);
        texels = sky.texels(DVec3::from(query.n));
        builder.light("sky", sky.environment());
    }
    more(&mut builder, black);
    Built { scene: builder.build().unwrap(), query, texels }
}

fn add_light(builder: &mut SceneBuilder, light: &Value) {
    let kind = light["type"].as_str().unwrap();
    let [radiance, intensity, irradiance] =
        ["Le", "I", "E0"].map(|k| Rgb::grey(light[k].as_f64().unwrap_or(0.0) as f32));
    let at = |k: &str| vec3(&light[k]);
    let length = |k: &str| number(&light[k]) as f32;
    match kind {
        "point" => builder.light(kind, Point { position: at("position"), intensity }),
        "spot" => {
            let range = light["range"].as_f64().map(|r| r as f32);
            let (inner, outer) = (length("inner"), length("outer"));
            builder.light(kind, Spot::new(at("position"), at("direction"), intensity, inner, outer, range));
        }
        "directional" => builder.light(kind, Directional::new(at("dir_to_light"), irradiance)),
        "sun_disc" => builder.light(kind, Sun::new(at("dir_to_light"), length("half_angle_rad"), radiance)),
        "rect" => builder.light(kind, Rectangle::new(at("corner"), at("u"), at("v"), radiance)),
        "disk" => builder.light(kind, Disk::new(at("center"), at("normal"), length("radius"), radiance)),
        "sphere" => builder.light(kind, Sphere::new(at("center"), length("radius"), radiance)),
        "triangle" => {
            let [a, b, c] = [0, 1, 2].map(|i| vec3(&light["v"][i]));
            builder.light(kind, Triangle::new(a, b, c, radiance));
        }
        // An emissive mesh: a fan.
        "polygon" => {
            let material = builder.material(Material::light(radiance));
            builder.object(kind, fan(&light["v"]), material);
        }
        // Seen from below the plane of its rim, a cap fills the directions of the disk in its rim.
        "sphere_cap_inside" => {
            let (half, radius) = (number(&light["half_angle_rad"]), number(&light["radius"]));
            let axis = DVec3::from(numbers::<3>(&light["axis"])).normalize();
            let center = DVec3::from(numbers::<3>(&light["center"])) + axis * (radius * real::cos(half));
            let rim = (radius * real::sin(half)) as f32;
            builder.light(kind, Disk::new(center.as_vec3(), (-axis).as_vec3(), rim, radiance));
        }
        other => panic!("a light of type {other}: leave its case out by name"),
    }
}

fn add_occluder(builder: &mut SceneBuilder, occluder: &Value, black: MaterialId) {
    let kind = occluder["type"].as_str().unwrap();
    let at = |k: &str| vec3(&occluder[k]);
    let array = |k: &str| vec3(&occluder[k]).to_array();
    let radius = occluder["radius"].as_f64().unwrap_or(0.0) as f32;
    match kind {
        "rect" => builder.object(kind, parallelogram(at("corner"), at("u"), at("v")), black),
        "triangle" => builder.object(kind, fan(&occluder["v"]), black),
        "plane" => {
            let (u, v) = DVec3::from(numbers::<3>(&occluder["n"])).normalize().any_orthonormal_pair();
            let (u, v) = ((u * 2.0 * PLANE).as_vec3(), (v * 2.0 * PLANE).as_vec3());
            builder.object(kind, parallelogram(at("p") - 0.5 * (u + v), u, v), black);
        }
        "disk" => {
            let (center, normal) = (array("center"), array("normal"));
            builder.shape(kind, Shape::Disk { center, normal, radius }, black);
        }
        "sphere" => builder.shape(kind, Shape::Sphere { center: array("center"), radius }, black),
        "open_cylinder" => {
            builder.shape(kind, Shape::Cylinder { p: array("p0"), q: array("p1"), radius }, black);
        }
        other => panic!("an occluder of type {other}"),
    }
}

/// Two triangles.
pub fn parallelogram(corner: Vec3, u: Vec3, v: Vec3) -> Triangles {
    let vertices = [corner, corner + u, corner + (u + v), corner + v].map(|x| x.to_array()).to_vec();
    Triangles { vertices, indices: vec![[0, 1, 2], [0, 2, 3]] }
}

fn fan(corners: &Value) -> Triangles {
    let vertices: Vec<[f32; 3]> = list(corners).iter().map(|v| vec3(v).to_array()).collect();
    let indices = (1..vertices.len() as u32 - 1).map(|i| [0, i, i + 1]).collect();
    Triangles { vertices, indices }
}
