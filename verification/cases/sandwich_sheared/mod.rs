//! Stage 2 of the sandwich: slip, friction coefficient and slip rate.

use super::sandwich::{self, PRESSED, Run, U_X, V_LOAD};
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Floor, Ledger, Plot, Series};

/// See the README.
pub const CASE: Case = Case {
    name: "sandwich_sheared",
    readme: include_str!("README.md"),
    covers: &[
        Capability::VelocityFriction,
        Capability::Implicit,
        Capability::Condensation,
        Capability::PenaltyContact2d,
        Capability::Stages,
    ],
    quick: true,
    run,
};

/// Heights at which slip is compared \[m\].
const HEIGHTS: [f64; 3] = [12.5e-3, 25e-3, 37.5e-3];
/// Friction parameters of the benchmark.
const MU0: f64 = 0.6;
const A: f64 = 0.01;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let fine = refine_in_time(ledger)?;
    late_time(ledger, &fine)?;
    meshes(ledger, &fine)?;
    young_cancels(ledger)?;
    variants(ledger)?;
    penalties(ledger)
}

/// The slip at three heights with the time step refined until it no longer matters.
fn refine_in_time(ledger: &mut Ledger) -> Result<Run, CaseError> {
    let mut levels: Vec<(f64, Run, Cost)> = Vec::new();
    for tolerance in [4e-9, 1e-9, 2.5e-10, 6.25e-11] {
        let (run, cost) = Cost::of(|| sandwich::simulate(&sandwich::tolerance(sandwich::base()?, tolerance)));
        let run = run?;
        let cost = cost.counts(&run.report.counts);
        levels.push((tolerance, run, cost));
    }
    let slips = levels.iter().map(|(_, run, _)| run.final_slip(&HEIGHTS)).collect::<Result<Vec<_>, _>>()?;
    // The last quantity in the sequence is taken off by its own extrapolation: the error of backward Euler halves as the
    // tolerance falls four times.
    let last = slips.len() - 1;
    let converged: Vec<f64> = (0..3).map(|k| 2.0 * slips[last][k] - slips[last - 1][k]).collect();
    let (_, fine, cost) = levels.pop().ok_or("no level was run")?;
    ledger
        .claim("slip at y = 12.5, 25, 37.5 mm and u_y = 0.05 mm, h = 1.25 mm, against the limit h -> 0")
        .unit("um")
        .values(&slips[last])
        .equals_each(&[34.269, 32.836, 32.176])
        .absolute(0.02)
        .uncertainty(0.005)
        .evidence(Evidence::OtherCode, "limit for h -> 0 of an independent solver")
        .because("mesh error at h = 1.25 mm and the uncertainty of the limit")
        .cost(&cost)
        .record();
    let change: f64 = (0..3).map(|k| (slips[last][k] - converged[k]).abs()).fold(0.0, f64::max);
    ledger
        .claim("change of slip by further refinement in time")
        .unit("um")
        .value(change)
        .at_most(2e-3)
        .evidence(Evidence::ConvergedSelf, "Richardson extrapolation of the two finest tolerances")
        .because("a tenth of the bound above, so that time no longer matters there")
        .record();
    Ok(fine)
}

