//! Declaration rules: one file each.
