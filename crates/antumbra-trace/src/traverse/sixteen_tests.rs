//! Sixteen lines at once say what the law says, where they say something: common origins and origins of their own, at
//! every level and scale; and they leave little open.

use fearless_simd::{Level, dispatch};

use super::*;
use crate::law::{self, Line};
use crate::level::SimdLevel;
use crate::traverse::ray::{FastLine, Limits};

use super::super::filter::rng::{Rng, amount, mix, to_f32, to_f64};

/// Sixteen lines and eight triangles that are hard for them.
struct Case {
    triangles: [[[f32; 3]; 3]; WIDTH],
    lines: [FastLine; PACKET],
}

fn case(r: &mut Rng, own: bool) -> Option<Case> {
    let s = libm::exp2(r.range(-100.0, 40.0).round());
    let size = libm::exp2(r.range(-8.0, 0.0).round());
    let centre = r.cube(1.0);
    let triangles = [0; WIDTH].map(|k| {
        let mut c = [r.cube(1.0), r.cube(1.0), r.cube(1.0)];
        if k % 3 == 0 {
            let (w, off) = (r.unit(), r.cube([1e-7, 1e-3][k % 2]));
            c[2] = [0, 1, 2].map(|a| c[0][a] + w * (c[1][a] - c[0][a]) + off[a]);
        }
        c.map(|p| to_f32([0, 1, 2].map(|a| s * (centre[a] + size * p[a]))))
    });
    let far = [1.0, 1.0, 1e3, 1e-3][r.below(4) as usize];
    let common = r.cube(2.0 * s * far).map(|x| if r.below(6) == 0 { 0.0 } else { x });
    let spread = s * [1.0, 1e-2, 1e-6][r.below(3) as usize];
    let lines = [0; PACKET].map(|_| {
        let aimed = triangles[r.below(8) as usize].map(to_f64);
        let target = match r.below(3) {
            0 => aimed[r.below(3) as usize],
            1 => mix([0.5, 0.5], [aimed[0], aimed[1]]),
            _ => mix(r.weights(), aimed),
        };
        let aside = if own { r.cube(spread) } else { [0.0; 3] };
        let o = [0, 1, 2].map(|a| common[a] + aside[a]);
        let length = libm::exp2(r.range(-30.0, 30.0));
        let d = [0, 1, 2].map(|a| (target[a] - o[a]) / s * length);
        let tmax = [f32::INFINITY, (s / length) as f32, (2.0 * s / length) as f32][r.below(3) as usize];
        FastLine { o: to_f32(o), d: to_f32(d), tmax }
    });
    let limits = Limits::of_scale(libm::exp2(40.0));
    let small = triangles.iter().flatten().flatten().all(|x| x.abs() <= libm::exp2f(40.0));
    (small && lines.iter().all(|line| limits.hold(line))).then_some(Case { triangles, lines })
}

/// What the filter says of every triangle.
#[inline(always)]
fn ask<S: Simd, const OWN: bool>(simd: S, case: &Case) -> [(u32, u32); WIDTH] {
    let column = |of: &dyn Fn(&FastLine) -> f32| f32x16::load_array(simd, case.lines.each_ref().map(of));
    let c = case.lines[0].o;
    let d = [0, 1, 2].map(|a| column(&|line| line.d[a]));
    let q = [0, 1, 2].map(|a| column(&|line| line.o[a]) - c[a]);
    let cross = |i: usize, j: usize| d[i].mul_sub(q[j], d[j] * q[i]) * 2.0;
    let m = [cross(1, 2), cross(2, 0), cross(0, 1)];
    let edge = column(&|line| line.d.iter().map(|c| c.abs()).sum::<f32>() * 1.00001 * (40.0 * U));
    let lines = Sixteen { d, q, m, bound: edge, tmax: column(&|line| line.tmax) };
    let far = q[0].abs().max(q[1].abs()).max(q[2].abs()).reduce_max();
    let seen = Seen::of::<S, OWN>(simd, &TriangleBlock::new(&case.triangles), V3::splat(simd, c), far);
    let mut lane = 0;
    [0; WIDTH].map(|_| {
        let met = lines.test::<OWN>(simd, &seen, lane, 0xffff);
        lane += 1;
        (met.hit, met.open)
    })
}

#[test]
fn certain_answers_are_the_laws() {
    let mut r = Rng::new(33);
    let (mut certain, mut open) = (0, 0);
    for round in 0..amount(6_000, 600_000) {
        let own = round % 2 == 0;
        let Some(case) = case(&mut r, own) else { continue };
        for level in SimdLevel::available() {
            let level = level.token().unwrap_or_else(Level::baseline);
            let said = dispatch!(level, simd => {
                if own { ask::<_, true>(simd, &case) } else { ask::<_, false>(simd, &case) }
            });
            for (corners, (hit, not)) in case.triangles.iter().zip(said) {
                for (k, line) in case.lines.iter().enumerate() {
                    if not >> k & 1 == 1 {
                        open += 1;
                        continue;
                    }
                    certain += 1;
                    let truth = law::triangle(&Line::ray(line.o, line.d, line.tmax), *corners).is_some();
                    assert_eq!(hit >> k & 1 == 1, truth, "{level:?} own {own} {line:?} {corners:?}");
                }
            }
        }
    }
    println!("{certain} certain answers, {open} open");
    assert!(certain > 500_000 && 2 * certain > open, "{certain}, {open}");
}
