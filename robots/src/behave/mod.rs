//! Behaviours: one file each.

mod avoid;
mod catalogue;
mod cloverleaf;
mod find;
mod go_home;
mod go_to;
mod open_loop;
mod reacquire;
mod survey;
mod track_in;
mod track_out;

pub use avoid::{Params as AvoidParams, SoftAvoid};
pub use catalogue::{CATALOGUE, FindSpec, ReacquireSpec, TrackInSpec, TrackOutSpec};
pub use cloverleaf::Cloverleaf;
pub use find::ZigZag;
pub use go_home::GoHome;
pub use go_to::GoTo;
pub use open_loop::{TimeTable, TimeTableParams, TimeTableRow};
pub use reacquire::Bowtie;
pub use survey::Passes;
pub use track_in::CounterTurn;
pub use track_out::UpAcross;
