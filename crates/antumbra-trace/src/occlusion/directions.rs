//! The directions that are decided together: N of them over the hemisphere about a normal, the same for every receiver
//! in the receiver's own frame, each with the length of its ray.

use antumbra_math::real;

use super::bins::Bins;
use super::levels::Levels;
use super::table::HalfSpaces;
use super::{BITS, Block};
use crate::{PrimId, SegmentBuffer};

/// How many directions there may be.
pub const COUNTS: [usize; 4] = [64, 256, 512, 1024];

/// Why there are no such directions.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DirectionsError {
    /// Their number is none of [`COUNTS`].
    #[error("{0} directions: 64, 256, 512 or 1024 are needed")]
    Count(usize),
    /// A ray would have no length.
    #[error("direction {0} has the length {1}: more than 0 is needed")]
    Length(usize, f32),
}

/// N directions of equal weight under a density cos θ / π, and the table of the half-spaces that they lie in.
///
/// A spiral: θ is stratified, the angle about the normal turns by the golden section. The mean of V over all of them is
/// the openness (1/π) ∫ V cos θ dω. Their frame is the receiver's own: one table serves all receivers.
#[derive(Clone, Debug)]
pub struct Directions {
    /// Unit vectors, n = +z, by component.
    pub(super) local: [Vec<f32>; 3],
    /// Largest t along each; may be +∞.
    pub(super) reach: Vec<f32>,
    pub(super) levels: Levels,
    pub(super) table: HalfSpaces,
    pub(super) bins: Bins,
    /// Below the cosine of every direction to its normal by 2⁻¹⁹.
    pub(super) low: f32,
}

impl Directions {
    /// `count` directions; `length` gives the length of a ray from a number in (0, 1), evenly spread over them all
    /// (the inverse of a fall-off makes the mean of V the fall-off's integral).
    pub fn new(count: usize, length: impl Fn(f32) -> f32) -> Result<Directions, DirectionsError> {
        if !COUNTS.contains(&count) {
            return Err(DirectionsError::Count(count));
        }
        let mut local = [const { Vec::new() }; 3];
        let mut reach = Vec::with_capacity(count);
        for i in 0..count {
            for (all, x) in local.iter_mut().zip(spiral(i, count)) {
                all.push(x);
            }
            // √2 − 1 and the golden section: no line of a lattice holds many of the points (θ, φ, length).
            let turn = (i as f64 + 0.5) * (std::f64::consts::SQRT_2 - 1.0);
            let l = length((turn - real::floor(turn)) as f32);
            if l.is_nan() || l <= 0.0 {
                return Err(DirectionsError::Length(i, l));
            }
            reach.push(l);
        }
        let lowest = local[2].iter().fold(1f32, |m, z| m.min(*z));
        let (levels, table, bins) = (Levels::new(&reach), HalfSpaces::new(&local), Bins::new(&local));
        Ok(Directions { levels, table, bins, local, reach, low: lowest - COS_SLACK })
    }

    /// Number of directions.
    #[allow(clippy::len_without_is_empty, reason = "there are always some")]
    pub fn len(&self) -> usize {
        self.reach.len()
    }

    /// Words of 64 bits in the mask of a receiver.
    pub fn words(&self) -> usize {
        self.len() / 64
    }

    /// Blocks of a mask inside.
    pub(super) fn blocks(&self) -> usize {
        self.len().div_ceil(BITS)
    }

    /// Direction `i` in the frame of a receiver, n = +z.
    pub fn local(&self, i: usize) -> [f32; 3] {
        [self.local[0][i], self.local[1][i], self.local[2][i]]
    }

    /// Largest t along direction `i`.
    pub fn reach(&self, i: usize) -> f32 {
        self.reach[i]
    }

    /// Every direction is in this mask.
    pub(super) fn all(&self) -> &[Block] {
        self.levels.all()
    }
}

/// 2⁻¹⁹: what roundings may take from a cosine, several times over.
const COS_SLACK: f32 = 1.0 / 524_288.0;

fn spiral(i: usize, count: usize) -> [f32; 3] {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let u = (i as f64 + 0.5) / count as f64;
    let turn = i as f64 * GOLDEN;
    let (sin, cos) = real::sincos(std::f64::consts::TAU * (turn - real::floor(turn)));
    [u.sqrt() * cos, u.sqrt() * sin, (1.0 - u).sqrt()].map(|x| x as f32)
}

