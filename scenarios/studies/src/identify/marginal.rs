//! What is known of each unknown alone.

use super::WeightedDraw;
use super::draws::Unknown;
use crate::campaign::Draw as Prior;
use crate::campaign::stats::Interval;
use std::collections::BTreeMap;

/// An unknown, before and after.
#[derive(Clone, Debug)]
pub struct Marginal {
    /// The unknown.
    pub unknown: Unknown,
    /// After.
    pub after: After,
}

/// What the draws' weights say of an unknown.
#[derive(Clone, Debug)]
pub enum After {
    /// Median of a number, and where 95 % of the weight lies.
    Number(f64, Interval),
    /// Share of the weight and of the draws by value.
    Choice(Vec<(String, f64, f64)>),
}

/// Those of all unknowns.
pub(super) fn marginals(unknowns: &[Unknown], draws: &[WeightedDraw]) -> Vec<Marginal> {
    let of = |unknown: &Unknown| {
        let after = match &unknown.prior {
            Prior::Choice(_) => shares(unknown, draws),
            Prior::Uniform(..) | Prior::LogUniform(..) => number(unknown, draws),
        };
        Marginal { unknown: unknown.clone(), after }
    };
    unknowns.iter().map(of).collect()
}

fn shares(unknown: &Unknown, draws: &[WeightedDraw]) -> After {
    let Prior::Choice(values) = &unknown.prior else { return After::Choice(Vec::new()) };
    let mut after: BTreeMap<&str, (f64, f64)> = BTreeMap::new();
    for d in draws {
        let sum = after.entry(d.draw.value(&unknown.path).unwrap_or_default()).or_default();
        *sum = (sum.0 + d.weight, sum.1 + 1.0 / draws.len() as f64);
    }
    let of = |value: &String| {
        let (weight, before) = after.get(value.as_str()).copied().unwrap_or_default();
        (value.clone(), weight, before)
    };
    After::Choice(values.iter().map(of).collect())
}

fn number(unknown: &Unknown, draws: &[WeightedDraw]) -> After {
    let mut all: Vec<(f64, f64)> = draws.iter().filter_map(|d| Some((unknown.number(d)?, d.weight))).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let quantile = |p: f64| {
        let mut sum = 0.0;
        let reached = all.iter().find(|(_, weight)| {
            sum += weight;
            sum >= p
        });
        reached.or(all.last()).map_or(f64::NAN, |(value, _)| *value)
    };
    After::Number(quantile(0.5), Interval { low: quantile(0.025), high: quantile(0.975) })
}

impl Unknown {
    /// A draw's value of it as a number: that of a choice without numbers is its place among the values.
    pub(super) fn number(&self, d: &WeightedDraw) -> Option<f64> {
        let value = d.draw.value(&self.path)?;
        value.parse().ok().or_else(|| match &self.prior {
            Prior::Choice(all) => all.iter().position(|v| v == value).map(|n| n as f64),
            _ => None,
        })
    }

    /// What it is called: the last part of its path.
    pub(super) fn name(&self) -> &str {
        self.path.rsplit('.').next().unwrap_or(&self.path)
    }
}
