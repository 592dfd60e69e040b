//! Spectra as linear sRGB: what the standard observer of CIE 1931 sees of them.

use antumbra_math::{Rgb, real};

/// What a spectrum stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A share of light, or an index, under daylight (D65): the same at all wavelengths is grey.
    Matter,
    /// Light: the same at all wavelengths has the luminance 1, and the chromaticity x = y = 1/3.
    Light,
}

/// A spectrum of values at wavelengths [nm]: linear between them, 0 beyond.
pub(super) struct Samples(Vec<[f64; 2]>);

impl Samples {
    /// Of pairs of wavelength and value; `None` unless the wavelengths grow.
    pub(super) fn new(pairs: Vec<[f64; 2]>) -> Option<Samples> {
        pairs.windows(2).all(|w| w[0][0] < w[1][0]).then_some(Samples(pairs))
    }

    /// Its colour.
    pub(super) fn seen(&self, of: Of) -> Rgb {
        let pieces = self.0.windows(2).map(|w| {
            let ([a, from], [b, to]) = (w[0], w[1]);
            integral(a, b, |nm| from + (to - from) * (nm - a) / (b - a), of)
        });
        color(pieces.fold([0.0; 3], |sum, piece| std::array::from_fn(|c| sum[c] + piece[c])), of)
    }
}

/// The colour of the same value at all wavelengths.
pub(super) fn flat(value: f64, of: Of) -> Rgb {
    color(integral(FIRST, LAST, |_| value, of), of)
}

/// The light of a black body of `kelvin`, spectral radiance in W·m⁻²·sr⁻¹·nm⁻¹.
pub(super) fn black_body(kelvin: f64) -> Rgb {
    color(integral(FIRST, LAST, |nm| planck(nm, kelvin), Of::Light), Of::Light)
}

/// Planck's law: 2hc²/λ⁵ / (exp(hc/λkT) − 1) [W·m⁻²·sr⁻¹·nm⁻¹], λ in nanometres, T in kelvin (CODATA 2018).
fn planck(nm: f64, kelvin: f64) -> f64 {
    let (first, second) = (1.191_042_972e20, 1.438_776_877e7);
    let x = second / (nm * kelvin);
    // Where the difference would lose digits, the first terms of its series.
    let above_one = if x < 1e-5 { x + 0.5 * x * x } else { real::exp(x) - 1.0 };
    first / (nm * nm * nm * nm * nm * above_one)
}

/// X, Y, Z of `value` from a to b [nm] against the table: Simpson's rule between its rows, exact for straight lines.
fn integral(a: f64, b: f64, value: impl Fn(f64) -> f64, of: Of) -> [f64; 3] {
    let (a, b) = (a.max(FIRST), b.min(LAST));
    let mut sum = [0.0; 3];
    if b <= a {
        return sum;
    }
    let row = |nm: f64| (((nm - FIRST) / STEP).floor().max(0.0) as usize).min(TABLE.len() - 2);
    for i in row(a)..=row(b) {
        let start = FIRST + STEP * i as f64;
        let (low, high) = (a.max(start), b.min(start + STEP));
        for (nm, part) in [(low, 1.0), (0.5 * (low + high), 4.0), (high, 1.0)] {
            let along = (nm - start) / STEP;
            let at = |k: usize| TABLE[i][k] + (TABLE[i + 1][k] - TABLE[i][k]) * along;
            let lit = if of == Of::Matter { at(3) } else { 1.0 };
            let weight = part * (high - low).max(0.0) / 6.0 * lit * value(nm);
            (0..3).for_each(|c| sum[c] += weight * at(c));
        }
    }
    sum
}

/// XYZ to linear sRGB (IEC 61966-2-1).
const SRGB: [[f64; 3]; 3] = [
    [3.240_454_2, -1.537_138_5, -0.498_531_4],
    [-0.969_266, 1.876_010_8, 0.041_556],
    [0.055_643_4, -0.204_025_9, 1.057_225_2],
];

/// Against what is 1; below 0, outside of sRGB, 0.
fn color(xyz: [f64; 3], of: Of) -> Rgb {
    let rgb = |xyz: [f64; 3]| SRGB.map(|row| (0..3).map(|c| row[c] * xyz[c]).sum::<f64>());
    let one = integral(FIRST, LAST, |_| 1.0, of);
    let by = if of == Of::Matter { rgb(one) } else { [one[1]; 3] };
    let rgb = rgb(xyz);
    Rgb(std::array::from_fn(|c| (rgb[c] / by[c]).max(0.0) as f32))
}

/// Wavelength of the first and the last row, and between rows [nm].
const FIRST: f64 = 360.0;
const LAST: f64 = 830.0;
const STEP: f64 = 5.0;

