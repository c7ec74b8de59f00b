//! For tests: what `check` says about a scenario of the catalogue with some texts changed.

use super::{check, parse, template};
use std::path::Path;

/// The findings, one line of path and message each.
pub(super) fn told(name: &str, changes: &[(&str, &str)]) -> Vec<String> {
    let mut text = template(name).expect("in the catalogue").text.to_string();
    for (from, to) in changes {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text = text.replace(from, to);
    }
    let scenario = parse("changed", &text).unwrap_or_else(|e| panic!("{:?}", e.lines()));
    let found = check(&scenario, Path::new(""));
    found.iter().map(|f| format!("{}: {}", f.path, f.message)).collect()
}
