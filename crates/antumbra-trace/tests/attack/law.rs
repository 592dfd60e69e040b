//! LAW §7.1 and §7.5: both stages of the law equal the truth, and the truth does not depend on how it is asked.

use antumbra_math::{DMat3, DVec3, Transform};
use antumbra_trace::Shape;
use antumbra_trace::law::{self, Line, Verdict};

use crate::cases::{Case, ExactExp2, GENERATORS, Question, at_random_scale};
use crate::rng::{Rng, amount, mix, to_f64};
use crate::truth::{Crossing, ExactLine, To, crossing};

pub fn line_of(case: &Case) -> Line {
    let world = case.question.line();
    case.object_from_world.as_ref().map_or(world, |m| world.to_object(m))
}

/// The truth of a case, from its own numbers.
fn truth(case: &Case) -> Option<Crossing> {
    let map = case.object_from_world;
    let point = |p: [f32; 3]| map.map_or(to_f64(p), |m| m.point(DVec3::from_array(to_f64(p))).to_array());
    let vector = |d: [f32; 3]| map.map_or(to_f64(d), |m| m.vector(DVec3::from_array(to_f64(d))).to_array());
    let line = match case.question {
        Question::Segment { p, q } => ExactLine { o: point(p), to: To::Point(point(q)), tmax: 1.0 },
        Question::Ray { o, d, tmax } => {
            ExactLine { o: point(o), to: To::Direction(vector(d)), tmax: tmax.into() }
        }
    };
    crossing(&line, case.corners)
}

#[test]
fn both_stages_equal_the_truth() {
    for (seed, (name, generate)) in GENERATORS.iter().enumerate() {
        let mut r = Rng::new(seed as u64 + 1);
        let (mut hits, mut open) = (0, 0);
        for i in 0..amount(15_000, 3_500_000) {
            let case = at_random_scale(generate(&mut r), &mut r);
            let line = line_of(&case);
            if !line.is_valid() {
                assert_eq!(law::triangle(&line, case.corners), None);
                continue;
            }
            let truth = truth(&case);
            let corners = case.corners.map(to_f64);
            let close = |t: f64| truth.as_ref().is_some_and(|c| t <= line.tmax && c.is_close(t, 29));
            let first = law::stage1(&line, corners);
            let stage1_right = match first {
                Verdict::Miss => truth.is_none(),
                Verdict::Hit(t) => close(t),
                Verdict::HitSomewhere => truth.is_some(),
                Verdict::Open => true,
            };
            assert!(stage1_right, "{name} {i}: stage 1 says {first:?} of {case:?}");
            let second = law::stage2(&line, corners);
            assert!(second.map_or(truth.is_none(), close), "{name} {i}: stage 2 says {second:?} of {case:?}");
            hits += usize::from(truth.is_some());
            open += usize::from(first == Verdict::Open);
        }
        assert!(hits > 100, "{name}: {hits} hits are no attack");
        println!("{name}: {hits} hits, {open} left open by stage 1");
    }
}

/// Calls `check` with cases of every generator.
fn for_cases(seed: u64, small: usize, large: usize, mut check: impl FnMut(&str, Case, &mut Rng)) {
    for (i, (name, generate)) in GENERATORS.iter().enumerate() {
        let mut r = Rng::new(seed + i as u64);
        for _ in 0..amount(small, large) {
            let case = at_random_scale(generate(&mut r), &mut r);
            check(name, case, &mut r);
        }
    }
}

fn is_hit(case: &Case) -> bool {
    law::blocks(&line_of(case), case.corners)
}

#[test]
fn both_questions_have_one_answer() {
    for_cases(50, 3000, 100_000, |name, case, _| {
        let line = line_of(&case);
        assert_eq!(is_hit(&case), law::triangle(&line, case.corners).is_some(), "{name} {case:?}");
    });
}

#[test]
fn order_of_corners_does_not_matter() {
    for_cases(100, 5000, 500_000, |name, case, _| {
        let [a, b, c] = case.corners;
        let want = is_hit(&case);
        for corners in [[b, c, a], [c, a, b], [c, b, a], [b, a, c], [a, c, b]] {
            assert_eq!(is_hit(&Case { corners, ..case }), want, "{name} {case:?}");
        }
    });
}

#[test]
fn ends_of_a_segment_can_be_swapped() {
    for_cases(200, 10_000, 500_000, |name, case, _| {
        if let Question::Segment { p, q } = case.question {
            let swapped = Case { question: Question::Segment { p: q, q: p }, ..case };
            assert_eq!(is_hit(&case), is_hit(&swapped), "{name} {case:?}");
        }
    });
}

