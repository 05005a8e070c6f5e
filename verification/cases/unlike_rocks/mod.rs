//! Slip between unlike rocks, with and without a delay of friction behind the normal traction.

mod sliding;

use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use sliding::{DELAY, SlipRun, slip};

/// See the README.
pub const CASE: Case = Case {
    name: "unlike_rocks",
    readme: include_str!("README.md"),
    covers: &[Capability::DynamicRupture, Capability::PlaneStrain, Capability::Coulomb],
    quick: true,
    run,
};

/// Spacings of nodes over the radius of the imposed traction.
const SPACINGS: [f64; 4] = [0.2, 0.1, 0.05, 0.025];

/// Half length of the part of the fault that is compared: what the sides reflect does not reach it.
const WITHIN: f64 = 3.0;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let all = |delay| SPACINGS.map(|h| slip(h, delay)).into_iter().collect::<Result<Vec<_>, _>>();
    let (prompt, delayed) = (all(None)?, all(Some(DELAY))?);
    diverges(ledger, &prompt);
    converges(ledger, &delayed);
    let head = ["spacing over radius", "without delay", "with delay"];
    let rows = prompt
        .iter()
        .zip(&delayed)
        .map(|(p, d)| [p.spacing.to_string(), format!("{:.4}", p.largest()), format!("{:.4}", d.largest())]);
    ledger.table("largest change of the slip rate over Δτ/(ρ c_s)", &head, rows.collect::<Vec<_>>());
    for (runs, name) in [(&prompt, "without delay"), (&delayed, "with a delay")] {
        // The finest run without delay would hide all others.
        let shown = if name == "without delay" { &runs[..3] } else { &runs[1..] };
        let mut plot = Plot::xy(
            format!("Change of the slip rate between unlike rocks, {name}"),
            "distance along the fault over the radius",
            "change over the imposed traction over rho c_s",
        );
        for run in shown {
            plot = plot.series(Series::line(format!("nodes {} apart", run.spacing), &run.changes));
        }
        ledger.plot(plot);
    }
    Ok(())
}

/// Without delay the shortest waves of the mesh grow fastest.
fn diverges(ledger: &mut Ledger, runs: &[SlipRun]) {
    let [.., coarse, fine] = runs else { return };
    ledger
        .claim("slip between unlike rocks, friction without delay: factor by which half the spacing raises the largest change of the slip rate")
        .value(fine.largest() / coarse.largest())
        .at_least(10.0)
        .evidence(Evidence::Exact, "ill-posedness: waves of every length grow, at rates in proportion to the wavenumber (Cochard & Rice 2000)")
        .because("it would be 1 where results converge; on half the spacing waves twice as short grow with twice the exponent")
        .why_not_tighter("the exponent of the shortest waves of a mesh is that of no closed form")
        .cost(&fine.cost)
        .record();
}

/// Root mean square difference from the finest run at common nodes, over the largest change there.
fn difference(run: &SlipRun, finest: &SlipRun) -> f64 {
    let skip = (run.spacing / finest.spacing).round() as usize;
    let pairs = run.changes.iter().zip(finest.changes.iter().step_by(skip));
    let squares: Vec<f64> =
        pairs.filter(|(a, _)| a.0.abs() < WITHIN).map(|(a, b)| (a.1 - b.1).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / finest.largest()
}

fn converges(ledger: &mut Ledger, runs: &[SlipRun]) {
    let [others @ .., finest] = runs else { return };
    let levels: Vec<(f64, f64)> = others.iter().map(|r| (r.spacing, difference(r, finest))).collect();
    ledger
        .order("slip between unlike rocks, friction with a delay: slip rates against the spacing of nodes")
        .norm("root mean square difference from nodes 0.025 apart, over the largest change")
        .levels(&levels)
        .expected(1.0)
        .within(0.25)
        .or_better()
        .evidence(Evidence::ConvergedSelf, "a run with nodes 0.025 apart")
        .because("normal tractions are felt as they were relaxed at the last slip rate, of first order in the step")
        .finest(0.01, "a hundredth of the signal, whose front is smooth over a radius of 20 spacings")
        .cost(&finest.cost)
        .record();
}
