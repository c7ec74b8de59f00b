//! What a plume knows of its filaments: places, ages, sizes and the steps that they take.

pub(super) mod arrays;
pub(super) mod bands;
pub(super) mod eddy_coordinates;
pub(super) mod folded;
pub(super) mod rise;
pub(super) mod rows;
pub(super) mod size;
pub(super) mod structure;
