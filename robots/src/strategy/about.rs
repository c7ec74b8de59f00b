//! What a strategy tells of itself before it is built.

use super::wishes::Wishes;
use crate::handoff::{ExchangeTiming, Need};

/// What checks, lists and figures ask of a strategy's parameters. The default is that of a search for one source.
#[derive(Clone, Debug)]
pub struct About {
    /// Whether it looks for a source: it then needs a chemical sensor, a flow estimate, and something to find.
    pub searches: bool,
    /// The instruments that it needs beside those of a search and of its wishes; paths below `strategy`.
    pub needs: Vec<Need>,
    /// The heights and speeds that it will command. Who commands any needs instruments to hold them.
    pub wishes: Wishes,
    /// Most declarations of it that can remain at the end; those that it rejects itself do not remain.
    pub declares_at_most: usize,
    /// If a searcher outside this program decides: how often it is asked.
    pub consulted: Option<ExchangeTiming>,
    /// Whether its decisions name subregions.
    pub regions: bool,
    /// Whether its decisions name layers.
    pub layers: bool,
}

impl Default for About {
    fn default() -> Self {
        Self {
            searches: true,
            needs: Vec::new(),
            wishes: Wishes::default(),
            declares_at_most: 1,
            consulted: None,
            regions: false,
            layers: false,
        }
    }
}

impl About {
    /// Of a strategy that looks for nothing and declares nothing.
    pub fn no_search() -> Self {
        Self { searches: false, declares_at_most: 0, ..Self::default() }
    }
}
