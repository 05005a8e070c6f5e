//! Shear tractions that are imposed on faults.

use super::placed::Placed;
use crate::diagnostic::Diagnostic;
use crate::scene::model::{Fault as Spec, Pulse as Asked};
use crate::warning::Warning;
use asperity_cycles::{Fault, Pulse};

/// Returns the amplitude of each pulse at all points, component by component of slip \[Pa\], and the duration of its growth \[s\].
///
/// # Errors
/// [`Diagnostic`] where a pulse acts on no point that slides.
pub(crate) fn pulses<const D: usize>(
    named: &[(&String, &Spec)],
    placed: &[Placed<D>],
    components: usize,
) -> Result<Vec<(Vec<f64>, f64)>, Diagnostic> {
    let mut all = Vec::new();
    for (fault, (name, spec)) in named.iter().enumerate() {
        for asked in &spec.pulses {
            let traction = asked.traction.get_ref().0;
            let at = |p: &Placed<D>| {
                if p.fault == fault { traction * sense(p) * shape(asked, &p.point.place.at) } else { 0.0 }
            };
            let mut amplitude = vec![0.0; components * placed.len()];
            amplitude.iter_mut().zip(placed).for_each(|(amplitude, p)| *amplitude = at(p));
            if amplitude.iter().all(|a| *a == 0.0) {
                return Err(Diagnostic::at(
                    asked.centre.span(),
                    format!("the pulse acts on no point of fault `{name}`"),
                    "check the signs and the unit of its centre, and its radius",
                ));
            }
            all.push((amplitude, asked.duration.get_ref().0));
        }
    }
    Ok(all)
}

/// Effect of a pulse on ln V below which it is doubtful.
const WEAK: f64 = 0.01;
/// Points that a pulse acts on, below which its shape is not resolved.
const FEW: usize = 3;

/// A warning for each pulse that hardly changes slip rates, that no friction holds, or that acts on hardly any point.
pub(super) fn doubts(named: &[(&String, &Spec)], fault: &Fault) -> Vec<Warning> {
    let asked = named.iter().flat_map(|(_, spec)| &spec.pulses);
    asked.zip(&fault.pulses).filter_map(|(asked, pulse)| doubt(asked, pulse, fault)).collect()
}

fn doubt(asked: &Asked, pulse: &Pulse, fault: &Fault) -> Option<Warning> {
    let points = fault.normal.len();
    let over = |scale: &dyn Fn(usize) -> f64| {
        let all = pulse.amplitude.iter().enumerate();
        all.map(|(i, amplitude)| amplitude.abs() / scale(i % points)).fold(0.0, f64::max)
    };
    // ln V changes by the traction over a f_n at most.
    let effect = over(&|p| fault.law.scale(p) * fault.normal[p]);
    let friction = over(&|p| fault.normal[p]);
    let acts = pulse.amplitude.iter().filter(|a| **a != 0.0).count();
    let traction = asked.traction.get_ref().0;
    let unit = "check its unit, such as `traction = \"1.75 MPa\"`, and that of `normal`";
    let (place, words, help) = if effect < WEAK {
        let words = format!(
            "the pulse of {traction:e} Pa hardly changes slip rates: by a factor of 1 + {effect:.1e} where its effect is largest"
        );
        (asked.traction.span(), words, unit)
    } else if friction > 1.0 {
        let words = format!(
            "the pulse of {traction:e} Pa is up to {friction:.2} times the normal traction: no friction holds it"
        );
        (asked.traction.span(), words, unit)
    } else if acts < FEW {
        let words = format!("the pulse acts on {acts} of the points, too few for its shape");
        (asked.radius.span(), words, "check the unit of its `radius`; or take smaller cells")
    } else {
        return None;
    };
    Some(Warning::at(place, words, help))
}

/// Sense of slip of a point: that of its slip rate, or of its shear traction where it starts at rest.
fn sense<const D: usize>(placed: &Placed<D>) -> f64 {
    let of = if placed.rate == 0.0 { placed.shear.unwrap_or_default() } else { placed.rate };
    of.signum()
}

/// Share of the traction of a pulse at a distance r from its centre, exp(r²/(r² - R²)) within R.
fn shape<const D: usize>(asked: &Asked, at: &[f64; D]) -> f64 {
    let square: f64 = at.iter().zip(asked.centre.get_ref()).map(|(x, c)| (x - c.0).powi(2)).sum();
    let limit = asked.radius.get_ref().0.powi(2);
    if square < limit { (square / (square - limit)).exp() } else { 0.0 }
}
