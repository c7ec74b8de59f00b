//! Tests of the search.

use super::*;
use crate::handoff::testing::fixed;
use crate::plan::ends::Ends;
use crate::plan::testing::{block, room, speckled};
use nalgebra::Vector3;
use proptest::prelude::*;

const COSTS: Costs = Costs { climb: 3.0, weight: 2.0, soft_m: 4.0 };

/// The cells to which a free cell has a move, and what the move costs, written out: no corner cut.
fn steps(s: &Search, room: &FreeSpace, cell: usize) -> Vec<(usize, u32)> {
    let g = room.lattice();
    let at = g.place(cell).map(|v| v as i64);
    let mut out = Vec::new();
    for code in 0..27 {
        let to = [0, 1, 2].map(|a| at[a] + code / [1, 3, 9][a] % 3 - 1);
        if to == at || (0..3).any(|a| to[a] < 0 || to[a] >= g.n[a] as i64) {
            continue;
        }
        let open = (0..8).all(|corner| {
            let c = [0, 1, 2].map(|a| if corner >> a & 1 == 1 { to[a] } else { at[a] } as usize);
            room.free(g.index(c))
        });
        if open {
            let set = (0..3).filter(|a| to[*a] != at[*a]).map(|a| 1 << a).sum();
            let length = s.octile.length(set).ceil() as u32 + 1;
            let next = s.padded(room, g.index(to.map(|v| v as usize)));
            out.push((next, length + (length * u32::from(s.penalty[next])).div_ceil(PARTS)));
        }
    }
    out
}

/// Bellman-Ford with the same costs: relaxes until nothing changes, without queue and heuristic.
fn slow(room: &FreeSpace, costs: Costs, start: usize, goal: usize) -> Option<u32> {
    let mut s = Search::new(costs);
    s.take_in(room);
    let mut g = vec![FAR; s.penalty.len()];
    g[s.padded(room, start)] = 0;
    // There and back in turn: what is nearer is before or behind.
    let mut order: Vec<usize> = (0..room.lattice().len()).collect();
    loop {
        let mut changed = false;
        for &cell in &order {
            let at = s.padded(room, cell);
            if !room.free(cell) || g[at] == FAR {
                continue;
            }
            for (next, more) in steps(&s, room, cell) {
                if g[at] + more < g[next] {
                    g[next] = g[at] + more;
                    changed = true;
                }
            }
        }
        if !changed {
            break;
        }
        order.reverse();
    }
    let cost = g[s.padded(room, goal)];
    (cost != FAR).then_some(cost)
}

fn ends(room: &FreeSpace, a: [f64; 2], b: [f64; 2]) -> Option<(usize, usize)> {
    let g = room.lattice();
    let point = |[u, v]: [f64; 2]| {
        let (x, y) = (u * g.n[0] as f64 * g.cell_m[0], v * g.n[1] as f64 * g.cell_m[1]);
        Vector3::new(x, y, g.corner.z + u * g.n[2] as f64 * g.cell_m[2])
    };
    let e = Ends::default().resolve(room, |c| room.free(c), &point(a), &point(b)).ok()?;
    Some((e.start, e.goal))
}

proptest! {
    #![proptest_config(fixed(96))]

    #[test]
    fn costs_as_little_as_dijkstra_and_as_relaxing_until_nothing_changes(
        seed in 0_u64..1_000_000, share in 0.0..0.12, space in 0..3_u8,
        a in proptest::array::uniform2(0.0..1.0), b in proptest::array::uniform2(0.0..1.0),
        climb in 1.0..6.0, weight in 0.0..3.9,
    ) {
        let (n, cell) = match space {
            0 => ([30, 24, 1], [1.0, 1.0, 1.0]),
            1 => ([24, 16, 1], [2.5, 4.0, 1.0]),
            _ => ([12, 11, 7], [1.0, 1.6, 0.7]),
        };
        let r = speckled(n, cell, share / if space == 2 { 3.0 } else { 1.0 }, seed);
        let Some((s, t)) = ends(&r, a, b) else { return Ok(()); };
        let costs = Costs { climb, weight, soft_m: 2.0 };
        let mut search = Search::new(costs);
        let (way, cost) = search.run(&r, s, t, false).expect("joined");
        let opened = search.opened();
        let (_, blind) = search.run(&r, s, t, true).expect("joined");
        prop_assert_eq!(cost, blind);
        prop_assert!(opened <= search.opened());
        prop_assert_eq!(Some(cost), slow(&r, costs, s, t));
        prop_assert_eq!((way[0], way[way.len() - 1]), (s, t));
        // Moves only to neighbours, through free cells, without cutting corners: the line between the middles is
        // free.
        for w in way.windows(2) {
            let (p, q) = (r.lattice().place(w[0]), r.lattice().place(w[1]));
            prop_assert!((0..3).all(|k| p[k].abs_diff(q[k]) <= 1) && w[0] != w[1]);
            for corner in 0..8_usize {
                let at = [0, 1, 2].map(|k| if corner >> k & 1 == 1 { q[k] } else { p[k] });
                prop_assert!(r.free(r.lattice().index(at)));
            }
        }
    }

    /// |h(a) − h(b)| is at most the cost of the move from a to b, in free water.
    #[test]
    fn the_heuristic_is_consistent(
        x in proptest::array::uniform3(1.0..5.0), climb in 1.0..6.0,
        at in proptest::array::uniform3(1_usize..11), to in proptest::array::uniform3(0_usize..12),
    ) {
        let r = FreeSpace::new(crate::plan::testing::lattice([12, 12, 12], x), 0.0, 0.0);
        let mut s = Search::new(Costs { climb, ..COSTS });
        s.take_in(&r);
        let target = to.map(|v| v + 1);
        let here = r.lattice().index(at);
        let h = |cell| s.octile.between(s.place(cell), target);
        for (next, cost) in steps(&s, &r, here) {
            prop_assert!(h(s.padded(&r, here)) <= h(next) + cost);
        }
    }
}

#[test]
fn a_straight_way_costs_its_length() {
    let r = room([60, 60, 1], [1.0; 3], vec![]);
    let at = |i, j| r.lattice().index([i, j, 0]);
    let (way, cost) = Search::new(COSTS).run(&r, at(5, 5), at(45, 25), false).unwrap();
    assert_eq!(way.len(), 41);
    let length = 20.0 * 2f64.sqrt() + 20.0;
    assert!((f64::from(cost) / UNITS - length).abs() < 40.0 * 2.0 / UNITS);
}

#[test]
fn clearance_is_kept_where_there_is_room_for_it() {
    let r = room([60, 60, 1], [1.0; 3], vec![block("b", 30.0, 20.0, [10.0, 20.0, 8.0])]);
    let at = |i, j| r.lattice().index([i, j, 0]);
    let nearest = |weight| {
        let mut s = Search::new(Costs { weight, ..COSTS });
        let (way, _) = s.run(&r, at(10, 20), at(50, 20), false).unwrap();
        way.iter().map(|c| r.clearance_m(*c)).fold(f64::INFINITY, f64::min)
    };
    assert!(nearest(2.0) > nearest(0.0) + 0.9, "{} {}", nearest(2.0), nearest(0.0));
}
