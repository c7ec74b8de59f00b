//! The pictures of a place as they come in.
//!
//! *Source*: see the files beside this one.
//!
//! *Parameters*: see [`AddUpSpec`].
//!
//! *Deviations*: a picture's shift against those before it is looked for about that of the last one; it never exceeds
//! `shift_m` against the navigation.

use super::clarity::SeenClarity;
use super::evidence::{PlaceEvidence, REACH_M, unseen, weigh};
use super::ground::{Patch, Stand};
use super::mosaic::Mosaic;
use super::photometry::Useless;
use super::register::GroundBrightness;
use nalgebra::Vector2;
use robots::handoff::Picture;
use robots::strategy::AddUpSpec;
use world::units::Heading;

/// Most pictures of a place that are kept; later ones are not looked at.
const MOST: usize = 400;

/// The pictures of a place.
#[derive(Clone, Debug)]
pub struct PlacePictures {
    spec: AddUpSpec,
    place: Vector2<f64>,
    down_flow: Heading,
    patches: Vec<(Patch, [i32; 2])>,
    known: GroundBrightness,
    /// Shift of the newest picture that overlap was found for, cells.
    shift: [i32; 2],
    useless: usize,
    clarity: Option<SeenClarity>,
}

impl PlacePictures {
    /// A place (east, north, m) of which there are no pictures yet, in water that goes along `down_flow`.
    pub fn new(spec: &AddUpSpec, place: Vector2<f64>, down_flow: Heading) -> Self {
        Self {
            spec: spec.clone(),
            place,
            down_flow,
            patches: Vec::new(),
            known: GroundBrightness::default(),
            shift: [0; 2],
            useless: 0,
            clarity: None,
        }
    }

    /// Adds a picture.
    ///
    /// # Errors
    /// Why it says nothing; it then changes nothing but what [`Self::pictures`] counts.
    pub fn add(&mut self, picture: &Picture, stand: &Stand) -> Result<(), Useless> {
        let cell_m = self.spec.cell_m.get();
        let patch = Patch::project(picture, stand, cell_m).inspect_err(|_| self.useless += 1)?;
        if self.patches.len() >= MOST {
            return Ok(());
        }
        let reach = (self.spec.shift_m.get() / cell_m).round() as i32;
        if let Some(shift) = self.known.shift(&patch, self.shift, reach) {
            self.shift = shift;
        }
        self.known.add(&patch, self.shift);
        self.patches.push((patch, self.shift));
        let all = self.patches.iter().map(|(p, _)| p);
        self.clarity = SeenClarity::from_patches(all, self.spec.bed_texture.get());
        Ok(())
    }

    /// Moves the told place; the pictures stay where they lie.
    pub fn move_to(&mut self, place: Vector2<f64>) {
        self.place = place;
    }

    /// Number of pictures that were added, and of those that said nothing.
    pub fn pictures(&self) -> [usize; 2] {
        [self.patches.len(), self.useless]
    }

    /// The water as the pictures show it.
    pub fn clarity(&self) -> Option<SeenClarity> {
        self.clarity
    }

    /// Shift of the newest picture against the navigation (east, north), m.
    pub fn shift_m(&self) -> Vector2<f64> {
        Vector2::from(self.shift.map(|s| f64::from(s) * self.spec.cell_m.get()))
    }

    /// The ground as all pictures show it; `None` without any.
    pub fn mosaic(&self) -> Option<Mosaic> {
        let cell_m = self.spec.cell_m.get();
        let middle = [0, 1].map(|k| (self.place[k] / cell_m).floor() as i32);
        let reach_m = self.spec.within_m.get() + REACH_M;
        let all = self.patches.iter().map(|(p, shift)| (p, *shift));
        let water = self.clarity?;
        Some(Mosaic::from_patches(all, &water, cell_m, middle, reach_m))
    }

    /// What no picture shows of sources that may be here: where it is (east, north, m), weighted by how likely the
    /// pictures make each source. Empty without any picture.
    pub fn unseen(&self) -> Vec<(Vector2<f64>, f64)> {
        self.mosaic().map_or_else(Vec::new, |mosaic| unseen(&mosaic, &self.weigh().places, self.down_flow))
    }

    /// What the pictures say.
    pub fn weigh(&self) -> PlaceEvidence {
        weigh(self.mosaic().as_ref(), self.place, self.down_flow, &self.spec)
    }
}
