//! Wells on faults: what flows from them, and doubts that all fluid shares.

use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Flux, Injection, Spanned, Well};
use crate::reading::scene::units::{Length, Time};
use asperity_cycles::PorePressure;
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use asperity_scene::lengths::brief;
use std::ops::Range;

/// A well as scenes give it, whatever its fluid does.
#[derive(Clone, Copy)]
pub(super) struct WellSpec<'a> {
    at: &'a Spanned<Length>,
    flux: &'a Spanned<Flux>,
    until: Option<&'a Spanned<Time>>,
}

impl<'a> From<&'a Injection> for WellSpec<'a> {
    fn from(well: &'a Injection) -> Self {
        Self { at: &well.at, flux: &well.flux, until: well.until.as_ref() }
    }
}

impl<'a> From<&'a Well> for WellSpec<'a> {
    fn from(well: &'a Well) -> Self {
        Self { at: &well.at, flux: &well.flux, until: well.until.as_ref() }
    }
}

impl WellSpec<'_> {
    /// Times \[s\] from which its flux has a value \[m/s\].
    pub fn steps(&self) -> Vec<(f64, f64)> {
        match self.flux.get_ref() {
            Flux::Steps(steps) => steps.to_vec(),
            Flux::Constant(flux) => {
                let end = self.until.map(|t| (t.get_ref().0, 0.0));
                std::iter::once((0.0, *flux)).chain(end).collect()
            }
        }
    }

    /// Position along the fault, between the ends of what slides of it \[m\].
    ///
    /// # Errors
    /// [`Diagnostic`] at a position beyond them.
    pub fn within(&self, fault: &str, [low, high]: [f64; 2]) -> Result<f64, Diagnostic> {
        let at = self.at.get_ref().0;
        if low <= at && at <= high {
            return Ok(at);
        }
        Err(Diagnostic::at(
            self.at.span(),
            format!("fault `{fault}` does not slide at {at} m along it, where fluid is injected"),
            format!("it slides from {low} to {high} m"),
        ))
    }

    /// Warning about a well that begins when the run has ended.
    pub fn idle(&self, fault: &str, end: f64) -> Option<Warning> {
        let begin = self.steps().into_iter().find(|step| step.1 != 0.0)?.0;
        let at = brief(self.at.get_ref().0);
        let message = format!(
            "the well at {at} of fault `{fault}` begins after the end of the run, which is at {end:e} s"
        );
        let help = "check the unit of its times, which count from the start of the run";
        (begin >= end).then(|| Warning::at(self.flux.span(), message, help))
    }
}

/// Fluid on a fault until the end of a run.
pub(super) struct FluidReach<'a> {
    pub fault: &'a str,
    /// Place of its wells in the scene.
    pub place: Range<usize>,
    pub help: &'static str,
    pub pressure: &'a dyn PorePressure,
    /// Steps of the fluxes of all wells: times \[s\] and values \[m/s\].
    pub steps: Vec<(f64, f64)>,
    /// End of the run \[s\].
    pub end: f64,
}

impl FluidReach<'_> {
    /// Warning about a fault, whose first point is `first`, if its fluid takes all of its normal traction at a change of a flux or at
    /// the end.
    pub fn lifted<const D: usize>(self, placed: &[PlacedPoint<D>], first: usize) -> Option<Warning> {
        let times = self.steps.iter().map(|step| step.0).filter(|t| *t < self.end);
        let mut times: Vec<f64> = times.chain([self.end]).collect();
        times.sort_by(f64::total_cmp);
        let fault = placed.get(first)?.fault;
        let (time, point, pressure) = times.into_iter().find_map(|time| {
            let felt = self.pressure.at(time, placed.len());
            let own = placed.iter().zip(felt).skip(first).take_while(|(p, _)| p.fault == fault);
            let lifted = own.filter(|(p, felt)| *felt > p.normal && p.floor.is_none());
            lifted.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(point, felt)| (time, point, felt))
        })?;
        let message = format!(
            "after {time:e} s fluid presses with {pressure:.4e} Pa on fault `{}` at {}, whose normal traction at the start is {:.4e} Pa: the run would end there",
            self.fault,
            coordinates::in_words(&point.point.place.at),
            point.normal
        );
        Some(Warning::at(self.place, message, self.help))
    }
}
