//! Impact of two equal bars.

use super::texts::{BodyRun, simulate};
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "impact_bars",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Inertia,
        Capability::PenaltyContact2d,
        Capability::Implicit,
        Capability::PlaneStrain,
    ],
    quick: true,
    run,
};

const SCENE: &str = include_str!("../../../scenes/impact.toml");
/// Density times wave speed [Pa s/m].
const IMPEDANCE: f64 = 8000.0 * 5000.0;
/// Speed of the left bar [m/s].
const SPEED: f64 = 2.0;
/// Instant at which the bars meet [s].
const MEETING: f64 = 50e-6;
/// Duration 2 l/c of the impact [s].
const DURATION: f64 = 40e-6;
/// Momentum of the left bar per area, rho l v [Pa s].
const MOMENTUM: f64 = 8000.0 * 0.1 * SPEED;
/// Numbers of cells along each bar.
const LEVELS: [usize; 4] = [25, 50, 100, 200];
const COVERS: [Capability; 3] = [Capability::Inertia, Capability::PenaltyContact2d, Capability::Implicit];

/// The scene with `n` cells along each bar and steps in proportion.
fn scene(n: usize, radius: f64) -> SceneText {
    SceneText::new(SCENE)
        .without("bodies.left.mesh.block.size")
        .without("bodies.right.mesh.block.size")
        .add("bodies.left.mesh.block.divisions", format!("[{n}, 1]"))
        .add("bodies.right.mesh.block.divisions", format!("[{n}, 1]"))
        .with_or_same("stages[0].steps", 12 * n)
        .with("time.inertia", format!("{{ spectral_radius = {radius:?} }}"))
}

/// Pressure of the contact over time.
struct Impact {
    done: BodyRun,
    pressure: Vec<f64>,
}

impl Impact {
    fn from_text(text: &str) -> Result<Impact, CaseError> {
        let done = simulate(text)?;
        let points = &done.record.histories()[0].points;
        let mean = |k: usize| {
            let area: f64 = points.iter().map(|p| p.area[k]).sum();
            points.iter().map(|p| p.area[k] * p.normal_traction[k]).sum::<f64>() / area
        };
        let pressure = (0..done.record.times().len()).map(mean).collect();
        Ok(Impact { done, pressure })
    }

    fn rows(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.done.record.times().iter().copied().zip(self.pressure.iter().copied())
    }

    /// Mean and standard deviation of the pressure in the middle half of the impact [Pa].
    fn plateau(&self) -> (f64, f64) {
        let (from, to) = (MEETING + 0.25 * DURATION, MEETING + 0.75 * DURATION);
        let inside: Vec<f64> = self.rows().filter(|(t, _)| *t > from && *t < to).map(|r| r.1).collect();
        let mean = inside.iter().sum::<f64>() / inside.len() as f64;
        let spread = inside.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / inside.len() as f64;
        (mean, spread.sqrt())
    }

    /// Impulse per area [Pa s].
    fn impulse(&self) -> f64 {
        let rows: Vec<(f64, f64)> = self.rows().collect();
        rows.windows(2).map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0)).sum()
    }

    /// Time for which the pressure exceeds half its plateau [s].
    fn duration(&self) -> f64 {
        let half = 0.25 * IMPEDANCE * SPEED;
        let pressed: Vec<f64> = self.rows().filter(|r| r.1 > half).map(|r| r.0).collect();
        pressed.last().zip(pressed.first()).map_or(0.0, |(last, first)| last - first)
    }

    fn imbalance(&self) -> f64 {
        self.done.report.energy.imbalance
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let runs =
        LEVELS.iter().map(|&n| Impact::from_text(&scene(n, 0.5).text()?)).collect::<Result<Vec<_>, _>>()?;
    let levels: Vec<(f64, f64)> =
        LEVELS.iter().zip(&runs).map(|(n, r)| (0.1 / *n as f64, 1.0 - r.impulse() / MOMENTUM)).collect();
    let shipped = &runs[2];
    pressures(ledger, shipped);
    exchanged(ledger, shipped, &levels);
    let mut rows: Vec<[String; 6]> = Vec::new();
    for (n, run) in LEVELS.iter().zip(&runs) {
        rows.push(row(*n, 0.5, run));
    }
    for radius in [0.3, 0.8, 1.0] {
        rows.push(row(100, radius, &Impact::from_text(&scene(100, radius).text()?)?));
    }
    ledger.table(
        "meshes and spectral radii",
        &[
            "cells",
            "radius",
            "pressure [MPa]",
            "its deviation [MPa]",
            "impulse over rho l v",
            "imbalance of energy",
        ],
        rows,
    );
    let found: Vec<(f64, f64)> = shipped.rows().map(|(t, p)| (t * 1e6, p * 1e-6)).collect();
    let (on, off, top) = (MEETING * 1e6, (MEETING + DURATION) * 1e6, 0.5 * IMPEDANCE * SPEED * 1e-6);
    let exact = [(0.0, 0.0), (on, 0.0), (on, top), (off, top), (off, 0.0), (120.0, 0.0)];
    let plot = Plot::xy("pressure of the contact", "time [us]", "pressure [MPa]");
    ledger.plot(plot.series(Series::line("exact", &exact)).series(Series::line("100 cells", &found)));
    Ok(())
}

