//! The commands, one file for each. They call the libraries and print what those return.

mod arena;
mod cache;
mod campaign;
mod check;
mod explain;
mod init;
mod list;
mod listen;
mod picture;
mod reproduce;
mod rerun;
mod run;
mod score_vision;
mod segment;
mod statistics;
mod topics;
mod vehicle;

use crate::args::Command;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::stop;
use world::registry::Registry;

/// Does what a command asks.
pub(super) fn dispatch(registry: &Registry, command: Command) -> Result<Exit, Failure> {
    stop::begin();
    match command {
        Command::Run(args) => run::run(registry, &args),
        Command::Rerun(args) => rerun::rerun(registry, &args),
        Command::Check(args) => Ok(check::check(registry, &args)),
        Command::Init(args) => init::init(&args),
        Command::List(args) => list::list(registry, &args),
        Command::Explain(args) => explain::explain(registry, &args),
        Command::Topics(args) => Ok(topics::topics(registry, &args)),
        Command::Listen(args) => listen::listen(registry, &args),
        Command::Arena(args) => arena::arena(registry, &args),
        Command::Campaign(args) => campaign::campaign(registry, &args.command),
        Command::Reproduce(args) => reproduce::run(registry, &args),
        Command::Cache(args) => cache::cache(&args),
        Command::Statistics(args) => statistics::statistics(registry, &args),
        Command::Picture(args) => picture::picture(registry, &args),
        Command::Segment(args) => segment::segment(&args),
        Command::ScoreVision(args) => score_vision::score_vision(&args),
        Command::Vehicle(args) => vehicle::vehicle(&args),
    }
}
