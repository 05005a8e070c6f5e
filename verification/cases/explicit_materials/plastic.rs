//! A metal bar whose end is accelerated smoothly: an elastic precursor, and a plastic wave that follows.
//!
//! Both waves run one way, and each velocity of the end travels at the speed that belongs to it: c_e up to yield, c_p above it.

use super::super::plastic_wave::Wave;
use super::{problem, table};
use crate::cases::waves::run;
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_vary::SceneText;
use std::f64::consts::TAU;

const SCENE: &str = include_str!("plastic.toml");

/// Velocity of the end after its rise \[m/s\].
const SPEED: f64 = 20.0;

/// Time of the rise \[s\].
const RISE: f64 = 2e-6;

/// End of the run \[s\].
const END: f64 = 16e-6;

/// Height of the bar \[m\].
const HEIGHT: f64 = 0.5e-3;

/// Points in the table of the motion while it rises: its velocity is off by half of their distance, 1e-3 of the end's acceleration.
const POINTS: u32 = 1000;

/// Cells along the bar.
const CELLS: [u32; 4] = [200, 400, 800, 1600];

const COVERS: [Capability; 2] = [Capability::Plasticity, Capability::Waves];

/// Velocity of the end \[m/s\].
fn end_velocity(t: f64) -> f64 {
    let x = (t / RISE).clamp(0.0, 1.0);
    SPEED * (x - (TAU * x).sin() / TAU)
}

/// Displacement of the end \[m\].
fn end_displacement(t: f64) -> f64 {
    let x = (t / RISE).clamp(0.0, 1.0);
    SPEED * (RISE * (0.5 * x * x + ((TAU * x).cos() - 1.0) / (TAU * TAU)) + (t - RISE).max(0.0))
}

/// Exact velocity \[m/s\].
fn velocity(wave: &Wave, x: f64, t: f64) -> f64 {
    let slow = end_velocity(t - x / wave.plastic);
    if slow > wave.limit.1 { slow } else { end_velocity(t - x / wave.elastic).min(wave.limit.1) }
}

/// State of the bar at the end.
struct Bar {
    /// Root mean square difference of velocities, over that of the end.
    error: f64,
    /// Position \[m\] and velocity \[m/s\] of the nodes of the bottom.
    velocities: Vec<(f64, f64)>,
    /// Exact velocities there.
    exact: Vec<(f64, f64)>,
    /// Middle of each cell \[m\], and its compression \[Pa\].
    compression: Vec<(f64, f64)>,
    /// Plastic work by the histories of the metal, and that of the energy budget \[J/m\].
    dissipated: [f64; 2],
    /// Kinetic, elastic and plastic energy less the work of the end, over the latter.
    imbalance: f64,
    cost: Cost,
}

fn scene(cells: u32) -> SceneText {
    let rising = (0..=POINTS).map(|k| RISE * f64::from(k) / f64::from(POINTS));
    let motion = table(rising.chain([END]).map(|t| (t, end_displacement(t))));
    SceneText::new(SCENE)
        .with_or_same("bodies.bar.mesh.block.divisions[0]", cells)
        .with("stages[0].conditions[0].x", motion)
}

