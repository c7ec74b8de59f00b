//! The searchers of a gantry, and the units of the tracker, by name.

use super::chemotaxis::ChemotaxisSpec;
use super::crab::spec::CrabSpec;
use super::external::ExternalSpec;
use super::spec::GantryStrategyParams;
use super::surge_cast::SurgeCastSpec;
use world::catalogue::Entry;
use world::kind;

kind! {
    /// Searchers that move a gantry's head by what its probes read.
    pub GantryStrategySpec = GantryStrategies of GantryStrategyParams {
        heading: "Searchers of a gantry (gantries: tracker)",
        rows: [CrabSpec, SurgeCastSpec, ChemotaxisSpec, ExternalSpec],
    }
}

/// Units of the tracker that can be chosen, with their names in RON; the other units follow from them.
pub const UNITS: &[Entry] = &[
    Entry {
        name: "sweep",
        what: "relative position/data builder: the place of the strongest smell in a full sweep",
        source: "Webster et al. 2012, sections 4 and 5",
    },
    Entry {
        name: "threshold",
        what: "threshold analyser: HalfMean (half the running average of spikes, not below a floor) or Level",
        source: "Webster et al. 2012, section 4; Page et al. 2011a",
    },
    Entry {
        name: "predictor",
        what: "spike characteristics predictor from 2-10 s of memory: their mean",
        source: "Webster et al. 2012, section 4",
    },
    Entry {
        name: "history",
        what: "short-term input-output history analyser: weighted average since the previous step, over Time or Spikes",
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

/// Places that the paper leaves open: the field, its readings with the default first, and the sentence that they read.
pub const READINGS: &[Entry] = &[
    Entry {
        name: "history.over",
        what: "Time, or Spikes: what an average runs over",
        source: "\"'Average' means time average over the period since the previous step\"",
    },
    Entry {
        name: "history.centre_weight",
        what: "2, from just above 1: weight of the centre probe",
        source: "\"the center probe has greater weighting for this function compared to the other probes\"",
    },
    Entry {
        name: "predictor.memory_s",
        what: "5 s, from 2 to 10: of which time the mean is expected of the next step",
        source: "\"short-term (2-10 s) memory data to predict the characteristics of a one-step-ahead measurement\"",
    },
    Entry {
        name: "stop.window_s, stop.count",
        what: "3.5 s, a step; Greatest, Pooled or Mean: how the frequency of spikes is counted",
        source: "\"exceeding a threshold frequency of concentration spikes ... set at 2 Hz\"",
    },
    Entry {
        name: "travel_m, at_end",
        what: "all of the machine's, Fails or Stops: where the travel ends, and what it means to get there",
        source: "\"The average final distance from the plume source location for the successful trials is 14.3 cm\"",
    },
    Entry {
        name: "probes.full_scale_kg_m3",
        what: "4.7, a tenth of the release, up to 47, all of it: the concentration that gives 5 V",
        source: "\"voltage signal range is -5 - +5 V\"",
    },
    Entry {
        name: "probes.noise_v, probes.adc_bits",
        what: "4 mV and 12 bits: what the least threshold of -4.98 V excludes",
        source: "\"a minimum threshold value of -4.98 V is applied to exclude noise\"",
    },
];
