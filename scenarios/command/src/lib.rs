//! The command `rheotaxis`: it reads arguments, calls the libraries and prints what they return.
#![deny(unsafe_code)]

mod args;
mod args_cache;
mod args_campaign;
mod args_control;
mod args_explain;
mod args_init;
mod args_key;
mod args_live;
mod args_picture;
mod args_reproduce;
mod args_ros2;
mod args_values;
mod args_vehicle;
mod args_vision;
mod cache;
mod campaign;
mod campaign_plan;
mod campaign_report;
mod check;
mod exit;
mod explain;
mod failure;
mod init;
mod lane_observers;
mod list;
mod listen;
mod picture;
mod progress;
mod reproduce;
mod rerun;
mod run;
mod run_observer;
mod say;
mod score_vision;
mod segment;
mod signals;
mod statistics;
mod stop;
mod topics;
mod vehicle;
mod vehicle_fly;
mod version;

pub use args::{Args, CheckArgs, Command, ListArgs, ListKind, RunArgs, StatisticsArgs};
pub use args_cache::{CacheArgs, CacheCommand, CacheCommandArgs, CachePlace};
pub use args_campaign::{
    CampaignArgs, CampaignCommand, CampaignRunArgs, MergeArgs, PlanArgs, ReportArgs, RerunArgs, StatusArgs,
};
pub use args_control::{ControlArgs, RerunMcapArgs};
pub use args_explain::ExplainArgs;
pub use args_init::InitArgs;
pub use args_live::{ListenArgs, TopicsArgs};
pub use args_picture::PictureArgs;
pub use args_reproduce::ReproduceArgs;
pub use args_values::{Numbers, Speed};
pub use args_vehicle::{
    VehicleArgs, VehicleCheckArgs, VehicleCommand, VehicleFlyArgs, VehicleInitArgs, VehicleTrialsArgs,
};
pub use args_vision::{ColourArgs, EdgesArg, ScoreVisionArgs, SegmentArgs};
pub use exit::Exit;

use clap::Parser;
use failure::{Failure, refused};
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
    cost::set_limit(memory);
    let work = || dispatch(registry, command).unwrap_or_else(|error| refused(&error));
    say::end(Exit::guarded(work)).into()
}

fn dispatch(registry: &Registry, command: Command) -> Result<Exit, Failure> {
    stop::begin();
    match command {
        Command::Run(args) => run::run(registry, &args),
        Command::Rerun(args) => rerun::rerun(registry, &args),
        Command::Check(args) => Ok(check::check(registry, &args)),
        Command::Init(args) => init::init(&args),
        Command::List(args) => Ok(list::list(registry, &args)),
        Command::Explain(args) => explain::explain(registry, &args),
        Command::Topics(args) => Ok(topics::topics(registry, &args)),
        Command::Listen(args) => listen::listen(registry, &args),
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
