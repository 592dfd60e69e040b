//! Adversarial pairs of a line and a triangle: the cases in which visibility code goes wrong.

use antumbra_math::{DMat3, DVec3, Transform};
use antumbra_trace::law::Line;

use crate::rng::{Rng, cross, mix, to_f32, to_f64, unit};

/// A question in world numbers.
#[derive(Clone, Copy, Debug)]
pub enum Question {
    Segment { p: [f32; 3], q: [f32; 3] },
    Ray { o: [f32; 3], d: [f32; 3], tmax: f32 },
}

impl Question {
    pub fn line(&self) -> Line {
        match *self {
            Question::Segment { p, q } => Line::segment(p, q),
            Question::Ray { o, d, tmax } => Line::ray(o, d, tmax),
        }
    }

    pub fn scaled(&self, s: f32) -> Question {
        let by = |v: [f32; 3]| v.map(|x| x * s);
        match *self {
            Question::Segment { p, q } => Question::Segment { p: by(p), q: by(q) },
            Question::Ray { o, d, tmax } => Question::Ray { o: by(o), d: by(d), tmax },
        }
    }
}

/// A question to a triangle, which an instance may have placed.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub corners: [[f32; 3]; 3],
    pub question: Question,
    pub object_from_world: Option<Transform>,
}

impl Case {
    /// No number of the case loses a bit when it is multiplied by `s` (none becomes subnormal).
    pub fn is_exact_times(&self, s: f32) -> bool {
        let (p, q) = match self.question {
            Question::Segment { p, q } => (p, q),
            Question::Ray { o, d, .. } => (o, d),
        };
        self.corners.iter().flatten().chain(&p).chain(&q).all(|x| x * s / s == *x)
    }
}

/// A generator of cases.
pub type Generator = fn(&mut Rng) -> Case;

/// All of them, by name.
pub const GENERATORS: [(&str, Generator); 10] = [
    ("soup", soup),
    ("aimed", aimed),
    ("coplanar", coplanar),
    ("sliver", sliver),
    ("far", far),
    ("lattice", lattice),
    ("mixed exponents", mixed_exponents),
    ("instance", instance),
    ("exact instance", exact_instance),
    ("end on triangle", end_on_triangle),
];

/// The same case at a scale of 10⁻⁶..10⁶, by one multiplication of every number (its own rounding included).
pub fn at_random_scale(case: Case, r: &mut Rng) -> Case {
    if case.object_from_world.is_some() || r.below(2) == 0 {
        return case;
    }
    let s = r.signed_power(-6.0, 6.0).abs() as f32;
    Case { corners: case.corners.map(|c| c.map(|x| x * s)), question: case.question.scaled(s), ..case }
}

fn flat(corners: [[f32; 3]; 3], question: Question) -> Case {
    Case { corners, question, object_from_world: None }
}

/// From o towards (or to) a point near `target`: as a ray or a segment, its end before, behind or at the target.
fn question(o: [f64; 3], target: [f64; 3], r: &mut Rng) -> Question {
    let o = to_f32(o);
    let s = [1.0, 1.0, 0.999, 1.001, 2.0, 0.5][r.below(6) as usize];
    let end = mix([1.0 - s, s], [to_f64(o), target]).map(|x| r.nudge(x as f32));
    if r.below(2) == 0 {
        return Question::Segment { p: o, q: end };
    }
    let d = [0, 1, 2].map(|k| end[k] - o[k]);
    let tmax = [f32::INFINITY, 1.0, 1.0 / s as f32, 3.0, 1e-3][r.below(5) as usize];
    Question::Ray { o, d, tmax }
}

fn random_corners(r: &mut Rng) -> [[f32; 3]; 3] {
    [0; 3].map(|_| to_f32(r.cube(1.0)))
}

fn point_on(corners: [[f32; 3]; 3], r: &mut Rng) -> [f64; 3] {
    mix(r.weights(), corners.map(to_f64))
}

/// No relation between the line and the triangle.
pub fn soup(r: &mut Rng) -> Case {
    let (o, target) = (r.cube(2.0), r.cube(2.0));
    flat(random_corners(r), question(o, target, r))
}

/// Aimed at a corner, an edge or a face point, some by ±2 ulp beside it.
pub fn aimed(r: &mut Rng) -> Case {
    let corners = random_corners(r);
    let (o, target) = (r.cube(3.0), point_on(corners, r));
    flat(corners, question(o, target, r))
}

/// In the plane of the triangle, or 10⁻¹⁰ beside it.
pub fn coplanar(r: &mut Rng) -> Case {
    let corners = random_corners(r);
    let [a, b, c] = corners.map(to_f64);
    let n = cross(mix([1.0, -1.0], [b, a]), mix([1.0, -1.0], [c, a]));
    let (u, v) = (r.range(-3.0, 3.0), r.range(-3.0, 3.0));
    let height = [0.0, 1e-10, -1e-10, 1e-7, -1e-7][r.below(5) as usize];
    let o = mix([1.0 - u - v, u, v, height], [a, b, c, n]);
    let target = point_on(corners, r);
    flat(corners, question(o, target, r))
}

