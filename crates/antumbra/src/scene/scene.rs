//! The checked, immutable scene that every sensor, estimator and query looks at.

use std::sync::Arc;

use antumbra_math::{Rgb, Transform, Vec3, World as Direction, hash};
use antumbra_trace::{
    Bits, Hits, NO_PRIM, Passes, PrimId, Segments, SimdLevel, Triangles, Visibility, World,
};

use super::{Alpha, Body, Camera, Material, Message, Tangents};
use crate::light::{Along, Light, LightId};
use crate::texture::Texture;

/// A mesh as the tree and the shading share it.
#[derive(Clone, Debug)]
pub struct SceneMesh {
    /// Its name; may be empty.
    pub name: String,
    /// Positions and indices.
    pub triangles: Arc<Triangles>,
    /// Shading normals, one a vertex.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Texture coordinates, sets 0 and 1.
    pub uvs: [Option<Vec<[f32; 2]>>; 2],
    /// Where u grows.
    pub tangents: Option<Tangents>,
    /// Linear colours and alpha.
    pub colors: Option<Vec<[f32; 4]>>,
}

/// Which light a primitive of an object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Emits {
    /// None.
    Nothing,
    /// The whole object is this light.
    One(LightId),
    /// An emissive object: each run of so many of its primitives is a light, the first one this.
    Each(LightId, u32),
}

/// An object in its place; instance i of the world is object i.
#[derive(Clone, Debug)]
pub struct Placed {
    /// Its name; may be empty.
    pub name: String,
    /// What it is made of (meshes: index into [`Scene::meshes`]).
    pub body: Body,
    /// Its look.
    pub material: u32,
    /// Object → world, or `None` where the numbers are world numbers.
    pub transform: Option<Transform>,
    /// Its first primitive in the world.
    pub first_prim: PrimId,
    /// Which lights its primitives are.
    pub emits: Emits,
}

/// Names of all lights, and which of them shine.
#[derive(Clone, Debug, Default)]
pub struct LightNames {
    /// Name of each light of the scene; the triangles of an object share one.
    pub names: Vec<String>,
    /// Where it stands among those that shine, or `u32::MAX`.
    pub slots: Vec<u32>,
}

/// A scene. Cloning is cheap: geometry is shared.
#[derive(Clone)]
pub struct Scene {
    /// What people call it.
    pub name: String,
    /// What its file says of itself.
    pub source: String,
    /// Meshes.
    pub meshes: Arc<Vec<SceneMesh>>,
    /// Objects in their places.
    pub objects: Arc<Vec<Placed>>,
    /// Looks.
    pub materials: Arc<Vec<Material>>,
    /// Textures.
    pub textures: Arc<Vec<Texture>>,
    /// Cameras; the first is the default.
    pub cameras: Vec<Camera>,
    /// Settings that the file asks for, in the words of the table of settings.
    pub suggested: Vec<(&'static str, String)>,
    /// Parameters that the file declares, with their values.
    pub parameters: Vec<(String, String)>,
    /// Notes and warnings.
    pub messages: Vec<Message>,
    pub(super) lights: Arc<Vec<Light>>,
    pub(super) along: Arc<Along>,
    pub(super) light_names: LightNames,
    pub(super) world: Arc<World>,
    pub(super) radius: f32,
    pub(super) has_masks: bool,
}

impl Scene {
    /// The lights that shine.
    #[inline]
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// Which of them lie along a direction.
    #[inline]
    pub fn along(&self) -> &Along {
        &self.along
    }

    /// Some surface is alpha-masked.
    #[inline]
    pub fn has_masks(&self) -> bool {
        self.has_masks
    }

    /// Name of each light of the scene and whether it shines.
    pub fn light_names(&self) -> &LightNames {
        &self.light_names
    }

    /// The tree.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Radius of a sphere about everything with a surface (1 if there is nothing).
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Lower and upper corner of everything with a surface; `None` if there is nothing.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let (low, high) = self.world.bounds();
        (self.world.prim_count() > 0).then(|| [Vec3::from(low), Vec3::from(high)])
    }

    /// Triangles, each instance counted.
    pub fn triangle_count(&self) -> u64 {
        let of = |o: &Placed| match o.body {
            Body::Mesh(m) => self.meshes[m as usize].triangles.indices.len() as u64,
            Body::Shape(_) => 0,
        };
        self.objects.iter().map(of).sum()
    }

