//! The units of the tracker by name.

use world::catalogue::Entry;

/// Units of the tracker that can be chosen, with their names in RON; the other units follow from them.
pub const UNITS: &[Entry] = &[
    Entry {
        name: "sweep",
        what: "relative position/data builder: the place of the strongest smell in a full sweep, Peak or Centroid",
        source: "Webster et al. 2012, sections 4 and 5",
    },
    Entry {
        name: "threshold",
        what: "threshold analyser: HalfMean (half the running average of spikes, not below a floor) or Level",
        source: "Webster et al. 2012, section 4; Page et al. 2011a",
    },
    Entry {
        name: "predictor",
        what: "spike characteristics predictor from 2-10 s of memory: Mean or Trend",
        source: "Webster et al. 2012, section 4",
    },
    Entry {
        name: "history",
        what: "short-term input-output history analyser: weighted mean of the spikes since the previous step",
        source: "Webster et al. 2012, section 4",
    },
    Entry {
        name: "advance",
        what: "decision unit, up-stream motion: StepRule (more than before, or as predicted) or Gated (any spike)",
        source: "Webster et al. 2012, section 4; Page et al. 2011a",
    },
    Entry {
        name: "contrast",
        what: "decision unit, steering: Fixed (30 % between the sides) or Adaptive (beyond its own uncertainty)",
        source: "Webster et al. 2012, sections 4 and 7",
    },
    Entry {
        name: "speed",
        what: "decision unit, pace: Fixed (6.1 and 3 cm/s, rest after each step) or Adaptive (faster with more spikes)",
        source: "Webster et al. 2012, sections 3 and 7",
    },
    Entry {
        name: "stop",
        what: "decision unit, stopping: SpikeRate (2 Hz) or Experience (relative to the first steps; end of the trail)",
        source: "Webster et al. 2012, sections 4 and 7",
    },
];
