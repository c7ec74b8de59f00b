//! Answers as JSON, read and written.

use super::forms::{AnswerForm, DeclareForm, DrivesForm, GoalForm, HeadForm, SlideForm, SteerForm};
use super::names::{behaviour, lasting};
use nalgebra::Vector2;
use robots::handoff::{
    Behaviour, Declaration, DriveCommand, HeadOrder, MOST_DRIVES, Manoeuvre, MotionOrder, MoveOrder, Reply, Vertical,
};
use serde_json::Value;
use world::units::Heading;

/// Longest answer that is read, bytes.
const LONGEST: usize = 65_536;

/// Reads an answer to the question of a number, asked at a time of the mission, s: one JSON object, of which each field
/// may be left out:
///
/// ```json
/// {"number": 12,
///  "goal": {"manoeuvre": {"go_to_point": {"point_m": [10.0, 20.0]}}, "depth_m": 3.0, "speed_m_s": 1.5},
///  "behaviour": "surge", "declare": {"position_m": [9.5, 21.0]}, "picture": true, "end": "completed"}
/// ```
///
/// In the place of `goal` one of `{"steer": {"heading_rad", "depth_m", "speed_m_s"}}`, `{"slide": {"heading_rad",
/// "velocity_m_s"}}`, `{"drives": {"set": [..]}}`, or for a gantry `{"head": {"target_m": [forward, left]}}`.
///
/// # Errors
/// What is wrong with it.
pub fn read_answer(text: &[u8], number: u64, t_s: f64) -> Result<Reply, String> {
    if text.len() > LONGEST {
        return Err(format!("an answer has at most {LONGEST} bytes, got {}", text.len()));
    }
    let form: AnswerForm = serde_json::from_slice(text).map_err(|e| e.to_string())?;
    if let Some(other) = form.number.filter(|n| *n != number) {
        return Err(format!("it answers question {other}, not {number}"));
    }
    form.answer(t_s)
}

/// An answer as [`read_answer`] reads it, to the last bit.
pub fn answer_json(answer: &Reply) -> Value {
    let mut value = serde_json::to_value(AnswerForm::from_reply(answer)).expect("numbers and names can be written");
    drop_nulls(&mut value);
    value
}

/// Takes away what is left out.
pub(super) fn drop_nulls(value: &mut Value) {
    match value {
        Value::Object(fields) => {
            fields.retain(|_, value| !value.is_null());
            fields.values_mut().for_each(drop_nulls);
        }
        Value::Array(all) => all.iter_mut().for_each(drop_nulls),
        _ => {}
    }
}

fn vertical(depth_m: Option<f64>, altitude_m: Option<f64>) -> Result<Option<Vertical>, String> {
    match (depth_m, altitude_m) {
        (Some(_), Some(_)) => Err("give `depth_m` or `altitude_m`, not both".to_string()),
        (Some(m), None) => Ok(Some(Vertical::Depth(m))),
        (None, Some(m)) => Ok(Some(Vertical::Altitude(m))),
        (None, None) => Ok(None),
    }
}

/// Depth and altitude, of which at most one is there.
fn heights(vertical: Option<Vertical>) -> [Option<f64>; 2] {
    match vertical {
        Some(Vertical::Depth(m)) => [Some(m), None],
        Some(Vertical::Altitude(m)) => [None, Some(m)],
        None => [None, None],
    }
}

impl AnswerForm {
    fn answer(self, t_s: f64) -> Result<Reply, String> {
        let given = [
            self.goal.is_some(),
            self.steer.is_some(),
            self.slide.is_some(),
            self.drives.is_some(),
            self.head.is_some(),
        ];
        if given.iter().filter(|there| **there).count() > 1 {
            return Err("give one of `goal`, `steer`, `slide`, `drives` and `head`".to_string());
        }
        let orders = [
            self.goal.map(GoalForm::order).transpose()?,
            self.steer.map(SteerForm::order).transpose()?,
            self.slide.map(SlideForm::order).transpose()?,
            self.drives.map(DrivesForm::order).transpose()?,
            self.head.map(HeadForm::order).transpose()?,
        ];
        let declared = self.declare.map(|d| {
            let rule = d.rule.as_deref().map_or(Ok("external"), lasting)?;
            let position = Vector2::from(d.position_m);
            Ok::<_, String>(Declaration { number: d.number, ..Declaration::first(t_s, position, rule) })
        });
        Ok(Reply {
            order: orders.into_iter().flatten().next(),
            behaviour: self.behaviour.as_deref().map(behaviour).transpose()?,
            declared: declared.transpose()?,
            picture: self.picture.unwrap_or(false),
            outcome: self.end,
        })
    }

