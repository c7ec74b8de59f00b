//! Scenario files: schema, reading and checks. Errors name the place in the file.

mod catalog;
mod change;
mod check;
pub mod cost;
mod fault;
mod folder_files;
mod gantry;
mod id;
mod load;
mod reader;
mod schema;
mod success;
mod version;

pub use catalog::{CATALOG, Template, template};
pub use change::set_value;
pub use check::{check, check_within};
pub use fault::{Fault, ScenarioError, Severity, UnplacedFault};
pub use folder_files::FolderFiles;
pub use gantry::{GantryBlock, HeadSpec, PlaceSpec};
pub use id::Id;
pub use load::{Loaded, hash, load, load_text, load_text_in, load_with, parse, parse_with};
pub use reader::outline::{Node, Outline};
pub use reader::read;
pub use schema::{AreaSpec, LevelSpec, RecordSpec, RobotSpec, Scenario, SlopeSpec, StartSpec, TerrainSpec, TimeSpec};
pub use success::{DeclaredSpec, ReachedSpec, SuccessSpec};
pub use version::{VERSION, Version, version_first};
