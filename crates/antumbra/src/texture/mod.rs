//! What varies over a surface: images and how they are wrapped onto it. Floor 2.

use std::sync::Arc;

use antumbra_math::{Rgb, real};

/// How texels are stored.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// Eight bits, colour components encoded as sRGB, alpha linear.
    Srgb8(Vec<[u8; 4]>),
    /// Eight bits, linear.
    Linear8(Vec<[u8; 4]>),
    /// Linear radiance or reflectance, no alpha.
    Float(Vec<[f32; 3]>),
}

/// A picture, row by row from the top. `texels` has width · height entries, both at least 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// The texels.
    pub texels: Texels,
}

/// What happens beyond [0, 1).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The picture repeats.
    #[default]
    Repeat,
    /// Each second copy is mirrored.
    Mirror,
    /// The border texel goes on.
    Clamp,
}

/// An image on a surface: which coordinates, how wrapped, how turned.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The picture.
    pub image: Arc<Image>,
    /// Which of the mesh's coordinate sets.
    pub uv_set: u8,
    /// Wrapping along u and v.
    pub wrap: [Wrap; 2],
    /// Nearest texel instead of bilinear interpolation.
    pub nearest: bool,
    /// u′ = m0·u + m1·v + m2, v′ = m3·u + m4·v + m5.
    pub map: [f32; 6],
}

impl Image {
    /// An image, if the number of texels is width · height and neither is 0.
    pub fn new(width: u32, height: u32, texels: Texels) -> Option<Image> {
        let n = match &texels {
            Texels::Srgb8(t) | Texels::Linear8(t) => t.len(),
            Texels::Float(t) => t.len(),
        };
        (width > 0 && height > 0 && n as u64 == u64::from(width) * u64::from(height)).then_some(Image {
            width,
            height,
            texels,
        })
    }

    /// Linear colour and alpha of one texel.
    #[inline]
    pub fn texel(&self, x: u32, y: u32) -> [f32; 4] {
        let i = y as usize * self.width as usize + x as usize;
        match &self.texels {
            Texels::Srgb8(t) => {
                let ([r, g, b, a], linear) = (t[i], &SRGB.0);
                [linear[r as usize], linear[g as usize], linear[b as usize], f32::from(a) / 255.0]
            }
            Texels::Linear8(t) => t[i].map(|c| f32::from(c) / 255.0),
            Texels::Float(t) => [t[i][0], t[i][1], t[i][2], 1.0],
        }
    }

    /// The least and the largest of one component (0 to 3) over all texels.
    pub fn range(&self, component: u8) -> (f32, f32) {
        let texels = (0..self.height).flat_map(|y| (0..self.width).map(move |x| self.texel(x, y)));
        let numbers = texels.map(|texel| texel[usize::from(component & 3)]);
        numbers.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    }

    /// Mean linear colour.
    pub fn mean(&self) -> Rgb {
        let mut sum = [0f64; 3];
        for y in 0..self.height {
            for x in 0..self.width {
                let t = self.texel(x, y);
                (0..3).for_each(|c| sum[c] += f64::from(t[c]));
            }
        }
        let n = f64::from(self.width) * f64::from(self.height);
        Rgb(sum.map(|s| (s / n) as f32))
    }
}

impl Texture {
    /// A repeating bilinear texture on coordinate set 0; v runs downwards, as in glTF.
    pub fn new(image: Arc<Image>) -> Texture {
        Texture {
            image,
            uv_set: 0,
            wrap: [Wrap::Repeat; 2],
            nearest: false,
            map: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        }
    }

    /// Linear colour and alpha at (u, v); v = 0 is the top row.
    pub fn at(&self, uv: [f32; 2]) -> [f32; 4] {
        let Some([x, y]) = self.place(uv) else { return self.image.texel(0, 0) };
        if self.nearest {
            let column = wrap(real::floorf(x) as i64, self.image.width, self.wrap[0]);
            let row = wrap(real::floorf(y) as i64, self.image.height, self.wrap[1]);
            return self.image.texel(column, row);
        }
        let ([[t00, t10], [t01, t11]], [fx, fy]) = self.around([x, y]);
        std::array::from_fn(|c| {
            let top = t00[c] * (1.0 - fx) + t10[c] * fx;
            let bottom = t01[c] * (1.0 - fx) + t11[c] * fx;
            top * (1.0 - fy) + bottom * fy
        })
    }