    fn from_reply(answer: &Reply) -> Self {
        let mut form = Self {
            behaviour: answer.behaviour.map(|b: Behaviour| b.name().to_string()),
            declare: answer.declared.map(|d| DeclareForm {
                position_m: d.position.into(),
                rule: Some(d.rule.to_string()),
                number: d.number,
            }),
            picture: answer.picture.then_some(true),
            end: answer.outcome,
            ..Self::default()
        };
        match &answer.order {
            Some(MotionOrder::Move(order)) => form.set_order(order),
            Some(MotionOrder::Head(order)) => {
                form.head = Some(HeadForm {
                    target_m: order.target_m.into(),
                    speed_m_s: order.speed_m_s.map(Into::into),
                    behaviour: Some(order.behaviour.name().to_string()),
                    id: order.id,
                });
            }
            None => {}
        }
        form
    }

    fn set_order(&mut self, order: &MoveOrder) {
        let [depth_m, altitude_m] = heights(order.vertical);
        let (id, speed_m_s) = (order.id, order.speed_m_s);
        match order.manoeuvre {
            Manoeuvre::Steer { heading } => {
                self.steer = Some(SteerForm { heading_rad: heading.rad(), depth_m, altitude_m, speed_m_s, id });
            }
            Manoeuvre::Slide { heading, over_ground_m_s } => {
                let (heading_rad, velocity_m_s) = (heading.rad(), over_ground_m_s.into());
                self.slide = Some(SlideForm { heading_rad, velocity_m_s, depth_m, altitude_m, id });
            }
            Manoeuvre::Drives(set) => self.drives = Some(DrivesForm { set: set.all().to_vec(), id }),
            manoeuvre => self.goal = Some(GoalForm { manoeuvre, depth_m, altitude_m, speed_m_s, id }),
        }
    }
}

fn to_move(id: Option<u32>, manoeuvre: Manoeuvre, vertical: Option<Vertical>, speed_m_s: Option<f64>) -> MotionOrder {
    MotionOrder::Move(MoveOrder { id, manoeuvre, vertical, speed_m_s })
}

impl GoalForm {
    fn order(self) -> Result<MotionOrder, String> {
        let vertical = vertical(self.depth_m, self.altitude_m)?;
        Ok(to_move(self.id, self.manoeuvre, vertical, self.speed_m_s))
    }
}

impl SteerForm {
    fn order(self) -> Result<MotionOrder, String> {
        let heading = Heading::from_rad(self.heading_rad);
        let vertical = vertical(self.depth_m, self.altitude_m)?;
        Ok(to_move(self.id, Manoeuvre::Steer { heading }, vertical, self.speed_m_s))
    }
}

impl SlideForm {
    fn order(self) -> Result<MotionOrder, String> {
        let manoeuvre = Manoeuvre::Slide {
            heading: Heading::from_rad(self.heading_rad),
            over_ground_m_s: self.velocity_m_s.into(),
        };
        let vertical = vertical(self.depth_m, self.altitude_m)?;
        Ok(to_move(self.id, manoeuvre, vertical, None))
    }
}

impl DrivesForm {
    fn order(self) -> Result<MotionOrder, String> {
        if self.set.len() > MOST_DRIVES {
            return Err(format!("no vehicle has more than {MOST_DRIVES} drives, got {}", self.set.len()));
        }
        let set = Manoeuvre::Drives(DriveCommand::new(&self.set));
        Ok(to_move(self.id, set, None, None))
    }
}

impl HeadForm {
    fn order(self) -> Result<MotionOrder, String> {
        let named = |name: &String| {
            let all = Behaviour::OF_GANTRY;
            all.into_iter().find(|b| b.name() == name).ok_or_else(|| {
                let names: Vec<_> = all.iter().map(|b| b.name()).collect();
                format!("`behaviour` must be one of {}, got {name:?}", names.join(", "))
            })
        };
        let behaviour = self.behaviour.as_ref().map(named).transpose()?;
        Ok(MotionOrder::Head(HeadOrder {
            id: self.id,
            target_m: self.target_m.into(),
            speed_m_s: self.speed_m_s.map(Into::into),
            behaviour: behaviour.unwrap_or(Behaviour::StepUp),
        }))
    }
}
