//! Why a scenario cannot be assembled.

use plumes::error::PlumeError;
use robots::error::RobotError;
use world::error::WorldError;

/// Why a scenario that could be read cannot be assembled.
#[derive(Debug, thiserror::Error)]
pub enum AssembleError {
    /// Terrain or obstacles.
    #[error(transparent)]
    World(#[from] WorldError),
    /// Water or sources.
    #[error(transparent)]
    Plume(#[from] PlumeError),
    /// Light in the water.
    #[error(transparent)]
    Optics(RobotError),
    /// A robot or a gantry.
    #[error("robot {id}: {source}")]
    Robot {
        /// Its id in the scenario.
        id: String,
        /// What is wrong.
        source: RobotError,
    },
    /// A machine of a kind that another crate adds.
    #[error("{id}: {problem}")]
    Apparatus {
        /// Its id in the scenario.
        id: String,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// The systems of other crates do not fit into the tick.
    #[error("{problem}")]
    Systems {
        /// What is wrong with them.
        problem: String,
    },
}
