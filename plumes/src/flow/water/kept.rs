//! Water written to bytes and read back into a fresh one of the same parameters, place and seed.
//!
//! Currents and meanders are the same at a time however they came to it, and are computed again. The solution round
//! obstacles also depends, in its last bits, on the solutions before it. It is written.

use super::Water;
use world::bits::{Reader, Unreadable, Writer};
use world::fields::Flow;

impl Water {
    /// Writes what [`Flow::advance`] alone would not give again.
    pub fn keep(&self, to: &mut Writer) {
        let Self {
            blocked,
            // `advance` gives these again.
            meanders: _,
            // These do not change.
            ground: _,
            uniform: _,
            tides: _,
            layered: _,
            bed: _,
            mixing: _,
            density: _,
            flume: _,
            waves: _,
            others: _,
        } = self;
        if let Some(blocked) = blocked {
            blocked.keep(to);
        }
    }

    /// Becomes what other water of the same origin was when it had been advanced to `t_s` and was kept.
    ///
    /// # Errors
    /// If the bytes are not those of such water. This one is then of no more use.
    pub fn recall(&mut self, t_s: f64, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        if let Some(blocked) = &mut self.blocked {
            blocked.recall(from)?;
        }
        self.advance(t_s);
        Ok(())
    }
}
