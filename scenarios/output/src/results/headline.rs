//! How a run ended, in one line: the title of its pictures.

use super::{DeclarationSummary, DeclaredKind, Summary};
use rheotaxis::outcome::RunOutcome;

impl Summary {
    /// Scenario, seed and outcome, such as `duck_st, seed 1: found after 1234 s, 2.1 m off`.
    pub fn headline(&self) -> String {
        format!("{}, seed {}: {}", self.scenario, self.seed, self.ended())
    }

    /// The outcome with its time, and how far off the declarations were.
    fn ended(&self) -> String {
        let robots = self.robots.iter().flat_map(|r| &r.declarations);
        let gantries = self.gantries.iter().flat_map(|g| &g.declaration);
        let declared: Vec<&DeclarationSummary> =
            (robots.chain(gantries)).filter(|d| d.kind == DeclaredKind::Source).collect();
        let last_s = declared.iter().map(|d| d.t_s).reduce(f64::max);
        let mission_s = self.run.totals.mission_s;
        let errors = declared.iter().filter_map(|d| d.error.as_ref());
        let off = match errors.map(|e| e.total_m).reduce(f64::max) {
            None => String::new(),
            Some(m) if declared.len() > 1 => format!(", at most {} off", length(m)),
            Some(m) => format!(", {} off", length(m)),
        };
        let many = match declared.len() {
            0 | 1 => String::new(),
            n => format!("{n} declarations, "),
        };
        match (self.outcome, last_s) {
            (RunOutcome::Found, Some(t_s)) => format!("{many}found after {t_s:.0} s{off}"),
            (RunOutcome::Found, None) => format!("found after {mission_s:.0} s"),
            (RunOutcome::NotFound, Some(t_s)) => {
                format!("{many}not found: declared after {t_s:.0} s{off}")
            }
            (RunOutcome::NotFound, None) => format!("not found in {mission_s:.0} s"),
            (other, _) => format!("{} after {mission_s:.0} s", other.label()),
        }
    }
}

/// A length in metres, or in centimetres if it is short.
fn length(m: f64) -> String {
    if m < 0.9995 {
        format!("{:.1} cm", 100.0 * m)
    } else if m < 99.95 {
        format!("{m:.1} m")
    } else {
        format!("{m:.0} m")
    }
}
