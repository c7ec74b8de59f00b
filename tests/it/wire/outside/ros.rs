//! A node of ROS 2 steers a robot with `/<robot>/cmd`.

use super::kit::{Run, channel, client, external};
use crate::waits::{PATIENCE, pause};
use output::ros::twist_stamped;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use zenoh::{Session, Wait};

const HASH: &str = "RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64";

/// A node that says the same again and again, until it is told that the run is over.
fn node(session: &Session, said: Vec<u8>, over: &Arc<AtomicBool>) -> JoinHandle<()> {
    let (writer, until) = (session.clone(), Arc::clone(over));
    std::thread::spawn(move || {
        let key = format!("42/auv0/cmd/geometry_msgs::msg::dds_::TwistStamped_/{HASH}");
        while !until.load(Ordering::Relaxed) {
            writer.put(&key, said.clone()).wait().unwrap();
            pause(0.005);
        }
    })
}

#[test]
fn a_command_that_is_not_finite_or_in_another_frame_is_no_answer() {
    for (frame, up_m_s) in [("auv0/base_link", f64::NAN), ("map", 0.0)] {
        let run = Run::start(&channel(&external("Hold"), 3.0), &["--allow-control", "--ros2", "--ros-domain", "42"]);
        let session = client(&run.endpoint);
        let over = Arc::new(AtomicBool::new(false));
        let ahead = twist_stamped(0, frame, &nalgebra::Vector3::new(1.5, 0.0, up_m_s));
        let node = node(&session, ahead, &over);
        let end = run.end();
        over.store(true, Ordering::Relaxed);
        node.join().unwrap();
        let counts = ["asked", "nonsense", "answered"].map(|what| end.count(0, what));
        assert_eq!(counts, [3, 3, 0], "{frame}: {}{}", end.said, end.summary);
        end.run_again();
        session.close().wait().unwrap();
    }
}

#[test]
fn commands_of_a_node_steer_a_robot_and_are_recorded() {
    let run = Run::start(&channel(&external("Abort"), 8.0), &["--allow-control", "--ros2", "--ros-domain", "42"]);
    let session = client(&run.endpoint);
    // The graph shows that the run listens.
    let tokens = (session.liveliness().declare_subscriber("@ros2_lv/42/**")).history(true).wait().unwrap();
    loop {
        let token = tokens.recv_timeout(PATIENCE).unwrap().expect("in time");
        let token = token.key_expr().as_str();
        if token.contains("/MS/") {
            assert!(token.contains(&format!("%auv0%cmd/geometry_msgs::msg::dds_::TwistStamped_/{HASH}")), "{token}");
            break;
        }
    }
    let over = Arc::new(AtomicBool::new(false));
    let ahead = twist_stamped(0, "auv0/base_link", &nalgebra::Vector3::new(1.5, 0.0, 0.0));
    let node = node(&session, ahead, &over);
    let end = run.end();
    over.store(true, Ordering::Relaxed);
    node.join().unwrap();
    assert_eq!(end.count(0, "answered"), 8, "{}{}", end.said, end.summary);
    assert_eq!(end.summary["robots"][0]["last_behaviour"], "ros_cmd");
    end.run_again();
    session.close().wait().unwrap();
}
