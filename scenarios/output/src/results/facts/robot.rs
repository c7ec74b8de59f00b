//! The facts about a robot: what it declared, what became of each subregion, and its way.

use super::{Fact, moment};
use crate::results::{DeclarationSummary, DeclaredKind, Position, RobotSummary};
use robots::handoff::Verdict;

impl RobotSummary {
    /// Its facts, in the order in which a page shows them.
    pub(super) fn facts(&self) -> Vec<Fact> {
        let mut facts = Vec::new();
        if self.sources_declared == 0 {
            facts.push(Fact::brief("Declared source", "none".to_owned()));
        }
        for d in &self.declarations {
            facts.extend(declaration(d, self.sources_declared > 1));
        }
        if let Some(remark) = self.map.as_ref().and_then(|m| m.remark.as_ref()) {
            facts.push(Fact::brief("Beware", remark.clone()));
        }
        for region in &self.regions {
            let searched = match (region.from_s, region.until_s) {
                (Some(from), Some(until)) => format!(", searched from {from:.0} to {until:.0} s"),
                _ => String::new(),
            };
            let state = format!("{}{searched}", region.state.label());
            facts.push(Fact::brief(format!("Subregion {}", region.name), state));
        }
        facts.extend(self.way());
        facts
    }

    fn way(&self) -> Vec<Fact> {
        let first = self.first_detection_s.map(|t| format!(", the first at {}", moment(Some(t))));
        let detections = format!("{}{}", self.detections, first.unwrap_or_default());
        let mut facts = vec![Fact::brief("Detections", detections)];
        if let Some(m) = self.traced_m {
            let traced = format!("{m:.0} m from the first detection to the first declaration");
            facts.push(Fact::brief("Traced", traced));
        }
        facts.push(Fact::brief("Travelled", format!("{:.0} m", self.travelled_m)));
        let [last, most] = [self.final_position_error_m, self.greatest_position_error_m];
        facts.push(Fact::new("Error of its own position", format!("{last:.1} m at the end, {most:.1} m at most")));
        for (name, value) in &self.last_numbers {
            facts.push(Fact::new(format!("Last {name}"), format!("{value}")));
        }
        let times: Vec<String> = self.behaviour_s.iter().map(|(b, s)| format!("{b} {s:.0} s")).collect();
        facts.push(Fact::new("Time in behaviours", times.join(", ")));
        facts
    }
}

fn place(p: Position) -> String {
    format!("{:.1} m east, {:.1} m north", p.east_m, p.north_m)
}

fn declaration(d: &DeclarationSummary, several: bool) -> Vec<Fact> {
    let region = d.region_name.as_deref();
    if d.kind == DeclaredKind::UpFlowEdge {
        // This declaration does not claim a source here, so the distance to the nearest one is no error.
        let name = format!("Up-flow edge of subregion {}", region.unwrap_or("the area"));
        let what = format!("the plume leads on over it, {} at {:.0} s", place(d.position), d.t_s);
        return vec![Fact::brief(name, what)];
    }
    let which = if several { d.name.trim_start_matches("source") } else { "" };
    let region = region.map_or_else(String::new, |k| format!(", in subregion {k}"));
    let declared = format!("{} at {:.0} s ({}){region}", place(d.position), d.t_s, d.rule);
    let mut facts = vec![Fact::brief(format!("Declared source{which}"), declared)];
    if d.verdict != Verdict::Unchecked {
        facts.push(Fact::brief(format!("Looked at{which}"), look(d)));
    }
    if let Some(p) = d.surveyed {
        let error = d.surveyed_error.as_ref().map(|e| format!("; {:.1} m from {}", e.total_m, e.source));
        let found = format!("{}{}", place(p), error.unwrap_or_default());
        facts.push(Fact::brief(format!("Found by the survey{which}"), found));
    }
    if let Some(e) = &d.error {
        facts.push(Fact::new("Nearest true source", format!("{} ({})", place(e.position), e.source)));
        facts.push(Fact::brief("Error", e.in_words(1.0, "m")));
    }
    if let Some(m) = d.fix_m {
        let moved = format!("moved its own position by {m:.1} m in the minute before");
        facts.push(Fact::new("Position fixes", moved));
    }
    facts
}

/// What a look at a declared place said, and by which pictures.
fn look(d: &DeclarationSummary) -> String {
    let verdict = d.verdict.label();
    let Some(l) = &d.looked else { return verdict.to_owned() };
    let visibility = l.visibility_m.map_or_else(String::new, |m| format!(", visibility {m:.1} m"));
    let useless = if l.useless > 0 { format!("; {} more showed nothing", l.useless) } else { String::new() };
    format!(
        "{verdict} by {} pictures from {} lines, the lowest {:.1} m above the bed: ln of the Bayes factor \
         {:+.1}{visibility}{useless}",
        l.pictures, l.lines, l.lowest_m, l.log_factor
    )
}
