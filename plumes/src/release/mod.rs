//! Sources and how they release filaments.
