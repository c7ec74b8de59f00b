//! A pair of axes: conversion from values to pixels, ticks, frame.

use super::canvas::{Anchor, Canvas, Style};
use super::label_box::LabelBox;
use super::palette::{GRID, INK};
use world::math;

/// A rectangle of the sheet that shows a rectangle of values. `y` points up unless `y_lo > y_hi`.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// Left edge, px.
    pub left: f64,
    /// Upper edge, px.
    pub top: f64,
    /// Width, px.
    pub width: f64,
    /// Height, px.
    pub height: f64,
    /// Values at left and right.
    pub x: [f64; 2],
    /// Values at bottom and top.
    pub y: [f64; 2],
}

impl Panel {
    /// Horizontal position of a value of x, px.
    pub fn px(&self, x: f64) -> f64 {
        self.left + (x - self.x[0]) / (self.x[1] - self.x[0]) * self.width
    }

    /// Vertical position of a value of y, px.
    pub fn py(&self, y: f64) -> f64 {
        self.top + self.height - (y - self.y[0]) / (self.y[1] - self.y[0]) * self.height
    }

    /// Position of a pair of values, px.
    pub fn position(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.px(x), self.py(y)]
    }

    /// Positions of pairs of values, px.
    pub fn all(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|p| self.position(*p)).collect()
    }

    /// Its lower edge, px.
    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Its right edge, px.
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    /// Pixels for one unit of x.
    pub fn px_per_unit(&self) -> f64 {
        self.width / (self.x[1] - self.x[0])
    }

    /// Positions of the corners of lines or rings, px.
    pub fn lines(&self, lines: &[Vec<[f64; 2]>]) -> Vec<Vec<[f64; 2]>> {
        lines.iter().map(|line| self.all(line)).collect()
    }

    /// Hides what is drawn outside the panel until the next unclip.
    pub fn clip(&self, c: &mut Canvas) {
        c.clip(self.left, self.top, self.width, self.height);
    }

    /// The same, on a black ground.
    pub fn clip_black(&self, c: &mut Canvas) {
        self.clip(c);
        let ground = Style::fill("#000000");
        c.rect(self.left, self.top, self.width, self.height, &ground);
    }

    /// Draws the panel's edge.
    pub fn frame(&self, c: &mut Canvas, width: f64) {
        c.rect(self.left, self.top, self.width, self.height, &Style::line(INK, width));
    }

    /// The edge, with ticks and numbers along the bottom and the left.
    pub fn axes(&self, c: &mut Canvas, apart_px: f64, size: f64) {
        self.frame(c, 1.0);
        self.x_ticks(c, true, size);
        self.y_ticks(c, apart_px, size);
    }

    /// What the axes are: words so far below the panel and to the left of it, px.
    pub fn names(&self, c: &mut Canvas, size: f64, [x, y]: [&str; 2], [below, left]: [f64; 2]) {
        c.text([self.left + self.width / 2.0, self.bottom() + below], size, Anchor::Middle, x);
        c.upright([self.left - left, self.top + self.height / 2.0], size, y);
    }

    /// Ticks and numbers along the bottom.
    pub fn x_ticks(&self, c: &mut Canvas, numbers: bool, size: f64) {
        let step = nice_step((self.x[1] - self.x[0]).abs(), self.width / 90.0);
        for v in ticks(self.x, step) {
            let x = self.px(v);
            c.line([x, self.bottom()], [x, self.bottom() + 4.0], &Style::line(INK, 0.8));
            if numbers {
                let at = [x, self.bottom() + 6.0 + size];
                c.text(at, size, Anchor::Middle, &number(v, step));
            }
        }
    }

    /// Ticks and numbers along the left.
    pub fn y_ticks(&self, c: &mut Canvas, apart_px: f64, size: f64) {
        let step = nice_step((self.y[1] - self.y[0]).abs(), self.height / apart_px);
        for v in ticks(self.y, step) {
            let y = self.py(v);
            c.line([self.left - 4.0, y], [self.left, y], &Style::line(INK, 0.8));
            let at = [self.left - 7.0, y + 0.36 * size];
            c.text(at, size, Anchor::End, &number(v, step));
        }
    }

    /// A faint line and a tick at a height of the sheet, px, for axes whose numbers are not evenly spaced.
    pub fn mark_y(&self, c: &mut Canvas, y: f64) {
        c.line([self.left, y], [self.right(), y], &Style::line(GRID, 0.7));
        c.line([self.left - 4.0, y], [self.left, y], &Style::line(INK, 0.8));
    }

    /// Faint lines at the ticks of both axes.
    pub fn grid(&self, c: &mut Canvas, apart_px: f64) {
        let step = nice_step((self.x[1] - self.x[0]).abs(), self.width / 90.0);
        for v in ticks(self.x, step) {
            let x = self.px(v);
            c.line([x, self.top], [x, self.bottom()], &Style::line(GRID, 0.7));
        }
        let step = nice_step((self.y[1] - self.y[0]).abs(), self.height / apart_px);
        for v in ticks(self.y, step) {
            let y = self.py(v);
            c.line([self.left, y], [self.right(), y], &Style::line(GRID, 0.7));
        }
    }

    /// The part of a room outside it, px².
    pub fn outside(&self, room: &LabelBox) -> f64 {
        let all = (room.right - room.left) * (room.bottom - room.top);
        let own = LabelBox { left: self.left, top: self.top, right: self.right(), bottom: self.bottom() };
        (all - room.shared(&own)).max(0.0)
    }

    /// Draws rimmed text at the first of several places where it covers nothing and lies within the panel. If there is
    /// none, it takes the place where it covers least, or omits the text if that is allowed.
    pub fn label_at(&self, c: &mut Canvas, places: &[([f64; 2], Anchor)], size: f64, s: &str, may_be_left_out: bool) {
        let in_the_way = |(at, anchor): &([f64; 2], Anchor)| {
            let room = LabelBox::of_text(*at, size, *anchor, s);
            c.taken().iter().map(|t| room.shared(t)).sum::<f64>() + self.outside(&room)
        };
        let free = places.iter().find(|p| in_the_way(p) == 0.0).copied();
        let least = || places.iter().copied().min_by(|a, b| in_the_way(a).total_cmp(&in_the_way(b)));
        let chosen = if may_be_left_out { free } else { free.or_else(least) };
        if let Some((at, anchor)) = chosen {
            c.rimmed(at, size, anchor, s);
        }
    }
}

