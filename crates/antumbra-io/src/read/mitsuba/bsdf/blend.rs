//! blendbsdf, and what wraps a blend.

use std::collections::HashMap;

use antumbra::scene::{Alpha, Material, MaterialId, Surface};

use super::super::Reader;
use super::super::document::Element;
use super::super::texture::{Paint, number};
use crate::error::ReadError;

/// (1 − weight) of the first bsdf, weight of the second.
pub(super) fn blendbsdf<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let [first, second] = reader.plugins(element, "bsdf")?[..] else {
        return Err(element.at.error(format!("{} needs two bsdfs in it", element.words())));
    };
    let (first, second) = (reader.bsdf(first)?, reader.bsdf(second)?);
    let attributes = [first, second].map(|id| reader.bsdfs.attribute(id));
    reader.color_both(element, attributes);
    let open = [first, second].map(|id| opacity(&reader.scene.materials[id as usize]));
    let weight = reader.paint(element, "weight", 0.5)?;
    match (weight, open) {
        (Paint::Plain(weight), [Some(a), Some(b)]) => Ok(covering(first, second, number(weight), [a, b])),
        (weight, open) => {
            if open != [Some(1.0); 2] {
                let what = format!("a mask in {} is not read: drawn without holes", element.words());
                reader.said.warn(element.at.words(), what);
            }
            Ok(match weight {
                Paint::Plain(weight) => Material::blend(first, second, number(weight)),
                Paint::Texture(weight) => {
                    let blend = Some(reader.luminance(weight));
                    Material { blend, ..Material::blend(first, second, 1.0) }
                }
            })
        }
    }
}

impl Reader<'_> {
    /// Takes the attribute of one of two bsdfs for both: a mesh has one set of colours.
    pub(super) fn color_both(&mut self, element: &Element, [one, other]: [Option<String>; 2]) {
        if one != other {
            let what = format!("colours of a mesh on one bsdf of {}: they colour both", element.words());
            self.said.warn(element.at.words(), what);
        }
        self.bsdfs.attribute = one.or(other);
    }
}

/// A blend whose parts cover the shares a and b: rays that meet it meet the second in w·b of all cases, out of
/// (1 − w)·a + w·b.
fn covering(first: MaterialId, second: MaterialId, weight: f32, [a, b]: [f32; 2]) -> Material {
    let covered = (1.0 - weight) * a + weight * b;
    if covered == 1.0 || (a, b) == (1.0, 1.0) {
        return Material::blend(first, second, weight);
    }
    let weight = if covered > 0.0 { weight * b / covered } else { 0.0 };
    Material { alpha: Alpha::Blend, opacity: covered, ..Material::blend(first, second, weight) }
}

/// The share of rays that a material stops; `None` where a texture says.
fn opacity(material: &Material) -> Option<f32> {
    match material.alpha {
        Alpha::Opaque => Some(1.0),
        _ => material.cover.is_none().then_some(material.opacity),
    }
}

impl Reader<'_> {
    /// `material` changed: of a blend, copies of all that it blends, and of its back.
    pub(super) fn each_part(
        &mut self,
        material: Material,
        change: &dyn Fn(Material) -> Material,
    ) -> Material {
        self.changed(material, change, &mut HashMap::new())
    }

    fn changed(
        &mut self,
        mut material: Material,
        change: &dyn Fn(Material) -> Material,
        done: &mut HashMap<MaterialId, MaterialId>,
    ) -> Material {
        let mut parts: Vec<&mut MaterialId> = material.back.iter_mut().collect();
        if let Surface::Blend { first, second, .. } = &mut material.surface {
            parts.extend([first, second]);
        }
        for part in parts {
            *part = match done.get(part) {
                Some(copy) => *copy,
                None => {
                    let copy = self.scene.materials[*part as usize].clone();
                    let copy = self.changed(copy, change, done);
                    let id = self.scene.material(copy);
                    done.insert(*part, id);
                    id
                }
            };
        }
        change(material)
    }
}
