//! Live state over zenoh, the only place that touches it.
