//! Behaviours: one file each.
