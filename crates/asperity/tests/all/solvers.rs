//! The table `[solver]` end to end: the choice of the solver, the agreement of all solvers, and messages where one
//! fails.

use crate::common::{displacements, fields, planned, simulate};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::diagnostic::Diagnostic;
use asperity_plan::reading::scene;
use asperity_run::report::Outcome;
use std::path::Path;

/// A bar clamped at its lower x, pulled by its own weight and by a traction, in `kinematics`.
fn bar(kinematics: &str, mesh: &str, material: &str, stages: &str, tables: &str) -> String {
    format!(
        r#"
schema = 1
title = "a bar"
kinematics = "{kinematics}"
[materials.m]
young = "10 GPa"
poisson = 0.3
{material}
[bodies.B]
mesh.block = {{ {mesh} }}
material = "m"
{stages}
{tables}
"#
    )
}

const IN_SPACE: &str = r#"min = [0, 0, 0], max = [4, 1, 1], divisions = [16, 4, 4], element = "hex8""#;
const IN_PLANE: &str = r#"min = [0, 0], max = [4, 1], divisions = [8, 2], element = "quad9""#;
const IMPLICIT: &str = "[time]\nstepper = \"implicit\"\n";
const FORWARD: &str = "[time]\nstepper = \"static-explicit\"\n";

fn pull(traction: &str, steps: usize) -> String {
    let clamp = if traction.matches(',').count() == 2 { "x = 0, y = 0, z = 0" } else { "x = 0, y = 0" };
    format!(
        "[[stages]]\nname = \"pull\"\nduration = 1\nsteps = {steps}\nconditions = [{{ set = \"B.left\", {clamp} }}, \
         {{ set = \"B.right\", traction = {traction} }}]\n"
    )
}

const LOAD: &str = "[{ to = 1e6 }, { to = 2e5 }, { to = -3e5 }]";
const PLANE_LOAD: &str = "[{ to = 1e6 }, { to = 2e5 }]";

