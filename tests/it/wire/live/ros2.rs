//! The run as a node of ROS 2 sees it: tokens, topics with what comes beside their messages, latched topics for those
//! who come late. `scenarios/clients/check_ros2.py` has clients of others read the same.

use super::hostile::Process;
use super::kit::{client, frame, meta, next, options, plume, sent};
use super::readings::picture;
use crate::common::root;
use crate::waits::{PATIENCE, until};
use nalgebra::Vector3;
use output::live::{Live, LiveOptions, Qos, Ros2, RosTopic, Scene, ros_topics};
use rheotaxis::frame::{Frame, TimedReading};
use rheotaxis::scenario;
use rheotaxis::trial::Event;
use robots::handoff::{AdcpReading, AltimeterReading, Attitude, Beam, DepthReading, DvlReading, RangeScan};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use world::units::Heading;
use zenoh::key_expr::KeyExpr;
use zenoh::sample::Sample;
use zenoh::{Session, Wait};
use zenoh_ext::{AdvancedSubscriberBuilderExt, HistoryConfig};

/// The scene of a vehicle and of a gantry, as the run of the kit has them.
fn scene() -> Scene {
    let of = |name: &str| {
        let path = root().join("scenarios/catalog").join(name);
        Scene::from_scenario(&scenario::load(&path).unwrap()).unwrap()
    };
    let (mut scene, flume) = (of("harbour_3d.ron"), of("flume_crab.ron"));
    scene.machines.extend(flume.machines);
    let ids: Vec<&str> = scene.machines.iter().map(|m| m.id.as_str()).collect();
    assert_eq!(ids, ["auv0", "crab0"]);
    scene
}

fn with_ros2(run: &str, domain: u32) -> LiveOptions {
    let scene = Arc::new(scene());
    LiveOptions { ros2: Some(Ros2 { domain, scene }), ..options(run) }
}

fn start(run: &str, domain: u32) -> Live {
    Live::start(&with_ros2(run, domain), meta()).expect("any free port will do")
}

/// A state with readings of all instruments and a path.
fn told(step: u64) -> Frame {
    fn at<T>(value: T) -> Option<TimedReading<T>> {
        Some(TimedReading { t_s: 0.25, value })
    }
    let mut frame = frame(step);
    let robot = &mut frame.robots[0];
    let v_body_m_s = Vector3::new(1.5, 0.0, 0.25);
    robot.readings.dvl = at(DvlReading { v_body_m_s, valid: true });
    robot.readings.adcp = at(AdcpReading { v_body_m_s, above_m: 1.0, valid: true });
    robot.readings.attitude =
        at(Attitude { heading: Heading::from_deg(90.0), roll_rad: 0.0, pitch_rad: 0.0, rates_rad_s: Vector3::z() });
    robot.readings.depth = at(DepthReading { depth_m: 10.0 });
    robot.readings.altimeter = at(AltimeterReading { altitude_m: 2.5, valid: true });
    let beam = |dir_B, echo_m| Beam { dir_B, echo_m };
    robot.readings.ranging = at(RangeScan {
        p_BS: Vector3::new(0.8, 0.0, 0.0),
        max_m: 40.0,
        beams: [beam(Vector3::x(), Some(12.0)), beam(Vector3::y(), None)].into(),
    });
    robot.shown.planned = vec![Vector3::zeros(), Vector3::new(5.0, 6.0, -3.0)];
    frame
}

/// The name of the topic that a message is of.
fn name_of(sample: &Sample) -> String {
    let parts: Vec<&str> = sample.key_expr().as_str().split('/').collect();
    format!("/{}", parts[1..parts.len() - 2].join("/"))
}

/// The row of the table for a name.
fn row(name: &str) -> &'static RosTopic {
    let parts: Vec<&str> = name.split('/').collect();
    let general = match parts[..] {
        ["", "crab0", "joint_states"] => "/<gantry>/joint_states".to_owned(),
        ["", "crab0", "probes", _] => "/<gantry>/probes/<probe>".to_owned(),
        _ => name.replace("auv0", "<robot>").replace("crab0", "<robot>"),
    };
    let found = ros_topics().iter().find(|t| t.name == general);
    found.unwrap_or_else(|| panic!("{name} is in no table"))
}

