//! Gravity of bodies between rollers, resolved onto faults.

use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_plan::faults::Plan;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_gravity",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads],
    quick: true,
    run,
};

const DENSITY: f64 = 2670.0;
const GRAVITY: f64 = 9.81;
/// Depth of the box \[m\]; faults end at half this depth.
const DEPTH: f64 = 20e3;
/// Bound on errors of tractions over the largest one with second-order cells: rounding of an elimination of about a thousand
/// unknowns with a condition number of about 1e4, the square of the number of cells across the box.
const ROUNDING: f64 = 1e-10;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    planes(ledger)?;
    first_order(ledger)?;
    with_stress(ledger)?;
    in_space(ledger)
}

/// A fault below a free surface.
struct Dipping {
    /// \[degrees\]
    dip: f64,
    poisson: f64,
    element: &'static str,
    /// Size of cells \[m\].
    size: f64,
    /// Further keys of the body.
    body: &'static str,
    /// A stage before the one in which the fault slides, if any.
    before: &'static str,
}

impl Dipping {
    fn plan(&self) -> Result<Plan, CaseError> {
        let (s, c) = self.dip.to_radians().sin_cos();
        let end = 0.5 * DEPTH;
        let text = format!(
            r#"
schema = 1
title = "weight"
kinematics = "plane-strain"
[materials.rock]
young = "80 GPa"
poisson = {}
density = {DENSITY}
[bodies.crust]
material = "rock"
mesh.fault = {{ trace = [[0.0, 0.0], [{:?}, {:?}]], spacing = {:?}, min = ["-15 km", {:?}], max = ["35 km", 0.0], growth = 1.5, element = "{}" }}
{}
[faults.main]
minus = "crust.fault.minus"
plus = "crust.fault.plus"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal_floor = "1 kPa"
rate = "-1e-9 m/s"
{}
[[stages]]
name = "stretched"
duration = "1 yr"
conditions = [{{ set = "crust.left", x = {{ rate = "-1e-9 m/s" }} }}, {{ set = "crust.right", x = {{ rate = "1e-9 m/s" }} }}, {{ set = "crust.bottom", y = 0 }}]
[time]
stepper = "fault-ode"
"#,
            self.poisson,
            end * c / s,
            -end,
            self.size,
            -DEPTH,
            self.element,
            self.body,
            self.before
        );
        seas::plan(&text)
    }

    /// f_n and τ_0 along slip at a depth \[Pa\].
    fn exact(&self, depth: f64) -> [f64; 2] {
        let (s, c) = self.dip.to_radians().sin_cos();
        let vertical = DENSITY * GRAVITY * depth;
        let across = self.poisson / (1.0 - self.poisson) * vertical;
        [vertical * c * c + across * s * s, -(vertical - across) * s * c]
    }
}

const WEIGHS: &str = "gravity = [0, -9.81]";

/// τ_0 of a point \[Pa\].
fn shear(plan: &Plan, point: usize, rates: &[f64]) -> f64 {
    let fault = &plan.problem.fault;
    fault.normal[point] * fault.law.scale(point) * plan.problem.start[point]
        + fault.damping[point] * rates[point]
}

/// Largest errors of f_n and of τ_0 over the largest f_n. The surface point has no τ_0 from gravity, since its normal traction is
/// the floor.
fn errors(plan: &Plan, exact: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
    let rates = plan.problem.fault.slip_rates(&plan.problem.start);
    let largest = plan.problem.fault.normal.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let mut worst = [0.0_f64; 2];
    for (p, point) in plan.points.iter().enumerate() {
        let depth = -point.at[1];
        let [normal, along] = exact(depth);
        worst[0] = worst[0].max((plan.problem.fault.normal[p] - normal).abs() / largest);
        if depth > 0.0 {
            worst[1] = worst[1].max((shear(plan, p, rates.component(0)) - along).abs() / largest);
        }
    }
    worst
}

