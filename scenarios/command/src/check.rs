//! `rheotaxis check`: reads and checks scenarios without running them.

use super::args::CheckArgs;
use super::exit::Exit;
use super::say;
use rheotaxis::scenario::{cost, load_with};
use world::cost::memory;
use world::registry::Registry;

/// Checks every file, also after one with mistakes.
pub(super) fn check(registry: &Registry, args: &CheckArgs) -> Exit {
    let mut exit = Exit::Success;
    for file in &args.files {
        let checked = load_with(registry, file).and_then(|loaded| loaded.check().map(|odd| (loaded, odd)));
        match checked {
            Ok((loaded, odd)) => {
                say::warnings(&odd);
                let s = &loaded.scenario;
                say::line(format_args!(
                    "{}: fine: {} ({}, {}, {})",
                    file.display(),
                    s.title,
                    count(s.robots.len(), "robot"),
                    count(s.sources.len(), "source"),
                    count(s.obstacles.len(), "obstacle")
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

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}
