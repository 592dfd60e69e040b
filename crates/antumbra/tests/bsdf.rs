//! Laws of every kind of reflection, walked through `Bsdf::examples()`.

use antumbra::bsdf::{Bsdf, Mirror};
use antumbra::math::hash::{hash3, unit_f32};
use antumbra::math::{Local, Rgb, Vec3, real};

/// The direction of polar cosine `cos` and azimuth `phi`.
fn direction(cos: f32, phi: f32) -> Local {
    let r = real::safe_sqrt((1.0 - cos) * (1.0 + cos));
    Local(Vec3::new(r * real::cosf(phi), r * real::sinf(phi), cos))
}

/// Cosines from straight on down to the last bits above the horizon.
const COSINES: [f32; 12] = [1.0, 0.999_999, 0.99, 0.8, 0.5, 0.2, 0.05, 1e-2, 1e-3, 1e-5, 1e-7, 1e-30];

fn pairs() -> impl Iterator<Item = (Local, Local)> {
    let to = COSINES.into_iter().flat_map(|c| [0.0, 1.0, 3.0, real::PI].map(|phi| direction(c, phi)));
    COSINES.into_iter().flat_map(move |c| to.clone().map(move |wi| (direction(c, 0.0), wi)))
}

fn numbers(i: u32, seed: u32) -> [f32; 3] {
    [0, 1, 2].map(|k| unit_f32(hash3(i, k, seed)))
}

#[test]
fn reciprocity() {
    for (name, bsdf) in Bsdf::examples() {
        for (wo, wi) in pairs() {
            let (a, b) = (bsdf.eval(wo, wi), bsdf.eval(wi, wo));
            for c in 0..3 {
                // Products in another order: a few roundings.
                let tolerance = 4.0 * f32::EPSILON * a.0[c].max(b.0[c]);
                assert!((a.0[c] - b.0[c]).abs() <= tolerance, "{name} {bsdf:?} {wo:?} {wi:?}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn finite_and_never_negative_down_to_the_horizon() {
    for (name, bsdf) in Bsdf::examples() {
        for (wo, wi) in pairs() {
            let (f, p) = (bsdf.eval(wo, wi), bsdf.pdf(wo, wi));
            let told = || format!("{name} {bsdf:?} {wo:?} {wi:?}: {f:?} {p}");
            assert!(f.is_finite() && f.0.iter().all(|&c| c >= 0.0), "{}", told());
            assert!(p.is_finite() && p >= 0.0, "{}", told());
        }
    }
}

#[test]
fn nothing_below_the_horizon() {
    for (name, bsdf) in Bsdf::examples() {
        for (wo, wi) in pairs() {
            for (a, b) in [(Local(-wo.0), wi), (wo, Local(-wi.0)), (Local(-wo.0), Local(-wi.0))] {
                assert!(bsdf.eval(a, b).is_black() && bsdf.pdf(a, b) == 0.0, "{name} {bsdf:?} {a:?} {b:?}");
            }
            assert!(bsdf.sample(Local(-wo.0), [0.5; 3]).is_none());
        }
    }
}

#[test]
fn samples_carry_what_eval_and_pdf_say() {
    for (name, bsdf) in Bsdf::examples() {
        for cos in COSINES {
            let wo = direction(cos, 0.7);
            for i in 0..500 {
                let Some(s) = bsdf.sample(wo, numbers(i, 11)) else { continue };
                let told = || format!("{name} {bsdf:?} {wo:?} {s:?}");
                assert!(s.throughput.is_finite() && s.throughput.0.iter().all(|&c| c >= 0.0), "{}", told());
                // A few roundings of the components.
                assert!((s.wi.0.length() - 1.0).abs() < 1e-6 && s.wi.cos() > 0.0, "{}", told());
                assert_eq!(s.density.is_delta(), bsdf.is_delta(), "{}", told());
                if bsdf.is_delta() {
                    continue;
                }
                let pdf = bsdf.pdf(wo, s.wi);
                assert!(pdf > 0.0 && (s.density.weight() - pdf).abs() <= 1e-5 * pdf, "{}", told());
                let expected = bsdf.eval(wo, s.wi) * (s.wi.cos() / pdf);
                for c in 0..3 {
                    let (a, b) = (s.throughput.0[c], expected.0[c]);
                    assert!((a - b).abs() <= 1e-5 * a.max(b), "{} eval says {expected:?}", told());
                }
            }
        }
    }
}

/// Any bits that make a direction: from the pole to the horizon, with tiny and subnormal components.
fn any_direction(i: u32, seed: u32) -> Local {
    let part = |k: u32| {
        let h = hash3(i, k, seed);
        let scale = [1.0, 1e-3, 1e-7, 1e-20, 1e-40, 0.0][(h % 6) as usize];
        (2.0 * unit_f32(hash3(i, k, seed + 1)) - 1.0) * scale
    };
    Local(Vec3::new(part(0), part(1), part(2).abs()).normalize_or(Vec3::Z))
}

#[test]
fn no_direction_and_no_number_breaks_a_kind() {
    let ends = [0.0, 1e-30, 0.5, real::ONE_MINUS];
    for (name, bsdf) in Bsdf::examples() {
        for i in 0..20_000 {
            let (wo, wi) = (any_direction(i, 1), any_direction(i, 3));
            let (f, p) = (bsdf.eval(wo, wi), bsdf.pdf(wo, wi));
            assert!(f.is_finite() && p.is_finite(), "{name} {bsdf:?} {wo:?} {wi:?}: {f:?} {p}");
            let u = [0, 1, 2].map(|k| ends[(hash3(i, k, 5) % 4) as usize]);
            let Some(s) = bsdf.sample(wo, u) else { continue };
            let sane = s.throughput.is_finite() && s.density.weight().is_finite() && s.wi.0.is_finite();
            assert!(sane && s.wi.cos() > 0.0, "{name} {bsdf:?} {wo:?} {u:?}: {s:?}");
        }
    }
}

#[test]
fn a_mirror_answers_with_one_direction() {
    let bsdf = Bsdf::Mirror(Mirror { reflectance: Rgb([0.9, 0.5, 0.1]) });
    for cos in COSINES {
        let wo = direction(cos, 2.0);
        for i in 0..10 {
            let s = bsdf.sample(wo, numbers(i, 3)).expect("a mirror reflects from everywhere above");
            assert_eq!((s.wi, s.throughput), (wo.mirrored(), Rgb([0.9, 0.5, 0.1])));
            assert!(s.density.is_delta());
        }
        assert!(bsdf.eval(wo, wo.mirrored()).is_black() && bsdf.pdf(wo, wo.mirrored()) == 0.0);
    }
}
