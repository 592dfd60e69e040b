//! Builder → scene: all checking happens here, once.

use std::collections::HashMap;

use antumbra_math::{Transform, Vec3};
use antumbra_trace::{Pool, Shape, Triangles};

use super::parts::Parts;
use super::{
    Body, Level, Material, Mesh, Message, Object, Scene, SceneBuilder, SceneError, Surface, Tangents, blended,
};
use crate::texture::Texture;

impl SceneBuilder {
    /// Checks everything and builds the tree, in the calling thread.
    pub fn build(self) -> Result<Scene, SceneError> {
        self.build_in(Pool::serial())
    }

    /// Checks everything and builds the tree with the threads of `pool`.
    pub fn build_in(self, pool: Pool<'_>) -> Result<Scene, SceneError> {
        self.checked()?.finished(pool)
    }

    /// The same scene with every number checked: what makes no sense is left out with a warning or is the error, cameras
    /// have names, a file without light has its sky. What is drawn, for those who write it elsewhere.
    pub fn checked(mut self) -> Result<SceneBuilder, SceneError> {
        self.check_materials()?;
        self.check_meshes()?;
        self.check_objects()?;
        self.check_heights();
        self.make_tangents();
        self.check_lights();
        self.check_cameras();
        self.add_sky();
        Ok(self)
    }

    /// What is checked, in its place, with the tree.
    fn finished(mut self, pool: Pool<'_>) -> Result<Scene, SceneError> {
        let mut parts = Parts::default();
        let uses = self.mesh_uses();
        let objects = std::mem::take(&mut self.objects);
        let mut meshes: Vec<Option<Mesh>> = std::mem::take(&mut self.meshes).into_iter().map(Some).collect();
        for object in objects {
            let place = format!("object \"{}\"", object.name);
            if let Err(what) = parts.place(object, &mut meshes, &uses) {
                self.say(Level::Warning, place, format!("{what}: left out"));
            }
        }
        for (name, light) in std::mem::take(&mut self.lights) {
            parts.add_light(&name, light, &mut self.materials);
        }
        parts.add_emissive_objects(&self.materials)?;
        parts.finish(self, pool)
    }

    fn check_materials(&mut self) -> Result<(), SceneError> {
        for i in 0..self.materials.len() {
            if self.materials[i].tame() {
                let text =
                    "reflects more than all light, or a number is not finite: taken into 0 to 1".to_string();
                self.say(Level::Warning, material_place(i, &self.materials[i]), text);
            }
            let m = &self.materials[i];
            if let Some(texture) = m.textures().find(|t| *t as usize >= self.textures.len()) {
                let what = format!("asks for texture {texture} of {}", self.textures.len());
                return Err(SceneError::new(material_place(i, m), what, ""));
            }
            let blends = match m.surface {
                Surface::Blend { first, second, .. } => Some(first.max(second)),
                _ => None,
            };
            if blends.max(m.back).is_some_and(|latest| latest as usize >= i) {
                let what = "blends, or has on its back, a material that does not stand before it";
                return Err(SceneError::new(material_place(i, m), what, ""));
            }
            if let Some(what) = m.surface.fault() {
                return Err(SceneError::new(material_place(i, m), what, ""));
            }
            if let Some(e) = m.emission
                && !(e.radiance.is_finite() && e.radiance.0.iter().all(|c| *c >= 0.0))
            {
                let what = format!("emits {:?}: radiance must be finite and not negative", e.radiance.0);
                return Err(SceneError::new(material_place(i, m), what, ""));
            }
            let (m, textures) = (&mut self.materials[i], &self.textures);
            m.roughness = m.roughness.take().map(|roughness| {
                let texture = &textures[roughness.channel.texture as usize];
                roughness.of(&m.surface, texture)
            });
        }
        Ok(())
    }

