//! The built-in URDF of the REMUS 100.

/// Its name for messages, and its text.
pub(super) const REMUS100: (&str, &str) =
    ("remus100.urdf", include_str!("../../urdf/remus100.urdf"));
