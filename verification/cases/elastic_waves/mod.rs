//! Waves in bodies by explicit steps.

mod absorbing;
mod impact;
mod lamb;

use super::body_plots;
use super::waves::{Rock, line, mesh, problem, run as steps};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use std::f64::consts::PI;

/// See the README.
pub const CASE: Case = Case {
    name: "elastic_waves",
    readme: include_str!("README.md"),
    covers: &[Capability::Waves, Capability::PlaneStrain, Capability::Antiplane],
    quick: true,
    run,
};

/// Rock without lateral strain under plane stress: waves along a bar run at c_p = c_s √2.
const BAR: Rock = Rock { density: 2700.0, pressure: 4e3 * std::f64::consts::SQRT_2, shear: 4e3 };

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    standing(ledger)?;
    absorbing::claims(ledger)?;
    lamb::claims(ledger)?;
    impact::claims(ledger)
}

/// A standing wave in a free bar of length 1 m.
struct Standing {
    /// Largest difference from the discrete solution, over the amplitude \[-\].
    discrete: f64,
    /// Largest difference from the exact solution, over the amplitude \[-\].
    exact: f64,
    /// Missing energy over its largest part \[-\].
    missing: f64,
    displacement: Vec<f64>,
    cost: Cost,
}

/// Three half waves on `n` cells, for one and a quarter periods.
fn stand(n: usize) -> Result<Standing, CaseError> {
    let h = 1.0 / n as f64;
    let k = 3.0 * PI;
    let omega = k * BAR.pressure;
    let bar = mesh(&[[line(0.0, 1.0, n), line(0.0, h, 1)]], ElementKind::Quad4)?;
    let mut problem = problem(bar, BAR, Idealisation::PlaneStress, 2.5 * PI / omega)?;
    let shape: Vec<f64> = problem.model.mesh.nodes.iter().map(|x| (k * x[0]).cos()).collect();
    problem.velocity = shape.iter().flat_map(|s| [*s, 0.0]).collect();
    let (result, cost) = Cost::measure(|| steps(&problem, |_| ()));
    let last = result?;
    let budget = last.budget();
    // The mode of the lumped bar is the cosine at its nodes; the scheme advances it by phases ν with sin(ν/2) = c Δt/h sin(k h/2).
    let (dt, time) = (last.dt(), last.time());
    let nu = 2.0 * (BAR.pressure * dt / h * (0.5 * k * h).sin()).asin();
    let discrete = dt * (nu * last.steps() as f64).sin() / nu.sin();
    let exact = (omega * time).sin() / omega;
    let off = |amplitude: f64| {
        let of = |(n, s): (usize, &f64)| (last.displacement()[2 * n] - amplitude * s).abs();
        shape.iter().enumerate().map(of).fold(0.0, f64::max) * omega
    };
    let missing = budget.energies().imbalance();
    let cost = cost.count("steps", last.steps() as f64).count("cells", n as f64);
    Ok(Standing {
        discrete: off(discrete),
        exact: off(exact),
        missing,
        displacement: last.displacement().to_vec(),
        cost,
    })
}

fn standing(ledger: &mut Ledger) -> Result<(), CaseError> {
    let sizes = [20, 40, 80, 160];
    let all = sizes.map(stand).into_iter().collect::<Result<Vec<_>, _>>()?;
    let (first, finest) = (&all[0], &all[3]);
    ledger
        .claim("standing wave in a bar of 20 cells, against the discrete solution")
        .norm("largest difference over the amplitude")
        .value(first.discrete)
        .at_most(1e-11)
        .evidence(Evidence::Exact, "dispersion relation of central differences on a lumped bar")
        .because("rounding of some sixty steps")
        .cost(&first.cost)
        .record();
    let levels: Vec<(f64, f64)> = sizes.iter().zip(&all).map(|(n, s)| (1.0 / *n as f64, s.exact)).collect();
    let k = 3.0 * PI;
    ledger
        .order("standing wave in a bar, steps and cells refined together")
        .levels(&levels)
        .expected(2.0)
        .within(0.1)
        .evidence(Evidence::Exact, "cos(k x) sin(c k t)")
        .because("central differences in time and linear elements with lumped mass are of second order")
        .finest(
            2.5 * PI * (k / 160.0).powi(2) / 24.0,
            "the phase of 1.25 periods times (k h)²/24, the error of the frequency at vanishing steps, from above",
        )
        .cost(&finest.cost)
        .record();
    ledger
        .claim("missing energy of the standing wave over its largest part")
        .value(all.iter().map(|s| s.missing).fold(0.0, f64::max))
        .at_most(1e-12)
        .evidence(
            Evidence::Exact,
            "the energy balance of central differences holds to the last bit but for rounding",
        )
        .because("sums of some hundred terms")
        .cost(&finest.cost)
        .record();
    let bar = mesh(&[[line(0.0, 1.0, 20), line(0.0, 0.05, 1)]], ElementKind::Quad4)?;
    body_plots::displacement(ledger, "Standing wave in a bar of 20 cells", &bar, &first.displacement, false)
}
