//! Searchers outside the program, over zenoh: they decide in lock-step, and whatever they do the run ends in order and
//! can be made again from its recording.

mod arena;
mod certificates;
mod decisions;
mod kit;
mod listen;
mod plane;
mod processes;
mod rogue;
mod ros;
mod security;
mod storm;
