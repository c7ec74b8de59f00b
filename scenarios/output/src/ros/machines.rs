//! What frames say of robots and gantries, as messages. Recordings and live state differ only in their topics, and in
//! the frames and times of the messages.

use super::{Joint, joint_state, nanoseconds, odometry, pose_stamped, vector3_stamped};
use nalgebra::UnitQuaternion;
use rheotaxis::gantry::GantryFrame;
use robots::handoff::{Declaration, Estimate, FlowEstimate};
use world::frames::{Pose, Truth};

/// Where a robot is: its pose in `frame`, its velocities in `child`.
pub fn true_odometry(t_ns: u64, [frame, child]: [&str; 2], truth: &Truth) -> Vec<u8> {
    odometry(t_ns, [frame, child], &truth.pose, [truth.v_WB_B, truth.w_WB_B])
}

/// The same as it believes.
pub fn believed_odometry(t_ns: u64, [frame, child]: [&str; 2], e: &Estimate) -> Vec<u8> {
    odometry(t_ns, [frame, child], &believed_pose(e), [e.v_ground_body, e.attitude.rates_rad_s])
}

/// The pose that a robot believes.
pub fn believed_pose(e: &Estimate) -> Pose {
    Pose { p_WB: e.p_WB(), R_WB: e.attitude.R_WB() }
}

/// The flow that a robot believes, as a `Vector3Stamped`.
pub fn believed_flow(t_ns: u64, frame: &str, flow: &FlowEstimate) -> Vec<u8> {
    vector3_stamped(t_ns, frame, &flow.velocity.push(0.0))
}

/// A declaration at a height, m, as a `PoseStamped` of its own time.
pub fn declared(frame: &str, d: &Declaration, z_m: f64) -> Vec<u8> {
    pose_stamped(nanoseconds(d.t_s), frame, &d.position.push(z_m), &UnitQuaternion::identity())
}

/// The slides of a gantry in the order of its URDF, as a `JointState`: m, m/s, N.
pub fn slides(t_ns: u64, frame: &str, gantry: &GantryFrame) -> Vec<u8> {
    let joints = (gantry.joint_names.iter().zip(&gantry.joints)).map(|(name, j)| Joint {
        name,
        position: j.position_m,
        velocity: j.speed_m_s,
        effort: j.force_N,
    });
    joint_state(t_ns, frame, &joints.collect::<Vec<_>>())
}
