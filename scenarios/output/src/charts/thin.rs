//! Leaves out the points of a line that nobody can see.
//!
//! *Source*: Ramer 1972, Comput. Graph. Image Process. 1, 244; Douglas & Peucker 1973, Cartographica 10, 112.
//!
//! *Parameters*: [`UNSEEN`], [`RUN`].
//!
//! *Deviations*: a line is thinned in runs of [`RUN`] points, whose ends stay. So the time grows with the number of
//! points, also for one that turns at each of them.

/// Farthest distance of a point that is left out from the line that is drawn, px: a fifth of a pixel of the PNG.
const UNSEEN: f64 = 0.1;
/// Points that are looked at together.
const RUN: usize = 256;

/// The points to draw, in order; the first and the last are among them.
pub(super) fn thinned(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let Some(first) = line.first() else {
        return Vec::new();
    };
    let mut kept = vec![*first];
    let mut open = Vec::new();
    let mut from = 0;
    while from + 1 < line.len() {
        let to = (from + RUN).min(line.len() - 1);
        // The nearer part of what was halved is done first, so that points come in order.
        open.push((from, to));
        while let Some((a, b)) = open.pop() {
            match farthest(line, a, b) {
                Some(middle) => open.extend([(middle, b), (a, middle)]),
                None => kept.push(line[b]),
            }
        }
        from = to;
    }
    kept
}

/// The point between two that is farthest from their connection, if it can be seen there.
fn farthest(line: &[[f64; 2]], a: usize, b: usize) -> Option<usize> {
    let (p, q) = (line[a], line[b]);
    let d = [q[0] - p[0], q[1] - p[1]];
    let length2 = d[0] * d[0] + d[1] * d[1];
    let (mut worst, mut at) = (UNSEEN * UNSEEN, None);
    for (n, r) in line.iter().enumerate().take(b).skip(a + 1) {
        let e = [r[0] - p[0], r[1] - p[1]];
        let along = (e[0] * d[0] + e[1] * d[1]) / length2.max(f64::MIN_POSITIVE);
        let along = along.clamp(0.0, 1.0);
        let off = [e[0] - along * d[0], e[1] - along * d[1]];
        let off2 = off[0] * off[0] + off[1] * off[1];
        if off2 > worst {
            (worst, at) = (off2, Some(n));
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::math;

    fn distance(p: [f64; 2], line: &[[f64; 2]]) -> f64 {
        let to = |ends: &[[f64; 2]]| {
            let (a, b) = (ends[0], ends[1]);
            let d = [b[0] - a[0], b[1] - a[1]];
            let e = [p[0] - a[0], p[1] - a[1]];
            let along = (e[0] * d[0] + e[1] * d[1]) / (d[0] * d[0] + d[1] * d[1]);
            let along = along.clamp(0.0, 1.0);
            let off = [e[0] - along * d[0], e[1] - along * d[1]];
            (off[0] * off[0] + off[1] * off[1]).sqrt()
        };
        line.windows(2).map(to).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn what_is_left_out_cannot_be_seen() {
        let spiral: Vec<[f64; 2]> = (0..5000)
            .map(|n| {
                let t = f64::from(n) * 0.01;
                let (sin, cos) = math::sin_cos(t);
                [300.0 + 5.0 * t * cos, 300.0 + 5.0 * t * sin]
            })
            .collect();
        let kept = thinned(&spiral);
        assert!(kept.len() < spiral.len() / 5, "{} points", kept.len());
        assert_eq!((kept[0], kept.last()), (spiral[0], spiral.last()));
        for p in &spiral {
            assert!(distance(*p, &kept) <= UNSEEN + 1e-9);
        }
    }

    #[test]
    fn corners_and_ways_back_stay() {
        let there_and_back = [[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [2.0, 0.0], [2.0, 3.0]];
        let kept = [[0.0, 0.0], [10.0, 0.0], [2.0, 0.0], [2.0, 3.0]];
        assert_eq!(thinned(&there_and_back), kept);
        assert_eq!(thinned(&[[1.0, 1.0]]), [[1.0, 1.0]]);
        assert!(thinned(&[]).is_empty());
    }

    #[test]
    fn points_at_one_place_become_its_ends() {
        assert_eq!(thinned(&[[3.0, 3.0]; 9]), [[3.0, 3.0]; 2]);
    }
}
