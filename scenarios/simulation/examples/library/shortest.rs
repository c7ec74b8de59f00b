//! The shortest run: a scenario that comes with the program, and what was declared in it.
//!
//! `cargo run --release --example library shortest`

use rheotaxis::scenario::load;
use rheotaxis::trial::Trial;
use std::path::Path;

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The name of a scenario in the catalogue, or the path of a file.
    let scenario = load(Path::new("uniform_channel"))?;
    // The seed is 1. The same seed gives the same run, bit by bit.
    let ended = Trial::assemble(&scenario, 1)?.finish_quietly();
    println!("{} after {:.0} s", ended.outcome.label(), ended.t_s);
    for declared in ended.declarations.values().flatten() {
        let place = declared.position;
        println!("declared at {:.1} m east, {:.1} m north by {}", place.x, place.y, declared.rule);
    }
    if ended.declarations.is_empty() {
        return Err("nothing was declared".into());
    }
    Ok(())
}
