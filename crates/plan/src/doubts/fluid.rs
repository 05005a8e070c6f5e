//! Fluid that has run beyond the ends of the fault into which it is injected.

use asperity_run::Warning;
use asperity_scene::lengths::brief;
use std::ops::Range;

/// Diffusion length over the distance of the farther end from which most of the fluid is where the model has none of it.
const BEYOND: f64 = 2.0;

/// An injection.
#[derive(Clone, Copy, Debug)]
pub struct Fluid {
    /// Position along the fault \[m\].
    pub at: f64,
    /// Ends of what slides of the fault, along it \[m\].
    pub ends: [f64; 2],
    /// Diffusivity \[m²/s\].
    pub diffusivity: f64,
    /// Duration of the run \[s\].
    pub duration: f64,
}

/// Warning about fluid whose diffusion length 2 √(D t) lies far beyond both ends. The pressure is that of an endless fault: it does not
/// dam up at the ends.
#[must_use]
pub fn fluid(fault: &str, place: Range<usize>, of: Fluid) -> Option<Warning> {
    let length = 2.0 * (of.diffusivity * of.duration).sqrt();
    let farther = (of.at - of.ends[0]).max(of.ends[1] - of.at);
    (length > BEYOND * farther).then(|| {
        let message = format!(
            "in {:e} s fluid spreads over {} along fault `{fault}`, whose farther end is {} from the injection: most of it has run beyond both ends, where the \
             model has an endless fault and no barrier",
            of.duration,
            brief(length),
            brief(farther)
        );
        let help = "a shorter run, a longer fault, or check the unit of `diffusivity` (m^2/s)";
        Warning::at(place, message, help)
    })
}

/// Fluid around a well.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    /// Position of the well along the fault \[m\].
    pub at: f64,
    /// Diffusion length 2 √(D t) until the run ends \[m\].
    pub length: f64,
    /// Size of the cells there \[m\].
    pub size: f64,
}

/// Warning about a well whose fluid stays within its cell; `pressed` says what the pressure of a cell is.
#[must_use]
pub fn narrow(fault: &str, place: Range<usize>, of: Spread, pressed: &str, help: &str) -> Option<Warning> {
    (of.length < of.size).then(|| {
        let message = format!(
            "fluid from the well at {} of fault `{fault}` spreads over {} until the run ends, and cells there have {}: {pressed}",
            brief(of.at),
            brief(of.length),
            brief(of.size)
        );
        Warning::at(place, message, help)
    })
}
