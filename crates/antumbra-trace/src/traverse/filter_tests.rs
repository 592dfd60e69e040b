//! LAW §7, attack 2: where the filter is certain it is right, plain and fused, at every scale that its conditions allow;
//! its errors stay below the proven parts of its bounds.

use fearless_simd::{Level, dispatch};

use super::*;
use crate::law::{self, Line};
use crate::level::SimdLevel;
use crate::traverse::ray::Limits;

use super::rng::{Rng, amount, mix, to_f32, to_f64};

/// Eight triangles and a line that is hard for them.
struct Case {
    triangles: [[[f32; 3]; 3]; 8],
    line: FastLine,
    exact: Line,
    placed: bool,
}

fn triangle(r: &mut Rng) -> [[f64; 3]; 3] {
    let c = [r.cube(1.0), r.cube(1.0), r.cube(1.0)];
    let thin = |r: &mut Rng, width: f64| {
        let (w, off) = (r.unit(), r.cube(width));
        [c[0], c[1], [0, 1, 2].map(|k| c[0][k] + w * (c[1][k] - c[0][k]) + off[k])]
    };
    match r.below(4) {
        0 => thin(r, 1e-7),
        1 => thin(r, 1e-3),
        2 => c.map(|p| p.map(|x| (4.0 * x).round())),
        _ => c,
    }
}

/// A case whose numbers lie around 2^k.
fn case(r: &mut Rng) -> Option<Case> {
    let k = r.range(-100.0, 40.0).round();
    let s = libm::exp2(k);
    let size = libm::exp2(r.range(-8.0, 0.0).round());
    let centre = r.cube(1.0);
    let triangles =
        [0; 8].map(|_| triangle(r).map(|p| to_f32([0, 1, 2].map(|a| s * (centre[a] + size * p[a])))));
    let aimed = triangles[r.below(8) as usize].map(to_f64);
    let target = match r.below(3) {
        0 => aimed[r.below(3) as usize],
        1 => mix([0.5, 0.5], [aimed[0], aimed[1]]),
        _ => mix(r.weights(), aimed),
    };
    let far = [1.0, 1.0, 1e3, 1e-3][r.below(4) as usize];
    let o = r.cube(2.0 * s * far).map(|x| if r.below(6) == 0 { 0.0 } else { x });
    let length = libm::exp2(r.range(-30.0, 30.0));
    let d = [0, 1, 2].map(|a| (target[a] - o[a]) / s * length);
    let tmax = [f32::INFINITY, (s / length) as f32, (2.0 * s / length) as f32][r.below(3) as usize];
    let (o32, d32) = (to_f32(o), to_f32(d));
    let placed = r.below(3) == 0;
    // An instance's line in f64 that f32 only rounds; t on both is the same parameter.
    let (line, exact) = if placed {
        let turn = antumbra_math::Transform {
            linear: antumbra_math::DMat3::from_rotation_y(r.range(0.0, 6.0)),
            translation: antumbra_math::DVec3::from_array(r.cube(s)),
        };
        let exact = Line::ray(o32, d32, tmax).to_object(&turn);
        (FastLine::of_line(&exact, tmax)?, exact)
    } else {
        (FastLine { o: o32, d: d32, tmax }, Line::ray(o32, d32, tmax))
    };
    // The conditions of the filter alone: sizes, not the distance in units of the tree.
    let holds = Limits::of_scale(libm::exp2(40.0)).hold(&line) && exact.is_valid();
    let small = triangles.iter().flatten().flatten().all(|x| x.abs() <= libm::exp2f(40.0));
    (holds && small).then_some(Case { triangles, line, exact, placed })
}

/// What the filter says at one level: verdict, interval of t, and its largest error/bound for edges, V, D.
fn ask(level: SimdLevel, case: &Case, block: &TriangleBlock) -> (Verdict, Interval, [f64; 3]) {
    let level = level.token().unwrap_or_else(Level::baseline);
    dispatch!(level, simd => {
        if case.placed { probe::<_, true>(simd, case, block) } else { probe::<_, false>(simd, case, block) }
    })
}

#[inline(always)]
fn probe<S: Simd, const PLACED: bool>(
    simd: S,
    case: &Case,
    block: &TriangleBlock,
) -> (Verdict, Interval, [f64; 3]) {
    let ray = TriangleRay::new(simd, &case.line, PLACED);
    let edges = Edges::of::<PLACED>(simd, block, &ray);
    let sides = Sides::of::<PLACED>(simd, block, &ray);
    let along = Along::of::<PLACED>(simd, &sides, &ray);
    let mut worst = [0f64; 3];
    for lane in 0..WIDTH {
        let truth = crate::traverse::measure::numbers(simd, (&case.exact.o, &case.exact.d), block, lane);
        let bound = f64::from(edges.bound.to_array()[lane]);
        for i in 0..3 {
            let error = (f64::from(edges.w[i].to_array()[lane]) - truth.edges.w[i]).abs();
            worst[0] = worst[0].max((error - truth.edges.b[i]) / bound);
        }
        let of = |value: f32x8<S>, bound: f32x8<S>, (x, b): (f64, f64)| {
            ((f64::from(value.to_array()[lane]).abs() - x.abs()).abs() - b)
                / f64::from(bound.to_array()[lane])
        };
        worst[1] = worst[1].max(of(along.sv, along.bv, truth.v));
        worst[2] = worst[2].max(of(along.size, along.bd, truth.det));
    }
    let (verdict, t) = filter_with_t::<S, PLACED>(simd, block, &ray, case.line.tmax);
    assert_eq!(verdict, filter::<S, PLACED>(simd, block, &ray, case.line.tmax));
    (verdict, t, worst)
}

#[test]
fn certain_answers_are_the_laws() {
    let mut r = Rng::new(21);
    let mut worst = [0f64; 3];
    let mut certain = 0;
    for _ in 0..amount(60_000, 3_000_000) {
        let Some(case) = case(&mut r) else { continue };
        let block = TriangleBlock::new(&case.triangles);
        for level in SimdLevel::available() {
            let (verdict, t, errors) = ask(level, &case, &block);
            for k in 0..3 {
                worst[k] = worst[k].max(errors[k]);
            }
            for (lane, &corners) in case.triangles.iter().enumerate() {
                if verdict.open >> lane & 1 == 1 {
                    continue;
                }
                certain += 1;
                let says = (verdict.hit >> lane & 1 == 1).then(|| (t.from[lane], t.to[lane]));
                let truth = law::triangle(&case.exact, corners);
                assert_eq!(says.is_some(), truth.is_some(), "{level:?} {:?} {corners:?}", case.exact);
                if let (Some((from, to)), Some(t)) = (says, truth) {
                    assert!(f64::from(from) <= t && t <= f64::from(to), "{from} {t} {to} at {level:?}");
                }
            }
        }
    }
    println!(
        "{certain} certain answers; largest error/bound: edges {:.2}, V {:.2}, D {:.2}",
        worst[0], worst[1], worst[2]
    );
    assert!(certain > 500_000);
    // Proved: 36 of 40, 8 of 12, 8 of 12 (LAW §4).
    assert!(worst[0] <= 0.9 && worst[1] <= 0.67 && worst[2] <= 0.67, "{worst:?}");
}
