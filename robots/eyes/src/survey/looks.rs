//! What the camera says of a declared place: by one picture that shows a source, or by all of them added up, with
//! lines chosen by what they have shown so far.
//!
//! *Source*: ours; the test of one picture and that of all in `vision`. Altitude by the visibility: as surveys with
//! cameras are planned, low enough for the water (Singh, Roman, Pizarro, Eustice & Can 2007, Int. J. Robotics Res. 26,
//! 55).
//!
//! *Parameters*: see [`CameraPasses`] and [`AddUpSpec`].
//!
//! *Deviations*: pictures are laid out where the vehicle has come by its Doppler log and compass since the survey
//! began: jumps by position fixes are taken out. Their mean moves the told place. A line leads, along the flow or
//! against it, over the strip in which most of the likelihood of a source is left: over what is not yet seen, or what
//! looks like one. Its altitude is the greatest at which `contrast_left` of the bed's contrast arrives by the pictures
//! so far, within the limits; the first is flown at `altitude_m`. The bed's depth is the middle one of the last
//! seconds, so that a body under the vehicle does not count as bed.

use super::holds::best_point;
use crate::numbers::median;
use crate::vision::Verifier;
use crate::vision::place::{PlaceEvidence, PlacePictures, SeenClarity, Stand};
use nalgebra::{Vector2, Vector3};
use robots::behave::Passes;
use robots::handoff::{Observation, PictureEvidence, Verdict};
use robots::places::{MARGIN_M, inside};
use robots::strategy::{AddUpSpec, CameraPasses};
use std::collections::VecDeque;
use std::f64::consts::FRAC_PI_2;
use world::math;
use world::units::Heading;

/// Observations over which the bed's depth is the middle one.
const BED: usize = 81;
/// Pictures are taken as far before and behind the told place as a source may be, and this much farther, m: the
/// template's reach and half a picture.
const FARTHER_M: f64 = 4.5;
/// A camera whose axis leads down by less than this share of its length (30°) shows no bed to stand off from.
const STEEP: f64 = 0.5;
/// Distance between strips that are compared, m; a strip is as wide as this share of what a picture shows.
const STRIPS_M: f64 = 0.25;
const STRIP: f64 = 0.7;

/// What has been seen of a place.
#[derive(Debug)]
pub(super) enum Looks {
    /// Each picture by itself, and what those so far say.
    Single(Verifier, Verdict),
    /// All together.
    Added(Box<PictureSum>),
}

impl Looks {
    /// Begins with a told place; lines lie along `along`, against the flow. Points are `held` instead of lines.
    pub(super) fn begin(
        spec: &CameraPasses,
        told: Vector2<f64>,
        along: Heading,
        seen: &Observation,
        held: bool,
    ) -> Self {
        let highest_m = spec.altitude_m.get();
        match &spec.add_up {
            None => Self::Single(Verifier::new(&spec.verifier), Verdict::Unchecked),
            Some(add_up) => Self::Added(Box::new(PictureSum::begin(add_up, highest_m, told, along, seen, held))),
        }
    }

    /// Takes in a tick, `on_line` (or point) or on the way there. Whether a picture from here can show the place.
    pub(super) fn step(&mut self, seen: &Observation, on_line: bool) -> bool {
        match self {
            Self::Single(verifier, said) => {
                if let Some(picture) = &seen.picture {
                    let shown = verifier.judge(&picture.image).verified || *said == Verdict::Verified;
                    *said = if shown { Verdict::Verified } else { Verdict::Rejected };
                }
                true
            }
            Self::Added(added) => {
                added.follow(seen, on_line);
                added.take(seen);
                added.near(seen)
            }
        }
    }

    /// What the camera says; unchecked if it never reported.
    pub(super) fn answer(&self) -> Verdict {
        match self {
            Self::Single(_, said) => *said,
            Self::Added(added) => added.answer(),
        }
    }

    /// Whether nothing more needs to be flown.
    pub(super) fn enough(&self) -> bool {
        match self {
            Self::Single(_, said) => *said == Verdict::Verified,
            Self::Added(added) => matches!(added.answer(), Verdict::Verified | Verdict::Rejected),
        }
    }
}

