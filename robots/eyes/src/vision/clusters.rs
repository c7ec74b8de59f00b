//! Which colour patterns of a group belong together: those near the pattern that is nearest to the reference.
//!
//! *Source*: Tian et al. 2013, section 5, the two criteria for clustering (pivot distance, Floyd's shortest paths).
//!
//! *Parameters*: how much farther from the reference than the pivot, δ₁, `delta1`, 40; how far from the pivot along
//! the graph, δ₂, `delta2`, 45; levels.
//!
//! *Deviations*: the paper does not say how long its graph's edges are ("based on the distances between the CPs in
//! terms of the given reference color"). Ours joins all patterns that the first criterion leaves, either by the
//! distance of their colours (`edges: Colours`) or by the difference of their distances to the reference (`edges:
//! Reference`). Both obey the triangle inequality, so the shortest way is the straight one and Floyd's algorithm
//! finds nothing shorter. With the paper's numbers neither of them adds what it should to the first criterion. With
//! `Colours`, a later pattern differs from the pivot by 74 levels or more in some channel (otherwise it would have
//! been taken with the pivot), so that δ₂ = 45 drops every one. With `Reference`, the way is Δ₁ itself, which δ₁ = 40
//! has already limited.

use super::{Pattern, distance};
use robots::strategy::{ColourSpec, Edges};
use serde::Serialize;

/// Fate of a colour pattern.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// The pattern nearest to the reference.
    Pivot,
    /// Belongs to the pivot's group; its shortest way to the pivot, levels.
    Kept(f64),
    /// Farther from the reference than the pivot by this, which is more than δ₁; levels.
    OffReference(f64),
    /// This far from the pivot, which is more than δ₂; levels.
    OffPivot(f64),
}

impl Fate {
    /// Whether it stays in the group.
    pub fn kept(self) -> bool {
        matches!(self, Fate::Pivot | Fate::Kept(_))
    }
}

/// The fate of each pattern of a group with a common reference.
pub fn fates(patterns: &[Pattern], spec: &ColourSpec) -> Vec<Fate> {
    let order = |a: &usize, b: &usize| patterns[*a].distance.total_cmp(&patterns[*b].distance);
    // Of equal ones the first.
    let Some(pivot) = (0..patterns.len()).min_by(order) else {
        return Vec::new();
    };
    let beyond = |k: usize| patterns[k].distance - patterns[pivot].distance;
    let near: Vec<usize> = (0..patterns.len()).filter(|k| beyond(*k) <= spec.delta1.get()).collect();
    let edges = |i: usize, j: usize| {
        let (a, b) = (&patterns[near[i]], &patterns[near[j]]);
        Some(match spec.edges {
            Edges::Colours => distance(a.rgb, b.rgb),
            Edges::Reference => (a.distance - b.distance).abs(),
        })
    };
    let paths = shortest_paths(near.len(), edges);
    let at = |k: usize| near.iter().position(|n| *n == k);
    let from = at(pivot).expect("the pivot is not farther than itself");
    let fate = |k: usize| match at(k) {
        _ if k == pivot => Fate::Pivot,
        None => Fate::OffReference(beyond(k)),
        Some(i) if paths[from][i] > spec.delta2.get() => Fate::OffPivot(paths[from][i]),
        Some(i) => Fate::Kept(paths[from][i]),
    };
    (0..patterns.len()).map(fate).collect()
}

/// Lengths of the shortest ways between `n` nodes (Floyd 1962), infinite if there is none; edges may be missing.
pub fn shortest_paths(n: usize, edge: impl Fn(usize, usize) -> Option<f64>) -> Vec<Vec<f64>> {
    let mut d: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| if i == j { 0.0 } else { edge(i, j).unwrap_or(f64::INFINITY) }).collect())
        .collect();
    for over in 0..n {
        for i in 0..n {
            for j in 0..n {
                d[i][j] = d[i][j].min(d[i][over] + d[over][j]);
            }
        }
    }
    d
}

#[cfg(test)]
mod tests {
    use super::super::Reference;
    use super::*;
    use proptest::prelude::*;
    use world::ranges::NonNegative;

    fn pattern(rgb: [u8; 3]) -> Pattern {
        Pattern { rgb, distance: distance(rgb, Reference::Red.rgb()) }
    }

