//! The campaign of the next round: the draws that remain possible, on fresh seeds.

use super::{Identification, NEXT};
use crate::campaign::{CampaignSpec, Seeds};
use std::fmt::Write;

/// What its file begins with.
pub(super) const HEAD: &str = "// The draws that remain after the rounds before";

/// Its file, for a number of seeds after those of the last round; `None` if the last round's seeds do not follow each
/// other.
pub fn next_round(found: &Identification, last: &CampaignSpec, seeds: u64) -> Option<String> {
    let Seeds::Literal { first, count } = last.seeds else { return None };
    let mut text = format!(
        "{HEAD}: the nearest tenth.\n(\n    version: 2,\n    \
         title: {:?},\n    base: {:?},\n    seeds: Literal(first: {}, count: {seeds}),\n    arms: [\n",
        last.title,
        last.base,
        first + count
    );
    for d in found.draws.iter().take((NEXT * found.draws.len() as f64).ceil() as usize) {
        let set: Vec<String> = d.draw.set.iter().map(|(path, value)| format!("({path:?}, {value:?})")).collect();
        let _ = writeln!(text, "        (name: {:?}, set: [{}]),", d.draw.name, set.join(", "));
    }
    text.push_str("    ],\n)\n");
    Some(text)
}
