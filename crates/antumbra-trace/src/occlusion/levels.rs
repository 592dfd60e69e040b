//! Which directions reach how far: masks by length of the ray.

use super::{BITS, Block};
use crate::layout::{above, below};

/// Lengths that are told apart; more of them share the mask of the next one.
const MOST: usize = 64;

/// 2⁻¹⁸: what the length of a unit vector and the squares of distances lose by rounding, more than once
/// (docs/visibility.md §3).
const SLACK: f64 = 1.0 / 262_144.0;

/// 2⁻¹¹⁸: covers what underflows in squares.
pub(super) const FLOOR: f32 = f32::from_bits(9 << 23);

/// Masks of the directions whose ray is at least so long, for rising lengths.
#[derive(Clone, Debug)]
pub(super) struct Levels {
    /// Blocks a mask.
    blocks: usize,
    /// Below the squared length of the shortest ray of each mask.
    least: Vec<f32>,
    /// Above the squared length.
    most: Vec<f32>,
    /// One mask a level, then one without any direction.
    masks: Vec<Block>,
    /// 1 if rays between two levels have none of their own.
    between: usize,
    /// Above the squared length of every ray.
    pub longest: f32,
}

impl Levels {
    pub fn new(reach: &[f32]) -> Levels {
        let mut sorted = reach.to_vec();
        sorted.sort_by(f32::total_cmp);
        sorted.dedup();
        let step = sorted.len().div_ceil(MOST);
        let kept: Vec<f32> = sorted.iter().copied().step_by(step).collect();
        let blocks = reach.len().div_ceil(BITS);
        let mut masks = vec![[0; 4]; blocks * (kept.len() + 1)];
        for (k, from) in kept.iter().enumerate() {
            for (i, _) in reach.iter().enumerate().filter(|(_, l)| *l >= from) {
                masks[k * blocks + i / BITS][i % BITS / 64] |= 1 << (i % 64);
            }
        }
        let square = |l: f32| f64::from(l) * f64::from(l);
        let most = |l: f32| above(square(l) * (1.0 + 2.0 * SLACK)) + FLOOR;
        Levels {
            blocks,
            least: kept.iter().map(|l| below(square(*l) * (1.0 - SLACK))).collect(),
            most: kept.iter().map(|l| most(*l)).collect(),
            masks,
            between: usize::from(step > 1),
            longest: sorted.last().map_or(f32::INFINITY, |l| most(*l)),
        }
    }

    /// Every direction.
    pub fn all(&self) -> &[Block] {
        &self.masks[..self.blocks]
    }

    /// Directions whose rays surely go on beyond the squared distance `far2`.
    #[inline]
    pub fn surely(&self, far2: f32) -> &[Block] {
        let k = self.least.partition_point(|l| *l <= far2);
        &self.masks[k * self.blocks..][..self.blocks]
    }

    /// All directions but such whose rays surely end before the squared distance `near2`.
    #[inline]
    pub fn perhaps(&self, near2: f32) -> &[Block] {
        let k = self.most.partition_point(|l| *l < near2).saturating_sub(self.between);
        &self.masks[k * self.blocks..][..self.blocks]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_bracket_the_lengths() {
        let falling: Vec<f32> = (0..1024).map(|i| 3.0 * (1.0 - (i as f32 + 0.5) / 1024.0)).collect();
        for reach in [vec![2.0; 64], vec![f32::INFINITY; 256], falling, vec![1e-30; 64], vec![1e30; 64]] {
            let levels = Levels::new(&reach);
            let has = |mask: &[Block], i: usize| mask[i / BITS][i % BITS / 64] >> (i % 64) & 1 == 1;
            for t in [0.0, 1e-35, 1e-25, 0.001, 0.5, 1.0, 1.9999, 2.0, 2.0001, 2.9999, 3.1, 1e18, 1e19] {
                let (surely, perhaps) = (levels.surely(t * t + FLOOR), levels.perhaps(t * t));
                for (i, l) in reach.iter().enumerate() {
                    assert!(has(levels.masks.as_slice(), i));
                    assert!(!has(surely, i) || *l > t, "{l} {t}");
                    assert!(has(perhaps, i) || *l < t, "{l} {t}");
                }
            }
        }
    }
}