/// Draws normal tractions on the closed form.
fn overlay(ledger: &mut Ledger, plan: &Plan, case: &Dipping) {
    let points = || plan.points.iter().enumerate().map(|(p, point)| (p, -point.at[1]));
    let found: Vec<(f64, f64)> =
        points().map(|(p, z)| (z / 1e3, plan.problem.fault.normal[p] / 1e6)).collect();
    let exact: Vec<(f64, f64)> = points().map(|(_, z)| (z / 1e3, case.exact(z)[0] / 1e6)).collect();
    ledger.plot(
        Plot::xy("Normal traction under weight, dip 60 degrees", "depth [km]", "f_n [MPa]")
            .series(Series::line("closed form", &exact))
            .series(Series::points("this code", &found)),
    );
}

fn planes(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (dip, poisson) in [(60.0, 0.25), (30.0, 0.35), (45.0, 0.2), (75.0, 0.3)] {
        let case = Dipping { dip, poisson, element: "quad9", size: 1000.0, body: WEIGHS, before: "" };
        let (plan, cost) = Cost::measure(|| case.plan());
        let plan = plan?;
        if dip == 60.0 {
            overlay(ledger, &plan, &case);
        }
        let found = errors(&plan, |z| case.exact(z));
        exact(ledger, &format!("dip {dip}, nu {poisson}"), &found, &cost);
    }
    let before = r#"[[stages]]
name = "press"
duration = "1 s"
conditions = [{ set = "crust.left", x = 0 }, { set = "crust.right", x = 0 }, { set = "crust.bottom", y = 0 }]"#;
    let case = Dipping { dip: 60.0, poisson: 0.25, element: "quad9", size: 1000.0, body: WEIGHS, before };
    let (plan, cost) = Cost::measure(|| case.plan());
    let found = errors(&plan?, |z| case.exact(z));
    exact(ledger, "dip 60, nu 0.25, which acts in a stage of its own", &found, &cost);
    Ok(())
}

/// Claims that errors are due to rounding.
fn exact(ledger: &mut Ledger, what: &str, errors: &[f64], cost: &Cost) {
    for (name, error) in ["f_n", "tau_0"].iter().zip(errors) {
        ledger
            .claim(format!("{name} under weight, {what}: largest error over the largest f_n"))
            .value(*error)
            .at_most(ROUNDING)
            .evidence(Evidence::Exact, "rho g z and nu/(1 - nu) of it, resolved onto the plane")
            .because(
                "displacements of uniaxial strain are quadratic, and nodal forces of linear tractions on faces of second order are \
                 areas times values: what is left is rounding of the elimination",
            )
            .why_not_tighter("rounding grows with the number of cells across the box, and differs between processors")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads])
            .cost(cost)
            .record();
    }
}

/// First-order cells have constant stress where the exact stress is linear.
fn first_order(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut levels = Vec::new();
    let mut total = None;
    for size in [2000.0, 1000.0, 500.0, 250.0] {
        let case = Dipping { dip: 60.0, poisson: 0.25, element: "quad4", size, body: WEIGHS, before: "" };
        let (plan, cost) = Cost::measure(|| case.plan());
        let [normal, _] = errors(&plan?, |z| case.exact(z));
        levels.push((size, normal));
        total = Some(cost);
    }
    let cost = total.ok_or("no level")?;
    ledger
        .order("f_n under weight, dip 60, cells of first order")
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .evidence(Evidence::Exact, "rho g z and nu/(1 - nu) of it, resolved onto the plane")
        .because("the point at the surface is pressed with a third of what presses one cell below it, and f_n there is zero")
        .finest(
            2.0 * 250.0 / (0.5 * DEPTH),
            "a cell's depth over that of the fault; a third of it at the surface, and more where the tip concentrates what cells miss",
        )
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads])
        .cost(&cost)
        .record();
    Ok(())
}

