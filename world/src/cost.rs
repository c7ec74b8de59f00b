//! Memory and time that a scenario will need, estimated by plain arithmetic before anything is built.
//!
//! Every specification whose size or work depends on numbers in the file has a method `cost` beside `build`. All
//! numbers are `f64`: a product that is too large becomes infinite, and [`Cost::fits`] treats NaN as too much.
//!
//! *Calibration*: times are for one core of an AMD EPYC in a virtual machine, from runs of duck_st, uniform_channel,
//! flume_crab_paper, harbour_3d, wp_laminar and moth_eyes. They weigh parts against each other and tell hours from
//! seconds. They are not shown: on another machine, and for inputs unlike these, they may be far off.

use crate::limits::shown;
use crate::math;

/// The times of a scenario, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// Step of the physics.
    pub step_s: f64,
    /// Length of the spin-up.
    pub spin_up_s: f64,
    /// Step of the plume during the spin-up.
    pub spin_up_period_s: f64,
    /// Longest mission.
    pub mission_s: f64,
    /// Step of the plume during the mission.
    pub drift_period_s: f64,
    /// Time between two evaluations of the flow for the plume; 0 means every step of the plume.
    pub flow_period_s: f64,
}

impl Times {
    /// Spin-up and mission, s.
    pub fn whole_s(&self) -> f64 {
        self.spin_up_s + self.mission_s
    }

    /// Number of steps of the plume.
    pub fn drifts(&self) -> f64 {
        // A step ends where the flow is renewed.
        let step = |period_s: f64| match self.flow_period_s > 0.0 {
            true => period_s.min(self.flow_period_s),
            false => period_s,
        };
        self.spin_up_s / step(self.spin_up_period_s) + self.mission_s / step(self.drift_period_s)
    }

    /// How often the flow is evaluated for the plume.
    pub fn sums(&self) -> f64 {
        let every = |period_s: f64| self.flow_period_s.max(period_s);
        2.0 + self.spin_up_s / every(self.spin_up_period_s) + self.mission_s / every(self.drift_period_s)
    }
}

/// How the need of a part depends on its field: proportional to a power of the field's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// The field's value.
    pub value: f64,
    /// The exponent.
    pub power: f64,
}

/// One thing that takes memory or time.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Path of the field that determines it, such as `sources[0].release.rate_hz`.
    pub path: String,
    /// What it is, and how many there are.
    pub what: String,
    /// Memory, bytes.
    pub bytes: f64,
    /// Computing time for the whole run, s.
    pub seconds: f64,
    /// How memory and time depend on the field, if as a power of its value.
    pub rule: Option<Rule>,
}

impl Part {
    /// A part that depends on no single number.
    pub fn new(path: impl Into<String>, what: impl Into<String>) -> Self {
        Self { path: path.into(), what: what.into(), bytes: 0.0, seconds: 0.0, rule: None }
    }

    /// Sets the memory that it takes, bytes.
    #[must_use]
    pub fn holds(mut self, bytes: f64) -> Self {
        self.bytes = bytes;
        self
    }

    /// Sets the time that it takes, s.
    #[must_use]
    pub fn takes(mut self, seconds: f64) -> Self {
        self.seconds = seconds;
        self
    }

    /// Memory and time are proportional to `value` to the power `power`.
    #[must_use]
    pub fn by(mut self, value: f64, power: f64) -> Self {
        self.rule = Some(Rule { value, power });
        self
    }

    /// The values of the field for which the part needs at most `bytes`, in words: "must be at most 3.2".
    pub fn legal(&self, bytes: f64) -> Option<String> {
        let rule = self.rule?;
        // One percent less, to stay on the safe side.
        let most = rule.value * math::powf(0.99 * bytes / self.bytes, 1.0 / rule.power);
        let legal = most.is_finite() && most > 0.0;
        let side = if rule.power > 0.0 { "most" } else { "least" };
        legal.then(|| format!("must be at {side} {}", shown(rounded(most, rule.power < 0.0))))
    }
}

/// Rounds to three digits, up or down.
fn rounded(v: f64, up: bool) -> f64 {
    let text = format!("{v:.2e}");
    let near: f64 = text.parse().unwrap_or(v);
    let exponent: i32 = text.split('e').nth(1).and_then(|e| e.parse().ok()).unwrap_or(0);
    let digit = format!("1e{}", exponent - 2).parse().unwrap_or(0.0);
    let off: f64 = match (up, near < v) {
        (true, true) => near + digit,
        (false, false) if near > v => near - digit,
        _ => near,
    };
    format!("{off:.2e}").parse().unwrap_or(off)
}

