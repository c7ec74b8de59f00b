//! Space divided into cells: which are solid, and the distance of each from the nearest solid one.

mod distance;
mod grid;
#[cfg(test)]
mod tests;

pub use grid::Voxels;