    /// The object of a primitive, and which primitive of it.
    #[inline]
    pub fn locate(&self, prim: PrimId) -> (&Placed, u32) {
        // Primitives come from the world's own hits; a foreign number is taken for the first.
        let (instance, local) = self.world.locate(prim).unwrap_or_default();
        (&self.objects[instance as usize], local)
    }

    /// The object of a primitive, by number.
    pub fn object_of(&self, prim: PrimId) -> u32 {
        self.world.locate(prim).map_or(u32::MAX, |(object, _)| object)
    }

    /// The light that a primitive is, if it shines.
    #[inline]
    pub fn light_of(&self, object: &Placed, local: u32) -> Option<LightId> {
        let light = match object.emits {
            Emits::Nothing => return None,
            Emits::One(light) => light,
            Emits::Each(first, run) => first + local / run,
        };
        let slot = self.light_names.slots[light as usize];
        (slot != u32::MAX).then_some(slot)
    }

    /// Light from infinity along `wi`, with the light it comes from.
    pub fn from_infinity(&self, wi: Direction) -> impl Iterator<Item = (LightId, Rgb)> + '_ {
        let met = move |id: &LightId| {
            self.lights[*id as usize].hit(Direction::ZERO, wi).map(|hit| (*id, hit.radiance))
        };
        self.along.infinite().iter().filter_map(met)
    }

    /// Light that every light would send to `p` along `wi`, were nothing in the way.
    pub fn from_everywhere(&self, p: Vec3, wi: Direction) -> impl Iterator<Item = (LightId, Rgb)> + '_ {
        let met = move |(i, l): (usize, &Light)| l.hit(p, wi).map(|h| (i as LightId, h.radiance));
        self.lights.iter().enumerate().filter_map(met)
    }

    /// The same scene asked at another SIMD level, with the same answers (copies the tree).
    pub fn at_level(&self, level: SimdLevel) -> Scene {
        Scene { world: Arc::new(World::clone(&self.world).with_level(level)), ..self.clone() }
    }

    /// The names of its lights, each once.
    pub fn distinct_light_names(&self) -> Vec<&str> {
        let mut seen = std::collections::HashSet::new();
        self.light_names.names.iter().map(String::as_str).filter(|name| seen.insert(*name)).collect()
    }

    /// The same scene with only the lights of these names; `Err` = a name that no light has.
    pub fn only_lights(&self, names: &[String]) -> Result<Scene, String> {
        if let Some(unknown) = names.iter().find(|n| !self.light_names.names.contains(n)) {
            return Err(unknown.clone());
        }
        Ok(self.with_lights(|name, _| names.iter().any(|n| n == name), Vec::new()))
    }

    /// The same scene with other light from all around, each with its name; none: without.
    pub fn under(&self, environment: Vec<(String, Light)>) -> Scene {
        self.with_lights(|_, light| !light.is_environment(), environment)
    }

    fn with_lights(&self, keep: impl Fn(&str, &Light) -> bool, more: Vec<(String, Light)>) -> Scene {
        let mut kept = Vec::new();
        let mut names = self.light_names.clone();
        for (name, slot) in names.names.iter().zip(&mut names.slots) {
            if *slot != u32::MAX {
                let light = &self.lights[*slot as usize];
                *slot = u32::MAX;
                if keep(name, light) {
                    *slot = kept.len() as u32;
                    kept.push(light.clone());
                }
            }
        }
        for (name, light) in more {
            names.names.push(name);
            names.slots.push(kept.len() as u32);
            kept.push(light);
        }
        let along = Arc::new(Along::new(&kept));
        Scene { lights: Arc::new(kept), along, light_names: names, ..self.clone() }
    }

    /// Which segments are free: alpha masks as the file says, or everything opaque.
    pub fn visibility(&self, opaque: bool) -> SceneVisibility<'_> {
        SceneVisibility { scene: self, opaque: opaque || !self.has_masks }
    }

    /// The share of rays that a light's own surface stops at the point `p` of `prim`: what it emits there counts as much.
    /// 1 but for alpha masks.
    pub fn coverage(&self, prim: PrimId, p: Vec3) -> f32 {
        if prim == NO_PRIM || !self.has_masks {
            return 1.0;
        }
        let (object, local) = self.locate(prim);
        let how = self.materials[object.material as usize].alpha;
        if how == Alpha::Opaque {
            return 1.0;
        }
        let alpha = self.alpha(object, local, self.weights_at(object, local, p));
        match how {
            Alpha::Mask { cutoff } => f32::from(u8::from(alpha >= cutoff)),
            _ => alpha,
        }
    }

    /// Weights of the second and third corner at a point of a triangle's plane, in world space.
    fn weights_at(&self, object: &Placed, local: u32, p: Vec3) -> [f32; 2] {
        let Body::Mesh(mesh) = object.body else { return [0.0; 2] };
        let corners = self.meshes[mesh as usize].triangles.corners(local as usize);
        let placed = |c: [f32; 3]| {
            let c = Vec3::from(c).as_dvec3();
            object.transform.map_or(c, |t| t.point(c))
        };
        let [a, b, c] = corners.map(placed);
        let (e, f, d) = (b - a, c - a, p.as_dvec3() - a);
        let n = e.cross(f);
        let scale = 1.0 / n.length_squared();
        [d.cross(f).dot(n) * scale, e.cross(d).dot(n) * scale].map(|w| w.clamp(0.0, 1.0) as f32)
    }

    /// Alpha of a masked surface at `uv`, in [0, 1].
    fn alpha(&self, object: &Placed, local: u32, uv: [f32; 2]) -> f32 {
        let material = &self.materials[object.material as usize];
        let Body::Mesh(mesh) = object.body else { return material.opacity };
        let mesh = &self.meshes[mesh as usize];
        let color = mesh.color_at(local, uv).map_or(1.0, |c| c[3]);
        let texture = material.color.map(|t| &self.textures[t as usize]);
        let texel = texture.map_or(1.0, |t| t.at(mesh.uv_at(t.uv_set, local, uv))[3]);
        let cover = material.cover.map(|t| &self.textures[t as usize]);
        let cover = cover.map_or(1.0, |t| t.at(mesh.uv_at(t.uv_set, local, uv))[0]);
        material.opacity * color * texel * cover
    }
}

