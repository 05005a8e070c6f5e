//! Contact far from the origin, sides that do not face each other, and laws with a memory of normal traction that lift off.

use crate::common::varied;
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies::{self, AnyPlan};
use asperity_plan::reading::scene;
use asperity_run::report::Outcome;
use asperity_vary::Change::{With, WithOrSame};

/// Blocks whose surfaces do not match, pressed and then dragged past a node of the other. Their interface begins at `x` and `y`.
fn dragged([x, y]: [f64; 2], measure: &str, strain: &str) -> String {
    let [low, high] = [y - 20.0, y + 20.0];
    let [left, right, end] = [x + 8.0, x + 32.0, x + 40.0];
    format!(
        r#"
schema = 1
title = "contact far from the origin"
kinematics = "plane-strain"
[materials.rock]
young = "50 GPa"
poisson = 0.25
[bodies.lower]
material = "rock"
strain = "{strain}"
mesh.block = {{ min = [{x}, {low}], max = [{end}, {y}], divisions = [7, 3], element = "quad4" }}
[bodies.upper]
material = "rock"
strain = "{strain}"
mesh.block = {{ min = [{left}, {y}], max = [{right}, {high}], divisions = [6, 3], element = "quad4" }}
[interfaces.c]
slave = "upper.bottom"
master = "lower.top"
measure = "{measure}"
sliding = "finite"
enforcement = {{ kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }}
law = {{ kind = "coulomb", mu = 0.3 }}
[[stages]]
name = "press"
duration = "1 s"
conditions = [
    {{ set = "lower.bottom", x = 0, y = 0 }},
    {{ set = "upper.top", x = 0, y = {{ to = "-5 mm" }} }},
]
[[stages]]
name = "drag"
duration = "1 s"
steps = 8
conditions = [{{ set = "upper.top", x = {{ to = "2 m" }}, y = "hold" }}]
[time]
stepper = "implicit"
[output]
forces.top = {{ set = "upper.top" }}
"#
    )
}

fn report(text: &str) -> RunReport {
    let AnyPlan::Two(plan) = bodies::plan(&scene::read(text).unwrap()).unwrap() else {
        panic!("a plane scene")
    };
    kinds::bodies::run(&AnyPlan::Two(plan), &mut Recorder::new()).unwrap()
}

/// Mean normal and shear traction after each stage.
fn tractions(text: &str) -> Vec<[f64; 2]> {
    let report = report(text);
    assert_eq!(report.outcome, Outcome::Completed, "{text}");
    report.results.iter().map(|r| [r.mean_normal_traction, r.mean_shear_traction]).collect()
}

#[test]
fn finite_sliding_is_the_same_at_any_distance_from_the_origin() {
    for measure in ["mortar", "node-to-point"] {
        for strain in ["small", "finite"] {
            let near = tractions(&dragged([0.0; 2], measure, strain));
            for place in [[0.0, 1e3], [512_000.0, 4_123_456.0]] {
                let far = tractions(&dragged(place, measure, strain));
                for (far, near) in far.iter().flatten().zip(near.iter().flatten()) {
                    // Newton's method leaves 1e-11 of the largest force, which slip at a kink of the master raises.
                    assert!(
                        (far - near).abs() <= 1e-7 * near.abs().max(1e5),
                        "{measure} {strain} {place:?}: {far} {near}"
                    );
                }
            }
        }
    }
}

/// A block pressed, slid, lifted and pressed again; its friction remembers normal traction.
const LIFTED: &str = r#"
schema = 1
title = "press, slide, lift and press again"
kinematics = "plane-strain"
[materials.rock]
young = "50 GPa"
poisson = 0.25
[bodies.lower]
material = "rock"
mesh.block = { min = [0, "-20 mm"], max = ["60 mm", 0], size = "10 mm", element = "quad4" }
[bodies.upper]
material = "rock"
mesh.block = { min = ["10 mm", 0], max = ["50 mm", "20 mm"], size = "10 mm", element = "quad4" }
[interfaces.c]
slave = "upper.bottom"
master = "lower.top"
measure = "mortar"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.012, b = 0.01, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s", alpha = 0.2, normal_initial = "5 MPa" }
[[stages]]
name = "press"
duration = 1
conditions = [{ set = "lower.bottom", x = 0, y = 0 }, { set = "upper.top", x = 0, y = { to = "-5 um" } }]
[[stages]]
name = "slide"
duration = 5
conditions = [{ set = "upper.top", x = { rate = "1 um/s" }, y = "hold" }]
[[stages]]
name = "lift"
duration = 5
conditions = [{ set = "upper.top", x = "hold", y = { to = "2 um" } }]
[[stages]]
name = "again"
duration = 5
conditions = [{ set = "upper.top", y = { to = "-5 um" } }]
[time]
stepper = "implicit"
"#;

#[test]
fn a_law_that_remembers_normal_traction_lifts_off_and_closes_again() {
    for stepper in ["implicit", "static-explicit"] {
        for measure in ["mortar", "node-to-point"] {
            for evolution in ["ageing", "slip"] {
                let scene = varied(
                    LIFTED,
                    &[
                        WithOrSame("time.stepper", stepper),
                        WithOrSame("interfaces.c.measure", measure),
                        WithOrSame("interfaces.c.law.evolution", evolution),
                    ],
                );
                let found = tractions(&scene);
                let [pressed, _, lifted, again] = found[..] else { panic!("{found:?}") };
                assert_eq!(lifted, [0.0; 2], "{stepper} {measure} {evolution}");
                // The same motion presses as before, but for the shear that friction holds: Poisson's effect of some per cent.
                assert!(
                    (again[0] / pressed[0] - 1.0).abs() < 0.01,
                    "{stepper} {measure} {evolution}: {again:?} {pressed:?}"
                );
            }
        }
    }
}

/// Sides that part at once leave gaps of rounding, at which the tangent and the traction of a point do not agree.
#[test]
fn a_whole_side_lifts_off_under_finite_sliding() {
    for (measure, alpha) in [("node-to-point", "0.3"), ("mortar", "0.5")] {
        let scene = varied(
            LIFTED,
            &[
                WithOrSame("time.stepper", "static-explicit"),
                WithOrSame("interfaces.c.sliding", "finite"),
                WithOrSame("interfaces.c.measure", measure),
                With("interfaces.c.law.alpha", alpha),
                With("bodies.lower.mesh.block.size", r#""5 mm""#),
                With("bodies.upper.mesh.block.size", r#""5 mm""#),
                With("stages[1].duration", "20"),
            ],
        );
        let found = tractions(&scene);
        assert_eq!(found[2], [0.0; 2], "{measure}: {found:?}");
    }
}

#[test]
fn sides_beside_each_other_are_refused_in_every_measure() {
    for measure in ["mortar", "node-to-point"] {
        for sliding in ["small", "finite"] {
            let scene = varied(
                LIFTED,
                &[
                    WithOrSame("interfaces.c.measure", measure),
                    WithOrSame("interfaces.c.sliding", sliding),
                    With("bodies.upper.mesh.block.min", r#"["400 mm", 0]"#),
                    With("bodies.upper.mesh.block.max", r#"["440 mm", "20 mm"]"#),
                ],
            );
            let error = bodies::plan(&scene::read(&scene).unwrap()).err().unwrap();
            assert!(
                error.message.contains("slave nodes has a closest point"),
                "{measure} {sliding}: {}",
                error.message
            );
        }
    }
}
