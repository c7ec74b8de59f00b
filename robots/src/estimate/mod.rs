//! Readings become what the vehicle believes.
