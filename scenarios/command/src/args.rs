//! The command line: its subcommands, their arguments and their help.

pub(super) mod arena;
pub(super) mod cache;
pub(super) mod campaign;
pub(super) mod control;
pub(super) mod explain;
pub(super) mod init;
mod key;
pub(super) mod live;
pub(super) mod picture;
pub(super) mod reproduce;
mod ros2;
pub(super) mod share;
pub(super) mod values;
pub(super) mod vehicle;
pub(super) mod vision;

use super::version;
use arena::ArenaArgs;
use cache::{CacheArgs, CacheCommandArgs};
use campaign::CampaignArgs;
use clap::{Parser, Subcommand, ValueEnum};
use control::{ControlArgs, RerunMcapArgs};
use explain::ExplainArgs;
use init::InitArgs;
use key::KeyArgs;
use live::{ListenArgs, TopicsArgs};
use picture::PictureArgs;
use reproduce::ReproduceArgs;
use ros2::Ros2Args;
use std::path::{Path, PathBuf};
use values::{Speed, bytes, within};
use vehicle::VehicleArgs;
use vision::{ScoreVisionArgs, SegmentArgs};

/// Simulator for chemical-plume tracing by underwater vehicles.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "rheotaxis",
    version,
    long_version = version::long(),
    about = "Simulates underwater vehicles that trace a chemical plume to its source",
    long_about = "Simulates underwater vehicles that trace a chemical plume to its source.\n\n\
        A scenario is a text file (RON). It describes the place, the water, the chemical sources, the vehicles that \
        search, and when the mission counts as a success. `rheotaxis run` simulates it. While it runs, it shows its \
        progress and publishes live state over zenoh. Afterwards its folder holds a recording, tables, figures and a \
        one-page report.\n\n\
        To begin, run a scenario that comes with the program, then copy and change it: see the examples below.",
    after_help = EXAMPLES,
    after_long_help = AFTER,
    max_term_width = 100
)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Memory that one run may use, such as 500M or 16G. A scenario that needs more is refused before it starts.
    #[arg(
        long,
        global = true,
        value_name = "SIZE",
        default_value = "4G",
        value_parser = bytes
    )]
    pub memory: f64,
}

const EXAMPLES: &str = "`rheotaxis COMMAND --help` explains a command; `rheotaxis --help` has examples.";

const AFTER: &str = "\
Examples:
  rheotaxis run uniform_channel         run a small scenario that comes with the program
  rheotaxis run duck_st                 run the main one: a REMUS traces a plume at Duck
  rheotaxis init duck_st mine.ron       write a copy of it to change
  rheotaxis check mine.ron              list all mistakes, with line, column and legal range
  rheotaxis run mine.ron --seed 7       run it; the results are in runs/mine-7/
  rheotaxis list sensors                list what a scenario can use, with sources
  rheotaxis explain water.currents      explain a field: unit, range, default, meaning

Exit codes:
  0    success, as each scenario defines it
  3    a mission ran to its end without success
  130  interrupted; everything recorded so far can be read
  1    error; the message on standard error explains it
  2    wrong usage";

