//! A mission over subregions: its parameters, the subregions' places, and its switching.

mod edge;
mod machine;
mod rectangles;
mod spec;

pub use machine::Subregions;
pub use spec::{EdgeSpec, Entry, GridSpec, RectangleSpec, RectanglesSpec, RegionsSpec, SubregionsSpec};

#[cfg(test)]
mod tests;
