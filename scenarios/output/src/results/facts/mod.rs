//! What a summary says in words: names and values, for the page and in part for the terminal.

mod gantry;
mod robot;

use super::Summary;

/// A fact about a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// What it is.
    pub name: String,
    /// The value with its unit.
    pub value: String,
    /// Whether the terminal says it too; otherwise only the page does.
    pub brief: bool,
}

impl Fact {
    fn new(name: impl Into<String>, value: String) -> Self {
        Self { name: name.into(), value, brief: false }
    }

    fn brief(name: impl Into<String>, value: String) -> Self {
        Self { brief: true, ..Self::new(name, value) }
    }
}

impl Summary {
    /// The facts about each robot and each gantry, in the order of the scenario: what it is, its id, its facts.
    pub fn machine_facts(&self) -> Vec<(&'static str, &str, Vec<Fact>)> {
        let robots = self.robots.iter().map(|r| ("Robot", r.id.as_str(), r.facts()));
        let gantries = self.gantries.iter().map(|g| ("Gantry", g.id.as_str(), g.facts()));
        robots.chain(gantries).collect()
    }

    /// The facts about the run itself.
    pub fn run_facts(&self) -> Vec<Fact> {
        let t = &self.run.totals;
        let mission = format!("{:.1} s in {} steps, {:.1} s of wall time", t.mission_s, t.steps, t.mission_wall_s);
        let kept = if t.spin_up_kept { ", taken from the cache" } else { "" };
        let spin_up = format!("{:.0} s, {:.1} s of wall time{kept}", t.spin_up_s, t.spin_up_wall_s);
        let mut facts = vec![Fact::new("Mission", mission), Fact::brief("Spin-up", spin_up)];
        if let (Some(a), Some(b)) = (self.run.real_time_factor, self.run.real_time_factor_with_spin_up) {
            let speed = format!("{a:.0} × real time; {b:.0} × with the spin-up's wall time");
            facts.push(Fact::brief("Speed", speed));
        }
        facts.push(Fact::new("Filaments at the end", t.filaments.to_string()));
        if let Some(m) = t.mass {
            let mass = format!(
                "released {:.4} kg, in the water {:.4} kg, carried out {:.4} kg, imbalance {:.1e} kg",
                m.released_kg, m.in_water_kg, m.left_kg, m.imbalance_kg
            );
            facts.push(Fact::new("Chemical", mass));
        }
        let v = &self.versions;
        let versions = format!("rheotaxis {}, scenario format {}, rapier3d {}", v.rheotaxis, v.scenario, v.rapier3d);
        facts.push(Fact::new("Versions", versions));
        facts.push(Fact::brief("Digest", self.digest.clone()));
        facts
    }
}

/// A moment, or that it never came.
fn moment(t_s: Option<f64>) -> String {
    t_s.map_or_else(|| "never".to_owned(), |t| format!("{t:.1} s"))
}