fn refused(text: &str) -> Diagnostic {
    let scene = scene::read_in(text, Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    bodies::plan(&scene).unwrap_err()
}

/// Runs a scene that stops.
fn stopped(text: &str) -> (RunReport, Recorder, String) {
    let mut record = Recorder::new().with_bodies();
    let report = kinds::bodies::run(&planned(text), &mut record).unwrap();
    let Outcome::Stopped { reason, .. } = report.outcome.clone() else { panic!("{:?}", report.outcome) };
    (report, record, reason)
}

fn all(record: &Recorder) -> Vec<f64> {
    fields(record).displacement.iter().flatten().copied().collect()
}

#[track_caller]
fn agree(a: &[f64], b: &[f64], tolerance: f64) {
    let size = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(size > 0.0 && worst <= tolerance * size, "{:e}", worst / size);
}

#[test]
fn the_iterative_method_gives_the_answer_of_the_direct_one_in_space_and_in_the_plane() {
    let cases = [
        ("3d", IN_SPACE, LOAD, IMPLICIT),
        ("3d", IN_SPACE, LOAD, FORWARD),
        ("plane-strain", IN_PLANE, PLANE_LOAD, IMPLICIT),
    ];
    for (kinematics, mesh, load, time) in cases {
        let text = |solver: &str| bar(kinematics, mesh, "", &pull(load, 3), &format!("{time}{solver}"));
        let (direct, exact) = simulate(&text(""));
        assert_eq!(
            (direct.counts.operations.factorisations, direct.counts.operations.linear_iterations),
            (1, 0)
        );
        for tolerance in [1e-6, 1e-10] {
            let solver = format!("[solver]\nmethod = \"iterative\"\ntolerance = {tolerance:e}\n");
            let (report, found) = simulate(&text(&solver));
            assert_eq!(report.counts.operations.factorisations, 1, "one preconditioner a run");
            assert!(report.counts.operations.linear_iterations > 3, "{:?}", report.counts);
            // The residual is measured through the preconditioner, whose condition number is some tens.
            agree(&all(&exact), &all(&found), 100.0 * tolerance);
            assert!(
                report.plan.solver.starts_with("iterative: the scene asks for it"),
                "{}",
                report.plan.solver
            );
        }
    }
}

#[test]
fn a_linear_model_in_space_too_big_for_the_memory_is_solved_iteratively_and_the_plan_says_why() {
    let fine = r#"min = [0, 0, 0], max = [4, 1, 1], divisions = [24, 12, 12], element = "hex8""#;
    let text = |memory: &str| {
        bar("3d", fine, "", &pull(LOAD, 1), &format!("{IMPLICIT}[solver]\nmemory = \"{memory}\"\n"))
    };
    let (small, exact) = simulate(&text("1 GiB"));
    assert!(small.plan.solver.starts_with("direct: symmetric"), "{}", small.plan.solver);
    let (large, found) = simulate(&text("45 MB"));
    let words = &large.plan.solver;
    assert!(
        words.starts_with("iterative: a factorisation would take") && words.contains("42.9 MiB"),
        "{words}"
    );
    agree(&all(&exact), &all(&found), 1e-8);
}

#[test]
fn too_much_memory_is_refused_with_the_need_the_bound_and_what_could_be_done() {
    let solver = "[solver]\nmemory = \"50 kB\"\n";
    let plane =
        refused(&bar("plane-strain", IN_PLANE, "", &pull(PLANE_LOAD, 1), &format!("{IMPLICIT}{solver}")));
    assert!(plane.message.contains("the factorisation of 170 degrees of freedom needs about"), "{plane}");
    assert!(plane.message.contains("48.8 KiB are allowed"), "{plane}");
    assert!(plane.help.unwrap().contains("method = \"iterative\""));
    let space = refused(&bar("3d", IN_SPACE, "", &pull(LOAD, 1), &format!("{IMPLICIT}{solver}")));
    assert!(space.message.contains("the iterative solution of 1275 degrees of freedom"), "{space}");
    let condensed = refused(&format!("{}[solver]\nmemory = \"5 kB\"\n", two_blocks("condensed", "", "")));
    assert!(condensed.message.contains("condensing the bodies onto"), "{condensed}");
}

#[test]
fn an_iteration_that_does_not_converge_ends_the_run_with_the_last_good_state() {
    // The second stage turns the load: within three iterations only the first, without load, can be solved.
    let hold = "[[stages]]\nname = \"hold\"\nduration = 1\nsteps = 1\nconditions = [{ set = \"B.left\", x = 0, y = 0, z = 0 }]\n";
    let stages = format!("{hold}{}", pull(LOAD, 1));
    let solver = "[solver]\nmethod = \"iterative\"\nmost_iterations = 3\n";
    let (report, record, reason) = stopped(&bar("3d", IN_SPACE, "", &stages, &format!("{IMPLICIT}{solver}")));
    assert!(reason.starts_with("iterative solution: not converged after 3 iterations"), "{reason}");
    // A shorter step of a linear model is no easier to solve, and is not tried.
    assert_eq!((report.counts.steps, report.counts.rejected), (1, 1));
    assert!(all(&record).iter().all(|u| *u == 0.0));
}

#[test]
fn a_plastic_bar_is_factored_symmetrically_and_each_time_anew() {
    let material = "plasticity = { yield = \"1 MPa\", hardening = \"linear\", modulus = \"1 GPa\" }";
    let (report, record) = simulate(&bar("plane-strain", IN_PLANE, material, &pull(PLANE_LOAD, 4), IMPLICIT));
    assert!(report.plan.solver.starts_with("direct: symmetric factorisation"), "{}", report.plan.solver);
    assert!(
        report.counts.operations.factorisations > 8 && report.counts.operations.indefinite == 0,
        "{:?}",
        report.counts
    );
    assert!(fields(&record).cell_plastic_strain.iter().any(|e| *e > 1e-5));
    // The same equilibrium by conjugate gradients.
    let solver = format!("{IMPLICIT}[solver]\nmethod = \"iterative\"\n");
    let (other, found) = simulate(&bar("plane-strain", IN_PLANE, material, &pull(PLANE_LOAD, 4), &solver));
    assert!(other.counts.operations.linear_iterations > 20);
    agree(&all(&record), &all(&found), 1e-7);
}

/// Two blocks, one on top of the other, the lower one held; `conditions` of the upper one, `law` of the joint.
fn two_blocks(path: &str, law: &str, conditions: &str) -> String {
    format!(
        r#"
schema = 1
title = "two blocks"
kinematics = "plane-strain"
[materials.m]
young = "10 GPa"
poisson = 0.3
[bodies.A]
mesh.block = {{ min = [0, 0], max = [2, 1], divisions = [4, 2], element = "quad4" }}
material = "m"
[bodies.B]
mesh.block = {{ min = [0, 1], max = [2, 2], divisions = [4, 2], element = "quad4" }}
material = "m"
[interfaces.joint]
slave = "B.bottom"
master = "A.top"
measure = "node-to-point"
sliding = "small"
enforcement = {{ kind = "penalty", normal = "100 E/h"{} }}
{law}
[[stages]]
name = "press"
duration = 1
steps = 2
frictionless = [{}]
conditions = [
    {{ set = "A.bottom", x = 0, y = 0 }},
    {{ set = "B.left", x = 0 }},
    {conditions}
]
[[stages]]
name = "hold"
duration = 1
[time]
stepper = "implicit"
path = "{path}"
"#,
        if law.is_empty() { "" } else { ", tangential = \"100 E/h\"" },
        if law.is_empty() { "" } else { "\"joint\"" },
    )
}

#[test]
fn stages_without_friction_are_factored_symmetrically_on_both_paths() {
    let press = "{ set = \"B.top\", pressure = { to = \"3 MPa\" } },";
    let (_, condensed) = simulate(&two_blocks("condensed", "", press));
    let (full, record) = simulate(&two_blocks("full", "", press));
    assert!(
        full.plan.solver.starts_with("direct: symmetric factorisation (Cholesky);"),
        "{}",
        full.plan.solver
    );
    assert_eq!(full.counts.operations.indefinite, 0);
    agree(&all(&condensed), &all(&record), 1e-9);
    let law = "law = { kind = \"coulomb\", mu = 0.6 }";
    let plan = planned(&two_blocks("full", law, press));
    let words = &plan.summary().solver;
    assert!(words.contains("symmetric factorisation (Cholesky), unsymmetric (LU) in `hold`"), "{words}");
    let (sticking, _) = simulate(&two_blocks("full", law, press));
    assert_eq!(sticking.counts.operations.indefinite, 0);
}

/// Two blocks in space, the upper one pressed and pushed until it slides, with all degrees of freedom in the system.
fn pushed_blocks(strain: &str, push: &str, solver: &str) -> String {
    blocks_in_space([10, 10, 5], "full", strain, push, solver)
}

fn blocks_in_space(divisions: [usize; 3], path: &str, strain: &str, push: &str, solver: &str) -> String {
    joined_blocks(divisions, path, strain, ["node-to-point", "small", "100 E/h"], push, solver)
}

/// The same with measure, sliding and penalty of the joint.
fn joined_blocks(
    divisions: [usize; 3],
    path: &str,
    strain: &str,
    [measure, sliding, penalty]: [&str; 3],
    push: &str,
    solver: &str,
) -> String {
    let block = |z: usize| {
        format!(
            "mesh.block = {{ min = [0, 0, {z}], max = [2, 2, {}], divisions = {divisions:?}, element = \"hex8\" }}\n\
             material = \"m\"\nstrain = \"{strain}\"",
            z + 1
        )
    };
    format!(
        r#"
schema = 1
title = "two blocks in space"
kinematics = "3d"
[materials.m]
young = "10 GPa"
poisson = 0.3
[bodies.A]
{}
[bodies.B]
{}
[interfaces.joint]
slave = "B.back"
master = "A.front"
measure = "{measure}"
sliding = "{sliding}"
enforcement = {{ kind = "penalty", normal = "{penalty}", tangential = "{penalty}" }}
law = {{ kind = "coulomb", mu = 0.6 }}
[[stages]]
name = "push"
duration = 1
steps = 3
conditions = [{{ set = "A.back", x = 0, y = 0, z = 0 }}, {push}]
[time]
stepper = "implicit"
path = "{path}"
[solver]
{solver}
"#,
        block(0),
        block(1),
    )
}

#[test]
fn large_unsymmetric_systems_are_iterated_to_the_solution_of_lu() {
    let push = "{ set = \"B.front\", z = { to = \"-2 mm\" }, x = { to = \"8 mm\" }, y = { to = \"2 mm\" } }";
    for strain in ["small", "finite"] {
        let (direct, exact) = simulate(&pushed_blocks(strain, push, "method = \"direct\""));
        let (iterated, found) = simulate(&pushed_blocks(strain, push, ""));
        assert!(direct.plan.solver.contains("(LU)"), "{}", direct.plan.solver);
        assert!(iterated.plan.solver.starts_with("GMRES"), "{}", iterated.plan.solver);
        let [direct, iterated] = [direct, iterated].map(|report| report.counts.operations);
        assert_eq!((direct.linear_iterations, direct.factorisations), (0, direct.iterations));
        // A factor serves a step, or two where it slips.
        assert!(
            iterated.factorisations <= 6 && iterated.factorisations < direct.factorisations,
            "{iterated:?}"
        );
        assert!(iterated.linear_iterations > iterated.solves, "{iterated:?}");
        // Newton's method ends at 1e-11 of the largest force, which a condition number of 1e3 to 1e4 lets through.
        agree(&all(&exact), &all(&found), 1e-7);
    }
}

#[test]
fn contact_in_space_is_iterated_without_factors_whatever_the_penalty() {
    let push = "{ set = \"B.front\", z = { to = \"-2 mm\" }, x = { to = \"8 mm\" }, y = { to = \"2 mm\" } }";
    for (strain, joint) in [
        ("small", ["node-to-point", "small", "100 E/h"]),
        ("small", ["mortar", "small", "1e6 E/h"]),
        ("small", ["mortar", "finite", "100 E/h"]),
        ("finite", ["node-to-point", "finite", "1 E/h"]),
    ] {
        let text = |solver: &str| joined_blocks([10, 10, 5], "full", strain, joint, push, solver);
        let (direct, exact) = simulate(&text("method = \"direct\""));
        let (iterated, found) = simulate(&text("method = \"iterative\""));
        let words = &iterated.plan.solver;
        assert!(words.starts_with("iterative: the scene asks for it; GMRES to 1e-5"), "{words}");
        let [direct, iterated] = [direct, iterated].map(|report| report.counts.operations);
        assert!(iterated.iterations <= direct.iterations + 4, "{joint:?}: {iterated:?} {direct:?}");
        // Twice what mortar contact in finite sliding takes; the others take 12 to 14.
        let most = 70 * iterated.solves;
        assert!((1..most).contains(&iterated.linear_iterations), "{joint:?}: {iterated:?}");
        agree(&all(&exact), &all(&found), 1e-7);
    }
}

#[test]
fn contact_whose_factors_take_long_is_iterated_and_the_plan_says_why() {
    let push = "{ set = \"B.front\", z = { to = \"-2 mm\" }, x = { to = \"8 mm\" } }";
    let text = |solver: &str| blocks_in_space([24, 24, 16], "full", "small", push, solver);
    for (solver, expected) in [
        ("", "iterative: a factorisation takes longer; GMRES to 1e-5 of the load"),
        ("tolerance = 1e-7", "iterative: a factorisation takes longer; GMRES to 1e-7 of the load"),
        ("method = \"direct\"", "direct: unsymmetric factorisation (LU)"),
    ] {
        let plan = planned(&text(solver));
        let words = &plan.summary().solver;
        assert!(words.starts_with(expected), "{words}");
    }
}

#[test]
fn contact_too_big_for_the_memory_is_iterated_and_the_plan_says_why() {
    let push = "{ set = \"B.front\", z = { to = \"-2 mm\" }, x = { to = \"8 mm\" } }";
    let text = |solver: &str| blocks_in_space([12, 12, 6], "auto", "small", push, solver);
    let (small, exact) = simulate(&text(""));
    assert!(!small.plan.solver.starts_with("iterative"), "{}", small.plan.solver);
    let (large, found) = simulate(&text("memory = \"30 MB\""));
    assert!(large.plan.solver.starts_with("iterative: a factorisation would take"), "{}", large.plan.solver);
    agree(&all(&exact), &all(&found), 1e-7);
}

#[test]
fn tractions_of_many_pairs_are_those_of_dense_factors() {
    // Held by what moves it, and by contact alone.
    let moved = "{ set = \"B.front\", z = { to = \"-2 mm\" }, x = { to = \"8 mm\" }, y = { to = \"2 mm\" } }";
    let loaded = "{ set = \"B.front\", traction = [{ to = 1e6 }, { to = 2e5 }, { to = -4e6 }] }";
    for (push, divisions) in [(moved, [14, 14, 2]), (loaded, [14, 14, 2]), (loaded, [10, 10, 3])] {
        let text = |solver: &str| blocks_in_space(divisions, "condensed", "small", push, solver);
        let (direct, exact) = simulate(&text("method = \"direct\""));
        let (pairs, found) = simulate(&text(""));
        assert!(direct.plan.solver.contains("dense LU where friction acts"), "{}", direct.plan.solver);
        // Few components are factored in each iteration.
        let iterates = divisions[0] == 14;
        let how =
            if iterates { "GMRES with a dense LU factor" } else { "direct: dense LU for the tractions" };
        assert!(pairs.plan.solver.starts_with(how), "{}", pairs.plan.solver);
        let [direct, pairs] = [direct, pairs].map(|report| report.counts.operations);
        assert_eq!(pairs.linear_iterations > 0, iterates, "{pairs:?}");
        assert!(pairs.iterations <= direct.iterations + 4, "{pairs:?} {direct:?}");
        // Newton's method ends at 1e-11 of the largest force, which a condition number of 1e3 to 1e4 lets through.
        agree(&all(&exact), &all(&found), 1e-7);
    }
}

#[test]
fn a_body_that_iterations_find_free_is_named_with_its_motion() {
    let lift = "{ set = \"B.left\", x = 0 }, { set = \"B.bottom\", y = 0 }, \
                { set = \"B.front\", traction = [0, 0, { to = 1e3 }] }";
    let (_, _, reason) = stopped(&pushed_blocks("small", lift, "method = \"iterative\""));
    assert!(reason.contains("body `B` is free in translation in z"), "{reason}");
    for (divisions, path) in [([10, 10, 5], "full"), ([10, 10, 2], "condensed")] {
        let (_, _, reason) = stopped(&blocks_in_space(divisions, path, "small", lift, ""));
        assert!(reason.contains("body `B` can translate along z"), "{path}: {reason}");
    }
}

#[test]
fn a_body_that_open_contact_lets_go_is_named_with_its_motion() {
    // Pulled upwards, the joint opens: nothing holds B vertically. With friction the matrix is factored by LU.
    let lift = "{ set = \"B.top\", traction = [0, { to = 1e3 }] },";
    for path in ["condensed", "full"] {
        for law in ["", "law = { kind = \"coulomb\", mu = 0.6 }"] {
            let (_, _, reason) = stopped(&two_blocks(path, law, lift));
            assert!(reason.contains("body `B` can translate along y"), "{path} {law}: {reason}");
        }
    }
}

#[test]
fn a_body_that_is_not_held_is_refused_with_the_motion_that_is_free() {
    let stage = |conditions: &str| {
        format!("[[stages]]\nname = \"load\"\nduration = 1\nconditions = [{conditions}]\n")
    };
    let cases = [
        ("plane-strain", IN_PLANE, "", "nothing holds its translation in"),
        ("plane-strain", IN_PLANE, "{ set = \"B.left\", y = 0 }", "nothing holds its translation in x"),
        ("3d", IN_SPACE, "", "nothing holds its translation in"),
        // Rotation about the lower left corner moves the bottom along y and the left side along x only.
        (
            "plane-strain",
            IN_PLANE,
            "{ set = \"B.bottom\", x = 0 }, { set = \"B.left\", y = 0 }",
            "nothing holds its rotation in the plane",
        ),
        (
            "3d",
            IN_SPACE,
            "{ set = \"B.left\", x = 0 }, { set = \"B.bottom\", y = 0 }",
            "nothing holds its translation in z",
        ),
        (
            "3d",
            IN_SPACE,
            "{ set = \"B.bottom\", x = 0 }, { set = \"B.left\", y = 0 }, { set = \"B.back\", z = 0 }",
            "nothing holds its rotation about z",
        ),
    ];
    for (kinematics, mesh, conditions, expected) in cases {
        let error = refused(&bar(kinematics, mesh, "", &stage(conditions), IMPLICIT));
        assert!(error.message.starts_with("body `B` ") && error.message.contains(expected), "{error}");
    }
}

#[test]
fn a_roller_at_each_end_keeps_its_place() {
    let (_, record) = simulate(&bar("plane-strain", IN_PLANE, "", &pull(PLANE_LOAD, 1), IMPLICIT));
    assert!(displacements(&record, |x| x[0] == 0.0).iter().all(|(_, u)| *u == [0.0; 3]));
}
