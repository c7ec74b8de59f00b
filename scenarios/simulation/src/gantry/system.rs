//! The systems of gantries: probes and encoders, the searcher, the drives, score and frames.

use super::Gantries;
use crate::control::QuestionContent;
use crate::control::exchanges::{ExchangeState, ReadingsSince};
use crate::frame::GantryFrame;
use crate::ocean::Ocean;
use crate::outbox::Outbox;
use crate::score::Score;
use crate::searchers::{SearcherId, must_be_sound, whole};
use bevy_ecs::prelude::{Component, Query, Res, ResMut};
use nalgebra::Vector3;
use robots::handoff::{Bounds, Declaration, GantryDecision, GantryObservation, GantryReadings, Outcome, ProbeScan};
use robots::sense::Probes;
use robots::track::GantryStrategy;
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

/// A gantry's searcher with the random stream it holds.
#[derive(Component)]
pub(crate) struct Searcher {
    /// What decides.
    pub strategy: Box<dyn GantryStrategy>,
    /// Its name in scenarios.
    pub name: &'static str,
    /// Within what its numbers must lie.
    pub bounds: Bounds,
    /// Its random numbers.
    pub rng: Stream,
    /// When it stopped, s.
    pub stopped_s: Option<f64>,
}

pub(crate) fn read_probes(
    clock: Res<Clock>,
    physics: Res<Physics>,
    ocean: Res<Ocean>,
    mut gantries: Query<(&Rig, &mut Head, &mut GantryReadings)>,
) {
    let plume = ocean.dye(clock.t_s());
    for (rig, mut head, mut readings) in &mut gantries {
        let joints = physics.joints(rig.joints);
        let head = &mut *head;
        head.tips_W.clear();
        head.tips_W.extend(rig.gantry.tips_W(&rig.base, &joints));
        let scan = head.probes.read(&clock, &head.tips_W, &plume);
        head.latest = scan.or(head.latest);
        *readings = GantryReadings { scan, joints: rig.gantry.readings(&joints) };
    }
}

/// Asks the searchers outside this program; the answers come between this stage and the next.
pub(crate) fn ask(
    clock: Res<Clock>,
    mut gantries: Query<(&SearcherId, &GantryReadings, &GantryDecision, &mut ExchangeState)>,
) {
    for (id, readings, decision, mut consulting) in &mut gantries {
        if let ReadingsSince::Gantry(gathered) = &mut consulting.kept {
            gathered.scans.extend(readings.scan);
        }
        if decision.stopped.is_none() && consulting.due(&clock) {
            let seen = GantryObservation { t_s: clock.t_s(), readings: *readings, told: None };
            consulting.ask(&clock, &id.name, |kept| QuestionContent::Gantry(seen, kept.take_gantry()));
        }
    }
}

type Tracking<'a> =
    (&'a SearcherId, &'a GantryReadings, &'a mut Searcher, &'a mut GantryDecision, Option<&'a mut ExchangeState>);

pub(crate) fn track(clock: Res<Clock>, mut gantries: Query<Tracking>) {
    for (id, readings, mut searcher, mut decision, consulting) in &mut gantries {
        let seen = GantryObservation {
            t_s: clock.t_s(),
            readings: *readings,
            told: consulting.and_then(|mut c| c.take_told()),
        };
        let searcher = &mut *searcher;
        *decision = searcher.strategy.step(&seen, &mut searcher.rng);
        let fault = decision.fault(searcher.bounds);
        let decides = ["tracker", searcher.name];
        must_be_sound(fault, ["gantry", &id.name], decides, seen.t_s);
        if decision.stopped.is_some() {
            searcher.stopped_s.get_or_insert(seen.t_s);
        }
    }
}

pub(crate) fn drive_gantries(
    clock: Res<Clock>,
    mut physics: ResMut<Physics>,
    mut gantries: Query<(&GantryDecision, &mut Rig)>,
) {
    for (decision, mut rig) in &mut gantries {
        let rig = &mut *rig;
        let joints = physics.joints(rig.joints);
        let drives = (rig.gantry).drive(decision, &joints, clock.dt_s, &mut rig.rng);
        physics.drive(rig.joints, drives);
    }
}

pub(crate) fn digest_gantries(
    physics: Res<Physics>,
    roster: Res<Gantries>,
    mut digest: ResMut<Digest>,
    gantries: Query<(&Rig, &Head, &GantryDecision)>,
) {
    for (rig, head, decision) in gantries.iter_many(&roster.0).map(whole) {
        for joint in physics.joints(rig.joints) {
            digest.f64s(&[joint.position_m, joint.speed_m_s]);
        }
        if let Some(scan) = head.latest {
            digest.f64s(&scan.volts[..scan.count]);
        }
        digest.f64s(decision.target_m.as_slice());
        digest.f64s(&[f64::from(decision.id), f64::from(decision.behaviour as u8)]);
    }
}

type FrameParts<'a> = (&'a SearcherId, &'a Rig, &'a Head, &'a GantryReadings, &'a GantryDecision);

