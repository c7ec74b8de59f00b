//! For tests: scenarios of the catalogue with values (RON) at some paths, and what is said of them.

use crate::scenario::{Loaded, ScenarioError, check, load_text, set_value, template};
use robots::strategy::{ExternalSpec, StrategySpec};
use std::path::Path;
use world::ranges::{NonNegative, Positive};
use world::registry::Registry;

/// The scenario that most tests change.
pub(crate) const CHANNEL: &str = "uniform_channel";

/// What `check` says when all is well.
pub(crate) const NOTHING: [&str; 0] = [];

/// A scenario of the catalogue with values at some paths.
pub(crate) fn with(registry: &Registry, name: &str, values: &[(&str, &str)]) -> Result<Loaded, ScenarioError> {
    let text = template(name).expect("in the catalogue").text.to_string();
    let text = values.iter().fold(text, |text, (path, value)| set_value(&text, path, value).expect(path));
    load_text(registry, "changed", &text)
}

/// The same with what comes with the program, where all of it can be read.
#[track_caller]
pub(crate) fn changed(name: &str, values: &[(&str, &str)]) -> Loaded {
    with(&Registry::default(), name, values).unwrap_or_else(|e| panic!("{:?}", e.lines()))
}

/// What `check` says of it, one line of path and message each.
#[track_caller]
pub(crate) fn told(name: &str, values: &[(&str, &str)]) -> Vec<String> {
    let found = check(&changed(name, values).scenario, Path::new("/nowhere"));
    found.iter().map(|f| format!("{}: {}", f.path, f.message)).collect()
}

/// The one thing that `check` says of it.
#[track_caller]
pub(crate) fn told_once(name: &str, values: &[(&str, &str)]) -> String {
    let mut all = told(name, values);
    assert_eq!(all.len(), 1, "{values:?}: {all:?}");
    all.remove(0)
}

/// What the reader says first of the channel with a value at a path: place, path and message.
pub(crate) fn refused(path: &str, value: &str) -> String {
    with(&Registry::default(), CHANNEL, &[(path, value)]).expect_err(value).lines().remove(0)
}

/// The channel, cut short.
pub(crate) fn short_channel(registry: &Registry, spin_up_s: f64, limit_s: f64) -> Loaded {
    let channel = with(registry, CHANNEL, &[]).expect("legal");
    channel.edit(|scenario| {
        scenario.time.spin_up_s = NonNegative::new(spin_up_s);
        scenario.time.limit_s = Positive::new(limit_s);
    })
}

/// A searcher outside that is asked with this period.
pub(crate) fn external(period_s: f64) -> StrategySpec {
    StrategySpec::new(ExternalSpec { period_s: Positive::new(period_s), ..ExternalSpec::default() })
}