/// A point that asks about all directions at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Where its rays start: safe above its surface (`start`).
    pub start: [f32; 3],
    /// The primitive it lies on, or `NO_PRIM`: if it is flat it never blocks.
    pub first: PrimId,
    /// Number of its first ray; the others follow (for `passes`).
    pub number: u32,
    /// Two tangents and the normal, each rounded once.
    frame: [[f32; 3]; 3],
}

impl Receiver {
    /// With a normal of any length above 0, its tangents turned about it by `turn` of a full circle. Without a normal
    /// (0, NaN) it asks about nothing.
    pub fn new(start: [f32; 3], first: PrimId, number: u32, normal: [f64; 3], turn: f64) -> Receiver {
        Receiver { start, first, number, frame: frame(normal, turn) }
    }

    /// Two tangents and the normal.
    pub fn frame(&self) -> [[f32; 3]; 3] {
        self.frame
    }

    /// Direction `i` in the world: one order of operations, in which every way computes it.
    #[inline]
    pub fn direction(&self, of: &Directions, i: usize) -> [f32; 3] {
        let ([x, y, z], [s, t, n]) = (of.local(i), self.frame);
        [0, 1, 2].map(|k| (x * s[k] + y * t[k]) + z * n[k])
    }

    /// Adds its rays, one a direction.
    pub fn rays(&self, of: &Directions, out: &mut SegmentBuffer) {
        for i in 0..of.len() {
            let number = self.number.wrapping_add(i as u32);
            out.push_ray(self.start, self.direction(of, i), of.reach(i), self.first, number);
        }
    }
}

/// In f64 (Duff et al. 2017, listing 3), turned about the normal, then rounded once.
fn frame(normal: [f64; 3], turn: f64) -> [[f32; 3]; 3] {
    let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
    let [x, y, z] = normal.map(|c| c / length);
    let sign = 1f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    let (s, t) = ([1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]);
    let (sin, cos) = if turn == 0.0 { (0.0, 1.0) } else { real::sincos(std::f64::consts::TAU * turn) };
    let turned = [0, 1, 2].map(|k| cos * s[k] + sin * t[k]);
    let across = [0, 1, 2].map(|k| cos * t[k] - sin * s[k]);
    [turned, across, [x, y, z]].map(|v| v.map(|c| c as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_unit_and_weigh_the_cosine() {
        for count in COUNTS {
            let all = Directions::new(count, |_| 1.0).unwrap_or_else(|e| panic!("{e}"));
            let mut mean = [0.0; 3];
            for i in 0..count {
                let d = all.local(i).map(f64::from);
                let length = d.iter().map(|c| c * c).sum::<f64>().sqrt();
                assert!((length - 1.0).abs() < 2f64.powi(-22) && d[2] > f64::from(all.low));
                (0..3).for_each(|k| mean[k] += d[k] / count as f64);
            }
            // ∫ ω cos θ / π dω = (0, 0, 2/3); a spiral of N points is nearer to it than 2 / N.
            assert!(mean[0].abs().max(mean[1].abs()).max((mean[2] - 2.0 / 3.0).abs()) < 2.0 / count as f64);
        }
        assert_eq!(Directions::new(100, |_| 1.0).map(|_| ()), Err(DirectionsError::Count(100)));
        assert!(matches!(Directions::new(64, |u| u - 0.5), Err(DirectionsError::Length(..))));
    }

    #[test]
    fn frames_are_orthonormal() {
        for normal in
            [[0.0, 0.0, 1.0], [0.0, 0.0, -2.0], [1.0, 0.0, 0.0], [0.3, -4.0, 1e-3], [1e-9, 1e-9, -1.0]]
        {
            let f = Receiver::new([0.0; 3], 0, 0, normal, 0.3).frame().map(|v| v.map(f64::from));
            for (i, a) in f.iter().enumerate() {
                for (j, b) in f.iter().enumerate() {
                    let dot: f64 = a.iter().zip(b).map(|(x, y)| x * y).sum();
                    // One rounding of each component: below 2 · 2⁻²⁴ in every dot product, twice that asked.
                    assert!((dot - f64::from(u8::from(i == j))).abs() < 2f64.powi(-22), "{normal:?} {i} {j}");
                }
            }
        }
    }
}
