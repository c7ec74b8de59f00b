//! A simulator of chemical-plume tracing: underwater vehicles and gantries measure a turbulent plume in moving water
//! and search for its source. This crate is the library that others build on: scenarios, the tick, trials. It draws
//! nothing and writes no files, except in a [`cache`] that is asked for; the crates `output`, `studies` and `command` do.
//!
//! # 1. The first run
//!
//! A [`scenario`] describes an experiment: the place, its water, what is released, who searches, and when the search
//! is a success. A [`Trial`](trial::Trial) is one run of it for a seed. The same seed gives the same run, bit by bit.
//!
//! ```
//! use rheotaxis::{scenario::load, trial::Trial};
//!
//! let scenario = load("uniform_channel".as_ref())?; // a name in the catalogue, or the path of a file
//! let mut trial = Trial::assemble(&scenario, 1)?;
//! trial.until(60.0); // the spin-up of the plume, then a minute of the mission
//! let robot = &trial.frame().expect("there are ten frames a second").robots[0];
//! println!("{} at {}", robot.behaviour.name(), robot.truth.pose.p_WB);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - `examples/library/shortest.rs`: a whole run in 25 lines.
//! - `examples/library/stepped.rs`: the state every minute. [`Trial::run`](trial::Trial::run) makes the whole run, and a
//!   [`Observer`](trial::Observer) sees every frame.
//!
//! # 2. A scenario of your own
//!
//! `rheotaxis init uniform_channel` writes a scenario file to change, `rheotaxis explain robots.strategy` says what a
//! field may hold, and `rheotaxis check FILE` names every mistake with line and column. [`load`](scenario::load) does
//! the same in a program.
//!
//! # 3. A strategy of your own
//!
//! A strategy is a struct of parameters that a scenario can name, and a state machine that turns an observation into a
//! decision, once a tick. `examples/library/own_strategy.rs` is a whole one:
//!
//! 1. Parameters, by [`params!`]: fields with defaults, name in files, one sentence, source. `StrategyParams` says what
//!    they build.
//! 2. The state machine, with `Strategy`. It gets what the instruments say and never the truth.
//! 3. A [`Registry`](world::registry::Registry) with the parameters as a row of the kind `Strategies`, and
//!    [`load_with`](scenario::load_with), which reads scenarios that name them.
//! 4. `command::main_with(&registry)` in a `main` of your own: the whole command, with campaigns and figures, for them.
//!
//! # 4. A controller of your own
//!
//! A robot or gantry whose strategy is `External` asks once a period, and a [`Controller`](control::Controller) answers:
//! a closure, or whatever another process says. [`Trial::until_asked`](trial::Trial::until_asked) stops at the questions
//! instead, for programs with a loop of their own. `examples/library/own_controller.rs` steers a robot; this moves a gantry:
//!
//! ```
//! use rheotaxis::control::{Question, Response, read_answer};
//! use rheotaxis::{scenario::load, trial::Trial};
//!
//! let mut trial = Trial::assemble(&load("flume_external".as_ref())?, 1)?;
//! trial.control("crab0", |asked: &Question| {
//!     let ahead = r#"{"head": {"target_m": [1.0, 0.0], "behaviour": "step_up"}}"#;
//!     read_answer(ahead.as_bytes(), asked.number, asked.t_s).map_or_else(Response::Nonsense, Response::Answer)
//! })?;
//! println!("{}", trial.finish_quietly().outcome.label());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # 5. More of your own
//!
//! | what | how | example |
//! | --- | --- | --- |
//! | a current | a row of `Currents` | `own_current.rs` |
//! | a sensor | a row of `Sensors` | `own_sensor.rs` |
//! | a behaviour, a rule of declaration, a source map, a planner | a row of its kind | like `own_strategy.rs` |
//! | a system in a stage of the tick, with data of its own | [`with_systems`] | `own_system.rs` |
//! | a value that live state, recording and summary show | [`with_topic`] | `own_topic.rs` |
//! | a machine beside robots and gantries | a row of [`Apparatuses`](machines::Apparatuses) | `own_apparatus.rs` |
//!
//! [`prelude`] has the names of a strategy, a sensor and a current; `docs/own_crate.md` is a whole crate with all three.
//!
//! [`with_systems`]: extend::Extend::with_systems
//! [`with_topic`]: extend::Extend::with_topic
//!
//! Run an example with `cargo run --release --example library own_current`.
//!
//! # Where things are
//!
//! - [`scenario`] reads and checks files; [`explain`] describes every field.
//! - [`ocean`] holds water, plume and obstacles. No searcher changes it, so [`lanes`] lets many runs share one, and
//!   [`cache`] keeps spun-up ones on the disk.
//! - [`control`] asks searchers outside the program.
//! - [`auv`] and [`gantry`] are the searchers; [`machines`] is the trait that both implement.
//! - [`tick`] shows the order of all systems on one screen; [`assemble`] puts a run together.
//! - [`score`] and [`incidents`] judge a run; [`frame`] and [`topic`] are what is seen of it.
//! - [`registry`] lists everything that has a name; [`extend`] adds systems and topics.
#![deny(unsafe_code)]

pub use {nalgebra, plumes, robots, schemars, serde, world};

pub mod assemble;
pub mod auv;
pub mod cache;
pub mod control;
pub mod error;
pub mod explain;
pub mod extend;
pub mod fleet;
pub mod frame;
pub mod gantry;
pub mod incidents;
pub mod lanes;
pub mod machines;
pub mod ocean;
pub mod outbox;
pub mod outcome;
mod params;
pub mod prelude;
pub mod registry;
pub mod scenario;
pub mod score;
pub mod searchers;
mod shape;
#[cfg(test)]
mod testing;
pub mod tick;
pub mod topic;
pub mod trial;
