//! Consultations as JSON, and a controller that repeats recorded ones.

use super::{Controller, Exchange, Question, Response, answer_json, read_answer};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A consultation as JSON, as it is recorded.
pub fn consultation_json(told: &Exchange) -> Value {
    let mut said = json!({
        "robot": told.robot, "number": told.number, "step": told.step, "t_s": told.t_s, "cause": told.response.name(),
    });
    match &told.response {
        Response::Answer(answer) => said["answer"] = answer_json(answer),
        Response::Nonsense(why) => said["why"] = json!(why),
        _ => {}
    }
    said
}

/// Reads what [`consultation_json`] wrote, to the last bit.
///
/// # Errors
/// What is wrong with it.
pub fn read_consultation(text: &str) -> Result<Exchange, String> {
    let value: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
    let lacks = |field: &str| format!("`{field}` is missing or of another type");
    let number = |field: &str| value[field].as_u64().ok_or_else(|| lacks(field));
    let words = |field: &str| value[field].as_str().ok_or_else(|| lacks(field));
    let (number, step) = (number("number")?, number("step")?);
    let t_s = value["t_s"].as_f64().ok_or_else(|| lacks("t_s"))?;
    let heard = match words("cause")? {
        "answered" => Response::Answer(read_answer(value["answer"].to_string().as_bytes(), number, t_s)?),
        "late" => Response::Late,
        "absent" => Response::Absent,
        "gone" => Response::Gone,
        "nonsense" => Response::Nonsense(words("why")?.to_string()),
        other => return Err(format!("unknown cause {other:?}")),
    };
    Ok(Exchange { robot: words("robot")?.to_string(), number, step, t_s, response: heard })
}

/// A controller that repeats what a robot was told in another run of the same scenario and seed.
#[derive(Clone, Debug, Default)]
pub struct Replay {
    told: BTreeMap<(String, u64), Exchange>,
}

impl Replay {
    /// Of recorded consultations, of any number of robots.
    pub fn new(told: impl IntoIterator<Item = Exchange>) -> Self {
        let told = told.into_iter();
        Self { told: told.map(|c| ((c.robot.clone(), c.number), c)).collect() }
    }

    /// The robots that were asked.
    pub fn robots(&self) -> Vec<String> {
        let mut names: Vec<String> = self.told.keys().map(|(name, _)| name.clone()).collect();
        names.dedup();
        names
    }
}

impl Controller for Replay {
    /// What was told then; a question that was not asked then finds nobody.
    fn answer(&mut self, question: &Question) -> Response {
        let key = (question.robot.clone(), question.number);
        let told = self.told.get(&key).filter(|told| told.step == question.step);
        told.map_or(Response::Absent, |told| told.response.clone())
    }
}
