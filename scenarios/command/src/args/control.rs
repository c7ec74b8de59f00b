//! Arguments of `run` for searchers outside the program, and of `rerun`.

use super::cache::CacheArgs;
use super::key::KeyArgs;
use super::values::within;
use std::path::PathBuf;

/// What others may do to a run.
#[derive(Clone, Debug, Default, PartialEq, clap::Args)]
pub struct ControlArgs {
    /// Let others control the run over zenoh: decide for robots and gantries whose strategy is `External`, pause, step,
    /// speed up and stop the run. Whoever reaches the endpoint can: it is on the loopback interface unless you say
    /// otherwise; docs/interfaces.md tells how to let in only some. A configuration that lets in anybody on the network
    /// is refused.
    #[arg(long, conflicts_with = "no_zenoh")]
    pub allow_control: bool,
    /// With --allow-control, let anybody on the network control the run, without a user, a client certificate or access
    /// control, if that is what endpoint and configuration come to.
    #[arg(long, requires = "allow_control")]
    pub control_from_anywhere: bool,
    /// How long the first question of each robot waits for a controller, s of real time.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0,
        value_parser = within(0.0..=1e6, "must be a number of seconds from 0 to 1e6"))]
    pub control_wait: f64,
}

/// Arguments of `rerun`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = RERUN_AFTER)]
pub struct RerunMcapArgs {
    /// The recording: `run.mcap`, or the folder it is in.
    #[arg(value_name = "RUN.MCAP")]
    pub recording: PathBuf,
    /// Folder for the results of the new run; without it nothing is written.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace files in that folder that no earlier run left there but that have the names of results.
    #[arg(long)]
    pub overwrite: bool,
    /// Folder to which file names in the scenario are relative [default: this folder].
    #[arg(long, value_name = "DIR")]
    pub base: Option<PathBuf>,
    /// The key of the run.
    #[command(flatten)]
    pub key: KeyArgs,
    /// The cache of spin-ups.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// Do not show progress.
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) const RERUN_ABOUT: &str = "Makes a recorded run again: its scenario and seed stand in the recording, and so does all that searchers outside \
     the program answered. These answers are fed back in the place of the searchers, and the digests are compared.";

const RERUN_AFTER: &str = "\
Examples:
  rheotaxis rerun runs/duck_external-1/run.mcap
  rheotaxis rerun runs/duck_external-1 --out again

Exit codes: 0 the same digest; 3 another digest, or none to compare with; 130 interrupted; 1 error; 2 wrong usage.";