impl SceneMesh {
    /// Σ weight · attribute over the corners of a triangle.
    #[inline]
    pub(super) fn interpolate<const N: usize>(
        &self,
        values: &[[f32; N]],
        local: u32,
        uv: [f32; 2],
    ) -> [f32; N] {
        let [a, b, c] = self.triangles.indices[local as usize].map(|v| values[v as usize]);
        std::array::from_fn(|k| a[k] * (1.0 - uv[0] - uv[1]) + b[k] * uv[0] + c[k] * uv[1])
    }

    /// Texture coordinates at a point; (0, 0) where the mesh has none.
    #[inline]
    pub(super) fn uv_at(&self, set: u8, local: u32, uv: [f32; 2]) -> [f32; 2] {
        let set = self.uvs.get(set as usize).and_then(Option::as_ref);
        set.map_or([0.0; 2], |values| self.interpolate(values, local, uv))
    }

    /// Vertex colour at a point.
    #[inline]
    pub(super) fn color_at(&self, local: u32, uv: [f32; 2]) -> Option<[f32; 4]> {
        self.colors.as_ref().map(|values| self.interpolate(values, local, uv))
    }
}

/// MASK by its cutoff; BLEND passes with probability 1 − α by a hash of (ray number, primitive).
impl Passes for Scene {
    fn passes(&self, number: u32, prim: PrimId, uv: [f32; 2]) -> bool {
        let (object, local) = self.locate(prim);
        let alpha = self.alpha(object, local, uv);
        match self.materials[object.material as usize].alpha {
            Alpha::Opaque => false,
            Alpha::Mask { cutoff } => alpha < cutoff,
            Alpha::Blend => hash::unit_f32(hash::hash2(number, prim)) >= alpha,
        }
    }
}

/// The tree with the scene's alpha masks.
pub struct SceneVisibility<'a> {
    scene: &'a Scene,
    opaque: bool,
}

impl Visibility for SceneVisibility<'_> {
    fn occluded(&self, segments: Segments<'_>, out: &mut Bits) {
        if self.opaque {
            self.scene.world.occluded(segments, out);
        } else {
            self.scene.world.with_passes(self.scene).occluded(segments, out);
        }
    }

    fn nearest(&self, rays: Segments<'_>, out: &mut Hits) {
        if self.opaque {
            self.scene.world.nearest(rays, out);
        } else {
            self.scene.world.with_passes(self.scene).nearest(rays, out);
        }
    }
}
