//! Water that flows round obstacles: currents are made free of divergence, and tangent to bed, surface and solids.

mod blocked;
mod cells;
mod field;
mod multigrid;
mod solve;
mod spec;
#[cfg(test)]
pub(crate) mod tests;
#[cfg(test)]
mod tests_flow;

pub use blocked::Blocked;
pub(crate) use cells::Cells;
pub use solve::Solved;
pub use spec::BlockageSpec;
