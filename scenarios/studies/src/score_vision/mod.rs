//! `rheotaxis score-vision`: how well dye and source are found in rendered pictures of known content, in clear to murky
//! water.

mod draw;
mod figures;
mod methods;
mod pixels;
mod render;
mod roc;
mod run;
mod save;
mod write;

pub use draw::{BINS, Content, SceneDraw, bin, draw};
pub use methods::{METHODS, Method};
pub use pixels::{Counts, Ratio, precision, recall};
pub use render::{Shot, shoot};
pub use roc::{Roc, ScoredPicture};
pub use run::{ScenePlan, SceneRow, ScoreError, score};
pub use save::save;
pub use write::{table, write};
