//! A mission over subregions: what a scenario says of it, where they are, and its switching.

mod edge;
mod machine;
mod rectangles;
mod spec;

pub use machine::Subregions;
pub use spec::{
    EdgeSpec, Entry, GridSpec, RectangleSpec, RectanglesSpec, RegionsSpec, SubregionsSpec,
};

#[cfg(test)]
mod tests;
