//! Split nodes along y = 0, with the friction of a problem.

use super::super::waves::{Cut, bump, cut};
use super::reference::{Flash, Friction, Parameters};
use crate::CaseError;
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::evolution::flash::{self, Weakening};
use asperity_friction::inertial::{InertialFault, InertialPoints};
use asperity_friction::points::Components;
use asperity_friction::rate::RateLaw;
use asperity_friction::slip_weakening::SlipWeakening;
use asperity_friction::strength::{self, regularised::Regularised};
use asperity_mechanics::Model;
use asperity_mechanics::dynamics::{Fault, Pulse};

/// Static coefficient of the barrier beyond the ends of the fault.
const BARRIER: f64 = 1e4;

/// The fault of a problem on nodes this far apart.
pub(super) fn between(model: &Model<2>, p: &Parameters, spacing: f64) -> Result<Fault, CaseError> {
    let Cut { at, points } = cut(model)?;
    let n = at.len();
    let (rate, pulses) = match &p.friction {
        Friction::SlipWeakening { .. } => (0.0, Vec::new()),
        Friction::RateAndState { rate, pulse, .. } => (
            *rate,
            vec![Pulse {
                amplitude: at.iter().map(|x| pulse.traction * bump(*x, pulse.radius)).collect(),
                rise: pulse.rise,
            }],
        ),
    };
    Ok(Fault {
        points,
        law: law(p, &at)?,
        normal: vec![p.normal; n],
        shear: Components::new(at.iter().map(|x| shear(p, *x, spacing)).collect(), n),
        rate: Components::new(vec![rate; n], n),
        opens: false,
        regularisation: None,
        pulses,
        forced: Vec::new(),
        onset: None,
        ties: Vec::new(),
    })
}

/// Initial traction: that of the patches, and the mean of both at a node on a border.
fn shear(p: &Parameters, x: f64, spacing: f64) -> f64 {
    let share = |[centre, half, _]: &[f64; 3]| (0.5 + (half - (x - centre).abs()) / spacing).clamp(0.0, 1.0);
    p.shear + p.patches.iter().map(|patch| share(patch) * (patch[2] - p.shear)).sum::<f64>()
}

/// Smooth step from 1 within W to 0 beyond W + w.
fn inside([wide, border]: [f64; 2], x: f64) -> f64 {
    let x = x.abs();
    if x <= wide {
        1.0
    } else if x >= wide + border {
        0.0
    } else {
        0.5 * (1.0 + (border / (x - wide - border) + border / (x - wide)).tanh())
    }
}

fn law(p: &Parameters, at: &[f64]) -> Result<Box<dyn InertialFault>, CaseError> {
    let form = |a: f64| Ok::<_, CaseError>(Regularised(strength::Parameters::new(p.f0, a, p.v0)?));
    Ok(match p.friction {
        Friction::SlipWeakening { mu_s, mu_d, length, half_length } => {
            let of = |x: &f64| {
                // Points at the very ends do not slip.
                let static_one = if x.abs() < half_length { mu_s } else { BARRIER };
                SlipWeakening::new(static_one, mu_d, length, None)
            };
            Box::new(InertialPoints(at.iter().map(of).collect::<Result<Vec<_>, _>>()?))
        }
        Friction::RateAndState { a, more_a, b, length, flash, rate, .. } => {
            let a = |x: f64| a + more_a * (1.0 - inside(p.border, x));
            match flash {
                None => {
                    let of =
                        |x: &f64| Ok(RateLaw::new(form(a(*x))?, Ageing::new(b, length, p.v0)?, rate, None)?);
                    Box::new(InertialPoints(at.iter().map(of).collect::<Result<Vec<_>, CaseError>>()?))
                }
                Some(Flash { v_w, more_v_w, f_w }) => {
                    let of = |x: &f64| {
                        let v_w = v_w + more_v_w * (1.0 - inside(p.border, *x));
                        let steady = Weakening { mu0: p.f0, a: a(*x), b, v_ref: p.v0, mu_w: f_w, v_w };
                        Ok(RateLaw::new(form(a(*x))?, flash::Flash::new(steady, length)?, rate, None)?)
                    };
                    Box::new(InertialPoints(at.iter().map(of).collect::<Result<Vec<_>, CaseError>>()?))
                }
            }
        }
    })
}
