//! Filaments: store, drift, concentration.
