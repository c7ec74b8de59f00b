//! Studies with the library: a campaign of your own, and figures and measurements of the documents.
//!
//! `cargo run --release -p rheotaxis-studies --example studies` lists them, and with a name behind it runs one. Each file is a
//! whole program: copy one as your `main.rs`.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "examples speak")]

mod hull_speed;
mod kinematic_cost;
mod mosaic;
mod own_campaign;
mod rising_thread;
mod scale;

use std::error::Error;
use std::process::ExitCode;

/// Name, what it shows, and the example itself.
type Example = (&'static str, &'static str, fn() -> Result<(), Box<dyn Error>>);

/// What a table of times needs above it: version, command, and the machine that it was measured on.
fn head(name: &str) -> String {
    let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = about.lines().find(|line| line.starts_with("model name")).and_then(|line| line.split(':').nth(1));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "Version {}, `cargo run --release -p rheotaxis-studies --example studies {name}`, {} with {cores} cores:\n",
        env!("CARGO_PKG_VERSION"),
        model.unwrap_or(std::env::consts::ARCH).trim(),
    )
}

const EXAMPLES: [Example; 6] = [
    ("own_campaign", "a campaign over arms of your own", own_campaign::main),
    ("rising_thread", "the crab's plume from the side, beside a neutral one [FILE.png]", rising_thread::main),
    ("mosaic", "the pictures of a source added up [FILE.png]", mosaic::main),
    ("hull_speed", "how fast a hull alone is computed", hull_speed::main),
    (
        "kinematic_cost",
        "what a mission of a kinematic vehicle costs beside its plume [PART OF A NAME]",
        kinematic_cost::main,
    ),
    ("scale", "how cost grows with filaments, robots and lanes [FILE.svg]", scale::main),
];

fn main() -> ExitCode {
    let name = std::env::args().nth(1).unwrap_or_default();
    let Some((.., example)) = EXAMPLES.iter().find(|(known, ..)| *known == name) else {
        println!("usage: cargo run --release -p rheotaxis-studies --example studies NAME\n");
        for (name, what, _) in EXAMPLES {
            println!("  {name:<16}{what}");
        }
        return ExitCode::from(if name.is_empty() { 0 } else { 2 });
    };
    match example() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{name}: {error}");
            ExitCode::FAILURE
        }
    }
}
