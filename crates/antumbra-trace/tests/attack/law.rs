//! LAW §7.1 and §7.5: both stages of the law equal the truth, and the truth does not depend on how it is asked.

use antumbra_math::DVec3;
use antumbra_trace::law::{self, Line, Verdict};

use crate::cases::{Case, GENERATORS, Question, at_random_scale};
use crate::rng::{Rng, amount, to_f64};
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
