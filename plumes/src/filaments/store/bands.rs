//! Steps of different length for filaments of different age.
//!
//! *Source*: steps that halve from level to level and meet at common times, as in individual time steps of N-body codes
//! (Makino 1991, Publ. Astron. Soc. Japan 43, 859). That a random walk may take them: see `kernel`.
//!
//! *Parameters*: the longest step (s), [`SHORTEST_S`], and the limits of [`Scales::step_s`] and [`Scales::age_s`].
//!
//! *Deviations*: none. A filament's band depends on its age and on the water, never on who asks. All bands meet at the
//! end of each longest step. Until its step has ended, a filament is found on the straight line from the step's start to
//! its end. The kick within a step of h then has a variance of up to K·h/2 less than a real one. The bands keep that
//! below an eighth of the filament's own variance.

use super::size::Size;

/// Most bands.
pub(crate) const MOST: usize = 8;

/// Steps are halved down to at least this, s.
const SHORTEST_S: f64 = 0.25;

/// Eddies between walls carry filaments in steps of at least this, s: at a few mm/s, a filament moves by a millimetre.
const CARRY_S: f64 = 0.2;

/// The longest step, s. With [`MOST`] bands, the youngest filaments then still take the shortest.
const LONGEST_S: f64 = SHORTEST_S * (1 << (MOST - 1)) as f64;

/// A step takes at most this part of a filament's age.
const PART_OF_AGE: f64 = 0.25;

/// The variance that a step's straight line lacks in its middle is at most this part of the filament's own.
const PART_OF_SIZE: f64 = 0.125;

/// No filament is older than this, s.
const OLDEST_S: f64 = 1e9;

/// A step of a band, s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Span {
    pub(crate) from_s: f64,
    pub(crate) to_s: f64,
}

impl Span {
    /// The part of it that has passed at a time, from 0 to 1.
    pub(crate) fn part(&self, now_s: f64) -> f32 {
        let whole = self.to_s - self.from_s;
        if whole > 0.0 { ((now_s - self.from_s) / whole).clamp(0.0, 1.0) as f32 } else { 1.0 }
    }
}

/// A time within a band's step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    pub(crate) span: Span,
    pub(crate) now_s: f64,
    /// The part of the step that has passed.
    pub(crate) part: f32,
}

impl Moment {
    /// The part of its way that a filament has gone that was released at a time; `None` if it is not released yet.
    pub(crate) fn part_gone(&self, born_s: f64) -> Option<f32> {
        let Self { span, now_s, part } = *self;
        if born_s <= span.from_s {
            Some(part)
        } else {
            (born_s <= now_s).then(|| Span { from_s: born_s, ..span }.part(now_s))
        }
    }
}

/// A coordinate when a part of the way is gone.
#[inline(always)]
pub(crate) fn on_way(start: f32, end: f32, part: f32) -> f32 {
    let on = start + part * (end - start);
    if part < 1.0 { on } else { end }
}

/// The bands from the longest step (band 0, the oldest filaments) to the shortest, and how far each has come.
#[derive(Clone, Debug)]
pub(crate) struct Bands {
    start_s: f64,
    end_s: f64,
    shortest_s: f64,
    /// Number of halvings from the longest step to the shortest.
    halvings: usize,
    /// Number of shortest steps since the start.
    tick: u64,
    spans: [Span; MOST],
}

impl Bands {
    /// From `start_s` on, in steps of at most `longest_s`. The longest step divides `flow_s`, the period at which the
    /// flow is renewed, unless that is 0. The last steps end at `end_s`.
    pub(crate) fn new(start_s: f64, end_s: f64, longest_s: f64, flow_s: f64, one_step: bool) -> Self {
        let mut most_s = longest_s.min(end_s - start_s);
        if !one_step {
            most_s = most_s.min(LONGEST_S);
        }
        let mut shortest_s = most_s;
        if flow_s > 0.0 {
            shortest_s = flow_s / (flow_s / most_s - 1e-9).ceil().max(1.0);
        }
        let mut halvings = 0;
        while !one_step && halvings + 1 < MOST && 0.5 * shortest_s >= SHORTEST_S {
            shortest_s *= 0.5;
            halvings += 1;
        }
        let at = Span { from_s: start_s, to_s: start_s };
        Self { start_s, end_s, shortest_s, halvings, tick: 0, spans: [at; MOST] }
    }

