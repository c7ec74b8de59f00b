//! Blocked water: free of divergence, tangent to everything, conserving mass, and unchanged where there is no obstacle.

use super::BlockageSpec;
use crate::flow::tests::kit::{layer, meander, rough, two_layers, uniform, wave};
use crate::flow::{CurrentSpec, Water, WaterSpec};
use nalgebra::{Vector2, Vector3};
use std::path::Path;
use world::area::Area;
use world::fields::Flow;
use world::obstacles::{BoxShape, CylinderShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use world::ranges::{Finite, Fraction, HeadingDeg, NonNegative, Positive};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

pub(crate) fn area(length_m: f64, width_m: f64, axis_deg: f64) -> Area {
    Area { centre: Vector2::new(4.0, -7.0), length_m, width_m, axis: Heading::from_deg(axis_deg) }
}

pub(crate) fn spec(cell_m: f64, levels: u32, margin_m: f64) -> BlockageSpec {
    BlockageSpec {
        cell_m: Positive::new(cell_m),
        levels,
        stretch: Fraction::new(0.5),
        margin_m: NonNegative::new(margin_m),
        period_s: Positive::new(20.0),
    }
}

impl BlockageSpec {
    /// As this water, but with evenly spaced levels.
    pub(crate) fn evenly(self) -> Self {
        Self { stretch: Fraction::new(0.0), ..self }
    }
}

pub(crate) fn eastward(speed_m_s: f64, blockage: BlockageSpec) -> WaterSpec {
    WaterSpec { currents: vec![uniform(speed_m_s, 90.0)], blockage: Some(blockage), ..WaterSpec::default() }
}

pub(crate) fn block(size: [f64; 3]) -> ShapeSpec {
    let [x, y, z] = size.map(Positive::new);
    ShapeSpec::Box(BoxShape { size_m: (x, y, z) })
}

pub(crate) fn pile(radius_m: f64, height_m: f64) -> ShapeSpec {
    ShapeSpec::Cylinder(CylinderShape { radius_m: Positive::new(radius_m), height_m: Positive::new(height_m) })
}

pub(crate) fn solids(of: &[(ShapeSpec, f64, f64, f64)], bed: &Terrain) -> Obstacles {
    let built = of.iter().map(|(shape, east, north, heading)| {
        let spec = ObstacleSpec {
            surface: Default::default(),
            id: "o".into(),
            shape: shape.clone(),
            east_m: Finite::new(*east),
            north_m: Finite::new(*north),
            base: Default::default(),
            heading_deg: HeadingDeg::new(*heading),
        };
        Obstacle::build(&spec, bed, Path::new("")).unwrap()
    });
    Obstacles(built.collect())
}

/// Two layers with a wave, meander and log law over a slope, a turned block and a pile in it.
fn everything() -> Water {
    let area = area(60.0, 40.0, 20.0);
    let bed = Terrain::sloping_over(&area, Heading::from_deg(290.0), 4.0, 8.0);
    let solids = solids(&[(block([9.0, 5.0, 3.0]), 8.0, -4.0, 50.0), (pile(2.5, 12.0), -4.0, -16.0, 0.0)], &bed);
    let waves = vec![wave(0.3, 120.0, 600.0, 250.0, None)];
    let layers = two_layers([layer(0.22, 20.0, 1020.0), layer(0.12, 170.0, 1024.0)], 1.8, 0.8, waves);
    let water = WaterSpec {
        currents: vec![CurrentSpec::new(layers), meander(0.03, 0.02, 10.0)],
        bed: rough(0.001, 2.0),
        blockage: Some(spec(1.5, 13, 15.0)),
        ..WaterSpec::default()
    };
    water.build_round(&area, &bed, &solids, 3).unwrap()
}

/// The physical divergence, from differences at random points inside cells, at a moment between two solutions. What is
/// left is single precision, 6e-8 of û, ŵ over a cell: the flattest is a fortieth of the widest, so about 1e-5.
#[test]
fn divergence_is_zero_at_every_point() {
    let mut water = everything();
    water.advance(47.0);
    let blocked = water.blocked().unwrap();
    let cells = blocked.cells();
    assert!(blocked.solved().divergence <= 1e-7 && blocked.solved().steps < 40);
    let mut rng = Stream::new(1, "test", "points");
    let (mut worst, mut strain) = (0.0_f64, 0.0_f64);
    for _ in 0..3000 {
        let mut draw = |n: usize| {
            let whole = (rng.uniform() * n as f64).floor();
            whole + 0.1 + 0.8 * rng.uniform()
        };
        let p = cells.place(draw(cells.n[0]), draw(cells.n[1]));
        let level = draw(cells.n[2]);
        let k = level as usize;
        let s = cells.s[k] + (cells.s[k + 1] - cells.s[k]) * level.fract();
        let p = p.push(water.floor(p).z * (1.0 - s));
        let e = 1e-4;
        let slope = |d: usize| {
            let mut step = Vector3::zeros();
            step[d] = e;
            (water.velocity(&(p + step), 47.5)[d] - water.velocity(&(p - step), 47.5)[d]) / (2.0 * e)
        };
        let parts = [slope(0), slope(1), slope(2)];
        worst = worst.max(parts.iter().sum::<f64>().abs());
        strain = strain.max(parts[0].abs());
    }
    // In units of current divided by cell size: 0.25 m/s by 1.5 m.
    let unit = 0.25 / 1.5;
    assert!(worst / unit < 2e-5, "{}", worst / unit);
    assert!(strain / unit > 0.05, "a flow that bends: {}", strain / unit);
}

/// No flux through any face of a solid cell, bed or surface, and none at points on the walls of a block.
#[test]
fn nothing_passes_walls_bed_and_surface() {
    let water = everything();
    let blocked = water.blocked().unwrap();
    let cells = blocked.cells();
    assert!(blocked.solved().open_cells < cells.open.len());
    for n in 0..3 {
        for (d, values) in blocked.field(n).0.iter().enumerate() {
            let (mut shut, mut open) = (0, 0);
            cells.each_face(d, |f| {
                let v = values[cells.face(d, f)];
                if cells.passes(d, f) {
                    open += usize::from(v != 0.0);
                } else {
                    assert_eq!(v, 0.0, "field {n}, face {f:?} across {d}");
                    shut += 1;
                }
            });
            assert!(shut > 0 && open > 0);
        }
    }
    let bed = Terrain::Level { depth_m: 6.0 };
    let solids = solids(&[(block([8.0, 6.0, 6.0]), 4.0, -7.0, 90.0)], &bed);
    let water = eastward(0.3, spec(1.0, 4, 10.0)).build_round(&area(40.0, 30.0, 90.0), &bed, &solids, 1).unwrap();
    for k in 0..60 {
        let along = -2.95 + 5.9 * f64::from(k) / 59.0;
        for z in [-5.9, -3.0, -0.1] {
            let west = Vector3::new(-1e-9, -7.0 + along, z);
            assert!(water.velocity(&west, 0.0).x.abs() < 1e-8, "{west:?}");
            let north = Vector3::new(4.0 + along, -4.0 + 1e-9, z);
            let v = water.velocity(&north, 0.0);
            assert!(v.y.abs() < 1e-8 && v.x > 0.2, "{north:?} {v}");
            assert_eq!(water.velocity(&Vector3::new(4.0 + along, -7.0, z), 0.0), Vector3::zeros());
        }
    }
}

/// In the rates that carry filaments, each cell has as much inflow as outflow to machine precision, at a moment between
/// two solutions and over a sloping bed. Rates are f32 and at most a few cells per second.
#[test]
fn filaments_see_no_divergence() {
    let mut water = everything();
    water.advance(47.0);
    let mut rates = Vec::new();
    assert!(water.rates(47.5, &mut rates));
    let fastest = rates.iter().flatten().fold(0.0_f32, |a, r| a.max(r.abs()));
    for r in &rates {
        let sum = r[1] - r[0] + r[3] - r[2] + r[5] - r[4];
        assert!(sum.abs() < 1e-6 * fastest, "{r:?}: {sum} of {fastest}");
    }
    assert!(fastest > 0.05, "{fastest}");
}

/// Over a level bed without obstacles the currents stay as they are; solving changes only rounding.
#[test]
fn a_current_round_nothing_is_untouched() {
    let bed = Terrain::Level { depth_m: 6.0 };
    let mut water = eastward(0.3, spec(2.0, 11, 20.0));
    water.bed = rough(0.001, 2.0);
    let area = area(40.0, 30.0, 33.0);
    let free = water.build(&area, &bed, 1).unwrap();
    let round = water.build_round(&area, &bed, &Obstacles::default(), 1).unwrap();
    assert_eq!(round.blocked().unwrap().solved().steps, 0);
    let cells = round.blocked().unwrap().cells();
    for (i, j) in [(0, 0), (17, 3), (39, 34)] {
        for k in 0..cells.n[2] {
            let z = -6.0 * (1.0 - cells.middle(k));
            let p = cells.place(f64::from(i) + 0.5, f64::from(j) + 0.5).push(z);
            let (a, b) = (round.velocity(&p, 0.0), free.velocity(&p, 0.0));
            assert!((a - b).norm() < 1e-7, "{a} {b}");
        }
    }
    let far = Vector3::new(900.0, 0.0, -2.0);
    assert_eq!(round.velocity(&far, 0.0), free.velocity(&far, 0.0));
    assert_eq!(round.density(&far, 0.0), free.density(&far, 0.0));
}

#[test]
fn water_shut_in_stands_still() {
    let bed = Terrain::Level { depth_m: 6.0 };
    let walls = [(0.0, 10.0, 90.0), (0.0, -10.0, 90.0), (10.0, 0.0, 0.0), (-10.0, 0.0, 0.0)]
        .map(|(e, n, h)| (block([24.0, 3.0, 8.0]), 4.0 + e, n - 7.0, h));
    let solids = solids(&walls, &bed);
    let water = eastward(0.3, spec(1.0, 4, 10.0)).build_round(&area(40.0, 40.0, 90.0), &bed, &solids, 1).unwrap();
    assert_eq!(water.velocity(&Vector3::new(4.0, -7.0, -3.0), 0.0), Vector3::zeros());
    assert!(water.velocity(&Vector3::new(4.0, 8.0, -3.0), 0.0).x > 0.3);
}

#[test]
fn what_cannot_be_is_refused() {
    let bed = Terrain::Level { depth_m: 6.0 };
    let area = area(40.0, 30.0, 90.0);
    let none = Obstacles::default();
    let full = solids(&[(block([200.0, 200.0, 8.0]), 0.0, 0.0, 90.0)], &bed);
    let quick = BlockageSpec { period_s: Positive::new(0.5), ..spec(1.0, 4, 10.0) };
    for (spec, solids, said) in [
        (spec(1.0, 4, 10.0), &full, "water.blockage: no water that could flow is left"),
        (spec(0.01, 40, 10.0), &none, "water.blockage.cell_m: 0.01 m makes 6000 x 5000 x 39"),
        (spec(1.0, 1, 10.0), &none, "water.blockage.levels: must be from 2 to 201, got 1"),
        (quick, &none, "water.blockage.period_s: must be at least 2 s, got 0.5"),
    ] {
        let e = eastward(0.3, spec).build_round(&area, &bed, solids, 1).unwrap_err().to_string();
        assert!(e.starts_with(said), "{e}");
    }
}

#[test]
fn obstacles_between_the_cells_are_named() {
    let bed = Terrain::Level { depth_m: 6.0 };
    let some =
        [(pile(0.2, 5.0), 4.0, -7.0, 0.0), (block([9.0; 3]), 4.0, -7.0, 90.0), (block([6.0; 3]), 4.0, -7.0, 90.0)];
    let unfelt = spec(2.0, 4, 10.0).unfelt(&area(40.0, 30.0, 90.0), &bed, &solids(&some, &bed), false);
    assert_eq!(unfelt.unwrap(), [0]);
}