/// Gravity added to a uniform initial stress, and its absence from the loading during the run.
fn with_stress(ledger: &mut Ledger) -> Result<(), CaseError> {
    let body = "gravity = [0, -9.81]\ninitial_stress = [\"-10 MPa\", \"-30 MPa\", \"0 MPa\"]";
    let case = Dipping { dip: 60.0, poisson: 0.25, element: "quad9", size: 1000.0, body, before: "" };
    let (plan, cost) = Cost::measure(|| case.plan());
    let plan = plan?;
    // On a plane of dip 60 degrees: f_n = 30/4 + 3/4 10, and τ is half the difference times sin 120.
    let stress = [15e6, -10e6 * 120f64.to_radians().sin()];
    let sum = |z: f64| {
        let weight = case.exact(z);
        [weight[0] + stress[0], weight[1] + stress[1]]
    };
    exact(ledger, "dip 60, with an initial stress", &errors(&plan, sum), &cost);
    let light = Dipping { body: "initial_stress = [\"-10 MPa\", \"-30 MPa\", \"0 MPa\"]", ..case }.plan()?;
    let rates = |plan: &Plan| plan.problem.loading.rates(1.0, plan.points.len(), true);
    let ((a, an), (b, bn)) = (rates(&plan), rates(&light));
    let size = a.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let off = a.iter().chain(&an).zip(b.iter().chain(&bn)).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    ledger
        .claim("rates of tractions by loads with weight less those without, over the largest")
        .value(off / size)
        .at_most(ROUNDING)
        .evidence(Evidence::Exact, "weight does not change in time")
        .because("the two condensations differ by a row of loads, and in rounding")
        .why_not_tighter("eliminations of different systems add in another order")
        .covers(&[Capability::FaultCycles])
        .cost(&cost)
        .record();
    Ok(())
}

/// A vertical fault through a 3D box, welded where the sides constrain motion along its slip.
fn in_space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let poisson = 0.3;
    let block = |name: &str, from: f64, to: f64| {
        format!(
            "[bodies.{name}]\nmaterial = \"rock\"\ngravity = [0, -9.81, 0]\nmesh.block = {{ min = [{from:?}, -8e3, 0.0], max = [{to:?}, 0.0, 4e3], divisions = [3, 8, 4], element = \"hex27\" }}\n"
        )
    };
    let held = |name: &str, side: &str| {
        format!(
            "{{ set = \"{name}.{side}\", x = 0 }}, {{ set = \"{name}.front\", z = 0 }}, {{ set = \"{name}.back\", z = 0 }}, {{ set = \"{name}.bottom\", y = 0 }}"
        )
    };
    let text = format!(
        r#"
schema = 1
title = "weight in space"
kinematics = "3d"
[materials.rock]
young = "80 GPa"
poisson = {poisson}
density = {DENSITY}
{}{}
[faults.main]
minus = "L.right"
plus = "R.left"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal_floor = "1 kPa"
rake = [0, 0, 1]
profiles.shear = {{ along = "y", points = [["-8 km", 60e6], ["0 km", 1e3]] }}
creep = {{ outside = {{ z = {{ from = 0.0, to = 4e3 }}, y = {{ from = -8e3 }} }}, rate = 0 }}
rate = "1e-9 m/s"
[[stages]]
name = "still"
duration = "1 yr"
conditions = [{}, {}]
[time]
stepper = "fault-ode"
"#,
        block("L", -3e3, 0.0),
        block("R", 0.0, 3e3),
        held("L", "left"),
        held("R", "right"),
    );
    let (plan, cost) = Cost::measure(|| seas::plan(&text));
    let plan = plan?;
    let largest = plan.problem.fault.normal.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let off = plan.points.iter().zip(&plan.problem.fault.normal).map(|(point, normal)| {
        (normal + poisson / (1.0 - poisson) * DENSITY * GRAVITY * point.at[1]).abs() / largest
    });
    exact(ledger, "a vertical fault in space, nu 0.3", &[off.fold(0.0, f64::max)], &cost);
    Ok(())
}
