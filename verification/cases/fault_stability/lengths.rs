//! Checks of plans: lengths of friction as published with the benchmarks, and the loading of a layer.

use super::{CRITICAL, FIRST, RATE, SHEAR_MODULUS, THICKNESS, Variant, WIDTH};
use crate::cases::seas;
use crate::{CaseError, Cost, Evidence, Ledger};
use asperity_plan::faults::Plan;
use asperity_plan::shared::checks::FaultCheck;

/// Checks of the only fault of a plan.
fn only(plan: Plan) -> Result<FaultCheck, CaseError> {
    plan.checks.faults.into_iter().next().ok_or_else(|| "the plan has no fault".into())
}

/// Cohesive zone and nucleation length \[m\], with the points on them, where they are fewest.
fn lengths(check: &FaultCheck) -> Result<[[f64; 2]; 2], CaseError> {
    let found = check.resolution.as_ref().ok_or("friction weakens nowhere")?;
    Ok([&found.cohesive_zone, &found.nucleation].map(|l| [l.length, l.points]))
}

/// A benchmark with the lengths in its description.
struct PublishedLengths {
    name: &'static str,
    scene: &'static str,
    /// Process zone and nucleation length \[m\].
    lengths: [f64; 2],
    /// Distance of points where they are fewest \[m\].
    spacing: f64,
    /// Half a unit of the last digit given, relative.
    digits: f64,
}

const PUBLISHED: [PublishedLengths; 2] = [
    PublishedLengths {
        name: "BP1",
        scene: include_str!("../../../scenes/bp1.toml"),
        lengths: [340.0, 2e3],
        spacing: 78.125,
        digits: 0.025,
    },
    PublishedLengths {
        name: "BP7",
        scene: include_str!("../../../scenes/bp7.toml"),
        lengths: [64.0, 280.0],
        spacing: 10.0,
        digits: 8e-3,
    },
];

/// Claims about the checks that `asperity check` prints.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    for published in &PUBLISHED {
        benchmark_lengths(ledger, published)?;
    }
    let slip = Variant { evolution: "slip", ..FIRST };
    let (checked, cost) = Cost::measure(|| only(slip.plan()?));
    let checked = checked?;
    let [_, [nucleation, _]] = lengths(&checked)?;
    ledger
        .claim("nucleation length of the slip law in the checks of the plan")
        .unit("m")
        .value(nucleation)
        .equals(WIDTH / CRITICAL as f64)
        .relative(1e-12)
        .evidence(
            Evidence::Exact,
            "half the neutral wavelength pi G L/(sigma (b - a)), at which modes are compared here",
        )
        .because("a formula, to rounding")
        .why_not_tighter("rounding differs between processors")
        .cost(&cost)
        .record();
    ledger
        .claim("mean rate of shear traction by the loads in the checks of the plan")
        .unit("Pa/s")
        .value(checked.loading.ok_or("no load shears the fault")?)
        .equals(SHEAR_MODULUS * RATE / (2.0 * THICKNESS))
        .relative(1e-9)
        .evidence(Evidence::Exact, "uniform shear G V/(2 H) of two layers whose outer faces move apart at V")
        .because("a linear field lies in the finite-element space; rounding of the condensation is left")
        .why_not_tighter("rounding grows with the size of the bodies and differs between processors")
        .cost(&cost)
        .record();
    Ok(())
}

fn benchmark_lengths(ledger: &mut Ledger, published: &PublishedLengths) -> Result<(), CaseError> {
    let PublishedLengths { name, scene, lengths: [zone, nucleation], spacing, digits } = published;
    let (checked, cost) = Cost::measure(|| only(seas::plan(scene)?));
    let [[zone_found, zone_points], [nucleation_found, nucleation_points]] = lengths(&checked?)?;
    ledger
        .claim(format!("process zone and nucleation length of {name} in the checks of the plan"))
        .unit("m")
        .values(&[zone_found, nucleation_found])
        .equals_each(&[*zone, *nucleation])
        .relative(*digits)
        .evidence(Evidence::Exact, "lengths in the description of the benchmark")
        .because("half a unit of their last digit")
        .why_not_tighter("the description gives no more digits")
        .cost(&cost)
        .record();
    ledger
        .claim(format!("points to these lengths where they are fewest, {name}"))
        .values(&[zone_points, nucleation_points])
        .equals_each(&[zone / spacing, nucleation / spacing])
        .relative(*digits)
        .evidence(Evidence::Exact, "these lengths over the distance of points in the scene")
        .because("half a unit of the last digit of the lengths")
        .why_not_tighter("the description gives no more digits")
        .cost(&cost)
        .record();
    Ok(())
}