    /// Indices in range; triangles with a corner that is not finite are dropped, with a warning.
    fn check_meshes(&mut self) -> Result<(), SceneError> {
        let mut said = Vec::new();
        for (i, mesh) in self.meshes.iter_mut().enumerate() {
            let place =
                if mesh.name.is_empty() { format!("mesh {i}") } else { format!("mesh \"{}\"", mesh.name) };
            let n = mesh.triangles.vertices.len();
            if let Some(bad) = mesh.triangles.indices.iter().flatten().find(|v| **v as usize >= n) {
                let what = format!("a triangle asks for vertex {bad}, but there are {n}");
                return Err(SceneError::new(place, what, "the file is damaged or its exporter is wrong"));
            }
            let attributes = [
                ("normals", mesh.normals.as_ref().map(Vec::len)),
                ("texture coordinates", mesh.uvs[0].as_ref().map(Vec::len)),
                ("texture coordinates", mesh.uvs[1].as_ref().map(Vec::len)),
                ("tangents", mesh.tangents.as_ref().and_then(Tangents::vertices)),
                ("colours", mesh.colors.as_ref().map(Vec::len)),
            ];
            for (what, len) in attributes {
                if len.is_some_and(|len| len != n) {
                    let what =
                        format!("{} {what} for {n} vertices: one a vertex is needed", len.unwrap_or(0));
                    return Err(SceneError::new(place, what, ""));
                }
            }
            if mesh.colors.as_mut().is_some_and(|c| tame_all(c.as_flattened_mut())) {
                said.push((place.clone(), "vertex colours outside of 0 to 1: taken into it".into()));
            }
            let dropped = drop_unusable(&mut mesh.triangles);
            if dropped > 0 {
                said.push((
                    place,
                    match dropped {
                        1 => "a triangle with coordinates that are not finite: left out".into(),
                        n => format!("{n} triangles with coordinates that are not finite: left out"),
                    },
                ));
            }
        }
        said.into_iter().for_each(|(place, text)| self.say(Level::Warning, place, text));
        Ok(())
    }

    /// References in range; objects that have no place in space are left out, with a warning.
    fn check_objects(&mut self) -> Result<(), SceneError> {
        let mut kept = Vec::with_capacity(self.objects.len());
        for (i, object) in std::mem::take(&mut self.objects).into_iter().enumerate() {
            let place = if object.name.is_empty() {
                format!("object {i}")
            } else {
                format!("object \"{}\"", object.name)
            };
            let mesh_missing = matches!(object.body, Body::Mesh(m) if m as usize >= self.meshes.len());
            if mesh_missing || object.material as usize >= self.materials.len() {
                return Err(SceneError::new(place, "asks for a mesh or material that does not exist", ""));
            }
            let singular =
                !object.transform.is_finite() || object.transform.inverse().is_none_or(|t| !t.is_finite());
            if singular {
                self.say(Level::Warning, place, "its transform squeezes it flat (singular): left out");
                continue;
            }
            if let Body::Shape(shape) = &object.body {
                if let Some(what) = shape_fault(shape) {
                    return Err(SceneError::new(place, what, ""));
                }
                let shines = self.materials[object.material as usize].emission.is_some();
                if shines && matches!(shape, Shape::Cylinder { .. }) {
                    self.say(Level::Warning, place.clone(), "a cylinder cannot shine: its light is left out");
                }
                if object.transform != Transform::IDENTITY {
                    return Err(SceneError::new(
                        place,
                        "a shape cannot be transformed",
                        "give its numbers in world space",
                    ));
                }
            }
            kept.push(object);
        }
        self.objects = kept;
        Ok(())
    }

    /// Says where heights cannot be drawn.
    fn check_heights(&mut self) {
        for object in &self.objects {
            let look = |id: u32| self.materials[id as usize].bump;
            let Some(map) = blended(&self.materials, object.material).into_iter().find_map(look) else {
                continue;
            };
            let set = usize::from(self.textures[map.texture as usize].uv_set);
            let bare = match object.body {
                Body::Mesh(m) => self.meshes[m as usize].uvs.get(set).is_none_or(Option::is_none),
                Body::Shape(_) => true,
            };
            if bare {
                let place = format!("object \"{}\"", object.name);
                let text = "has heights and no texture coordinates: drawn without them".into();
                self.messages.push(Message { level: Level::Warning, place, text });
            }
        }
    }

    /// Meshes under a normal map or with facets of two widths get tangents if they bring none; a mesh that objects look at
    /// through different texture coordinates becomes one for each.
    fn make_tangents(&mut self) {
        // The mesh of the file and how its tangents are made, then the mesh that has them.
        let mut made: HashMap<(u32, usize, bool), u32> = HashMap::new();
        let bare: Vec<bool> = self.meshes.iter().map(|mesh| mesh.tangents.is_none()).collect();
        for object in &mut self.objects {
            let Body::Mesh(m) = object.body else { continue };
            let looks = || {
                blended(&self.materials, object.material).into_iter().map(|id| &self.materials[id as usize])
            };
            let map = looks().find_map(|look| look.normal).map(|map| &self.textures[map.texture as usize]);
            if !bare[m as usize] || (map.is_none() && !looks().any(|look| look.surface.is_stretched())) {
                continue;
            }
            // A map that turns v round (OBJ) makes it grow upwards on the mesh.
            let turns = |t: &Texture| t.map[0] * t.map[4] - t.map[1] * t.map[3] < 0.0;
            let set = map.map_or(0, |map| map.uv_set as usize);
            let way = (m, set, !map.is_some_and(turns));
            if let Some(of) = made.get(&way) {
                object.body = Body::Mesh(*of);
                continue;
            }
            let said = match Tangents::made(&self.meshes[m as usize], set, way.2) {
                Some((tangents, said)) => {
                    let of = with_tangents(&mut self.meshes, m, tangents);
                    made.insert(way, of);
                    object.body = Body::Mesh(of);
                    said
                }
                None => {
                    map.map(|_| "has a normal map and no texture coordinates: drawn without it".to_string())
                }
            };
            if let Some(text) = said {
                let place = format!("object \"{}\"", object.name);
                self.messages.push(Message { level: Level::Warning, place, text });
            }
        }
    }

