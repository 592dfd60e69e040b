//! How much light a GGX surface reflects at one bounce: a table over roughness and angle, made at first use.
//!
//! With Schlick's F = F0 + (1−F0)·s the share reflected is a line in F0: F0·scale + bias (Karis 2013, "Real Shading in
//! Unreal Engine 4"). Tabulated are what varies slowly, the share at F0 = 1 (scale + bias) and the rise of
//! bias/(scale + bias) above the (1−μ)⁵ of a smooth surface. What the table says differs from the truth by less than
//! 0.001 at F0 = 0.04 where μ ≥ 0.01, by less than 0.0025 everywhere (the tests measure both).

use std::sync::LazyLock;

use antumbra_math::real;

use super::ggx::MIN_ALPHA;

/// F0 of every dielectric in glTF's model (index of refraction 1.5).
pub const DIELECTRIC_F0: f32 = 0.04;

const ROWS: usize = 32;
const COLUMNS: usize = 32;

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
        Share { scale: mix(self.scale, o.scale, t), bias: mix(self.bias, o.bias, t) }
    }
}

/// One entry.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// scale + bias.
    total: f32,
    /// bias/(scale + bias) − (1−μ)⁵.
    rise: f32,
}

impl Cell {
    #[inline]
    fn lerp(self, o: Cell, t: f32) -> Cell {
        Cell { total: mix(self.total, o.total, t), rise: mix(self.rise, o.rise, t) }
    }

    #[inline]
    fn share(self, mu: f32) -> Share {
        let miss = 1.0 - mu;
        let miss2 = miss * miss;
        let bias = self.total * (miss2 * miss2 * miss + self.rise);
        Share { scale: self.total - bias, bias }
    }
}

/// A place between two rows of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    place: f32,
    /// 3α: columns are even in x = μ(1+3α)/(μ+3α), so that half of them lie where μ is of the order of α.
    bend: f32,
}

impl Row {
    /// The row of a roughness = √α; rows are even in it.
    pub fn of_roughness(roughness: f32) -> Row {
        let least = MIN_ALPHA.sqrt();
        let place = ((roughness - least) / (1.0 - least)).clamp(0.0, 1.0) * (ROWS - 1) as f32;
        Row { place, bend: 3.0 * roughness * roughness }
    }

    /// The share reflected of what arrives from cosine `mu`, bilinear.
    #[inline]
    pub fn directional(self, mu: f32) -> Share {
        let mu = mu.clamp(0.0, 1.0);
        let x = mu * (1.0 + self.bend) / (mu + self.bend);
        let (i, s) = split(self.place, ROWS);
        let (k, t) = split(x * (COLUMNS - 1) as f32, COLUMNS);
        let (a, b) = (&TABLE.directional[i], &TABLE.directional[i + 1]);
        a[k].lerp(a[k + 1], t).lerp(b[k].lerp(b[k + 1], t), s).share(mu)
    }

    /// The share reflected of light that is equal from everywhere: 2 ∫ directional(μ) μ dμ.
    #[inline]
    pub fn average(self) -> Share {
        let (i, s) = split(self.place, ROWS);
        TABLE.average[i].lerp(TABLE.average[i + 1], s)
    }
}

#[inline]
fn mix(a: f32, b: f32, t: f32) -> f32 {
    a * (1.0 - t) + b * t
}

/// Lower neighbour and the distance from it.
#[inline]
fn split(x: f32, count: usize) -> (usize, f32) {
    let i = (x as usize).min(count - 2);
    (i, x - i as f32)
}

struct Table {
    directional: [[Cell; COLUMNS]; ROWS],
    average: [Share; ROWS],
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let azimuths = azimuths();
    let least = f64::from(MIN_ALPHA).sqrt();
    let alpha = |i: usize| {
        let roughness = least + (1.0 - least) * i as f64 / (ROWS - 1) as f64;
        roughness * roughness
    };
    let mut directional = [[Cell::default(); COLUMNS]; ROWS];
    let mut averages = [Share::default(); ROWS];
    for (i, row) in directional.iter_mut().enumerate() {
        for (k, cell) in row.iter_mut().enumerate() {
            *cell = entry(alpha(i), cosine(alpha(i), k as f64 / (COLUMNS - 1) as f64), &azimuths);
        }
        averages[i] = average(row, alpha(i));
    }
    Table { directional, average: averages }
});

/// μ of the column x: the inverse of [`Row::directional`]'s x.
fn cosine(alpha: f64, x: f64) -> f64 {
    3.0 * alpha * x / (1.0 + 3.0 * alpha - x)
}

fn entry(alpha: f64, mu: f64, azimuths: &[(f64, f64)]) -> Cell {
    let (scale, bias) = share(alpha, mu, azimuths);
    let total = scale + bias;
    Cell { total: total as f32, rise: (bias / total - schlick(mu)) as f32 }
}