    /// A single band that takes a single step.
    pub(crate) fn single(from_s: f64, to_s: f64) -> Self {
        Self::new(from_s, to_s, to_s - from_s, 0.0, true)
    }

    /// The band of the shortest steps.
    pub(crate) fn last(&self) -> usize {
        self.halvings
    }

    /// From when to when eddies carry a band that they have carried up to `since_s`; `None` if they wait. Shorter steps
    /// than [`CARRY_S`] are all in one band, and the eddies carry it once in several of them.
    pub(crate) fn carries(&self, band: usize, since_s: f64) -> Option<Span> {
        let span = self.spans[band];
        if self.last() > 0 {
            return Some(span);
        }
        let from_s = since_s.min(span.from_s);
        let due = span.to_s - from_s >= CARRY_S - 1e-9 || span.to_s >= self.end_s - 1e-9;
        due.then_some(Span { from_s, ..span })
    }

    /// Length of a band's steps, s.
    pub(crate) fn step_s(&self, band: usize) -> f64 {
        self.shortest_s * (1_u64 << (self.halvings - band)) as f64
    }

    /// Start of the next steps, s.
    pub(crate) fn next_s(&self) -> f64 {
        (self.start_s + self.tick as f64 * self.shortest_s).min(self.end_s)
    }

    /// End of the last steps, s; infinite if there is none.
    pub(crate) fn end_s(&self) -> f64 {
        self.end_s
    }

    /// The first band whose step starts now; all later bands start theirs, too.
    pub(crate) fn due(&self) -> usize {
        self.halvings - (self.tick.trailing_zeros() as usize).min(self.halvings)
    }

    /// The end of the longest step that starts at or after the next steps, s.
    pub(crate) fn next_meeting_s(&self) -> f64 {
        let ticks = 1_u64 << self.halvings;
        let meeting = (self.tick / ticks + 1) * ticks;
        (self.start_s + meeting as f64 * self.shortest_s).min(self.end_s)
    }

    /// The step that a band takes or has taken last.
    pub(crate) fn span(&self, band: usize) -> Span {
        self.spans[band]
    }

    /// A time within the step that a band takes.
    pub(crate) fn moment(&self, band: usize, now_s: f64) -> Moment {
        let span = self.spans[band];
        let part = span.part(now_s);
        Moment { span, now_s, part }
    }

    /// Starts the steps that are due.
    pub(crate) fn pass(&mut self) {
        let from_s = self.next_s();
        for band in self.due()..=self.last() {
            let to_s = (from_s + self.step_s(band)).min(self.end_s);
            self.spans[band] = Span { from_s, to_s };
        }
        self.tick += 1;
    }

    /// Lengths of the steps, longest first, s.
    #[cfg(test)]
    pub(crate) fn steps_s(&self) -> Vec<f64> {
        (0..=self.last()).map(|b| self.step_s(b)).collect()
    }
}

/// Scales of the water that limit steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Scales {
    /// Fastest horizontal speed, m/s.
    pub(crate) fastest_m_s: f64,
    /// Greatest diffusivities, m²/s.
    pub(crate) k_h_m2_s: f64,
    pub(crate) k_z_m2_s: f64,
    /// Distance over which the flow or the walls change, m.
    pub(crate) reach_m: f64,
}

impl Scales {
    /// The longest step in which a filament goes no farther than half of the distance over which the flow changes, with
    /// the current or by two standard deviations of a kick, s.
    pub(crate) fn step_s(&self) -> f64 {
        let half = 0.5 * self.reach_m;
        (half / self.fastest_m_s).min(half * half / (8.0 * self.k_h_m2_s))
    }

