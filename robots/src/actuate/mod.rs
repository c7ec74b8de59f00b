//! Commands become actuator set-points.
