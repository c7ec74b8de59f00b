//! All scenes: rendered, examined with every method, and counted.

use super::draw::{SceneDraw, draw};
use super::methods::{METHODS, Method};
use super::pixels::Counts;
use super::render::{Shot, shoot};
use crate::campaign::{ThreadsError, pool};
use output::files::ReportError;
use rayon::prelude::*;
use robots::strategy::VerifierSpec;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};

/// The plan of a test.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenePlan {
    /// Seed of the scenes.
    pub seed: u64,
    /// Number of scenes.
    pub scenes: u64,
    /// Width and height of the pictures, px.
    pub size_px: [u32; 2],
    /// The verifier.
    pub verifier: VerifierSpec,
}

/// The result of one method for one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneRow {
    /// The scene.
    pub scene: SceneDraw,
    /// The method.
    pub method: Method,
    /// Its pixels of dye.
    pub dye: Counts,
    /// Its pixels of the source.
    pub source: Counts,
    /// The verifier's score.
    pub score: f64,
    /// Whether it verifies.
    pub verified: bool,
}

/// Why scenes cannot be scored.
#[derive(Debug, thiserror::Error)]
pub enum ScoreError {
    /// A scene cannot be built.
    #[error("scene {n}: {problem}")]
    Scene {
        /// Its number.
        n: u64,
        /// What is wrong.
        problem: String,
    },
    /// The threads cannot be started.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
    /// Results cannot be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// Ctrl-C or a termination signal.
    #[error("interrupted: nothing is written")]
    Interrupted,
}

/// Scores the scenes of a plan, `jobs` at a time (0: one for each core). The rows are in order and do not
/// depend on `jobs`. `done` gets every scene with its picture when it is finished.
///
/// # Errors
/// If threads cannot be started, if a scene cannot be built, or if `stop` is set.
pub fn score(
    plan: &ScenePlan,
    jobs: usize,
    stop: &AtomicBool,
    done: impl Fn(&SceneDraw, &Shot) + Sync,
) -> Result<Vec<SceneRow>, ScoreError> {
    let pool = pool(jobs)?;
    let one = |n: u64| {
        if stop.load(Ordering::Relaxed) {
            return Err(ScoreError::Interrupted);
        }
        let scene = draw(plan.seed, n);
        let shot = shoot(plan.seed, &scene, plan.size_px).map_err(|problem| ScoreError::Scene { n, problem })?;
        done(&scene, &shot);
        Ok(rows(&scene, &shot, &plan.verifier))
    };
    let all: Result<Vec<Vec<SceneRow>>, ScoreError> =
        pool.install(|| (0..plan.scenes).into_par_iter().map(one).collect());
    Ok(all?.concat())
}

fn rows(scene: &SceneDraw, shot: &Shot, spec: &VerifierSpec) -> Vec<SceneRow> {
    let row = |method: Method| {
        let (dye, body, seen) = method.look(&shot.picture, spec);
        SceneRow {
            scene: scene.clone(),
            method,
            dye: Counts::compare(&dye, &shot.dye),
            source: Counts::compare(&body, &shot.source),
            score: seen.score,
            verified: seen.verified,
        }
    };
    METHODS.map(row).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_do_not_depend_on_the_number_of_jobs() {
        let go = AtomicBool::new(false);
        let plan = ScenePlan { seed: 3, scenes: 4, size_px: [24, 18], verifier: VerifierSpec::default() };
        let of = |jobs| score(&plan, jobs, &go, |_, _| {}).unwrap();
        let one = of(1);
        assert_eq!(one.len(), 4 * METHODS.len());
        assert_eq!(one, of(2));
    }
}
