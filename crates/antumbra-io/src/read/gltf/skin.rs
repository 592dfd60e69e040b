//! Skins as their joints stand: v′ = Σ wⱼ · (world ← joint)ⱼ · (joint ← mesh)ⱼ · v (glTF 2.0, section 3.7.3).

use antumbra_math::{DMat3, DVec3, Transform};

use super::Reader;
use super::accessor::Pick;
use super::document::Primitive;
use super::primitive::of;
use crate::error::ReadError;

impl Reader<'_> {
    /// The index of a skin that can be used; otherwise the mesh is drawn as it was modelled, with a warning.
    pub(super) fn skin(&mut self, index: usize) -> Option<usize> {
        let skin = self.doc.skins.get(index);
        let stands = |joint: &usize| self.world.get(*joint).is_some_and(Option::is_some);
        if skin.is_some_and(|s| s.joints.iter().all(stands)) {
            return Some(index);
        }
        let text = "does not have all its joints in the scene: its meshes are drawn unbent";
        self.said.warn(format!("skin {index}"), text);
        None
    }

    /// World ← mesh of each joint.
    fn joints(&self, index: usize) -> Result<Vec<Transform>, ReadError> {
        let skin = &self.doc.skins[index];
        let worlds = skin.joints.iter().map(|j| self.world[*j].unwrap_or(Transform::IDENTITY));
        let Some(accessor) = skin.inverse_bind_matrices else { return Ok(worlds.collect()) };
        let inverse =
            self.accessors.floats::<16>(accessor, None).map_err(|e| of(e, "inverseBindMatrices"))?;
        if inverse.len() < skin.joints.len() {
            let what = format!("has {} matrices for {} joints", inverse.len(), skin.joints.len());
            return Err(ReadError::new(format!("accessor {accessor} of skin {index}"), what));
        }
        let bind = |m: &[f32; 16]| Transform::from_columns(&m.map(f64::from));
        Ok(worlds.zip(&inverse).map(|(world, m)| world.after(&bind(m))).collect())
    }

    /// Moves vertices and normals into the world.
    pub(super) fn bend(
        &mut self,
        p: &Primitive,
        skin: usize,
        count: u64,
        pick: Pick,
        vertices: &mut [[f32; 3]],
        mut normals: Option<&mut [[f32; 3]]>,
    ) -> Result<(), ReadError> {
        let joints = self.joints(skin)?;
        let mut shares =
            vec![(Transform { linear: DMat3::ZERO, translation: DVec3::ZERO }, 0.0); vertices.len()];
        for set in 0.. {
            let (joint, weight) = (format!("JOINTS_{set}"), format!("WEIGHTS_{set}"));
            let Some(index) = self.attribute(p, &joint, count, |r, i| r.accessors.integers::<4>(i, pick))?
            else {
                break;
            };
            let Some(weight) = self.attribute(p, &weight, count, |r, i| r.accessors.floats::<4>(i, pick))?
            else {
                break;
            };
            for ((sum, total), (index, weight)) in shares.iter_mut().zip(index.iter().zip(&weight)) {
                for (j, w) in index.iter().zip(weight).filter(|(_, w)| **w != 0.0) {
                    let Some(m) = joints.get(*j as usize) else {
                        let what = format!("names joint {j} of {}", joints.len());
                        return Err(ReadError::new(joint, what));
                    };
                    let w = f64::from(*w);
                    sum.linear += m.linear * w;
                    sum.translation += m.translation * w;
                    *total += w;
                }
            }
        }
        for (i, (sum, total)) in shares.iter().enumerate().filter(|(_, s)| s.1 != 0.0) {
            // Weights of few bits do not add up to 1 exactly.
            let m = Transform { linear: sum.linear * (1.0 / total), translation: sum.translation / *total };
            vertices[i] = m.point(DVec3::from_array(vertices[i].map(f64::from))).as_vec3().to_array();
            if let Some(normals) = &mut normals {
                let n = m.normal(DVec3::from_array(normals[i].map(f64::from)));
                normals[i] = n.normalize_or_zero().as_vec3().to_array();
            }
        }
        Ok(())
    }
}
