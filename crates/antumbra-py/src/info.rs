//! What is in a scene: counts for one line, and everything for `antumbra info`.

use std::collections::{BTreeMap, HashSet};

use antumbra::light::Light;
use antumbra::scene::{Alpha, Body, Camera, Emits, Projection, Scene, Surface, Surfaces};
use antumbra::texture::Texels;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::scene::PyScene;

/// A light as people count it: all triangles of an emissive object are one.
struct Counted {
    name: String,
    kind: &'static str,
    power: f32,
    /// Of an environment: mean luminance over all directions, and its picture's size.
    sky: Option<(f32, Option<[u32; 2]>)>,
}

#[pymethods]
impl PyScene {
    /// What there is, for one line: (word, number), only what there is.
    fn counts(&self, py: Python<'_>) -> PyResult<Vec<(String, u64)>> {
        let scene = self.scene(py)?;
        let mut all =
            vec![("triangle".to_string(), scene.triangle_count()), ("shape".into(), shapes(&scene))];
        for light in lights(&scene) {
            let word =
                if light.kind == "environment" { light.kind.into() } else { format!("{} light", light.kind) };
            match all.iter_mut().find(|(known, _)| *known == word) {
                Some((_, n)) => *n += 1,
                None => all.push((word, 1)),
            }
        }
        all.retain(|(_, n)| *n > 0);
        Ok(all)
    }

    /// Counts, bounds, lights, cameras, memory: stable keys, SI units.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let scene = self.scene(py)?;
        let out = PyDict::new(py);
        out.set_item("source", if scene.source.is_empty() { "built in" } else { &scene.source })?;
        out.set_item("triangles", scene.triangle_count())?;
        out.set_item("shapes", shapes(&scene))?;
        out.set_item("meshes", meshes(&scene))?;
        out.set_item("objects", scene.objects.len())?;
        out.set_item("instances", scene.objects.iter().filter(|o| o.transform.is_some()).count())?;
        out.set_item("bounds", scene.bounds().map(|b| self.world_box(b)))?;
        out.set_item("tree_bytes", scene.world().stats().bytes)?;
        let listed = lights(&scene).into_iter().map(|l| light_dict(py, &l)).collect::<PyResult<Vec<_>>>()?;
        out.set_item("lights", PyList::new(py, listed)?)?;
        let cameras = scene.cameras.iter().map(|c| camera_dict(py, c)).collect::<PyResult<Vec<_>>>()?;
        out.set_item("cameras", PyList::new(py, cameras)?)?;
        out.set_item("materials", scene.materials.len())?;
        let masked = scene.materials.iter().filter(|m| m.alpha != Alpha::Opaque).count();
        out.set_item("masked_materials", masked)?;
        out.set_item("material_kinds", material_kinds(&scene))?;
        out.set_item("textures", scene.textures.len())?;
        out.set_item("texture_bytes", texture_bytes(&scene))?;
        let largest = scene.textures.iter().map(|t| [t.image.width, t.image.height]).max_by_key(area);
        out.set_item("largest_texture", largest)?;
        let surfaces = scene.surfaces();
        out.set_item("surfaces", surfaces_dict(py, &surfaces)?)?;
        out.set_item("looks_wrong", scene.looks_wrong(&surfaces))?;
        Ok(out)
    }
}

impl PyScene {
    fn world_box(&self, corners: [antumbra::math::Vec3; 2]) -> [[f64; 3]; 2] {
        let origin = self.origin();
        corners.map(|corner| [0, 1, 2].map(|k| f64::from(corner[k]) + origin[k]))
    }
}

fn shapes(scene: &Scene) -> u64 {
    scene.objects.iter().filter(|o| matches!(o.body, Body::Shape(_))).count() as u64
}

fn meshes(scene: &Scene) -> usize {
    let of = |o: &antumbra::scene::Placed| match o.body {
        Body::Mesh(m) => Some(m),
        Body::Shape(_) => None,
    };
    scene.objects.iter().filter_map(of).collect::<HashSet<_>>().len()
}

fn area([width, height]: &[u32; 2]) -> u64 {
    u64::from(*width) * u64::from(*height)
}

/// How many materials of each kind there are, by the words that people use.
fn material_kinds(scene: &Scene) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    for material in scene.materials.iter() {
        let word = match material.surface {
            Surface::Diffuse { .. } if material.emission.is_some() => "light",
            Surface::Diffuse { .. } => "diffuse",
            Surface::DiffuseTransmission(_) => "thin cloth",
            Surface::Mirror { .. } => "mirror",
            Surface::MetallicRoughness { .. } => "metallic-roughness",
            Surface::ClearCoat { .. } => "clear coat",
            Surface::Principled(_) => "principled",
            Surface::Unlit { .. } => "unlit",
            Surface::Conductor(_) => "metal",
            Surface::RoughConductor(_) => "rough metal",
            Surface::CoatedConductor(_) => "coated metal",
            Surface::Dielectric(_) => "glass",
            Surface::RoughDielectric(_) => "ground glass",
            Surface::ThinDielectric(_) => "pane of glass",
            Surface::RoughThinDielectric(_) => "pane of ground glass",
            Surface::Plastic { .. } => "plastic",
            Surface::RoughPlastic { .. } => "rough plastic",
            Surface::Blend { .. } => "blend",
        };
        *counts.entry(word).or_default() += 1;
    }
    counts
}

