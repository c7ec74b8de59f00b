//! When a source releases filaments: at random (a Poisson process) or at equal intervals.
//!
//! *Source*: Farrell, Murlis, Long, Li & Cardé 2002, Environ. Fluid Mech. 2, 143 (5 to 10 filaments a second).
//!
//! *Parameters*: `rate_hz`: mean number a second, 1/s (5 to 10); `poisson`: waiting times exponential or equal; `pulse`
//! (none): only while the source is open.
//!
//! *Deviations*: the paper releases at equal intervals. Here random times are the default, because equal intervals
//! interfere with the sampling of a sensor and leave gaps that no real water has.

use super::source::{PulseSpec, ReleaseSpec};
use world::bits::{Reader, Unreadable, Writer};
use world::seeds::{Seed, Stream};

/// The times of release of one source, in order; they do not depend on who asks or how often.
#[derive(Clone, Debug)]
pub struct ReleaseTimes {
    rate_hz: f64,
    pulse: Option<PulseSpec>,
    draws: Option<Stream>,
    next_s: Option<f64>,
}

impl ReleaseTimes {
    /// Times of the source called `id` under the run's `seed`; nothing is released before the first `until`.
    pub fn new(release: &ReleaseSpec, seed: Seed, id: &str) -> Self {
        Self {
            rate_hz: release.rate_hz.get(),
            pulse: release.pulse.clone(),
            draws: release.poisson.then(|| Stream::new(seed, id, "release")),
            next_s: None,
        }
    }

    /// Passes all times in (`from_s`, `until_s`] to `take`, in order; the source opens at the first call's `from_s`.
    pub fn until(&mut self, from_s: f64, until_s: f64, mut take: impl FnMut(f64)) {
        let mut next = match self.next_s {
            Some(next) => next,
            None => from_s + self.wait(),
        };
        while next <= until_s {
            if self.pulse.as_ref().is_none_or(|pulse| pulse.open(next)) {
                take(next);
            }
            next += self.wait();
        }
        self.next_s = Some(next);
    }

    /// Time of the next release, s; `None` before the source has opened.
    pub fn next_s(&self) -> Option<f64> {
        self.next_s
    }

    /// Writes how far it has come.
    pub(crate) fn keep(&self, to: &mut Writer) {
        let Self { rate_hz: _, pulse: _, draws, next_s } = self;
        if let Some(draws) = draws {
            draws.keep(to);
        }
        to.maybe(*next_s);
    }

    /// Goes to where another of the same source and seed was kept.
    pub(crate) fn recall(&mut self, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        if let Some(draws) = &mut self.draws {
            draws.recall(from)?;
        }
        self.next_s = from.maybe()?;
        Ok(())
    }

    fn wait(&mut self) -> f64 {
        match &mut self.draws {
            Some(stream) => stream.exponential(self.rate_hz),
            None => 1.0 / self.rate_hz,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::ranges::Positive;

    fn times(poisson: bool, step_s: f64) -> Vec<f64> {
        pulsed(None, poisson, step_s)
    }

    fn pulsed(pulse: Option<PulseSpec>, poisson: bool, step_s: f64) -> Vec<f64> {
        let mut r = ReleaseTimes::new(&ReleaseSpec { poisson, pulse, ..ReleaseSpec::default() }, 3.into(), "s1");
        let mut out = Vec::new();
        for n in 0..(1000.0 / step_s) as usize {
            r.until(n as f64 * step_s, (n + 1) as f64 * step_s, |t| out.push(t));
        }
        out
    }

    #[test]
    fn times_do_not_depend_on_the_step() {
        assert_eq!(times(true, 0.5), times(true, 20.0));
        assert_eq!(times(false, 0.5), times(false, 20.0));
    }

    /// A source that opens for 1 s in 4 releases what a steady one does in that time, and nothing else.
    #[test]
    fn a_pulsed_source_is_open_a_part_of_the_time() {
        let pulse = PulseSpec { on_s: Positive::new(1.0), off_s: Positive::new(3.0) };
        for poisson in [true, false] {
            let steady = times(poisson, 20.0).into_iter().filter(|t| t % 4.0 < 1.0);
            assert_eq!(pulsed(Some(pulse.clone()), poisson, 0.5), steady.collect::<Vec<_>>());
        }
    }

    #[test]
    fn counts_are_poisson_or_regular() {
        // Counts in 10 s windows: mean 50; variance 50 if Poisson. 100 windows: the variance has a
        // standard error of 50·√(2/99 + 1/(50·100)) = 7.1, the mean one of √(50/100) = 0.71. Five of each.
        let counts = |times: &[f64]| {
            let mut c = vec![0.0; 100];
            for t in times {
                c[((t / 10.0) as usize).min(99)] += 1.0;
            }
            let m = c.iter().sum::<f64>() / 100.0;
            (m, c.iter().map(|v| (v - m) * (v - m)).sum::<f64>() / 99.0)
        };
        let (mean, variance) = counts(&times(true, 1.0));
        assert!((mean - 50.0).abs() < 3.6 && (variance - 50.0).abs() < 35.5, "{mean} {variance}");
        let (mean, variance) = counts(&times(false, 1.0));
        assert!((mean - 50.0).abs() < 0.1 && variance < 0.5, "{mean} {variance}");
    }
}
