//! What the command can be asked.

use super::args_campaign::CampaignArgs;
use super::args_explain::ExplainArgs;
use super::args_key::KeyArgs;
use super::args_picture::PictureArgs;
use super::args_reproduce::ReproduceArgs;
use super::args_vision::{ScoreVisionArgs, SegmentArgs};
use super::version;
use clap::{Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use std::str::FromStr;

/// Simulator for chemical-plume tracing by underwater vehicles.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "rheotaxis",
    version,
    long_version = version::long(),
    about = "Simulates underwater vehicles that trace a chemical plume to its source",
    long_about = "Simulates underwater vehicles that trace a chemical plume to its source.\n\n\
        A scenario file (RON) says where, in which water, what is released, who searches and when it \
        counts as found. A run steps it all, shows its progress, publishes live state over zenoh, and \
        leaves a folder with a recording, tables, figures and a one-page report.",
    after_help = EXAMPLES,
    after_long_help = AFTER,
    max_term_width = 100
)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Memory that one run may take, such as 500M or 16G: a scenario that needs more is refused before it starts.
    #[arg(
        long,
        global = true,
        value_name = "SIZE",
        default_value = "4G",
        value_parser = bytes
    )]
    pub memory: f64,
}

/// A size of memory: a number of bytes, or of K, M, G or T (thousands).
fn bytes(s: &str) -> Result<f64, String> {
    let units = [('K', 1e3), ('M', 1e6), ('G', 1e9), ('T', 1e12)];
    let last = s.chars().last().map(|c| c.to_ascii_uppercase());
    let unit = units.into_iter().find(|(name, _)| Some(*name) == last);
    let (number, times) = unit.map_or((s, 1.0), |(_, times)| (&s[..s.len() - 1], times));
    match number.trim().parse::<f64>() {
        Ok(n) if n * times >= 1e6 && (n * times).is_finite() => Ok(n * times),
        Ok(n) if n >= 0.0 => Err("must be at least 1M".to_string()),
        _ => Err("must be a size such as 500M, 4G or 1.5T".to_string()),
    }
}

const EXAMPLES: &str =
    "`rheotaxis help COMMAND` or `--help` says more, with examples and exit codes.";

const AFTER: &str = "\
Examples:
  rheotaxis run duck_st                 the main scenario, as it comes with the program
  rheotaxis init duck_st mine.ron       a copy to change
  rheotaxis check mine.ron              what is wrong with it: file, line, column, legal range
  rheotaxis run mine.ron --seed 7       run it, into runs/mine-7/
  rheotaxis list sensors                what a scenario can ask for, each with its source
  rheotaxis explain water.currents      what a field means: unit, range, default

Exit codes:
  0    every mission ended as its scenario defines success
  3    ran to the end, but not found
  130  interrupted; what was recorded is whole
  1    error, explained on standard error
  2    wrong usage";

/// What to do.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Run scenarios, one after the other.
    Run(RunArgs),
    /// Read and check scenarios without running them.
    Check(CheckArgs),
    /// Write a scenario to start from; alone, list those there are.
    Init(InitArgs),
    /// List scenarios, algorithms, flows, sensors and vehicles, each with its source.
    List(ListArgs),
    /// Explain a field of a scenario: unit, range, default, meaning, source; alone, the top of a scenario.
    Explain(ExplainArgs),
    /// List what a run publishes over zenoh.
    Topics(TopicsArgs),
    /// Run thousands of seeds, arms and conditions, on one machine or many, and compare them.
    Campaign(CampaignArgs),
    /// Run the papers' experiments over many seeds and show our figures beside theirs.
    Reproduce(ReproduceArgs),
    /// Watch a scenario's water and plume and show their statistics beside published ones.
    Statistics(StatisticsArgs),
    /// Take a picture of a scenario's plume from anywhere in the water.
    Picture(PictureArgs),
    /// Take a picture apart by colour and judge whether it shows a source giving off dye.
    Segment(SegmentArgs),
    /// Score how well dye and source are found in rendered pictures of known truth.
    ScoreVision(ScoreVisionArgs),
}

/// Arguments of `run`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Runs scenarios, one after the other: spin-up of the plume, then the mission. Each \
        leaves its folder, by default runs/<scenario>-<seed>/, with summary.json, track.csv, \
        probes-<gantry>.csv, run.mcap, figures and report.html.\n\nThe same scenario, seed and program give the same run, bit by bit, \
        however fast it goes and whoever listens.",
    after_help = RUN_AFTER
)]
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
    /// Folder for the results; with several files, one folder in it for each.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// How fast: `max`, `realtime`, or simulated seconds per second.
    #[arg(long, default_value = "max", value_name = "max|realtime|X")]
    pub speed: Speed,
    /// Publish nothing.
    #[arg(long)]
    pub no_zenoh: bool,
    /// Write no recording (run.mcap).
    #[arg(long)]
    pub no_record: bool,
    /// Show no progress.
    #[arg(long, short)]
    pub quiet: bool,
    /// zenoh's own configuration (JSON5): routers, TLS, access control.
    #[arg(long, value_name = "FILE", conflicts_with = "no_zenoh")]
    pub zenoh_config: Option<PathBuf>,
    /// Where zenoh listens; without it tcp/127.0.0.1:7447, or the next free port.
    #[arg(long, value_name = "ENDPOINT", conflicts_with = "no_zenoh")]
    pub zenoh_listen: Option<String>,
    /// Keep answering subscribers for this long after the end.
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 0.0,
        conflicts_with = "no_zenoh"
    )]
    pub zenoh_linger: f64,
}

