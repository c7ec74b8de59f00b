//! The results of a campaign: tables, CSVs, figures, one page.

mod arms;
mod curves;
mod pairs;
mod plots;
mod reliability;
mod restricted;
mod screen;
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

pub use arms::{ArmFigures, ArmMeasure, ConditionFigures, MeasureSummary};
pub use curves::{Curve, Point};
pub(crate) use reliability::reliability;
pub use reliability::{Bin, Reliability, StatedEvent};
pub(crate) mod reliable {
    //! The reliability of maps as table, notes, CSV and picture.
    pub(crate) use super::reliability::{csv, notes, picture, table};
}
pub use pairs::{Compares, Comparison};
pub(crate) use restricted::restricted;
pub use restricted::{RestrictedMean, SuccessTime};
pub use screen::Film;
pub(crate) use tables::range;
pub(crate) use text::{Table, TableColumn, wrapped};
pub use tracks::{Pick, Rank, RemadeRun, picks};
pub use unit::{Scale, Unit};
pub(crate) use walls::Walls;
pub use write::{About, WrittenReport, write};
