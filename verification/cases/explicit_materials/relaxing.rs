//! A standing shear wave in a bar of Maxwell material.
//!
//! The mode cos(k x) of displacement U and stress S obeys `ρ U'' = -k S`, `S' = G k U' - S/T`, with T = η/G. From rest with U' = 1,
//! `U = U∞ + e^(-t/2T) (B sin ωt - U∞ cos ωt)`, ω² = G k²/ρ - 1/(4T²), U∞ = ρ/(G k² T): viscous flow leaves a part of the wave behind.

use super::problem;
use crate::cases::waves::run;
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_mechanics::dynamics::Budget;
use asperity_vary::SceneText;
use std::f64::consts::PI;

const SCENE: &str = include_str!("relaxing.toml");

/// G = ρ = 1, and η \[SI\].
const TIME: f64 = 0.2;

/// Wavenumber: three half waves in the bar \[1/m\].
const K: f64 = 3.0 * PI;

/// Cells along the bar.
const CELLS: [u32; 4] = [20, 40, 80, 160];

/// U \[m\].
fn exact(t: f64) -> f64 {
    let omega = (K * K - 0.25 / (TIME * TIME)).sqrt();
    let left = 1.0 / (K * K * TIME);
    let sine = (1.0 - 0.5 * left / TIME) / omega;
    left + (-0.5 * t / TIME).exp() * (sine * (omega * t).sin() - left * (omega * t).cos())
}

/// Energy that viscous flow has dissipated, over that at the start \[-\]: what U'² and S²/G leave of it.
fn dissipated(t: f64) -> f64 {
    let (rate, omega) = (0.5 / TIME, (K * K - 0.25 / (TIME * TIME)).sqrt());
    let left = 1.0 / (K * K * TIME);
    let sine = (1.0 - rate * left) / omega;
    let across = omega * left - rate * sine;
    let (sin, cos) = (omega * t).sin_cos();
    let velocity = (-rate * t).exp() * (across * sin + cos);
    let acceleration = (-rate * t).exp() * ((omega * across - rate) * cos - (rate * across + omega) * sin);
    1.0 - velocity.powi(2) - (acceleration / K).powi(2)
}

struct Standing {
    /// Largest difference through time over the largest displacement.
    error: f64,
    history: Vec<(f64, f64)>,
    /// Energy budget at the end.
    budget: Budget,
    cost: Cost,
}

fn stand(cells: u32) -> Result<Standing, CaseError> {
    let mut problem =
        problem(SceneText::new(SCENE).with_or_same("bodies.bar.mesh.block.divisions[0]", cells))?;
    problem.velocity = problem.model.mesh.nodes.iter().map(|x| (K * x[0]).cos()).collect();
    let mut history = Vec::new();
    let (result, cost) =
        Cost::measure(|| run(&problem, |run| history.push((run.time(), run.displacement()[0]))));
    let last = result?;
    let cost = cost.count("cells", f64::from(cells)).count("steps", last.steps() as f64);
    let off = history.iter().map(|(t, u)| (u - exact(*t)).abs()).fold(0.0, f64::max);
    let largest = history.iter().map(|(t, _)| exact(*t).abs()).fold(0.0, f64::max);
    Ok(Standing { error: off / largest, history, budget: last.budget(), cost })
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let all = CELLS.map(stand).into_iter().collect::<Result<Vec<_>, _>>()?;
    let levels: Vec<(f64, f64)> =
        CELLS.iter().zip(&all).map(|(n, s)| (1.0 / f64::from(*n), s.error)).collect();
    let finest = &all[all.len() - 1];
    ledger
        .order("standing shear wave in a Maxwell body: displacement against the size of cells and steps")
        .norm("largest difference through time over the largest displacement")
        .levels(&levels)
        .expected(2.0)
        .within(0.1)
        .evidence(Evidence::Exact, "damped oscillation of the mode cos(k x), with viscous flow")
        .because("central differences, linear elements and the exact relaxation of a linear strain are of second order")
        .finest(
            1.2 * PI * (K / 160.0).powi(2) / 12.0,
            "the error of the frequency (k h)²/24 times the phase 0.8 k, and as much again for the relaxation of stresses within a step",
        )
        .covers(&[Capability::Viscoelasticity, Capability::Waves])
        .cost(&finest.cost)
        .record();
    let budget = finest.budget;
    ledger
        .claim("standing shear wave in a Maxwell body: energy that viscous flow dissipates over that at the start")
        .value(budget.viscous / budget.initial)
        .equals(dissipated(budget.time))
        .relative(3e-5)
        .evidence(Evidence::Exact, "kinetic and elastic energy of the mode cos(k x)")
        .because("2.5 % of the energy is left, and errs by twice the error of displacements, some 1e-3 of itself")
        .covers(&[Capability::Viscoelasticity, Capability::Waves])
        .cost(&finest.cost)
        .record();
    let curve: Vec<(f64, f64)> = finest.history.iter().map(|(t, _)| (*t, exact(*t))).collect();
    ledger.plot(
        Plot::xy("Standing shear wave in a Maxwell body", "time [s]", "displacement of the end [m]")
            .series(Series::line("exact", &curve))
            .series(Series::line("20 cells", &all[0].history)),
    );
    Ok(())
}
