//! `rheotaxis check`: reads and checks scenarios without running them.

use crate::args::CheckArgs;
use crate::exit::Exit;
use crate::say;
use rheotaxis::scenario::cost;
use world::cost::memory;
use world::registry::Registry;

/// Checks every file, also after one with mistakes.
pub(crate) fn check(registry: &Registry, args: &CheckArgs) -> Exit {
    let mut exit = Exit::Success;
    for file in &args.files {
        match say::checked(registry, file) {
            Ok(loaded) => {
                let s = &loaded.scenario;
                say::line(format_args!(
                    "{}: fine: {} ({}, {}, {})",
                    file.display(),
                    s.title,
                    say::count(s.robots.len() as u64, "robot"),
                    say::count(s.sources.len() as u64, "source"),
                    say::count(s.obstacles.len() as u64, "obstacle")
                ));
                let cost = cost::cost(s);
                say::line(format_args!(
                    "  a run takes about {} of memory; memory and time go into",
                    memory(cost.bytes())
                ));
                for part in cost::greatest(&cost) {
                    say::line(format_args!("    {part}"));
                }
            }
            Err(error) => {
                say::scenario_error(&error);
                exit = Exit::Error;
            }
        }
    }
    exit
}