/// Publishers in the graph: key of the topic and token, by name.
fn publishers(session: &Session, domain: u32) -> BTreeMap<String, (String, String)> {
    let tokens = session.liveliness().get(format!("@ros2_lv/{domain}/*/0/*/MP/**")).timeout(PATIENCE).wait().unwrap();
    let token = |reply: zenoh::query::Reply| {
        let sample = reply.into_result().expect("only tokens are answered");
        let token = sample.key_expr().as_str().to_owned();
        let parts: Vec<&str> = token.split('/').collect();
        let name = parts[9].replace('%', "/");
        let key = format!("{domain}{name}/{}/{}", parts[10], parts[11]);
        (name, (key, token))
    };
    tokens.iter().map(token).collect()
}

/// The number of a message, and the id of its publisher.
fn beside(sample: &Sample) -> (i64, Vec<u8>) {
    let bytes = sample.attachment().expect("a node drops it").to_bytes();
    assert_eq!((bytes.len(), bytes[16]), (33, 16));
    let number = i64::from_le_bytes(bytes[..8].try_into().unwrap());
    (number, bytes[17..].to_vec())
}

/// Seconds and nanoseconds after the four bytes that name the encoding.
fn stamp(payload: &[u8]) -> (i32, u32) {
    let part = |k: usize| payload[k..k + 4].try_into().unwrap();
    (i32::from_le_bytes(part(4)), u32::from_le_bytes(part(8)))
}

#[test]
fn nodes_see_every_topic_of_the_table_and_hear_it() {
    let live = start("ros2_1", 31);
    let session = client(live.endpoint());
    // Without a bound: a full channel would hold up the session, and with it the answers that are asked for below.
    let (hear, samples) = std::sync::mpsc::channel();
    let _subscriber = session
        .declare_subscriber("31/**")
        .history(HistoryConfig::default().detect_late_publishers())
        .callback(move |sample| drop(hear.send(sample)))
        .wait()
        .unwrap();
    // Topics come into being with their first message; what is said twice is surely heard.
    let mut heard: BTreeMap<String, Sample> = BTreeMap::new();
    let wanted: BTreeSet<&str> = ros_topics().iter().map(|t| t.name).collect();
    let mut step = 1;
    until("every topic of the table is heard", || {
        live.see(&Event::Frame(Arc::new(told(step))));
        live.see(&Event::Plume(Arc::new(plume(10))));
        live.see(&Event::Picture(Arc::new(picture(1.0))));
        sent(&live);
        step += 1;
        heard.extend(samples.try_iter().map(|sample| (name_of(&sample), sample)));
        let seen: BTreeSet<&str> = heard.keys().map(|name| row(name).name).collect();
        (seen == wanted).then_some(())
    });
    // Two names share a row; what is latched for the other one may still be on its way.
    let known = until("every topic in the graph is heard, and no other", || {
        heard.extend(samples.try_iter().map(|sample| (name_of(&sample), sample)));
        Some(publishers(&session, 31)).filter(|known| known.keys().eq(heard.keys()))
    });
    for (name, sample) in &heard {
        let (key, token) = &known[name];
        let row = row(name);
        assert_eq!(sample.key_expr().as_str(), key);
        let kind = format!("{}/{}", row.kind.dds_name(), row.kind.hash());
        assert!(token.ends_with(&format!("/{kind}/{}", row.qos.chunk())), "{token}");
        let (number, id) = beside(sample);
        assert!(number >= 1);
        let hash = xxhash_rust::xxh3::xxh3_128(token.as_bytes());
        assert_eq!(id, hash.to_le_bytes(), "{name}");
        assert_eq!(sample.payload().to_bytes()[..4], [0, 1, 0, 0]);
    }
    let odometry = heard["/auv0/odom"].payload().to_bytes();
    let frame_id = String::from_utf8_lossy(&odometry[16..19]).into_owned();
    assert_eq!(frame_id, "map");
    // A reading has its own time.
    assert_eq!(stamp(&heard["/auv0/imu"].payload().to_bytes()), (0, 250_000_000));
    let pressure = heard["/auv0/pressure"].payload().to_bytes();
    let pa = f64::from_le_bytes(pressure[pressure.len() - 16..][..8].try_into().unwrap());
    assert!((pa - (101_325.0 + 1025.0 * 9.806_65 * 10.0)).abs() < 1e-6, "{pa}");
    drop(samples);
    drop(live);
    session.close().wait().unwrap();
}

