//! Shear tractions that are imposed on faults.

use super::placed_point::PlacedPoint;
use crate::doubts::PulsePoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Pulse as Asked};
use crate::shared::entry::Entry;
use asperity_cycles::Fault;
use asperity_run::Warning;

/// Returns the amplitude of each pulse at all points, component by component of slip \[Pa\], and the duration of its growth \[s\].
///
/// # Errors
/// [`Diagnostic`] where a pulse acts on no point that slides.
pub(crate) fn pulses<const D: usize>(
    named: &[Entry<'_, Spec>],
    placed: &[PlacedPoint<D>],
    components: usize,
) -> Result<Vec<(Vec<f64>, f64)>, Diagnostic> {
    let mut all = Vec::new();
    for (fault, Entry { name, spec }) in named.iter().enumerate() {
        for asked in &spec.pulses {
            let traction = asked.traction.get_ref().0;
            let at = |p: &PlacedPoint<D>| {
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

/// Doubts about each pulse of a run of this duration \[s\], given all points; `pushed` has what counts of a point beside the amplitude.
pub(crate) fn doubts<'a>(
    named: &[Entry<'_, Spec>],
    amplitudes: impl Iterator<Item = &'a [f64]>,
    pushed: &[PulsePoint],
    run: f64,
) -> Vec<Warning> {
    let asked = named.iter().flat_map(|fault| &fault.spec.pulses);
    let doubt = |(asked, amplitude): (&Asked, &[f64])| {
        let points = amplitude.iter().enumerate();
        crate::doubts::pulse(
            asked,
            points.map(|(i, a)| PulsePoint { amplitude: *a, ..pushed[i % pushed.len()] }),
            run,
        )
    };
    asked.zip(amplitudes).filter_map(doubt).collect()
}

/// State of the points of faults in equilibrium, as far as it counts for pulses.
pub(super) fn at_rest(fault: &Fault) -> Vec<PulsePoint> {
    let of = |p: usize| PulsePoint {
        amplitude: 0.0,
        normal: fault.normal[p],
        direct: Some(fault.law.scale(p) * fault.normal[p]),
        strength: None,
        // Slip has the years of a cycle.
        begins: None,
    };
    (0..fault.normal.len()).map(of).collect()
}

/// Direction of slip of a point: that of its slip rate, or of its shear traction where it starts at rest.
fn sense<const D: usize>(placed: &PlacedPoint<D>) -> f64 {
    let of = if placed.rate == 0.0 { placed.shear.unwrap_or_default() } else { placed.rate };
    of.signum()
}

/// Share of the traction of a pulse at a distance r from its centre, exp(r²/(r² - R²)) within R.
fn shape<const D: usize>(asked: &Asked, at: &[f64; D]) -> f64 {
    let square: f64 = at.iter().zip(asked.centre.get_ref()).map(|(x, c)| (x - c.0).powi(2)).sum();
    let limit = asked.radius.get_ref().0.powi(2);
    if square < limit { (square / (square - limit)).exp() } else { 0.0 }
}
