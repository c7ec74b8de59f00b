//! A simulator of chemical-plume tracing: vehicles and gantries that smell a turbulent plume in moving water and must find
//! its source. This crate is what others build on: scenarios, the tick, trials. It draws nothing and writes no files.
//!
//! # The first run
//!
//! A [`scenario`] says where, in which water, what is released, who searches, and when it counts as found. A
//! [`Trial`](trial::Trial) runs it for a seed; the same seed gives the same run, bit by bit.
//!
//! ```
//! use rheotaxis::{scenario::load, trial::Trial};
//!
//! let scenario = load("uniform_channel".as_ref())?; // or the path of a file
//! let mut trial = Trial::assemble(&scenario, 1)?;
//! trial.until(60.0); // a minute of the mission, after the spin-up of the plume
//! let robot = &trial.frame().expect("frames come ten times a second").robots[0];
//! println!("{} at {}", robot.behaviour.name(), robot.truth.pose.p_WB);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Trial::run`](trial::Trial::run) goes to the end; a [`Watch`](trial::Watch) sees every frame. `examples/shortest.rs` and
//! `examples/stepped.rs` are whole programs.
//!
//! # A strategy of your own
//!
//! A strategy is a struct of parameters that a scenario can name, and a state machine that turns an observation into a decision,
//! once a tick. `examples/own_strategy.rs` is one, whole:
//!
//! 1. Parameters with `Listed` (name as in RON, one sentence, source) and `StrategyParams` (what they build).
//! 2. The state machine with `Strategy`: what was seen goes in, a `Decision` comes out. It never sees the truth.
//! 3. A [`Registry`](world::registry::Registry) that adds the parameters to the kind `Strategies`, and
//!    [`load_with`](scenario::load_with), which reads scenarios that ask for them. `command::main_with` gives the whole command,
//!    campaigns and figures for them.
//!
//! Behaviours, declaration rules, source maps, planners, sensors, currents and a gantry's searchers are added the same way.
//!
//! # Where things are
//!
//! [`scenario`] reads and checks files; [`explain`] knows every field. [`ocean`] is water, plume and obstacles, which no searcher
//! changes; [`auv`] and [`gantry`] are the searchers; [`tick`] is the order of all systems on one screen; [`score`], [`abnormal`]
//! and [`frame`] are what is seen of a run.
#![forbid(unsafe_code)]

pub mod abnormal;
pub mod assemble;
pub mod auv;
pub mod error;
pub mod explain;
pub mod frame;
pub mod gantry;
pub mod ocean;
pub mod outcome;
pub mod registry;
pub mod scenario;
pub mod score;
pub mod searchers;
pub mod tick;
pub mod trial;
