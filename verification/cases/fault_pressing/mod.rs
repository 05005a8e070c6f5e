//! Faults of bodies that a stage presses before they slide.

pub(super) mod block;

use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::Layout;
use asperity_plan::faults::Plan;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_pressing",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads],
    quick: true,
    run,
};

/// Bound on errors over the largest normal traction: rounding of an elimination of about a thousand unknowns with a condition
/// number of about 1e4, the square of the number of cells across a body.
const ROUNDING: f64 = 1e-10;

/// Reason for the bound not to be tighter.
const PROCESSORS: &str =
    "rounding grows with the number of cells across a body, and differs between processors";

/// Law and initial rate of the faults.
const FAULT: &str = r#"law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.005, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }
rate = "1 um/s""#;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (dip, element) in [(60.0, "quad4"), (30.0, "quad9"), (45.0, "quad8")] {
        sawcut(ledger, dip, element)?;
    }
    in_space(ledger)?;
    block::claims(ledger)
}

/// Tractions at the start, component by component \[Pa\].
fn shear(plan: &Plan) -> Vec<f64> {
    let (fault, layout) = (&plan.problem.fault, Layout::from_fault(&plan.problem.fault));
    let m = &plan.problem.start[layout.m()];
    let n = plan.points.len();
    m.iter().enumerate().map(|(k, m)| fault.normal[k % n] * fault.law.scale(k % n) * m).collect()
}

/// Pressures on the right and the upper side of the square \[Pa\].
const PRESSURES: [f64; 2] = [40e6, 60e6];

/// A square with a cut of half its width.
fn sawcut(ledger: &mut Ledger, dip: f64, element: &str) -> Result<(), CaseError> {
    let (s, c) = f64::to_radians(dip).sin_cos();
    let (half, [right, top]) = (0.02, PRESSURES);
    let text = format!(
        r#"
schema = 1
title = "sawcut"
kinematics = "plane-strain"
[materials.rock]
young = "60 GPa"
poisson = 0.25
[bodies.rock]
material = "rock"
mesh.fault = {{ trace = [[{:?}, {:?}], [{:?}, {:?}]], spacing = 5e-3, min = [-0.04, -0.04], max = [0.04, 0.04], growth = 1.2, element = "{element}" }}
[faults.cut]
minus = "rock.fault.minus"
plus = "rock.fault.plus"
{FAULT}
[[stages]]
name = "press"
duration = "10 s"
conditions = [
    {{ set = "rock.left", symmetry = true }},
    {{ set = "rock.bottom", symmetry = true }},
    {{ set = "rock.right", pressure = {{ to = {right:?} }} }},
    {{ set = "rock.top", pressure = {top:?} }},
]
[[stages]]
name = "shear"
duration = "1 s"
conditions = [{{ set = "rock.top", pressure = {{ to = 61e6 }} }}]
[time]
stepper = "fault-ode"
"#,
        -half * c,
        half * s,
        half * c,
        -half * s,
    );
    let (plan, cost) = Cost::measure(|| seas::plan(&text));
    let plan = plan?;
    let normal = right * s * s + top * c * c;
    // The plus side is driven along the stress vector σn, in the direction of positive slip.
    let along = |p: usize| {
        let (n, e) = (plan.points[p].normal, plan.points[p].slides);
        -(right * n[0] * e[0] + top * n[1] * e[1])
    };
    let size = (right - top).abs() * s * c;
    let found = shear(&plan);
    let points = 0..plan.points.len();
    let errors = [
        points.clone().map(|p| (plan.problem.fault.normal[p] - normal).abs()).fold(0.0, f64::max) / normal,
        points.clone().map(|p| (found[p] - along(p)).abs()).fold(0.0, f64::max) / normal,
        points.map(|p| (along(p).abs() - size).abs()).fold(0.0, f64::max) / normal,
    ];
    ledger
        .claim(format!("sawcut of {dip} degrees, {element}: largest errors of f_n and of tau over f_n, and of the size of tau"))
        .values(&errors)
        .equals_each(&[0.0; 3])
        .absolute(ROUNDING)
        .evidence(Evidence::Exact, "uniform stress resolved onto a plane")
        .because("elements contain uniform strain, and nodal forces of uniform tractions are areas times them")
        .why_not_tighter(PROCESSORS)
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads])
        .cost(&cost)
        .record();
    Ok(())
}

/// Normal traction and shear traction of the fault in space \[Pa\].
const SPACE: [f64; 2] = [30e6, 6e6];

/// Two blocks that are pressed and sheared along z; slip of their fault may turn.
fn in_space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let [pressure, shearing] = SPACE;
    let block = |name: &str, from: f64, to: f64| {
        format!(
            "[bodies.{name}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{from:?}, 0, 0], max = [{to:?}, 1, 1], divisions = [2, 3, 4], element = \"hex8\" }}\n"
        )
    };
    let sides = |name: &str| {
        format!(
            "    {{ set = \"{name}.back\", traction = [{{ to = {}e6 }}, 0, 0] }},\n    {{ set = \"{name}.front\", traction = [{{ to = {}e6 }}, 0, 0] }},\n",
            -shearing / 1e6,
            shearing / 1e6
        )
    };
    let text = format!(
        r#"
schema = 1
title = "sheared in space"
kinematics = "3d"
[materials.rock]
young = "60 GPa"
poisson = 0
{}{}[faults.face]
minus = "west.right"
plus = "east.left"
rake = [0, 1, 1]
slip = "free"
{FAULT}
[[stages]]
name = "press"
duration = "10 s"
conditions = [
    {{ set = "west.left", x = 0, y = 0, z = 0 }},
    {{ set = "east.right", traction = [{{ to = {:?} }}, 0, {{ to = {shearing:?} }}] }},
{}{}]
[[stages]]
name = "shear"
duration = "1 s"
conditions = [{{ set = "east.right", traction = [{:?}, 0, {{ to = 6.1e6 }}] }}]
[time]
stepper = "fault-ode"
"#,
        block("west", -1.0, 0.0),
        block("east", 0.0, 1.0),
        -pressure,
        sides("west"),
        sides("east"),
        -pressure,
    );
    let (plan, cost) = Cost::measure(|| seas::plan(&text));
    let plan = plan?;
    let (found, n) = (shear(&plan), plan.points.len());
    let off = |p: usize| {
        let view = &plan.points[p];
        let across = view.across.unwrap_or_default();
        let vector: [f64; 3] = std::array::from_fn(|c| found[p] * view.slides[c] + found[n + p] * across[c]);
        // The stress drives the east side, which is the plus side, along z.
        let wanted = [0.0, 0.0, shearing];
        vector.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let errors = [
        (0..n).map(|p| (plan.problem.fault.normal[p] - pressure).abs()).fold(0.0, f64::max) / pressure,
        (0..n).map(off).fold(0.0, f64::max) / pressure,
    ];
    ledger
        .claim("a fault in space with a rake between two axes: largest errors of f_n and of the vector of tau, over f_n")
        .values(&errors)
        .equals_each(&[0.0; 2])
        .absolute(ROUNDING)
        .evidence(Evidence::Exact, "uniform stress, balance of forces")
        .because("elements contain uniform strain, and nodal forces of uniform tractions are areas times them")
        .why_not_tighter(PROCESSORS)
        .covers(&[Capability::FaultCycles, Capability::Loads])
        .cost(&cost)
        .record();
    Ok(())
}
