//! Water that flows round obstacles: currents are made free of divergence, and tangent to bed, surface and solids.

mod blocked;
mod cells;
mod felt;
mod field;
mod multigrid;
mod solve;
mod spec;
#[cfg(test)]
pub(crate) mod tests;
#[cfg(test)]
mod tests_flow;

pub use blocked::ObstacleFlow;
pub(crate) use cells::{Cells, beyond};
pub use solve::SolutionReport;
pub use spec::BlockageSpec;
