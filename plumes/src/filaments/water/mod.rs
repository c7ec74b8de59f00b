//! The water as filaments see it: the flow grid, looked up for many places at once.

pub(super) mod fetch;
pub(super) mod lookup;
pub(super) mod sampled;
