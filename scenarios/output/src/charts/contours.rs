//! Lines of equal value on a grid, and the regions above a value.
//!
//! *Source*: marching squares (Lorensen & Cline 1987 in two dimensions), saddles split by the mean
//! of their corners.
//! *Parameters*: the grid.
//! *Deviations*: none.

use std::collections::BTreeMap;

/// Values at the nodes of a regular grid.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Nodes along x and y.
    pub n: [usize; 2],
    /// First node.
    pub origin: [f64; 2],
    /// Distance between nodes.
    pub step: [f64; 2],
    /// Values row by row, x fastest.
    pub values: Vec<f64>,
}

/// An edge between two neighbouring nodes: node and direction (0 along x, 1 along y).
type Edge = (usize, usize, u8);

impl Grid {
    /// Evaluates a function over a rectangle.
    pub fn evaluate(x: [f64; 2], y: [f64; 2], n: [usize; 2], f: impl Fn(f64, f64) -> f64) -> Self {
        let step = [(x[1] - x[0]) / (n[0] - 1) as f64, (y[1] - y[0]) / (n[1] - 1) as f64];
        let mut values = Vec::with_capacity(n[0] * n[1]);
        for j in 0..n[1] {
            for i in 0..n[0] {
                values.push(f(x[0] + i as f64 * step[0], y[0] + j as f64 * step[1]));
            }
        }
        Self { n, origin: [x[0], y[0]], step, values }
    }

    fn value(&self, i: usize, j: usize) -> f64 {
        self.values[j * self.n[0] + i]
    }

    /// The grid with a rim of nodes at the same edge, with a value below all levels, so that regions close there.
    fn rimmed(&self, low: f64) -> (Vec<f64>, [usize; 2]) {
        let n = [self.n[0] + 2, self.n[1] + 2];
        let mut v = vec![low; n[0] * n[1]];
        for j in 0..self.n[1] {
            for i in 0..self.n[0] {
                v[(j + 1) * n[0] + i + 1] = self.value(i, j);
            }
        }
        (v, n)
    }

    /// Lines where the value is `level`.
    pub fn lines(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        let place = |i: f64, j: f64| [self.origin[0] + i * self.step[0], self.origin[1] + j * self.step[1]];
        trace(&self.values, self.n, level, place)
    }

    /// Rings round the regions at or above `level`.
    pub fn rings(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        // Far below, so that the crossing on an edge to the rim falls on the inner node.
        let (values, n) = self.rimmed(level - 1e12 * (1.0 + level.abs()));
        let clamp = |k: f64, n: usize| (k - 1.0).clamp(0.0, (n - 1) as f64);
        let place = |i: f64, j: f64| {
            [self.origin[0] + clamp(i, self.n[0]) * self.step[0], self.origin[1] + clamp(j, self.n[1]) * self.step[1]]
        };
        trace(&values, n, level, place)
    }
}

fn trace(values: &[f64], n: [usize; 2], level: f64, place: impl Fn(f64, f64) -> [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    let at = |i: usize, j: usize| values[j * n[0] + i];
    let crossing = |(i, j, along): Edge| {
        let (a, b) = if along == 0 { (at(i, j), at(i + 1, j)) } else { (at(i, j), at(i, j + 1)) };
        let s = ((level - a) / (b - a)).clamp(0.0, 1.0);
        if along == 0 { place(i as f64 + s, j as f64) } else { place(i as f64, j as f64 + s) }
    };
    // Each crossed edge connects to at most two others.
    let mut links: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    let mut link = |a: Edge, b: Edge| {
        links.entry(a).or_default().push(b);
        links.entry(b).or_default().push(a);
    };
    for j in 0..n[1] - 1 {
        for i in 0..n[0] - 1 {
            let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let above = corners.map(|v| v >= level);
            // Most cells lie on one side.
            if above == [above[0]; 4] {
                continue;
            }
            let edges = [(i, j, 0), (i + 1, j, 1), (i, j + 1, 0), (i, j, 1)];
            let crossed: Vec<Edge> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).map(|k| edges[k]).collect();
            match crossed[..] {
                [a, b] => link(a, b),
                [a, b, c, d] => {
                    let middle_above = corners.iter().sum::<f64>() / 4.0 >= level;
                    if above[0] == middle_above {
                        link(a, b);
                        link(c, d);
                    } else {
                        link(d, a);
                        link(b, c);
                    }
                }
                _ => {}
            }
        }
    }
    // Ends first, so that open lines are whole; then the rings.
    let ends: Vec<Edge> = links.iter().filter(|(_, l)| l.len() == 1).map(|(e, _)| *e).collect();
    let rest: Vec<Edge> = links.keys().copied().collect();
    let mut lines = Vec::new();
    for start in ends.into_iter().chain(rest) {
        let mut line = Vec::new();
        let mut here = start;
        while let Some(next) = links.get_mut(&here).and_then(Vec::pop) {
            if line.is_empty() {
                line.push(crossing(here));
            }
            let back = links.get_mut(&next).expect("links go both ways");
            if let Some(k) = back.iter().position(|e| *e == here) {
                back.swap_remove(k);
            }
            line.push(crossing(next));
            here = next;
        }
        if line.len() > 1 {
            lines.push(line);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(ring: &[[f64; 2]]) -> f64 {
        let twice: f64 = (0..ring.len())
            .map(|k| {
                let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
                a[0] * b[1] - a[1] * b[0]
            })
            .sum();
        (twice / 2.0).abs()
    }

    #[test]
    fn circle_is_one_ring_of_its_area() {
        let g = Grid::evaluate([-2.0, 2.0], [-2.0, 2.0], [81, 81], |x, y| 1.0 - x * x - y * y);
        let rings = g.rings(0.0);
        assert_eq!(rings.len(), 1);
        // Chords of a circle remove at most (h/r)²/6 of it: h = 0.05.
        assert!((area(&rings[0]) - std::f64::consts::PI).abs() < 5e-3);
        assert_eq!(g.lines(0.0).len(), 1);
    }

    #[test]
    fn slope_is_one_straight_line_and_its_upper_side_closes_at_the_edge() {
        let g = Grid::evaluate([0.0, 10.0], [0.0, 4.0], [11, 5], |x, _| x);
        let lines = g.lines(2.5);
        assert_eq!(lines.len(), 1);
        assert!(lines[0].iter().all(|p| (p[0] - 2.5).abs() < 1e-12));
        assert_eq!(lines[0].len(), 5);
        let rings = g.rings(2.5);
        assert_eq!(rings.len(), 1);
        assert!((area(&rings[0]) - 30.0).abs() < 1e-6);
    }

    #[test]
    fn saddle_gives_two_lines() {
        let g = Grid { n: [2, 2], origin: [0.0, 0.0], step: [1.0, 1.0], values: vec![1.0, 0.0, 0.0, 1.0] };
        assert_eq!(g.lines(0.5).len(), 2);
        assert_eq!(g.lines(2.0).len(), 0);
    }
}
