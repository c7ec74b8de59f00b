//! What a map may doubt: the model, what it does not know of flow and source, and where the vehicle was.

pub(super) mod alternatives;
pub(super) mod evidence;
pub(super) mod navigation;
pub(super) mod shifts;
