//! Flags of commands whose runs can be divided among machines, stopped and continued.

use super::cache::CacheArgs;
use super::values::wall_time;
use std::time::Duration;
use studies::campaign::{CampaignError, Shard};

/// Which runs are made, how many at a time, and how long.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct ShareArgs {
    /// The cache of spin-ups.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// Do the I-th of N shares, counted from 1 [default: what the cluster's scheduler says, else all].
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Runs at the same time; 0 means one on each core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,
    /// Stop early enough to end within this time, such as 90s, 55m or 1h30m.
    #[arg(long, value_name = "TIME", value_parser = wall_time)]
    pub max_wall: Option<Duration>,
    /// Do not show progress.
    #[arg(long, short)]
    pub quiet: bool,
}

impl ShareArgs {
    /// The share that was asked for, or that of the cluster's scheduler.
    ///
    /// # Errors
    /// If the scheduler's variables say something that is no share.
    pub fn shard(&self) -> Result<Shard, CampaignError> {
        match self.shard {
            Some(shard) => Ok(shard),
            None => Ok(Shard::from_environment(|name| std::env::var(name).ok())?.unwrap_or_default()),
        }
    }
}
