//! BP1 with a characteristic slip distance of 16 mm: two events of each law against their limit in cell size and tolerance.

use crate::cases::body_plots;
use crate::cases::seas::{self, CycleResults};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;
use asperity_vary::bp1::{AT_CREEP, BP1, SIZE, sized};

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp1_16mm",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::AgeingLaw, Capability::SlipLaw],
    quick: true,
    run,
};

/// A law and the limit of its events in cell size and tolerance, which the case `seas_bp1_16mm_limit` computes.
pub struct Law {
    /// Name of the evolution law.
    pub name: &'static str,
    scene: &'static str,
    /// Onsets \[yr\].
    pub onsets: [f64; 2],
    /// Largest slip rates \[m/s\].
    peaks: [f64; 2],
    /// Uncertainty of these onsets \[yr\].
    pub uncertainty: f64,
}

/// Source of the limit.
const LIMIT: &str =
    "cells of 156, 78 and 39 m by dop853 with a tolerance of 1e-6, extrapolated (case `seas_bp1_16mm_limit`)";

/// Both laws.
pub const LAWS: [Law; 2] = [
    Law {
        name: "ageing",
        scene: BP1,
        onsets: [271.219, 413.675],
        peaks: [4.4570, 4.3531],
        uncertainty: 0.02,
    },
    Law {
        name: "slip",
        scene: include_str!("../../../scenes/bp1-slip.toml"),
        onsets: [255.382, 378.602],
        peaks: [3.9884, 3.8792],
        uncertainty: 0.04,
    },
];

/// The scene of a law with this L and cells of `size` \[m\].
///
/// # Errors
/// If the scene lacks a key that is varied.
pub fn text(law: &Law, size: f64) -> Result<String, CaseError> {
    let scene = SceneText::new(law.scene).with("faults.main.law.l", "16 mm");
    Ok(sized(scene, size, AT_CREEP / SIZE * size).text()?)
}

/// The first two events with cells of this size \[m\].
fn found(law: &Law, size: f64) -> Result<CycleResults, CaseError> {
    let plan = seas::plan(&text(law, size)?)?;
    let mut settings = plan.problem.settings;
    settings.most_events = Some(2);
    seas::found(&plan, &settings, |_| {})
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = text(&LAWS[0], SIZE)?;
    body_plots::plot(
        ledger,
        "Slip rate through time",
        &scene,
        "main_rate",
        "L = 16 mm, ageing law, cells of 156 m.",
    )?;
    for law in &LAWS {
        let fine = found(law, 156.25)?;
        events(ledger, law, &fine);
        if law.name == "ageing" {
            falls(ledger, law, &fine)?;
        }
    }
    Ok(())
}

fn events(ledger: &mut Ledger, law: &Law, found: &CycleResults) {
    let name = law.name;
    ledger
        .claim(format!("onsets of the first two events, {name} law, cells of 156 m"))
        .unit("yr")
        .values(&found.onsets)
        .equals_each(&law.onsets)
        .absolute(0.3)
        .uncertainty(law.uncertainty)
        .evidence(Evidence::ConvergedSelf, LIMIT)
        .because("0.1 % of the first onset: 4.4 cells to the process zone; BP1 has 0.04 % with four cells to its own (78 m)")
        .cost(&found.cost)
        .record();
    let peaks: Vec<f64> = found.events.iter().map(|e| e.peak).collect();
    ledger
        .claim(format!("peak slip rates of the first two events, {name} law, cells of 156 m"))
        .unit("m/s")
        .values(&peaks)
        .equals_each(&law.peaks)
        .relative(0.01)
        .uncertainty(0.01)
        .evidence(Evidence::ConvergedSelf, LIMIT)
        .because("the peak is a few steps and cells wide; it changes by 0.2 % from 78 to 39 m")
        .why_not_tighter("the highest step of a peak falls anywhere within it")
        .cost(&found.cost)
        .record();
}

/// Claim that errors decrease with cell size.
fn falls(ledger: &mut Ledger, law: &Law, fine: &CycleResults) -> Result<(), CaseError> {
    let coarse = found(law, 312.5)?;
    let off = |f: &CycleResults| (f.onsets[0] - law.onsets[0]).abs();
    ledger
        .claim("error of the first onset with cells of 312 m over that with 156 m, ageing law")
        .value(off(&coarse) / off(fine))
        .at_least(4.0)
        .evidence(Evidence::ConvergedSelf, LIMIT)
        .because("second order; boundary elements have 2.5 between 156 and 78 m in BP1, at half these sizes to the process zone")
        .cost(&coarse.cost)
        .record();
    Ok(())
}
