//! Behaviours: one file each.

mod avoid;
mod behaviour;
mod bilateral;
mod cast;
mod catalogue;
mod climb;
mod cloverleaf;
mod corners;
mod find;
mod go_to;
mod lawnmower;
mod open_loop;
mod random_points;
mod reacquire;
mod square_spiral;
mod survey;
#[cfg(test)]
mod testing;
mod track_in;
mod track_out;

pub use avoid::{Params as AvoidParams, SoftAvoid};
pub use behaviour::{Behave, BehaviourParams, Stride};
pub use catalogue::{
    FindSpec, Finds, PARTS, ReacquireSpec, Reacquires, TrackInSpec, TrackOutSpec, TracksIn, TracksOut,
};
pub use cloverleaf::{Cloverleaf, Params as CloverleafParams};
pub use find::{Params as ZigZagParams, ZigZag};
pub use go_to::GoTo;
pub use open_loop::{TimeTable, TimeTableParams, TimeTableRow};
pub use reacquire::{Bowtie, Params as BowtieParams};
pub use survey::Passes;
pub use track_in::{CounterTurn, Params as CounterTurnParams};
pub use track_out::{Params as UpAcrossParams, UpAcross};
