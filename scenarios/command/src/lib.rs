//! The command `rheotaxis`: it reads arguments, calls the libraries and prints what they return.
#![deny(unsafe_code)]

mod args;
mod commands;
mod exit;
mod failure;
mod lane_observers;
mod progress;
mod run_observer;
mod say;
mod signals;
mod stop;
mod version;

pub use args::arena::ArenaArgs;
pub use args::cache::{CacheArgs, CacheCommand, CacheCommandArgs, CachePlace};
pub use args::campaign::{
    CampaignArgs, CampaignCommand, CampaignRunArgs, MergeArgs, PlanArgs, ReportArgs, RerunArgs, StatusArgs,
};
pub use args::control::{ControlArgs, RerunMcapArgs};
pub use args::explain::ExplainArgs;
pub use args::init::InitArgs;
pub use args::live::{ListenArgs, TopicsArgs};
pub use args::picture::PictureArgs;
pub use args::reproduce::ReproduceArgs;
pub use args::values::{Numbers, Speed};
pub use args::vehicle::{
    VehicleArgs, VehicleCheckArgs, VehicleCommand, VehicleFlyArgs, VehicleInitArgs, VehicleTrialsArgs,
};
pub use args::vision::{ColourArgs, EdgesArg, ScoreVisionArgs, SegmentArgs};
pub use args::{Args, CheckArgs, Command, ListArgs, ListKind, RunArgs, StatisticsArgs};
pub use exit::Exit;

use clap::Parser;
use failure::refused;
use rheotaxis::scenario::cost;
use std::process::ExitCode;
use world::registry::Registry;

/// The whole command, from its arguments to its exit code.
pub fn main() -> ExitCode {
    main_with(&Registry::default())
}

/// The whole command for a crate that adds strategies, currents or sensors of its own. `run`, `check`, `list`,
/// `explain` and campaigns then know them.
pub fn main_with(registry: &Registry) -> ExitCode {
    signals::ignore_limits();
    let Args { command, memory } = match Args::try_parse() {
        Ok(args) => args,
        // Wrong usage, or `--help` and the like.
        Err(said) => return say::usage(&said).into(),
    };
    let registry = cost::with_limit(registry.clone(), memory);
    let work = || commands::dispatch(&registry, command).unwrap_or_else(|error| refused(&error));
    say::end(Exit::guarded(work)).into()
}
