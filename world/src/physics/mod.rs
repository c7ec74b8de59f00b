//! Rigid bodies and contacts, the only place that touches rapier3d.
