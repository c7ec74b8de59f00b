//! The campaign of the next round: the draws that remain possible, on fresh seeds.

use super::{Identification, LEAST, LOST};
use crate::campaign::{CampaignSpec, Seeds};
use std::fmt::Write;

/// What its file begins with.
pub(super) const HEAD: &str = "// The draws that remain after the rounds before";

/// Its file, for a number of seeds after those of the last round; `None` if the last round's seeds do not follow each
/// other.
pub fn next_round(found: &Identification, last: &CampaignSpec, seeds: u64) -> Option<String> {
    let Seeds::Literal { first, count } = last.seeds else { return None };
    let mut text = format!(
        "{HEAD}: those that hold all but {LOST} of the weight, and at least {LEAST} of all.\n(\n    version: 2,\n    \
         title: {:?},\n    base: {:?},\n    seeds: Literal(first: {}, count: {seeds}),\n    arms: [\n",
        last.title,
        last.base,
        first + count
    );
    let least = (LEAST * found.draws.len() as f64) as usize;
    let mut held = 0.0;
    for (n, d) in found.draws.iter().enumerate() {
        if n >= least && held >= 1.0 - LOST {
            break;
        }
        let set: Vec<String> = d.draw.set.iter().map(|(path, value)| format!("({path:?}, {value:?})")).collect();
        let _ = writeln!(text, "        (name: {:?}, set: [{}]),", d.draw.name, set.join(", "));
        held += d.weight;
    }
    text.push_str("    ],\n)\n");
    Some(text)
}
