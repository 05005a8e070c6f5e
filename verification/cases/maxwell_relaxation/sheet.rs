//! Sheets of Maxwell material in plane stress under held strain: they thin while they relax.

use crate::cases::body::{self, Body, Entry, Work};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::nonlinear::Kinematics;

use super::{BULK, SHEAR, TIME, fluid};

/// Strain along x, held from the start on.
const HELD: f64 = 0.02;
/// Time of holding.
const END: f64 = 2.0 * TIME;
const STEPS: [usize; 4] = [4, 8, 16, 32];
/// The error of a step: the square of its length over the time of relaxation, over twelve.
const FINEST: f64 = (END / TIME / 32.0) * (END / TIME / 32.0) / 12.0;
const OF_FINEST: &str = "the square of the step over the relaxation time, over twelve: the error of a rate held over the step in an exponential";

/// Condition that determines the strain across the sheet.
#[derive(Clone, Copy, PartialEq)]
enum Sides {
    /// No strain along y.
    Held,
    /// No stress along y.
    Free,
}

/// Stresses along x and y at time `t`.
///
/// With G replaced by G s/(s + 1/T), sigma_zz = 0 gives the strain through the thickness, and sigma_ii = 2 G s/(s + 1/T)
/// (e_ii - e_zz). Transformed back, e_zz tends to that of an incompressible sheet with the rate b.
fn exact(sides: Sides, t: f64) -> [f64; 2] {
    let a = TIME.recip();
    match sides {
        Sides::Held => {
            let stiff = BULK + 4.0 * SHEAR / 3.0;
            let (late, b) = (2.0 * SHEAR / stiff, a * BULK / stiff);
            let (along, slow) = ((-a * t).exp(), (-b * t).exp());
            let thinning = late * (a * along - b * slow) / (a - b);
            [2.0 * SHEAR * HELD * (2.0 * along - thinning), 2.0 * SHEAR * HELD * (along - thinning)]
        }
        Sides::Free => {
            let soft = 3.0 * BULK + SHEAR;
            let young = 9.0 * BULK * SHEAR / soft;
            [young * HELD * (-3.0 * BULK / soft * a * t).exp(), 0.0]
        }
    }
}

/// A square sheet, its prescribed displacements when strained, and the ones held from then on.
fn sheet(sides: Sides) -> Result<(Body<2>, Vec<Entry>), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2; 2])?;
    let mesh = body::distorted(mesh, [1.0; 2], 0.5, 0.2);
    let mut held: Vec<Entry> = body::side(&mesh, "left")?.iter().map(|n| (2 * n, 0.0)).collect();
    held.extend(body::side(&mesh, "right")?.iter().map(|n| (2 * n, HELD)));
    held.extend(body::side(&mesh, "bottom")?.iter().map(|n| (2 * n + 1, 0.0)));
    if sides == Sides::Held {
        held.extend(body::side(&mesh, "top")?.iter().map(|n| (2 * n + 1, 0.0)));
    }
    let options = body::model(fluid()?, Idealisation::PlaneStress, Kinematics::Small);
    Ok((Body::new(mesh, options, &body::dofs(&held))?, held))
}

/// Stress along x and y of a point after `steps` steps, with Newton's method or in forward steps.
fn relaxed(sides: Sides, steps: usize, forward: bool) -> Result<([f64; 2], Work), CaseError> {
    let (mut body, held) = sheet(sides)?;
    let dt = END / steps as f64;
    // Forces are 0.05; rounding of stiffness times displacement leaves 1e-17.
    let balanced = 1e-15;
    if forward {
        body.forward(&held, &[], 0.0)?;
        for _ in 0..steps {
            body.forward(&[], &[], dt)?;
        }
    } else {
        body.implicit(&held, &[], 0.0, balanced, None)?;
        for _ in 0..steps {
            body.implicit(&held, &[], dt, balanced, None)?;
        }
    }
    let s = body.block.stress_at_points()[5];
    Ok(([s[0], s[1]], body.work))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let how = |forward| if forward { "forward steps" } else { "implicit steps" };
    for (sides, named) in [(Sides::Held, "no strain across"), (Sides::Free, "free sides")] {
        let mut finest = Vec::new();
        for forward in [false, true] {
            let (mut levels, mut last) = (Vec::new(), Cost::default());
            let exact = exact(sides, END);
            let start = self::exact(sides, 0.0)[0];
            for steps in STEPS {
                let (outcome, cost) = Cost::measure(|| relaxed(sides, steps, forward));
                let (found, work) = outcome?;
                let error = (found[0] - exact[0]).hypot(found[1] - exact[1]) / start;
                levels.push(((steps as f64).recip(), error));
                last = cost.counts(&work);
                if steps == STEPS[0] {
                    finest.push(found);
                }
            }
            ledger
                .order(format!("stress of a sheet in plane stress at held strain over 2 relaxation times, {named}, over that at the start, {}", how(forward)))
                .levels(&levels)
                .expected(2.0)
                .within(0.05)
                .finest(FINEST, OF_FINEST)
                .evidence(Evidence::Exact, "elastic sheet with G s/(s + 1/T), transformed back")
                .because("the strain rate through the thickness varies and is held over a step: order 2")
                .why_not_tighter("only the strain through the thickness varies, which is a part of the strain")
                .covers(&[Capability::Viscoelasticity, Capability::PlaneStress])
                .cost(&last)
                .record();
        }
        ledger
            .claim(format!("stress of a sheet in plane stress, {named}, 4 forward steps less 4 implicit ones, over G times the strain"))
            .values(&finest[1].map(|s| s / (SHEAR * HELD)))
            .equals_each(&finest[0].map(|s| s / (SHEAR * HELD)))
            .absolute(1e-13)
            .evidence(Evidence::Exact, "a step of a linear body is one linear system for both")
            .between(how(false), how(true))
            .because("rounding; forces are balanced to 1e-15 of 5e-2")
            .why_not_tighter("a few roundings of 1e-16 add up in each step")
            .covers(&[Capability::Viscoelasticity, Capability::PlaneStress])
            .record();
        for forward in [false, true] {
            let (start, _) = start(sides, forward)?;
            ledger
                .claim(format!("stress of a sheet in plane stress at the moment of straining, {named}, over G times the strain, {}", how(forward)))
                .values(&start.map(|s| s / (SHEAR * HELD)))
                .equals_each(&exact(sides, 0.0).map(|s| s / (SHEAR * HELD)))
                .absolute(1e-13)
                .evidence(Evidence::Exact, "elastic sheet")
                .because("a uniform strain lies in the space of elements; forces are balanced to 1e-15 of 5e-2")
                .why_not_tighter("rounding")
                .covers(&[Capability::Viscoelasticity, Capability::PlaneStress])
                .record();
        }
    }
    Ok(())
}

/// Stress along x and y at the moment of straining.
fn start(sides: Sides, forward: bool) -> Result<([f64; 2], Work), CaseError> {
    let (mut body, held) = sheet(sides)?;
    if forward {
        body.forward(&held, &[], 0.0)?;
    } else {
        body.implicit(&held, &[], 0.0, 1e-15, None)?;
    }
    let s = body.block.stress_at_points()[5];
    Ok(([s[0], s[1]], body.work))
}
