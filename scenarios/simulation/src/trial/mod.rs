//! One run of a scenario from the spin-up to its end. It writes no files and draws nothing: an [`Observer`] does.
//!
//! [`Trial::run`] makes the whole run. [`Trial::step`] and [`Trial::until`] make a part of it, and the state can be
//! read in between. All three give the same run, bit for bit.

mod asking;
mod controlled;
mod observer;
#[cfg(test)]
mod own_tests;
mod progress;
mod run;
mod steps;
mod water;

pub use controlled::{NotControlled, consulted, controlled};
pub use observer::{Event, Observer, Unwatched, Wants};
pub use run::{RunEnd, Trial};

pub(crate) use progress::Progress;
