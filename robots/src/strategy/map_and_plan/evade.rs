//! Keeps the vehicle away from solids that its path passes too closely, and frees it from one that it ran into.
//!
//! *Source*: dynamic window, Fox, Burgard & Thrun 1997, IEEE Robot. Autom. Mag. 4, 23: of the motions that the
//! vehicle can make, those that end in a collision are excluded, and of the others the one nearest to the wish is
//! taken.
//!
//! *Parameters*: turning radius, m, or the vehicle's own if that is greater; distance looked ahead, m; time for which it backs off, s, and propeller speed,
//! rpm.
//!
//! *Deviations*: the motions are turns on the turning circle to a course, then straight on; speed is not chosen. A
//! vehicle that does not move although it should backs off: propeller astern, rudder amidships.

use crate::handoff::{Capabilities, Manoeuvre, Observation};
use crate::plan::FreeSpace;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{NonNegative, Positive};
use world::units::Heading;

/// Courses are tried in steps of this, on both sides of the wanted one, rad.
const STEP_RAD: f64 = std::f64::consts::PI / 12.0;
/// A vehicle slower than this over ground, m/s, for this long, s, is held by something.
const HELD: (f64, f64) = (0.25, 3.0);

/// Parameters.
#[derive(Clone, Copy, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EvadeSpec {
    /// Turning radius, m; the vehicle's own if that is greater.
    #[serde(with = "world::limits::turn_m")]
    #[default(Positive::new(12.0))]
    pub turn_radius_m: Positive,
    /// Distance looked ahead, m.
    #[serde(with = "world::limits::look_m")]
    #[default(Positive::new(20.0))]
    pub look_m: Positive,
    /// How long it backs off when it is held, s.
    #[default(NonNegative::new(10.0))]
    pub back_s: NonNegative,
    /// Propeller speed while backing off, astern, rpm.
    #[serde(with = "world::limits::rpm_limit")]
    #[default(Positive::new(1000.0))]
    pub back_rpm: Positive,
}

/// The ways that are tried: turns of this radius, m, and how far they are looked along, m.
#[derive(Clone, Copy, Debug)]
struct Ways {
    radius_m: f64,
    look_m: f64,
}

/// State.
#[derive(Clone, Debug)]
pub(super) struct Evade {
    spec: EvadeSpec,
    hull_m: f64,
    slow_since_s: Option<f64>,
    back_until_s: f64,
}

impl Evade {
    pub(super) fn new(spec: EvadeSpec, hull_m: f64) -> Self {
        Self { spec, hull_m, slow_since_s: None, back_until_s: f64::NEG_INFINITY }
    }

    /// Turning radius of a vehicle, m.
    pub(super) fn turn_radius_m(&self, able: &Capabilities) -> f64 {
        self.spec.turn_radius_m.get().max(able.turning_radius_m)
    }

    /// The course nearest to `wish` that is free as far as it looks, from `at` (ENU, m) moving along `heading`, with
    /// turns of `radius_m`; if none is free, the one that is free for longest.
    pub(super) fn course(
        &self,
        room: &FreeSpace,
        at: &Vector3<f64>,
        heading: Heading,
        wish: Heading,
        radius_m: f64,
    ) -> Heading {
        let look_m = self.look_m(room, radius_m);
        let ways = Ways { radius_m, look_m };
        let mut best = (0.0, wish);
        for k in 0..=12 {
            for side in [1.0, -1.0] {
                let course = wish.turned(side * f64::from(k) * STEP_RAD);
                let far_m = self.free_m(room, at, heading, course, ways);
                if far_m >= look_m {
                    return course;
                }
                if far_m > best.0 {
                    best = (far_m, course);
                }
            }
        }
        best.1
    }

    /// How far it looks, m: no farther than the vehicle needs to turn round and leave the room.
    fn look_m(&self, room: &FreeSpace, radius_m: f64) -> f64 {
        let g = room.lattice();
        let across_m: f64 = (0..2).map(|a| g.n[a] as f64 * g.cell_m[a]).sum();
        let round_m = std::f64::consts::PI * radius_m;
        self.spec.look_m.get().min(across_m + round_m)
    }

    /// How far the vehicle gets, turning to a course and then going straight on, m; at most as far as it looks.
    fn free_m(
        &self,
        room: &FreeSpace,
        at: &Vector3<f64>,
        heading: Heading,
        course: Heading,
        Ways { radius_m, look_m }: Ways,
    ) -> f64 {
        let clear_m = |p: &Vector3<f64>| room.clearance_m(room.nearest_cell(p));
        // Where it is already too near, it may come no nearer.
        let least_m = self.hull_m.min(clear_m(at));
        let step_m = 0.5 * room.narrowest_m();
        let most = step_m / radius_m;
        let (mut p, mut now, mut far_m) = (*at, heading, 0.0);
        while far_m < look_m {
            let turn = now.turn_to(course).clamp(-most, most);
            now = now.turned(turn);
            let d = now.unit() * step_m;
            p += Vector3::new(d.x, d.y, 0.0);
            if clear_m(&p) < least_m {
                break;
            }
            far_m += step_m;
        }
        far_m
    }