fn push(wave: &Wave, cells: u32) -> Result<Bar, CaseError> {
    let problem = problem(scene(cells))?;
    let (result, cost) = Cost::measure(|| run(&problem, |_| ()));
    let last = result?;
    let cost = cost.count("cells", f64::from(cells)).count("steps", last.steps() as f64);
    let time = last.time() - 0.5 * last.dt();
    let nodes = problem.model.mesh.nodes.iter().enumerate().filter(|(_, x)| x[1] == 0.0);
    let velocities: Vec<(f64, f64)> = nodes.map(|(n, x)| (x[0], last.velocity()[2 * n])).collect();
    let exact: Vec<(f64, f64)> = velocities.iter().map(|(x, _)| (*x, velocity(wave, *x, time))).collect();
    let square: f64 = velocities.iter().zip(&exact).map(|(a, b)| (a.1 - b.1).powi(2)).sum();
    let width = 0.1 / f64::from(cells);
    let metal = &last.nonlinear()[0];
    let (stored, dissipated) = (metal.strain_energy(), metal.plastic_work());
    let middle = |k: usize| (k as f64 + 0.5) * width;
    let compression = metal.cell_stress().iter().enumerate().map(|(k, s)| (middle(k), -s[0])).collect();
    let budget = last.budget();
    Ok(Bar {
        error: (square / velocities.len() as f64).sqrt() / SPEED,
        velocities,
        exact,
        compression,
        dissipated: [dissipated, budget.plastic],
        imbalance: (budget.kinetic + stored + dissipated - budget.motions) / budget.motions,
        cost,
    })
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let wave = Wave::new(SPEED);
    let bars = CELLS.map(|n| push(&wave, n)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let finest = &bars[bars.len() - 1];
    let levels: Vec<(f64, f64)> =
        CELLS.iter().zip(&bars).map(|(n, b)| (0.1 / f64::from(*n), b.error)).collect();
    ledger
        .order("plastic wave in explicit steps: velocities against the size of cells")
        .unit("m")
        .norm("root mean square difference over the velocity of the end")
        .levels(&levels)
        .expected(1.0)
        .within(0.3)
        .or_better()
        .evidence(Evidence::Exact, "each velocity of the end travels at the speed that belongs to it")
        .because("the solution has kinks at yield, at which schemes of second order converge with order one in the mean square")
        .finest(2e-3, "a kink of the slope 20 m/s in 11 mm is rounded over some cells of 0.06 mm")
        .covers(&COVERS)
        .cost(&finest.cost)
        .record();
    states(ledger, &wave, finest);
    ledger.plot(
        Plot::xy("Velocity along the bar after 16 µs", "distance from the end [m]", "velocity [m/s]")
            .series(Series::line("exact", &finest.exact))
            .series(Series::line("400 cells", &bars[1].velocities)),
    );
    Ok(())
}

/// Mean compression between two positions \[Pa\].
fn mean(bar: &Bar, from: f64, to: f64) -> f64 {
    let inside: Vec<f64> =
        bar.compression.iter().filter(|(x, _)| (from..to).contains(x)).map(|(_, s)| *s).collect();
    inside.iter().sum::<f64>() / inside.len() as f64
}

/// Plastic work of the exact solution \[J/m\].
fn dissipation() -> f64 {
    let n = 4000;
    let width = 0.1 / f64::from(n);
    let work = |k: i32| {
        let x = (f64::from(k) + 0.5) * width;
        let reached = end_velocity(END - x / Wave::new(SPEED).plastic);
        let own = Wave::new(reached);
        if reached > own.limit.1 { own.work() } else { 0.0 }
    };
    (0..n).map(work).sum::<f64>() * width * HEIGHT
}

fn states(ledger: &mut Ledger, wave: &Wave, bar: &Bar) {
    let (slow, fast) = (wave.plastic * END, wave.elastic * END);
    // The rise takes up a part of the way behind each front.
    let flat = [(slow, fast - wave.elastic * RISE), (0.0, slow - wave.plastic * RISE)];
    const YIELD: &str = "the kink at yield rings over some cells ahead of the plastic wave; a rise over 180 cells leaves less than 0.1 % of it in the mean";
    const REST: &str =
        "no kink lies behind the plastic wave, and the error of the rise over 130 cells is its square";
    let parts = [
        ("behind the elastic precursor", flat[0], wave.limit.0, (1e-3, YIELD)),
        ("behind the plastic wave", flat[1], wave.stress, (6e-5, REST)),
    ];
    for (place, (from, to), exact, (bound, reason)) in parts {
        let edge = 0.1 * (to - from);
        ledger
            .claim(format!("plastic wave in explicit steps: mean stress {place}"))
            .unit("Pa")
            .value(mean(bar, from + edge, to - edge))
            .equals(exact)
            .relative(bound)
            .evidence(Evidence::Exact, "momentum across the waves (Wood 1952)")
            .because(reason)
            .covers(&COVERS)
            .cost(&bar.cost)
            .record();
    }
    for (of, found) in ["", ", in the energy budget"].into_iter().zip(bar.dissipated) {
        ledger
            .claim(format!("plastic wave in explicit steps: energy that plastic flow dissipates{of}"))
            .unit("J/m")
            .value(found)
            .equals(dissipation())
            .relative(2e-3)
            .evidence(Evidence::Exact, "(Y + H e/2) e, integrated over the plastic strains behind the wave")
            .because(
                "the bound of the velocities: plastic strain is in proportion to the velocity above that at yield",
            )
            .covers(&COVERS)
            .cost(&bar.cost)
            .record();
    }
    ledger
        .claim("plastic wave in explicit steps: kinetic, elastic and plastic energy less the work of the end, over the latter")
        .value(bar.imbalance.abs())
        .at_most(1.2e-5)
        .evidence(Evidence::Exact, "energy budget; the plastic work is that of the material, not of the forces")
        .because(
            "in the step of 6 ns in which a point yields the work errs by half the change of stress, 5 MPa, times the plastic strain, 2e-5: \
             50 J/m3 of 420 kJ/m3 of plastic work, a tenth of all energy",
        )
        .why_not_tighter("an estimate from above: points yield anywhere within a step")
        .covers(&COVERS)
        .cost(&bar.cost)
        .record();
}
