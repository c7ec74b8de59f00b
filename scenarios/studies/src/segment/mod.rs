//! `rheotaxis segment`: a picture analysed by the fuzzy colour extractor, with every step drawn.

mod clusters;
mod overlay;
mod picture;
mod sheet;
mod write;

pub use overlay::SegmentedPicture;
pub use picture::{MOST_PIXELS, MOST_SIDE, PictureError, read_picture};
pub use write::{table, write};
