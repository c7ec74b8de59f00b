//! Looks out for what goes wrong, at the end of a tick.

use super::{Abnormality, Abnormals, Lookout, OUTSIDE_M};
use crate::system::{Hull, RobotId};
use bevy_ecs::prelude::{Query, Res, ResMut};
use robots::handoff::Readings;
use world::area::Area;
use world::clock::Clock;
use world::frames::Truth;
use world::physics::Physics;

pub(crate) fn watch(
    clock: Res<Clock>,
    area: Res<Area>,
    physics: Res<Physics>,
    mut abnormals: ResMut<Abnormals>,
    mut robots: Query<(&RobotId, &Truth, &Readings, &Hull, &mut Lookout)>,
) {
    let events = &mut abnormals.0;
    for (id, truth, readings, hull, mut lookout) in &mut robots {
        let p = truth.pose.p_WB;
        let outside_m = -area.edge_distance(p.xy()).0;
        let deaf = |valid: Option<bool>| valid.map(|valid| !valid);
        for (what, wrong) in [
            (Abnormality::LeftArea, Some(outside_m > OUTSIDE_M)),
            (
                Abnormality::NoBottomLock,
                deaf(readings.dvl.map(|r| r.valid)),
            ),
            (
                Abnormality::NoAltitude,
                deaf(readings.altimeter.map(|r| r.valid)),
            ),
            (Abnormality::NoFlow, deaf(readings.adcp.map(|r| r.valid))),
            (
                Abnormality::Touched,
                Some(physics.contacts(hull.body).touching),
            ),
        ] {
            lookout.see(what, wrong, &id.0, clock.t_s(), p, events);
        }
    }
}
