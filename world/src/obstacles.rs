//! Solid things standing in the water.
