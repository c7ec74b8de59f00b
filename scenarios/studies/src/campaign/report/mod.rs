//! The results of a campaign: tables, CSVs, figures, one page.

mod arms;
mod curves;
mod page;
mod pairs;
mod plots;
mod reliability;
mod restricted;
mod tables;
mod text;
mod tracks;
mod unit;
mod walls;
mod write;

#[cfg(test)]
pub(crate) mod sample;
#[cfg(test)]
mod tests;

pub use arms::{ArmFigures, ArmMeasure, ConditionFigures, Measured};
pub use curves::{Curve, Point};
pub use reliability::{Bin, Reliability, Stated};
pub(crate) use reliability::{RELIABILITY, reliability};
pub(crate) mod reliable {
    //! The reliability of maps as table, notes, CSV and picture.
    pub(crate) use super::plots::colour;
    pub(crate) use super::reliability::{csv, notes, picture, table};
}
pub use pairs::{Compares, Comparison};
pub use restricted::Restricted;
pub(crate) use tables::range;
pub(crate) use text::align;
pub use tracks::{Film, Pick, Rank, Shown, picks};
pub use unit::Unit;
pub(crate) use walls::Walls;
pub use write::{About, Written, write};
