//! The error of navigation that each particle believes in: drawn at every fix, shared by all readings until the next.
//!
//! *Source*: the shared error of `navigation`, integrated out by drawing it: a particle has the source's place and the
//! error as its state (e.g. Thrun, Burgard & Fox 2005, Probabilistic Robotics, section 4.3).
//!
//! *Parameters*: as `navigation`.
//!
//! *Deviations*: the drift's direction and rate are drawn with the error and held until the next fix.

use super::evidence::DoubtSpec;
use super::navigation::NavigationError;
use world::seeds::Stream;

/// An error of so many particles.
#[derive(Clone, Debug)]
pub(in crate::map) struct Shifts {
    stated: NavigationError,
    /// Error at the begin of the block, m, and rate of drift, m/s, in standard deviations, along the map's axes.
    drawn: Vec<[f64; 4]>,
}

impl Shifts {
    /// Before the first fix; `None` if navigation is taken to be true.
    pub(in crate::map) fn from_doubt(doubt: &DoubtSpec, particles: usize, rng: &mut Stream) -> Option<Self> {
        let mut new = Self { stated: NavigationError::from_doubt(doubt)?, drawn: vec![[0.0; 4]; particles] };
        new.draw(rng);
        Some(new)
    }

    fn draw(&mut self, rng: &mut Stream) {
        for drawn in &mut self.drawn {
            *drawn = [0; 4].map(|_| rng.normal());
        }
    }

    /// New errors after a fix.
    pub(in crate::map) fn fixed(&mut self, t_s: f64, rng: &mut Stream) {
        self.stated.begin(t_s, true);
        self.draw(rng);
    }

    /// By how much each particle's source appears displaced at `t_s`, m.
    pub(in crate::map) fn displacements(&mut self, t_s: f64) -> impl Iterator<Item = [f64; 2]> {
        let [fix_m, rate, dt] = self.stated.parts(t_s);
        (self.drawn.iter()).map(move |d| [0, 1].map(|a| fix_m * d[a] + rate * dt * d[a + 2]))
    }

    /// Keeps the errors of the particles that survive a resampling, by their numbers.
    pub(in crate::map) fn keep(&mut self, kept: &[usize]) {
        self.drawn = kept.iter().map(|i| self.drawn[*i]).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::ranges::NonNegative;

    #[test]
    fn errors_are_held_between_fixes_and_have_the_stated_size() {
        let doubt =
            DoubtSpec { fix_m: NonNegative::new(5.0), drift_m_s: NonNegative::new(0.2), ..DoubtSpec::default() };
        let mut rng = Stream::new(1, "auv0", "shifts");
        assert!(Shifts::from_doubt(&DoubtSpec::default(), 9, &mut rng).is_none());
        let n = 20_000;
        let mut shifts = Shifts::from_doubt(&doubt, n, &mut rng).expect("an error");
        assert!(shifts.displacements(3.0).all(|d| d == [0.0; 2]));
        shifts.fixed(10.0, &mut rng);
        let rms = |all: &[[f64; 2]]| {
            let sum: f64 = all.iter().map(|d| d[0] * d[0] + d[1] * d[1]).sum();
            (sum / (2 * all.len()) as f64).sqrt()
        };
        let first: Vec<_> = shifts.displacements(10.0).collect();
        let same: Vec<_> = shifts.displacements(10.0).collect();
        assert_eq!(first, same);
        // 40 000 numbers: the standard error of their root mean square is 0.35 %.
        assert!((rms(&first) / 5.0 - 1.0).abs() < 0.015, "{}", rms(&first));
        let later: Vec<_> = shifts.displacements(40.0).collect();
        let want = f64::sqrt(5.0 * 5.0 + 6.0 * 6.0);
        assert!((rms(&later) / want - 1.0).abs() < 0.015, "{}", rms(&later));
        shifts.keep(&[7, 7, 3]);
        let kept: Vec<_> = shifts.displacements(40.0).collect();
        assert_eq!(kept, [later[7], later[7], later[3]]);
    }
}
