//! The SEAS benchmark BP5-QD in the half-space: intervals between events against other boundary elements of the same cells.

use crate::cases::seas::{self, CycleResults};
use crate::{Axis, Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp5",
    readme: include_str!("README.md"),
    covers: &[Capability::Medium, Capability::FaultCycles, Capability::Solid3d],
    quick: true,
    run,
};

/// Events of a run: the one in the seed, and three that nucleate by themselves.
pub const EVENTS: usize = 4;
/// Interval between events with cells of 1 km \[yr\], published for the code interact with dense operators.
pub const INTERACT_1KM: f64 = 235.362;
/// Source of that interval.
const INTERACT: &str =
    "interact, dense boundary elements of one slip component (Okada 1992), constant over 12 events";

/// The scene with cells of this size \[km\], with slip along the rake alone.
///
/// # Errors
/// If the scene has changed its keys, or cannot be planned.
pub fn along_rake(size: &str) -> Result<Plan, CaseError> {
    seas::plan(&text(size).text()?)
}

fn text(size: &str) -> SceneText {
    SceneText::new(include_str!("../../../scenes/bp5.toml"))
        .with_or_same("faults.main.rectangle.size", size)
        .without("faults.main.slip")
}

/// The scene with the initial tractions of the published runs.
///
/// The benchmark has tau = sigma f + eta V. The parameters of HBI (github.com/sozawa94/hbi, examples/bp5r_param.py) have
/// tau = sigma (f + eta V) with sigma and eta V in MPa, and HBI takes tau for the frictional part. In the seed this adds
/// sigma eta V = 3.47 MPa.
fn with_published_seed(size: &str) -> Result<Plan, CaseError> {
    // MPa, and MPa s/m with a shear modulus of 32.04 GPa and a wave speed of 3.464 km/s.
    let (normal, eta) = (25.0, 32.04 / (2.0 * 3.464));
    let traction = |a: f64, rate: f64| {
        normal * a * (0.5 * rate / 1e-6 * ((0.6 + 0.03 * 1e3_f64.ln()) / a).exp()).asinh()
    };
    let seed = traction(0.004, 0.03) + normal * eta * 0.03 + eta * 0.03;
    let shear = |path: &str, value: f64, text: SceneText| text.add(path, format!("\"{value} MPa\""));
    let text = shear("faults.main.shear", traction(0.04, 1e-9), text(size));
    let text = shear("faults.main.patches[0].shear", traction(0.004, 1e-9), text);
    seas::plan(&shear("faults.main.patches[1].shear", seed, text).text()?)
}

/// Runs a plan to its fourth event, or fewer; returns times \[yr\] with the largest slip rates \[m/s\] besides.
///
/// # Errors
/// If the run fails.
pub fn events(plan: &Plan, number: usize) -> Result<(CycleResults, Vec<(f64, f64)>), CaseError> {
    let mut settings = plan.problem.settings;
    settings.most_events = Some(number);
    let mut rates = Vec::new();
    let found = seas::found(plan, &settings, |now| rates.push((now.at.seconds() / seas::YEAR, now.largest)))?;
    Ok((found, rates))
}

/// Interval between the last two events \[yr\].
#[must_use]
pub fn interval(found: &CycleResults) -> f64 {
    found.onsets[EVENTS - 1] - found.onsets[EVENTS - 2]
}

/// Claims the interval of a run with cells of this size \[yr\].
pub fn claim(ledger: &mut Ledger, size: &str, found: &CycleResults, published: f64) {
    ledger
        .claim(format!("interval between events, cells of {size}"))
        .unit("yr")
        .value(interval(found))
        .equals(published)
        .absolute(0.03)
        .uncertainty(0.001)
        .evidence(Evidence::OtherCode, INTERACT)
        .because(
            "cells and kernels are the same; errors of the steps of both codes are about 1e-4 of an interval",
        )
        .why_not_tighter("the tolerance of the other code is not published")
        .cost(&found.cost)
        .record();
}

/// The first and the second event that nucleate by themselves, with cells of 1 km \[yr\], published for interact.
const NATURAL: [f64; 2] = [234.272, 469.665];

/// Claims the times of natural events with the initial tractions of the published runs.
fn natural(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = with_published_seed("1 km")?;
    let (found, _) = events(&plan, 1 + NATURAL.len())?;
    for (k, (name, published)) in ["first", "second"].into_iter().zip(NATURAL).enumerate() {
        ledger
            .claim(format!("{name} natural event with the seed of the published runs, cells of 1 km"))
            .unit("yr")
            .value(found.onsets[k + 1])
            .equals(published)
            .absolute(0.03 * (k + 1) as f64)
            .uncertainty(0.001)
            .evidence(Evidence::OtherCode, INTERACT)
            .because("the bound of one interval, once and twice")
            .why_not_tighter("the tolerance of the other code is not published")
            .cost(&found.cost)
            .record();
    }
    Ok(())
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    natural(ledger)?;
    let plan = along_rake("1 km")?;
    let (found, rates) = events(&plan, EVENTS)?;
    claim(ledger, "1 km", &found, INTERACT_1KM);
    ledger.plot(
        Plot::xy("Largest slip rate", "time [yr]", "V_max [m/s]")
            .axes(Axis::Linear, Axis::Log)
            .series(Series::line("cells of 1 km", &rates)),
    );
    Ok(())
}
