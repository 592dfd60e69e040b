//! Complex indices of refraction of metals, η + ik, for Rec. 709.
//!
//! Measured spectra (Palik, "Handbook of Optical Constants of Solids"; SOPRA's tables for Ag, Al, Au, Cr, Cu, W) weighed
//! by the CIE 1931 observer, as published with Bitterli's renderer Tungsten; six digits.

use antumbra_math::Rgb;

/// η + ik of a metal, per component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// η.
    pub eta: Rgb,
    /// k, the absorption.
    pub k: Rgb,
}

/// Name, η, k.
type Row = (&'static str, [f32; 3], [f32; 3]);

const METALS: [Row; 20] = [
    ("Ag", [0.155_265, 0.116_723, 0.138_381], [4.828_343, 3.122_246, 2.146_95]),
    ("Al", [1.657_46, 0.880_369, 0.521_229], [9.223_869, 6.269_523, 4.837_001]),
    ("Au", [0.143_119, 0.374_957, 1.442_479], [3.983_16, 2.385_721, 1.603_215]),
    ("Be", [4.185_059, 3.185_06, 2.784_091], [3.835_44, 3.010_126, 2.869_009]),
    ("Cr", [4.369_683, 2.916_702, 1.654_701], [5.206_434, 4.231_365, 3.754_947]),
    ("Cu", [0.200_438, 0.924_033, 1.102_212], [3.912_949, 2.452_848, 2.142_188]),
    ("Hg", [2.398_931, 1.440_025, 0.909_551], [6.327_627, 4.371_941, 3.421_79]),
    ("Ir", [3.086_41, 2.082_194, 1.617_887], [5.592_151, 4.067_176, 3.267_261]),
    ("K", [0.064_049, 0.046_41, 0.038_184], [2.104_216, 1.348_936, 0.913_211]),
    ("Li", [0.265_787, 0.195_61, 0.220_92], [3.540_174, 2.311_131, 1.668_593]),
    ("Mo", [4.483_701, 3.525_458, 2.776_077], [4.111_131, 3.420_872, 3.150_603]),
    ("Na", [0.060_267, 0.056_141, 0.061_991], [3.179_291, 2.112_48, 1.579_094]),
    ("Nb", [3.420_135, 2.790_192, 2.395_586], [3.441_382, 2.737_644, 2.579_913]),
    ("Ni", [2.367_275, 1.663_358, 1.467_055], [4.498_833, 3.050_164, 2.345_427]),
    ("Rh", [2.585_795, 1.860_187, 1.554_428], [6.782_293, 4.702_95, 3.976_089]),
    ("Ta", [2.062_585, 2.393_092, 2.628_068], [2.408_047, 1.741_371, 1.947_038]),
    ("TiN", [1.648_469, 1.150_448, 1.379_78], [3.368_46, 1.943_489, 1.102_012]),
    ("V", [4.277_513, 3.513_154, 2.761_126], [3.491_184, 2.889_358, 3.111_697]),
    ("VN", [2.865_601, 2.119_182, 1.940_077], [3.032_326, 2.056_108, 1.616_293]),
    ("W", [4.370_703, 3.300_297, 2.998_267], [3.500_678, 2.604_865, 2.273_193]),
];

impl Metal {
    /// The metal of a chemical symbol (any case), as `"Au"`.
    pub fn named(name: &str) -> Option<Metal> {
        let row = METALS.iter().find(|(n, ..)| n.eq_ignore_ascii_case(name))?;
        Some(Metal { eta: Rgb(row.1), k: Rgb(row.2) })
    }

    /// The names that [`Metal::named`] knows.
    pub fn names() -> impl Iterator<Item = &'static str> {
        METALS.iter().map(|(name, ..)| *name)
    }

    /// The numbers that a light can meet: both finite and not negative, η above 0.
    pub fn is_possible(&self) -> bool {
        let fits = |x: &f32| (0.0..1e6).contains(x);
        self.eta.0.iter().all(|e| fits(e) && *e > 0.0) && self.k.0.iter().all(fits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::fresnel;

    #[test]
    fn metals_have_their_colours() {
        // Linear reflectance straight on (Akenine-Möller et al., "Real-Time Rendering", 4th edition, table 9.2). Its
        // spectra and primaries are not the same measurements: a twentieth apart at most.
        let published = [
            ("Au", [1.0, 0.782, 0.344]),
            ("Ag", [0.972, 0.960, 0.915]),
            ("Al", [0.913, 0.922, 0.924]),
            ("Cu", [0.955, 0.638, 0.538]),
        ];
        for (name, rgb) in published {
            let metal = Metal::named(name).unwrap();
            let told = fresnel::conductor(1.0, metal.eta, metal.k);
            for c in 0..3 {
                assert!((told.0[c] - rgb[c]).abs() < 0.05, "{name}: {told:?} {rgb:?}");
            }
        }
    }

    #[test]
    fn names_in_any_case() {
        assert_eq!(Metal::named("au"), Metal::named("Au"));
        assert!(Metal::named("gold").is_none() && Metal::names().count() == METALS.len());
        assert!(Metal::names().all(|n| Metal::named(n).is_some_and(|m| m.is_possible())));
    }
}
