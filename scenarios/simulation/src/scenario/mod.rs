//! Scenario files: schema, reading, checking; errors that point at the place.

mod catalog;
mod check;
mod check_able;
mod check_berth;
mod check_fitted;
mod check_limits;
mod check_obstacles;
mod check_steps;
mod check_view;
pub mod cost;
mod explain;
mod fault;
mod load;
mod outline;
mod reader;
mod schema;
mod success;
#[cfg(test)]
mod told;

pub use catalog::{CATALOG, Template, template};
pub use check::within;
pub use check::{check, check_within};
pub use fault::{Fault, Found, ScenarioError, Severity};
pub use load::{Loaded, load, load_with, parse, parse_with};
pub use outline::{Node, Outline};
pub use reader::read;
pub use schema::{
    AreaSpec, Id, LevelSpec, RecordSpec, RobotSpec, Scenario, SlopeSpec, StartSpec, TerrainSpec,
    TimeSpec, VERSION, Version,
};
pub use success::{DeclaredSpec, ReachedSpec, SuccessSpec};
