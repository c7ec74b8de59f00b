//! Our figures beside the papers': rows of `tests/reference/rows`, run over many seeds.

mod compare;
mod joint;
mod kept;
mod measure;
mod published;
mod quantity;
mod row;
mod run;
mod time_left;
mod write;

pub use compare::{FigureComparison, Standing, compare};
pub use joint::{Joint, joint};
pub use kept::Table;
pub use measure::{Measure, RunEvent};
pub use published::Published;
pub use quantity::{Estimate, Quantity};
pub use row::{Figure, Paper, Reference, ReproduceError, Row, rows, wanted};
pub use run::{Plan, RowResult, reproduce};
pub use time_left::TimeLeft;
pub use write::{table, write};