/// A triangle of width 10⁻¹ to 10⁻⁹ or of no width, aimed at.
pub fn sliver(r: &mut Rng) -> Case {
    let (a, b) = (r.cube(1.0), r.cube(1.0));
    let u = r.range(-0.2, 1.2);
    let width = if r.below(8) == 0 { 0.0 } else { r.signed_power(-9.0, -1.0) };
    let c = mix([1.0 - u, u, width], [a, b, r.direction()]);
    let corners = [a, b, c].map(to_f32);
    let (o, target) = (r.cube(3.0), point_on(corners, r));
    flat(corners, question(o, target, r))
}

/// An origin up to 10⁵ away.
pub fn far(r: &mut Rng) -> Case {
    let corners = random_corners(r);
    let o = r.direction().map(|x| x * r.signed_power(0.0, 5.0));
    let target = point_on(corners, r);
    flat(corners, question(o, target, r))
}

/// Everything an integer of [−4, 4]: exact coincidences of every kind.
pub fn lattice(r: &mut Rng) -> Case {
    let mut point = || [0; 3].map(|_| r.below(9) as f32 - 4.0);
    let corners = [point(), point(), point()];
    let (o, end) = (point(), point());
    let tmax = [f32::INFINITY, 1.0, 0.5, 2.0][r.below(4) as usize];
    let ray = Question::Ray { o, d: end, tmax };
    flat(corners, if r.below(2) == 0 { ray } else { Question::Segment { p: o, q: end } })
}

/// Every number with an exponent of its own, 2⁻⁴⁵ to 2²⁵.
pub fn mixed_exponents(r: &mut Rng) -> Case {
    let mut point = || {
        [0; 3].map(|_| {
            let mantissa = r.range(-2.0, 2.0) as f32;
            let exponent = r.below(71) as i32 - 45;
            if r.below(10) == 0 { 0.0 } else { mantissa * (exponent as f32).exp2_exact() }
        })
    };
    let corners = [point(), point(), point()];
    let (o, random_end) = (point(), point());
    let target = if r.below(2) == 0 { to_f64(random_end) } else { point_on(corners, r) };
    flat(corners, question(to_f64(o), target, r))
}

/// The triangle stands in an object that is rotated, scaled (also mirrored) and moved.
pub fn instance(r: &mut Rng) -> Case {
    let corners = random_corners(r);
    let x = r.direction();
    let y = unit(cross(x, r.direction()));
    let scale = [0; 3].map(|_| r.signed_power(-2.0, 2.0));
    let rotation = DMat3::from_cols_array_2d(&[x, y, cross(x, y)]);
    let linear = rotation * DMat3::from_diagonal(DVec3::from_array(scale));
    let shift = r.signed_power(-2.0, 3.0);
    let world_from_object = Transform { linear, translation: DVec3::from_array(r.cube(shift)) };
    let world = |p: [f64; 3]| world_from_object.point(DVec3::from_array(p)).to_array();
    let (o, target) = (world(r.cube(3.0)), world(point_on(corners, r)));
    Case { corners, question: question(o, target, r), object_from_world: world_from_object.inverse() }
}

/// An object turned by quarters, mirrored, scaled by powers of two and moved by whole numbers: coincidences survive
/// the map, which is exact.
pub fn exact_instance(r: &mut Rng) -> Case {
    let case = if r.below(2) == 0 { lattice(r) } else { end_on_triangle(r) };
    let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
    axes.swap(r.below(3) as usize, r.below(3) as usize);
    let linear = axes.map(|axis| {
        let size = f64::from((r.below(41) as f32 - 20.0).exp2_exact());
        if r.below(2) == 0 { axis * size } else { axis * -size }
    });
    let translation = DVec3::from_array([0; 3].map(|_| r.below(9) as f64 - 4.0));
    let object_from_world =
        Transform { linear: DMat3::from_cols_array_2d(&linear.map(|c| c.to_array())), translation };
    // The question is asked where the map brings it back to the lattice.
    let Some(world) = object_from_world.inverse() else { return case };
    let point = |p: [f32; 3]| to_f32(world.point(DVec3::from_array(to_f64(p))).to_array());
    let vector = |d: [f32; 3]| to_f32(world.vector(DVec3::from_array(to_f64(d))).to_array());
    let question = match case.question {
        Question::Segment { p, q } => Question::Segment { p: point(p), q: point(q) },
        Question::Ray { o, d, tmax } => Question::Ray { o: point(o), d: vector(d), tmax },
    };
    Case { question, object_from_world: Some(object_from_world), ..case }
}

/// One end is a corner of the triangle or a point of its plane's lattice: the open ends of the interval.
pub fn end_on_triangle(r: &mut Rng) -> Case {
    let mut point = || [0; 3].map(|_| r.below(9) as f32 - 4.0);
    let corners = [point(), point(), point()];
    let (on, off) = (corners[0], point());
    let middle = [0, 1, 2].map(|k| (corners[1][k] + corners[2][k]) / 2.0);
    let on = if r.below(2) == 0 { on } else { middle };
    let question = match r.below(3) {
        0 => Question::Segment { p: on, q: off },
        1 => Question::Segment { p: off, q: on },
        _ => Question::Ray { o: off, d: [0, 1, 2].map(|k| on[k] - off[k]), tmax: 1.0 },
    };
    flat(corners, question)
}

/// 2^x for whole x, without rounding.
pub trait ExactExp2 {
    fn exp2_exact(self) -> f32;
}

impl ExactExp2 for f32 {
    fn exp2_exact(self) -> f32 {
        f32::from_bits(((self as i32 + 127) as u32) << 23)
    }
}
