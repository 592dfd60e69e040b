//! Light from all around as a picture.

use antumbra::light::{Environment, Light};
use antumbra::texture::{Image, Texels};
use antumbra_math::{World, real};

use super::paint;

/// The environments of a scene.
pub(super) fn all(lights: &[(String, Light)]) -> impl Iterator<Item = &Environment> {
    lights.iter().filter_map(|(_, light)| match light {
        Light::Environment(e) => Some(e),
        _ => None,
    })
}

/// Texels of one radiance: so few that no one minds.
const EVEN: [u32; 2] = [4, 2];

/// The sum of environments as a lat-long picture in the axes of the world, as large as the largest.
pub(super) fn sum(all: &[&Environment]) -> Result<Image, String> {
    let sizes = all.iter().filter_map(|e| e.picture.as_ref()).map(|p| [p.image().width, p.image().height]);
    let [width, height] = sizes.max().unwrap_or(EVEN);
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let d = direction([width, height], x as f32 + 0.5, y as f32 + 0.5);
        let light = all.iter().map(|e| e.radiance_from(d).0);
        texels.push(light.fold([0.0f32; 3], |sum, l| std::array::from_fn(|c| sum[c] + l[c])));
    }
    Image::new(width, height, Texels::Float(texels)).ok_or_else(|| "it has no texels".into())
}

/// The same as an EXR.
pub(super) fn exr(all: &[&Environment]) -> Result<Vec<u8>, String> {
    let image = sum(all)?;
    paint::exr([image.width, image.height], &|x, y| image.texel(x, y))
}

/// d = (sin φ sin θ, cos θ, −cos φ sin θ) at a place in texels.
fn direction([width, height]: [u32; 2], x: f32, y: f32) -> World {
    let (phi, theta) = (2.0 * real::PI * x / width as f32, real::PI * y / height as f32);
    let sin = real::sinf(theta);
    World::new(real::sinf(phi) * sin, real::cosf(theta), -real::cosf(phi) * sin)
}
