//! The finished scene as it grows: objects in their places, their lights, and at last the tree.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra_math::{DVec3, Rgb, Transform, Vec3};
use antumbra_trace::{BuildOptions, Geometry, Instance, Pool, Triangles, World};

use super::scene::{Emits, LightNames, Placed, Scene, SceneMesh};
use super::{Alpha, Body, Material, Mesh, Object, SceneBuilder, SceneError, emissive};
use crate::light::{Along, Light, LightSurface};

/// Copies of a mesh are written out as world triangles up to this many triangles in all; beyond, they are instances.
const FLATTEN_TRIANGLES: usize = 1 << 18;

/// The most lights that a scene may have.
const MOST_LIGHTS: usize = 1 << 24;

/// What the finished scene is made of, as it grows.
#[derive(Default)]
pub(super) struct Parts {
    meshes: Vec<SceneMesh>,
    /// Builder's mesh → scene's mesh, where it is kept as it is.
    kept: HashMap<u32, u32>,
    objects: Vec<Placed>,
    lights: Vec<Light>,
    names: Vec<String>,
    /// Lights as people count them: an emissive object is one.
    counted: u32,
}

impl Parts {
    /// Puts an object into the world: by its own numbers, written out, or as an instance.
    pub(super) fn place(
        &mut self,
        object: Object,
        meshes: &mut [Option<Mesh>],
        uses: &[usize],
    ) -> Result<(), String> {
        let identity = object.transform == Transform::IDENTITY;
        let (body, transform) = match object.body {
            Body::Shape(_) => (object.body, None),
            Body::Mesh(m) => {
                let triangles = match self.kept.get(&m) {
                    Some(kept) => self.meshes[*kept as usize].triangles.indices.len(),
                    None => meshes[m as usize].as_ref().map_or(0, |mesh| mesh.triangles.indices.len()),
                };
                if triangles == 0 {
                    return Ok(());
                }
                let few = uses[m as usize] == 1 || uses[m as usize] * triangles <= FLATTEN_TRIANGLES;
                if few && !identity {
                    let moved = self.source(m, meshes, uses).moved(&object.transform);
                    let mesh = moved.ok_or("its coordinates in the world are too large")?;
                    (Body::Mesh(self.add_mesh(mesh)), None)
                } else {
                    let kept = self.keep(m, meshes);
                    (Body::Mesh(kept), (!identity).then_some(object.transform))
                }
            }
        };
        let Object { name, material, .. } = object;
        self.objects.push(Placed { name, body, material, transform, first_prim: 0, emits: Emits::Nothing });
        Ok(())
    }

    /// The mesh to write out: given away at its only use, else shared.
    fn source(&mut self, m: u32, meshes: &mut [Option<Mesh>], uses: &[usize]) -> SceneMesh {
        match meshes[m as usize].take() {
            Some(mesh) if uses[m as usize] == 1 => mesh.into(),
            Some(mesh) => {
                let copy = mesh.clone();
                meshes[m as usize] = Some(mesh);
                copy.into()
            }
            None => self.meshes[self.kept[&m] as usize].clone(),
        }
    }

    fn keep(&mut self, m: u32, meshes: &mut [Option<Mesh>]) -> u32 {
        if let Some(kept) = self.kept.get(&m) {
            return *kept;
        }
        let mesh = meshes[m as usize].take().unwrap_or_default();
        let id = self.add_mesh(mesh.into());
        self.kept.insert(m, id);
        id
    }

    fn add_mesh(&mut self, mesh: SceneMesh) -> u32 {
        self.meshes.push(mesh);
        self.meshes.len() as u32 - 1
    }

    /// The name of the next light: its own, or "light 2" for a second one without.
    fn light_name(&mut self, own: &str) -> String {
        self.counted += 1;
        if own.is_empty() { format!("light {}", self.counted) } else { own.into() }
    }

