//! What holds for all runs of a campaign, or differs between arms and conditions: time limit and success.

use super::error::CampaignError;
use super::plan::Campaign;
use super::report::SuccessTime;
use rheotaxis::scenario::Scenario;

impl Campaign {
    /// The shortest time limit of its scenarios, s. It differs between them only if arms or conditions set it.
    ///
    /// # Errors
    /// If a scenario cannot be made.
    pub fn limit_s(&self) -> Result<f64, CampaignError> {
        let mut least = f64::INFINITY;
        self.each("time", |scenario| {
            least = least.min(scenario.time.limit_s.get());
        })?;
        Ok(least)
    }

    /// By when a success counts in its scenarios, and how near a declaration has to be: the largest distance, if arms or
    /// conditions set it.
    ///
    /// # Errors
    /// If a scenario cannot be made.
    pub fn success_time(&self) -> Result<SuccessTime, CampaignError> {
        let mut within_m: Option<f64> = None;
        self.each("success", |scenario| {
            let m = scenario.success.declared_within_m();
            within_m = within_m.map_or(m, |most| m.map(|m| m.max(most)).or(Some(most)));
        })?;
        Ok(SuccessTime { limit_s: self.limit_s()?, within_m })
    }

    /// What counts as a success in its scenarios, in words: one rule, unless arms or conditions set it.
    ///
    /// # Errors
    /// If a scenario cannot be made.
    pub fn success_rules(&self) -> Result<Vec<String>, CampaignError> {
        let mut rules = Vec::new();
        self.each("success", |scenario| {
            let words = scenario.success.describe();
            if !rules.contains(&words) {
                rules.push(words);
            }
        })?;
        Ok(rules)
    }

    /// Shows `what` a scenario, and if arms or conditions set something of `field`, that of each of them.
    fn each(&self, field: &str, mut what: impl FnMut(&Scenario)) -> Result<(), CampaignError> {
        let set = |paths: &[(String, String)]| paths.iter().any(|(path, _)| path.starts_with(field));
        let by_arms = self.spec.arms.iter().any(|a| set(&a.set));
        let conditions = if set(&self.condition(0)) { self.spec.n_conditions() } else { 1 };
        let arms = if by_arms { self.spec.arms.len() } else { 1 };
        for condition in 0..conditions {
            for arm in 0..arms {
                what(&self.typical(condition, arm)?.scenario);
            }
        }
        Ok(())
    }
}
