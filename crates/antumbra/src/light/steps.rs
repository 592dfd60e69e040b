//! Choosing in proportion to weights, exactly: probabilities are whole multiples of 2⁻²⁴, the grain of the random
//! numbers, so that the frequency of every choice *is* its probability, and no weight above 0 is lost to rounding.

use antumbra_math::real;

/// Number of steps that the weights share.
pub const STEPS: u32 = 1 << 24;

/// What was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Index of the weight.
    pub index: usize,
    /// Its probability.
    pub prob: f32,
    /// Where in its part of [0, 1) the number fell, stretched to [0, 1): a number to use again.
    pub rest: f32,
}

/// Fills `ends` with the running numbers of steps: w_i / Σw of what is left after one step for each weight above 0.
/// `ends` is empty if no weight is above 0. At most 2²⁴ weights.
pub fn share_out(weights: impl Iterator<Item = f32> + Clone, ends: &mut Vec<u32>) {
    let usable = weights.map(|w| f64::from(w.clamp(0.0, f32::MAX)));
    let (mut sum, mut count) = (0.0, 0);
    for w in usable.clone().filter(|w| *w > 0.0) {
        sum += w;
        count += 1;
    }
    ends.clear();
    if count == 0 {
        return;
    }
    let free = f64::from(STEPS - count);
    let (mut run, mut seen) = (0.0, 0);
    ends.extend(usable.map(|w| {
        if w > 0.0 {
            run += w;
            seen += 1;
        }
        (run / sum * free) as u32 + seen
    }));
}

/// Up to so many weights the roundings of [`share_out_fast`] are bounded.
pub const FAST: usize = 1024;

/// As [`share_out`] for up to [`FAST`] weights of one receiver, many times a second: in f32 and without a step of one
/// number after the other but a sum of whole numbers. What roundings leave, less than 2⁻¹³ of all, goes to the last
/// weight above 0. `ends` is as long as `weights`; `false` if no weight is above 0.
pub fn share_out_fast(weights: &[f32], ends: &mut [u32]) -> bool {
    const LANES: usize = 8;
    /// What is kept back, so that the steps never sum to more than there are: `FAST` weights, summed by eights, round to
    /// less than 2⁻¹⁷ of their sum.
    const KEPT: f32 = 1.0 - 1.0 / 65_536.0;
    let usable = |w: f32| if w > 0.0 { w } else { 0.0 };
    let (mut sums, mut counts) = ([0.0f32; LANES], [0u32; LANES]);
    let (eights, rest) = weights.as_chunks::<LANES>();
    for eight in eights {
        for k in 0..LANES {
            sums[k] += usable(eight[k]);
            counts[k] += u32::from(eight[k] > 0.0);
        }
    }
    let sum = sums.iter().sum::<f32>() + rest.iter().map(|w| usable(*w)).sum::<f32>();
    let count = counts.iter().sum::<u32>() + rest.iter().filter(|w| **w > 0.0).count() as u32;
    // A step for each, and one for its rounding.
    let scale = STEPS.saturating_sub(2 * count) as f32 * KEPT / sum;
    if !((0.5 * scale).is_normal() && sum.is_finite()) {
        let mut exact = Vec::new();
        share_out(weights.iter().copied(), &mut exact);
        exact.resize(ends.len(), 0);
        ends.copy_from_slice(&exact);
        return count > 0;
    }
    for (end, w) in ends.iter_mut().zip(weights) {
        // Halved, a number of steps is a whole number where 2²³ is added: its bits, without a conversion.
        let half = (usable(*w) * (0.5 * scale) + 8_388_608.0).to_bits() & 0x007f_ffff;
        *end = 2 * half + u32::from(*w > 0.0);
    }
    let mut run = 0;
    for end in ends.iter_mut() {
        run += *end;
        *end = run;
    }
    ends.iter_mut().rev().take_while(|end| **end == run).for_each(|end| *end = STEPS);
    true
}

/// The weight that `u` in [0, 1) falls on; `None` if there is none.
#[inline]
pub fn pick(ends: &[u32], u: f32) -> Option<Choice> {
    let step = step_of(u);
    choice(ends, find(ends, step), step)
}

/// As [`pick`] for a few weights: all are compared at once, which guesses nothing wrong.
#[inline]
pub fn pick_few<const N: usize>(ends: &[u32; N], u: f32) -> Option<Choice> {
    let step = step_of(u);
    choice(ends, ends.iter().map(|end| u32::from(*end <= step)).sum::<u32>() as usize, step)
}

#[inline]
fn step_of(u: f32) -> u32 {
    ((u * STEPS as f32) as u32).min(STEPS - 1)
}

#[inline]
fn choice(ends: &[u32], index: usize, step: u32) -> Option<Choice> {
    let (low, high) = part(ends, index)?;
    let rest = ((step - low) as f32 + 0.5) / (high - low) as f32;
    Some(Choice { index, prob: (high - low) as f32 / STEPS as f32, rest: rest.min(real::ONE_MINUS) })
}