/// What all meshes together are as surfaces: counts.
fn surfaces_dict<'py>(py: Python<'py>, meshes: &[Surfaces]) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    let sum = |of: fn(&Surfaces) -> u64| meshes.iter().map(of).sum::<u64>();
    out.set_item("closed_meshes", sum(|m| u64::from(m.volume.is_some())))?;
    out.set_item("open_meshes", sum(|m| u64::from(m.volume.is_none())))?;
    out.set_item("edges", sum(|m| m.edges))?;
    out.set_item("open_edges", sum(|m| m.open_edges))?;
    out.set_item("turned_edges", sum(|m| m.turned_edges))?;
    out.set_item("duplicate_triangles", sum(|m| m.duplicates))?;
    out.set_item("triangles_without_area", sum(|m| m.without_area))?;
    out.set_item("triangles_with_normals_on_the_back", sum(|m| m.backward_normals))?;
    Ok(out)
}

/// Pictures that several textures share count once.
fn texture_bytes(scene: &Scene) -> u64 {
    let mut seen = HashSet::new();
    let fresh = scene.textures.iter().filter(|t| seen.insert(std::sync::Arc::as_ptr(&t.image)));
    let size = |texels: &Texels| match texels {
        Texels::Srgb8(t) | Texels::Linear8(t) => 4 * t.len() as u64,
        Texels::Float(t) => 12 * t.len() as u64,
    };
    fresh.map(|t| size(&t.image.texels)).sum()
}

fn kind(light: &Light) -> &'static str {
    match light {
        Light::Point(_) => "point",
        Light::Spot(_) => "spot",
        Light::Directional(_) => "directional",
        Light::Sun(_) => "sun",
        Light::Environment(_) => "environment",
        Light::Triangle(_) | Light::Rectangle(_) | Light::Disk(_) | Light::Sphere(_) => "area",
    }
}

fn lights(scene: &Scene) -> Vec<Counted> {
    let names = scene.light_names();
    let parts: HashSet<usize> = scene.objects.iter().flat_map(|o| emitted(scene, o)).collect();
    let mut name_of = vec![""; scene.lights().len()];
    for (name, slot) in names.names.iter().zip(&names.slots) {
        if let Some(own) = name_of.get_mut(*slot as usize) {
            *own = name;
        }
    }
    let one = |(id, light): (usize, &Light), power: f32| Counted {
        name: name_of[id].into(),
        kind: kind(light),
        power,
        sky: sky(light),
    };
    let of = |id: &usize| scene.lights().get(*id).map_or(0.0, |l| l.power(scene.radius()));
    let single = scene.lights().iter().enumerate().filter(|(id, _)| !parts.contains(id));
    let mut all: Vec<Counted> = single.map(|(id, l)| one((id, l), of(&id))).collect();
    for object in scene.objects.iter() {
        let ids = emitted(scene, object);
        if !ids.is_empty() {
            let name = match object.emits {
                Emits::Each(first, _) => names.names[first as usize].clone(),
                _ => object.name.clone(),
            };
            all.push(Counted { name, kind: "area", power: ids.iter().map(of).sum(), sky: None });
        }
    }
    all
}

fn sky(light: &Light) -> Option<(f32, Option<[u32; 2]>)> {
    let Light::Environment(environment) = light else { return None };
    let picture = environment.picture.as_ref();
    let mean = picture.map_or(1.0, |p| p.mean() as f32) * environment.radiance.luminance();
    Some((mean, picture.map(|p| [p.image().width, p.image().height])))
}

/// The lights that the triangles of an object are.
fn emitted(scene: &Scene, object: &antumbra::scene::Placed) -> Vec<usize> {
    let (Emits::Each(_, run), Body::Mesh(_)) = (object.emits, &object.body) else { return Vec::new() };
    let primitives = (0..object.primitives(&scene.meshes)).step_by(run as usize);
    primitives.filter_map(|local| scene.light_of(object, local).map(|id| id as usize)).collect()
}

fn light_dict<'py>(py: Python<'py>, light: &Counted) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    out.set_item("name", &light.name)?;
    out.set_item("kind", light.kind)?;
    out.set_item("power", light.power)?;
    if let Some((mean, size)) = light.sky {
        out.set_item("mean_radiance", mean)?;
        out.set_item("size", size)?;
    }
    Ok(out)
}

fn camera_dict<'py>(py: Python<'py>, camera: &Camera) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    let fov = match camera.projection {
        Projection::Perspective { vertical_fov } => Some(vertical_fov),
        Projection::Orthographic { .. } => None,
    };
    out.set_item("name", &camera.name)?;
    out.set_item("vertical_fov", fov)?;
    out.set_item("eye", camera.eye.to_array())?;
    out.set_item("look_at", camera.look_at.to_array())?;
    out.set_item("aperture", camera.lens.map(|lens| lens.radius))?;
    out.set_item("focus", camera.lens.map(|lens| lens.focus))?;
    Ok(out)
}
