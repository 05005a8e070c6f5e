//! Bodies that mirror each other, of which one is condensed for both, against both.

use super::{Blocks, ROCK};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_plan::faults::Plan;

/// Rate of the plates \[m/s\].
const PLATES: f64 = 1e-9;

/// Two equal blocks whose fault creeps below 2 km, and whose sides move past each other at this rate \[m/s\]; slip is free to turn.
fn plan(sides: f64, rest: &str) -> Result<Plan, CaseError> {
    let moved = |half: f64| format!("x = 0, y = {{ rate = {:e} }}, z = {{ rate = {half:e} }}", 0.25 * half);
    Blocks {
        kinematics: "3d",
        moduli: [ROCK; 2],
        wide: 4e3,
        ends: &[[-4e3, 0.0], [-2e3, 3e3]],
        cells: ["divisions = [4, 4, 5]"; 2],
        fault: &format!(
            "rake = [0, 0.25, 1]\nslip = \"free\"\ndamping = 5e6\ncreep = {{ outside = {{ y = {{ from = \"-2 km\" }} }}, rate = {PLATES:e}, rake = [0, 0, 1] }}"
        ),
        conditions: &format!(
            "{{ set = \"L.left\", {} }}, {{ set = \"R.right\", {} }}",
            moved(-0.5 * sides),
            moved(0.5 * sides)
        ),
        rest,
        duration: "1 yr",
    }
    .plan()
}

/// Claims loads and tractions of mirrored bodies. With a receiver both are condensed.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (sides, what) in [(0.0, "creep alone"), (PLATES, "creep and sides")] {
        let (plans, cost) = Cost::measure(|| {
            Ok::<_, CaseError>([
                plan(sides, "")?,
                plan(sides, "[output]\nreceivers.r = [1500.0, -700.0, 300.0]\n")?,
            ])
        });
        let plans = plans?;
        let mirrored =
            plans.each_ref().map(|plan| plan.notes.iter().any(|note| note.contains("one side is condensed")));
        if mirrored != [true, false] {
            return Err(
                format!("bodies that mirror each other, and those that are kept: {mirrored:?}").into()
            );
        }
        let n = plans[0].points.len();
        let slip: Vec<f64> = (0..2 * n).map(|k| (1.7 * k as f64).sin()).collect();
        let [one, both] = plans.each_ref().map(|plan| {
            let caused = plan.problem.fault.operator.shear_of(&slip);
            [plan.problem.loading.rates(1.0, n, false).0, caused]
        });
        let off = [0, 1].map(|k| {
            let largest = both[k].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            one[k].iter().zip(&both[k]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
        });
        ledger
            .claim(format!("one body for both that mirror each other, against both, loaded by {what}: rates of tractions of the loads, and tractions of slip in two directions, largest difference over the largest"))
            .values(&off)
            .equals_each(&[0.0; 2])
            .absolute(1e-11)
            .between(&mirrored[0], &mirrored[1])
            .evidence(Evidence::Exact, "antisymmetric loads and slip displace equal bodies antisymmetrically")
            .because("rounding")
            .why_not_tighter("rounding grows with the condition of the condensed stiffness, some 1e4; a wrong share is of the order of one")
            .covers(&[Capability::FaultCycles, Capability::Solid3d, Capability::Loads])
            .cost(&cost)
            .record();
    }
    Ok(())
}
