//! Strategies: compositions of behaviours.
