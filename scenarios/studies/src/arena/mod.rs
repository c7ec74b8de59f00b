//! The arena: published searchers in the same water, with the same hull, instruments and limits.
//!
//! A [`FamilySpec`] is a scenario and what varies in it from seed to seed; a [`SearcherSpec`] is what makes a machine
//! of a family search in its own way. Both together are a campaign ([`campaign`]), an arm a searcher, so that all
//! searchers of a seed meet one and the same plume, and rows, shards and resumption are those of campaigns.

mod design;
mod family;
mod load;
mod page;
mod picture;
mod ranks;
mod searcher;
mod standing;
mod total;

pub use design::{Contest, campaign};
pub use family::{FAMILY_FILE, FamilySpec, Machine};
pub use load::{ArenaError, FAMILIES, Family, families, searchers};
pub use page::{WrittenArena, write};
pub use ranks::Rank;
pub use searcher::{SEARCHERS_FILE, SearcherSpec};
pub use standing::{Count, Figures, Standing, standing};
