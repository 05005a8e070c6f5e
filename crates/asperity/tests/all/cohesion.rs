//! Cohesion of interfaces and of faults between bodies with mass.

use crate::common::{planned, simulate, varied};
use asperity_mechanics::dynamics::{Explicit, ForcedWeakening};
use asperity_output::bodies::Recorder;
use asperity_plan::bodies::AnyPlan as Bodies;
use asperity_plan::dynamics;
use asperity_plan::dynamics::AnyPlan;
use asperity_plan::reading::scene;
use asperity_vary::Change::{Add, With, WithOrSame};

/// A block on a plate, pressed and then pushed along it until all of it slides, in the plane or in space.
struct PushedBlock<'a> {
    in_space: bool,
    measure: &'a str,
    enforcement: &'a str,
    stepper: &'a str,
    law: &'a str,
}

impl PushedBlock<'_> {
    fn text(&self) -> String {
        let Self { in_space, measure, enforcement, stepper, law } = self;
        let [kinematics, element, z] =
            if *in_space { ["3d", "hex8", ", 0"] } else { ["plane-strain", "quad4", ""] };
        let [one, held] = if *in_space { [", 1", ", z = 0"] } else { ["", ""] };
        let cells = if *in_space { ", 2" } else { "" };
        format!(
            r#"schema = 1
title = "a block that sticks to a plate"
kinematics = "{kinematics}"
[materials.m]
young = 1000
poisson = 0.2
[bodies.plate]
mesh.block = {{ min = [-1, -1{z}], max = [2, 0{one}], divisions = [6, 2{cells}], element = "{element}" }}
material = "m"
[bodies.block]
mesh.block = {{ min = [0, 0{z}], max = [1, 0.5{one}], divisions = [3, 2{cells}], element = "{element}" }}
material = "m"
[interfaces.joint]
slave = "block.bottom"
master = "plate.top"
measure = "{measure}"
sliding = "small"
enforcement = {{ {enforcement}, tangential = "10 E/h" }}
law = {{ {law} }}
[[stages]]
name = "press"
duration = 1
frictionless = ["joint"]
conditions = [{{ set = "plate.bottom", x = 0, y = 0{held} }}, {{ set = "block.top", x = 0, y = {{ to = -0.02 }}{held} }}]
[[stages]]
name = "push"
duration = 1
steps = 10
conditions = [{{ set = "plate.bottom", x = 0, y = 0{held} }}, {{ set = "block.top", x = {{ to = 0.06 }}, y = "hold"{held} }}]
[time]
stepper = "{stepper}"
[output]
probes.joint = 3
"#
        )
    }

    /// Asserts that the closed points carry c + μ f_n each, and all together c A + μ N.
    fn assert_holds(&self, (cohesion, mu): (f64, f64)) {
        let text = self.text();
        let (_, record) = simulate(&text);
        let end = &record.stage_ends().last().unwrap().interfaces[0];
        let (mut force, mut expected) = (0.0, 0.0);
        for p in 0..end.area.len() {
            let (normal, shear, area) = (end.normal_traction[p], end.shear_traction[p], end.area[p]);
            force += area * shear.abs();
            if normal > 0.0 {
                expected += area * (cohesion + mu * normal);
                let strength = cohesion + mu * normal;
                assert!((shear.abs() / strength - 1.0).abs() < 1e-6, "{p}: {shear} {strength}\n{text}");
            } else {
                assert_eq!(shear, 0.0, "{p}\n{text}");
            }
        }
        assert!(
            expected > 0.9 * cohesion && (force / expected - 1.0).abs() < 1e-6,
            "{force} {expected}\n{text}"
        );
    }
}

const PENALTY: &str = r#"kind = "penalty", normal = "10 E/h""#;
const UZAWA: &str = r#"kind = "uzawa", normal = "10 E/h", penetration = "1e-9 h""#;
const MIXED: &str = r#"kind = "augmented-lagrangian", normal = "1 E/h""#;
const COULOMB: &str = r#"kind = "coulomb", mu = 0.3, cohesion = 1.5"#;
const WEAKENING: &str = r#"kind = "slip-weakening", mu_s = 0.35, mu_k = 0.3, d_c = 0.01, cohesion = 1.5"#;

