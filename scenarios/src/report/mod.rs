//! What a run leaves behind: recording, tables, figures, one-page report.

mod belief_track;
mod echoes;
pub(crate) mod figures;
mod files;
pub(crate) mod html;
mod map_end;
mod map_record;
mod odour;
mod pictures;
mod probes;
mod recorder;
mod recorder_gantry;
mod summary;
mod summary_builder;
mod track;
mod write;

pub use belief_track::{BeliefRow, BeliefSnapshot, BeliefTrack, RobotBelief};
pub use echoes::{Echoes, RobotEchoes};
pub use files::ReportError;
pub(crate) use files::{Kept, begin_folder, make_folder, write_whole};
pub use map_end::MapEnd;
pub use pictures::{Pictures, ShownPicture};
pub use probes::{GantryInfo, GantryRow, GantryTrack, ProbeTables};
pub use recorder::{Recorder, RunInfo};
pub use summary::{
    AbnormalSummary, DeclarationSummary, DeclaredKind, MassBalance, Position, RegionSummary,
    RobotSummary, RunOutcome, RunSummary, SourceError, SourceSummary, Summary, Totals, Versions,
};
pub use summary_builder::{RunEnd, SourceTruth, SummaryBuilder};
pub use track::{RobotInfo, RobotTrack, Track, TrackRow, TrackTable};
pub use write::{ObstacleOutline, RunReport, write_all};

#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_gantry;
#[cfg(test)]
mod tests_words;