/// 2 ∫ E μ dμ of a row as it is interpolated, ten points between columns.
fn average(row: &[Cell; COLUMNS], alpha: f64) -> Share {
    let mut sum = (0.0, 0.0);
    let (bend, width) = (3.0 * alpha, 1.0 / (COLUMNS - 1) as f64);
    for k in 0..COLUMNS - 1 {
        for (t, weight) in GAUSS {
            let x = (k as f64 + t) * width;
            let mu = cosine(alpha, x);
            let dmu_dx = bend * (1.0 + bend) / ((1.0 + bend - x) * (1.0 + bend - x));
            let share = row[k].lerp(row[k + 1], t as f32).share(mu as f32);
            let weight = 2.0 * mu * weight * width * dmu_dx;
            sum.0 += weight * f64::from(share.scale);
            sum.1 += weight * f64::from(share.bias);
        }
    }
    Share { scale: sum.0 as f32, bias: sum.1 as f32 }
}

/// Gauss–Legendre nodes and weights on [0, 1], ten points.
const GAUSS: [(f64, f64); 10] = [
    (0.013_046_735_741_414_1, 0.033_335_672_154_344_1),
    (0.067_468_316_655_507_7, 0.074_725_674_575_290_2),
    (0.160_295_215_850_487_8, 0.109_543_181_257_991),
    (0.283_302_302_935_376_4, 0.134_633_359_654_998_3),
    (0.425_562_830_509_184_4, 0.147_762_112_357_376_4),
    (0.574_437_169_490_815_6, 0.147_762_112_357_376_4),
    (0.716_697_697_064_623_6, 0.134_633_359_654_998_3),
    (0.839_704_784_149_512_2, 0.109_543_181_257_991),
    (0.932_531_683_344_492_3, 0.074_725_674_575_290_2),
    (0.986_953_264_258_585_9, 0.033_335_672_154_344_1),
];

/// (cos ψ, weight) over half a turn, the rest being its mirror image; a rule for each quarter, because grazing light
/// jumps between them.
fn azimuths() -> [(f64, f64); 2 * GAUSS.len()] {
    std::array::from_fn(|k| {
        let (t, weight) = GAUSS[k % GAUSS.len()];
        let quarter = (k / GAUSS.len()) as f64;
        (real::cos((quarter + t) * std::f64::consts::FRAC_PI_2), 0.5 * weight)
    })
}

/// (scale, bias) for one α and one μ_o.
///
/// E = (1/μ_o) ∫ P₂₂ F G₂ (ω_o·m)/(m·n) over the slopes of facets m, in polar form: slope = αρ(cos ψ, sin ψ), where
/// u = ρ²/(1+ρ²) is uniform under P₂₂. The reflected direction is above the horizon inside the circle of slopes
/// about (tan θ_o, 0) with radius 1/cos θ_o, which bounds u for each ψ.
fn share(alpha: f64, mu_o: f64, azimuths: &[(f64, f64)]) -> (f64, f64) {
    let mu_o = mu_o.clamp(1e-6, 1.0);
    let sin_o = (1.0 - mu_o * mu_o).sqrt();
    let slant_o = slant(alpha, mu_o);
    let mut sum = (0.0, 0.0);
    for &(cos_psi, weight_psi) in azimuths {
        let end = horizon(alpha, sin_o / mu_o * cos_psi);
        for (t, weight_t) in GAUSS {
            // u = end (1 − t²): nodes crowd at the horizon, where G₂ falls to 0 within μ_o.
            let rest = (1.0 - end) + end * t * t;
            let rho2 = end * (1.0 - t * t) / rest;
            let towards = sin_o * alpha * rho2.sqrt() * cos_psi + mu_o;
            let m_z = 1.0 / (1.0 + alpha * alpha * rho2).sqrt();
            let oh = towards * m_z;
            let mu_i = (2.0 * oh * m_z - mu_o).max(0.0);
            let g = 2.0 * mu_i * towards / (mu_o * slant(alpha, mu_i) + mu_i * slant_o);
            let weighted = weight_psi * weight_t * 2.0 * t * end * g;
            let s = schlick(oh);
            sum.0 += (1.0 - s) * weighted;
            sum.1 += s * weighted;
        }
    }
    sum
}

/// The largest u whose reflected direction is above the horizon; `tilt` = tan θ_o cos ψ.
fn horizon(alpha: f64, tilt: f64) -> f64 {
    let root = (tilt * tilt + 1.0).sqrt();
    // tilt + root without cancellation.
    let slope = if tilt > 0.0 { tilt + root } else { 1.0 / (root - tilt) };
    slope * slope / (alpha * alpha + slope * slope)
}

