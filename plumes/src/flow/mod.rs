//! The water: one file a flow, summed into one answer.
