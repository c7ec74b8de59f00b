//! What filaments cannot pass, and how they are kept in the water.

pub(super) mod clearances;
pub(super) mod cut_off;
pub(super) mod domain;
pub(super) mod open_place;
pub(super) mod rebound;
pub(super) mod side_walls;
pub(super) mod solids;
