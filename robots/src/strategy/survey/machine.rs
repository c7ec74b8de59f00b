//! After a declaration: passes with the sidescan, then with the camera, and their verdict on the declared place.
//!
//! *Source*: Pang 2009, section 3 ("following the source declaration, additional AUV maneuvers") and section 6 (the
//! declared source's place confirmed by sidescan sonar); verification of a declared source by pictures: Tian et al.
//! 2013, section 5.
//!
//! *Parameters*: see [`SurveySpec`]; the papers print none. With lines 8 m beside the place, a sidescan of 20 m range
//! sees from each line the strip below the other one, where that one is blind, and sees the place itself from two
//! sides; ±30 m is twice the mean error of a declaration there (13 m); 3 m of height is 15 % of the range (sidescans
//! are towed at 10 to 20 %).
//!
//! *Deviations*: what is not printed is ours: the order, the rule; that pictures may be added up (`looks.rs`), which
//! may leave it open whether there is a source; that a vehicle that hovers holds over points (`holds.rs`) for pictures
//! that are added up, or if the place was told. Where each picture is judged by itself and the place is as uncertain as
//! a declared one, standing still would show less than a line, so that all vehicles fly lines. Detections are ignored
//! during a survey. A picture that verifies the source ends the camera's passes. If the declared place and the
//! sidescan's differ, the declaration keeps its own and carries the other.

use super::holds::{Holding, Holds, ViewPlan};
use super::looks::Looks;
use super::spec::{AfterDeclaration, SurveySpec, Verify};
use crate::behave::{Passes, Stride};
use crate::error::RobotError;
use crate::handoff::{Behaviour, Declaration, Observation, Verdict, Vertical};
use crate::places::{MARGIN_M, inside};
use crate::survey::{Object, Waterfall, detect, merge};
use crate::vision::place::PlaceVerdict;
use nalgebra::Vector2;
use smart_default::SmartDefault;
use std::f64::consts::FRAC_PI_2;
use world::units::Heading;

/// Cell of the sidescan's picture, m.
const CELL_M: f64 = 0.25;

/// Result of a step after a declaration.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// Continue with this answer for the guidance.
    Go(Stride),
    /// The survey is over: the declaration again, with its verdict.
    Over(Declaration),
}

/// The passes being flown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum SurveyPhase {
    #[default]
    None,
    Sidescan,
    Camera,
}

/// State of the time after declarations.
#[derive(Debug, SmartDefault)]
pub struct PostDeclaration {
    after: AfterDeclaration,
    /// What the camera has seen; `None` without passes for it.
    looks: Option<Looks>,
    /// Declarations so far.
    made: u32,
    phase: SurveyPhase,
    declaration: Option<Declaration>,
    #[default(Heading::from_deg(0.0))]
    along: Heading,
    flown: ViewPlan,
    /// Whether the places were told, and are not declared by the vehicle itself.
    told: bool,
    /// The line being imaged and its picture.
    line: Option<(usize, Waterfall)>,
    objects: Vec<Object>,
    /// Whether the sidescan saw a source; `None` if it never reported.
    by_sidescan: Option<bool>,
    /// Whether a picture is wanted; and when the last one was asked for, s.
    picture: bool,
    asked_s: Option<f64>,
}

impl PostDeclaration {
    /// # Errors
    /// [`RobotError::Invalid`] if the parts of a survey contradict each other.
    pub fn new(after: &AfterDeclaration) -> Result<Self, RobotError> {
        let mut looks = None;
        if let AfterDeclaration::Survey(spec) = after {
            spec.check("strategy.after_declaration")?;
            looks = spec.camera.as_ref().map(Looks::new);
        }
        Ok(Self { after: after.clone(), looks, ..Self::default() })
    }

    /// The same for told places, which are surer than declared ones.
    #[must_use]
    pub(crate) fn for_told_places(mut self) -> Self {
        self.told = true;
        self
    }

    /// Takes in a declared source; `along` is the direction of the lines, up-flow. Returns the declaration with its
    /// number, and what the vehicle does next: [`Behaviour::Survey`], or the mission's end.
    pub fn enter(&mut self, declaration: Declaration, seen: &Observation, along: Heading) -> (Declaration, Behaviour) {
        let declaration = Declaration { number: self.made, ..declaration };
        self.made += 1;
        let next = match &self.after {
            AfterDeclaration::GoHome => Behaviour::GoHome,
            AfterDeclaration::Stop => Behaviour::Done,
            AfterDeclaration::Survey(_) => Behaviour::Survey,
        };
        self.declaration = Some(declaration);
        self.along = along;
        self.objects.clear();
        self.line = None;
        self.by_sidescan = None;
        self.looks = self.spec().and_then(|s| s.camera.as_ref()).map(Looks::new);
        self.begin(SurveyPhase::Sidescan, declaration.position, seen);
        (declaration, next)
    }

