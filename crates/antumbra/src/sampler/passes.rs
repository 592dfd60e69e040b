//! The passes of a render and the replicates that they fall into.

/// The passes of a render: how many, and in which replicates they stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassPlan {
    /// All passes (viewing rays per pixel, samples per point).
    pub count: u32,
    /// Independent replicates.
    pub replicates: u32,
    /// Stop after this many.
    pub until: u32,
}

impl PassPlan {
    /// R = 4 replicates below 256 passes, 16 from there; never more than passes.
    pub fn of(count: u32) -> PassPlan {
        PassPlan { count, replicates: if count < 256 { 4.min(count) } else { 16 }, until: count }
    }

    /// First pass of replicate `r`.
    pub fn begin(&self, r: u32) -> u32 {
        (u64::from(self.count) * u64::from(r) / u64::from(self.replicates.max(1))) as u32
    }

    /// Passes of the longest replicate.
    #[inline]
    pub fn longest(&self) -> u32 {
        self.count.div_ceil(self.replicates.max(1))
    }

    /// The replicate of a pass, its number there, and how many passes the longest replicate has.
    #[inline]
    pub fn locate(&self, pass: u32) -> (u32, u32, u32) {
        let r =
            ((u64::from(pass) + 1) * u64::from(self.replicates)).div_ceil(u64::from(self.count)) as u32 - 1;
        (r, pass - self.begin(r), self.longest())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_fall_into_replicates_of_nearly_equal_length() {
        for count in [1, 2, 3, 4, 5, 16, 100, 255, 256, 1000] {
            let passes = PassPlan::of(count);
            let mut lengths = vec![0; passes.replicates as usize];
            for pass in 0..count {
                let (r, i, longest) = passes.locate(pass);
                assert!(i < longest && passes.begin(r) + i == pass, "{count} {pass}");
                lengths[r as usize] += 1;
            }
            let (low, high) = (lengths.iter().min(), lengths.iter().max());
            assert!(high.unwrap() - low.unwrap() <= 1, "{lengths:?}");
        }
    }
}
