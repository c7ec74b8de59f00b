//! The time after declarations: their numbers, and what the vehicle does next.

use super::eyes::{Eyes, Progress, Survey};
use super::spec::AfterDeclaration;
use crate::behave::Stride;
use crate::error::RobotError;
use crate::handoff::{Behaviour, Declaration, Observation, Verdict, Vertical};
use world::units::Heading;

/// State of the time after declarations.
#[derive(Debug)]
pub struct PostDeclaration {
    /// What the vehicle does after a declaration.
    next: Behaviour,
    forget_m: f64,
    /// Declarations so far.
    made: u32,
    survey: Option<Box<dyn Survey>>,
}

impl PostDeclaration {
    /// Of places that the vehicle declares itself, or that were `told`, which are surer.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the parts of a survey contradict each other.
    pub fn new(after: &AfterDeclaration, eyes: &dyn Eyes, told: bool) -> Result<Self, RobotError> {
        let flown = match after {
            AfterDeclaration::Survey(spec) => Some(spec),
            AfterDeclaration::GoHome | AfterDeclaration::Stop => None,
        };
        flown.map_or(Ok(()), |spec| spec.check("strategy.after_declaration"))?;
        Ok(Self {
            next: match after {
                AfterDeclaration::GoHome => Behaviour::GoHome,
                AfterDeclaration::Stop => Behaviour::Done,
                AfterDeclaration::Survey(_) => Behaviour::Survey,
            },
            forget_m: flown.map_or(0.0, |spec| spec.forget_m.get()),
            made: 0,
            survey: flown.map(|spec| eyes.survey(spec, told)),
        })
    }

    /// Takes in a declared source; `along` is the direction of the lines, up-flow. Returns the declaration with its
    /// number, and what the vehicle does next: [`Behaviour::Survey`], or the mission's end.
    pub fn enter(&mut self, declaration: Declaration, seen: &Observation, along: Heading) -> (Declaration, Behaviour) {
        let declaration = Declaration { number: self.made, ..declaration };
        self.made += 1;
        if let Some(survey) = &mut self.survey {
            survey.enter(declaration, seen, along);
        }
        (declaration, self.next)
    }

    /// One tick of the survey. `arrived` says whether the guidance has reached the end of the last line.
    pub fn step(&mut self, seen: &Observation, arrived: bool) -> Progress {
        self.survey.as_mut().map_or(Progress::Go(Stride::Over), |survey| survey.step(seen, arrived))
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
        self.survey.as_ref()?.vertical()
    }

    /// Whether a picture is wanted in this tick.
    pub fn picture(&self) -> bool {
        self.survey.as_ref().is_some_and(|survey| survey.picture())
    }

    /// Lost points within this distance of a rejected place are forgotten, m.
    pub fn forget_m(&self) -> f64 {
        self.forget_m
    }
}
