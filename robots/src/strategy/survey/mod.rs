//! What follows a declaration: going home, a stop, or a survey of the declared place. Every strategy can include it.

mod add_up_spec;
mod detect_spec;
mod eyes;
mod post;
mod spec;
mod verifier_spec;

pub(super) use spec::BLIND;

pub use add_up_spec::AddUpSpec;
pub use detect_spec::DetectSpec;
pub use eyes::{Eyes, Progress, Survey};
pub use post::PostDeclaration;
pub use spec::{AfterDeclaration, CameraPasses, SidescanPasses, SurveySpec, Verify};
pub use verifier_spec::{ColourSpec, Edges, VerifierSpec};
