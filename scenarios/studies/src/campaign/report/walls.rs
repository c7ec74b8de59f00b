//! How the wall time of many runs was spent.

use crate::campaign::RunRow;

/// Sums over runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Walls {
    /// Number of runs.
    pub(crate) runs: usize,
    /// Number of runs that took over a spin-up.
    pub(crate) shared: usize,
    /// Wall time of all spin-ups, s.
    pub(crate) spin_up_s: f64,
    /// Wall time of all missions, s.
    pub(crate) mission_s: f64,
}

impl Walls {
    pub(crate) fn sum<'a>(rows: impl IntoIterator<Item = &'a RunRow>) -> Self {
        let mut walls = Self::default();
        for r in rows {
            walls.runs += 1;
            walls.shared += usize::from(r.error.is_none() && r.spin_up_wall_s == 0.0);
            walls.spin_up_s += r.spin_up_wall_s;
            walls.mission_s += r.mission_wall_s;
        }
        walls
    }

    /// The sums in a sentence.
    pub(crate) fn describe(&self) -> String {
        let total = self.spin_up_s + self.mission_s;
        if total <= 0.0 {
            return "Wall time: none measured.".to_string();
        }
        let mut out = format!(
            "Wall time, all threads: {total:.0} s, {:.1} s a run; spin-up {:.0} % ({:.0} s), mission {:.0} % ({:.0} s).",
            total / self.runs as f64,
            100.0 * self.spin_up_s / total,
            self.spin_up_s,
            100.0 * self.mission_s / total,
            self.mission_s
        );
        if self.shared > 0 {
            let paid = self.runs - self.shared;
            let saved = if paid > 0 { self.spin_up_s / paid as f64 * self.shared as f64 } else { 0.0 };
            out.push_str(&format!(
                " {} runs took their spin-up over from another: about {saved:.0} s saved.",
                self.shared
            ));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::row;
    use super::*;

    #[test]
    fn says_where_the_time_went_and_what_was_saved() {
        let paid = RunRow { spin_up_wall_s: 3.0, mission_wall_s: 1.0, ..row(0, None) };
        let shared = RunRow { spin_up_wall_s: 0.0, mission_wall_s: 2.0, ..row(1, None) };
        let said = Walls::sum(&[paid, shared]).describe();
        assert!(said.contains("6 s, 3.0 s a run; spin-up 50 % (3 s), mission 50 % (3 s)"), "{said}");
        assert!(said.contains("1 runs took their spin-up over from another: about 3 s saved"), "{said}");
        assert_eq!(Walls::sum(&[]).describe(), "Wall time: none measured.");
    }
}
