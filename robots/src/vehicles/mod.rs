//! Bodies that move; the only place that touches urdf-rs.
