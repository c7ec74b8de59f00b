//! Scenario files: schema, reading, checking; errors that point at the place.

mod catalog;
mod check;
mod check_berth;
mod check_fitted;
mod check_limits;
mod check_obstacles;
mod explain;
mod fault;
mod load;
mod outline;
mod schema;
mod success;

pub use catalog::{CATALOG, Template, template};
pub use check::check;
pub(crate) use check::within;
pub(crate) use explain::explain;
pub use fault::{Fault, Found, ScenarioError};
pub use load::{Loaded, load, parse};
pub(crate) use outline::Outline;
pub use schema::{
    AreaSpec, Id, LevelSpec, RecordSpec, RobotSpec, Scenario, SlopeSpec, StartSpec, TerrainSpec,
    TimeSpec, VERSION, Version,
};
pub use success::{DeclaredSpec, ReachedSpec, SuccessSpec};
