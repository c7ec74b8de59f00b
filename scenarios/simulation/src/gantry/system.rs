//! The systems of gantries: probes and encoders, the drives, digest and score, frames.

use crate::control::{QuestionContent, ReadingsSince};
use crate::frame::GantryFrame;
use crate::machines::{Inputs, SearcherKind};
use crate::ocean::Ocean;
use crate::outbox::Outbox;
use crate::score::Score;
use crate::searchers::{OnboardTime, Roster, SearcherId, SearcherParts, whole};
use bevy_ecs::prelude::{Component, Query, Res, ResMut};
use nalgebra::Vector3;
use robots::handoff::{
    Behaviour, Decision, Declaration, GantryObservation, GantryReadings, HeadGoal, Outcome, ProbeScan, ReplyOutcome,
};
use robots::sense::Probes;
use robots::vehicles::Gantry;
use world::clock::Clock;
use world::digest::Digest;
use world::frames::Pose;
use world::physics::{GantryId, Physics};
use world::seeds::Stream;

/// A gantry and its joints in the physics.
#[derive(Component)]
pub(crate) struct Rig {
    /// Frame and drives.
    pub gantry: Gantry,
    /// Its joints.
    pub joints: GantryId,
    /// Where it stands.
    pub base: Pose,
    /// Random numbers of its drives.
    pub rng: Stream,
}

/// A gantry's probes.
#[derive(Component)]
pub(crate) struct Head {
    /// The probes.
    pub probes: Probes,
    /// Their latest scan.
    pub latest: Option<ProbeScan>,
    tips_W: Vec<Vector3<f64>>,
}

impl Head {
    /// Probes that have not been read.
    pub(crate) fn new(probes: Probes) -> Self {
        Self { probes, latest: None, tips_W: Vec::new() }
    }
}

pub(crate) fn read_probes(
    clock: Res<Clock>,
    physics: Res<Physics>,
    ocean: Res<Ocean>,
    mut gantries: Query<(&mut OnboardTime, &Rig, &mut Head, &mut GantryReadings)>,
) {
    let plume = ocean.dye(clock.t_s());
    for (mut now, rig, mut head, mut readings) in &mut gantries {
        now.0 = *clock;
        let joints = physics.joints(rig.joints);
        let head = &mut *head;
        head.tips_W.clear();
        head.tips_W.extend(rig.gantry.tips_W(&rig.base, &joints));
        let scan = head.probes.read(&clock, &head.tips_W, &plume);
        head.latest = scan.or(head.latest);
        *readings = GantryReadings { scan, joints: rig.gantry.readings(&joints) };
    }
}

impl SearcherKind for HeadGoal {
    type Inputs = (&'static OnboardTime, &'static GantryReadings);
    const WORDS: [&'static str; 2] = ["gantry", "tracker"];

    fn see((now, readings): &Inputs<Self>, told: Option<ReplyOutcome>) -> GantryObservation {
        GantryObservation { t_s: now.0.t_s(), readings: **readings, told }
    }

    fn gather(_: f64, (_, readings): &Inputs<Self>, gathered: &mut ReadingsSince) {
        gathered.scans.extend(readings.scan);
    }

    fn ask(seen: GantryObservation, gathered: ReadingsSince) -> QuestionContent {
        QuestionContent::Gantry(seen, Box::new(gathered))
    }
}

pub(crate) fn drive_gantries(
    clock: Res<Clock>,
    mut physics: ResMut<Physics>,
    mut gantries: Query<(&Decision<HeadGoal>, &mut Rig)>,
) {
    for (decision, mut rig) in &mut gantries {
        let rig = &mut *rig;
        let joints = physics.joints(rig.joints);
        let drives = (rig.gantry).drive(decision, &joints, clock.dt_s, &mut rig.rng);
        physics.drive(rig.joints, drives);
    }
}

/// A gantry at the end of a step. It holds the truth.
type GantryEnd<'a> =
    (&'a SearcherId, &'a Rig, &'a Head, &'a GantryReadings, &'a Decision<HeadGoal>, &'a SearcherParts<HeadGoal>);

/// Adds gantries to the digest and the score.
pub(crate) fn report(
    clock: Res<Clock>,
    (roster, physics): (Res<Roster>, Res<Physics>),
    (mut digest, mut score): (ResMut<Digest>, ResMut<Score>),
    gantries: Query<GantryEnd>,
) {
    for (id, rig, head, readings, decision, searcher) in gantries.iter_many(&roster.gantries).map(whole) {
        let joints = physics.joints(rig.joints);
        for joint in &joints {
            digest.f64s(&[joint.position_m, joint.speed_m_s]);
        }
        if let Some(scan) = head.latest {
            digest.f64s(&scan.volts[..scan.count]);
        }
        let Decision { behaviour, goal, outcome, .. } = decision;
        digest.f64s(goal.target_m.as_slice());
        digest.f64s(&[f64::from(goal.id), behaviour.number(&Behaviour::OF_GANTRY)]);
        score.outcome(id.place, outcome.map(|_| Outcome::Completed));
        let own = &mut score.searchers[id.place];
        let head_W = rig.gantry.head_W(&rig.base, &joints);
        own.moved(&head_W);
        if readings.scan.is_some() && searcher.strategy.shown().spike.contains(&true) {
            own.detected(clock.t_next_s(), head_W.xy());
        }
        // It declares once, the place of its head by the encoders: where it stops.
        if own.declarations.is_empty() && *outcome == Some(Outcome::Completed) {
            let off = rig.gantry.readings(&joints).position_m - rig.gantry.head_m(&joints);
            let position = head_W.xy() + (rig.base.R_WB * off.push(0.0)).xy();
            own.declared(Declaration::first(clock.t_s(), position, "stop"));
        }
    }
}

pub(crate) fn picture(
    physics: Res<Physics>,
    roster: Res<Roster>,
    score: Res<Score>,
    mut outbox: ResMut<Outbox>,
    gantries: Query<GantryEnd>,
) {
    let Some(frame) = &mut outbox.open else {
        return;
    };
    for (id, rig, head, readings, decision, searcher) in gantries.iter_many(&roster.gantries).map(whole) {
        let joints = physics.joints(rig.joints);
        let base = &rig.base;
        let touching = physics.gantry_contact(rig.joints).with;
        frame.gantries.push(GantryFrame {
            id: id.name.clone(),
            joint_names: rig.gantry.joint_names().map(str::to_string),
            joints,
            readings: readings.joints,
            forward: (base.R_WB * Vector3::x()).xy(),
            head_W: rig.gantry.head_W(base, &joints),
            tips_W: rig.gantry.tips_W(base, &joints).collect(),
            scan: head.latest,
            behaviour: decision.behaviour,
            goal: decision.goal,
            outcome: decision.outcome,
            shown: searcher.strategy.shown(),
            touching: touching.map(|solid| physics.name(solid).to_string()),
            declarations: score.searchers[id.place].declarations.clone(),
        });
    }
}
