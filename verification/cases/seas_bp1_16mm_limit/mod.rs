//! The limit in cell size and tolerance of the two events of the case `seas_bp1_16mm`.

use crate::cases::seas_bp1_16mm::{LAWS, Law, text};
use crate::cases::{body_plots, seas};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_ode::Method;

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp1_16mm_limit",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::AgeingLaw, Capability::SlipLaw],
    quick: false,
    run,
};

/// Sizes of cells \[m\].
const SIZES: [f64; 3] = [156.25, 78.125, 39.0625];
/// Tolerance at which the time error of onsets is far below the error of the cells.
const TIGHT: f64 = 1e-6;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = text(&LAWS[0], SIZES[0])?;
    body_plots::plot(
        ledger,
        "Slip rate through time",
        &scene,
        "main_rate",
        "L = 16 mm, ageing law, cells of 156 m.",
    )?;
    for law in &LAWS {
        limit(ledger, law)?;
    }
    Ok(())
}

fn limit(ledger: &mut Ledger, law: &Law) -> Result<(), CaseError> {
    let (mut onsets, mut rows, mut cost) = (Vec::new(), Vec::new(), Cost::default());
    for size in SIZES {
        let plan = seas::plan(&text(law, size)?)?;
        let mut settings = plan.problem.settings;
        (settings.method, settings.tolerance, settings.most_events) = (Method::Dop853, TIGHT, Some(2));
        let found = seas::found(&plan, &settings, |_| {})?;
        let peaks: Vec<String> = found.events.iter().map(|e| format!("{:.4}", e.peak)).collect();
        rows.push([
            law.name.to_string(),
            format!("{size:.0}"),
            format!("{:.4}, {:.4}", found.onsets[0], found.onsets[1]),
            peaks.join(", "),
            found.rates.to_string(),
        ]);
        onsets.push(found.onsets);
        cost = found.cost;
    }
    ledger.table(
        format!("two events in the limit of small steps, {} law", law.name),
        &["law", "cells [m]", "onsets [yr]", "peaks [m/s]", "right-hand sides"],
        rows,
    );
    let [a, b, c] = onsets.as_slice() else { return Err("three sizes".into()) };
    let name = law.name;
    // Aitken's rule, for differences of one sign: the order need not be known.
    let extrapolated: Vec<f64> =
        (0..2).map(|k| c[k] + (c[k] - b[k]).powi(2) / ((b[k] - a[k]) - (c[k] - b[k]))).collect();
    let left = (0..2).map(|k| (extrapolated[k] - c[k]).abs()).fold(0.0, f64::max);
    ledger
        .claim(format!("onsets that `seas_bp1_16mm` compares with, against their limit in cells, {name} law"))
        .unit("yr")
        .values(&law.onsets)
        .equals_each(&extrapolated)
        .absolute(law.uncertainty)
        .uncertainty(left)
        .evidence(
            Evidence::ConvergedSelf,
            "cells of 156, 78 and 39 m, dop853 with a tolerance of 1e-6, extrapolated by Aitken's rule",
        )
        .because(
            "the uncertainty that case takes; what extrapolation adds to 39 m is the reference's own error",
        )
        .covers(&[Capability::FaultCycles])
        .cost(&cost)
        .record();
    ledger
        .claim(format!("order of the first onset in the size of cells, from its differences at 156, 78 and 39 m, {name} law"))
        .value(((b[0] - a[0]) / (c[0] - b[0])).abs().log2())
        .at_least(0.8)
        .evidence(Evidence::ConvergedSelf, "the same runs")
        .because(
            "slip rates at the front follow the root of the distance over the process zone: between order one of a kink, which the slip law is \
             nearer to, and two of smooth slip; 0.2 for the three sizes not yet being in the limit",
        )
        .covers(&[Capability::FaultCycles])
        .cost(&cost)
        .record();
    Ok(())
}
