//! What others see of a run and ask of it: live state, recordings, searchers outside the program.

mod layouts;
mod live;
mod outside;
