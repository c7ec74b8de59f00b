//! The messages of a robot, one for each row of [`TOPICS`](super::topics::TOPICS) that is JSON.

use crate::frame::{RobotFrame, TimedReading};
use crate::incidents::Incident;
use crate::topic::{chunk, merged, with};
use robots::handoff::{Actuation, Command, Declaration, Goal, Manoeuvre, Vertical, region_name};
use serde_json::{Value, json};

/// All messages of a robot in a frame; `abnormal` are the events of all robots.
pub(crate) fn messages(t_s: f64, r: &RobotFrame, abnormal: &[Incident]) -> Vec<(String, Value)> {
    let id = chunk(&r.id);
    let mut out = Vec::with_capacity(8);
    let mut say = |topic: &str, value: Value| out.push((format!("auv/{id}/{topic}"), value));

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
    if let Some(TimedReading { t_s, value: scan }) = &r.readings.ranging {
        let echoes: Vec<_> = scan.echoes_B().map(|p| [p.x, p.y, p.z]).collect();
        say(
            "ranging",
            json!({
                "t_s": t_s,
                "place_body_m": scan.p_BS.as_slice(),
                "free": scan.beams.len() - echoes.len(),
                "echoes_body_m": echoes,
                "max_m": scan.max_m,
            }),
        );
    }
    let lost: Vec<[f64; 2]> = r.shown.lost_points.iter().map(|p| [p.x, p.y]).collect();
    let mut doing = json!({"t_s": t_s, "behaviour": r.behaviour.name(), "lost_points_m": lost});
    if !r.shown.zone.points.is_empty() {
        let [points, corners] =
            [&r.shown.zone.points, &r.shown.zone.corners].map(|all| all.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>());
        doing = merged(doing, json!({"zone_points_m": points, "zone_m": corners}));
    }
    if let Some(k) = r.shown.regions.now {
        let corners = r.shown.regions.all[k as usize].area.corners();
        let corners = corners.map(|p| [p.x, p.y]);
        doing = merged(doing, json!({"region": k, "region_name": region_name(k), "region_m": corners}));
    }
    let wrong: Vec<String> = (abnormal.iter()).filter(|a| a.robot == r.id && !a.over).map(Incident::describe).collect();
    if !wrong.is_empty() {
        doing = merged(doing, json!({ "abnormal": wrong }));
    }
    say("behaviour", doing);
    if !r.shown.layers.is_empty() {
        let names: Vec<&str> = r.shown.layers.iter().map(|l| l.name).collect();
        let states: Vec<_> = r.shown.layers.iter().map(|l| l.state).collect();
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
    if let Some(l) = d.looked {
        said = merged(said, json!({"pictures": l.pictures, "log_factor": l.log_factor}));
    }
    said
}

fn goal(t_s: f64, g: &Goal) -> Value {
    let horizontal = match g.manoeuvre {
        Manoeuvre::GoToPoint { point, radius_m } => {
            with(json!({"manoeuvre": "go_to_point", "point_m": point.as_slice()}), "radius_m", radius_m)
        }
        Manoeuvre::FollowLine { from, to } => {
            json!({"manoeuvre": "follow_line", "from_m": from.as_slice(), "point_m": to.as_slice()})
        }
        Manoeuvre::GoToPointWithHeading { point, heading } => json!({
            "manoeuvre": "go_to_point_with_heading", "point_m": point.as_slice(), "heading_rad": heading.rad(),
        }),
        Manoeuvre::Hold { point, .. } => {
            json!({"manoeuvre": "hold", "point_m": point.as_slice()})
        }
        Manoeuvre::SlideTo { point, radius_m, heading } => with(
            json!({
                "manoeuvre": "slide_to", "point_m": point.as_slice(), "heading_rad": heading.rad(),
            }),
            "radius_m",
            radius_m,
        ),
        Manoeuvre::Course { course } => json!({"manoeuvre": "course", "heading_rad": course.rad()}),
        Manoeuvre::Steer { heading } => {
            json!({"manoeuvre": "steer", "heading_rad": heading.rad()})
        }
        Manoeuvre::Slide { heading, over_ground_m_s: v } => {
            json!({"manoeuvre": "slide", "heading_rad": heading.rad(), "velocity_m_s": v.as_slice()})
        }
        Manoeuvre::Drives(set) => json!({"manoeuvre": "drives", "drives": set.all()}),
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
        Command::Steer(s) => json!({
            "kind": "steer", "heading_rad": s.heading.rad(), "water_speed_m_s": s.water_speed_m_s,
        }),
        Command::Move(s) => json!({
            "kind": "move", "heading_rad": s.heading.rad(),
            "east_m_s": s.over_ground_m_s.x, "north_m_s": s.over_ground_m_s.y,
        }),
        Command::Direct(_) | Command::Drives(_) => json!({"kind": "direct"}),
    };
    let mut said = merged(asked, json!({ "t_s": t_s }));
    if let Some(height) = r.asked_height() {
        let (vertical, vertical_m) = vertical(height);
        said["vertical"] = vertical.into();
        said["vertical_m"] = vertical_m.into();
    }
    if let Actuation::Drives(set) = &r.actuators {
        said["drives"] = set.all().into();
        return said;
    }
    for (name, value) in r.actuators.named() {
        said[name] = value.into();
    }
    said
}

fn vertical(v: Vertical) -> (&'static str, f64) {
    match v {
        Vertical::Altitude(m) => ("altitude", m),
        Vertical::Depth(m) => ("depth", m),
    }
}
