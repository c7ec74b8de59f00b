//! Verification by all pictures of a place: laid on the ground, shifted onto one another, added up, and weighed.

mod clarity;
mod evidence;
mod gathered;
mod ground;
mod mosaic;
mod photometry;
mod register;

pub use clarity::SeenClarity;
pub use evidence::PlaceEvidence;
pub use gathered::PlacePictures;
pub use ground::Stand;
pub use mosaic::Mosaic;
pub use photometry::Useless;
