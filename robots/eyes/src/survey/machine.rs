//! Passes with the sidescan, then with the camera, and their verdict on a declared place.
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
use crate::sidescan::{Object, Waterfall, detect, merge};
use nalgebra::Vector2;
use robots::behave::{Passes, Stride};
use robots::handoff::{Declaration, Observation, Verdict, Vertical};
use robots::places::{MARGIN_M, inside};
use robots::strategy::{Progress, Survey, SurveySpec, Verify};
use smart_default::SmartDefault;
use std::f64::consts::FRAC_PI_2;
use world::ranges::{Finite, Positive};
use world::units::Heading;

/// The passes being flown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum SurveyPhase {
    #[default]
    Sidescan,
    Camera,
}

/// A survey that is flown.
#[derive(Debug, SmartDefault)]
pub struct SurveyFlight {
    spec: SurveySpec,
    /// Whether the places were told, and are not declared by the vehicle itself.
    told: bool,
    /// What the camera has seen; `None` before its passes, and without any.
    looks: Option<Looks>,
    phase: SurveyPhase,
    /// The place that is surveyed; `None` while no passes are flown.
    declaration: Option<Declaration>,
    #[default(Heading::from_deg(0.0))]
    along: Heading,
    flown: ViewPlan,
    /// The line being imaged and its picture.
    line: Option<(usize, Waterfall)>,
    objects: Vec<Object>,
    /// What the sidescan says; unchecked if it never reported.
    by_sidescan: Verdict,
    /// Whether a picture is wanted; and when the last one was asked for, s.
    picture: bool,
    asked_s: Option<f64>,
}

impl SurveyFlight {
    /// Of places that the vehicle declares, or that it was `told`, which are surer.
    pub fn new(spec: &SurveySpec, told: bool) -> Self {
        Self { spec: spec.clone(), told, ..Self::default() }
    }

    /// Lines over a place, or points if some are held.
    fn passes(
        &self,
        place: Vector2<f64>,
        (offsets_m, half_length_m): (&[Finite], Positive),
        holding: Option<Holding>,
        seen: &Observation,
    ) -> ViewPlan {
        let offsets: Vec<f64> = offsets_m.iter().map(|o| o.get()).collect();
        let Some(holding) = holding else {
            return ViewPlan::Lines(Passes::over(place, self.along, &offsets, half_length_m.get(), &seen.area));
        };
        let right = self.along.turned(FRAC_PI_2).unit();
        let points = offsets.iter().map(|o| inside(&seen.area, place + right * *o, MARGIN_M)).collect();
        ViewPlan::Points(Holds::new(points, holding))
    }

    fn begin_sidescan(&mut self, place: Vector2<f64>, seen: &Observation) {
        self.phase = SurveyPhase::Sidescan;
        let lines = self.spec.sidescan.as_ref().map(|p| (&p.offsets_m[..], p.half_length_m));
        self.flown = lines.map_or_else(ViewPlan::default, |lines| self.passes(place, lines, None, seen));
    }

    fn begin_camera(&mut self, place: Vector2<f64>, seen: &Observation) {
        self.phase = SurveyPhase::Camera;
        let holding = self.holding(seen);
        let held = holding.is_some();
        self.looks = self.spec.camera.as_ref().map(|c| Looks::begin(c, place, self.along, seen, held));
        if let Some(Looks::Added(_)) = self.looks {
            self.fly_on(seen);
        } else {
            let lines = self.spec.camera.as_ref().map(|p| (&p.offsets_m[..], p.half_length_m));
            self.flown = lines.map_or_else(ViewPlan::default, |lines| self.passes(place, lines, holding, seen));
        }
    }

    /// How points are held; `None` if lines are flown for the camera.
    fn holding(&self, seen: &Observation) -> Option<Holding> {
        let camera = self.spec.camera.as_ref()?;
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
        let (Some(camera), Some(Looks::Added(added))) = (&self.spec.camera, &mut self.looks) else {
            return false;
        };
        let next = match holding {
            None => added.next_line(camera.half_length_m.get(), seen).map(ViewPlan::Lines),
            Some(holding) => (added.next_point(seen)).map(|point| ViewPlan::Points(Holds::new(vec![point], holding))),
        };
        let some = next.is_some();
        self.flown = next.unwrap_or_default();
        some
    }

