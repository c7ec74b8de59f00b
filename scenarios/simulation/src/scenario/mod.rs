//! Scenario files: schema, reading, checking; errors that point at the place.

mod catalog;
mod check;
mod check_able;
mod check_berth;
mod check_fitted;
mod check_gantry;
mod check_limits;
mod check_obstacles;
mod check_steps;
mod check_view;
pub mod cost;
mod fault;
mod gantry;
mod load;
mod outline;
mod reader;
mod schema;
mod success;
#[cfg(test)]
mod told;
mod unread;

pub use catalog::{CATALOG, Template, template};
pub use check::within;
pub use check::{check, check_within};
pub use fault::{Fault, Found, ScenarioError, Severity};
pub use gantry::{GantryBlock, HeadSpec, PlaceSpec};
pub use load::{Loaded, load, load_text, load_with, parse, parse_with};
pub use outline::{Node, Outline};
pub(crate) use reader::distance;
pub use reader::read;
pub use schema::{
    AreaSpec, Id, LevelSpec, RecordSpec, RobotSpec, Scenario, SlopeSpec, StartSpec, TerrainSpec,
    TimeSpec, VERSION, Version,
};
pub use success::{DeclaredSpec, ReachedSpec, SuccessSpec};