/// [`super::ggx::Ggx::slant`] in f64.
fn slant(alpha: f64, mu: f64) -> f64 {
    (alpha * alpha + (1.0 - alpha * alpha) * mu * mu).sqrt()
}

fn schlick(cos: f64) -> f64 {
    let miss = (1.0 - cos).max(0.0);
    let miss2 = miss * miss;
    miss2 * miss2 * miss
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::ggx::Ggx;
    use antumbra_math::{Local, Vec3};

    /// E by another road: midpoints over the numbers that `Ggx::sample` takes, G₂/G₁ of its directions.
    fn by_sampling(alpha: f32, mu: f32) -> (f64, f64) {
        let ggx = Ggx { alpha };
        let wo = Local(Vec3::new(((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu));
        let (rows, columns) = (400, 200);
        let mut sum = (0.0, 0.0);
        for i in 0..rows * columns {
            let u = [
                ((i % columns) as f32 + 0.5) / (2 * columns) as f32,
                ((i / columns) as f32 + 0.5) / rows as f32,
            ];
            let wi = ggx.sample(wo, u);
            let Some(pair) = ggx.pair(wo, wi).filter(|_| wi.cos() > 0.0) else { continue };
            let weight = pair.d * ggx.visibility(mu, wi.cos()) * wi.cos() / ggx.pdf(mu, pair.d);
            sum.0 += f64::from((1.0 - pair.schlick) * weight);
            sum.1 += f64::from(pair.schlick * weight);
        }
        let n = f64::from(rows * columns);
        (sum.0 / n, sum.1 / n)
    }

    #[test]
    fn quadrature_and_sampling_agree() {
        let azimuths = azimuths();
        for roughness in [MIN_ALPHA.sqrt(), 0.1, 0.35, 0.7, 1.0] {
            for mu in [0.01, 0.1, 0.4, 0.9, 1.0] {
                let alpha = roughness * roughness;
                let (a, b) = (share(alpha.into(), mu.into(), &azimuths), by_sampling(alpha, mu));
                // Midpoints along the horizon's jump: each of 200 columns errs by up to half its width and cell, 1/400.
                // The quadrature errs by as much where μ is small and roughness large.
                let told = format!("roughness {roughness} mu {mu}: {a:?} {b:?}");
                assert!((a.0 - b.0).abs() < 4e-3 && (a.1 - b.1).abs() < 4e-3, "{told}");
            }
        }
    }

    #[test]
    fn straight_on_at_full_width() {
        // α = 1: D = 1/π, G₂/(4 μ_o μ_i) = 1/(2 (1 + μ)), so facets that reflect all light give back
        // ∫ μ/(1 + μ) dμ = 1 − ln 2. The quadrature's own error is the tolerance of the test above.
        let (scale, bias) = share(1.0, 1.0, &azimuths());
        assert!((scale + bias - (1.0 - std::f64::consts::LN_2)).abs() < 4e-3, "{}", scale + bias);
    }

    #[test]
    fn the_table_follows_the_quadrature() {
        let azimuths = azimuths();
        let mut worst = [0.0f64; 2];
        for i in 0..=40 {
            let least = MIN_ALPHA.sqrt();
            let roughness = least + (1.0 - least) * (i as f32 / 40.0) * (i as f32 / 40.0);
            let alpha = f64::from(roughness) * f64::from(roughness);
            for k in 0..=60 {
                let mu = real::powf(10.0, -4.0 * k as f32 / 60.0);
                let (scale, bias) = share(alpha, mu.into(), &azimuths);
                let truth = f64::from(DIELECTRIC_F0) * scale + bias;
                let off =
                    (f64::from(Row::of_roughness(roughness).directional(mu).at(DIELECTRIC_F0)) - truth).abs();
                let class = usize::from(mu < 0.01);
                worst[class] = worst[class].max(off);
            }
        }
        assert!(worst[0] < 1e-3 && worst[1] < 2.5e-3, "{worst:?}");
    }

    #[test]
    fn averages_are_those_of_the_interpolated_rows() {
        for i in 0..=20 {
            let row = Row::of_roughness(0.0317 + (1.0 - 0.0317) * i as f32 / 20.0);
            let n = 4000;
            let mean: f64 = (0..n)
                .map(|k| (f64::from(k) + 0.5) / f64::from(n))
                .map(|mu| 2.0 * mu * f64::from(row.directional(mu as f32).at(DIELECTRIC_F0)) / f64::from(n))
                .sum();
            let said = f64::from(row.average().at(DIELECTRIC_F0));
            // Between rows the columns move with α, and the average is only as straight as they are.
            assert!((mean - said).abs() < 3e-4, "{row:?}: {mean} {said}");
        }
    }
}
