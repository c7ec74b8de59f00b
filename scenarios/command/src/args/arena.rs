//! Arguments of `rheotaxis arena`.

use super::key::KeyArgs;
use super::share::ShareArgs;
use super::values::within;
use std::path::PathBuf;

/// Arguments of `arena`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = AFTER)]
pub struct ArenaArgs {
    /// Family of water: a name or a file of your own; may be given several times [default: all that come with the
    /// program].
    #[arg(long, value_name = "FAMILY")]
    pub family: Vec<PathBuf>,
    /// Searcher: a name or a file of your own; may be given several times [default: all that come with the program].
    #[arg(long, value_name = "SEARCHER")]
    pub searcher: Vec<String>,
    /// Number of seeds of each family.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub seeds: u64,
    /// The first seed.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(..=1 << 60))]
    pub first_seed: u64,
    /// A first look: one to four seeds of each family.
    #[arg(long, conflicts_with = "seeds")]
    pub quick: bool,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
    /// Folder for the results: a campaign for each family, the page, tables and figures.
    #[arg(long, value_name = "DIR", default_value = "runs/arena")]
    pub out: PathBuf,
    /// Which runs are made, and how.
    #[command(flatten)]
    pub share: ShareArgs,
    /// How long a question waits until the first program that answers for a searcher outside is there, s of real time.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0,
        value_parser = within(0.0..=1e6, "must be a number of seconds from 0 to 1e6"))]
    pub control_wait: f64,
    /// Configuration file of zenoh (JSON5), by which searchers outside are asked [default: the loopback interface].
    #[arg(long, value_name = "FILE")]
    pub zenoh_config: Option<PathBuf>,
    /// Endpoint at which zenoh listens [default: tcp/127.0.0.1:7447, or the next free port].
    #[arg(long, value_name = "ENDPOINT")]
    pub zenoh_listen: Option<String>,
    /// Let anybody on the network answer for searchers outside, if that is what endpoint and configuration come to.
    #[arg(long)]
    pub control_from_anywhere: bool,
}

/// What the help of this command begins with.
pub(super) const ABOUT: &str = "\
    Lets searchers compete on equal terms. A family of water is a scenario and what differs in it from seed to seed: \
    flow, source, start. In each family all searchers have the same vehicle, instruments and limits, and those of a \
    seed meet one and the same plume. `rheotaxis list searchers` lists searchers and families with their sources.\n\n\
    Each family becomes a campaign in DIR/FAMILY: the same command continues what was interrupted, any number of \
    machines can share the folder, and `rheotaxis campaign report DIR/FAMILY` and `rerun` work there. DIR itself gets \
    report.html, RANKING.md, arena.csv, figures and FAMILY.parquet.\n\n\
    Seeds are public unless --key gives a secret: then flow, source, start and all noise depend on it, and nobody \
    can have tuned on them.\n\n\
    A searcher of your own is a file like those that come with the program (docs/arena.md): its strategy may be one of \
    your own crate, or External, which asks another program (docs/interfaces.md), in Python for instance.";

const AFTER: &str = "\
Examples:
  rheotaxis arena --quick
  rheotaxis arena --family uniform --searcher surge-cast --searcher infotaxis --seeds 40
  rheotaxis arena --searcher mine.ron --searcher surge-cast --family duck --out mine
  RHEOTAXIS_KEY=... rheotaxis arena --seeds 100 --out sealed

Exit codes: 0 done; 75 stopped before the end (the same command continues); 1 error; 2 wrong usage.";
