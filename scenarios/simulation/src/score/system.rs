//! Keeps the score.

use super::Score;
use crate::gantry::system::{Declaring, declaration};
use crate::system::{Roster, whole};
use bevy_ecs::prelude::{Query, Res, ResMut};
use robots::handoff::Decision;
use world::frames::Truth;
use world::physics::Physics;

pub(crate) fn keep_score(
    roster: Res<Roster>,
    physics: Res<Physics>,
    mut score: ResMut<Score>,
    robots: Query<(&Truth, &Decision)>,
    gantries: Query<Declaring>,
) {
    for (n, (truth, decision)) in robots.iter_many(&roster.robots).map(whole).enumerate() {
        score.at(n, &truth.pose.p_WB);
        score.declared(n, decision.declared);
    }
    for (k, parts) in gantries.iter_many(&roster.gantries).map(whole).enumerate() {
        let n = roster.robots.len() + k;
        // It declares once: where its head is when it stops.
        if score.searchers[n].declarations.is_empty() {
            score.declared(n, declaration(&physics, parts));
        }
    }
}
