//! Lines with no more points than can be told apart.

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
