//! The slides of a gantry as joints.

use super::Joint;
use rheotaxis::gantry::GantryFrame;

/// Its joints in the order of its URDF, for a `JointState`: m, m/s, N.
#[must_use]
pub fn joints(gantry: &GantryFrame) -> Vec<Joint<'_>> {
    (gantry.joint_names.iter().zip(&gantry.joints))
        .map(|(name, j)| Joint { name, position: j.position_m, velocity: j.speed_m_s, effort: j.force_N })
        .collect()
}