/// The first index whose end lies beyond `step`, or the number of ends. Searched outwards from where it would be if all
/// weights were equal: near, and in the same lines of the cache, for even weights (a row of a sky); as fast as halving
/// for the others.
#[inline]
fn find(ends: &[u32], step: u32) -> usize {
    let beyond = |i: usize| ends[i] > step;
    let guess = ((u64::from(step) * ends.len() as u64) >> 24) as usize;
    let (mut low, mut high) = (guess, guess);
    let mut stride = 1;
    if guess < ends.len() && beyond(guess) {
        while low > 0 && beyond(low - 1) {
            high = low - 1;
            low = high.saturating_sub(stride);
            stride *= 2;
        }
    } else {
        while high < ends.len() && !beyond(high) {
            low = high + 1;
            high = (low + stride).min(ends.len());
            stride *= 2;
        }
    }
    low + ends[low..high].partition_point(|end| *end <= step)
}

/// The probability of weight `index`.
#[inline]
pub fn prob(ends: &[u32], index: usize) -> f32 {
    part(ends, index).map_or(0.0, |(low, high)| (high - low) as f32 / STEPS as f32)
}

/// First step of weight `index` and the first after it.
#[inline]
fn part(ends: &[u32], index: usize) -> Option<(u32, u32)> {
    let high = *ends.get(index)?;
    Some((if index == 0 { 0 } else { ends[index - 1] }, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every step of the grain once: the frequency of each choice is its probability, and all of them sum to 1.
    #[test]
    fn frequency_is_probability_exactly() {
        let weights = [0.0, 1e-30, 3.0, 0.0, f32::INFINITY, 2.5, f32::NAN, 1e30, -1.0];
        let mut ends = Vec::new();
        share_out(weights.iter().copied(), &mut ends);
        let mut fast = [0; 9];
        assert!(share_out_fast(&weights, &mut fast) && fast == ends[..]);
        let finite = weights.map(|w| if w.is_finite() { w } else { 0.0 });
        assert!(share_out_fast(&finite, &mut fast));
        for (weights, ends) in [(weights, &ends[..]), (finite, &fast)] {
            let mut seen = [0u32; 9];
            for step in 0..STEPS {
                let choice = pick(ends, step as f32 / STEPS as f32).unwrap();
                assert!((0.0..1.0).contains(&choice.rest));
                seen[choice.index] += 1;
            }
            for (i, n) in seen.iter().enumerate() {
                assert_eq!(*n as f32 / STEPS as f32, prob(ends, i));
                assert_eq!(*n > 0, weights[i] > 0.0, "weight {i}");
            }
        }
    }

    /// The fast way gives every weight its share to 2⁻¹³ of all, the sum is all, and no light is lost.
    #[test]
    fn fast_shares_are_the_shares() {
        for n in [1, 7, 8, 33, 400, 1024] {
            let weights: Vec<f32> = (0..n).map(|i| ((i * 7919 % 13) as f32 - 2.0).powi(5)).collect();
            let (mut exact, mut fast) = (Vec::new(), vec![0; n]);
            share_out(weights.iter().copied(), &mut exact);
            let any = share_out_fast(&weights, &mut fast);
            assert_eq!(any, !exact.is_empty());
            if any {
                assert_eq!(fast[n - 1], STEPS);
                for i in 0..n {
                    assert!((prob(&fast, i) - prob(&exact, i)).abs() < 1.0 / 8192.0, "{i} of {n}");
                    assert_eq!(prob(&fast, i) > 0.0, weights[i] > 0.0, "{i} of {n}");
                }
            }
        }
    }

    /// The search finds what halving finds, in even, hot and empty tables.
    #[test]
    fn the_search_finds_the_end() {
        let tables: [Vec<f32>; 4] = [
            vec![1.0; 1000],
            (0..1000).map(|i| if i == 17 { 1e9 } else { 1.0 }).collect(),
            (0..1000).map(|i| f32::from(i >= 990)).collect(),
            vec![0.0; 3],
        ];
        for weights in tables {
            let mut ends = Vec::new();
            share_out(weights.iter().copied(), &mut ends);
            for step in (0..STEPS).step_by(997).chain([STEPS - 1]) {
                assert_eq!(find(&ends, step), ends.partition_point(|end| *end <= step));
            }
        }
    }

    #[test]
    fn nothing_to_choose() {
        let mut ends = vec![1, 2];
        share_out([0.0, -1.0, f32::NAN].into_iter(), &mut ends);
        assert_eq!((pick(&ends, 0.5), prob(&ends, 0)), (None, 0.0));
        assert!(!share_out_fast(&[0.0, -1.0, f32::NAN], &mut [0; 3]));
    }
}