/// All pictures of a place, and the lines over it.
#[derive(Debug)]
pub(super) struct PictureSum {
    spec: AddUpSpec,
    highest_m: f64,
    place: PlacePictures,
    told: Vector2<f64>,
    along: Heading,
    weighed: Option<PlaceEvidence>,
    /// Sum of the jumps since the survey began, and mean of that sum over the fixes.
    jumped: Vector2<f64>,
    fixes: (f64, Vector2<f64>),
    bed_m: VecDeque<f64>,
    /// Whether points are held; otherwise lines are flown.
    held: bool,
    /// Lines or points begun.
    lines: u32,
    altitude_m: f64,
    lowest_m: f64,
    /// How far the vehicle came below the clearance, m.
    raised_m: f64,
    view_rad: f64,
    /// Where the camera's axis meets the bed, for each metre of height, ahead and to the left.
    looks_at: Vector2<f64>,
}

impl PictureSum {
    fn begin(
        spec: &AddUpSpec,
        highest_m: f64,
        told: Vector2<f64>,
        along: Heading,
        seen: &Observation,
        held: bool,
    ) -> Self {
        let flow = seen.estimate.flow.map(|f| f.heading());
        let down_flow = flow.unwrap_or_else(|| along.opposite());
        Self {
            spec: spec.clone(),
            highest_m,
            place: PlacePictures::new(spec, told, down_flow),
            told,
            along,
            weighed: None,
            jumped: Vector2::zeros(),
            fixes: (0.0, Vector2::zeros()),
            bed_m: VecDeque::new(),
            held,
            lines: 0,
            altitude_m: highest_m,
            lowest_m: highest_m,
            raised_m: 0.0,
            view_rad: FRAC_PI_2,
            looks_at: Vector2::zeros(),
        }
    }

    /// Height of the lines, m.
    pub(super) fn altitude_m(&self) -> f64 {
        self.altitude_m
    }

    /// One tick: follows the jumps, the bed and the clearance. Called whether or not there is a picture.
    fn follow(&mut self, seen: &Observation, on_line: bool) {
        let e = &seen.estimate;
        self.jumped += e.fix_jump;
        if e.fix_jump != Vector2::zeros() {
            let (n, mean) = self.fixes;
            self.fixes = (n + 1.0, mean + (self.jumped - mean) / (n + 1.0));
            let middle = self.middle();
            self.place.move_to(middle);
        }
        let Some(altitude_m) = e.altitude_m else {
            return;
        };
        // Over a held place the body would become the bed.
        let full = self.bed_m.len() == BED;
        if !(self.held && full && self.near(seen)) {
            if full {
                self.bed_m.pop_front();
            }
            self.bed_m.push_back(e.depth_m + altitude_m);
        }
        if on_line {
            let short = self.spec.clearance_m.get() - altitude_m;
            self.raised_m = self.raised_m.max(short);
        }
    }

    /// The told place where the pictures are laid out.
    fn middle(&self) -> Vector2<f64> {
        self.told - self.fixes.1
    }

    /// Where the vehicle is where the pictures are laid out.
    fn position(&self, seen: &Observation) -> Vector2<f64> {
        seen.estimate.position - self.jumped
    }

    /// Whether a picture from here can show the place.
    fn near(&self, seen: &Observation) -> bool {
        (self.position(seen) - self.middle()).norm() <= self.spec.within_m.get() + FARTHER_M
    }

    /// Takes in the picture of this tick.
    fn take(&mut self, seen: &Observation) {
        let at = self.position(seen);
        let (Some(picture), Some(bed_m)) = (&seen.picture, median(self.bed_m.iter().copied())) else {
            return;
        };
        let stand =
            Stand { position: at, altitude_m: bed_m - seen.estimate.depth_m, R_WB: seen.estimate.attitude.R_WB() };
        self.view_rad = picture.view_rad;
        let axis = picture.R_BC * Vector3::z();
        if -axis.z > STEEP {
            self.looks_at = axis.xy() / -axis.z;
        }
        // A picture that says nothing is counted by the place.
        let _ = self.place.add(picture, &stand);
        self.weighed = Some(self.place.weigh());
    }

    /// The next line; `None` if no more are to be flown.
    pub(super) fn next_line(&mut self, half_m: f64, seen: &Observation) -> Option<Passes> {
        if self.lines >= self.spec.most_lines {
            return None;
        }
        self.choose(self.place.clarity());
        let along = match self.lines % 2 {
            0 => self.along,
            _ => self.along.opposite(),
        };
        let right = self.along.turned(FRAC_PI_2).unit();
        let place = self.middle() + self.jumped + right * self.strip();
        self.lines += 1;
        Some(Passes::over(place, along, &[0.0], half_m, &seen.area))
    }

