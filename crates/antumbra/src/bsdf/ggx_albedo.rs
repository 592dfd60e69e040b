//! How much light a GGX surface reflects once: a table over roughness and angle, made at first use.
//!
//! With Schlick's F = F0 + (1−F0)·s the share reflected is F0·scale + bias, where scale and bias do not depend on F0:
//! scale = E[(1−s)·G₂/G₁] and bias = E[s·G₂/G₁] over visible normals (Karis 2013, "Real Shading in Unreal Engine 4").

use std::sync::LazyLock;

use antumbra_math::real;

use super::ggx::MIN_ALPHA;

/// F0 of every dielectric in glTF's model (index of refraction 1.5).
pub const DIELECTRIC_F0: f32 = 0.04;

const ROWS: usize = 32;
const COLUMNS: usize = 48;

/// Share of light as a line in F0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Share {
    /// Slope in F0.
    pub scale: f32,
    /// Share at F0 = 0.
    pub bias: f32,
}

impl Share {
    /// F0·scale + bias.
    #[inline]
    pub fn at(self, f0: f32) -> f32 {
        f0 * self.scale + self.bias
    }

    #[inline]
    fn lerp(self, o: Share, t: f32) -> Share {
        let mix = |a: f32, b: f32| a * (1.0 - t) + b * t;
        Share { scale: mix(self.scale, o.scale), bias: mix(self.bias, o.bias) }
    }
}

/// A place between two rows of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row(f32);

impl Row {
    /// The row of a roughness = √α; rows are evenly spaced in it.
    pub fn of_roughness(roughness: f32) -> Row {
        let least = MIN_ALPHA.sqrt();
        Row(((roughness - least) / (1.0 - least)).clamp(0.0, 1.0) * (ROWS - 1) as f32)
    }

    /// The share reflected of what arrives from cosine `mu`, bilinear in (roughness, √μ).
    #[inline]
    pub fn directional(self, mu: f32) -> Share {
        let (i, s) = split(self.0, ROWS);
        let (k, t) = split(mu.clamp(0.0, 1.0).sqrt() * (COLUMNS - 1) as f32, COLUMNS);
        let (a, b) = (&TABLE.directional[i], &TABLE.directional[i + 1]);
        a[k].lerp(a[k + 1], t).lerp(b[k].lerp(b[k + 1], t), s)
    }

    /// The share reflected of light that is equal from everywhere: 2 ∫ directional(μ) μ dμ.
    #[inline]
    pub fn average(self) -> Share {
        let (i, s) = split(self.0, ROWS);
        TABLE.average[i].lerp(TABLE.average[i + 1], s)
    }
}

/// Lower neighbour and the distance from it.
#[inline]
fn split(x: f32, count: usize) -> (usize, f32) {
    let i = (x as usize).min(count - 2);
    (i, x - i as f32)
}

struct Table {
    directional: [[Share; COLUMNS]; ROWS],
    average: [Share; ROWS],
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let nodes = Nodes::new();
    let least = f64::from(MIN_ALPHA).sqrt();
    let mut directional = [[Share::default(); COLUMNS]; ROWS];
    for (i, row) in directional.iter_mut().enumerate() {
        let roughness = least + (1.0 - least) * i as f64 / (ROWS - 1) as f64;
        for (k, cell) in row.iter_mut().enumerate() {
            let t = k as f64 / (COLUMNS - 1) as f64;
            *cell = nodes.share(roughness * roughness, t * t);
        }
    }
    Table { average: directional.each_ref().map(average), directional }
});

/// 2 ∫ E μ dμ, exact for E linear in t = √μ between the columns: ∫ E 4t³ dt.
fn average(row: &[Share; COLUMNS]) -> Share {
    let h = 1.0 / (COLUMNS - 1) as f64;
    let mut sum = (0.0, 0.0);
    for k in 0..COLUMNS - 1 {
        let (a, b) = (k as f64 * h, (k + 1) as f64 * h);
        // Moments of 4t³ over [a, b], split between the two ends.
        let whole = b.powi(4) - a.powi(4);
        let upper = (0.8 * (b.powi(5) - a.powi(5)) - a * whole) / h;
        for (share, weight) in [(row[k], whole - upper), (row[k + 1], upper)] {
            sum.0 += weight * f64::from(share.scale);
            sum.1 += weight * f64::from(share.bias);
        }
    }
    Share { scale: sum.0 as f32, bias: sum.1 as f32 }
}

const AZIMUTHS: usize = 12;
const HEIGHTS: usize = 32;

/// Midpoints over the numbers (u, φ) that sample visible normals; φ over half a turn, by symmetry.
struct Nodes {
    cos_phi: [f64; AZIMUTHS],
}

impl Nodes {
    fn new() -> Nodes {
        let step = std::f64::consts::PI / AZIMUTHS as f64;
        Nodes { cos_phi: std::array::from_fn(|k| real::cos((k as f64 + 0.5) * step)) }
    }

    /// Scale and bias for one α and one μ_o.
    fn share(&self, alpha: f64, mu_o: f64) -> Share {
        let mut sum = (0.0, 0.0);
        for k in 0..HEIGHTS {
            let u = (k as f64 + 0.5) / HEIGHTS as f64;
            for cos_phi in self.cos_phi {
                let (g, s) = reflected(alpha, mu_o, u, cos_phi);
                sum.0 += (1.0 - s) * g;
                sum.1 += s * g;
            }
        }
        let n = (AZIMUTHS * HEIGHTS) as f64;
        Share { scale: (sum.0 / n) as f32, bias: (sum.1 / n) as f32 }
    }
}

/// (G₂/G₁, Schlick's weight) of one visible normal, ω_o in the plane y = 0; the f64 twin of [`super::ggx`].
fn reflected(alpha: f64, mu_o: f64, u: f64, cos_phi: f64) -> (f64, f64) {
    let sin_o = (1.0 - mu_o * mu_o).sqrt();
    let length = (alpha * alpha * sin_o * sin_o + mu_o * mu_o).sqrt();
    let (wx, wz) = (alpha * sin_o / length, mu_o / length);
    let sum_z = (1.0 - u) * (1.0 + wz);
    let z = sum_z - wz;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (x, y2) = (r * cos_phi + wx, r * r * (1.0 - cos_phi * cos_phi));
    let (mx, my2, mz) = (alpha * x, alpha * alpha * y2, sum_z);
    let scale = 1.0 / (mx * mx + my2 + mz * mz).sqrt();
    let oh = (sin_o * mx + mu_o * mz) * scale;
    let mu_i = 2.0 * oh * mz * scale - mu_o;
    if mu_i <= 0.0 {
        return (0.0, 0.0);
    }
    let slant = |mu: f64| (alpha * alpha + (1.0 - alpha * alpha) * mu * mu).sqrt();
    let g = mu_i * (mu_o + slant(mu_o)) / (mu_o * slant(mu_i) + mu_i * slant(mu_o));
    let miss = (1.0 - oh).max(0.0);
    (g, miss * miss * miss * miss * miss)
}
