//! The messages: a state as JSON, a plume as packed numbers.

use super::message_gantry::gantry;
use super::options::chunk;
use super::{LiveCounts, Payload, Topic, topics};
use rheotaxis::abnormal::Abnormal;
use rheotaxis::frame::{Frame, PlumeFrame, RobotFrame};
use robots::handoff::{Command, Declaration, Goal, Manoeuvre, Vertical, region_name};
use serde_json::{Map, Value, json};

/// A message, with its key below `rheotaxis/<run>/`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Message {
    pub(super) key: String,
    pub(super) payload: Vec<u8>,
    pub(super) packed: Payload,
    /// Header of a payload that is not JSON.
    pub(super) attachment: Option<Vec<u8>>,
}

impl Message {
    pub(super) fn json(key: impl Into<String>, value: &Value) -> Self {
        Self {
            key: key.into(),
            payload: value.to_string().into_bytes(),
            packed: Payload::Json,
            attachment: None,
        }
    }

    /// Packed numbers with a header.
    pub(super) fn numbers(
        key: impl Into<String>,
        numbers: impl Iterator<Item = f32>,
        header: &Value,
    ) -> Self {
        Self {
            key: key.into(),
            payload: numbers.flat_map(f32::to_le_bytes).collect(),
            packed: Payload::PackedF32,
            attachment: Some(header.to_string().into_bytes()),
        }
    }
}

/// No plume message has more filaments, so that it stays well below 1 MB.
const MOST_FILAMENTS: usize = 10_000;

pub(super) fn clock(t_s: f64, step: u64, ended: bool, counts: LiveCounts) -> Message {
    let LiveCounts {
        sent, superseded, ..
    } = counts;
    Message::json(
        "clock",
        &json!({"t_s": t_s, "step": step, "ended": ended, "sent": sent, "superseded": superseded}),
    )
}

/// All messages of a state except the clock.
pub(super) fn state(frame: &Frame) -> Vec<Message> {
    let robots = (frame.robots.iter()).flat_map(|r| robot(frame.t_s, r, &frame.abnormal));
    let gantries = frame.gantries.iter().flat_map(|g| gantry(frame.t_s, g));
    robots.chain(gantries).collect()
}

fn robot(t_s: f64, r: &RobotFrame, abnormal: &[Abnormal]) -> Vec<Message> {
    let id = chunk(&r.id);
    let mut out = Vec::with_capacity(8);
    let mut say =
        |topic: &str, value: Value| out.push(Message::json(format!("auv/{id}/{topic}"), &value));

    let pose = &r.truth.pose;
    say(
        "truth",
        json!({
            "t_s": t_s,
            "position_m": pose.p_WB.as_slice(),
            "quaternion_xyzw": pose.R_WB.coords.as_slice(),
            "heading_rad": pose.heading().rad(),
            "velocity_m_s": r.truth.v_world().as_slice(),
            "rates_rad_s": r.truth.w_WB_B.as_slice(),
            "altitude_m": r.altitude_m,
        }),
    );
    let e = &r.estimate;
    say(
        "estimate",
        with(
            json!({
                "t_s": e.t_s,
                "position_m": e.position.as_slice(),
                "depth_m": e.depth_m,
                "heading_rad": e.attitude.heading.rad(),
                "roll_rad": e.attitude.roll_rad,
                "pitch_rad": e.attitude.pitch_rad,
                "velocity_m_s": e.v_ground().as_slice(),
                "fix_jump_m": e.fix_jump_m(),
            }),
            "altitude_m",
            e.altitude_m,
        ),
    );
    if let Some(flow) = &e.flow {
        say(
            "flow",
            json!({
                "t_s": e.t_s,
                "velocity_m_s": flow.velocity.as_slice(),
                "heading_rad": flow.heading().rad(),
                "age_s": flow.age_s,
            }),
        );
    }
    if let Some(g) = &r.goal {
        say("goal", goal(t_s, g));
    }
    if let Some(c) = &r.command {
        say("command", command(t_s, c, r));
    }
    if let Some(c) = &r.chemical {
        say(
            "chemical",
            json!({
                "t_s": t_s,
                "volts": c.volts,
                "of_full_scale": c.of_full_scale,
                "above_threshold": c.detected,
                "detected": r.detected,
            }),
        );
    }
    let lost: Vec<[f64; 2]> = r.lost_points.iter().map(|p| [p.x, p.y]).collect();
    let mut doing = json!({"t_s": t_s, "behaviour": r.behaviour.name(), "lost_points_m": lost});
    if let Some(k) = r.regions.now {
        let corners = r.regions.all[k as usize].area.corners();
        let corners = corners.map(|p| [p.x, p.y]);
        doing = merged(
            doing,
            json!({"region": k, "region_name": region_name(k), "region_m": corners}),
        );
    }
    let wrong: Vec<&str> = (abnormal.iter())
        .filter(|a| a.robot == r.id && !a.over)
        .map(|a| a.what.words())
        .collect();
    if !wrong.is_empty() {
        doing = merged(doing, json!({ "abnormal": wrong }));
    }
    say("behaviour", doing);
    if !r.layers.is_empty() {
        let names: Vec<&str> = r.layers.iter().map(|l| l.name).collect();
        let states: Vec<_> = r.layers.iter().map(|l| l.state).collect();
        let mut said = json!({"t_s": t_s, "layers": names, "states": states});
        if let Some(holds) = r.holding_layer() {
            said["holds"] = holds.into();
        }
        say("layers", said);
    }
    for d in &r.declarations {
        say(&format!("declaration/{}", d.number), declaration(d));
    }
    out
}