/// The force that moves a block held by cohesion and friction is c A + μ N, whatever enforces contact.
#[test]
fn a_sliding_block_carries_cohesion_times_area_and_friction_times_force() {
    for (measure, enforcement, stepper, law) in [
        ("node-to-point", PENALTY, "implicit", COULOMB),
        ("mortar", PENALTY, "implicit", WEAKENING),
        ("node-to-point", UZAWA, "implicit", WEAKENING),
        ("mortar", UZAWA, "implicit", COULOMB),
        ("mortar", MIXED, "implicit", COULOMB),
        ("node-to-point", MIXED, "implicit", WEAKENING),
        ("node-to-point", PENALTY, "static-explicit", COULOMB),
        ("mortar", PENALTY, "static-explicit", WEAKENING),
    ] {
        PushedBlock { in_space: false, measure, enforcement, stepper, law }.assert_holds((1.5, 0.3));
    }
    for (measure, stepper, law) in
        [("mortar", "implicit", WEAKENING), ("node-to-point", "static-explicit", COULOMB)]
    {
        PushedBlock { in_space: true, measure, enforcement: PENALTY, stepper, law }.assert_holds((1.5, 0.3));
    }
}

#[test]
fn a_field_of_cohesion_reaches_the_points_of_an_interface() {
    let pushed = PushedBlock {
        in_space: false,
        measure: "node-to-point",
        enforcement: PENALTY,
        stepper: "implicit",
        law: COULOMB,
    };
    let field = r#"{ cohesion = { file = "cohesion.csv" } }"#;
    let text = varied(&pushed.text(), &[Add("interfaces.joint.fields", field)]);
    let Bodies::Two(plan) = planned(&text) else { panic!("the scene is plane") };
    let mut record = Recorder::new();
    asperity::kinds::bodies::run(&Bodies::Two(plan), &mut record).unwrap();
    let end = &record.stage_ends().last().unwrap().interfaces[0];
    for p in 0..end.area.len() {
        // The file has 1 Pa at x = 0 and 3 Pa at x = 1.
        let strength =
            1.0 + 2.0 * record.setup().interfaces[0].positions[p][0] + 0.3 * end.normal_traction[p];
        assert!((end.shear_traction[p].abs() / strength - 1.0).abs() < 1e-6, "{p}: {strength}");
    }
}

/// Two half-spaces that slide past each other everywhere at once: a strip with sides that absorb what the fault radiates.
const STRIP: &str = r#"schema = 1
title = "a strip"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.A]
mesh.fault = { trace = [[0, "100 m"], [0, "-100 m"]], spacing = "100 m", min = ["-400 m", "-100 m"], max = ["400 m", "100 m"], growth = 1.0, element = "quad4" }
material = "rock"
[faults.main]
minus = "A.fault.minus"
plus = "A.fault.plus"
law = { kind = "coulomb", mu = 0.5, cohesion = "4 MPa" }
normal = "120 MPa"
shear = "70 MPa"
under_resolved = "allow"
[[stages]]
name = "slip"
duration = "4 s"
conditions = [{ set = "A.left", absorbing = true }, { set = "A.right", absorbing = true }]
[time]
stepper = "explicit"
[output]
sampling = "10 ms"
"#;

