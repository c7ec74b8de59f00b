//! Cuts off what lies far outside a sheet, near its edge, because the rasteriser cannot handle such large coordinates.
//!
//! *Source*: polygons, Sutherland & Hodgman 1974, Commun. ACM 17, 32; lines, Liang & Barsky 1984, ACM Trans. Graph. 3,
//! 1.
//!
//! *Parameters*: none; nothing nearer than `FAR` is changed.
//!
//! *Deviations*: none.

/// A coordinate beyond this is far away, px.
const FAR: f64 = 1e5;
/// Distance beyond the frame at which a shape is cut, px; the cut must not be visible.
const BEYOND: f64 = 100.0;

/// Left, top, right, bottom, px.
pub type Frame = [f64; 4];

/// Whether a point is far outside any sheet, or not finite.
pub fn is_far(p: [f64; 2]) -> bool {
    // NaN counts as far, too.
    !(p[0].abs() <= FAR && p[1].abs() <= FAR)
}

/// The part of lines or rings that is near a frame; `None` if that is all of it.
pub fn near(lines: &[Vec<[f64; 2]>], closed: bool, frame: Frame) -> Option<Vec<Vec<[f64; 2]>>> {
    if !lines.iter().flatten().any(|p| is_far(*p)) {
        return None;
    }
    let [left, top, right, bottom] = frame;
    let wider = [left - BEYOND, top - BEYOND, right + BEYOND, bottom + BEYOND];
    let real = lines.iter().map(|line| {
        let points = line.iter().copied();
        // Products of larger numbers would be infinite.
        let real = points.filter(|p| p.iter().all(|v| v.is_finite()));
        real.map(|p| p.map(|v| v.clamp(-1e100, 1e100))).collect::<Vec<_>>()
    });
    Some(if closed {
        real.map(|ring| ring_in(ring, wider)).collect()
    } else {
        real.flat_map(|line| line_in(&line, wider)).collect()
    })
}

/// The part of a ring in a frame.
fn ring_in(mut ring: Vec<[f64; 2]>, frame: Frame) -> Vec<[f64; 2]> {
    for (side, limit) in frame.into_iter().enumerate() {
        let axis = side % 2;
        let inside = |p: &[f64; 2]| {
            if side < 2 { p[axis] >= limit } else { p[axis] <= limit }
        };
        let mut kept = Vec::with_capacity(ring.len() + 1);
        for (k, b) in ring.iter().enumerate() {
            let a = &ring[(k + ring.len() - 1) % ring.len()];
            if inside(a) != inside(b) {
                let part = (limit - a[axis]) / (b[axis] - a[axis]);
                let mut cut = [0, 1].map(|d| a[d] + part * (b[d] - a[d]));
                cut[axis] = limit;
                kept.push(cut);
            }
            if inside(b) {
                kept.push(*b);
            }
        }
        ring = kept;
    }
    ring
}

/// The parts of a line in a frame.
fn line_in(line: &[[f64; 2]], frame: Frame) -> Vec<Vec<[f64; 2]>> {
    let mut parts: Vec<Vec<[f64; 2]>> = Vec::new();
    for ends in line.windows(2) {
        let Some([a, b]) = segment_in(ends[0], ends[1], frame) else {
            continue;
        };
        match parts.last_mut().filter(|part| part.last() == Some(&a)) {
            Some(part) => part.push(b),
            None => parts.push(vec![a, b]),
        }
    }
    parts
}

fn segment_in(a: [f64; 2], b: [f64; 2], frame: Frame) -> Option<[[f64; 2]; 2]> {
    let (mut begin, mut end) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let way = b[axis] - a[axis];
        let (low, high) = (frame[axis] - a[axis], frame[axis + 2] - a[axis]);
        if way == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
            continue;
        }
        let (s, t) = (low / way, high / way);
        begin = begin.max(s.min(t));
        end = end.min(s.max(t));
    }
    let at = |part: f64, whole: [f64; 2]| match part {
        0.0 | 1.0 => whole,
        _ => [0, 1].map(|d| a[d] + part * (b[d] - a[d])),
    };
    (begin < end).then(|| [at(begin, a), at(end, b)])
}

#[cfg(test)]
mod tests {
    use super::super::canvas::{Canvas, Style};
    use super::super::raster::png;
    use super::*;

    const SHEET: Frame = [0.0, 0.0, 60.0, 30.0];

    #[test]
    fn what_is_near_stays_as_it_is() {
        let line = vec![vec![[0.0, 0.0], [99_999.0, 5.0]]];
        assert_eq!(near(&line, false, SHEET), None);
    }

    #[test]
    fn a_ring_round_the_sheet_fills_it_and_one_beyond_is_gone() {
        let all = |v: f64| vec![vec![[-v, -v], [v, -v], [v, v], [-v, v]]];
        for v in [1e6, 1e200] {
            let kept = near(&all(v), true, SHEET).unwrap();
            assert_eq!(kept[0].len(), 4, "{kept:?}");
            for p in &kept[0] {
                assert!([-100.0, 160.0].contains(&p[0]) && [-100.0, 130.0].contains(&p[1]));
            }
        }
        let off = vec![vec![[1e7, 0.0], [2e7, 0.0], [2e7, 9.0]]];
        assert_eq!(near(&off, true, SHEET).unwrap(), [Vec::<[f64; 2]>::new()]);
    }

    #[test]
    fn a_line_through_the_sheet_keeps_its_direction() {
        let line = vec![vec![[-1e9, -5e8], [1e9, 5e8], [f64::NAN, 0.0]]];
        let kept = near(&line, false, SHEET).unwrap();
        assert_eq!(kept.len(), 1);
        for [x, y] in &kept[0] {
            assert!((y - 0.5 * x).abs() < 1e-3, "{x} {y}");
        }
        assert!((kept[0][0][0] + 100.0).abs() < 1e-3);
    }

    /// An obstacle of 2·10⁹ m: the drawing library panics at its raw corners.
    #[test]
    fn a_figure_with_a_huge_shape_is_drawn() {
        let mut c = Canvas::new(60.0, 30.0);
        c.clip(10.0, 5.0, 40.0, 20.0);
        for v in [2e9, 1e30, 1e200] {
            let ring = vec![[-v, -v], [v, -v], [v, v], [-v, v]];
            c.polygon(ring, &Style::fill("#000000").edged("#000000", 1.0).dashed("7 4"));
            c.line([-v, 3.0], [v, 3.0], &Style::line("#000000", 1.0).dashed("7 4"));
            c.circle([v, 0.0], v, &Style::fill("#000000"));
            c.rect(-v, -v, 2.0 * v, 2.0 * v, &Style::line("#000000", 1.0));
        }
        c.unclip();
        assert!(png(&c.svg("t")).is_ok());
    }
}
