//! The radiance of the sun's disc through the air.
//!
//! Spectrum outside of the atmosphere and absorption of ozone: Iqbal, An Introduction to Solar Radiation (1983), as in
//! Preetham, Shirley and Smits, A Practical Analytic Model for Daylight (1999), table 2 and appendix A.1, whose extinction
//! by molecules (Rayleigh), haze (Ångström) and ozone is taken along one straight path. Absorption by water and mixed
//! gases, which lies beyond 690 nm, is left out. Colours: the observer of CIE 1931 as fitted by Wyman, Sloan and
//! Shirley, Simple Analytic Approximations to the CIE XYZ Color Matching Functions (2013).

use antumbra_math::Rgb;
use antumbra_math::real::{exp, pow};

/// Spectral radiance of the sun outside of the atmosphere [100 W·m⁻²·sr⁻¹·nm⁻¹] from 380 nm by 10 nm.
const SUN: [f64; 38] = [
    165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6, 306.6, 288.3, 287.1, 278.2, 271.0,
    272.3, 263.6, 255.0, 250.6, 253.1, 253.5, 251.3, 246.3, 241.7, 236.8, 232.1, 228.2, 223.4, 219.7, 215.3,
    211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6,
];

/// Absorption of ozone [cm⁻¹] at the same wavelengths.
const OZONE: [f64; 38] = [
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.003, 0.003, 0.006, 0.009, 0.014, 0.021, 0.030, 0.040, 0.048, 0.063,
    0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048, 0.036,
    0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009,
];

/// Ozone above us [cm at standard pressure].
const OZONE_COLUMN: f64 = 0.35;

/// Radiance of the disc of the sun at an elevation [rad] ≥ 0, in the unit of the sky: linear Rec. 709 of ∫ L(λ) x̄ȳz̄(λ) dλ
/// [W·m⁻²·sr⁻¹]. A channel that would be negative is 0.
pub fn radiance(elevation: f64, turbidity: f64) -> Rgb {
    let mass = air_mass(elevation);
    let haze = 0.046_08 * turbidity - 0.045_86;
    let mut xyz = [0.0; 3];
    for (i, (sun, ozone)) in SUN.iter().zip(OZONE).enumerate() {
        let nm = 380.0 + 10.0 * i as f64;
        let micrometres = 1e-3 * nm;
        let depth =
            0.008_735 * pow(micrometres, -4.08) + haze * pow(micrometres, -1.3) + ozone * OZONE_COLUMN;
        let light = 100.0 * sun * exp(-mass * depth) * 10.0;
        let seen = observer(nm);
        (0..3).for_each(|c| xyz[c] += light * seen[c]);
    }
    let [x, y, z] = xyz;
    let rgb = [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266_0 * x + 1.876_010_8 * y + 0.041_556_0 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ];
    Rgb(rgb.map(|c| c.max(0.0) as f32))
}

/// Air along the way in zenith heights of it (Kasten 1966).
fn air_mass(elevation: f64) -> f64 {
    1.0 / (antumbra_math::real::sin(elevation) + 0.15 * pow(elevation.to_degrees() + 3.885, -1.253))
}

/// x̄, ȳ, z̄ at a wavelength [nm].
fn observer(nm: f64) -> [f64; 3] {
    let lobe = |middle: f64, below: f64, above: f64| {
        let x = (nm - middle) * if nm < middle { below } else { above };
        exp(-0.5 * x * x)
    };
    [
        0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
            - 0.065 * lobe(501.1, 0.0490, 0.0382),
        0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
        1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 683 lm/W · Y · Ω: Iqbal's and Preetham's numbers give direct sunlight of about 100 klx at a high sun through clean
    /// air, and of about 130 klx outside of the atmosphere (illuminance constant of the sun: 127 to 134 klx).
    #[test]
    fn illuminance_of_the_sun() {
        let klux =
            |light: Rgb| 0.683 * f64::from(light.luminance()) * std::f64::consts::PI * 0.004_652 * 0.004_652;
        let high = klux(radiance(60f64.to_radians(), 2.5));
        assert!((90.0..110.0).contains(&high), "{high} klx");
        let low = klux(radiance(5f64.to_radians(), 2.5));
        assert!((5.0..20.0).contains(&low), "{low} klx");
    }

    /// Lower suns are redder and dimmer, hazier ones dimmer.
    #[test]
    fn a_low_sun_is_red() {
        let ratio = |e: f64| {
            let Rgb([r, _, b]) = radiance(e.to_radians(), 3.0);
            b / r
        };
        assert!(ratio(60.0) > ratio(20.0) && ratio(20.0) > ratio(5.0) && ratio(5.0) > ratio(1.0));
        assert!(radiance(0.5, 2.0).luminance() > radiance(0.5, 6.0).luminance());
        assert!(radiance(0.0, 10.0).0.iter().all(|c| c.is_finite() && *c >= 0.0));
    }
}