    /// The next point to hold: that from which a picture shows the most of what has not been seen where a source may
    /// still be; `None` if no more are to be held.
    pub(super) fn next_point(&mut self, seen: &Observation) -> Option<Vector2<f64>> {
        if self.lines >= self.spec.most_lines {
            return None;
        }
        self.choose(self.place.clarity());
        self.lines += 1;
        let within_m = self.spec.within_m.get() + FARTHER_M;
        let best = best_point(&self.place.unseen(), self.middle(), within_m, self.shown_m());
        // A camera that looks ahead shows the point from farther back.
        let left = self.along.turned(-FRAC_PI_2).unit();
        let ahead = self.along.unit() * self.looks_at.x + left * self.looks_at.y;
        let stand = best - ahead * self.altitude_m;
        Some(inside(&seen.area, stand + self.jumped, MARGIN_M))
    }

    /// How far to the side a picture from the present altitude shows the bed well, m.
    fn shown_m(&self) -> f64 {
        let half_view = (0.5 * self.view_rad).min(0.25 * std::f64::consts::PI);
        STRIP * self.altitude_m * math::tan(half_view)
    }

    /// Chooses the altitude of the next line for the water that the pictures show.
    fn choose(&mut self, water: Option<SeenClarity>) {
        if let Some(water) = water {
            let lowest_m = self.spec.least_altitude_m.get() + self.raised_m;
            let range_m = (lowest_m.min(self.highest_m), self.highest_m);
            self.altitude_m = water.height_m(self.spec.contrast_left.get(), range_m);
        }
        // In shallow water: half its depth.
        if let Some(bed_m) = self.bed_m.back() {
            self.altitude_m = self.altitude_m.min((0.5 * bed_m).max(0.5));
        }
        self.lowest_m = self.lowest_m.min(self.altitude_m);
    }

    /// Distance of the best strip from the told place, to the right of `along`, m.
    fn strip(&self) -> f64 {
        let Some(weighed) = &self.weighed else {
            return 0.0;
        };
        let right = self.along.turned(FRAC_PI_2).unit();
        let (half, middle) = (self.shown_m(), self.middle());
        let mass = |offset: f64| -> f64 {
            (weighed.places.iter())
                .filter(|(p, _)| ((p - middle).dot(&right) - offset).abs() <= half)
                .map(|(_, log)| math::exp(*log))
                .sum()
        };
        let n = (self.spec.within_m.get() / STRIPS_M).floor() as i32;
        // From the middle outwards, so that of equal strips the nearest one is flown.
        let strips = (0..=n).flat_map(|k| [k, -k]).map(|k| f64::from(k) * STRIPS_M);
        let best = strips.map(|offset| (offset, mass(offset))).reduce(|a, b| if b.1 > 1.001 * a.1 { b } else { a });
        best.map_or(0.0, |(offset, _)| offset)
    }

    /// What the pictures say; unchecked without any.
    fn answer(&self) -> Verdict {
        self.weighed.as_ref().map_or(Verdict::Unchecked, |weighed| weighed.answer)
    }

    /// The likeliest place of the source as the vehicle believes now, if the pictures verify one.
    pub(super) fn found(&self) -> Option<Vector2<f64>> {
        let weighed = self.weighed.as_ref()?;
        let best = weighed.best.filter(|_| weighed.answer == Verdict::Verified)?;
        // From where the pictures lie to the mean of the fixes.
        Some(best + self.fixes.1)
    }

    /// What the pictures were and what they say.
    pub(super) fn evidence(&self) -> PictureEvidence {
        let [pictures, useless] = self.place.pictures();
        PictureEvidence {
            pictures: pictures as u32,
            useless: useless as u32,
            lines: self.lines,
            lowest_m: self.lowest_m,
            visibility_m: self.place.clarity().map(|c| c.visibility_m()),
            log_factor: self.weighed.as_ref().map_or(0.0, |w| w.log_factor),
        }
    }
}

#[cfg(test)]
#[path = "looks_tests.rs"]
mod tests;
