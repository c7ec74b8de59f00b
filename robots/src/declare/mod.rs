//! Declaration rules: one file each.

mod along_flow;
mod catalogue;

pub use along_flow::AlongFlow;
pub use catalogue::{CATALOGUE, DeclareSpec};