fn declaration(d: &Declaration) -> Value {
    let mut said = json!({
        "t_s": d.t_s, "number": d.number, "position_m": d.position.as_slice(), "rule": d.rule,
        "verdict": d.verdict.name(),
    });
    if let Some(k) = d.region {
        said = merged(said, json!({ "region": k, "region_name": region_name(k) }));
    }
    if let Some(p) = d.surveyed {
        said = merged(said, json!({"surveyed_m": p.as_slice()}));
    }
    said
}

fn goal(t_s: f64, g: &Goal) -> Value {
    let horizontal = match g.manoeuvre {
        Manoeuvre::GoToPoint { point, radius_m } => with(
            json!({"manoeuvre": "go_to_point", "point_m": point.as_slice()}),
            "radius_m",
            radius_m,
        ),
        Manoeuvre::FollowLine { from, to } => {
            json!({"manoeuvre": "follow_line", "from_m": from.as_slice(), "point_m": to.as_slice()})
        }
        Manoeuvre::GoToPointWithHeading { point, heading } => json!({
            "manoeuvre": "go_to_point_with_heading", "point_m": point.as_slice(), "heading_rad": heading.rad(),
        }),
        Manoeuvre::Course { course } => json!({"manoeuvre": "course", "heading_rad": course.rad()}),
        Manoeuvre::Direct { .. } => json!({"manoeuvre": "direct"}),
    };
    let (vertical, vertical_m) = vertical(g.vertical);
    merged(
        horizontal,
        json!({
            "t_s": t_s, "id": g.id, "vertical": vertical, "vertical_m": vertical_m, "speed_m_s": g.speed_m_s,
        }),
    )
}

fn command(t_s: f64, c: &Command, r: &RobotFrame) -> Value {
    let asked = match c {
        Command::Steer(s) => {
            let (vertical, vertical_m) = vertical(s.vertical);
            json!({
                "kind": "steer", "heading_rad": s.heading.rad(), "water_speed_m_s": s.water_speed_m_s,
                "vertical": vertical, "vertical_m": vertical_m,
            })
        }
        Command::Direct(_) => json!({"kind": "direct"}),
    };
    let a = &r.actuators;
    merged(
        asked,
        json!({"t_s": t_s, "rudder_rad": a.rudder_rad, "stern_rad": a.stern_rad, "rpm": a.rpm}),
    )
}

fn vertical(v: Vertical) -> (&'static str, f64) {
    match v {
        Vertical::Altitude(m) => ("altitude", m),
        Vertical::Depth(m) => ("depth", m),
    }
}

/// A plume, evenly thinned if it is too large for one message.
pub(super) fn plume(p: &PlumeFrame) -> Message {
    let stride = p.points.len().div_ceil(MOST_FILAMENTS).max(1);
    let shown = p.points.iter().step_by(stride);
    // The filaments that are shown also stand for those omitted here, as they already do for those omitted before.
    let times = p.points.len() as f32 / shown.len().max(1) as f32;
    let shown = shown.map(|&[x, y, z, size, mass, n]| [x, y, z, size, mass * times, n * times]);
    let header = json!({
        "t_s": p.t_s, "total": p.total, "shown": shown.len(),
        "fields": ["x", "y", "z", "size", "mass", "stands_for"], "dtype": "<f4",
    });
    Message::numbers("plume", shown.flatten(), &header)
}