    fn image(&mut self, seen: &Observation, on: Option<usize>) {
        if self.line.as_ref().map(|(n, _)| *n) != on && self.line.is_some() {
            self.end_line();
        }
        let (Some(number), Some(ping)) = (on, &seen.sidescan) else {
            return;
        };
        let (_, picture) = self.line.get_or_insert_with(|| (number, Waterfall::default()));
        picture.push(ping, &seen.estimate);
    }

    /// Searches the picture of a finished line.
    fn end_line(&mut self) {
        if let (Some((_, picture)), Some(p)) = (self.line.take(), &self.spec.sidescan) {
            self.objects.extend(detect(&picture, &p.detect));
            if self.by_sidescan == Verdict::Unchecked {
                self.by_sidescan = Verdict::Rejected;
            }
        }
    }

    /// The source's place in the sidescan image, if there is an object near enough to the declared place.
    fn place(&mut self, declared: Vector2<f64>) -> Option<Vector2<f64>> {
        let p = self.spec.sidescan.as_ref()?;
        let near = |o: &Object| (o.place - declared).norm() <= p.within_m.get();
        let objects: Vec<Object> = self.objects.iter().copied().filter(near).collect();
        let best = merge(&objects, p.detect.merge_m.get()).first().map(|f| f.place);
        if best.is_some() {
            self.by_sidescan = Verdict::Verified;
        }
        best
    }

    fn look(&mut self, seen: &Observation, on: Option<usize>) {
        let Some(period_s) = self.spec.camera.as_ref().map(|c| c.period_s.get()) else {
            return;
        };
        if seen.picture.is_some() {
            self.flown.took();
        }
        let near = self.looks.as_mut().is_some_and(|looks| looks.step(seen, on.is_some()));
        let due = self.asked_s.is_none_or(|t| seen.t_s - t >= period_s - 1e-9);
        if on.is_some() && due && near {
            self.asked_s = Some(seen.t_s);
            self.picture = true;
        }
    }

    fn verdict(&self) -> Verdict {
        let by_camera = self.looks.as_ref().map_or(Verdict::Unchecked, Looks::answer);
        let says: &[Verdict] = match self.spec.verify {
            Verify::Sidescan => &[self.by_sidescan],
            Verify::Camera => &[by_camera],
            Verify::Either | Verify::Both => &[self.by_sidescan, by_camera],
        };
        // The first of these that an instrument says.
        let order = match self.spec.verify {
            Verify::Both => [Verdict::Rejected, Verdict::CannotTell, Verdict::Unchecked, Verdict::Verified],
            _ => [Verdict::Verified, Verdict::CannotTell, Verdict::Rejected, Verdict::Unchecked],
        };
        order.into_iter().find(|verdict| says.contains(verdict)).unwrap_or_default()
    }
}

impl Survey for SurveyFlight {
    fn enter(&mut self, declaration: Declaration, seen: &Observation, along: Heading) {
        self.declaration = Some(declaration);
        self.along = along;
        self.objects.clear();
        self.line = None;
        self.by_sidescan = Verdict::Unchecked;
        self.looks = None;
        self.begin_sidescan(declaration.position, seen);
    }

    fn step(&mut self, seen: &Observation, arrived: bool) -> Progress {
        let Some(declared) = self.declaration else {
            return Progress::Go(Stride::Over);
        };
        self.picture = false;
        let on = self.flown.on(seen, self.vertical());
        match self.phase {
            SurveyPhase::Sidescan => self.image(seen, on),
            SurveyPhase::Camera => self.look(seen, on),
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
                    self.declaration = Some(Declaration { surveyed: place, ..declared });
                    self.begin_camera(place.unwrap_or(declared.position), seen);
                }
                SurveyPhase::Camera => {
                    let mut over = self.declaration.take().unwrap_or(declared);
                    over.verdict = self.verdict();
                    if let Some(Looks::Added(added)) = &self.looks {
                        over.looked = Some(added.evidence());
                        over.surveyed = added.found().or(over.surveyed);
                    }
                    return Progress::Over(over);
                }
            }
        }
    }

    fn vertical(&self) -> Option<Vertical> {
        self.declaration?;
        let altitude_m = match (self.phase, &self.looks) {
            (SurveyPhase::Sidescan, _) => self.spec.sidescan.as_ref()?.altitude_m.get(),
            (SurveyPhase::Camera, Some(Looks::Added(added))) => added.altitude_m(),
            (SurveyPhase::Camera, _) => self.spec.camera.as_ref()?.altitude_m.get(),
        };
        Some(Vertical::Altitude(altitude_m))
    }

    fn picture(&self) -> bool {
        self.picture
    }
}
