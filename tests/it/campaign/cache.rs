//! Spin-ups kept on the disk: the same runs as without, and whatever is in the folder, the run goes on.

mod command;
mod damaged;
mod kit;
mod lanes;
mod same;
