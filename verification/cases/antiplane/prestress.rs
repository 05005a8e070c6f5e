//! Initial stress in antiplane motion: what holds it at the sides of a box, and its shear traction on inclined faults.

use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_plan::faults::Plan;

use super::simulate;

/// Unlike components, in one box: a stress exchanged or of the wrong sign loads other sides \[Pa\].
const YZ: f64 = 3e6;
const ZX: f64 = 7e6;
/// Stress in the plane that presses the faults \[Pa\].
const PRESSED: [f64; 3] = [-40e6, -60e6, 5e6];

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    held(ledger)?;
    for dip in [90.0, 60.0, 30.0] {
        resolved(ledger, dip)?;
    }
    Ok(())
}

/// A box of width 3 and height 2 that its sides hold against the stress.
fn held(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = format!(
        r#"
schema = 1
title = "a box held against its stress"
kinematics = "antiplane"
[materials.rock]
young = "25 GPa"
poisson = 0.25
[bodies.B]
mesh.block = {{ min = [0, 0], max = [3, 2], size = 0.25, element = "quad4" }}
material = "rock"
initial_stress = [{YZ:?}, {ZX:?}]
[[stages]]
name = "hold"
duration = 1
steps = 1
conditions = [{{ set = "B.left", z = 0 }}, {{ set = "B.right", z = 0 }}, {{ set = "B.bottom", z = 0 }}, {{ set = "B.top", z = 0 }}]
[time]
stepper = "implicit"
[output]
forces.bottom = {{ set = "B.bottom" }}
forces.left = {{ set = "B.left" }}
forces.right = {{ set = "B.right" }}
forces.top = {{ set = "B.top" }}
"#
    );
    let (samples, cost) = simulate(&text)?;
    let found: Vec<f64> = samples.forces.iter().map(|f| f[2] / (2.0 * ZX)).collect();
    ledger
        .claim("forces along z that hold the bottom, left, right and top of a box against its initial stress, over sigma_zx times the height")
        .values(&found)
        .equals_each(&[-3.0 * YZ, -2.0 * ZX, 2.0 * ZX, 3.0 * YZ].map(|f| f / (2.0 * ZX)))
        .relative(1e-13)
        .evidence(Evidence::Exact, "sigma_yz on faces along x, sigma_zx on faces along y, times lengths")
        .because("the stress is uniform and nothing moves: rounding of sums over a hundred cells")
        .why_not_tighter("rounding depends on the order of sums")
        .covers(&[Capability::Antiplane, Capability::Loads])
        .cost(&cost)
        .record();
    Ok(())
}

/// A fault from the surface of a box down to half its depth.
fn fault(dip: f64, stress: &str, normal: &str) -> Result<Plan, CaseError> {
    let (s, c) = dip.to_radians().sin_cos();
    seas::plan(&format!(
        r#"
schema = 1
title = "a stress resolved"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.crust]
material = "rock"
mesh.fault = {{ trace = [[0.0, 0.0], [{:?}, -10e3]], spacing = "1 km", min = ["-15 km", "-20 km"], max = ["35 km", 0.0], growth = 1.5, element = "quad9" }}
initial_stress = [{stress}]
[faults.main]
minus = "crust.fault.minus"
plus = "crust.fault.plus"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
{normal}
rate = "1e-9 m/s"
[[stages]]
name = "torn"
duration = "1 yr"
conditions = [{{ set = "crust.left", z = {{ rate = "-1e-9 m/s" }} }}, {{ set = "crust.right", z = {{ rate = "1e-9 m/s" }} }}]
[time]
stepper = "fault-ode"
"#,
        10e3 * c / s,
    ))
}

/// Normal and shear tractions of all points at the start \[Pa\].
fn tractions(plan: &Plan) -> [Vec<f64>; 2] {
    let (fault, start) = (&plan.problem.fault, &plan.problem.start);
    let rates = fault.slip_rates(start);
    let rates = rates.component(0);
    let shear = |p: usize| fault.normal[p] * fault.law.scale(p) * start[p] + fault.damping[p] * rates[p];
    [fault.normal.clone(), (0..plan.points.len()).map(shear).collect()]
}

fn resolved(ledger: &mut Ledger, dip: f64) -> Result<(), CaseError> {
    // The plus side is above the fault, and the normal points to it.
    let (x, y) = dip.to_radians().sin_cos();
    let exact = ZX * x + YZ * y;
    let [xx, yy, xy] = PRESSED;
    let pressed = -(xx * x * x + yy * y * y + 2.0 * xy * x * y);
    let all = format!("{xx:?}, {yy:?}, -50e6, {xy:?}, {YZ:?}, {ZX:?}");
    let (of_two, cost) = Cost::measure(|| fault(dip, &format!("{YZ:?}, {ZX:?}"), "normal = \"50 MPa\""));
    let ([_, shear], [normal, same]) = (tractions(&of_two?), tractions(&fault(dip, &all, "")?));
    for (what, found, exact) in [
        ("tau_0 of an initial stress given by yz and zx", shear, exact),
        ("tau_0 of an initial stress given by all six components", same, exact),
        ("f_n of an initial stress given by all six components", normal, pressed),
    ] {
        let found: Vec<f64> = found.iter().map(|t| t / exact).collect();
        ledger
            .claim(format!("{what}, dip {dip}: over its exact value, all points"))
            .values(&found)
            .equals_each(&vec![1.0; found.len()])
            .relative(1e-14)
            .evidence(Evidence::Exact, "tau_0 = sigma_zx sin(dip) + sigma_yz cos(dip), f_n = -n sigma n")
            .because("a uniform stress on a plane: some ten roundings of normals, components and states")
            .why_not_tighter("the errors of ten roundings may add up")
            .covers(&[Capability::FaultCycles, Capability::Antiplane, Capability::Loads])
            .cost(&cost)
            .record();
    }
    Ok(())
}
