//! A pad that is turned on a plate by a right angle.

use super::MEASURES;
use crate::cases::texts::simulate;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;
use std::f64::consts::FRAC_PI_2;

const SCENE: &str = include_str!("twist.toml");
/// Numbers of cells along a side of the pad.
const CELLS: [usize; 3] = [4, 6, 8];
/// Limit of friction \[Pa\].
const STRENGTH: f64 = 0.5e6;

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    // Mean distance from the middle of a square of unit side.
    let arm = (2.0_f64.sqrt() + 1.0_f64.asinh()) / 6.0;
    let exact = STRENGTH * arm * FRAC_PI_2;
    for (measure, plane) in MEASURES {
        let capability = if measure == "mortar" { plane } else { Capability::PenaltyContact3d };
        let covers = [capability, Capability::Coulomb, Capability::FiniteSliding];
        let mut errors = Vec::new();
        for n in CELLS {
            let scene = SceneText::new(SCENE)
                .with_or_same("interfaces.contact.measure", measure)
                .with_or_same("bodies.pad.mesh.block.divisions", format!("[{n}, 2, {n}]"))
                .with_or_same("bodies.plate.mesh.block.divisions", format!("[{}, 1, {}]", n + 1, n + 1));
            let done = simulate(&scene.text()?)?;
            let work = done.contact("turn")?.dissipated;
            errors.push(((n as f64).recip(), (work / exact - 1.0).abs()));
            if n == CELLS[2] {
                ledger
                    .claim(format!("work of friction over a quarter turn of a square pad, {measure}"))
                    .unit("J")
                    .value(work)
                    .equals(exact)
                    .relative(0.02)
                    .evidence(Evidence::Exact, "mu p a^3 (sqrt 2 + asinh 1)/6 times the angle")
                    .because(
                        "the rule of nodes errs by h^2/12 of the slope of the arm around the rim, 1.1 % here; the pad shears by mu p/G = 1e-3 and \
                         presses its edges unevenly",
                    )
                    .why_not_tighter("steps of 3 degrees turn the pad with an error of their square, 0.3 %")
                    .covers(&covers)
                    .cost(&done.cost)
                    .record();
            }
        }
        ledger
            .order(format!("work of friction over a quarter turn, {measure}"))
            .levels(&errors)
            .expected(2.0)
            .within(0.7)
            .because("arms are a cone, which the functions of faces interpolate to second order; three meshes decide")
            .finest(0.02, "as claimed for this mesh")
            .why_not_tighter("what the pad does by itself, 0.1 to 0.3 %, is not of this order")
            .evidence(Evidence::Exact, "mu p a^3 (sqrt 2 + asinh 1)/6 times the angle")
            .covers(&covers)
            .record();
    }
    Ok(())
}