/// x̄, ȳ, z̄ of the standard observer (CIE 1931, 2°) and daylight D65 (ISO 11664-2), every 5 nm from 360 to 830.
#[rustfmt::skip]
const TABLE: [[f64; 4]; 95] = [
    [0.0001299, 3.917e-06, 0.0006061, 46.6383],
    [0.0002321, 6.965e-06, 0.001086, 49.3637],
    [0.0004149, 1.239e-05, 0.001946, 52.0891],
    [0.0007416, 2.202e-05, 0.003486, 51.0323],
    [0.001368, 3.9e-05, 0.00645, 49.9755],
    [0.002236, 6.4e-05, 0.01055, 52.3118],
    [0.004243, 0.00012, 0.02005, 54.6482],
    [0.00765, 0.000217, 0.03621, 68.7015],
    [0.01431, 0.000396, 0.06785, 82.7549],
    [0.02319, 0.00064, 0.1102, 87.1204],
    [0.04351, 0.00121, 0.2074, 91.486],
    [0.07763, 0.00218, 0.3713, 92.4589],
    [0.13438, 0.004, 0.6456, 93.4318],
    [0.21477, 0.0073, 1.03905, 90.057],
    [0.2839, 0.0116, 1.3856, 86.6823],
    [0.3285, 0.01684, 1.62296, 95.7736],
    [0.34828, 0.023, 1.74706, 104.865],
    [0.34806, 0.0298, 1.7826, 110.936],
    [0.3362, 0.038, 1.77211, 117.008],
    [0.3187, 0.048, 1.7441, 117.41],
    [0.2908, 0.06, 1.6692, 117.812],
    [0.2511, 0.0739, 1.5281, 116.336],
    [0.19536, 0.09098, 1.28764, 114.861],
    [0.1421, 0.1126, 1.0419, 115.392],
    [0.09564, 0.13902, 0.81295, 115.923],
    [0.05795, 0.1693, 0.6162, 112.367],
    [0.03201, 0.20802, 0.46518, 108.811],
    [0.0147, 0.2586, 0.3533, 109.082],
    [0.0049, 0.323, 0.272, 109.354],
    [0.0024, 0.4073, 0.2123, 108.578],
    [0.0093, 0.503, 0.1582, 107.802],
    [0.0291, 0.6082, 0.1117, 106.296],
    [0.06327, 0.71, 0.07825, 104.79],
    [0.1096, 0.7932, 0.05725, 106.239],
    [0.1655, 0.862, 0.04216, 107.689],
    [0.22575, 0.91485, 0.02984, 106.047],
    [0.2904, 0.954, 0.0203, 104.405],
    [0.3597, 0.9803, 0.0134, 104.225],
    [0.43345, 0.99495, 0.00875, 104.046],
    [0.51205, 1.0, 0.00575, 102.023],
    [0.5945, 0.995, 0.0039, 100.0],
    [0.6784, 0.9786, 0.00275, 98.1671],
    [0.7621, 0.952, 0.0021, 96.3342],
    [0.8425, 0.9154, 0.0018, 96.0611],
    [0.9163, 0.87, 0.00165, 95.788],
    [0.9786, 0.8163, 0.0014, 92.2368],
    [1.0263, 0.757, 0.0011, 88.6856],
    [1.0567, 0.6949, 0.001, 89.3459],
    [1.0622, 0.631, 0.0008, 90.0062],
    [1.0456, 0.5668, 0.0006, 89.8026],
    [1.0026, 0.503, 0.00034, 89.5991],
    [0.9384, 0.4412, 0.00024, 88.6489],
    [0.85445, 0.381, 0.00019, 87.6987],
    [0.7514, 0.321, 0.0001, 85.4936],
    [0.6424, 0.265, 5e-05, 83.2886],
    [0.5419, 0.217, 3e-05, 83.4939],
    [0.4479, 0.175, 2e-05, 83.6992],
    [0.3608, 0.1382, 1e-05, 81.863],
    [0.2835, 0.107, 0.0, 80.0268],
    [0.2187, 0.0816, 0.0, 80.1207],
    [0.1649, 0.061, 0.0, 80.2146],
    [0.1212, 0.04458, 0.0, 81.2462],
    [0.0874, 0.032, 0.0, 82.2778],
    [0.0636, 0.0232, 0.0, 80.281],
    [0.04677, 0.017, 0.0, 78.2842],
    [0.0329, 0.01192, 0.0, 74.0027],
    [0.0227, 0.00821, 0.0, 69.7213],
    [0.01584, 0.005723, 0.0, 70.6652],
    [0.0113592, 0.004102, 0.0, 71.6091],
    [0.00811092, 0.002929, 0.0, 72.979],
    [0.00579035, 0.002091, 0.0, 74.349],
    [0.00410946, 0.001484, 0.0, 67.9765],
    [0.00289933, 0.001047, 0.0, 61.604],
    [0.00204919, 0.00074, 0.0, 65.7448],
    [0.00143997, 0.00052, 0.0, 69.8856],
    [0.000999949, 0.0003611, 0.0, 72.4863],
    [0.000690079, 0.0002492, 0.0, 75.087],
    [0.000476021, 0.0001719, 0.0, 69.3398],
    [0.000332301, 0.00012, 0.0, 63.5927],
    [0.000234826, 8.48e-05, 0.0, 55.0054],
    [0.00016615, 6e-05, 0.0, 46.4182],
    [0.000117413, 4.24e-05, 0.0, 56.6118],
    [8.30753e-05, 3e-05, 0.0, 66.8054],
    [5.87065e-05, 2.12e-05, 0.0, 65.0941],
    [4.15099e-05, 1.499e-05, 0.0, 63.3828],
    [2.93533e-05, 1.06e-05, 0.0, 63.8434],
    [2.06738e-05, 7.4657e-06, 0.0, 64.304],
    [1.45598e-05, 5.2578e-06, 0.0, 61.8779],
    [1.0254e-05, 3.7029e-06, 0.0, 59.4519],
    [7.22146e-06, 2.6078e-06, 0.0, 55.7054],
    [5.08587e-06, 1.8366e-06, 0.0, 51.959],
    [3.58165e-06, 1.2934e-06, 0.0, 54.6998],
    [2.52252e-06, 9.1093e-07, 0.0, 57.4406],
    [1.77651e-06, 6.4153e-07, 0.0, 58.8765],
    [1.25114e-06, 4.5181e-07, 0.0, 60.3125],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// x and y of a colour of light.
    fn chromaticity(Rgb(rgb): Rgb) -> [f64; 2] {
        // Linear sRGB to XYZ (IEC 61966-2-1).
        let rows = [
            [0.412_456_4, 0.357_576_1, 0.180_437_5],
            [0.212_672_9, 0.715_152_2, 0.072_175],
            [0.019_333_9, 0.119_192, 0.950_304_1],
        ];
        let [x, y, z] = rows.map(|row| (0..3).map(|c| row[c] * f64::from(rgb[c])).sum::<f64>());
        [x / (x + y + z), y / (x + y + z)]
    }

    /// The same at all wavelengths is white as matter, and as light the white of equal energy, x = y = 1/3; the table is
    /// normalised to 10⁻⁴ of that.
    #[test]
    fn equal_energy() {
        assert_eq!(flat(1.0, Of::Matter), Rgb::WHITE);
        let light = flat(1.0, Of::Light);
        assert!((light.luminance() - 1.0).abs() < 1e-4, "{light:?}");
        assert!(
            chromaticity(light).iter().all(|c| (c - 1.0 / 3.0).abs() < 1e-4),
            "{:?}",
            chromaticity(light)
        );
        let pairs =
            Samples::new(vec![[300.0, 0.25], [500.0, 0.25], [900.0, 0.25]]).map(|s| s.seen(Of::Matter));
        assert!(pairs.is_some_and(|c| c.0.iter().all(|c| (c - 0.25).abs() < 1e-6)), "{pairs:?}");
    }

    /// Illuminant A is a black body of 2855.5 K: x = 0.44757, y = 0.40745 (ISO 11664-2, five digits of a table with c₂ of
    /// 1948, a shift of 10⁻⁴ at most). 6504 K lies at x = 0.3135, y = 0.3237 (Wyszecki and Stiles 1982).
    #[test]
    fn black_bodies_have_their_chromaticity() {
        for (kelvin, x, y) in [(2855.5, 0.44757, 0.40745), (6504.0, 0.3135, 0.3237)] {
            let seen = chromaticity(black_body(kelvin));
            assert!((seen[0] - x).abs() < 2e-4 && (seen[1] - y).abs() < 2e-4, "{kelvin} {seen:?}");
        }
        // Twice as hot as 2000 K is brighter by more than 2⁴ (the visible part grows faster than the whole).
        assert!(black_body(4000.0).luminance() > 16.0 * black_body(2000.0).luminance());
    }

    /// A spectrum is the sum of its pieces, and what lies outside of the table is not seen.
    #[test]
    fn pieces_add_up() {
        let seen =
            |pairs: &[[f64; 2]]| Samples::new(pairs.to_vec()).map_or(Rgb::BLACK, |s| s.seen(Of::Light));
        let whole = seen(&[[380.0, 1.0], [550.0, 2.0], [780.0, 1.0]]);
        let parts = seen(&[[380.0, 1.0], [550.0, 2.0]]) + seen(&[[550.0, 2.0], [780.0, 1.0]]);
        // Each part alone is bluer or redder than sRGB: only green has no clamp.
        assert!((whole.0[1] - parts.0[1]).abs() < 1e-6, "{whole:?} {parts:?}");
        assert_eq!(seen(&[[900.0, 1.0], [1000.0, 1.0]]), Rgb::BLACK);
        assert!(Samples::new(vec![[500.0, 1.0], [500.0, 2.0]]).is_none());
    }
}
