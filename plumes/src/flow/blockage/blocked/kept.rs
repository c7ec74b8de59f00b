//! The solutions of unsteady water round obstacles, written to bytes and read back. Steady water has one, which it
//! solves when it is built.

use super::{Faces, ObstacleFlow, SolutionReport};
use std::sync::Arc;
use world::bits::{Reader, Unreadable, Writer};

impl ObstacleFlow {
    /// Writes what has changed since it was built.
    pub(in crate::flow) fn keep(&self, to: &mut Writer) {
        let Self {
            projector,
            phi,
            fields,
            first,
            solved,
            // `advance` gives this again.
            free: _,
            // These do not change.
            cells: _,
            period_s: _,
            drift: _,
            depth: _,
        } = self;
        if projector.is_none() {
            return;
        }
        to.word(*first);
        to.write_list(phi);
        for list in fields.iter().flat_map(|f| &f.0) {
            to.write_list(list);
        }
        let SolutionReport { steps, divergence, open_cells: _, cells: _ } = solved;
        to.word(*steps as u64);
        to.word(*divergence);
    }

    /// Takes over what another one of the same water and obstacles has written.
    pub(in crate::flow) fn recall(&mut self, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        if self.projector.is_none() {
            return Ok(());
        }
        self.first = from.word()?;
        self.phi = from.exactly(self.phi.len())?;
        for field in &mut self.fields {
            let [x, y, s] = field.0.each_ref().map(Vec::len);
            *field = Arc::new(Faces([from.exactly(x)?, from.exactly(y)?, from.exactly(s)?]));
        }
        self.solved.steps = from.word::<u64>()? as usize;
        self.solved.divergence = from.word()?;
        // To the last of the three moments, as when they were solved.
        self.free.advance((self.first + 2) as f64 * self.period_s);
        Ok(())
    }
}
