//! What a run leaves behind: recording, tables, figures, one-page report.
