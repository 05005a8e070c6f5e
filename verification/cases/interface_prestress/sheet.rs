//! A sheet in plane stress that carries its weight.

use super::super::texts::simulate_in;
use super::FOLDER;
use crate::{Capability, CaseError, Evidence, Ledger};

const SHEET: &str = r#"schema = 1
title = "a sheet under its weight"
kinematics = "plane-stress"
[materials.rock]
young = "50 GPa"
poisson = 0.25
density = 2700
[bodies.sheet]
mesh.block = { min = [0, -8], max = [4, 0], divisions = [2, 4], element = "quad4" }
material = "rock"
gravity = [0, -9.81]
initial_stress = { kind = "lithostatic", level = 0, k0 = 0.5 }
[[stages]]
name = "rest"
duration = 1
conditions = [{ set = "sheet.bottom", y = 0 }, { set = "sheet.left", x = 0 }, { set = "sheet.right", x = 0 }]
[time]
stepper = "implicit"
"#;

pub fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = simulate_in(SHEET, FOLDER)?;
    let end = done.record.stage_end("rest").ok_or("the stage was not reached")?;
    let stress = &end.bodies.as_ref().ok_or("no fields")?.cell_stress;
    let largest = 2700.0 * 9.81 * 8.0;
    let through = stress.iter().map(|s| s[2].abs()).fold(0.0, f64::max);
    ledger
        .claim("stress through the thickness of a sheet that carries its weight, over the largest vertical stress")
        .value(through / largest)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "plane stress")
        .because("rounding")
        .why_not_tighter("it may be zero to the last bit")
        .covers(&[Capability::PlaneStress, Capability::Loads])
        .cost(&done.cost)
        .record();
    let across = stress.iter().map(|s| (s[0] - 0.5 * s[1]).abs()).fold(0.0, f64::max);
    let vertical: f64 = stress.iter().map(|s| s[1]).sum::<f64>() / stress.len() as f64;
    ledger
        .claim("horizontal stress of that sheet less K0 times the vertical one, over the largest vertical stress")
        .value(across / largest)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "K0 = 0.5, and nothing moves between rollers")
        .because("rounding of balanced forces")
        .why_not_tighter("rounding depends on the order of sums")
        .covers(&[Capability::PlaneStress, Capability::Loads])
        .cost(&done.cost)
        .record();
    ledger
        .claim("mean vertical stress of that sheet")
        .unit("Pa")
        .value(vertical)
        .equals(-0.5 * largest)
        .relative(1e-9)
        .evidence(Evidence::Exact, "rho g H/2")
        .because("rounding of balanced forces")
        .why_not_tighter("rounding depends on the order of sums")
        .covers(&[Capability::PlaneStress, Capability::Loads])
        .cost(&done.cost)
        .record();
    Ok(())
}
