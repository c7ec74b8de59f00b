//! The messages of a robot, one for each row of [`TOPICS`](super::topics::TOPICS) that is JSON.

use super::topics::{
    BehaviourMessage, ChemicalMessage, CommandMessage, DeclarationMessage, EstimateMessage, FlowMessage, GoalMessage,
    LayersMessage, RangingMessage, ReadingsMessage, TruthMessage,
};
use crate::frame::{RobotFrame, TimedReading};
use crate::incidents::Incident;
use crate::topic::{Said, chunk};
use nalgebra::Vector2;
use robots::handoff::{Actuation, Command, Declaration, Goal, Manoeuvre, Vertical, region_name};
use world::units::Heading;

/// All messages of a robot in a frame; `abnormal` are the events of all robots.
pub(crate) fn messages(t_s: f64, r: &RobotFrame, abnormal: &[Incident]) -> Said {
    let mut said = Said::below(format!("auv/{}", chunk(&r.id)));
    said.add("truth", &truth(t_s, r));
    said.add("estimate", &estimate(r));
    if let Some(flow) = &r.estimate.flow {
        let (velocity_m_s, heading_rad) = (flow.velocity.into(), flow.heading().rad());
        said.add("flow", &FlowMessage { t_s: r.estimate.t_s, velocity_m_s, heading_rad, age_s: flow.age_s });
    }
    if let Some(g) = &r.goal {
        said.add("goal", &goal(t_s, g));
    }
    if let Some(c) = &r.command {
        said.add("command", &command(t_s, c, r));
    }
    if let Some(c) = &r.chemical {
        let (above_threshold, detected) = (c.detected, r.detected);
        let (volts, of_full_scale) = (c.volts, c.of_full_scale);
        said.add("chemical", &ChemicalMessage { t_s, volts, of_full_scale, above_threshold, detected });
    }
    if let Some(TimedReading { t_s, value: scan }) = &r.readings.ranging {
        let echoes_body_m: Vec<[f64; 3]> = scan.echoes_B().map(Into::into).collect();
        let free = scan.beams.len() - echoes_body_m.len();
        let place_body_m = scan.p_BS.into();
        said.add("ranging", &RangingMessage { t_s: *t_s, place_body_m, echoes_body_m, max_m: scan.max_m, free });
    }
    if !r.readings.other.is_empty() {
        let numbers = r.readings.other.iter().map(|(name, reading)| (*name, reading.value)).collect();
        said.add("readings", &ReadingsMessage { t_s, numbers });
    }
    said.add("behaviour", &behaviour(t_s, r, abnormal));
    if !r.shown.layers.is_empty() {
        let layers = r.shown.layers.iter().map(|l| l.name).collect();
        let states = r.shown.layers.iter().map(|l| l.state.name()).collect();
        said.add("layers", &LayersMessage { t_s, layers, states, holds: r.holding_layer() });
    }
    for d in &r.declarations {
        said.add(&format!("declaration/{}", d.number), &declaration(d));
    }
    said
}

fn truth(t_s: f64, r: &RobotFrame) -> TruthMessage {
    let pose = &r.truth.pose;
    TruthMessage {
        t_s,
        position_m: pose.p_WB.into(),
        quaternion_xyzw: pose.R_WB.coords.into(),
        heading_rad: pose.heading().rad(),
        velocity_m_s: r.truth.v_world().into(),
        rates_rad_s: r.truth.w_WB_B.into(),
        altitude_m: r.altitude_m,
    }
}

fn estimate(r: &RobotFrame) -> EstimateMessage {
    let e = &r.estimate;
    EstimateMessage {
        t_s: e.t_s,
        position_m: e.position.into(),
        depth_m: e.depth_m,
        altitude_m: e.altitude_m,
        heading_rad: e.attitude.heading.rad(),
        roll_rad: e.attitude.roll_rad,
        pitch_rad: e.attitude.pitch_rad,
        velocity_m_s: e.v_ground().into(),
        fix_jump_m: e.fix_jump_m(),
    }
}

fn behaviour(t_s: f64, r: &RobotFrame, abnormal: &[Incident]) -> BehaviourMessage {
    let zone = Some(&r.shown.zone).filter(|zone| !zone.points.is_empty());
    let region = r.shown.regions.now;
    let wrong: Vec<String> = (abnormal.iter()).filter(|a| a.robot == r.id && !a.over).map(Incident::describe).collect();
    BehaviourMessage {
        t_s,
        behaviour: r.behaviour.name(),
        lost_points_m: points(&r.shown.lost_points),
        zone_points_m: zone.map(|zone| points(&zone.points)),
        zone_m: zone.map(|zone| points(&zone.corners)),
        region,
        region_name: region.map(region_name),
        region_m: region.map(|k| points(&r.shown.regions.all[k as usize].area.corners())),
        abnormal: Some(wrong).filter(|wrong| !wrong.is_empty()),
    }
}