/// What to do.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Run scenarios, one after the other.
    #[command(long_about = RUN_ABOUT)]
    Run(RunArgs),
    /// Make a recorded run again, with the answers that searchers outside the program gave.
    #[command(long_about = control::RERUN_ABOUT)]
    Rerun(RerunMcapArgs),
    /// Check scenarios without running them, and estimate what a run takes.
    #[command(long_about = CHECK_ABOUT)]
    Check(CheckArgs),
    /// Write a scenario to start from; without a name, list those that come with the program.
    #[command(long_about = INIT_ABOUT)]
    Init(InitArgs),
    /// List scenarios, algorithms, flows, sensors and vehicles, each with its source.
    #[command(long_about = LIST_ABOUT)]
    List(ListArgs),
    /// Explain a field of a scenario: unit, range, default, meaning, source.
    #[command(long_about = explain::EXPLAIN_ABOUT)]
    Explain(ExplainArgs),
    /// List the live state that a run publishes over zenoh.
    #[command(long_about = live::TOPICS_ABOUT)]
    Topics(TopicsArgs),
    /// Print what runs publish over zenoh while they go, one JSON object a line.
    #[command(long_about = live::LISTEN_ABOUT)]
    Listen(ListenArgs),
    /// Compare variants of a scenario over thousands of runs, on one machine or many.
    #[command(long_about = campaign::CAMPAIGN_ABOUT)]
    Campaign(CampaignArgs),
    /// Let published searchers, and yours, compete in several kinds of water.
    #[command(long_about = arena::ABOUT)]
    Arena(ArenaArgs),
    /// Repeat the papers' experiments over many seeds and compare the figures.
    #[command(long_about = reproduce::REPRODUCE_ABOUT)]
    Reproduce(ReproduceArgs),
    /// Show or clear the spin-ups that are kept so that they need not be made again.
    #[command(long_about = cache::ABOUT)]
    Cache(CacheCommandArgs),
    /// Measure the statistics of a scenario's water and plume and compare them with published ones.
    #[command(long_about = STATISTICS_ABOUT)]
    Statistics(StatisticsArgs),
    /// Take an underwater picture of a scenario's plume.
    #[command(long_about = picture::PICTURE_ABOUT)]
    Picture(PictureArgs),
    /// Find dye and its source in a picture by colour.
    #[command(long_about = vision::SEGMENT_ABOUT)]
    Segment(SegmentArgs),
    /// Score how well dye and source are found, on rendered pictures whose truth is known.
    #[command(long_about = vision::SCORE_VISION_ABOUT)]
    ScoreVision(ScoreVisionArgs),
    /// Check a vehicle of your own and put it through trials.
    #[command(long_about = vehicle::VEHICLE_ABOUT)]
    Vehicle(VehicleArgs),
}

/// Arguments of `run`.
#[derive(Clone, Debug, Default, PartialEq, clap::Args)]
#[command(after_help = RUN_AFTER)]
pub struct RunArgs {
    /// Scenario file, or the name of a scenario that comes with the program.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Seed of all random numbers.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
    /// The cache of spin-ups.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// Folder for the results. With several scenarios it gets one folder for each.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace files in that folder that no earlier run left there but that have the names of results.
    #[arg(long)]
    pub overwrite: bool,
    /// Speed of the simulation: `max`, `realtime`, or simulated seconds per second, such as 10.
    #[arg(long, default_value = "max", value_name = "max|realtime|X")]
    pub speed: Speed,
    /// Do not publish live state.
    #[arg(long)]
    pub no_zenoh: bool,
    /// Do not write the recording (run.mcap).
    #[arg(long)]
    pub no_record: bool,
    /// Do not show progress.
    #[arg(long, short)]
    pub quiet: bool,
    /// What others may do to the run.
    #[command(flatten)]
    pub control: ControlArgs,
    /// Configuration file of zenoh (JSON5), for routers, TLS, users and access control. docs/interfaces.md has some to
    /// start from.
    #[arg(long, value_name = "FILE", conflicts_with = "no_zenoh")]
    pub zenoh_config: Option<PathBuf>,
    /// Endpoint at which zenoh listens [default: tcp/127.0.0.1:7447, or the next free port].
    #[arg(long, value_name = "ENDPOINT", conflicts_with = "no_zenoh")]
    pub zenoh_listen: Option<String>,
    /// After the run, keep answering subscribers for this long.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, conflicts_with = "no_zenoh")]
    pub zenoh_linger: f64,
    /// ROS 2.
    #[command(flatten)]
    pub ros2: Ros2Args,
    /// Threads for the plume; 0 means one for each core. With more than one, a further one writes tables and recording,
    /// a few simulated seconds behind, unless `--speed` or a controller sets the pace. The results are the same.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub threads: usize,
}

impl RunArgs {
    /// Those of a run that nobody outside sees, for a seed under a key.
    pub(super) fn alone(seed: u64, key: &KeyArgs, out: Option<&Path>) -> Self {
        Self { seed, key: key.clone(), out: out.map(Path::to_path_buf), no_zenoh: true, ..Self::default() }
    }
}

const RUN_AFTER: &str = "\
Examples:
  rheotaxis run duck_st
  rheotaxis run mine.ron --seed 7 --out results/mine --no-zenoh
  rheotaxis run duck_st --speed realtime --zenoh-listen tcp/127.0.0.1:7500
  rheotaxis run duck_st --speed realtime --ros2