    /// A light, with the black surface that an area light brings.
    pub(super) fn add_light(&mut self, name: &str, light: Light, materials: &mut Vec<Material>) {
        let name = self.light_name(name);
        if let Some(surface) = light.surface() {
            materials.push(Material::diffuse(Rgb::BLACK).named(&name));
            let material = materials.len() as u32 - 1;
            let body = match surface {
                LightSurface::Shape(shape) => Body::Shape(shape),
                LightSurface::Triangles(triangles) => {
                    let vertices = triangles.iter().flatten().copied().collect();
                    let indices =
                        (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
                    Body::Mesh(self.add_mesh(
                        Mesh { triangles: Triangles { vertices, indices }, ..Mesh::default() }.into(),
                    ))
                }
            };
            let emits = Emits::One(self.lights.len() as u32);
            self.objects.push(Placed {
                name: name.clone(),
                body,
                material,
                transform: None,
                first_prim: 0,
                emits,
            });
        }
        self.lights.push(light);
        self.names.push(name);
    }

    /// Every triangle (or shape) of an emissive object is a light, or every two triangles that are a rectangle.
    pub(super) fn add_emissive_objects(&mut self, materials: &[Material]) -> Result<(), SceneError> {
        for i in 0..self.objects.len() {
            let object = &self.objects[i];
            let material = &materials[object.material as usize];
            let Some(emission) = material.emission.filter(|e| !e.radiance.is_black()) else { continue };
            let name = if object.name.is_empty() { material.name.clone() } else { object.name.clone() };
            let lights = emissive::lights(object, &self.meshes, emission);
            let run = object.primitives(&self.meshes) / lights.len().max(1) as u32;
            if self.lights.len() + lights.len() > MOST_LIGHTS {
                let what = format!("more than {MOST_LIGHTS} emissive triangles in the scene");
                return Err(SceneError::new(format!("object \"{name}\""), what, "make fewer surfaces emit"));
            }
            if lights.is_empty() {
                continue;
            }
            self.objects[i].emits = Emits::Each(self.lights.len() as u32, run);
            let name = self.light_name(&name);
            self.names.extend(std::iter::repeat_n(name, lights.len()));
            self.lights.extend(lights);
        }
        Ok(())
    }

    /// Builds the tree and joins everything.
    pub(super) fn finish(mut self, builder: SceneBuilder, pool: Pool<'_>) -> Result<Scene, SceneError> {
        let mut geometries: Vec<Geometry> =
            self.meshes.iter().map(|m| Geometry::Triangles(Arc::clone(&m.triangles))).collect();
        let mut instances = Vec::with_capacity(self.objects.len());
        let mut next = 0u64;
        for object in &mut self.objects {
            let geometry = match &object.body {
                Body::Mesh(m) => *m,
                Body::Shape(shape) => {
                    geometries.push(Geometry::Shapes(vec![*shape]));
                    geometries.len() as u32 - 1
                }
            };
            object.first_prim = next as u32;
            next += geometries[geometry as usize].len() as u64;
            let masked = builder.materials[object.material as usize].alpha != Alpha::Opaque;
            instances.push(Instance { geometry, transform: object.transform, masked });
        }
        if next >= u64::from(u32::MAX) {
            return Err(SceneError::new("", format!("{next} primitives: at most {} fit", u32::MAX - 1), ""));
        }
        self.tell_lights();
        let world = World::build(geometries, instances, &BuildOptions::default(), pool)
            .map_err(|e| SceneError::new("", e.to_string(), ""))?;
        let radius = radius_of(&world);
        let slots = (0..self.lights.len() as u32).collect();
        Ok(Scene {
            name: builder.name,
            source: builder.source,
            meshes: Arc::new(self.meshes),
            objects: Arc::new(self.objects),
            materials: Arc::new(builder.materials),
            textures: Arc::new(builder.textures),
            cameras: builder.cameras,
            suggested: builder.suggested,
            parameters: builder.parameters,
            messages: builder.messages,
            along: Arc::new(Along::new(&self.lights)),
            lights: Arc::new(self.lights),
            light_names: LightNames { names: self.names, slots },
            has_masks: world.has_masks(),
            world: Arc::new(world),
            radius,
        })
    }

    /// Lights that are surfaces learn which primitives of the world they are.
    fn tell_lights(&mut self) {
        for object in &self.objects {
            match object.emits {
                Emits::Nothing => {}
                Emits::One(light) => self.lights[light as usize].set_first_prim(object.first_prim),
                Emits::Each(first, run) => {
                    for i in (0..object.primitives(&self.meshes)).step_by(run as usize) {
                        self.lights[(first + i / run) as usize].set_first_prim(object.first_prim + i);
                    }
                }
            }
        }
    }
}

impl From<Mesh> for SceneMesh {
    fn from(mesh: Mesh) -> SceneMesh {
        let Mesh { name, triangles, normals, uvs, tangents, colors } = mesh;
        // Files give normals of any length; interpolation asks for length 1.
        let unit = |n: [f32; 3]| DVec3::from(n.map(f64::from)).normalize_or_zero().as_vec3().to_array();
        let normals = normals.map(|normals| normals.into_iter().map(unit).collect());
        SceneMesh { name, triangles: Arc::new(triangles), normals, uvs, tangents, colors }
    }
}

impl SceneMesh {
    /// The mesh in world numbers; `None` if they do not fit f32.
    fn moved(self, transform: &Transform) -> Option<SceneMesh> {
        let mut triangles = Arc::unwrap_or_clone(self.triangles);
        for v in &mut triangles.vertices {
            let moved = transform.point(DVec3::from(v.map(f64::from))).as_vec3();
            if !moved.is_finite() {
                return None;
            }
            *v = moved.to_array();
        }
        if transform.mirrors() {
            // Mirrored triangles turn round; their front stays outside.
            triangles.indices.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let turn = |n: [f32; 3]| {
            transform.normal(DVec3::from(n.map(f64::from))).normalize_or_zero().as_vec3().to_array()
        };
        let normals = self.normals.map(|normals| normals.into_iter().map(turn).collect());
        let along = |[x, y, z, w]: [f32; 4]| {
            let t = transform.vector(DVec3::new(x.into(), y.into(), z.into())).normalize_or_zero().as_vec3();
            [t.x, t.y, t.z, if transform.mirrors() { -w } else { w }]
        };
        let tangents = self.tangents.map(|tangents| tangents.moved(along, transform.mirrors()));
        Some(SceneMesh { triangles: Arc::new(triangles), normals, tangents, ..self })
    }
}

fn radius_of(world: &World) -> f32 {
    if world.prim_count() == 0 {
        return 1.0;
    }
    let (low, high) = world.bounds();
    let half = (Vec3::from(high) * 0.5 - Vec3::from(low) * 0.5).length();
    if half > 0.0 && half.is_finite() { half } else { 1.0 }
}
