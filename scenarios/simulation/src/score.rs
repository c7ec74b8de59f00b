//! What a run is judged by, kept up at every step: how near each robot came to a source, and what was declared. It hangs
//! on no frame and on nothing else that is written down.

use bevy_ecs::prelude::Resource;
use nalgebra::Vector3;
use robots::handoff::Declaration;

/// The score of all searchers.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct Score {
    /// Where the sources are (ENU), m.
    sources: Vec<Vector3<f64>>,
    /// Robots and then gantries, each in the scenario's order.
    pub searchers: Vec<SearcherScore>,
}

/// The score of one searcher.
#[derive(Clone, Debug, PartialEq)]
pub struct SearcherScore {
    /// Its id in the scenario.
    pub id: String,
    /// Least horizontal distance between the robot and a source so far, m; infinite for a gantry, and without sources.
    pub closest_m: f64,
    /// Its declarations so far, by number.
    pub declarations: Vec<Declaration>,
}

impl Score {
    /// Of searchers that have not set out.
    #[must_use]
    pub fn new(sources: Vec<Vector3<f64>>, ids: impl Iterator<Item = String>) -> Self {
        let searchers = ids.map(|id| SearcherScore {
            id,
            closest_m: f64::INFINITY,
            declarations: Vec::new(),
        });
        Self {
            sources,
            searchers: searchers.collect(),
        }
    }

    /// Least horizontal distance between any robot and a source so far, m.
    #[must_use]
    pub fn closest_m(&self) -> f64 {
        let all = self.searchers.iter().map(|s| s.closest_m);
        all.fold(f64::INFINITY, f64::min)
    }

    /// Searcher `n` is at a place (ENU, m).
    pub(crate) fn at(&mut self, n: usize, p_W: &Vector3<f64>) {
        let away = (self.sources.iter()).map(|s| (s - p_W).xy().norm_squared());
        let nearest_m = away.fold(f64::INFINITY, f64::min).sqrt();
        let closest_m = &mut self.searchers[n].closest_m;
        *closest_m = closest_m.min(nearest_m);
    }

    /// Searcher `n` declares.
    pub(crate) fn declared(&mut self, n: usize, declaration: Option<Declaration>) {
        if let Some(declaration) = declaration {
            declaration.join(&mut self.searchers[n].declarations);
        }
    }
}