    /// Backs off if the vehicle is held.
    pub(super) fn back(&mut self, seen: &Observation) -> Option<Manoeuvre> {
        let (slowest_m_s, for_s) = HELD;
        let t_s = seen.t_s;
        if t_s >= self.back_until_s {
            let moves = seen.estimate.v_ground().norm() >= slowest_m_s;
            let since_s = *self.slow_since_s.get_or_insert(t_s);
            if moves {
                self.slow_since_s = None;
            } else if t_s - since_s >= for_s {
                self.slow_since_s = None;
                self.back_until_s = t_s + self.spec.back_s.get();
            }
        }
        (t_s < self.back_until_s).then(|| Manoeuvre::Direct {
            rudder_rad: 0.0,
            stern_rad: 0.0,
            rpm: -self.spec.back_rpm.get(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;
    use crate::plan::testing::{block, room};
    use nalgebra::Vector2;

    fn evade() -> Evade {
        Evade::new(EvadeSpec::default(), 0.8)
    }

    fn at(x: f64, y: f64) -> Vector3<f64> {
        Vector3::new(x, y, -4.0)
    }

    #[test]
    fn a_free_course_is_kept_and_a_pile_ahead_is_passed_clear() {
        let north = Heading::from_deg(0.0);
        let open = room([80, 80, 1], [1.0; 3], vec![]);
        let straight = evade().course(&open, &at(40.0, 10.0), north, north, 12.0);
        assert_eq!(straight, north);
        let pile = vec![block("p", 40.5, 40.0, [3.0, 3.0, 8.0])];
        let r = room([80, 80, 1], [1.0; 3], pile);
        let (mut p, mut h, mut nearest) = (at(40.0, 15.0), north, f64::INFINITY);
        // A vehicle that turns no tighter than its circle, and wants to go straight on.
        for _ in 0..400 {
            let course = evade().course(&r, &p, h, north, 12.0);
            let most = 0.1 / 12.0;
            h = h.turned(h.turn_to(course).clamp(-most, most));
            let d = h.unit() * 0.1;
            p += Vector3::new(d.x, d.y, 0.0);
            nearest = f64::min(nearest, r.clearance_m(r.nearest_cell(&p)));
        }
        // No nearer than the hull, except for half a cell, the distance of the vehicle from its cell's middle.
        assert!(nearest >= 0.8 - r.half_diagonal_m() && p.y > 48.0, "{nearest} {p}");
    }

    #[test]
    fn before_a_wall_it_turns_to_the_side_where_there_is_room() {
        let north = Heading::from_deg(0.0);
        // A corner: a wall ahead and another one on the left.
        let walls = vec![block("n", 40.0, 60.0, [80.0, 4.0, 8.0]), block("w", 30.0, 40.0, [4.0, 40.0, 8.0])];
        let r = room([80, 80, 1], [1.0; 3], walls);
        let wish = Heading::from_deg(-10.0);
        let course = evade().course(&r, &at(38.0, 42.0), north, wish, 12.0);
        assert!((60.0..180.0).contains(&course.deg()), "{course:?}");
    }

    /// A hull that turns wider than the setting begins its turn earlier, and the setting is the least.
    #[test]
    fn a_vehicle_that_turns_wider_turns_away_earlier() {
        let north = Heading::from_deg(0.0);
        let wall = vec![block("n", 40.0, 62.0, [80.0, 4.0, 8.0])];
        let r = room([80, 80, 1], [1.0; 3], wall);
        let spec = EvadeSpec { look_m: Positive::new(60.0), ..EvadeSpec::default() };
        let evade = Evade::new(spec, 0.8);
        let able = |turning_radius_m| Capabilities { turning_radius_m, ..Capabilities::default() };
        let radii = [4.0, 12.0, 30.0].map(|m| evade.turn_radius_m(&able(m)));
        assert_eq!(radii, [12.0, 12.0, 30.0]);
        let turned = |y: f64, radius_m: f64| {
            let course = evade.course(&r, &at(40.0, y), north, Heading::from_deg(60.0), radius_m);
            north.turn_to(course).abs().to_degrees()
        };
        // The wall begins at 60. A turn of 12 m to 60 degrees and the rest of 60 m end at 54, those of 30 m at 60.3.
        let (tight, wide) = (turned(20.0, 12.0), turned(20.0, 30.0));
        assert!(tight < wide, "{tight} {wide}");
    }

    #[test]
    fn held_fast_it_backs_off_for_a_while() {
        let mut e = evade();
        let still = |t: f64| {
            let mut o = seen(t, Vector2::zeros(), 0.0, None);
            o.estimate.v_ground_body *= 0.0;
            o
        };
        let moving = |t: f64| {
            let mut o = still(t);
            o.estimate.v_ground_body.x = 1.5;
            o
        };
        assert!(moving(0.0).estimate.v_ground().norm() > 1.0);
        for k in 0..100 {
            assert!(e.back(&moving(f64::from(k) * 0.1)).is_none());
        }
        let backs: Vec<f64> = (0..300)
            .map(|k| 10.0 + f64::from(k) * 0.1)
            .filter(|t| {
                let o = if *t < 16.0 { still(*t) } else { moving(*t) };
                e.back(&o).is_some()
            })
            .collect();
        // Three seconds at rest, ten astern.
        let (first, last) = (backs[0], backs[backs.len() - 1]);
        assert!((first - 13.0).abs() < 0.15 && (last - 23.0).abs() < 0.15, "{first} {last}");
    }
}
