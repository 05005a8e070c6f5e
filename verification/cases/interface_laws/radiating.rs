//! Radiation damping of an interface of a body of two materials, of which one lies on the interface.

use super::NORMAL;
use crate::cases::texts;
use crate::{Capability, CaseError, Evidence, Ledger};

const SCENE: &str = include_str!("layers.toml");
/// Slip rate \[m/s\], also the reference rate of the law.
const RATE: f64 = 0.1;
const MU0: f64 = 0.3;
const A: f64 = 0.1;

/// Impedance of a material of ν = 1/4 \[Pa s/m\].
fn impedance(young: f64, density: f64) -> f64 {
    (young / 2.5 * density).sqrt()
}

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = texts::simulate_in(SCENE, "interface_laws")?;
    let last = |values: &[f64]| values.last().copied().unwrap_or(f64::NAN).abs();
    // What friction does not carry.
    let friction = NORMAL * A * (0.5 * (MU0 / A).exp()).asinh();
    let points = &done.record.histories()[0].points;
    let found: Vec<f64> = points.iter().map(|p| (last(&p.shear_traction) - friction) / RATE).collect();
    let (lower, base) = (impedance(10e9, 2500.0), impedance(40e9, 2700.0));
    ledger
        .claim("radiation damping of a column of two materials that slides steadily on a base of another")
        .unit("Pa s/m")
        .values(&found)
        .equals_each(&[lower * base / (lower + base); 2])
        .relative(1e-5)
        .evidence(
            Evidence::Exact,
            "Z₁ Z₂/(Z₁ + Z₂) of the materials on both sides of the interface, Z = √(G ρ)",
        )
        .because("steps end with forces that balance to 1e-8, and damping is a twentieth of the traction")
        .why_not_tighter("the state is steady up to the error of the last steps")
        .covers(&[Capability::VelocityFriction, Capability::Implicit])
        .cost(&done.cost)
        .record();
    Ok(())
}
