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

/// The pairs that a kind is asked: above the surface; for those that let light through, on every side.
fn pairs_of(bsdf: &Bsdf) -> impl Iterator<Item = (Local, Local)> + use<> {
    let sides: &[[f32; 2]] = match bsdf.index_below() {
        None => &[[1.0, 1.0]],
        Some(_) => &[[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]],
    };
    let onto = |w: Local, side: f32| Local(Vec3::new(w.0.x, w.0.y, w.0.z * side));
    pairs().flat_map(move |(wo, wi)| sides.iter().map(move |s| (onto(wo, s[0]), onto(wi, s[1]))))
}

/// n² on the side of a direction, over that above the surface.
fn n2(bsdf: &Bsdf, w: Local) -> f32 {
    let n = bsdf.index_below().filter(|_| w.cos() < 0.0).unwrap_or(1.0);
    n * n
}

#[test]
fn reciprocity() {
    for (name, bsdf) in Bsdf::examples() {
        for (wo, wi) in pairs_of(&bsdf) {
            let (a, b) = (bsdf.eval(wo, wi) * n2(&bsdf, wi), bsdf.eval(wi, wo) * n2(&bsdf, wo));
            for c in 0..3 {
                // Products in another order: a few roundings. A half vector is known to a few ε over the smallest α;
                // through a boundary it is a difference, and Snell's law makes the loss worse at grazing angles.
                // Where it is seen edge-on, f vanishes with ω·m, which is known to ε.
                let (roundings, edge) = if wo.same_side(wi) { (32.0, 0.0) } else { (4096.0, 1e-6) };
                let tolerance = roundings * f32::EPSILON * a.0[c].max(b.0[c]) + edge;
                assert!((a.0[c] - b.0[c]).abs() <= tolerance, "{name} {bsdf:?} {wo:?} {wi:?}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn finite_and_never_negative_down_to_the_horizon() {
    for (name, bsdf) in Bsdf::examples() {
        for (wo, wi) in pairs_of(&bsdf) {
            let (f, p) = (bsdf.eval(wo, wi), bsdf.pdf(wo, wi));
            let told = || format!("{name} {bsdf:?} {wo:?} {wi:?}: {f:?} {p}");
            assert!(f.is_finite() && f.0.iter().all(|&c| c >= 0.0), "{}", told());
            assert!(p.is_finite() && p >= 0.0, "{}", told());
        }
    }
}

#[test]
fn nothing_below_the_horizon_but_through_glass() {
    for (name, bsdf) in Bsdf::examples().into_iter().filter(|(_, b)| b.index_below().is_none()) {
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
        let below = bsdf.index_below().map(|_| COSINES.map(|c| -c));
        for cos in COSINES.into_iter().chain(below.into_iter().flatten()) {
            let wo = Local(direction(cos.abs(), 0.7).0 * Vec3::new(1.0, 1.0, cos.signum()));
            for i in 0..500 {
                let Some(s) = bsdf.sample(wo, numbers(i, 11)) else { continue };
                let told = || format!("{name} {bsdf:?} {wo:?} {s:?}");
                assert!(s.throughput.is_finite() && s.throughput.0.iter().all(|&c| c >= 0.0), "{}", told());
                // A few roundings of the components.
                assert!((s.wi.0.length() - 1.0).abs() < 1e-6 && on_its_side(&bsdf, s.wi), "{}", told());
                let both = bsdf.has_single_directions() && !bsdf.is_delta();
                assert!(both || s.density.is_delta() == bsdf.is_delta(), "{}", told());
                if s.density.is_delta() {
                    continue;
                }
                let pdf = bsdf.pdf(wo, s.wi);
                assert!(pdf > 0.0 && (s.density.weight() - pdf).abs() <= 1e-5 * pdf, "{}", told());
                let expected = bsdf.eval(wo, s.wi) * (s.wi.cos().abs() / pdf);
                for c in 0..3 {
                    let (a, b) = (s.throughput.0[c], expected.0[c]);
                    assert!((a - b).abs() <= 1e-5 * a.max(b), "{} eval says {expected:?}", told());
                }
            }
        }
    }
}

/// A direction that the kind may send light into.
fn on_its_side(bsdf: &Bsdf, wi: Local) -> bool {
    wi.cos() > 0.0 || (bsdf.index_below().is_some() && wi.cos() < 0.0)
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
            let (wo, mut wi) = (any_direction(i, 1), any_direction(i, 3));
            if bsdf.index_below().is_some() && i % 2 == 1 {
                wi.0.z = -wi.0.z;
            }
            let (f, p) = (bsdf.eval(wo, wi), bsdf.pdf(wo, wi));
            assert!(f.is_finite() && p.is_finite(), "{name} {bsdf:?} {wo:?} {wi:?}: {f:?} {p}");
            let u = [0, 1, 2].map(|k| ends[(hash3(i, k, 5) % 4) as usize]);
            let Some(s) = bsdf.sample(wo, u) else { continue };
            let sane = s.throughput.is_finite() && s.density.weight().is_finite() && s.wi.0.is_finite();
            assert!(sane && on_its_side(&bsdf, s.wi), "{name} {bsdf:?} {wo:?} {u:?}: {s:?}");
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
