//! What of robots is shown.

pub(crate) mod system;