/// What every point tends to.
fn late_time(ledger: &mut Ledger, fine: &Run) -> Result<(), CaseError> {
    let end = fine.end("shear")?;
    let steady = MU0 + A * (V_LOAD / 1e-6_f64).ln();
    let away: Vec<f64> = end.friction.iter().map(|mu| mu - steady).collect();
    ledger
        .claim("friction coefficient of all points at the end")
        .values(&end.friction)
        .equals_each(&vec![steady; away.len()])
        .absolute(1e-8)
        .evidence(Evidence::Exact, "mu0 + a ln(V_load/Vref)")
        .because("the approach is exponential with a time of a sigma/(k V), long over at the end: a times the last deviation of V")
        .why_not_tighter("the deviation of the slowest point depends on where the last steps fall")
        .record();
    let histories = &fine.record.histories()[0].points;
    let over = histories
        .iter()
        .flat_map(|p| p.slip_rate.iter().map(|v| v.abs() / V_LOAD - 1.0))
        .fold(f64::NEG_INFINITY, f64::max);
    ledger
        .claim("overshoot of the slip rate, max V/V_load - 1")
        .value(over.max(0.0))
        .at_most(1e-6)
        .evidence(Evidence::OtherCode, "an independent solver sees 1e-9: V approaches V_load from below")
        .because("rounding of V, which is a difference of displacements over the last step: 1e-16 m over 1e-9 m")
        .why_not_tighter("the rounding scales with the smallest step of the run")
        .record();
    let times = [PRESSED + 40.0, PRESSED + 45.0, PRESSED + 50.0];
    let mut slopes = Vec::new();
    for node in 0..histories.len() {
        let s = fine.slip_at(node, &times);
        slopes.push((s[2] - s[1]) / 5.0);
    }
    ledger
        .claim("slope of all slip curves over the last 5 um of loading, over V_load")
        .values(&slopes)
        .equals_each(&vec![1.0; slopes.len()])
        .absolute(1e-6)
        .evidence(Evidence::Exact, "block sliding of the whole face at V_load")
        .because("the remaining transient is exponentially small; rounding of slip over 5 um is 1e-11")
        .why_not_tighter("interpolation between accepted steps")
        .record();
    let mut plot = Plot::xy("Slip rate over loading rate, eight positions", "u_y [um]", "V / V_load");
    for k in 0..8 {
        let node = k * (histories.len() - 1) / 7;
        let p = &histories[node];
        let points: Vec<(f64, f64)> = fine
            .record
            .times()
            .iter()
            .zip(&p.slip_rate)
            .filter(|(t, _)| **t > PRESSED && **t < PRESSED + 30.0)
            .map(|(t, v)| ((t - PRESSED) * V_LOAD * 1e6, v.abs() / V_LOAD))
            .collect();
        plot = plot.series(Series::line(&format!("y = {:.1} mm", p.position[1] * 1e3), &points));
    }
    ledger.plot(plot);
    Ok(())
}

/// Quantities the corner makes mesh-dependent, against the same discretisation of the independent solver.
fn meshes(ledger: &mut Ledger, base: &Run) -> Result<(), CaseError> {
    let mut spreads = Vec::new();
    let mut onsets = Vec::new();
    for h in [2.5, 1.25, 0.625] {
        let own;
        let run = if h == 1.25 {
            base
        } else {
            own = sandwich::simulate(&sandwich::size(sandwich::base()?, h))?;
            &own
        };
        let slip = &run.end("shear")?.slip;
        spreads.push((slip[0].abs() - slip[slip.len() - 1].abs()).abs() / U_X);
        onsets.push(onset(run) / U_X);
    }
    ledger
        .claim("difference of final slip between the two ends over u_x, h = 2.5, 1.25, 0.625 mm")
        .values(&spreads)
        .equals_each(&[0.757, 0.794, 0.819])
        .absolute(2e-3)
        .evidence(Evidence::OtherCode, "verification/independent, same meshes")
        .because("three printed digits and the first-order error in time")
        .record();
    ledger
        .claim("u_y/u_x at which all points exceed V_load/2, h = 2.5, 1.25, 0.625 mm")
        .values(&onsets)
        .equals_each(&[1.92, 1.95, 1.98])
        .absolute(2e-2)
        .evidence(Evidence::OtherCode, "an independent solver, same meshes")
        .because("two printed decimals and the length of the steps there")
        .record();
    Ok(())
}

/// u_y at which the slowest point passes half the loading rate \[m\], interpolated between steps.
fn onset(run: &Run) -> f64 {
    let points = &run.record.histories()[0].points;
    let times = run.record.times();
    let slowest: Vec<f64> = (0..times.len())
        .map(|k| points.iter().map(|p| p.slip_rate[k].abs()).fold(f64::INFINITY, f64::min) / V_LOAD)
        .collect();
    let k = slowest.iter().zip(times).position(|(v, t)| *t > PRESSED && *v > 0.5).unwrap_or(times.len() - 1);
    let s = (0.5 - slowest[k - 1]) / (slowest[k] - slowest[k - 1]);
    (times[k - 1] + s * (times[k] - times[k - 1]) - PRESSED) * V_LOAD
}

