//! Idealisations, formulations and materials end to end, against closed forms.

use crate::common::{close, displacements, fields, planned, simulate, varied};
use asperity_output::bodies::Recorder;
use asperity_vary::Change::{Add, With, Without};

const YOUNG: f64 = 10e9;

/// A scene of one block `B`, with rollers at its left and bottom sides.
fn block(kinematics: &str, material: &str, body: &str, block: &str, stages: &str, time: &str) -> String {
    format!(
        r#"
schema = 1
title = "one block"
kinematics = "{kinematics}"
[materials.m]
young = "10 GPa"
poisson = 0.25
{material}
[bodies.B]
mesh.block = {{ {block} }}
material = "m"
{body}
{stages}
[time]
{time}
"#
    )
}

const ROLLERS: &str = r#"{ set = "B.left", symmetry = true }, { set = "B.bottom", symmetry = true }"#;
const IMPLICIT: &str = "stepper = \"implicit\"";

fn bar(element: &str) -> String {
    format!("min = [0, 0], max = [2, 1], divisions = [2, 1], element = \"{element}\"")
}

fn stage(steps: usize, condition: &str) -> String {
    format!(
        "[[stages]]\nname = \"load\"\nduration = 1\nsteps = {steps}\nconditions = [{ROLLERS}, {condition}]\n"
    )
}

