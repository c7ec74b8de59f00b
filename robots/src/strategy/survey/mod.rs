//! What follows a declaration: going home, a stop, or a survey of the declared place. Every strategy can include it.

mod holds;
mod looks;
mod machine;
mod spec;

pub(super) use spec::BLIND;

pub use machine::{PostDeclaration, Progress};
pub use spec::{AfterDeclaration, CameraPasses, SidescanPasses, SurveySpec, Verify};

#[cfg(test)]
mod amp_tests;
#[cfg(test)]
mod tests;
