//! Why a scenario cannot be brought to life.

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
    /// A robot.
    #[error("robot {id}: {source}")]
    Robot {
        /// Which.
        id: String,
        /// What is wrong.
        source: RobotError,
    },
}
