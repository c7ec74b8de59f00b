//! Space cut into cells: which are solid, and how far it is from each to the nearest solid one.

mod distance;
mod grid;
#[cfg(test)]
mod tests;

pub use grid::Voxels;
