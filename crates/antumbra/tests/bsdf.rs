//! Laws of every kind of reflection, walked through `Bsdf::examples()`.

use antumbra::bsdf::Bsdf;
use antumbra::math::hash::{hash3, unit_f32};
use antumbra::math::{Local, Vec3, real};

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