/// What a specification or a whole scenario needs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cost {
    /// Each thing that takes memory or time.
    pub parts: Vec<Part>,
}

impl Cost {
    /// A cost with one part.
    pub fn single(part: Part) -> Self {
        Self { parts: vec![part] }
    }

    /// Adds the parts of another cost.
    pub fn add(&mut self, other: Cost) {
        self.parts.extend(other.parts);
    }

    /// Puts a prefix in front of all paths.
    #[must_use]
    pub fn under(mut self, path: &str) -> Self {
        for part in &mut self.parts {
            part.path = if part.path.is_empty() { path.to_owned() } else { format!("{path}.{}", part.path) };
        }
        self
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> f64 {
        self.parts.iter().map(|p| p.bytes).sum()
    }

    /// Computing time, s.
    pub fn seconds(&self) -> f64 {
        self.parts.iter().map(|p| p.seconds).sum()
    }

    /// Whether `bytes` of memory suffice; false if the need is not known.
    pub fn fits(&self, bytes: f64) -> bool {
        self.bytes() <= bytes
    }

    /// The part that takes most memory.
    pub fn largest(&self) -> Option<&Part> {
        // NaN sorts last, so it counts as the greatest.
        self.parts.iter().max_by(|a, b| a.bytes.total_cmp(&b.bytes))
    }

    /// The part that takes most time.
    pub fn slowest(&self) -> Option<&Part> {
        self.parts.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }
}

/// A time in words.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.5 => format!("{:.1} s", s.max(0.1)),
        s if s < 100.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.0} h", s / 3600.0),
        s if s < 1e8 => format!("{:.0} days", s / 86_400.0),
        s if s < 1e12 => format!("{:.0} years", s / 3.156e7),
        _ => "more than a lifetime".to_owned(),
    }
}

/// A size of memory in words.
pub fn memory(bytes: f64) -> String {
    match bytes {
        b if b < 1e9 => format!("{:.0} MB", (b / 1e6).max(1.0)),
        b if b < 1e13 => format!("{:.1} GB", b / 1e9),
        b if b.is_finite() => format!("{:.0e} GB", b / 1e9),
        _ => "more than any machine's memory".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_too_much() {
        let nan = Cost::single(Part::new("a", "x").holds(f64::INFINITY * 0.0));
        assert!(!nan.fits(1e300));
        let mut two = Cost::single(Part::new("a", "x").holds(1e308 * 10.0));
        two.add(Cost::single(Part::new("b", "y").holds(5.0)));
        assert!(!two.fits(1e300));
        assert_eq!(two.largest().unwrap().path, "a");
        assert!(Cost::default().fits(0.0));
    }

    #[test]
    fn the_legal_value_needs_no_more_than_is_there() {
        // 1000 filaments for each hertz, 100 bytes each.
        let at = |hz: f64| Part::new("rate_hz", "filaments").holds(1e5 * hz).by(hz, 1.0);
        assert_eq!(at(1e6).legal(1e9).unwrap(), "must be at most 9900");
        // Cells of a plane: memory goes with the inverse square of their size.
        let of = |m: f64| Part::new("cell_m", "cells").holds(1e6 / (m * m)).by(m, -2.0);
        let said = of(1e-3).legal(1e9).unwrap();
        assert_eq!(said, "must be at least 0.0318");
        assert!(of(0.0318).bytes <= 1e9 && of(0.031).bytes > 1e9);
        assert_eq!(Part::new("a", "b").holds(9.0).legal(1.0), None);
    }

    #[test]
    fn paths_go_below_another() {
        let cost = Cost::single(Part::new("grid", "cells")).under("robots[0].map");
        assert_eq!(cost.parts[0].path, "robots[0].map.grid");
        let whole = Cost::single(Part::new("", "hull")).under("robots[0]");
        assert_eq!(whole.parts[0].path, "robots[0]");
    }

    #[test]
    fn times_and_sizes_are_said_as_people_say_them() {
        let times = [0.0, 12.4, 600.0, 4e4, 1e6, 1e10, f64::NAN].map(duration);
        assert_eq!(times, ["0.1 s", "12 s", "10 min", "11 h", "12 days", "317 years", "more than a lifetime"]);
        let sizes = [6.2e7, 2.4e9, 1e18, f64::INFINITY].map(memory);
        assert_eq!(sizes, ["62 MB", "2.4 GB", "1e9 GB", "more than any machine's memory"]);
    }
}
