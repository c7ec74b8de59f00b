//! The concentration at a point.

pub(super) mod batch;
pub(super) mod boxes;
pub(super) mod contribution;
pub(super) mod group;
pub(super) mod image;
pub(super) mod index;
pub(super) mod moving_packet;
pub(super) mod order;
pub(super) mod packet;
pub(super) mod question;
pub(super) mod run_bounds;
pub(super) mod scan;
