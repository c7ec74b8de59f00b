//! What is known of each unknown alone.

use super::JudgedDraw;
use super::draws::Unknown;
use crate::campaign::stats::{Interval, finite_sorted, quantile};
use crate::distribution::Distribution as Prior;

/// An unknown, before and after.
#[derive(Clone, Debug)]
pub struct Marginal {
    /// The unknown.
    pub unknown: Unknown,
    /// After.
    pub after: After,
}

/// What the accepted draws say of an unknown.
#[derive(Clone, Debug)]
pub enum After {
    /// Median of a number, and where 95 % of them lie.
    Number(f64, Interval),
    /// Share of them by value.
    Choice(Vec<(String, f64)>),
}

/// Those of all unknowns.
pub(super) fn marginals(unknowns: &[Unknown], draws: &[JudgedDraw]) -> Vec<Marginal> {
    let of = |unknown: &Unknown| {
        let after = match &unknown.prior {
            Prior::Choice(_) => shares(unknown, draws),
            Prior::Uniform(..) | Prior::LogUniform(..) => number(unknown, draws),
        };
        Marginal { unknown: unknown.clone(), after }
    };
    unknowns.iter().map(of).collect()
}

fn shares(unknown: &Unknown, draws: &[JudgedDraw]) -> After {
    let Prior::Choice(values) = &unknown.prior else { return After::Choice(Vec::new()) };
    let share = |value: &String| {
        let with = draws.iter().filter(|d| d.draw.value(&unknown.path) == Some(value)).count();
        (value.clone(), with as f64 / draws.len().max(1) as f64)
    };
    After::Choice(values.iter().map(share).collect())
}

fn number(unknown: &Unknown, draws: &[JudgedDraw]) -> After {
    let sorted = finite_sorted(draws.iter().filter_map(|d| unknown.number(d)));
    let at = |p: f64| quantile(&sorted, p).unwrap_or(f64::NAN);
    After::Number(at(0.5), Interval { low: at(0.025), high: at(0.975) })
}

impl Unknown {
    /// A draw's value of it as a number: that of a choice without numbers is its place among the values.
    pub(super) fn number(&self, d: &JudgedDraw) -> Option<f64> {
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
