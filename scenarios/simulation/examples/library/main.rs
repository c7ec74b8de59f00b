//! Examples of the library: runs, and algorithms, systems and machines of your own.
//!
//! `cargo run --release --example library` lists them, and with a name behind it runs one. Each file is a
//! whole program: copy one as your `main.rs`.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "examples speak")]

mod own_apparatus;
mod own_controller;
mod own_current;
mod own_sensor;
mod own_strategy;
mod own_system;
mod own_topic;
mod shortest;
mod stepped;

use std::error::Error;
use std::process::ExitCode;

/// Name, what it shows, and the example itself.
type Example = (&'static str, &'static str, fn() -> Result<(), Box<dyn Error>>);

const EXAMPLES: [Example; 9] = [
    (
        "shortest",
        "the shortest run: a scenario that comes with the program, and what was declared in it",
        shortest::main,
    ),
    ("stepped", "a run in steps: the state every minute, and the water at the vehicle", stepped::main),
    ("own_strategy", "a strategy: up-stream until it smells something", own_strategy::main),
    ("own_controller", "a controller that the run asks once a second", own_controller::main),
    ("own_current", "a current: a jet", own_current::main),
    ("own_sensor", "a sensor: the pressure of the water", own_sensor::main),
    ("own_system", "a system of the tick that counts sharp turns", own_system::main),
    ("own_topic", "a topic of live state and recording", own_topic::main),
    ("own_apparatus", "an apparatus beside robots and gantries: a moored buoy", own_apparatus::main),
];

fn main() -> ExitCode {
    let name = std::env::args().nth(1).unwrap_or_default();
    let Some((.., example)) = EXAMPLES.iter().find(|(known, ..)| *known == name) else {
        println!("usage: cargo run --release --example library NAME\n");
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
