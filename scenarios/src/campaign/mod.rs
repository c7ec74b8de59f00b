//! Thousands of seeded runs: planned, cut into blocks, run on any number of machines, and compared.

mod block;
mod enough;
mod error;
mod load;
mod manifest;
mod one_run;
mod overrides;
mod plan;
mod read;
pub mod report;
mod row;
mod run;
mod shard;
mod spec;
pub mod stats;
mod status;
mod table;

pub use block::{BlockState, block_path, read_block};
pub use enough::{Wanted, wanted};
pub use error::CampaignError;
pub use load::{CAMPAIGNS, load};
pub use manifest::Manifest;
pub(crate) use one_run::sharing_run;
pub use one_run::{RunName, one_run};
pub use overrides::put;
pub use plan::{Campaign, Place};
pub use read::{Merged, merge, read_row, read_rows};
pub use row::{DeclaredAt, RunRow};
pub use run::{BLOCK, Event, RunEnded, RunOptions, run};
pub use shard::Shard;
pub use spec::{Arm, CampaignSpec, Conditions, Draw, RandomConditions, Until};
pub use status::{ArmStatus, Status};