    #[test]
    fn by_hand() {
        let spec = ColourSpec::default();
        // 55, 85 and 105 from RED; the last but one 60 from the pivot; then one within both limits.
        let group = [[200, 0, 0], [255, 85, 0], [150, 0, 0], [180, 20, 20]].map(pattern);
        let got = fates(&group, &spec);
        assert_eq!(got[0], Fate::Pivot);
        assert_eq!(got[1], Fate::OffPivot(distance([200, 0, 0], [255, 85, 0])));
        assert_eq!(got[2], Fate::OffReference(50.0));
        assert_eq!(got[3], Fate::Kept((400.0_f64 + 400.0 + 400.0).sqrt()));
        let kept: Vec<bool> = got.iter().map(|f| f.kept()).collect();
        assert_eq!(kept, [true, false, false, true]);
    }

    /// A pattern at a limit stays ("greater than" drops): 40 farther from the reference, 45 from the pivot.
    #[test]
    fn limits_are_kept() {
        let spec = ColourSpec::default();
        let far = fates(&[pattern([200, 0, 0]), pattern([160, 0, 0])], &spec);
        assert_eq!(far[1], Fate::Kept(40.0));
        let wide = fates(&[pattern([200, 0, 0]), pattern([200, 27, 36])], &spec);
        assert_eq!(wide[1], Fate::Kept(45.0));
    }

    #[test]
    fn none_and_one() {
        let spec = ColourSpec::default();
        assert!(fates(&[], &spec).is_empty());
        assert_eq!(fates(&[pattern([0, 255, 255])], &spec), [Fate::Pivot]);
    }

    /// The paper's two patterns of Fig. 11: as printed 295 and 296 from RED and 60 apart; read as blue, green, red
    /// 152 and 207 from RED.
    #[test]
    fn the_papers_second_pattern_stays_by_one_reading_only() {
        let by = |edges: Edges, group: [[u8; 3]; 2]| {
            let spec = ColourSpec { edges, ..ColourSpec::default() };
            fates(&group.map(pattern), &spec)[1]
        };
        let printed = [[106, 106, 231], [156, 136, 243]];
        assert!(matches!(by(Edges::Colours, printed), Fate::OffPivot(d) if (d - 59.5).abs() < 0.1));
        assert!(matches!(by(Edges::Reference, printed), Fate::Kept(d) if (d - 0.9).abs() < 0.1));
        let turned = [[231, 106, 106], [243, 136, 156]];
        for edges in [Edges::Colours, Edges::Reference] {
            assert!(matches!(by(edges, turned), Fate::OffReference(d) if (d - 55.4).abs() < 0.1));
        }
    }

    /// By the difference of the distances to RED, two colours 74 apart stay together; three colours 20 apart each are
    /// dropped at the limit.
    #[test]
    fn edges_by_the_reference_are_differences_of_distances() {
        let spec = ColourSpec { edges: Edges::Reference, delta2: NonNegative::new(30.0), ..ColourSpec::default() };
        let group = [[215, 0, 0], [195, 0, 0], [255, 0, 60], [180, 0, 0]].map(pattern);
        let got = fates(&group, &spec);
        assert_eq!(got, [Fate::Pivot, Fate::Kept(20.0), Fate::Kept(20.0), Fate::OffPivot(35.0)]);
    }

    /// The shortest way, found by trying every way that visits no node twice.
    fn brute(d: &[Vec<Option<f64>>], at: usize, to: usize, seen: &mut Vec<bool>) -> f64 {
        if at == to {
            return 0.0;
        }
        seen[at] = true;
        let mut best = f64::INFINITY;
        for next in 0..d.len() {
            if let (false, Some(step)) = (seen[next], d[at][next]) {
                best = best.min(step + brute(d, next, to, seen));
            }
        }
        seen[at] = false;
        best
    }

    proptest! {
        #[test]
        fn floyd_finds_what_trying_all_ways_finds(
            edges in proptest::collection::vec(proptest::option::weighted(0.6, 0.1_f64..10.0), 25),
        ) {
            let d: Vec<Vec<Option<f64>>> = edges.chunks(5).map(<[_]>::to_vec).collect();
            let got = shortest_paths(5, |i, j| d[i][j]);
            for (i, row) in got.iter().enumerate() {
                for (j, way) in row.iter().enumerate() {
                    let want = brute(&d, i, j, &mut vec![false; 5]);
                    prop_assert!(*way == want || (way - want).abs() < 1e-12);
                }
            }
        }

        #[test]
        fn among_colours_the_straight_way_is_the_shortest(colours: [[u8; 3]; 4]) {
            let got = shortest_paths(4, |i, j| Some(distance(colours[i], colours[j])));
            for i in 0..4 {
                for j in 0..4 {
                    prop_assert!((got[i][j] - distance(colours[i], colours[j])).abs() < 1e-9);
                }
            }
        }
    }
}
