//! A question as JSON: SI units, ENU axes, compass headings in radians; what was not measured is left out.

use super::answers::drop_nulls;
use super::{Question, QuestionContent, ReadingsSince};
use robots::handoff::{Estimate, GantryObservation, Observation, RangeScan};
use serde_json::{Map, Value, json};

/// A question as JSON. Pictures and sidescan pings are not in it: they have topics of their own.
pub fn question_json(question: &Question) -> Value {
    let mut said = match &question.seen {
        QuestionContent::Robot(seen, gathered) => robot(question.t_s, seen, gathered),
        QuestionContent::Gantry(seen, gathered) => gantry(seen, gathered),
    };
    said["robot"] = json!(question.robot);
    said["number"] = json!(question.number);
    said["step"] = json!(question.step);
    said["t_s"] = json!(question.t_s);
    said["deadline_s"] = json!(question.deadline_s);
    drop_nulls(&mut said);
    said
}

fn robot(t_s: f64, seen: &Observation, gathered: &ReadingsSince) -> Value {
    let able = &seen.able;
    let other = seen.other.iter().map(|(name, v)| ((*name).to_string(), json!(v)));
    json!({
        "estimate": estimate(&seen.estimate),
        "guidance": {
            "goal": seen.guidance.goal_id, "done": seen.guidance.done, "aborted": seen.guidance.aborted,
        },
        "gathered": chemical(t_s, gathered),
        "home_m": seen.home.as_slice(),
        "area_m": seen.area.corners().map(|p| [p.x, p.y]),
        "able": {
            "least_speed_m_s": able.least_speed_m_s, "top_speed_m_s": able.top_speed_m_s,
            "turning_radius_m": able.turning_radius_m, "hovers": able.hovers, "sideways": able.sideways,
            "dives": able.dives, "holds_depth": able.holds_depth,
        },
        "flow": seen.estimate.flow.map(|flow| {
            json!({"velocity_m_s": flow.velocity.as_slice(), "age_s": flow.age_s})
        }),
        "belief": seen.belief.as_ref().map(|belief| json!({
            "best_m": belief.grid.centre(belief.best).as_slice(), "entropy_nat": belief.entropy_nat,
            "updates": belief.updates, "informed": belief.informed,
        })),
        "ranging": gathered.ranging.as_ref().map(ranging),
        "other": (!seen.other.is_empty()).then(|| other.collect::<Map<_, _>>()),
    })
}

fn estimate(e: &Estimate) -> Value {
    json!({
        "position_m": e.position.as_slice(), "depth_m": e.depth_m, "altitude_m": e.altitude_m,
        "heading_rad": e.attitude.heading.rad(), "roll_rad": e.attitude.roll_rad, "pitch_rad": e.attitude.pitch_rad,
        "rates_rad_s": e.attitude.rates_rad_s.as_slice(), "velocity_m_s": e.v_ground().as_slice(),
        "velocity_body_m_s": e.v_ground_body.as_slice(),
    })
}

/// What the chemical sensor said since the last question.
fn chemical(t_s: f64, g: &ReadingsSince) -> Value {
    json!({
        "readings": g.readings, "detections": g.detections, "highest": g.highest,
        "mean": (g.readings > 0).then(|| g.sum / f64::from(g.readings)),
        "newest": g.chemical.map(|newest| json!({
            "volts": newest.volts, "of_full_scale": newest.of_full_scale, "detected": newest.detected,
        })),
        "since_detection_s": g.detected_s.map(|then| t_s - then),
    })
}

fn ranging(scan: &RangeScan) -> Value {
    let beams = scan.beams.iter();
    let beams: Vec<Value> =
        beams.map(|beam| json!({"direction_body": beam.dir_B.as_slice(), "echo_m": beam.echo_m})).collect();
    json!({"place_body_m": scan.p_BS.as_slice(), "max_m": scan.max_m, "beams": beams})
}

fn gantry(seen: &GantryObservation, gathered: &ReadingsSince) -> Value {
    let joints = &seen.readings.joints;
    let scans: Vec<Value> =
        (gathered.scans.iter()).map(|scan| json!({"t_s": scan.t_s, "volts": &scan.volts[..scan.count]})).collect();
    json!({
        "joints": {
            "position_m": joints.position_m.as_slice(), "speed_m_s": joints.speed_m_s.as_slice(),
            "arrived": joints.arrived, "blocked": joints.blocked,
        },
        "scans": scans,
    })
}