/// 10 to the power of an integer.
pub fn power_of_ten(n: i32) -> f64 {
    10f64.powi(n)
}

/// Largest n with 10ⁿ ≤ x.
pub fn decade(x: f64) -> i32 {
    (math::ln(x) / std::f64::consts::LN_10 + 1e-12).floor() as i32
}

/// 1, 2 or 5 times a power of ten, such that `span` has about `wanted` steps.
pub fn nice_step(span: f64, wanted: f64) -> f64 {
    let raw = span.max(1e-9) / wanted.max(1.0);
    let base = power_of_ten(decade(raw));
    let times = [1.0, 2.0, 5.0, 10.0];
    base * times.into_iter().find(|t| t * base >= raw * 0.999).unwrap_or(10.0)
}

/// Multiples of `step` within the range, which may be descending.
pub fn ticks(range: [f64; 2], step: f64) -> Vec<f64> {
    let (lo, hi) = (range[0].min(range[1]), range[0].max(range[1]));
    let first = (lo / step - 1e-9).ceil() as i64;
    let last = (hi / step + 1e-9).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// A number with as many decimals as its step needs, and a true minus sign.
pub fn number(v: f64, step: f64) -> String {
    let decimals = usize::try_from(-decade(step)).unwrap_or(0);
    let text = format!("{:.decimals$}", v.abs());
    let zero = text.chars().all(|c| matches!(c, '0' | '.'));
    if v < 0.0 && !zero { format!("−{text}") } else { text }
}

/// A range that contains all given numbers, widened by a share; it is never empty.
pub fn range_of(values: impl Iterator<Item = f64>, widen: f64) -> Option<[f64; 2]> {
    let mut range: Option<[f64; 2]> = None;
    for v in values.filter(|v| v.is_finite()) {
        let r = range.get_or_insert([v, v]);
        *r = [r[0].min(v), r[1].max(v)];
    }
    let [lo, hi] = range?;
    let span = (hi - lo).max(1e-6 * hi.abs().max(lo.abs())).max(1e-6);
    Some([lo - widen * span, hi + widen * span])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_one_two_or_five_and_numbers_carry_their_decimals_and_no_minus_zero() {
        for (span, parts, step) in [(1000.0, 5.0, 200.0), (1.0, 10.0, 0.1), (7.0, 3.0, 5.0)] {
            assert_eq!(nice_step(span, parts), step);
        }
        assert_eq!(ticks([0.5, -0.2], 0.2).len(), 4);
        for (value, step, text) in [(-200.0, 100.0, "−200"), (0.25, 0.05, "0.25"), (-1e-12, 0.1, "0.0")] {
            assert_eq!(number(value, step), text);
        }
    }

    #[test]
    fn reversed_axis_points_down() {
        let p = Panel { left: 0.0, top: 0.0, width: 10.0, height: 10.0, x: [0.0, 1.0], y: [8.0, 0.0] };
        assert_eq!(p.py(8.0), 10.0);
        assert_eq!(p.py(0.0), 0.0);
    }

    #[test]
    fn range_of_one_value_is_not_empty_and_of_none_is_none() {
        let r = range_of([3.0, f64::NAN].into_iter(), 0.1).unwrap();
        assert!(r[0] < 3.0 && r[1] > 3.0);
        assert!(range_of(std::iter::empty(), 0.1).is_none());
    }
}