#[test]
fn a_sheet_under_tension_stretches_by_youngs_modulus_alone() {
    let load = stage(1, r#"{ set = "B.right", traction = ["5 MPa", 0] }"#);
    for element in ["quad4", "quad8", "quad9", "tri3", "tri6"] {
        let (_, record) = simulate(&block("plane-stress", "", "", &bar(element), &load, IMPLICIT));
        let strain = 5e6 / YOUNG;
        for (x, u) in displacements(&record, |x| x[0] > 0.0 && x[1] > 0.0) {
            close(u[0], strain * x[0], 1e-11);
            close(u[1], -0.25 * strain * x[1], 1e-11);
        }
        assert!(fields(&record).cell_stress.iter().all(|s| s[2] == 0.0 && (s[0] / 5e6 - 1.0).abs() < 1e-10));
    }
}

/// Two cylinders, one on top of the other, under a pressure of 3 MPa.
fn cylinders(path: &str, element: &str) -> String {
    format!(
        r#"
schema = 1
title = "pressed cylinders"
kinematics = "axisymmetric"
[materials.m]
young = "10 GPa"
poisson = 0.25
[bodies.A]
mesh.block = {{ min = [0, 0], max = [1, 1], divisions = [4, 2], element = "{element}" }}
material = "m"
[bodies.B]
mesh.block = {{ min = [0, 1], max = [1, 3], divisions = [4, 2], element = "{element}" }}
material = "m"
[interfaces.joint]
slave = "A.top"
master = "B.bottom"
measure = "node-to-point"
sliding = "small"
enforcement = {{ kind = "penalty", normal = "1e12 Pa/m" }}
[[stages]]
name = "press"
duration = 1
steps = 1
conditions = [
    {{ set = "A.left", symmetry = true }},
    {{ set = "B.left", symmetry = true }},
    {{ set = "A.bottom", symmetry = true }},
    {{ set = "B.top", pressure = "3 MPa" }},
]
[time]
stepper = "implicit"
path = "{path}"
"#
    )
}

#[test]
fn cylinders_pressed_together_have_uniform_pressure() {
    // Elements of second order have no area on the axis: they are tried on a pipe, whose inner side is free.
    let pipe = |text: String| {
        let changes = [
            Without("stages[0].conditions[1]"),
            Without("stages[0].conditions[0]"),
            With("bodies.A.mesh.block.min[0]", "0.5"),
            With("bodies.B.mesh.block.min[0]", "0.5"),
        ];
        varied(&text, &changes)
    };
    let pi = std::f64::consts::PI;
    for path in ["condensed", "full"] {
        for (text, area) in [(cylinders(path, "quad4"), pi), (pipe(cylinders(path, "quad9")), 0.75 * pi)] {
            let (report, record) = simulate(&text);
            let interface = &record.stage_ends()[0].interfaces[0];
            for traction in &interface.normal_traction {
                close(*traction, 3e6, 1e-9);
            }
            let exact = -3e6 * (3.0 / YOUNG + 1.0 / 1e12);
            for (_, u) in displacements(&record, |x| x[1] == 3.0) {
                close(u[1], exact, 1e-9);
            }
            // The areas are those of the full circle.
            close(record.areas(0).iter().sum(), area, 1e-12);
            close(report.balance[0].slave_force[1].abs(), 3e6 * area, 1e-9);
        }
    }
}

const PLASTIC: &str = r#"plasticity = { yield = "20 MPa", hardening = "linear", modulus = "1 GPa" }"#;

/// Stress of a bar with linear hardening at an axial strain.
fn uniaxial(strain: f64) -> f64 {
    let tangent = YOUNG * 1e9 / (YOUNG + 1e9);
    20e6 + tangent * (strain - 20e6 / YOUNG)
}

#[test]
fn a_plastic_bar_follows_its_tangent_modulus() {
    let strain = 5e-3;
    let pull = |steps| stage(steps, r#"{ set = "B.right", x = { to = "10 mm" } }"#);
    let forward = "stepper = \"static-explicit\"\nmax_step = 0.1";
    for (time, steps) in [(IMPLICIT, 5), (forward, 10)] {
        for kinematics in ["plane-stress", "axisymmetric"] {
            let bar = if kinematics == "axisymmetric" {
                "min = [0, 0], max = [1, 2], divisions = [1, 2], element = \"quad4\""
            } else {
                &bar("quad4")
            };
            let stages = if kinematics == "axisymmetric" {
                stage(steps, r#"{ set = "B.top", y = { to = "10 mm" } }"#)
            } else {
                pull(steps)
            };
            let (_, record) = simulate(&block(kinematics, PLASTIC, "", bar, &stages, time));
            let axis = usize::from(kinematics == "axisymmetric");
            let fields = fields(&record);
            for (s, e) in fields.cell_stress.iter().zip(&fields.cell_plastic_strain) {
                close(s[axis], uniaxial(strain), 1e-6);
                close(*e, (uniaxial(strain) - 20e6) / 1e9, 1e-6);
            }
        }
    }
}

#[test]
fn a_forward_step_ends_where_the_bar_begins_to_yield() {
    let text = block(
        "plane-stress",
        PLASTIC,
        "",
        &bar("quad4"),
        &stage(1, r#"{ set = "B.right", x = { to = "10 mm" } }"#),
        "stepper = \"static-explicit\"",
    );
    assert!(planned(&text).summary().stepper.contains("r1"));
    let (report, _) = simulate(&text);
    let first = &report.steps[0];
    assert!(first.limited_by.contains("r1"), "{}", first.limited_by);
    close(first.time, 20e6 / YOUNG * 2.0 / 10e-3, 1e-9);
}

#[test]
fn hardenings_are_those_of_their_formulas() {
    let strain = 5e-3;
    let plastic = |e: f64, y: f64| strain - y / YOUNG - e;
    for (hardening, law) in [
        (
            r#"{ yield = "20 MPa", hardening = "perfect" }"#,
            Box::new(|_: f64| 20e6) as Box<dyn Fn(f64) -> f64>,
        ),
        (
            r#"{ yield = "20 MPa", hardening = "power", strain = 0.001, exponent = 0.2 }"#,
            Box::new(|e: f64| 20e6 * (1.0 + e / 0.001).powf(0.2)),
        ),
        (
            r#"{ hardening = "table", table = [[0, "20 MPa"], [0.002, "26 MPa"], [0.01, "30 MPa"]] }"#,
            Box::new(|e: f64| if e < 0.002 { 20e6 + 3e9 * e } else { 26e6 + 0.5e9 * (e - 0.002) }),
        ),
    ] {
        let stages = stage(5, r#"{ set = "B.right", x = { to = "10 mm" } }"#);
        let text =
            block("plane-stress", &format!("plasticity = {hardening}"), "", &bar("quad4"), &stages, IMPLICIT);
        let (_, record) = simulate(&text);
        let fields = fields(&record);
        let (stress, e) = (fields.cell_stress[0][0], fields.cell_plastic_strain[0]);
        close(stress, law(e), 1e-9);
        assert!(plastic(e, stress).abs() < 1e-9, "{e} {stress}");
    }
}

#[test]
fn simple_shear_under_the_jaumann_rate_is_the_sine_of_the_angle() {
    // All nodes are prescribed: the motion is known and the stress follows.
    let gamma: f64 = 1.5;
    let stages = format!(
        "[[stages]]\nname = \"shear\"\nduration = 1\nsteps = 300\nconditions = [{{ set = \"B.bottom\", x = 0, y = 0 }}, \
         {{ set = \"B.top\", x = {{ to = {gamma} }}, y = 0 }}]\n"
    );
    let unit = r#"min = [0, 0], max = [1, 1], divisions = [1, 1], element = "quad4""#;
    let text = block("plane-strain", "", "strain = \"finite\"", unit, &stages, IMPLICIT);
    assert!(planned(&text).summary().physics[0].contains("large deformation"));
    let (_, record) = simulate(&text);
    let shear = YOUNG / 2.5;
    let stress = fields(&record).cell_stress[0];
    close(stress[3], shear * gamma.sin(), 1e-4);
    close(stress[0], shear * (1.0 - gamma.cos()), 1e-4);
}

/// Shear stress after each stage of a block whose shear is held at 0.1 %.
fn relaxed(record: &Recorder) -> Vec<f64> {
    record.stage_ends().iter().map(|s| s.bodies.as_ref().unwrap().cell_stress[0][3]).collect()
}

#[test]
fn a_maxwell_body_relaxes_exponentially() {
    let shear = YOUNG / 2.5;
    let stages = "[[stages]]\nname = \"shear\"\nduration = \"1 s\"\nsteps = 1\nconditions = [{ set = \"B.bottom\", x = 0, y = 0 }, \
                  { set = \"B.top\", x = { to = 1e-3 }, y = 0 }]\n\
                  [[stages]]\nname = \"relax\"\nduration = \"10 yr\"\nsteps = 3\n";
    let unit = r#"min = [0, 0], max = [1, 1], divisions = [1, 1], element = "quad4""#;
    let decade = 10.0 * 365.25 * 86400.0;
    let run = |material: &str| {
        let (_, record) = simulate(&block("plane-strain", material, "", unit, stages, IMPLICIT));
        let stress = relaxed(&record);
        close(stress[0], shear * 1e-3, 1e-6);
        stress[1] / stress[0]
    };
    close(run("viscosity = \"1e18 Pa s\""), (-shear * decade / 1e18).exp(), 1e-9);
    let half = run("maxwell = [{ share = 0.5, viscosity = \"1e18 Pa s\" }]");
    close(half, 0.5 + 0.5 * (-0.5 * shear * decade / 1e18).exp(), 1e-9);
    close(run("viscosity = \"1 GPa yr\""), (-shear * 10.0 / 1e9).exp(), 1e-6);
}

#[test]
fn weight_and_initial_stress_act_on_a_plastic_body_as_on_an_elastic_one() {
    let column = r#"min = [0, 0], max = [1, 2], divisions = [1, 3], element = "quad9""#;
    let body = "gravity = [0, -9.81]\ninitial_stress = [\"-1 MPa\", \"-1 MPa\", 0]";
    let stages = stage(1, r#"{ set = "B.top", pressure = "1.2 MPa" }"#);
    let ends: Vec<Vec<f64>> = ["", "plasticity = { yield = \"1 GPa\", hardening = \"perfect\" }"]
        .iter()
        .map(|plasticity| {
            let material = format!("density = 2500\n{plasticity}");
            let (_, record) = simulate(&block("plane-strain", &material, body, column, &stages, IMPLICIT));
            let stress = fields(&record).cell_stress.iter().map(|s| s[1] / 1e6);
            displacements(&record, |x| x[1] > 0.0).iter().map(|(_, u)| u[1] * 1e4).chain(stress).collect()
        })
        .collect();
    assert_eq!(ends[0].len(), ends[1].len());
    for (a, b) in ends[0].iter().zip(&ends[1]) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn b_bar_bears_incompressible_bending_that_locks_the_standard_element() {
    let beam = r#"min = [0, 0], max = [10, 1], divisions = [20, 4], element = "quad4""#;
    let stages = "[[stages]]\nname = \"bend\"\nduration = 1\nsteps = 1\nconditions = [{ set = \"B.left\", x = 0, y = 0 }, \
                  { set = \"B.right\", traction = [0, \"1 kPa\"] }]\n";
    let tip = |formulation: &str| {
        let formulation = format!("formulation = \"{formulation}\"");
        let text = block("plane-strain", "", &formulation, beam, stages, IMPLICIT);
        let text = varied(&text, &[With("materials.m.poisson", "0.4999")]);
        let (_, record) = simulate(&text);
        displacements(&record, |x| x[0] == 10.0 && x[1] == 0.0)[0].1[1]
    };
    // Bending of a long beam in plane strain, F L^3 (1 - nu^2)/(3 E I), without shear deformation.
    let exact = 1e3 * 1000.0 * (1.0 - 0.4999_f64.powi(2)) / (3.0 * YOUNG / 12.0);
    assert!((tip("b-bar") / exact - 1.0).abs() < 0.05, "{} {exact}", tip("b-bar"));
    assert!(tip("standard") < 0.6 * exact, "{} {exact}", tip("standard"));
}

#[test]
fn a_plan_says_which_bodies_are_not_linear_and_takes_the_full_path() {
    let plastic =
        r#"{ young = "10 GPa", poisson = 0.25, plasticity = { yield = "1 GPa", hardening = "perfect" } }"#;
    let text =
        varied(&cylinders("auto", "quad4"), &[With("bodies.A.material", "p"), Add("materials.p", plastic)]);
    let plan = planned(&text);
    let summary = plan.summary();
    assert!(summary.path.contains("full: in body `A` its material is not elastic"), "{}", summary.path);
    assert!(summary.physics.iter().any(|l| l.contains("plasticity, small strain") && l.ends_with(": A)")));
    let (_, record) = simulate(&text);
    for traction in &record.stage_ends()[0].interfaces[0].normal_traction {
        close(*traction, 3e6, 1e-9);
    }
}

#[test]
fn the_thick_walled_cylinder_yields_from_the_inside() {
    let text = include_str!("../../../../scenes/cylinder.toml");
    let (young, poisson, limit) = (210e9, 0.3, 240e6 / 3.0_f64.sqrt());
    let (a, b) = (0.1, 0.2);
    let outer = |record: &Recorder, stage: usize| {
        let nodes = &record.setup().mesh.nodes;
        let u = &record.stage_ends()[stage].bodies.as_ref().unwrap().displacement;
        nodes.iter().zip(u).find(|(x, _)| x[0] > 0.2 - 1e-12).unwrap().1[0]
    };
    // Below the yield pressure: Lame's solution.
    let (_, elastic) = simulate(&varied(text, &[With("stages[0].conditions[2].pressure.to", "100 MPa")]));
    let lame = 2.0 * 100e6 * a * a * b * (1.0 - poisson * poisson) / (young * (b * b - a * a));
    close(outer(&elastic, 0), lame, 1e-6);
    assert!(outer(&elastic, 1).abs() < 1e-9 * lame);
    assert!(fields(&elastic).cell_plastic_strain.iter().all(|e| *e == 0.0));
    // Above it: the plastic radius c from p = k (1 - c^2/b^2 + 2 ln(c/a)), which assumes that the axial stress is the
    // mean of the others (Hill). This is 2 % off, and c by less than a cell. The plastic region stays plastic after the
    // pressure is removed.
    let (_, plastic) = simulate(text);
    let pressure = |c: f64| limit * (1.0 - c * c / (b * b) + 2.0 * (c / a).ln());
    let (mut low, mut high) = (a, b);
    for _ in 0..60 {
        let c = 0.5 * (low + high);
        if pressure(c) < 180e6 { low = c } else { high = c }
    }
    let hill = 2.0 * limit * low * low * (1.0 - poisson * poisson) / (young * b);
    close(outer(&plastic, 0), hill, 0.02);
    let mesh = &plastic.setup().mesh;
    for (cell, e) in mesh.cells.iter().zip(&fields(&plastic).cell_plastic_strain) {
        let (inner, end) =
            cell.points.iter().map(|&n| mesh.nodes[n][0]).fold((b, a), |(l, h), r| (l.min(r), h.max(r)));
        assert!(end > low - 0.005 || *e > 0.0, "no plastic strain at {end}");
        assert!(inner < low + 0.005 || *e == 0.0, "plastic strain {e} at {inner}");
    }
}

#[test]
fn cooks_membrane_rises_as_it_should() {
    let (_, record) = simulate(include_str!("../../../../scenes/cook.toml"));
    let tip = displacements(&record, |x| x[0] > 47.99 && (x[1] - 52.0).abs() < 1e-9);
    close(tip[0].1[1], 23.96, 2e-3);
}

/// Two layers of a mixed mesh, both plastic, pressed together.
const LAYERS: &str = r#"
schema = 1
title = "plastic layers in contact"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
plasticity = { yield = "20 MPa", hardening = "linear", modulus = "1 GPa" }
[bodies.A]
mesh.gmsh = { file = "mixed.msh", groups = ["lower"] }
material = "rock"
[bodies.B]
mesh.gmsh = { file = "mixed.msh", groups = ["upper"] }
material = "rock"
[interfaces.f]
slave = "A.fault"
master = "B.fault"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "coulomb", mu = 0.3 }
[[stages]]
name = "press"
duration = "1 s"
conditions = [{ set = "A.bottom", x = 0, y = 0 }, { set = "B.top", x = 0, y = { to = "-5 mm" } }]
[time]
stepper = "static-explicit"
max_step = 0.02
"#;

#[test]
fn forward_steps_of_plastic_bodies_in_contact_reach_the_implicit_traction() {
    let mean = |text: &str| {
        let (report, _) = simulate(text);
        assert!(planned(text).summary().path.starts_with("full"));
        report.results[0].mean_normal_traction
    };
    let implicit = varied(LAYERS, &[With("time.stepper", "implicit")]);
    close(mean(LAYERS), mean(&implicit), 1e-3);
}
