//! Bodies with inertia: vibration, a block that slides to rest, a plastic wave, a body that turns, a short blow.

mod blow;
mod handed;
mod plastic;
mod sliding;
mod spinning;
mod tied;
mod vibration;

use super::texts::BodyRun;
use crate::{Capability, Case, CaseError, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "implicit_dynamics",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Inertia,
        Capability::Implicit,
        Capability::Coulomb,
        Capability::FiniteSliding,
        Capability::Plasticity,
        Capability::FiniteStrain,
        Capability::Loads,
    ],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    vibration::run(ledger)?;
    handed::run(ledger)?;
    sliding::run(ledger)?;
    plastic::run(ledger)?;
    spinning::run(ledger)?;
    blow::run(ledger)?;
    tied::run(ledger)
}

/// Largest energy that the budget of a run misses, over its largest part.
fn imbalance(done: &BodyRun) -> f64 {
    done.report.energy.imbalance
}

/// Displacement along x of a point of the scene after each step [m].
fn along_x(done: &BodyRun, point: usize) -> Vec<f64> {
    done.record.samples().iter().map(|s| s.points[point].displacement[0]).collect()
}
