//! Tracks as lines: in stretches of one kind, with no more points than can be told apart.

/// Points of a track nearer than this to the last drawn point are omitted, px.
const APART_PX: f64 = 0.5;

/// Points at least [`APART_PX`] apart, including the last.
pub(super) fn thinned(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    let mut left_out = None;
    for p in points {
        let far = kept.last().is_none_or(|q| {
            let d = [p[0] - q[0], p[1] - q[1]];
            d[0] * d[0] + d[1] * d[1] >= APART_PX * APART_PX
        });
        if far {
            kept.push(p);
            left_out = None;
        } else {
            left_out = Some(p);
        }
    }
    kept.extend(left_out);
    kept
}

/// Stretches of equal rows, each with one row of the next, so that lines along them have no gaps; and where they begin.
pub(super) fn stretches<T, K: PartialEq>(rows: &[T], of: impl Fn(&T) -> K) -> impl Iterator<Item = (usize, &[T])> {
    let mut next = 0;
    rows.chunk_by(move |a, b| of(a) == of(b)).map(move |run| {
        let begin = next;
        next += run.len();
        (begin, &rows[begin..(next + 1).min(rows.len())])
    })
}