pub(crate) fn picture(
    physics: Res<Physics>,
    roster: Res<Gantries>,
    score: Res<Score>,
    mut outbox: ResMut<Outbox>,
    gantries: Query<FrameParts>,
) {
    let Some(frame) = &mut outbox.open else {
        return;
    };
    for (id, rig, head, readings, decision) in gantries.iter_many(&roster.0).map(whole) {
        let joints = physics.joints(rig.joints);
        let base = &rig.base;
        let touching = physics.gantry_contact(rig.joints).with;
        let declarations = &score.searchers[id.place].declarations;
        frame.gantries.push(GantryFrame {
            id: id.name.clone(),
            joint_names: rig.gantry.joint_names().map(str::to_string),
            joints,
            readings: readings.joints,
            forward: (base.R_WB * Vector3::x()).xy(),
            head_W: rig.gantry.head_W(base, &joints),
            tips_W: rig.gantry.tips_W(base, &joints).collect(),
            scan: head.latest,
            decision: decision.clone(),
            touching: touching.map(|solid| physics.name(solid).to_string()),
            declaration: declarations.first().copied(),
        });
    }
}

type ScoreParts<'a> = (&'a SearcherId, &'a Rig, &'a GantryReadings, &'a GantryDecision, &'a Searcher);

pub(crate) fn keep_score(
    clock: Res<Clock>,
    roster: Res<Gantries>,
    physics: Res<Physics>,
    mut score: ResMut<Score>,
    gantries: Query<ScoreParts>,
) {
    for (id, rig, readings, decision, searcher) in gantries.iter_many(&roster.0).map(whole) {
        let ended = decision.stopped.map(|_| Outcome::Completed);
        score.outcome(id.place, ended);
        let own = &mut score.searchers[id.place];
        let head_W = rig.gantry.head_W(&rig.base, &physics.joints(rig.joints));
        own.moved(&head_W);
        let spikes = &decision.working.spike;
        if readings.scan.is_some() && spikes.contains(&true) {
            own.detected(clock.t_next_s(), head_W.xy());
        }
        // It declares once: where its head is when it stops.
        if own.declarations.is_empty()
            && let Some(declaration) = declaration(&physics, rig, decision, searcher)
        {
            own.declared(declaration);
        }
    }
}

/// Where the searcher says the source is, once it has stopped there: the place of the head according to its encoders.
fn declaration(physics: &Physics, rig: &Rig, decision: &GantryDecision, searcher: &Searcher) -> Option<Declaration> {
    let t_s = searcher.stopped_s.filter(|_| decision.stopped == Some(true))?;
    let joints = physics.joints(rig.joints);
    let head = rig.gantry.head_W(&rig.base, &joints).xy();
    let off = rig.gantry.readings(&joints).position_m - rig.gantry.head_m(&joints);
    Some(Declaration::first(t_s, head + (rig.base.R_WB * off.push(0.0)).xy(), "stop"))
}
