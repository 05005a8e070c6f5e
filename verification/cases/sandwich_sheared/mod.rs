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

/// Slip at three heights, and slip histories as the time step is refined to convergence. Final slip does not depend on
/// the history, since all points end in block sliding; its time error is rounding.
fn refine_in_time(ledger: &mut Ledger) -> Result<Run, CaseError> {
    let times: Vec<f64> = (1..=10).map(|k| PRESSED + 5.0 * f64::from(k)).collect();
    let nodes = |run: &Run| HEIGHTS.iter().map(|&y| run.node_at(y)).collect::<Result<Vec<_>, _>>();
    let mut levels = Vec::new();
    let mut histories = Vec::new();
    let mut finest = None;
    for steps in [400, 800, 1600, 3200] {
        let (run, cost) =
            Cost::measure(|| sandwich::simulate(&sandwich::equal_steps(sandwich::base()?, steps)));
        let run = run?;
        histories.push(nodes(&run)?.into_iter().flat_map(|n| run.slip_at(n, &times)).collect::<Vec<f64>>());
        finest = Some((run, cost));
    }
    let (fine, cost) = finest.ok_or("no level was run")?;
    let cost = cost.counts(&fine.report.counts);
    let (last, before) = (&histories[3], &histories[2]);
    let limit: Vec<f64> = last.iter().zip(before).map(|(a, b)| 2.0 * a - b).collect();
    for (steps, history) in [400.0, 800.0, 1600.0].iter().zip(&histories) {
        let error = history.iter().zip(&limit).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        levels.push((50.0 / steps, error));
    }
    ledger
        .order("slip histories at three heights, in the time step")
        .unit("um")
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .finest(2e-2, "half the change of V over onset, V_load, times the step of 0.03 s, times the few steps onset takes")
        .evidence(Evidence::ConvergedSelf, "Richardson extrapolation of 1600 and 3200 steps")
        .because("V = slip increment over step is backward Euler")
        .why_not_tighter("the estimate of the finest level is from above: steps of onset partly cancel")
        .cost(&cost)
        .record();
    ledger
        .claim("slip at y = 12.5, 25, 37.5 mm and u_y = 0.05 mm, h = 1.25 mm, against the limit h -> 0")
        .unit("um")
        .values(&fine.final_slip(&HEIGHTS)?)
        .equals_each(&[34.2694, 32.8368, 32.1769])
        .absolute(0.02)
        .uncertainty(0.002)
        .evidence(Evidence::OtherCode, "limit of verification/independent for h -> 0")
        .because("mesh error at h = 1.25 mm and the uncertainty of the limit")
        .cost(&cost)
        .record();
    ledger
        .claim("slip at the same points against the same mesh of the second implementation")
        .unit("um")
        .values(&fine.final_slip(&HEIGHTS)?)
        .equals_each(&[34.27003, 32.83135, 32.17901])
        .absolute(2e-5)
        .evidence(Evidence::OtherCode, "verification/independent, h = 1.25 mm")
        .because("seven printed digits; final slip has no error in time")
        .why_not_tighter("the reference prints no more digits here")
        .record();
    Ok(fine)
}

/// Limit that every point approaches at late time.
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
        .evidence(Evidence::OtherCode, "verification/independent: V approaches V_load from below, V/V_load - 1 below 4e-14")
        .because(
            "a step of 0.016 s slips 1.6e-8 m; rounding of displacements of 5e-5 m through the interface, whose condition is some 1e4, leaves 1e-16 to 1e-14 m of it: 1e-8 to 1e-6",
        )
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
        plot = plot.series(Series::line(format!("y = {:.1} mm", p.position[1] * 1e3), &points));
    }
    ledger.plot(plot);
    Ok(())
}

/// Quantities that the corner makes mesh-dependent, against the independent solver on the same mesh.
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
        let largest = slip.iter().map(|s| s.abs()).fold(0.0, f64::max);
        let least = slip.iter().map(|s| s.abs()).fold(f64::INFINITY, f64::min);
        spreads.push((largest - least) / U_X);
        onsets.push(onset(run) / U_X);
    }
    ledger
        .claim("largest minus least final slip over u_x, h = 2.5, 1.25, 0.625 mm")
        .values(&spreads)
        .equals_each(&[0.7570, 0.7935, 0.8193])
        .absolute(2e-4)
        .evidence(Evidence::OtherCode, "verification/independent, same meshes")
        .because("four printed digits; final slip does not depend on the history once every point slides at V_load")
        .record();
    ledger
        .claim("u_y/u_x at which all points exceed V_load/2, h = 2.5, 1.25, 0.625 mm")
        .values(&onsets)
        .equals_each(&[1.9159, 1.9485, 1.9718])
        .absolute(5e-3)
        .evidence(Evidence::OtherCode, "verification/independent, same meshes")
        .because("backward Euler lags by about one step, 0.05 s = 5e-3 u_x, at this tolerance")
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

/// Claim that Young's modulus cancels when the penalties scale with it.
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
    let mut scene = sandwich::tolerance(sandwich::base()?, 1e-8);
    for interface in scene.interfaces.values_mut() {
        interface.sliding =
            asperity_plan::reading::scene::model::here(asperity_plan::reading::scene::model::Sliding::Finite);
    }
    let finite = sandwich::simulate(&scene)?;
    for (name, run, stress, slips) in [
        ("nu = 0.25", &nu, 9.814142, [32.41597, 30.86419, 30.22086]),
        ("Vref = V_load/100", &vref, 9.335791, [32.98035, 31.39068, 30.62254]),
    ] {
        let mut found = vec![run.mean_normal("press")?];
        found.extend(run.final_slip(&HEIGHTS)?);
        ledger
            .claim(format!("mean normal stress [MPa] and slip at three heights [um], {name}"))
            .values(&found)
            .equals_each(&[stress, slips[0], slips[1], slips[2]])
            .relative(2e-6)
            .evidence(Evidence::OtherCode, "verification/independent, h = 1.25 mm")
            .because("seven printed digits; final slip has no error in time")
            .why_not_tighter("the printed digits are the reference: half of the last one is 5e-8, and the tables round twice")
            .record();
    }
    for (name, run) in
        [("nu = 0.25", &nu), ("Vref = V_load/100", &vref), ("finite sliding (no reference)", &finite)]
    {
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
            .order(format!("{name} in 1/E_n"))
            .unit(unit)
            .levels(levels)
            .expected(1.0)
            .within(0.1)
            .floor(Floor::Rounding, 1e-9)
            .finest(finest, "the compliance of the penalty, h/1000 in 50 mm, times the value")
            .why_not_tighter("an estimate from above: most of the compliance is common to both levels")
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
