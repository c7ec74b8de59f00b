//! What holds: one test binary.
//!
//! | folder | what it holds |
//! | --- | --- |
//! | `physics` | vehicles under physics: published trajectories, single effects, contacts, waves |
//! | `missions` | whole missions: what they find, that they repeat bit by bit, what goes wrong in them |
//! | `wire` | what others see of a run and ask of it: live state, recordings, searchers outside the program |
//! | `campaign` | campaigns, lanes, kept spin-ups and reproduced tables |
//! | `input` | what users type and write, what they are answered, and what is on their disks and terminals |
//! | `structure` | the never-rules of README, the packages, and that README and docs promise what is so |
//!
//! `common` and `waits` are what several of them need.

mod campaign;
mod common;
mod input;
mod missions;
mod physics;
mod structure;
mod waits;
mod wire;