#[test]
fn powers_of_two_change_nothing() {
    for_cases(300, 5000, 500_000, |name, case, r| {
        if case.object_from_world.is_some() {
            return;
        }
        let power = |r: &mut Rng| (r.below(41) as f32 - 20.0).exp2_exact();
        let s = power(r);
        if !case.is_exact_times(s) {
            return;
        }
        let corners = case.corners.map(|v| v.map(|x| x * s));
        let scaled = Case { corners, question: case.question.scaled(s), ..case };
        assert_eq!(is_hit(&case), is_hit(&scaled), "{name} times {s}: {case:?}");
        let c = power(r);
        if let Question::Ray { o, d, tmax } = case.question
            && d.iter().all(|x| x * c / c == *x)
        {
            let question = Question::Ray { o, d: d.map(|x| x * c), tmax: tmax / c };
            assert_eq!(is_hit(&case), is_hit(&Case { question, ..case }), "{name} d times {c}: {case:?}");
        }
    });
}

#[test]
fn nothing_behind_the_start_is_hit() {
    // T3 with m = the z axis.
    for_cases(400, 5000, 500_000, |name, case, r| {
        let Question::Ray { o, d, tmax } = case.question else { return };
        let height = case.corners.iter().fold(f32::MIN, |m, c| m.max(c[2])).next_up();
        let d = [d[0], d[1], if r.below(3) == 0 { 0.0 } else { d[2].abs() }];
        let case = Case { question: Question::Ray { o: [o[0], o[1], height], d, tmax }, ..case };
        assert!(case.object_from_world.is_some() || !is_hit(&case), "{name} {case:?}");
    });
}

#[test]
fn a_grazing_sliver_that_an_epsilon_law_hits_is_missed() {
    let big = 1.0 + 2f32.powi(-21);
    let corners = [[0.0; 3], [1.0; 3], [0.5 + 2f32.powi(-23), 0.5, 0.5]];
    assert!(!law::blocks(&Line::ray([big, big, -15.0], [0.0, 0.0, 1.0], f32::INFINITY), corners));
}

#[test]
fn weights_give_the_point_of_the_hit() {
    for_cases(500, 5000, 200_000, |name, case, _| {
        let line = line_of(&case);
        let Some(t) = law::triangle(&line, case.corners) else { return };
        let [u, v] = law::barycentrics(&line, case.corners);
        assert!(u >= 0.0 && v >= 0.0 && u + v <= 1.0, "{name} {u} {v} {case:?}");
        let corners = case.corners.map(to_f64);
        let at = mix([1.0 - f64::from(u) - f64::from(v), u.into(), v.into()], corners);
        for k in 0..3 {
            let size = corners.iter().fold(0f64, |m, c| m.max(c[k].abs()));
            // Weights: two roundings to f32 and 1 - u, each 2^-24 of a corner; t: 2^-29 of the way from the origin,
            // once more in the sum.
            let tolerance = size * 4.0 * 2f64.powi(-24) + (t * line.d[k]).abs() * 2f64.powi(-28);
            let off = at[k] - (line.o[k] + t * line.d[k]);
            assert!(off.abs() <= tolerance, "{name}: off by {off}, allowed {tolerance}, {case:?}");
        }
    });
}

#[test]
fn an_invalid_line_hits_nothing() {
    let corners = [[-1.0, -1.0, 1.0], [3.0, -1.0, 1.0], [-1.0, 3.0, 1.0]];
    let (o, up, inf, nan) = ([0f32; 3], [0.0, 0.0, 1.0], f32::INFINITY, f32::NAN);
    assert!(law::blocks(&Line::ray(o, up, inf), corners));
    let lines = [
        Line::segment(o, o),
        Line::segment([nan, 0.0, 0.0], up),
        Line::segment(o, [0.0, inf, 1.0]),
        Line::ray(o, [0.0; 3], inf),
        Line::ray(o, [0.0, nan, 1.0], inf),
        Line::ray(o, [0.0, 0.0, inf], inf),
        Line::ray([0.0, -inf, 0.0], up, inf),
        Line::ray(o, up, nan),
        Line::ray(o, up, 0.0),
        Line::ray(o, up, -2.0),
    ];
    for line in lines {
        assert!(!line.is_valid() && !law::blocks(&line, corners), "{line:?}");
        assert_eq!(law::triangle(&line, corners), None, "{line:?}");
        assert_eq!(law::shape(&line, &Shape::Sphere { center: [0.0; 3], radius: 0.5 }), None, "{line:?}");
        assert!(!line.to_object(&Transform::IDENTITY).is_valid());
    }
    let overflow = Transform { linear: DMat3::IDENTITY * 1e300, translation: DVec3::ZERO };
    assert!(!Line::ray(o, up, inf).to_object(&overflow).is_valid());
}