fn points(all: &[Vector2<f64>]) -> Vec<[f64; 2]> {
    all.iter().map(|p| (*p).into()).collect()
}

fn declaration(d: &Declaration) -> DeclarationMessage {
    DeclarationMessage {
        t_s: d.t_s,
        number: d.number,
        position_m: d.position.into(),
        rule: d.rule,
        verdict: d.verdict.name(),
        region: d.region,
        region_name: d.region.map(region_name),
        surveyed_m: d.surveyed.map(Into::into),
        pictures: d.looked.map(|l| l.pictures),
        log_factor: d.looked.map(|l| l.log_factor),
    }
}

fn goal(t_s: f64, g: &Goal) -> GoalMessage {
    let (vertical, vertical_m) = vertical(g.vertical);
    let said = GoalMessage { t_s, id: g.id, vertical, vertical_m, speed_m_s: g.speed_m_s, ..GoalMessage::default() };
    let at = |p: Vector2<f64>| Some(p.into());
    let rad = |h: Heading| Some(h.rad());
    match g.manoeuvre {
        Manoeuvre::GoToPoint { point, radius_m } => {
            GoalMessage { manoeuvre: "go_to_point", point_m: at(point), radius_m, ..said }
        }
        Manoeuvre::FollowLine { from, to } => {
            GoalMessage { manoeuvre: "follow_line", from_m: at(from), point_m: at(to), ..said }
        }
        Manoeuvre::GoToPointWithHeading { point, heading } => {
            GoalMessage { manoeuvre: "go_to_point_with_heading", point_m: at(point), heading_rad: rad(heading), ..said }
        }
        Manoeuvre::Hold { point, .. } => GoalMessage { manoeuvre: "hold", point_m: at(point), ..said },
        Manoeuvre::SlideTo { point, radius_m, heading } => {
            let (point_m, heading_rad) = (at(point), rad(heading));
            GoalMessage { manoeuvre: "slide_to", point_m, heading_rad, radius_m, ..said }
        }
        Manoeuvre::Course { course } => GoalMessage { manoeuvre: "course", heading_rad: rad(course), ..said },
        Manoeuvre::Steer { heading } => GoalMessage { manoeuvre: "steer", heading_rad: rad(heading), ..said },
        Manoeuvre::Slide { heading, over_ground_m_s } => {
            let (heading_rad, velocity_m_s) = (rad(heading), at(over_ground_m_s));
            GoalMessage { manoeuvre: "slide", heading_rad, velocity_m_s, ..said }
        }
        Manoeuvre::Drives(set) => GoalMessage { manoeuvre: "drives", drives: Some(set.all().to_vec()), ..said },
        Manoeuvre::Direct { .. } => GoalMessage { manoeuvre: "direct", ..said },
    }
}

fn command(t_s: f64, c: &Command, r: &RobotFrame) -> CommandMessage {
    let mut said = CommandMessage { t_s, kind: "direct", ..CommandMessage::default() };
    match c {
        Command::Steer(s) => {
            said.kind = "steer";
            said.heading_rad = Some(s.heading.rad());
            said.water_speed_m_s = Some(s.water_speed_m_s);
        }
        Command::Move(s) => {
            said.kind = "move";
            said.heading_rad = Some(s.heading.rad());
            said.east_m_s = Some(s.over_ground_m_s.x);
            said.north_m_s = Some(s.over_ground_m_s.y);
        }
        Command::Direct(_) | Command::Drives(_) => {}
    }
    (said.vertical, said.vertical_m) = r.asked_height().map(vertical).unzip();
    match &r.actuators {
        Actuation::Fins(set) => {
            said.rudder_rad = Some(set.rudder_rad);
            said.stern_rad = Some(set.stern_rad);
            said.rpm = Some(set.rpm);
        }
        Actuation::Rates(set) => {
            said.turn_rad_s = Some(set.turn_rad_s);
            said.climb_m_s = Some(set.climb_m_s);
            said.speed_m_s = Some(set.speed_m_s);
        }
        Actuation::Drives(set) => said.drives = Some(set.all().to_vec()),
    }
    said
}

fn vertical(v: Vertical) -> (&'static str, f64) {
    match v {
        Vertical::Altitude(m) => ("altitude", m),
        Vertical::Depth(m) => ("depth", m),
    }
}
