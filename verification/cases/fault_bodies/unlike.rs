//! Slip between unlike half-spaces in plane strain, which changes normal tractions.

use super::{A, WIDE, halves};
use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_plan::faults::Plan;
use std::f64::consts::LN_2;

/// Shear moduli of the sides of smaller and larger x \[Pa\]: the softer one is the minus side.
const MODULI: [f64; 2] = [20e9, 60e9];
/// Poisson's ratio of both.
const NU: f64 = 0.25;
/// Cells along the half length of the slip.
const CELLS: [f64; 2] = [20.0, 40.0];
/// Part of the half length in which tractions are compared. Slip changes its curvature at the ends.
const INNER: f64 = 0.8;

/// The two media, with slip over twice A.
fn plan(cells: f64) -> Result<Plan, CaseError> {
    let h = A / cells;
    let across = format!("[[{}, {}], [0, {h}], [{WIDE}, {}]]", -WIDE, WIDE / 4.0, WIDE / 4.0);
    let up = format!("[[{}, {}], [{}, {h}], [{A}, {h}], [{WIDE}, {}]]", -WIDE, WIDE / 4.0, -A, WIDE / 4.0);
    let held = ("plane-strain", "x = 0, y = 0");
    seas::plan(&halves(MODULI, (&across, &up), held, "under_resolved = \"allow\"\n"))
}

/// C and |beta| of an interface dislocation (Comninou 1977): its shear stress is C b/(pi x), and its normal stress
/// beta C b times a point load.
fn constants() -> (f64, f64) {
    let kappa = 3.0 - 4.0 * NU;
    let [first, second] = MODULI;
    let sum = (first + second) * (kappa + 1.0);
    let alpha = (second - first) * (kappa + 1.0) / sum;
    let beta = (second - first) * (kappa - 1.0) / sum;
    (2.0 * first * (1.0 + alpha) / ((kappa + 1.0) * (1.0 - beta * beta)), beta)
}

/// Slip 2/3 A (1 - s^2)^(3/2) with s = y/A.
fn slip(y: f64) -> f64 {
    2.0 / 3.0 * A * (1.0 - (y / A).powi(2)).max(0.0).powf(1.5)
}

/// Changes of shear traction and of normal traction, compression positive. The derivative of slip is -2 s sqrt(1 - s^2), whose
/// Hilbert transform is 2 s^2 - 1. The softer side slips towards -y, and loses compression where slip ends there.
fn exact(y: f64) -> [f64; 2] {
    let (c, beta) = constants();
    let s = y / A;
    [c * (2.0 * s * s - 1.0), beta * c * 2.0 * s * (1.0 - s * s).max(0.0).sqrt()]
}

/// Largest errors of shear and normal tractions over the largest of each, and tractions at distances.
fn errors(plan: &Plan) -> ([f64; 2], [Vec<(f64, f64)>; 2]) {
    let n = plan.points.len();
    let given: Vec<f64> = plan.points.iter().map(|p| slip(p.at[1])).collect();
    let shear = plan.problem.fault.operator.shear_of(&given);
    let normal = plan.problem.fault.operator.normal_of(&given);
    let inner = (0..n).filter(|&p| plan.points[p].at[1].abs() <= INNER * A);
    let (mut off, mut largest, mut drawn) = ([0.0_f64; 2], [0.0_f64; 2], [Vec::new(), Vec::new()]);
    for p in inner {
        let y = plan.points[p].at[1];
        for (k, (found, exact)) in [shear[p], normal[p]].into_iter().zip(exact(y)).enumerate() {
            off[k] = off[k].max((found - exact).abs());
            largest[k] = largest[k].max(exact.abs());
            drawn[k].push((y / A, found / 1e9));
        }
    }
    ([off[0] / largest[0], off[1] / largest[1]], drawn)
}

/// Claims on tractions of smooth slip.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let coarse = errors(&plan(CELLS[0])?).0;
    let (fine, cost) = Cost::measure(|| plan(CELLS[1]));
    let (fine, drawn) = errors(&fine?);
    for (k, name) in ["shear", "normal"].into_iter().enumerate() {
        ledger
            .claim(format!("slip between media of 20 and 60 GPa in plane strain: {name} tractions, largest error over the largest"))
            .value(fine[k])
            .at_most(4e-4)
            .evidence(Evidence::Exact, "an interface dislocation (Comninou 1977), with the Hilbert transform of the derivative of slip")
            .because("40 cells of the second order to half of the length; the box adds about (1/100)^2")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
            .cost(&cost)
            .record();
        ledger
            .claim(format!(
                "slip between media of 20 and 60 GPa in plane strain: order of the error of {name} tractions"
            ))
            .value((coarse[k] / fine[k]).ln() / LN_2)
            .at_least(1.5)
            .evidence(Evidence::Exact, "an interface dislocation (Comninou 1977)")
            .because("second order, but for what the box adds to both")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
            .cost(&cost)
            .record();
    }
    let [shear, normal] = drawn;
    let formula =
        |k: usize| -> Vec<(f64, f64)> { shear.iter().map(|&(s, _)| (s, exact(s * A)[k] / 1e9)).collect() };
    ledger.plot(
        Plot::xy("Tractions of slip between unlike media", "y/A", "traction [GPa]")
            .series(Series::line("shear, closed form", &formula(0)))
            .series(Series::line("normal, closed form", &formula(1)))
            .series(Series::points("shear", &shear))
            .series(Series::points("normal", &normal)),
    );
    Ok(())
}