    /// ∂/∂u and ∂/∂v of the bilinear red at (u, v), of the mesh's coordinates.
    pub fn slope(&self, uv: [f32; 2]) -> [f32; 2] {
        let Some(place) = self.place(uv) else { return [0.0; 2] };
        let ([[t00, t10], [t01, t11]], [fx, fy]) = self.around(place);
        let along_x = (t10[0] - t00[0]) * (1.0 - fy) + (t11[0] - t01[0]) * fy;
        let along_y = (t01[0] - t00[0]) * (1.0 - fx) + (t11[0] - t10[0]) * fx;
        let (x, y) = (along_x * self.image.width as f32, along_y * self.image.height as f32);
        let m = &self.map;
        [m[0] * x + m[3] * y, m[1] * x + m[4] * y]
    }

    /// Where (u, v) lies in texels from the upper left corner; `None` where f32 holds no place between texels any more.
    #[inline]
    fn place(&self, uv: [f32; 2]) -> Option<[f32; 2]> {
        let m = &self.map;
        let u = m[0] * uv[0] + m[1] * uv[1] + m[2];
        let v = m[3] * uv[0] + m[4] * uv[1] + m[5];
        let (x, y) = (u * self.image.width as f32, v * self.image.height as f32);
        // Beyond 2³¹ texels.
        (x.abs() < 2e9 && y.abs() < 2e9).then_some([x, y])
    }

    /// The two rows of two texels about a place, and how far it lies between them.
    #[inline]
    fn around(&self, [x, y]: [f32; 2]) -> ([[[f32; 4]; 2]; 2], [f32; 2]) {
        let (w, h) = (self.image.width, self.image.height);
        let (x, y) = (x - 0.5, y - 0.5);
        let (x0, y0) = (real::floorf(x), real::floorf(y));
        let column = |i: i64| wrap(x0 as i64 + i, w, self.wrap[0]);
        let row = |j: i64| wrap(y0 as i64 + j, h, self.wrap[1]);
        let texels = [0, 1].map(|j| [0, 1].map(|i| self.image.texel(column(i), row(j))));
        (texels, [x - x0, y - y0])
    }
}

/// The texel that index `i` of `n` means.
#[inline]
fn wrap(i: i64, n: u32, how: Wrap) -> u32 {
    let n = i64::from(n);
    if (0..n).contains(&i) {
        return i as u32;
    }
    let j = match how {
        Wrap::Repeat => i.rem_euclid(n),
        Wrap::Clamp => i.clamp(0, n - 1),
        Wrap::Mirror => {
            let k = i.rem_euclid(2 * n);
            if k < n { k } else { 2 * n - 1 - k }
        }
    };
    j as u32
}

/// sRGB decoding of the 256 codes (IEC 61966-2-1).
struct SrgbTable([f32; 256]);

static SRGB: std::sync::LazyLock<SrgbTable> = std::sync::LazyLock::new(|| {
    SrgbTable(std::array::from_fn(|i| {
        let c = i as f64 / 255.0;
        (if c <= 0.04045 { c / 12.92 } else { real::pow((c + 0.055) / 1.055, 2.4) }) as f32
    }))
});

#[cfg(test)]
mod tests {
    use super::*;

    fn checker() -> Texture {
        let texels = Texels::Linear8(vec![[0; 4], [255; 4], [255; 4], [0; 4]]);
        Texture::new(Arc::new(Image::new(2, 2, texels).unwrap()))
    }

    #[test]
    fn texel_centres_are_exact_and_the_middle_is_the_mean() {
        let t = checker();
        assert_eq!(t.at([0.25, 0.25])[0], 0.0);
        assert_eq!(t.at([0.75, 0.25])[0], 1.0);
        assert_eq!(t.at([0.5, 0.5])[0], 0.5);
    }

    #[test]
    fn wrapping() {
        assert_eq!(
            [wrap(-1, 4, Wrap::Repeat), wrap(-1, 4, Wrap::Clamp), wrap(-1, 4, Wrap::Mirror)],
            [3, 0, 0]
        );
        assert_eq!([wrap(5, 4, Wrap::Repeat), wrap(5, 4, Wrap::Clamp), wrap(5, 4, Wrap::Mirror)], [1, 3, 2]);
    }

    #[test]
    fn srgb_ends_and_middle() {
        assert_eq!((SRGB.0[0], SRGB.0[255]), (0.0, 1.0));
        // 188/255 is the code nearest to linear 0.5 (IEC 61966-2-1): 0.5029.
        assert!((SRGB.0[188] - 0.5029).abs() < 1e-4);
    }
}
