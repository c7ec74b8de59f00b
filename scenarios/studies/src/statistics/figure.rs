//! One figure of a plume, and all of them.

/// A figure is flagged if it differs from the expectation by more than this factor.
const FACTOR: f64 = 2.0;

/// A figure of ours and its expected value.
#[derive(Clone, Debug, PartialEq)]
pub struct PlumeFigure {
    /// What it is.
    pub name: String,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    /// Our value.
    pub ours: f64,
    /// The expected value, if there is one.
    pub expected: Option<f64>,
    /// Where the expectation comes from, or how our figure is defined.
    pub source: &'static str,
}

impl PlumeFigure {
    /// Our value divided by the expected one.
    pub fn ratio(&self) -> Option<f64> {
        self.expected.map(|e| self.ours / e)
    }

    /// Whether the ratio lies outside 0.5 to 2.
    pub fn flagged(&self) -> bool {
        self.ratio().is_some_and(|r| !(1.0 / FACTOR..=FACTOR).contains(&r))
    }
}

/// The figures of a scenario's plume.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// Name of the scenario.
    pub name: String,
    /// Seed of the run.
    pub seed: u64,
    /// How long the plume was observed after the spin-up, s.
    pub watched_s: f64,
    /// The figures.
    pub figures: Vec<PlumeFigure>,
}
