//! Cells in shades of a value, and the scale of the shades.

use crate::charts::canvas::{Canvas, Style};

/// Width of a shade on the scale, px.
const WIDTH: f64 = 14.0;

/// Cells; neighbours of one shade in a line form one shape.
pub(super) struct ShadedCells {
    rings: Vec<Vec<Vec<[f64; 2]>>>,
}

impl ShadedCells {
    pub(super) fn new(shades: usize) -> Self {
        Self { rings: vec![Vec::new(); shades] }
    }

    /// A line of cells; `None` omits one. `corners` gives those of the cells from one to before another, px.
    pub(super) fn line(&mut self, shades: &[Option<usize>], corners: impl Fn(usize, usize) -> [[f64; 2]; 4]) {
        let mut from = 0;
        for run in shades.chunk_by(|a, b| a == b) {
            let to = from + run.len();
            if let Some(shade) = run[0] {
                self.rings[shade].push(corners(from, to).to_vec());
            }
            from = to;
        }
    }

    /// Draws them, each shade in its colour on a ramp, with an edge that hides the seams between them.
    pub(super) fn draw(&self, c: &mut Canvas, ramp: fn(f64) -> String, edge_px: f64) {
        for (shade, rings) in self.rings.iter().enumerate() {
            let colour = ramp(shade as f64 / (self.rings.len() - 1) as f64);
            c.lines(rings, true, &Style::fill(&colour).edged(&colour, edge_px));
        }
    }
}

/// The colours of a scale from a place on; returns where it ends, px.
pub(super) fn scale(c: &mut Canvas, [mut x, y]: [f64; 2], colours: impl Iterator<Item = String>) -> f64 {
    for colour in colours {
        c.rect(x, y - 9.0, WIDTH, 11.0, &Style::fill(&colour));
        x += WIDTH;
    }
    x
}