const RUN_AFTER: &str = "\
Examples:
  rheotaxis run duck_st
  rheotaxis run mine.ron --seed 7 --out results/mine --no-zenoh
  rheotaxis run duck_st --speed realtime --zenoh-listen tcp/127.0.0.1:7500

Exit codes: 0 success as the scenario defines it; 3 ran, not found; 130 interrupted; 1 error; 2 usage.
With several files the worst of them: 130, then 1, then 3.";

/// How fast a run goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// As fast as the machine can.
    Max,
    /// So many simulated seconds in a second.
    Times(f64),
}

impl FromStr for Speed {
    type Err = String;
    fn from_str(s: &str) -> Result<Self, String> {
        match s {
            "max" => Ok(Speed::Max),
            "realtime" => Ok(Speed::Times(1.0)),
            _ => match s.strip_suffix('x').unwrap_or(s).parse::<f64>() {
                Ok(x) if x > 0.0 && x.is_finite() => Ok(Speed::Times(x)),
                _ => Err("must be `max`, `realtime` or a number > 0".to_string()),
            },
        }
    }
}

/// Arguments of `check`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Reads scenarios and checks what they mean, without running them. Every mistake is \
        shown with file, line, column, field, value and legal range.",
    after_help = "Exit codes: 0 all are fine (there may be warnings); 1 at least one is not."
)]
pub struct CheckArgs {
    /// Scenario file, or the name of a scenario that comes with the program.
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
}

/// Arguments of `init`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Writes a scenario that comes with the program, with its comments, to be changed. \
        Never overwrites. Alone it lists the templates.",
    after_help = "Examples:\n  rheotaxis init\n  rheotaxis init duck_st mine.ron"
)]
pub struct InitArgs {
    /// Name of a scenario that comes with the program.
    pub template: Option<String>,
    /// File to write, or a folder to write it in; without it TEMPLATE.ron here.
    pub path: Option<PathBuf>,
}

/// Arguments of `list`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(
    long_about = "Lists what a scenario can ask for, each with the paper, section or equation it comes from.",
    after_help = "Examples:\n  rheotaxis list\n  rheotaxis list algorithms"
)]
pub struct ListArgs {
    /// Only these.
    pub what: Option<ListKind>,
}

/// What can be listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ListKind {
    /// Scenarios that come with the program.
    Scenarios,
    /// Strategies, behaviours, declaration rules, guidance, estimators, autopilots.
    Algorithms,
    /// Currents.
    Flows,
    /// Instruments.
    Sensors,
    /// Bodies.
    Vehicles,
}

/// Arguments of `statistics`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Lets a scenario's plume develop, without its robots, then watches it with probes that disturb nothing: \
        widths, mean and intermittent concentration, gaps, the gamma law, integral times; in an open channel also the \
        profile and the intensities of the water. One table, our figure beside the published one; what is outside a \
        factor of 0.5 to 2 is marked. Leaves statistics.csv.",
    after_help = "Examples:\n  rheotaxis statistics flume_crab\n  rheotaxis statistics duck_st --seed 3 --seconds 600\n\n\
        Exit codes: 0 done, whatever the figures say; 1 error; 2 usage."
)]
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
    /// How long to watch; without it 1200 s in an open channel, elsewhere the scenario's `time.limit_s`.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub seconds: Option<f64>,
    /// Folder for statistics.csv; without it `runs/SCENARIO-SEED-statistics`.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Show no progress.
    #[arg(long, short)]
    pub quiet: bool,
}

fn seconds(s: &str) -> Result<f64, String> {
    match s.parse::<f64>() {
        Ok(v) if v > 0.0 && v.is_finite() => Ok(v),
        _ => Err("must be a number > 0".to_string()),
    }
}

/// Arguments of `topics`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
pub struct TopicsArgs {
    /// Print the JSON Schemas instead, as one object.
    #[arg(long)]
    pub schema: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_well_formed() {
        use clap::CommandFactory;
        Args::command().debug_assert();
    }

    #[test]
    fn sizes_of_memory_read_with_their_units() {
        assert_eq!(bytes("4G"), Ok(4e9));
        assert_eq!(bytes("500m"), Ok(5e8));
        assert_eq!(bytes("1.5T"), Ok(1.5e12));
        assert_eq!(bytes("2000000"), Ok(2e6));
        for bad in ["", "G", "-4G", "nan", "infG", "4X", "10K", "0"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn the_memory_allowed_is_that_of_the_library() {
        let args = Args::try_parse_from(["rheotaxis", "check", "a.ron"]).unwrap();
        assert_eq!(args.memory, rheotaxis::scenario::cost::MEMORY);
        let args = ["rheotaxis", "run", "a.ron", "--memory", "16G"];
        assert_eq!(Args::try_parse_from(args).unwrap().memory, 16e9);
    }

    #[test]
    fn speeds_read_as_words_and_numbers() {
        assert_eq!("max".parse(), Ok(Speed::Max));
        assert_eq!("realtime".parse(), Ok(Speed::Times(1.0)));
        assert_eq!("2.5x".parse(), Ok(Speed::Times(2.5)));
        for bad in ["0", "-1", "nan", "inf", "fast", ""] {
            assert!(bad.parse::<Speed>().is_err(), "{bad}");
        }
    }
}