    /// The age from which a filament may take steps of `step_s`; infinite if it never may.
    pub(crate) fn age_s(&self, size: &Size, step_s: f64) -> f64 {
        if step_s > self.step_s() {
            return f64::INFINITY;
        }
        let lacks = [self.k_h_m2_s, self.k_z_m2_s].map(|k| 0.5 * k * step_s);
        let large = |age_s: f64| {
            let flat = size.horizontal(age_s);
            let sizes = [flat, size.vertical(flat, f32::MIN)].map(f64::from);
            (0..2).all(|d| lacks[d] <= PART_OF_SIZE * sizes[d] * sizes[d])
        };
        let (mut young, mut old) = (step_s / PART_OF_AGE, OLDEST_S);
        if large(young) {
            return young;
        } else if !large(old) {
            return f64::INFINITY;
        }
        while old > 1.01 * young {
            let middle = (old * young).sqrt();
            if large(middle) {
                old = middle;
            } else {
                young = middle;
            }
        }
        old
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::release::ReleaseSpec;
    use world::ranges::Positive;

    #[test]
    fn steps_halve_and_divide_the_period_of_the_flow() {
        let steps = |longest_s, flow_s| Bands::new(0.0, 9000.0, longest_s, flow_s, false).steps_s();
        assert_eq!(steps(6.0, 10.0), [5.0, 2.5, 1.25, 0.625, 0.3125]);
        assert_eq!(steps(10.0, 10.0)[0], 10.0);
        assert_eq!(steps(0.4, 1.0), [1.0 / 3.0]);
        assert_eq!(steps(0.5, 0.0), [0.5, 0.25]);
        // However long a step may be, the youngest filaments take the shortest.
        for flow_s in [0.0, 1e9] {
            let long = steps(1e5, flow_s);
            assert!((31.9..=32.0).contains(&long[0]), "{long:?}");
            assert_eq!(long.len(), MOST);
            assert!((long[MOST - 1] - SHORTEST_S).abs() < 1e-3);
        }
    }

    /// Every band covers the time without gaps, in steps of its length, and all end together.
    #[test]
    fn bands_meet_at_every_longest_step_and_at_the_end() {
        let mut bands = Bands::new(3.0, 45.0, 4.0, 4.0, false);
        let mut reached = [3.0; MOST];
        while bands.next_s() < 45.0 {
            let (due, t) = (bands.due(), bands.next_s());
            bands.pass();
            for (band, reached) in reached.iter_mut().enumerate().take(bands.last() + 1).skip(due) {
                let span = bands.span(band);
                assert_eq!((span.from_s, t), (*reached, t));
                assert!(span.to_s == 45.0 || span.to_s - span.from_s == bands.step_s(band));
                *reached = span.to_s;
            }
            if due == 0 {
                assert!(reached[..=bands.last()].iter().all(|r| *r > t));
            }
        }
        assert!(reached[..=bands.last()].iter().all(|r| *r == 45.0));
        assert_eq!(Span { from_s: 2.0, to_s: 4.0 }.part(2.5), 0.25);
    }

    #[test]
    fn eddies_carry_short_steps_several_at_a_time() {
        let mut bands = Bands::new(0.0, 1.02, 0.05, 0.0, false);
        let (mut since_s, mut ends) = (0.0, Vec::new());
        while bands.next_s() < 1.02 {
            bands.pass();
            if let Some(span) = bands.carries(0, since_s) {
                assert_eq!(span.from_s, since_s);
                since_s = span.to_s;
                ends.push(span.to_s);
            }
        }
        assert_eq!(ends.len(), 6);
        assert!(ends.iter().zip([0.2, 0.4, 0.6, 0.8, 1.0, 1.02]).all(|(a, b)| (a - b).abs() < 1e-9));
        let mut long = Bands::new(0.0, 9.0, 1.0, 0.0, false);
        long.pass();
        assert_eq!(long.carries(2, 0.0), Some(long.span(2)));
    }

    #[test]
    fn only_old_filaments_in_gentle_water_take_long_steps() {
        let size = Size::new(&ReleaseSpec::default());
        let duck = Scales { fastest_m_s: 0.3, k_h_m2_s: 0.01, k_z_m2_s: 2e-3, reach_m: 20.0 };
        let ages = [0.3125, 1.25, 5.0].map(|step_s| duck.age_s(&size, step_s));
        assert!(ages[0] < 20.0 && ages[1] < 60.0 && ages[2] < 250.0, "{ages:?}");
        assert!(ages[0] < ages[1] && ages[1] < ages[2]);
        assert!(duck.age_s(&size, 40.0).is_infinite());
        let never =
            Size::new(&ReleaseSpec { vertical_size_limit_m: Some(Positive::new(0.05)), ..ReleaseSpec::default() });
        assert!(duck.age_s(&never, 5.0).is_infinite());
    }
}