#[test]
fn the_clock_goes_on_and_its_messages_are_numbered() {
    let live = start("ros2_clock_1", 32);
    live.see(&Event::Frame(Arc::new(told(1))));
    sent(&live);
    let session = client(live.endpoint());
    let clocks = session.declare_subscriber("32/clock/rosgraph_msgs::msg::dds_::Clock_/*").wait().unwrap();
    // An answer means that the run knows of the subscription.
    publishers(&session, 32);
    let mut before = (0, (0, 0));
    for step in 2..22 {
        live.see(&Event::Frame(Arc::new(told(step))));
        sent(&live);
        let sample = next(&clocks);
        let now = (beside(&sample).0, stamp(&sample.payload().to_bytes()));
        assert!(now.0 > before.0 && now.1 > before.1, "{before:?} {now:?}");
        before = now;
    }
    assert!(before.1 <= (2, 100_000_000), "{before:?}");
    drop(live);
    session.close().wait().unwrap();
}

#[test]
fn who_comes_late_hears_what_is_latched_and_the_node_goes_with_the_run() {
    let live = start("ros2_late_1", 33);
    live.see(&Event::Frame(Arc::new(told(1))));
    live.end("d1");
    sent(&live);
    let session = client(live.endpoint());
    let alive = session.liveliness().declare_subscriber("@ros2_lv/33/*/0/0/NN/%/%/*").history(true).wait().unwrap();
    assert!(next(&alive).key_expr().as_str().ends_with("/rheotaxis"));
    // The time is what is said last of a state.
    let known =
        until("the clock is published", || Some(publishers(&session, 33)).filter(|known| known.contains_key("/clock")));
    for (name, (key, _)) in known {
        if row(&name).qos != Qos::Latched {
            continue;
        }
        let late = session
            .declare_subscriber(KeyExpr::try_from(key).unwrap())
            .history(HistoryConfig::default().detect_late_publishers())
            .wait()
            .unwrap();
        let sample = next(&late);
        assert_eq!(beside(&sample).0, 1, "{name}");
        if name.ends_with("/robot_description") {
            let text = String::from_utf8_lossy(&sample.payload().to_bytes()).into_owned();
            assert!(text.contains("<robot name=") && !text.contains("capsule"));
        }
    }
    drop(live);
    assert_eq!(next(&alive).kind(), zenoh::sample::SampleKind::Delete);
    session.close().wait().unwrap();
}

#[test]
fn a_stalled_node_does_not_hold_the_run() {
    let live = start("ros2_stalled_1", 34);
    live.see(&Event::Frame(Arc::new(told(0))));
    sent(&live);
    let mut stalled = Process::start(live.endpoint(), "34/**");
    live.see(&Event::Frame(Arc::new(told(1))));
    stalled.wait_for("STALLED");
    // More than what sockets and queues between the two can take.
    let plume = plume(10_000);
    for step in 2..62 {
        live.see(&Event::Plume(Arc::new(plume.clone())));
        live.see(&Event::Frame(Arc::new(told(step))));
        sent(&live);
    }
    for step in 62..10_062 {
        live.see(&Event::Plume(Arc::new(plume.clone())));
        live.see(&Event::Frame(Arc::new(told(step))));
    }
    assert_eq!(live.counts().offered, 10_062);
    assert!(live.counts().superseded > 0, "{:?}", live.counts());
    live.finish("d1");
    drop(stalled);
}
