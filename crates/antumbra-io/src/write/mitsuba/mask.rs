//! Surfaces that let a part of the rays pass.

use antumbra::scene::{Alpha, Material};
use antumbra::texture::Texture;

use super::Writer;
use super::bsdf::Dress;
use super::xml::Element;
use crate::write::paint::{alike, has_alpha};

/// The most texels of a picture of holes: large pictures need no steps within a texel.
const MOST: u64 = 1 << 22;

impl Writer<'_, '_> {
    /// `bsdf`, where the material's alpha stops rays.
    pub(super) fn masked(&mut self, m: &Material, dress: Dress, bsdf: Element) -> Result<Element, String> {
        let mask = |opacity: Element, bsdf: Element| Element::plugin("bsdf", "mask").add(opacity).add(bsdf);
        let cutoff = match m.alpha {
            Alpha::Opaque => return Ok(bsdf),
            Alpha::Mask { cutoff } => Some(cutoff),
            Alpha::Blend => None,
        };
        let textured = dress != Dress::Plain;
        let color = m.color.filter(|_| textured).map(|id| self.job.texture(id));
        let cover = m.cover.filter(|_| textured).map(|id| self.job.texture(id));
        let color = color.filter(|t| has_alpha(&t.image));
        let Some(on) = color.or(cover) else {
            let even = cutoff.map_or(m.opacity, |cutoff| f32::from(u8::from(m.opacity >= cutoff)));
            return Ok(if even == 1.0 { bsdf } else { mask(self.measure("opacity", even, None)?, bsdf) });
        };
        let cover = cover.filter(|cover| alike(cover, on));
        if m.cover.is_some() && cover.is_none() {
            let what =
                "its alpha lies on it in another way than its colour: only that of its colour is written";
            self.warn(format!("material \"{}\"", m.name), what);
        }
        let opacity = match cutoff {
            None => {
                let whole = [on.image.width, on.image.height];
                // One alpha of eight bits stays what it is.
                let eight_bits = m.opacity == 1.0 && cover.is_none();
                let texel = |x, y| {
                    let a = color.map_or(1.0, |c| c.image.texel(x, y)[3]);
                    [m.opacity * a * cover.map_or(1.0, |c| c.image.texel(x, y)[0]); 4]
                };
                let file = self.made(whole, eight_bits, &texel)?;
                self.bitmap("opacity", on, &file)
            }
            Some(cutoff) => self.cut(m, on, [color, cover], cutoff)?,
        };
        Ok(mask(opacity, bsdf))
    }

    /// A picture of holes: 0 where alpha is below the cutoff, 1 elsewhere, in steps of a texel or of a part of it.
    fn cut(
        &mut self,
        m: &Material,
        on: &Texture,
        [color, cover]: [Option<&Texture>; 2],
        cutoff: f32,
    ) -> Result<Element, String> {
        let texels = u64::from(on.image.width) * u64::from(on.image.height);
        let steps =
            [4, 2].into_iter().find(|n| !on.nearest && texels * u64::from(n * n) <= MOST).unwrap_or(1);
        if !on.nearest {
            let what = "has holes with a cutoff: written as a picture of holes, whose edges have small steps";
            self.warn(format!("material \"{}\"", m.name), what);
        }
        let [width, height] = [on.image.width * steps, on.image.height * steps];
        // The picture alone, not its place on the surface.
        let straight = |t: &Texture| Texture { map: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0], ..t.clone() };
        let (color, cover) = (color.map(straight), cover.map(straight));
        let texel = |x: u32, y: u32| {
            let uv = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
            let alpha =
                color.as_ref().map_or(1.0, |t| t.at(uv)[3]) * cover.as_ref().map_or(1.0, |t| t.at(uv)[0]);
            [f32::from(u8::from(m.opacity * alpha >= cutoff)); 4]
        };
        let file = self.made([width, height], true, &texel)?;
        Ok(self.bitmap("opacity", &Texture { nearest: true, ..on.clone() }, &file))
    }
}
