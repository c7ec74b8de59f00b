//! Tells whether a room has changed since something was computed from it.
//!
//! *Source*: this project's own.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use std::sync::Arc;

/// A state of a room. It equals only itself and its copies; every new revision differs from all others, also from
/// those of other rooms. Its value enters no result.
#[derive(Clone, Debug, Default)]
pub struct Revision(Arc<()>);

// A kept revision keeps its address from being used again, so that addresses tell revisions apart.
impl PartialEq for Revision {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
