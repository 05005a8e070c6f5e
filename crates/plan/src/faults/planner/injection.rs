//! Fluid injected into faults, whose pressure has a closed form.

use super::placed_point::PlacedPoint;
use super::wells::{FluidReach, WellSpec};
use crate::doubts::{Fluid, Spread};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Injection as Given, Scene};
use asperity_cycles::{Injection, Pressure};
use asperity_run::Warning;

/// Injection into all faults in a run that ends at `end` \[s\].
///
/// # Errors
/// [`Diagnostic`] at a well beyond what slides of its fault.
pub(super) fn injection<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    end: f64,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Pressure>, Diagnostic> {
    let mut all: Option<Pressure> = None;
    for (fault, (name, spec)) in scene.faults.iter().enumerate() {
        let Some(wells) = &spec.injection else { continue };
        let first = placed.partition_point(|p| p.fault < fault);
        let points = placed[first..].iter().take_while(|p| p.fault == fault);
        let (along, sizes): (Vec<f64>, Vec<f64>) = points.map(|p| (p.point.place.along, p.spacing)).unzip();
        let ends = along.iter().fold([f64::INFINITY, 0.0_f64], |[l, h], s| [l.min(*s), h.max(*s)]);
        let mut steps = Vec::new();
        for well in &wells.0 {
            let spec = WellSpec::from(well);
            let at = spec.within(name, ends)?;
            let injection = injected(well, spec.steps());
            warnings.extend(spec.idle(name, end));
            let nearest = |a: &usize, b: &usize| (along[*a] - at).abs().total_cmp(&(along[*b] - at).abs());
            let size = (0..along.len()).min_by(nearest).map_or(0.0, |k| sizes[k]);
            warnings.extend(narrow(name, well, &injection, (Spread { at, length: 0.0, size }, end)));
            steps.extend(injection.flux.iter().copied());
            all.get_or_insert_default().add(injection, first, along.iter().map(|s| s - at).collect());
        }
        warnings.extend(spread((name, &wells.0), ends, end));
        if let Some(pressure) = &all {
            let help = "check the units of `flux`, `diffusivity` and `compressibility`; or give the fault a `normal_floor`";
            let reach = FluidReach { fault: name, place: wells.span(), help, pressure, steps, end };
            warnings.extend(reach.lifted(placed, first));
        }
    }
    Ok(all)
}

/// Warning about a well whose fluid hardly reaches a point until the run ends, at `end` \[s\].
fn narrow(name: &str, well: &Given, injection: &Injection, (spread, end): (Spread, f64)) -> Option<Warning> {
    let begin = injection.flux.iter().find(|step| step.1 != 0.0).filter(|step| step.0 < end)?.0;
    let length = 2.0 * (injection.diffusivity * (end - begin)).sqrt();
    let help = "smaller cells; or check the unit of `diffusivity` (m^2/s)";
    let pressed = "between their centres, where pressure is taken, there may be far more";
    crate::doubts::narrow(name, well.at.span(), Spread { length, ..spread }, pressed, help)
}

/// Flow of a well: these steps of its flux.
fn injected(well: &Given, flux: Vec<(f64, f64)>) -> Injection {
    Injection {
        flux,
        diffusivity: *well.diffusivity.get_ref(),
        porosity: *well.porosity.get_ref(),
        compressibility: *well.compressibility.get_ref(),
    }
}

/// Warning about the first well of a fault whose fluid has run beyond the ends of what slides before the run ends \[s\].
fn spread((name, wells): (&str, &[Given]), ends: [f64; 2], end: f64) -> Option<Warning> {
    wells.iter().find_map(|well| {
        let at = well.at.get_ref().0;
        let fluid = Fluid { at, ends, diffusivity: *well.diffusivity.get_ref(), duration: end };
        crate::doubts::fluid(name, well.diffusivity.span(), fluid)
    })
}