    /// Lights whose numbers make no sense are left out, with a warning.
    fn check_lights(&mut self) {
        for (name, light) in std::mem::take(&mut self.lights) {
            match light.fault() {
                None => self.lights.push((name, light)),
                Some(what) => {
                    let place = format!("{} light \"{name}\"", light.kind().to_lowercase());
                    self.say(Level::Warning, place, format!("{what}: left out"));
                }
            }
        }
    }

    /// Cameras that cannot look are left out, with a warning; those without a name get one ("camera 2").
    fn check_cameras(&mut self) {
        for mut camera in std::mem::take(&mut self.cameras) {
            if let Some(up) = camera.other_up() {
                camera.up = up;
                let text = "it looks straight along its up direction: another one is taken";
                self.say(Level::Note, format!("camera \"{}\"", camera.name), text);
            }
            match camera.fault() {
                None => self.cameras.push(camera),
                Some(what) => self.say(
                    Level::Warning,
                    format!("camera \"{}\"", camera.name),
                    format!("{what}: left out"),
                ),
            }
        }
        for (i, camera) in self.cameras.iter_mut().enumerate().filter(|(_, c)| c.name.is_empty()) {
            camera.name = format!("camera {}", i + 1);
        }
    }

    /// Files that cannot carry lights, or carry none, get the default sky.
    fn add_sky(&mut self) {
        let emissive =
            |o: &Object| self.materials[o.material as usize].emission.is_some_and(|e| !e.radiance.is_black());
        if self.sky_if_unlit && self.lights.is_empty() && !self.objects.iter().any(emissive) {
            self.light("sky", super::builtin::default_sky());
            self.say(
                Level::Note,
                "",
                "no light in the file: lit by the default sky (`environment` to choose)",
            );
        }
    }

    fn mesh_uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.meshes.len()];
        for object in &self.objects {
            if let Body::Mesh(m) = object.body {
                uses[m as usize] += 1;
            }
        }
        uses
    }
}

/// Gives mesh `m` tangents, or a copy of it if it has others; the mesh that has them.
fn with_tangents(meshes: &mut Vec<Mesh>, m: u32, tangents: Tangents) -> u32 {
    let mesh = &mut meshes[m as usize];
    if mesh.tangents.is_none() {
        mesh.tangents = Some(tangents);
        return m;
    }
    let copy = Mesh { tangents: Some(tangents), ..mesh.clone() };
    meshes.push(copy);
    meshes.len() as u32 - 1
}

fn material_place(i: usize, m: &Material) -> String {
    if m.name.is_empty() { format!("material {i}") } else { format!("material \"{}\"", m.name) }
}

/// Takes every number into [0, 1], NaN to 0; says whether one had to be.
fn tame_all(numbers: &mut [f32]) -> bool {
    numbers.iter_mut().fold(false, |any, x| super::material::tame(x) | any)
}

/// Leaves out triangles with a corner that is not finite; returns how many. Unused vertices become the origin.
fn drop_unusable(triangles: &mut Triangles) -> usize {
    let finite = |v: &[f32; 3]| v.iter().all(|c| c.is_finite());
    if triangles.vertices.iter().all(finite) {
        return 0;
    }
    let before = triangles.indices.len();
    let vertices = &mut triangles.vertices;
    triangles.indices.retain(|t| t.iter().all(|v| finite(&vertices[*v as usize])));
    vertices.iter_mut().filter(|v| !finite(v)).for_each(|v| *v = [0.0; 3]);
    before - triangles.indices.len()
}

fn shape_fault(shape: &Shape) -> Option<String> {
    let (numbers, radius, length): (Vec<f32>, f32, f32) = match shape {
        Shape::Sphere { center, radius } => (center.to_vec(), *radius, 1.0),
        Shape::Disk { center, normal, radius } => {
            ([*center, *normal].concat(), *radius, Vec3::from(*normal).length())
        }
        Shape::Cylinder { p, q, radius } => {
            ([*p, *q].concat(), *radius, (Vec3::from(*q) - Vec3::from(*p)).length())
        }
    };
    if !numbers.iter().all(|x| x.is_finite()) {
        return Some(format!("{shape:?}: a coordinate is not finite"));
    }
    if !(radius > 0.0 && radius.is_finite() && length > 0.0) {
        return Some(format!("{shape:?}: radius, normal and axis need a length above 0"));
    }
    None
}
