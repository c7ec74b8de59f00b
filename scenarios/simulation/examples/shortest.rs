//! The shortest run: a scenario that comes with the program, and what was declared in it.
//!
//! `cargo run --release -p rheotaxis --example shortest`

use rheotaxis::scenario::load;
use rheotaxis::trial::Trial;
use std::path::Path;

#[allow(clippy::print_stdout, reason = "an example speaks")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scenario = load(Path::new("uniform_channel"))?;
    let ended = Trial::assemble(&scenario, 1)?.finish_quietly();
    println!("{} after {:.0} s", ended.outcome.words(), ended.t_s);
    for declared in ended.declarations.values().flatten() {
        let place = declared.position;
        println!(
            "declared at {:.1} m east, {:.1} m north by {}",
            place.x, place.y, declared.rule
        );
    }
    Ok(())
}
