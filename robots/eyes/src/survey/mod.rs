//! A survey of a place: passes with sidescan and camera, or points that are held, and the verdict.

mod holds;
mod looks;
mod machine;

pub use machine::SurveyFlight;

#[cfg(test)]
mod amp_tests;
#[cfg(test)]
mod inspect_tests;
#[cfg(test)]
mod tests;
