//! `--no-cache`, and where spin-ups are kept; arguments of `rheotaxis cache`.

use super::values::{bytes, within};
use clap::Subcommand;
use clap::builder::FalseyValueParser;
use rheotaxis::cache::{LEAST, MOST, SpinUps};
use std::path::PathBuf;
use std::time::Duration;

/// Whether spin-ups are taken from the cache, and kept in it.
#[derive(Clone, Debug, Default, PartialEq, clap::Args)]
pub struct CacheArgs {
    /// Make every spin-up anew, and keep none. The results are the same. `rheotaxis cache --help` tells what is kept.
    #[arg(long, env = "RHEOTAXIS_NO_CACHE", value_parser = FalseyValueParser::new())]
    pub no_cache: bool,
    /// Where spin-ups are kept.
    #[command(flatten)]
    pub place: CachePlace,
}

/// Where spin-ups are kept.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct CachePlace {
    /// Folder of the kept spin-ups [default: `rheotaxis` in your cache folder].
    #[arg(long = "cache", value_name = "DIR", env = "RHEOTAXIS_CACHE", global = true, hide_short_help = true)]
    pub dir: Option<PathBuf>,
    /// The most that the folder may hold, such as 500M or 10G. What was not used for longest goes first.
    #[arg(
        long = "cache-size",
        value_name = "SIZE",
        env = "RHEOTAXIS_CACHE_SIZE",
        global = true,
        default_value = "2G",
        value_parser = bytes,
        hide_short_help = true
    )]
    pub size: f64,
    /// Keep only spin-ups that took at least this long to make, s.
    #[arg(
        long = "cache-from",
        value_name = "SECONDS",
        env = "RHEOTAXIS_CACHE_FROM",
        global = true,
        default_value = "0.5",
        value_parser = within(0.0..=1e9, "must be a number >= 0"),
        hide_short_help = true
    )]
    pub from: f64,
}

impl Default for CachePlace {
    fn default() -> Self {
        Self { dir: None, size: MOST as f64, from: LEAST.as_secs_f64() }
    }
}

impl CachePlace {
    /// The kept spin-ups.
    ///
    /// # Errors
    /// Says what to do if the system names no folder for them.
    pub(crate) fn open(&self) -> Result<SpinUps, &'static str> {
        let most = self.size as u64;
        let kept = match &self.dir {
            Some(dir) => SpinUps::new(dir.clone(), most),
            None => SpinUps::of_user(most).ok_or(
                "spin-ups are not kept: this system names no folder for caches; set RHEOTAXIS_CACHE to one of yours",
            )?,
        };
        Ok(kept.from(Duration::from_secs_f64(self.from)))
    }
}

/// What `rheotaxis cache --help` says first. It stands at the variant of the command, whose own text would replace it.
pub(super) const ABOUT: &str = "\
Shows or clears the cache of spin-ups.\n\n\
Before a mission, the plume develops (spin-up). `run`, `campaign run`, `reproduce` and `picture` \
keep the plume at the end of a spin-up on the disk. The next run with the same seed, place, water, \
obstacles, sources and spin-up, and with any robots and strategy, takes it from there and begins at \
once. Its results are the same, bit by bit; its summary.json says `spin_up_kept`.\n\n\
A kept plume belongs to one build of the program and to the content of all files that it was made \
from; if any of them changes, it is made anew. A damaged file is noticed, removed and made anew. \
Runs with a --key are never kept. A command adds at most a quarter of --cache-size, so a campaign of \
thousands of seeds keeps the first of them. --no-cache, or the environment variable \
RHEOTAXIS_NO_CACHE=1, does without.";

/// Arguments of `cache`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "Examples:\n  rheotaxis cache\n  rheotaxis cache clear\n  \
        RHEOTAXIS_CACHE=/scratch/plumes RHEOTAXIS_CACHE_SIZE=20G rheotaxis run duck_st")]
pub struct CacheCommandArgs {
    /// What to do [default: show the folder, what it holds, and its bound].
    #[command(subcommand)]
    pub what: Option<CacheCommand>,
    /// Where spin-ups are kept.
    #[command(flatten)]
    pub place: CachePlace,
}

/// What to do with the cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Subcommand)]
pub enum CacheCommand {
    /// Remove all kept spin-ups, of all builds of the program; other files in the folder stay.
    Clear,
}
