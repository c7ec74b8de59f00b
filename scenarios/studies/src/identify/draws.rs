//! The draws of a campaign with their runs.

use crate::campaign::{Arm, Campaign, RunRow};
use crate::distribution::Distribution as Prior;
use std::collections::BTreeMap;

/// A value that is not known.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Its path in the scenario.
    pub path: String,
    /// From what it was drawn.
    pub prior: Prior,
}

/// An arm that was drawn, with its runs.
#[derive(Clone, Debug)]
pub struct Draw {
    /// The arm's name.
    pub name: String,
    /// What it sets.
    pub set: Vec<(String, String)>,
    /// The round of its runs, from 0.
    pub round: usize,
    /// Its runs.
    pub runs: Vec<RunRow>,
}

/// The draws of a campaign.
#[derive(Clone, Debug)]
pub struct Draws {
    /// What differs from draw to draw.
    pub unknowns: Vec<Unknown>,
    /// The draws that have runs.
    pub draws: Vec<Draw>,
}

impl Draws {
    /// Of a first round, the campaign that drew them, and of the rounds after it. A draw's runs are those of the last
    /// round that has it, for a round was made for what the rounds before it have left: their trials have chosen it.
    ///
    /// # Errors
    /// What the rounds lack: drawn arms, or the same arms.
    pub fn gather(rounds: Vec<(Campaign, Vec<RunRow>)>) -> Result<Self, String> {
        let first = rounds.first().ok_or("there is no round")?;
        let drawn = (first.0.spec.drawn_arms.as_ref())
            .ok_or_else(|| format!("the campaign `{}` draws no arms (`drawn_arms`)", first.0.name))?;
        let varies = |(_, prior): &&(String, Prior)| !matches!(prior, Prior::Choice(all) if all.len() == 1);
        let unknowns = (drawn.draw.iter())
            .filter(varies)
            .map(|(path, prior)| Unknown { path: path.clone(), prior: prior.clone() })
            .collect();
        let mut draws: BTreeMap<String, Draw> = BTreeMap::new();
        let arms: BTreeMap<&String, &Arm> = first.0.spec.arms.iter().map(|arm| (&arm.name, arm)).collect();
        for (round, (campaign, rows)) in rounds.iter().enumerate() {
            for arm in &campaign.spec.arms {
                if arms.get(&arm.name).is_none_or(|there| there.set != arm.set) {
                    return Err(format!("`{}` has an arm `{}` that the first round has not", campaign.name, arm.name));
                }
            }
            let mut runs: BTreeMap<&String, Vec<RunRow>> = BTreeMap::new();
            for row in rows {
                runs.entry(&row.arm).or_default().push(row.clone());
            }
            for (name, runs) in runs {
                let Some(arm) = arms.get(name) else { continue };
                draws.insert(name.clone(), Draw { name: name.clone(), set: arm.set.clone(), round, runs });
            }
        }
        Ok(Self { unknowns, draws: draws.into_values().collect() })
    }
}

impl Draw {
    /// Its value of an unknown.
    pub fn value(&self, path: &str) -> Option<&str> {
        self.set.iter().find(|(p, _)| p == path).map(|(_, value)| value.as_str())
    }
}
