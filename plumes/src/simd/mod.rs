//! Vector code: which instructions run, and lanes of floats for them.

pub(crate) mod dispatch;
pub(crate) mod f32x4;
pub(crate) mod movemask;
