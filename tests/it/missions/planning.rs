//! Planned paths against the geometry itself: parry's own test of a hull swept along every leg.

use nalgebra::{Vector2, Vector3};
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::query::distance;
use parry3d::shape::Capsule;
use robots::handoff::BeliefGrid;
use robots::plan::{AStar, AStarParams, FreeSpace, PathStart, Planner, Reach};
use std::path::Path;
use world::obstacles::{Base, BoxShape, CylinderShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use world::ranges::{Finite, HeadingDeg, Positive};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

/// Random worlds tried.
const WORLDS: u64 = 10_000;
/// Hull's radius, m.
const HULL_M: f64 = 0.6;

fn obstacles(rng: &mut Stream, size: [f64; 3], bed: &Terrain) -> Obstacles {
    let count = 1 + (rng.uniform() * 6.0) as usize;
    let solids = (0..count).map(|k| {
        let mut within = |from: f64, to: f64| from + (to - from) * rng.uniform();
        let shape = if within(0.0, 1.0) < 0.5 {
            let [x, y, z] = [within(1.0, 8.0), within(1.0, 8.0), within(0.2, 1.0) * size[2]];
            ShapeSpec::Box(BoxShape { size_m: (Positive::new(x), Positive::new(y), Positive::new(z)) })
        } else {
            ShapeSpec::Cylinder(CylinderShape {
                radius_m: Positive::new(within(0.3, 3.0)),
                height_m: Positive::new(within(0.2, 1.0) * size[2]),
            })
        };
        let spec = ObstacleSpec {
            surface: Default::default(),
            id: format!("o{k}"),
            shape,
            east_m: Finite::new(within(0.0, size[0])),
            north_m: Finite::new(within(0.0, size[1])),
            base: if within(0.0, 1.0) < 0.7 { Base::OnBed } else { Base::Z(Finite::new(within(-1.0, -0.3) * size[2])) },
            heading_deg: HeadingDeg::new(within(0.0, 360.0)),
        };
        Obstacle::build(&spec, bed, Path::new(".")).expect("a legal obstacle")
    });
    Obstacles(solids.collect())
}

/// Distance between the hull swept from `a` to `b` and the nearest solid, m, by parry; zero where they meet.
fn parry_distance(solids: &Obstacles, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    let to = |v: &Vector3<f64>| Vector::new(v.x, v.y, v.z);
    let swept = Capsule::new(to(a), to(b), HULL_M);
    solids
        .0
        .iter()
        .map(|o| {
            let q = o.pose.R_WB.coords;
            let pose = Pose::from_parts(to(&o.pose.p_WB), Rotation::from_xyzw(q.x, q.y, q.z, q.w));
            distance(&Pose::IDENTITY, &swept, &pose, &*o.shape).expect("parry knows both shapes").distance
        })
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn paths_are_free_for_the_inflated_hull_in_ten_thousand_random_worlds() {
    let mut rng = Stream::new(1, "planning", "worlds");
    let (mut planned, mut whole, mut legs) = (0, 0, 0);
    // One for all, so that nothing it keeps of one room may show in the next.
    let mut planner = AStar::new(&AStarParams::default()).expect("legal");
    for world in 0..WORLDS {
        // Nine in ten of the plane, the others of space.
        let n = if world % 10 == 0 { [14, 12, 7] } else { [52, 44, 1] };
        let cell_m = if world % 10 == 0 { [1.6, 1.4, 1.2] } else { [0.5, 0.6, 8.0] };
        let size = [0, 1, 2].map(|a| n[a] as f64 * cell_m[a]);
        let bed = Terrain::Level { depth_m: size[2] };
        let solids = obstacles(&mut rng, size, &bed);
        let lattice =
            BeliefGrid { corner: Vector3::new(0.0, 0.0, -size[2]), axes: [Vector2::x(), Vector2::y()], cell_m, n };
        let mut room = FreeSpace::new(lattice, HULL_M, 4.0);
        let level = -0.5 * size[2];
        room.chart(&solids, &bed, &|_, _| level);
        let mut place = || {
            let [x, y, z] = [rng.uniform(), rng.uniform(), rng.uniform()];
            let z = if n[2] == 1 { level } else { (z - 1.0) * size[2] };
            Vector3::new(x * size[0], y * size[1], z)
        };
        let (p_W, goal) = (place(), place());
        let heading = Heading::from_deg(360.0 * rng.uniform());
        let start = PathStart { p_W, heading, turning_radius_m: 0.0 };
        let Ok(path) = planner.plan(&room, &start, &goal) else {
            assert!((0..room.lattice().len()).all(|c| !room.free(c)), "world {world}");
            continue;
        };
        planned += 1;
        whole += usize::from(path.reach == Reach::Goal);
        // The first leg of a path out of a solid is not free, and the path says so, then only.
        assert_eq!(path.leaves_solid, !room.free(room.nearest_cell(&p_W)), "world {world}");
        let skip = usize::from(path.leaves_solid);
        for leg in path.points[skip..].windows(2) {
            legs += 1;
            let d = parry_distance(&solids, &leg[0], &leg[1]);
            assert!(d > 0.0, "world {world}: the hull meets a solid on {leg:?} of {path:?}");
        }
    }
    assert!(planned > 9_900 && whole > 6_000 && legs > 10_000, "{planned} planned, {whole} whole, {legs} legs");
}
