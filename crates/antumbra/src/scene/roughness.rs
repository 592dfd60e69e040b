//! Roughness that varies over a surface: a texture, and what facets of every width have in common with it.

use std::sync::Arc;

use super::{Surface, TextureId};
use crate::texture::Texture;

/// One number of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Channel {
    /// The picture, plain numbers.
    pub texture: TextureId,
    /// Which component of its texels: 0 red, 1 green, 2 blue, 3 alpha.
    pub component: u8,
}

/// Roughness by texture: the factor of a metallic-roughness surface's roughness, or of the α of facets.
#[derive(Clone, Debug, PartialEq)]
pub struct Roughness {
    /// The factor.
    pub channel: Channel,
    /// α goes with its square: the texture holds perceptual roughness. (Metallic-roughness surfaces square by themselves.)
    pub squared: bool,
    /// The surface with facets of α times x², x even from 0 to 1: how much light facets keep varies slowly with their
    /// width and takes long to find out.
    rungs: Arc<[Surface]>,
}

/// Widths at which a surface is kept. Between two of them what a coat reflects is off by less than 0.005.
const RUNGS: usize = 17;

impl Roughness {
    /// By one component of a texture.
    pub fn new(channel: Channel, squared: bool) -> Roughness {
        Roughness { channel, squared, rungs: Arc::from([]) }
    }

    /// The same, ready for a surface: with it at every width that the texture holds.
    pub(super) fn of(self, surface: &Surface, texture: &Texture) -> Roughness {
        let Some(facets) = surface.facets() else { return self };
        let (least, most) = texture.image.range(self.channel.component);
        let [low, high] = [least, most].map(|texel| self.place(texel).0);
        let mut made: Vec<Surface> = Vec::with_capacity(RUNGS);
        for k in 0..RUNGS {
            let x = k as f32;
            // Below and beyond stand copies that nobody asks for.
            let asked = x > low - 1.0 && x < high + 1.0;
            let by = x / (RUNGS - 1) as f32;
            let rung = if asked { surface.with_facets(facets.scaled(by * by)) } else { *surface };
            made.push(rung);
        }
        Roughness { rungs: made.into(), ..self }
    }

    /// Which rung a texel asks for, and the factor of α.
    #[inline]
    fn place(&self, texel: f32) -> (f32, f32) {
        let texel = if texel > 0.0 { texel.min(1.0) } else { 0.0 };
        let (root, by) = if self.squared { (texel, texel * texel) } else { (texel.sqrt(), texel) };
        (root * (RUNGS - 1) as f32, by)
    }

    /// A surface with facets where the texture holds `texel`; `None` for a surface without facets.
    #[inline]
    pub(super) fn at(&self, surface: &Surface, texel: f32) -> Option<Surface> {
        let facets = surface.facets().filter(|_| !self.rungs.is_empty())?;
        let (x, by) = self.place(texel);
        let k = (x as usize).min(RUNGS - 2);
        Some(self.rungs[k].between(&self.rungs[k + 1], x - k as f32, facets.scaled(by)))
    }
}