    fn spec(&self) -> Option<&SurveySpec> {
        match &self.after {
            AfterDeclaration::Survey(spec) => Some(spec.as_ref()),
            _ => None,
        }
    }

    fn begin(&mut self, phase: SurveyPhase, place: Vector2<f64>, seen: &Observation) {
        let flown = self.spec().and_then(|s| match phase {
            SurveyPhase::Sidescan => s.sidescan.as_ref().map(|p| (&p.offsets_m, p.half_length_m)),
            SurveyPhase::Camera => s.camera.as_ref().map(|p| (&p.offsets_m, p.half_length_m)),
            SurveyPhase::None => None,
        });
        let offsets = flown.map(|(offsets, half)| {
            let offsets: Vec<f64> = offsets.iter().map(|o| o.get()).collect();
            (offsets, half.get())
        });
        self.phase = phase;
        let holding = self.holding(seen).filter(|_| phase == SurveyPhase::Camera);
        self.flown = match (offsets, holding) {
            (None, _) => ViewPlan::default(),
            (Some((offsets, half_m)), None) => {
                let area = &seen.area;
                ViewPlan::Lines(Passes::over(place, self.along, &offsets, half_m, area))
            }
            (Some((offsets, _)), Some(holding)) => {
                let right = self.along.turned(FRAC_PI_2).unit();
                let points = offsets.iter().map(|o| place + right * *o);
                let points = points.map(|p| inside(&seen.area, p, MARGIN_M)).collect();
                ViewPlan::Points(Holds::new(points, holding))
            }
        };
        if phase == SurveyPhase::Camera
            && let Some(Looks::Added(added)) = &mut self.looks
        {
            added.begin(place, self.along, seen, holding.is_some());
            self.flown = ViewPlan::default();
            self.fly_on(seen);
        }
    }

    /// How points are held; `None` if lines are flown for the camera.
    fn holding(&self, seen: &Observation) -> Option<Holding> {
        let camera = self.spec()?.camera.as_ref()?;
        let worth = self.told || camera.add_up.is_some();
        (seen.able.hovers && worth && camera.held_pictures > 0).then_some(Holding {
            pictures: camera.held_pictures,
            period_s: camera.period_s.get(),
            heading: self.along,
        })
    }

    /// Begins the next line or point that added-up pictures ask for; false if there is none.
    fn fly_on(&mut self, seen: &Observation) -> bool {
        let holding = self.holding(seen);
        let half = self.spec().and_then(|s| s.camera.as_ref());
        let (Some(half_m), Some(Looks::Added(added))) = (half.map(|c| c.half_length_m.get()), &mut self.looks) else {
            return false;
        };
        let next = match holding {
            None => added.next_line(half_m, seen).map(ViewPlan::Lines),
            Some(holding) => (added.next_point(seen)).map(|point| ViewPlan::Points(Holds::new(vec![point], holding))),
        };
        let some = next.is_some();
        self.flown = next.unwrap_or_default();
        some
    }

    /// One tick of the survey. `arrived` says whether the guidance has reached the end of the last line.
    pub fn step(&mut self, seen: &Observation, arrived: bool) -> Progress {
        let Some(declared) = self.declaration else {
            return Progress::Go(Stride::Over);
        };
        self.picture = false;
        let on = self.flown.on(seen, self.vertical());
        match self.phase {
            SurveyPhase::Sidescan => self.image(seen, on),
            SurveyPhase::Camera => self.look(seen, on),
            SurveyPhase::None => {}
        }
        let mut arrived = arrived;
        loop {
            // The camera has seen enough.
            let enough = self.phase == SurveyPhase::Camera && self.looks.as_ref().is_some_and(Looks::enough);
            let stride = if enough { Stride::Over } else { self.flown.step(seen, arrived) };
            if stride != Stride::Over {
                return Progress::Go(stride);
            }
            // The next passes begin even if these had no lines.
            arrived = false;
            let phase = self.phase;
            match phase {
                SurveyPhase::Camera if !enough && self.fly_on(seen) => {}
                SurveyPhase::Sidescan => {
                    self.end_line();
                    let place = self.place(declared.position);
                    let of_source = place.unwrap_or(declared.position);
                    if let Some(d) = &mut self.declaration {
                        d.surveyed = place;
                    }
                    self.begin(SurveyPhase::Camera, of_source, seen);
                }
                SurveyPhase::Camera | SurveyPhase::None => {
                    self.phase = SurveyPhase::None;
                    let verdict = self.verdict();
                    if let (Some(Looks::Added(added)), Some(d)) = (&self.looks, &mut self.declaration) {
                        d.looked = added.evidence();
                        d.surveyed = added.found().or(d.surveyed);
                    }
                    let over = self.declaration.take().unwrap_or(declared);
                    return Progress::Over(Declaration { verdict, ..over });
                }
            }
        }
    }

