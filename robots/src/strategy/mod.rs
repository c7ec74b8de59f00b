//! Strategies: compositions of behaviours.

mod about;
mod amp;
mod catalogue;
mod external;
mod inspect;
mod map_and_plan;
mod open_loop;
mod policy_search;
mod route;
mod setting;
mod spec;
mod subregions;
mod subsumption;
mod survey;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod trial_tests;
mod wishes;

pub use about::About;
pub use amp::{Amp, AmpSpec, Detections, StartAt};
pub use external::{ExternalSpec, OnLate};
pub use inspect::{Inspect, InspectSpec, ToldSpec};
pub use map_and_plan::{AtTarget, CrossSpec, MapAndPlan, MapAndPlanSpec, PlaneSpec, RoomSpec, SpaceSpec};
pub use open_loop::{OpenLoop, OpenLoopSpec};
pub use policy_search::{PolicySearch, PolicySearchSpec};
pub use route::{Route, RouteSpec};
pub use setting::Setting;
pub use spec::{Strategies, Strategy, StrategyParams, StrategySpec};
pub use subregions::{
    EdgeSpec, Entry, GridSpec, RectangleSpec, RectanglesSpec, RegionsSpec, Subregions, SubregionsSpec,
};
pub use subsumption::{EyesSpec, GoHomeSpec, LayerSpec, MaintainSpec, PlumeMapSpec, Subsumption, SubsumptionSpec};
pub use survey::{
    AddUpSpec, AfterDeclaration, CameraPasses, ColourSpec, DetectSpec, Edges, Eyes, PostDeclaration, Progress,
    SidescanPasses, Survey, SurveySpec, VerifierSpec, Verify,
};
pub use wishes::{VerticalSpec, Wishes};
