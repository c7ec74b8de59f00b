//! The index compared with a search through all filaments.

use super::index::Index;
use super::kernel::Path;
use super::leaf::{LEAF, Leaf};
use super::lookup::Lookup;
use super::room::Room;
use super::size::Size;
use super::store::Store;
use crate::flow::grid::{FlowGrid, GridShape};
use crate::release::ReleaseSpec;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

/// Nothing but bed and surface.
fn open_water() -> (Room, Lookup) {
    let area = Area {
        centre: Vector2::zeros(),
        length_m: 400.0,
        width_m: 400.0,
        axis: Heading::from_deg(90.0),
    };
    let bed = Terrain::Level { depth_m: 6.0 };
    let grid = FlowGrid::new(&area, &bed, GridShape::default());
    (Room::new(&grid), Lookup::new(&grid))
}

/// A cloud of filaments of all ages in 6 m of water.
fn cloud(n: usize) -> Store {
    let mut s = Store::new(Size::new(&ReleaseSpec::default()), 1e-6);
    let mut r = Stream::new(5, "test", "cloud");
    for k in 0..n {
        let age = (n - k) as f64 * 0.2;
        let p = [0.1 * age, 0.2 * age.sqrt() * r.normal(), -6.0 * r.uniform()];
        s.push(p.map(|v| v as f32), -6.0, -age);
    }
    s
}

#[test]
fn index_finds_all_that_a_full_search_finds() {
    let (room, cells) = open_water();
    let s = cloud(5000);
    let stores = [s];
    let index = Index::new(&stores, 0.0, 0.0);
    let mut all = Vec::new();
    for chunk in 0..stores[0].len().div_ceil(LEAF) {
        let mut leaf = Leaf::new();
        let s = &stores[0];
        for i in chunk * LEAF..((chunk + 1) * LEAF).min(s.len()) {
            let sh = s.size.horizontal(-s.born_s[i]);
            let sizes = [sh, s.size.vertical(sh, s.bed[i])];
            leaf.push([s.x[i], s.y[i], s.z[i]], s.bed[i], sizes, s.filament_kg);
        }
        all.push(leaf);
    }
    let mut r = Stream::new(6, "test", "probe");
    let mut hits = 0;
    for _ in 0..2000 {
        let p = Vector3::new(
            110.0 * r.uniform(),
            10.0 * r.uniform() - 5.0,
            -6.0 * r.uniform(),
        );
        let got = index.at(&stores, &room, &cells, Path::detect(), &p);
        let q = [p.x as f32, p.y as f32, p.z as f32];
        let want: f64 = all.iter().map(|l| f64::from(l.at(Path::Portable, q))).sum();
        assert!((got - want).abs() <= 1e-5 * want, "{got} {want}");
        hits += usize::from(want > 0.0);
    }
    assert!(hits > 500, "{hits}");
}

#[test]
fn answers_do_not_depend_on_what_was_asked_before() {
    let (room, cells) = open_water();
    let stores = [cloud(5000)];
    let asked = Index::new(&stores, 0.0, 0.0);
    let mut r = Stream::new(7, "test", "probe");
    let mut hits = 0;
    for _ in 0..300 {
        let p = Vector3::new(110.0 * r.uniform(), 2.0 * r.normal(), -6.0 * r.uniform());
        let fresh = Index::new(&stores, 0.0, 0.0).at(&stores, &room, &cells, Path::Portable, &p);
        let again = asked.at(&stores, &room, &cells, Path::detect(), &p);
        assert_eq!(again.to_bits(), fresh.to_bits());
        hits += usize::from(fresh > 0.0);
    }
    assert!(hits > 100, "{hits}");
}

#[test]
fn nothing_is_felt_above_the_surface() {
    let (room, cells) = open_water();
    let stores = [cloud(1000)];
    let index = Index::new(&stores, 0.0, 0.0);
    let at = |z: f64| {
        index.at(
            &stores,
            &room,
            &cells,
            Path::detect(),
            &Vector3::new(15.0, 0.0, z),
        )
    };
    assert!(at(-1e-6) > 0.0 && at(1e-6) == 0.0);
}