    /// What the vehicle does after a verdict.
    pub fn next(verdict: Verdict) -> Behaviour {
        match verdict {
            Verdict::Rejected => Behaviour::Find,
            Verdict::Verified | Verdict::Unchecked | Verdict::CannotTell => Behaviour::GoHome,
        }
    }

    /// Height for the passes; `None` while no passes are flown.
    pub fn vertical(&self) -> Option<Vertical> {
        let spec = self.spec()?;
        let altitude = match self.phase {
            SurveyPhase::Sidescan => spec.sidescan.as_ref()?.altitude_m,
            SurveyPhase::Camera => match &self.looks {
                Some(Looks::Added(added)) => return Some(Vertical::Altitude(added.altitude_m())),
                _ => spec.camera.as_ref()?.altitude_m,
            },
            SurveyPhase::None => return None,
        };
        Some(Vertical::Altitude(altitude.get()))
    }

    /// Whether a picture is wanted in this tick.
    pub fn picture(&self) -> bool {
        self.picture
    }

    /// Lost points within this distance of a rejected place are forgotten, m.
    pub fn forget_m(&self) -> f64 {
        self.spec().map_or(0.0, |s| s.forget_m.get())
    }

    fn image(&mut self, seen: &Observation, on: Option<usize>) {
        if self.line.as_ref().map(|(n, _)| *n) != on && self.line.is_some() {
            self.end_line();
        }
        let (Some(number), Some(ping)) = (on, &seen.sidescan) else {
            return;
        };
        let (_, picture) = self.line.get_or_insert_with(|| (number, Waterfall::new(CELL_M)));
        picture.push(ping, &seen.estimate);
    }

    /// Searches the picture of a finished line.
    fn end_line(&mut self) {
        let Some((_, picture)) = self.line.take() else {
            return;
        };
        if let Some(p) = self.spec().and_then(|s| s.sidescan.as_ref()) {
            let found = detect(&picture, &p.detect);
            self.objects.extend(found);
            self.by_sidescan.get_or_insert(false);
        }
    }

    /// The source's place in the sidescan image, if there is an object near enough to the declared place.
    fn place(&mut self, declared: Vector2<f64>) -> Option<Vector2<f64>> {
        let p = self.spec().and_then(|s| s.sidescan.as_ref())?;
        let (within_m, merge_m) = (p.within_m.get(), p.detect.merge_m.get());
        let near = |o: &Object| (o.place - declared).norm() <= within_m;
        let objects: Vec<Object> = self.objects.iter().copied().filter(near).collect();
        let best = merge(&objects, merge_m).first().map(|f| f.place);
        if best.is_some() {
            self.by_sidescan = Some(true);
        }
        best
    }

    fn look(&mut self, seen: &Observation, on: Option<usize>) {
        let Some(period_s) = self.spec().and_then(|s| s.camera.as_ref()).map(|c| c.period_s.get()) else {
            return;
        };
        if seen.picture.is_some() {
            self.flown.took();
        }
        let near = match &mut self.looks {
            Some(Looks::Single(verifier, saw)) => {
                if let Some(picture) = &seen.picture {
                    let verified = verifier.judge(&picture.image).verified;
                    *saw = Some(*saw == Some(true) || verified);
                }
                true
            }
            Some(Looks::Added(added)) => {
                added.follow(seen, on.is_some());
                added.take(seen);
                added.near(seen)
            }
            None => false,
        };
        let due = self.asked_s.is_none_or(|t| seen.t_s - t >= period_s - 1e-9);
        if on.is_some() && due && near {
            self.asked_s = Some(seen.t_s);
            self.picture = true;
        }
    }

    fn verdict(&self) -> Verdict {
        let Some(spec) = self.spec() else {
            return Verdict::Unchecked;
        };
        let by_sidescan = self.by_sidescan.map(|yes| match yes {
            true => PlaceVerdict::Verified,
            false => PlaceVerdict::Rejected,
        });
        let by_camera = self.looks.as_ref().and_then(Looks::answer);
        let says: &[Option<PlaceVerdict>] = match spec.verify {
            Verify::Sidescan => &[by_sidescan],
            Verify::Camera => &[by_camera],
            Verify::Either | Verify::Both => &[by_sidescan, by_camera],
        };
        let some = |a: PlaceVerdict| says.contains(&Some(a));
        let (yes, no) = (some(PlaceVerdict::Verified), some(PlaceVerdict::Rejected));
        let open = some(PlaceVerdict::CannotTell);
        match spec.verify {
            Verify::Both if no => Verdict::Rejected,
            Verify::Both if open => Verdict::CannotTell,
            Verify::Both if says.contains(&None) => Verdict::Unchecked,
            _ if yes => Verdict::Verified,
            _ if open => Verdict::CannotTell,
            _ if no => Verdict::Rejected,
            _ => Verdict::Unchecked,
        }
    }
}
