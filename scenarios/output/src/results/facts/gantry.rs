//! The facts about a gantry: how it ended, its motions, and how it went up-stream.

use super::{Fact, moment};
use crate::results::GantrySummary;

impl GantrySummary {
    /// Its facts, in the order in which a page shows them.
    pub(super) fn facts(&self) -> Vec<Fact> {
        let stopped = match self.stopped {
            Some(true) => "declared a source",
            Some(false) => "gave up",
            None => "did not stop",
        };
        let mut facts = vec![Fact::brief("Stopped", stopped.to_owned())];
        if let Some(d) = &self.declaration {
            let error = d.error.as_ref().map(|e| format!(", {}", e.in_words(100.0, "cm")));
            facts.push(Fact::brief("Declared", format!("at {:.1} s{}", d.t_s, error.unwrap_or_default())));
        }
        facts.push(Fact::new("First sweep over", moment(self.sweep_s)));
        let spikes = format!("{} scans, the first at {}", self.spikes, moment(self.first_spike_s));
        facts.push(Fact::brief("Scans with a spike", spikes));
        let [steps, casts, sweeps] = self.moves;
        facts.push(Fact::brief("Motions", format!("{steps} steps up-stream, {casts} casts, {sweeps} full sweeps")));
        let tracked = self.tracked_m.map(|m| format!("; {m:.2} m from the first step up-stream"));
        facts.push(Fact::brief("Path", format!("{:.2} m{}", self.travelled_m, tracked.unwrap_or_default())));
        if let (Some(v), Some(ngdr)) = (self.speed_m_s, self.ngdr) {
            let way = format!("{:.1} cm/s; straight way over path (NGDR) {ngdr:.2}", 100.0 * v);
            facts.push(Fact::brief("From the first step up-stream", way));
        }
        facts.push(Fact::new("Speed", far_near(self.speed_far_near_m_s, "cm/s")));
        facts.push(Fact::new("From the centreline", far_near(self.offset_far_near_m, "cm")));
        if self.blocked {
            facts.push(Fact::brief("Blocked", "a drive gave up against something in the way".to_owned()));
        }
        facts
    }
}

/// A length or a speed far from the source and near it.
fn far_near([far, near]: [Option<f64>; 2], unit: &str) -> String {
    let value = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| format!("{:.1} {unit}", 100.0 * v));
    format!("{} at 100–50 cm, {} at 50–0 cm", value(far), value(near))
}