/// Messages known before the run starts: scenario, version and schemas.
pub(super) fn meta(meta: &super::LiveMeta) -> Vec<Message> {
    let mut out = vec![
        Message::json(
            "meta/scenario",
            &json!({
                "name": meta.scenario_name, "seed": meta.seed, "ron": meta.scenario_text,
            }),
        ),
        Message::json(
            "meta/version",
            &json!({"program": "rheotaxis", "version": meta.version}),
        ),
    ];
    let schema = |t: &Topic| Message::json(format!("meta/schema/{}", t.name), &t.schema());
    out.extend(topics().iter().map(schema));
    out
}

pub(super) fn digest(digest: &str) -> Message {
    Message::json("meta/digest", &json!({"digest": digest}))
}

fn merged(a: Value, b: Value) -> Value {
    let fields = |v| match v {
        Value::Object(fields) => fields,
        _ => Map::new(),
    };
    fields(a).into_iter().chain(fields(b)).collect()
}

pub(super) fn with(object: Value, name: &str, number: Option<f64>) -> Value {
    match number {
        Some(number) => merged(object, json!({ name: number })),
        None => object,
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::sample_gantry as sample;
    use nalgebra::{Vector2, Vector3};
    use robots::handoff::{ActuatorCommand, Attitude, Behaviour, Estimate, GantryBehaviour};
    use world::frames::{Pose, Truth};
    use world::units::Heading;

    /// One robot, heading east at 1 m/s.
    pub(crate) fn frame(step: u64) -> Frame {
        let heading = Heading::from_deg(90.0);
        let pose = Pose::level(Vector3::new(1.0, 2.0, -3.0), heading);
        let mut truth = Truth::at_rest(pose);
        truth.v_WB_B = Vector3::x();
        let estimate = Estimate {
            t_s: 0.0,
            position: Vector2::new(1.0, 2.0),
            depth_m: 3.0,
            altitude_m: None,
            attitude: Attitude {
                heading,
                roll_rad: 0.0,
                pitch_rad: 0.0,
                rates_rad_s: Vector3::zeros(),
            },
            v_ground_body: Vector3::x(),
            flow: None,
            fix_jump: Vector2::zeros(),
        };
        let robot = RobotFrame {
            id: "auv0".to_owned(),
            truth,
            altitude_m: 2.0,
            estimate,
            goal: None,
            command: None,
            actuators: ActuatorCommand::default(),
            chemical: None,
            detected: false,
            behaviour: Behaviour::Find,
            layers: std::sync::Arc::default(),
            lost_points: Vec::new(),
            planned: std::sync::Arc::default(),
            belief: None,
            regions: Default::default(),
            declarations: Vec::new(),
            fix_m: None,
        };
        Frame {
            t_s: 0.1,
            step,
            robots: vec![robot],
            gantries: vec![sample::gantry(1.0, 0.0, GantryBehaviour::StepUp)],
            abnormal: Vec::new(),
        }
    }

    #[test]
    fn velocities_are_in_world_axes() {
        let messages = state(&frame(0));
        let truth: Value = serde_json::from_slice(&messages[0].payload).unwrap();
        assert_eq!(messages[0].key, "auv/auv0/truth");
        let v: Vec<f64> = serde_json::from_value(truth["velocity_m_s"].clone()).unwrap();
        // East at 1 m/s; a quarter turn in f64 is exact to a few ulp.
        assert!(
            (v[0] - 1.0).abs() < 1e-12 && v[1].abs() < 1e-12 && v[2].abs() < 1e-12,
            "{v:?}"
        );
    }

    #[test]
    fn a_plume_is_packed_in_order_and_thinned_evenly() {
        let n = 2 * MOST_FILAMENTS + 1;
        let points = (0..n)
            .map(|i| [i as f32, 1.0, 2.0, 3.0, 4.0, 10.0])
            .collect();
        let message = plume(&PlumeFrame {
            t_s: 1.5,
            total: 99_999,
            points,
        });
        let header: Value = serde_json::from_slice(&message.attachment.unwrap()).unwrap();
        let shown = header["shown"].as_u64().unwrap() as usize;
        assert_eq!(shown, n.div_ceil(3));
        assert_eq!(header["total"], 99_999);
        assert_eq!(message.payload.len(), shown * 24);
        let number =
            |i: usize| f32::from_le_bytes(message.payload[4 * i..4 * i + 4].try_into().unwrap());
        assert_eq!([number(0), number(6), number(7)], [0.0, 3.0, 1.0]);
        // The masses sum to those of all points passed in.
        let mass: f64 = (0..shown).map(|i| f64::from(number(6 * i + 4))).sum();
        assert!((mass / (4.0 * n as f64) - 1.0).abs() < 1e-5, "{mass}");
    }
}
