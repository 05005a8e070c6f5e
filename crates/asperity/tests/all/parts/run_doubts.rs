use asperity::kinds::worst::*;
use asperity_plan::bodies::{AnyPlan, plan};
use asperity_plan::reading::scene;

const BAR: &str = r#"
schema = 1
title = "a bar"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.A]
mesh.block = { min = [0, 0], max = [4, 2], divisions = [3, 2], element = "quad8" }
material = "rock"
[[stages]]
name = "turn"
duration = 1
conditions = [{ set = "A.left", x = 0, y = 0 }]
[time]
stepper = "implicit"
"#;

/// Largest strain and rotation, and the warnings, for a displacement field `u`.
fn told(u: impl Fn(&[f64; 2]) -> [f64; 2]) -> (Largest, Vec<String>) {
    let AnyPlan::Two(plan) = plan(&scene::read(BAR).unwrap()).unwrap() else { panic!("a plane scene") };
    let u: Vec<f64> = plan.problem.model.mesh.nodes.iter().flat_map(u).collect();
    let mut worst = Worst::default();
    // The state is at its worst in the middle of the stage, and at rest at its end.
    worst.see(&plan.problem, (0.5, &[]), &[], &|| u.clone(), false);
    worst.see(&plan.problem, (1.0, &[]), &[], &|| vec![0.0; u.len()], true);
    let told = worst.warnings(&plan.problem, "turn").into_iter().map(|w| w.message).collect();
    (largest_in_block(&plan.problem.model, 0, 0.0, &u), told)
}

#[test]
fn a_rotation_is_no_strain_and_is_told_as_what_it_is_taken_for() {
    let (largest, warnings) = told(|x| [-0.06 * x[1], 0.06 * x[0]]);
    assert!((largest.rotation - 0.06).abs() < 1e-12 && largest.strain < 1e-12, "{largest:?}");
    assert!(warnings.len() == 1 && warnings[0].contains("turns by 0.060 rad"), "{warnings:?}");
    // 0.06²/2 times 10 GPa.
    assert!(warnings[0].contains("1.800e7 Pa"), "{warnings:?}");
}

#[test]
fn the_principal_strain_of_simple_shear_is_half_the_slope() {
    let (largest, warnings) = told(|x| [0.12 * x[1], 0.0]);
    assert!((largest.strain - 0.06).abs() < 1e-12 && (largest.rotation - 0.06).abs() < 1e-12);
    assert!(warnings.len() == 1 && warnings[0].contains("strained by 0.060"), "{warnings:?}");
    assert!(told(|x| [0.08 * x[1], 0.0]).1.is_empty());
}
