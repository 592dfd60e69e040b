//! A number that changes with anything that is seen: geometry, places, looks, textures, lights, cameras.

use antumbra_math::hash::fnv1a;

use super::{Emits, Scene, SceneMesh};
use crate::texture::{Image, Texels};

impl Scene {
    /// The scene's hash, as pictures carry it.
    pub fn content_hash(&self) -> u64 {
        let text = |x: &dyn std::fmt::Debug| fnv1a(format!("{x:?}").as_bytes());
        let mut all = Sum(0);
        self.meshes.iter().for_each(|mesh| mesh_hash(mesh, &mut all));
        self.objects.iter().for_each(|o| all.take(text(&(&o.body, o.transform, o.material))));
        self.materials.iter().for_each(|m| all.take(text(m)));
        for t in self.textures.iter() {
            all.take(text(&(t.uv_set, t.wrap, t.nearest, t.map)));
            all.take(image_hash(&t.image));
        }
        self.lights_hash(&mut all);
        self.cameras.iter().for_each(|c| all.take(text(c)));
        all.0
    }

    /// Which lights shine, and what those are that are no surface of an object. They print short: pictures of the sky as
    /// their own hash.
    fn lights_hash(&self, all: &mut Sum) {
        let mut of_objects = vec![false; self.light_names.slots.len()];
        for object in self.objects.iter() {
            if let Emits::Each(first, run) = object.emits {
                let count = object.primitives(&self.meshes) / run;
                of_objects[first as usize..(first + count) as usize].fill(true);
            }
        }
        for (slot, of_object) in self.light_names.slots.iter().zip(of_objects) {
            all.take(u64::from(*slot));
            if let (Some(light), false) = (self.lights.get(*slot as usize), of_object) {
                all.take(fnv1a(format!("{light:?}").as_bytes()));
            }
        }
    }
}

/// A running hash of words.
struct Sum(u64);

impl Sum {
    fn take(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn floats(&mut self, values: &[f32]) {
        values.iter().for_each(|v| self.take(u64::from(v.to_bits())));
    }
}

fn mesh_hash(mesh: &SceneMesh, all: &mut Sum) {
    all.floats(mesh.triangles.vertices.as_flattened());
    mesh.triangles.indices.as_flattened().iter().for_each(|i| all.take(u64::from(*i)));
    for values in [&mesh.uvs[0], &mesh.uvs[1]].into_iter().flatten() {
        all.floats(values.as_flattened());
    }
    mesh.normals.iter().for_each(|n| all.floats(n.as_flattened()));
    mesh.tangents.iter().for_each(|t| all.floats(t.numbers()));
    mesh.colors.iter().for_each(|c| all.floats(c.as_flattened()));
}

/// The hash of a picture's texels.
fn image_hash(image: &Image) -> u64 {
    let mut all = Sum(u64::from(image.width));
    match &image.texels {
        Texels::Srgb8(t) | Texels::Linear8(t) => {
            t.iter().for_each(|t| all.take(u64::from(u32::from_le_bytes(*t))))
        }
        Texels::Float(t) => all.floats(t.as_flattened()),
    }
    all.0
}