Exit codes: 0 success as the scenario defines it; 3 no success; 130 interrupted; 1 error; 2 wrong usage.
With several scenarios the worst one counts: 130, then 1, then 3.";

/// Arguments of `check`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    after_help = "Exit codes: 0 every scenario can run (there may be warnings); 1 at least one cannot; 2 wrong usage."
)]
pub struct CheckArgs {
    /// Scenario file, or the name of a scenario that comes with the program.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
}

/// Arguments of `list`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(after_help = "Examples:\n  rheotaxis list\n  rheotaxis list algorithms")]
pub struct ListArgs {
    /// What to list [default: everything].
    pub what: Option<ListKind>,
}

/// What can be listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ListKind {
    /// Scenarios that come with the program.
    Scenarios,
    /// Strategies, behaviours, declaration rules, guidance, estimators, autopilots.
    Algorithms,
    /// Currents, waves and what else moves the water.
    Flows,
    /// Instruments of robots and gantries.
    Sensors,
    /// Vehicles and gantries.
    Vehicles,
    /// Searchers and families of the arena.
    Searchers,
}

/// Arguments of `statistics`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "Examples:\n  rheotaxis statistics flume_crab\n  \
        rheotaxis statistics duck_st --seed 3 --seconds 600\n\n\
        Exit codes: 0 done, whatever the figures say; 130 interrupted; 1 error; 2 wrong usage.")]
pub struct StatisticsArgs {
    /// Scenario file, or the name of a scenario that comes with the program.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Seed of all random numbers.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
    /// Duration of the measurement, s [default: 1200 in an open channel, else the scenario's time.limit_s].
    #[arg(long, value_name = "SECONDS", value_parser = within(f64::MIN_POSITIVE..=f64::MAX, "must be a number > 0"))]
    pub seconds: Option<f64>,
    /// Folder for statistics.csv [default: runs/SCENARIO-SEED-statistics].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Do not show progress.
    #[arg(long, short)]
    pub quiet: bool,
}

/// What the help of this command begins with.
pub(super) const RUN_ABOUT: &str = "Runs scenarios. In each, the plume first develops (spin-up); then the mission begins. The developed \
        plume is kept in a cache: the next run with the same seed, and with any robots and strategy, takes it from \
        there. Scenarios that differ only in the searcher share one plume and run together, with the same results; the \
        others run one after the other.\n\n\
        The results are in runs/SCENARIO-SEED/ unless --out names another folder. Open report.html first. The folder \
        also holds summary.json, track.csv (of a gantry: probes-GANTRY.csv), the figures, and the recording run.mcap \
        for Foxglove, Lichtblick or Rerun.\n\n\
        The same scenario, seed and program give the same run, bit by bit, at any speed and with any number of \
        subscribers.";

/// What the help of this command begins with.
pub(super) const CHECK_ABOUT: &str = "Checks scenarios without running them. Every mistake is shown with file, line, column, field, value \
        and legal range. Warnings tell of what is legal but probably not meant, such as an instrument that is out of \
        range of the bed.\n\n\
        For a scenario without mistakes it estimates the time and memory of a run, and says what takes most of it.";

/// What the help of this command begins with.
pub(super) const INIT_ABOUT: &str = "Writes a scenario that comes with the program to a file, with its comments, so that you can change \
        it. An existing file is never overwritten. Without a name, the scenarios are listed.";

/// What the help of this command begins with.
pub(super) const LIST_ABOUT: &str = "Lists what a scenario can use, each with one sentence and its source: the paper, section or equation \
        it follows. `rheotaxis explain` then explains the parameters.";

/// What the help of this command begins with.
pub(super) const STATISTICS_ABOUT: &str = "Lets a scenario's plume develop without its robots, then measures it with probes that do not disturb \
        it: widths, mean concentration, intermittency, gaps between whiffs, the gamma distribution and integral times. \
        In an open channel it also measures the velocity profile and the turbulence intensities.\n\n\
        A table shows each figure beside the published one and marks those outside a factor of 0.5 to 2. The same \
        table is written to statistics.csv.";
