//! Energies of a bar that is stretched beyond yield.

use super::super::texts::simulate;
use crate::{Capability, CaseError, Evidence, Ledger};

const SCENE: &str = include_str!("bar.toml");
/// Young's modulus, yield stress and hardening modulus \[Pa\].
const YOUNG: f64 = 200e9;
const YIELD: f64 = 200e6;
const HARDENING: f64 = 2e9;
/// Strain at the end \[-\].
const STRAIN: f64 = 4e-3;
/// Length times height \[m²\].
const VOLUME: f64 = 20e-3 * 5e-3;

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = simulate(SCENE)?;
    let energy = &done.report.energy;
    let flow = (YOUNG * STRAIN - YIELD) / (YOUNG + HARDENING);
    let stress = YIELD + HARDENING * flow;
    let plastic = (YIELD + 0.5 * HARDENING * flow) * flow * VOLUME;
    let elastic = 0.5 * stress * stress / YOUNG * VOLUME;
    ledger
        .claim("plastic work, elastic energy and work of the motion, plane stress, quad4")
        .unit("J/m")
        .values(&["plastic", "elastic", "motions"].map(|part| energy.part(part)))
        .equals_each(&[plastic, elastic, plastic + elastic])
        .relative(1e-9)
        .evidence(Evidence::Exact, "(Y + H e_p/2) e_p and s²/(2E) of the volume, with s = Y + H e_p = E (e - e_p)")
        .because("the force is linear in every step, so that the trapezoidal rule is exact; forces are balanced to 1e-11 of the largest, and beyond yield E/H = 100 times that of plastic strain")
        .why_not_tighter("the last iteration of Newton's method leaves less than it must")
        .covers(&[Capability::Plasticity, Capability::Implicit])
        .cost(&done.cost)
        .record();
    ledger
        .claim("energy that the budget of the bar misses, over the largest part")
        .value(energy.imbalance)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "energy is put in, stored or dissipated")
        .because("as for its parts")
        .why_not_tighter("the last iteration of Newton's method leaves less than it must")
        .covers(&[Capability::Plasticity, Capability::Implicit])
        .cost(&done.cost)
        .record();
    Ok(())
}
