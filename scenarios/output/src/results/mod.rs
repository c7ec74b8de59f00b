//! Data gathered from the frames of a run: tracks, maps, echoes, pictures, and the summary.

pub mod belief_track;
mod echoes;
mod facts;
mod gantry_path;
mod headline;
mod map_end;
mod map_stated;
pub mod odour;
pub(crate) mod pictures;
mod plume_film;
pub mod probes;
mod run;
mod sources;
mod summary;
mod summary_builder;
mod table_file;
mod thinning;
mod track;
pub(crate) mod track_columns;

pub use belief_track::{BeliefRow, BeliefSnapshot, BeliefTrack, RobotBelief};
pub use echoes::{Echoes, RobotEchoes};
pub use facts::Fact;
pub use gantry_path::{GantryPath, GantrySummary};
pub use map_end::MapEnd;
pub use map_stated::{MapStated, NEAR_M};
pub use pictures::{Pictures, ShownPicture};
pub use plume_film::{PlumeFilm, Wisp};
pub use probes::{GantryInfo, GantryRow, GantryTrack, ProbeTables};
pub use run::{ObstacleOutline, RunInfo, RunReport};
pub use sources::{DeclarationSummary, DeclaredKind, Position, SourceError, SourceTruth};
pub use summary::{
    AbnormalSummary, MassBalance, RegionSummary, RobotSummary, RunSummary, SourceSummary, Summary, Totals, Versions,
};
pub use summary_builder::{SummaryBuilder, SummaryEnd};
pub use track::{LostPoint, RobotInfo, RobotTrack, Track, TrackRow, TrackTable};
pub use track_columns::{COLUMNS, numbers};
