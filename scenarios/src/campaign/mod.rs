//! Thousands of seeded runs: planned, cut into blocks, run on any number of machines, and compared.

mod row;

pub use row::RunRow;
