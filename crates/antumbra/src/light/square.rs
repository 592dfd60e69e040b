//! Densities on the unit square from which points of flat lights are drawn: even, and the lecture's others.

use antumbra_math::{DVec2, real};

use super::LightPoints;

/// A density over the unit square; its mean is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Square {
    /// 1 everywhere.
    Even,
    /// 0.2 + 1.6 x: one side nine times as dense as the other.
    Skewed,
    /// As 1/(w² + (x − c)²) along each axis: dense about c, the more the smaller w.
    Near { c: DVec2, w: DVec2 },
    /// 4/3, but 0 for 1/2 ≤ x < 3/4.
    Hole,
}

const LOW: f64 = 0.2;
const HOLE: [f64; 2] = [0.5, 0.75];
/// The smallest w: nearer receivers see no denser points.
const NEAREST: f64 = 1.0 / 64.0;

impl Square {
    /// The density for a way of drawing; `near`: where in the square the light is nearest to the receiver, and how far the
    /// receiver is from there in sides of the square.
    #[inline]
    pub fn of(how: LightPoints, near: impl FnOnce() -> (DVec2, DVec2)) -> Square {
        match how {
            LightPoints::SolidAngle | LightPoints::Area => Square::Even,
            LightPoints::Skewed => Square::Skewed,
            LightPoints::Hole => Square::Hole,
            LightPoints::Nearest => {
                let (c, w) = near();
                let c = c.clamp(DVec2::ZERO, DVec2::ONE);
                Square::Near { c, w: w.clamp(DVec2::splat(NEAREST), DVec2::splat(1e3)) }
            }
        }
    }

    /// A point for two even numbers.
    #[inline]
    pub fn sample(&self, u: [f64; 2]) -> [f64; 2] {
        match *self {
            Square::Even => u,
            // ∫₀ˣ = LOW x + (1 − LOW) x² = u.
            Square::Skewed => {
                let x = 2.0 * u[0] / (LOW + (LOW * LOW + 4.0 * (1.0 - LOW) * u[0]).sqrt());
                [x.min(1.0), u[1]]
            }
            Square::Near { c, w } => [near_at(u[0], c.x, w.x), near_at(u[1], c.y, w.y)],
            Square::Hole => {
                let x = u[0] * (1.0 - (HOLE[1] - HOLE[0]));
                [if x < HOLE[0] { x } else { x + HOLE[1] - HOLE[0] }, u[1]]
            }
        }
    }

    /// How densely `sample` draws the point.
    #[inline]
    pub fn pdf(&self, [x, y]: [f64; 2]) -> f64 {
        match *self {
            Square::Even => 1.0,
            Square::Skewed => LOW + 2.0 * (1.0 - LOW) * x,
            Square::Near { c, w } => near_pdf(x, c.x, w.x) * near_pdf(y, c.y, w.y),
            Square::Hole if (HOLE[0]..HOLE[1]).contains(&x) => 0.0,
            Square::Hole => 1.0 / (1.0 - (HOLE[1] - HOLE[0])),
        }
    }
}

/// The angles under which 0 and 1 are seen from the distance w of c.
#[inline]
fn angles(c: f64, w: f64) -> [f64; 2] {
    [real::atan(-c / w), real::atan((1.0 - c) / w)]
}

/// x in [0, 1] with even angle (equiangular).
#[inline]
fn near_at(u: f64, c: f64, w: f64) -> f64 {
    let [from, to] = angles(c, w);
    (c + w * real::tan(from + (to - from) * u)).clamp(0.0, 1.0)
}

/// w / (θ₁ − θ₀) / (w² + (x − c)²).
#[inline]
fn near_pdf(x: f64, c: f64, w: f64) -> f64 {
    let [from, to] = angles(c, w);
    w / ((to - from) * (w * w + (x - c) * (x - c)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAYS: [Square; 5] = [
        Square::Even,
        Square::Skewed,
        Square::Near { c: DVec2::new(0.3, 1.0), w: DVec2::new(0.1, 2.0) },
        Square::Near { c: DVec2::new(0.0, 0.5), w: DVec2::new(NEAREST, 50.0) },
        Square::Hole,
    ];

    /// A midpoint rule of 1000² points: 10⁻³ for a density that is 20 times the mean at a border.
    #[test]
    fn densities_have_mean_one() {
        for square in WAYS {
            let at = |i: usize| (i as f64 + 0.5) / 1000.0;
            let along = |y: f64| (0..1000).map(|i| square.pdf([at(i), y])).sum::<f64>() / 1000.0;
            let mean = (0..1000).map(|j| along(at(j))).sum::<f64>() / 1000.0;
            assert!((mean - 1.0).abs() < 1e-3, "{square:?}: {mean}");
        }
    }

    /// The derivative of `sample` is 1 over the density, by differences of 10⁻⁴; not where the hole is leapt over.
    #[test]
    fn samples_follow_the_density() {
        const H: f64 = 1e-4;
        for square in WAYS {
            for i in 1..100 {
                let u = [f64::from(i) / 100.0 + 0.003, 0.37];
                let slope = |axis: usize| {
                    let [mut low, mut high] = [u; 2];
                    low[axis] -= 0.5 * H;
                    high[axis] += 0.5 * H;
                    (square.sample(high)[axis] - square.sample(low)[axis]) / H
                };
                let x = square.sample(u);
                let product = slope(0) * slope(1) * square.pdf(x);
                assert!((product - 1.0).abs() < 1e-2, "{square:?} at {u:?}: {product}");
                assert!(x.iter().all(|x| (0.0..=1.0).contains(x)) && square.pdf(x) > 0.0);
            }
        }
    }
}
