//! Space on a sheet: what texts and keys occupy, and a free place for the next label.

/// Position of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Anchor {
    /// The text begins at the point.
    Start,
    /// The text is centred on the point.
    Middle,
    /// The text ends at the point.
    End,
}

/// A rectangle of the sheet, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelBox {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Right edge.
    pub right: f64,
    /// Lower edge.
    pub bottom: f64,
}

impl LabelBox {
    /// A square round a point.
    pub fn round([x, y]: [f64; 2], reach: f64) -> Self {
        Self { left: x - reach, top: y - reach, right: x + reach, bottom: y + reach }
    }

    /// The space of a line of text at a point.
    pub fn of_text([x, y]: [f64; 2], size: f64, anchor: Anchor, s: &str) -> Self {
        let width = width_of(s, size);
        let left = match anchor {
            Anchor::Start => x,
            Anchor::Middle => x - 0.5 * width,
            Anchor::End => x - width,
        };
        Self { left, top: y - 0.78 * size, right: left + width, bottom: y + 0.24 * size }
    }

    /// The area that two rooms share, px²; zero if they only touch.
    pub fn shared(&self, other: &LabelBox) -> f64 {
        let w = self.right.min(other.right) - self.left.max(other.left);
        let h = self.bottom.min(other.bottom) - self.top.max(other.top);
        w.max(0.0) * h.max(0.0)
    }
}

/// Width of a text, px, in DejaVu Sans. Letters are grouped in classes, each with the width of its widest letter.
pub fn width_of(s: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | '\'' => 0.28,
        ' ' | '.' | ',' | ':' | ';' | 'I' | 'f' | 't' | 'r' | '(' | ')' | '/' | '-' | '·' => 0.41,
        'm' | 'M' | 'W' | '%' => 0.99,
        'w' | '+' | '−' | '=' | '×' | '<' | '>' | 'O' | 'Q' | 'D' | 'G' | 'H' | 'N' | 'U' => 0.84,
        'A'..='Z' => 0.70,
        '⁰'..='⁹' | '²' | '³' | '⁻' | '°' => 0.50,
        _ => 0.64,
    };
    size * s.chars().map(em).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rooms_that_touch_share_nothing() {
        let a = LabelBox::round([0.0, 0.0], 5.0);
        assert_eq!(a.shared(&LabelBox::round([10.0, 0.0], 5.0)), 0.0);
        assert_eq!(a.shared(&LabelBox::round([8.0, 6.0], 5.0)), 8.0);
    }

    #[test]
    fn text_stands_left_of_round_or_right_of_its_point() {
        let at = |anchor| LabelBox::of_text([100.0, 50.0], 10.0, anchor, "declared");
        let (start, end) = (at(Anchor::Start), at(Anchor::End));
        assert_eq!((start.left, end.right), (100.0, 100.0));
        assert!((start.right - start.left - 10.0 * (6.0 * 0.64 + 0.41 + 0.28)).abs() < 1e-9);
    }
}
