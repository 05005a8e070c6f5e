//! Bodies in antiplane motion end to end, against closed forms.

use crate::common::{close, displacements, fields, planned, simulate, varied};
use asperity_vary::Change::{Add, With, WithOrSame};

/// G for E = 10 GPa and a Poisson's ratio of a quarter.
const SHEAR: f64 = 4e9;

/// A block of 2 x 1 m with these lines in its material, its table and its stages.
fn scene(element: &str, material: &str, body: &str, stages: &str) -> String {
    format!(
        r#"
schema = 1
title = "antiplane"
kinematics = "antiplane"
[materials.m]
young = "10 GPa"
poisson = 0.25
{material}
[bodies.B]
mesh.block = {{ min = [0, 0], max = [2, 1], divisions = [3, 2], grading = [2, 1], element = "{element}" }}
material = "m"
{body}
{stages}
[time]
stepper = "implicit"
"#
    )
}

/// A stage of 1 s in `steps` steps.
fn stage(name: &str, steps: usize, conditions: &str) -> String {
    format!("[[stages]]\nname = \"{name}\"\nduration = 1\nsteps = {steps}\nconditions = [{conditions}]\n")
}

#[test]
fn a_block_is_sheared_uniformly_by_its_sides_or_by_a_traction() {
    let strain = 1e-3;
    for element in ["quad4", "quad8", "quad9", "tri3", "tri6"] {
        for load in [r#"z = { to = "2 mm" }"#, r#"traction = [{ to = "4 MPa" }]"#] {
            let conditions = format!(r#"{{ set = "B.left", z = 0 }}, {{ set = "B.right", {load} }}"#);
            let (report, record) = simulate(&scene(element, "", "", &stage("shear", 1, &conditions)));
            assert_eq!(report.plan.dofs, record.setup().mesh.nodes.len());
            for (x, u) in displacements(&record, |x| x[0] > 0.0) {
                close(u[2], strain * x[0], 1e-12);
                assert_eq!(u[..2], [0.0, 0.0]);
            }
            let fields = fields(&record);
            for (s, mises) in fields.cell_stress.iter().zip(&fields.cell_mises) {
                close(s[5], SHEAR * strain, 1e-11);
                close(*mises, 3f64.sqrt() * SHEAR * strain, 1e-11);
                assert!(s[..4].iter().all(|s| *s == 0.0) && s[4].abs() < 1e-11 * SHEAR * strain, "{s:?}");
            }
        }
    }
}

#[test]
fn a_slab_sags_along_z_under_its_weight_as_a_parabola() {
    // G u'' = -rho g, u(0) = 0, u'(1) = 0.
    let conditions = r#"{ set = "B.bottom", z = 0 }"#;
    for (element, steps) in [("quad9", 1), ("tri6", 2)] {
        let text = scene(element, "density = 2500", "gravity = [-9.81]", &stage("weigh", steps, conditions));
        let (_, record) = simulate(&text);
        for (x, u) in displacements(&record, |x| x[1] > 0.0) {
            close(u[2], -2500.0 * 9.81 / SHEAR * x[1] * (1.0 - 0.5 * x[1]), 1e-11);
        }
    }
}

#[test]
fn an_initial_stress_is_in_balance_with_the_traction_it_came_from() {
    let conditions = r#"{ set = "B.bottom", z = 0 }, { set = "B.top", traction = ["3 MPa"] }"#;
    for (stress, plastic) in
        [(r#"["3 MPa", 0]"#, ""), (r#"[0, 0, 0, 0, "3 MPa", 0]"#, ""), (r#"["3 MPa", 0]"#, "plastic")]
    {
        let plasticity = "plasticity = { yield = \"1 GPa\", hardening = \"perfect\" }";
        let material = if plastic.is_empty() { "" } else { plasticity };
        let sides = r#", { set = "B.left", z = 0 }, { set = "B.right", z = 0 }"#;
        let body = format!("initial_stress = {stress}");
        let (_, record) =
            simulate(&scene("quad4", material, &body, &stage("rest", 1, &format!("{conditions}{sides}"))));
        let nothing = 1e-12 * 3e6 / SHEAR;
        assert!(displacements(&record, |_| true).iter().all(|(_, u)| u[2].abs() < nothing));
        assert!(fields(&record).cell_stress.iter().all(|s| (s[4] / 3e6 - 1.0).abs() < 1e-11));
    }
}

#[test]
fn stages_ramp_hold_and_release_a_motion_along_z() {
    let stages = [
        stage("rate", 2, r#"{ set = "B.left", z = 0 }, { set = "B.right", z = { rate = "2 mm/s" } }"#),
        stage("hold", 1, r#"{ set = "B.right", z = "hold" }"#),
        stage("free", 1, r#"{ set = "B.right", z = "free" }"#),
    ];
    for (stepper, stages) in [("implicit", &stages[..]), ("static-explicit", &stages[..2])] {
        let text =
            varied(&scene("quad4", "", "", &stages.join("\n")), &[WithOrSame("time.stepper", stepper)]);
        let (_, record) = simulate(&text);
        let stress: Vec<f64> =
            record.stage_ends().iter().map(|s| s.bodies.as_ref().unwrap().cell_stress[0][5]).collect();
        close(stress[0], SHEAR * 1e-3, 1e-11);
        close(stress[1], SHEAR * 1e-3, 1e-11);
        assert!(stress.get(2).is_none_or(|s| s.abs() < 1e-11 * stress[0]), "{stress:?}");
    }
}

#[test]
fn a_plastic_block_yields_in_shear_at_the_yield_stress_over_root_three() {
    let material = "plasticity = { yield = \"10 MPa\", hardening = \"linear\", modulus = \"1 GPa\" }";
    let conditions = r#"{ set = "B.left", z = 0 }, { set = "B.right", z = { to = "10 mm" } }"#;
    let text = scene("quad4", material, "", &stage("shear", 3, conditions));
    assert!(planned(&text).summary().physics[0].contains("plasticity, small strain, antiplane motion"));
    let (_, record) = simulate(&text);
    // With Y = Y0 + H e and e = gamma_p/sqrt 3: tau = k + (H/3) gamma_p, gamma = tau/G + gamma_p.
    let (k, h, gamma) = (10e6 / 3f64.sqrt(), 1e9 / 3.0, 5e-3);
    let tau = (k + h * gamma) / (1.0 + h / SHEAR);
    for (s, e) in fields(&record).cell_stress.iter().zip(&fields(&record).cell_plastic_strain) {
        close(s[5], tau, 1e-9);
        close(*e, (gamma - tau / SHEAR) / 3f64.sqrt(), 1e-9);
    }
}

#[test]
fn a_mesh_from_a_file_moves_along_z() {
    // Two layers in series: the traction is the same in both.
    let text = scene(
        "quad4",
        "",
        "",
        &stage("shear", 1, r#"{ set = "B.bottom", z = 0 }, { set = "B.top", traction = ["4 MPa"] }"#),
    );
    let text = varied(
        &text,
        &[
            With("bodies.B.mesh", "{ gmsh = { file = \"mixed.msh\" } }"),
            With("bodies.B.material", "{ lower = \"m\", upper = \"n\" }"),
            Add("materials.n", "{ young = \"1 GPa\", poisson = 0.25 }"),
        ],
    );
    let (_, record) = simulate(&text);
    for (_, u) in displacements(&record, |x| x[1] == 1.0) {
        close(u[2], 4e6 / SHEAR * 11.0, 1e-11);
    }
}
