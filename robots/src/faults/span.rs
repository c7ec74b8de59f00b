//! When a fault holds, in steps.

use world::clock::Clock;

/// A time that is nearer to the beginning of a step than this share of it counts as that beginning: 300 / 0.02 is not
/// exactly 15000.
const NEAR: f64 = 1e-6;

/// From one step until before another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    at_s: f64,
    from: u64,
    until: Option<u64>,
}

impl Span {
    /// From the first step that begins at `at_s` or later, until before the first that begins at `until_s` or later; for
    /// good without it. Steps take `dt_s`.
    pub fn new(at_s: f64, until_s: Option<f64>, dt_s: f64) -> Self {
        let step = |s: f64| (s / dt_s - NEAR).ceil().max(0.0) as u64;
        Self { at_s, from: step(at_s), until: until_s.map(step) }
    }

    /// Whether it holds now.
    pub fn holds(&self, clock: &Clock) -> bool {
        clock.step >= self.from && !self.is_over(clock)
    }

    /// Whether it held before and will not again.
    pub fn is_over(&self, clock: &Clock) -> bool {
        self.until.is_some_and(|until| clock.step >= until)
    }

    /// Time since it began, s.
    pub fn lasted_s(&self, clock: &Clock) -> f64 {
        (clock.t_s() - self.at_s).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The steps of the first thousand in which it holds.
    fn steps(at_s: f64, until_s: Option<f64>, dt_s: f64) -> (Option<u64>, usize) {
        let span = Span::new(at_s, until_s, dt_s);
        let held: Vec<u64> = (0..1000).filter(|&step| span.holds(&Clock { step, dt_s })).collect();
        (held.first().copied(), held.len())
    }

    #[test]
    fn it_holds_from_its_time_on_until_before_its_end() {
        assert_eq!(steps(0.0, None, 0.02), (Some(0), 1000));
        assert_eq!(steps(2.0, Some(3.0), 0.02), (Some(100), 50));
        // 0.07 / 0.01 is a little above 7, 0.06 / 0.02 a little below 3.
        assert_eq!(steps(0.07, Some(0.09), 0.01), (Some(7), 2));
        assert_eq!(steps(0.06, Some(0.1), 0.02), (Some(3), 2));
        // Between two steps: from the next on.
        assert_eq!(steps(0.05, Some(0.11), 0.02), (Some(3), 3));
        assert_eq!(steps(1e9, None, 0.02), (None, 0));
    }

    #[test]
    fn a_drift_grows_from_the_beginning() {
        let span = Span::new(2.0, None, 0.5);
        let lasted = |step| span.lasted_s(&Clock { step, dt_s: 0.5 });
        assert_eq!([lasted(0), lasted(4), lasted(7)], [0.0, 0.0, 1.5]);
    }
}
