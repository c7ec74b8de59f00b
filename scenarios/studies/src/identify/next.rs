//! The campaign of the next round: the draws that remain possible, on fresh seeds.

use super::{Identification, LOST};
use crate::campaign::{CampaignSpec, Seeds};
use std::fmt::Write;

/// Its file, for a number of seeds after those of the last round; `None` if the last round's seeds do not follow each
/// other.
pub fn next_round(found: &Identification, last: &CampaignSpec, seeds: u64) -> Option<String> {
    let Seeds::Literal { first, count } = last.seeds else { return None };
    let mut text = format!(
        "// The draws that hold all but {LOST} of the weight after the rounds before.\n(\n    version: 2,\n    \
         title: {:?},\n    base: {:?},\n    seeds: Literal(first: {}, count: {seeds}),\n    arms: [\n",
        last.title,
        last.base,
        first + count
    );
    let mut held = 0.0;
    for d in &found.draws {
        let set: Vec<String> = d.draw.set.iter().map(|(path, value)| format!("({path:?}, {value:?})")).collect();
        let _ = writeln!(text, "        (name: {:?}, set: [{}]),", d.draw.name, set.join(", "));
        held += d.weight;
        if held >= 1.0 - LOST {
            break;
        }
    }
    text.push_str("    ],\n)\n");
    Some(text)
}
