//! Hidden Markov model of odour moving from cell to cell.

mod adjoint;
mod mapper;
mod paths;
mod products;
mod transition;

pub use mapper::{Hmm, HmmSpec};

#[cfg(test)]
mod tests;
