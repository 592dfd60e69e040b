//! Many comparisons, one α: each estimate against its truth, in units of its own standard error.

use antumbra::math::stats::{normal_two_sided, sidak, student_t_two_sided};

/// An estimate and what it should be.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Case and estimator.
    pub name: String,
    /// What was estimated.
    pub estimate: f64,
    /// Its standard error.
    pub error: f64,
    /// Degrees of freedom of the error; +∞: known.
    pub dof: f64,
    /// What it should be.
    pub truth: f64,
    /// What rounding may add, however many rays.
    pub slack: f64,
}

impl Trial {
    /// How far the estimate lies from the truth, beyond rounding, in standard errors.
    pub fn score(&self) -> f64 {
        let off = ((self.estimate - self.truth).abs() - self.slack).max(0.0);
        if off == 0.0 { 0.0 } else { off / self.error }
    }

    /// Probability of a score at least this large.
    pub fn p(&self) -> f64 {
        let score = self.score();
        match (score.is_nan(), self.dof.is_finite()) {
            (true, _) => 0.0,
            (_, true) => student_t_two_sided(score, self.dof),
            (_, false) => normal_two_sided(score),
        }
    }
}

/// The comparisons of one test.
#[derive(Default)]
pub struct Judge {
    trials: Vec<Trial>,
}

impl Judge {
    /// One more comparison.
    pub fn add(&mut self, trial: Trial) {
        self.trials.push(trial);
    }

    /// Compares two estimates of the same thing with known errors.
    pub fn agree(&mut self, name: String, a: [f64; 2], b: [f64; 2]) {
        let error = (a[1] * a[1] + b[1] * b[1]).sqrt();
        // Sums of 2⁻²⁴ roundings along both ways.
        let slack = 4e-6 * a[0].abs();
        self.add(Trial { name, estimate: a[0], error, dof: f64::INFINITY, truth: b[0], slack });
    }

    /// Fails if a comparison is less likely than `alpha` allows over all of them.
    pub fn verdict(mut self, test: &str, alpha: f64) {
        let each = sidak(alpha, self.trials.len());
        let n = self.trials.len();
        self.trials.sort_by(|a, b| a.p().total_cmp(&b.p()));
        let tell = |t: &Trial| {
            format!(
                "{}: {:.9e} ± {:.2e}, truth {:.9e}, {:.2} standard errors",
                t.name,
                t.estimate,
                t.error,
                t.truth,
                t.score()
            )
        };
        println!("{test}: {n} comparisons, each at α = {each:.1e}; the farthest:");
        self.trials.iter().take(5).for_each(|t| println!("  {}", tell(t)));
        let bad: Vec<String> = self.trials.iter().filter(|t| t.p() < each).map(tell).collect();
        assert!(bad.is_empty(), "{test}: {} of {n} are off:\n{}", bad.len(), bad.join("\n"));
    }
}

/// `few`, or with `ANTUMBRA_STRESS` set `many`.
pub fn size(few: u32, many: u32) -> u32 {
    if std::env::var_os("ANTUMBRA_STRESS").is_some() { many } else { few }
}