fn pressures(ledger: &mut Ledger, run: &Impact) {
    let (mean, spread) = run.plateau();
    ledger
        .claim("mean pressure in the middle half of the impact")
        .unit("Pa")
        .value(mean)
        .equals(0.5 * IMPEDANCE * SPEED)
        .relative(1e-3)
        .evidence(Evidence::Exact, "rho c v/2: momentum of the material that the waves have reached")
        .because("waves spread over some cells, of which the middle half is free; a tenth of a percent is left for ringing")
        .why_not_tighter("the mean of a signal that rings by chance is more exact")
        .covers(&COVERS)
        .cost(&run.done.cost)
        .record();
    ledger
        .claim("standard deviation of the pressure there, over rho c v/2")
        .value(spread / (0.5 * IMPEDANCE * SPEED))
        .at_most(0.01)
        .evidence(Evidence::Exact, "constant pressure")
        .because("the default spectral radius damps the motion of the contact point within a few steps, as read from a pressure gauge")
        .why_not_tighter("a hundredth is what a user sees")
        .covers(&COVERS)
        .cost(&run.done.cost)
        .record();
    ledger
        .claim("duration of the impact, at half the pressure")
        .unit("s")
        .value(run.duration())
        .equals(DURATION)
        .absolute(1.2e-6)
        .evidence(Evidence::Exact, "2 l/c")
        .because("a front that has run through n cells is wide by some n^(1/3) cells: six cells of 0.2 us")
        .covers(&COVERS)
        .cost(&run.done.cost)
        .record();
}

fn exchanged(ledger: &mut Ledger, run: &Impact, levels: &[(f64, f64)]) {
    ledger
        .order("impulse short of the momentum of the left bar, over the latter")
        .unit("m")
        .levels(levels)
        .expected(2.0 / 3.0)
        .within(0.15)
        .finest(5e-3, "n^(1/3)/n of the impulse, a seventh of it lost to motions of single cells")
        .evidence(Evidence::Exact, "equal bars exchange their velocities")
        .because("vibrations left behind by a front as wide as h^(2/3) carry the momentum that is missing")
        .covers(&COVERS)
        .cost(&run.done.cost)
        .record();
    ledger
        .claim("energy that the budget misses, over the kinetic energy")
        .value(run.imbalance())
        .at_most(5e-3)
        .evidence(Evidence::Exact, "energy budget")
        .because(
            "the point closes within a step and opens within another: p v dt/2 = 4 J/m2 of 1600 J/m2 each, with p the pressure and v dt \
             the motion in a step",
        )
        .covers(&COVERS)
        .cost(&run.done.cost)
        .record();
}

fn row(n: usize, radius: f64, run: &Impact) -> [String; 6] {
    let (mean, spread) = run.plateau();
    [
        n.to_string(),
        format!("{radius}"),
        format!("{:.3}", mean * 1e-6),
        format!("{:.1e}", spread * 1e-6),
        format!("{:.4}", run.impulse() / MOMENTUM),
        format!("{:.1e}", run.imbalance()),
    ]
}
