//! Errors of a campaign as a whole. An error in one run becomes a row.

use rheotaxis::scenario::ScenarioError;
use std::path::PathBuf;
use world::files::OutputError;

/// A campaign cannot be planned, run or read.
#[derive(Debug, thiserror::Error)]
pub enum CampaignError {
    /// The campaign's file, its base scenario, or the scenario of an arm is wrong.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The path of an override leads nowhere in the scenario.
    #[error("{variant}: `{path}`: {problem}")]
    Override {
        /// Campaign, arm and condition.
        variant: String,
        /// The given path.
        path: String,
        /// What is wrong.
        problem: String,
    },
    /// An arm asks searchers outside the program, of which a campaign has none.
    #[error(
        "{arm}: {robots} asks a searcher outside the program, and a campaign has none: give it a strategy of the \
         program, or make the runs with `rheotaxis run --allow-control` or from Python"
    )]
    Outside {
        /// The scenario of the arm.
        arm: String,
        /// The robots.
        robots: String,
    },
    /// Whoever decides in an arm is not there.
    #[error("run {run} (arm {arm}) has no row, for its searcher outside is not there: {why}; the others are kept")]
    Deserted {
        /// The run.
        run: u64,
        /// Its arm.
        arm: String,
        /// When it was asked.
        why: String,
    },
    /// The folder holds another campaign.
    #[error("{} holds runs of another campaign: {}", dir.display(), what.join("; "))]
    Differs {
        /// The folder.
        dir: PathBuf,
        /// What differs, with both values.
        what: Vec<String>,
    },
    /// The folder holds no campaign.
    #[error("{} holds no campaign: {problem}", dir.display())]
    NoCampaign {
        /// The folder.
        dir: PathBuf,
        /// The reason.
        problem: String,
    },
    /// A file or folder cannot be written: no permission, or the disk is full.
    #[error(transparent)]
    Write(#[from] OutputError),
    /// A file cannot be read.
    #[error("cannot read {}: {problem}", path.display())]
    Read {
        /// The path.
        path: PathBuf,
        /// The system's message.
        problem: String,
    },
    /// A block that is not whole.
    #[error("{} is not whole: {problem}", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// How the damage was found.
        problem: String,
    },
    /// This process cannot tell which share of the work is its own.
    #[error("{0}")]
    Shard(String),
    /// The campaign has no such run.
    #[error("there is no run {run}: the campaign has {runs}, counted from 0")]
    NoRun {
        /// The run asked for.
        run: u64,
        /// The number of runs.
        runs: u64,
    },
}