/// Young's modulus cancels when the penalties scale with it.
fn young_cancels(ledger: &mut Ledger) -> Result<(), CaseError> {
    let steps = 200;
    let one = sandwich::simulate(&sandwich::equal_steps(sandwich::base()?, steps))?;
    let ten = sandwich::simulate(&sandwich::young(sandwich::equal_steps(sandwich::base()?, steps), 10.0))?;
    let (a, b) = (&one.end("shear")?.slip, &ten.end("shear")?.slip);
    let largest = a.iter().map(|s| s.abs()).fold(0.0, f64::max);
    let difference = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
    ledger
        .claim("largest change of slip when E and the penalties are ten times larger")
        .value(difference)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "E cancels from slip, mu and V when the penalties scale with E")
        .because("the iteration's tolerance of 1e-11 times the condition of the interface, some hundred")
        .why_not_tighter("Newton usually ends far below its tolerance")
        .record();
    Ok(())
}

/// Other materials and laws.
fn variants(ledger: &mut Ledger) -> Result<(), CaseError> {
    let nu = sandwich::simulate(&sandwich::poisson(sandwich::base()?, 0.25))?;
    let vref = sandwich::simulate(&sandwich::reference_rate(sandwich::base()?, 0.01))?;
    let mu = &vref.end("shear")?.friction;
    let steady = MU0 + A * 100.0_f64.ln();
    ledger
        .claim("friction coefficient of all points at the end, Vref = V_load/100")
        .values(mu)
        .equals_each(&vec![steady; mu.len()])
        .absolute(1e-6)
        .evidence(Evidence::Exact, "mu0 + a ln 100")
        .because("a times the relative deviation of V from V_load at the end")
        .why_not_tighter("the deviation of the slowest point depends on where the last steps fall")
        .record();
    let mut rows = Vec::new();
    for (name, run) in [("nu = 0.25", &nu), ("Vref = V_load/100", &vref)] {
        let slips = run.final_slip(&HEIGHTS)?;
        rows.push(
            std::iter::once(name.to_string())
                .chain(slips.iter().map(|s| format!("{s:.4}")))
                .chain([format!("{:.5}", run.mean_normal("press")?)])
                .collect::<Vec<_>>(),
        );
    }
    ledger.table(
        "Variants: slip [um] at y = 12.5, 25, 37.5 mm and mean normal stress [MPa]",
        &["variant", "12.5 mm", "25 mm", "37.5 mm", "mean stress"],
        rows,
    );
    Ok(())
}

/// Influence of the penalty: first order in 1/E_n.
fn penalties(ledger: &mut Ledger) -> Result<(), CaseError> {
    let value = |factor: f64| -> Result<(f64, f64), CaseError> {
        let scene = sandwich::press_only(sandwich::penalty(sandwich::base()?, factor));
        let mean = sandwich::simulate(&scene)?.mean_normal("press")?;
        let scene = sandwich::equal_steps(sandwich::penalty(sandwich::base()?, factor), 400);
        Ok((mean, sandwich::simulate(&scene)?.final_slip(&[25e-3])?[0]))
    };
    let factors = [0.1, 1.0, 10.0];
    let reference = value(1e4)?;
    let mut stress = Vec::new();
    let mut slip = Vec::new();
    for factor in factors {
        let (mean, middle) = value(factor)?;
        stress.push((1.0 / factor, (mean - reference.0).abs()));
        slip.push((1.0 / factor, (middle - reference.1).abs()));
    }
    for (name, unit, levels, finest) in
        [("mean normal stress", "MPa", &stress, 1e-3), ("slip at y = 25 mm", "um", &slip, 0.02)]
    {
        ledger
            .order(&format!("{name} in 1/E_n"))
            .unit(unit)
            .levels(levels)
            .expected(1.0)
            .within(0.1)
            .floor(Floor::Rounding, 1e-9)
            .finest(finest, "the compliance of the penalty, h/1000 in 50 mm, times the value")
            .evidence(Evidence::ConvergedSelf, "the same run with 10^4 times the penalty")
            .because("the penalty acts as a layer of compliance 1/E_n in series with the blocks; from 0.1x its square shows")
            .record();
    }
    ledger.plot(
        Plot::xy("Influence of the penalty", "1/E_n over its default", "difference [MPa], [um]")
            .axes(Axis::Log, Axis::Log)
            .series(Series::marked("mean normal stress", &stress))
            .series(Series::marked("slip at y = 25 mm", &slip)),
    );
    Ok(())
}