/// Slip rates of all points at the end of a run.
fn slip_rates(text: &str) -> Vec<f64> {
    let read = scene::read(text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let AnyPlan::Two(plan) = dynamics::plan(&read).unwrap_or_else(|e| panic!("{e} {:?}", e.help)) else {
        panic!("the scene is plane")
    };
    let mut explicit = Explicit::new(&plan.problem).unwrap();
    explicit.begin_stage(0).unwrap();
    while explicit.steps() <= plan.steps {
        explicit.step().unwrap();
    }
    explicit.fault().rate.all().to_vec()
}

/// A fault that slides as a whole radiates plane waves, which carry G/(2 c_s) V on each side: V = 2 (τ - c - μ f_n)/(ρ c_s).
#[test]
fn a_strip_slides_at_the_rate_that_cohesion_and_friction_leave() {
    let impedance = (2670.0 * 32e9_f64).sqrt();
    let weakened =
        r#"{ kind = "slip-weakening", mu_s = 0.5, mu_k = 0.4, d_c = "1000 km", cohesion = "4 MPa" }"#;
    // What is left of the waves of the start is 3e-6. Slip of metres weakens by 1e-5 over 1000 km.
    for (law, tolerance) in [(None, 1e-5), (Some(weakened), 1e-4)] {
        let changes: Vec<_> = law.iter().map(|law| With("faults.main.law", law)).collect();
        let text = if changes.is_empty() { STRIP.to_string() } else { varied(STRIP, &changes) };
        for rate in slip_rates(&text) {
            let expected = 2.0 * (70e6 - 4e6 - 0.5 * 120e6) / impedance;
            assert!((rate / expected - 1.0).abs() < tolerance, "{law:?}: {rate} {expected}");
        }
    }
}

/// A front that arrives everywhere at once: friction falls over the duration, and slip rates follow it.
#[test]
fn a_forced_rupture_lets_friction_fall_over_its_duration() {
    let law = r#"{ kind = "slip-weakening", mu_s = 0.6, mu_k = 0.4, d_c = "1 km", cohesion = "4 MPa" }"#;
    let forced = r#"{ centre = [0, 0], radius = "1000 km", speed = "1e12 m/s", duration = "2 s" }"#;
    let changes = [With("faults.main.law", law), Add("faults.main.forced_rupture", forced)];
    // At 1 s μ has fallen to 0.5, and at 4 s to 0.4, where it stays.
    for (duration, mu) in [("1 s", 0.5), ("4 s", 0.4)] {
        let text = varied(&varied(STRIP, &changes), &[WithOrSame("stages[0].duration", duration)]);
        let impedance = (2670.0 * 32e9_f64).sqrt();
        for rate in slip_rates(&text) {
            let expected = 2.0 * (70e6 - 4e6 - mu * 120e6) / impedance;
            // At 1 s they grow by 2.8 % within a step, behind which they lag.
            assert!((rate / expected - 1.0).abs() < 0.05, "{duration}: {rate} {expected}");
        }
    }
}

/// TPV24: T = r/(0.7 V_s) + 0.081 r_c/(0.7 V_s) (1/(1 - (r/r_c)²) - 1), with r_c = 4 km.
#[test]
fn forced_ruptures_arrive_when_the_benchmark_says() {
    let forced = r#"{ centre = [0, "-500 m"], radius = "4 km", speed = "2424.8 m/s", duration = "0.5 s" }"#;
    let text = varied(
        STRIP,
        &[
            With("faults.main.law", r#"{ kind = "slip-weakening", mu_s = 0.6, mu_k = 0.4, d_c = "40 cm" }"#),
            With("bodies.A.mesh.fault.trace", r#"[[0, "100 m"], [0, "-5.5 km"]]"#),
            With("bodies.A.mesh.fault.min", r#"["-400 m", "-5.5 km"]"#),
            Add("faults.main.forced_rupture", forced),
        ],
    );
    let read = scene::read(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let AnyPlan::Two(plan) = dynamics::plan(&read).unwrap_or_else(|e| panic!("{e} {:?}", e.help)) else {
        panic!("the scene is plane")
    };
    let fault = plan.problem.fault.as_ref().unwrap();
    let at = |depth: f64| {
        let p = plan.points.iter().position(|p| (p.at[1] + depth).abs() < 1e-6).unwrap();
        fault.forced[p].at
    };
    // The centre is a point to the rounding of its position.
    assert!(at(500.0) < 1e-9);
    // r = 2 km: 2000/2424.8 + 0.081 4000/2424.8 (4/3 - 1) = 0.824810 + 0.044540.
    assert!((at(2500.0) - 0.869_350_049).abs() < 1e-8, "{}", at(2500.0));
    assert!((at(4400.0) - (3900.0 + 324.0 * (1.0 / (1.0 - 0.950_625) - 1.0)) / 2424.8).abs() < 1e-9);
    assert_eq!([at(4500.0), at(5000.0)], [f64::INFINITY; 2]);
    // Friction falls linearly over the duration.
    let share = |time| fault.forced[plan.points.len() - 1].share(time);
    assert_eq!(share(1e9), 0.0);
    assert_eq!(ForcedWeakening { at: 2.0, duration: 0.5 }.share(2.25), 0.5);
}

#[test]
fn a_profile_of_cohesion_reaches_the_points_of_a_fault() {
    let profile = r#"{ cohesion = { along = "y", points = [["-100 m", 1e6], ["100 m", 0]] } }"#;
    let patch = r#"[{ box = { y = { from = "50 m" } }, cohesion = "3 MPa" }]"#;
    let text = varied(STRIP, &[Add("faults.main.profiles", profile), Add("faults.main.patches", patch)]);
    let rates = slip_rates(&varied(&text, &[With("stages[0].duration", "10 ms")]));
    assert_eq!(rates.len(), 3);
    // The waves of a point have not reached its neighbours to any extent: rates fall with cohesion, 3, 0.5 and 1 MPa.
    let read = scene::read(&text).unwrap();
    let AnyPlan::Two(plan) = dynamics::plan(&read).unwrap() else { panic!("the scene is plane") };
    let rate = |y: f64| rates[plan.points.iter().position(|p| (p.at[1] - y).abs() < 1e-6).unwrap()];
    assert!(rate(100.0) < rate(-100.0) && rate(-100.0) < rate(0.0), "{rates:?}");
}
