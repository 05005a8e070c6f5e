//! Multipliers and bonded interfaces end to end: scenes with closed forms.

use crate::common::{close, displacements, fields, planned, simulate, varied};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_run::report::Outcome;
use asperity_vary::Change::With;

/// Young's modulus over the element size of the upper block \[Pa/m\].
const UNIT: f64 = 4000.0;
const PENALTY: &str = r#"kind = "penalty", normal = "10 E/h""#;
const UZAWA: &str = r#"kind = "uzawa", normal = "10 E/h", penetration = "1e-10 h""#;
const MIXED: &str = r#"kind = "augmented-lagrangian", normal = "1 E/h""#;

/// Two unit squares, one on top of the other; the upper is the slave.
struct Blocks<'a> {
    poisson: f64,
    /// Number of elements along each side, of the upper and of the lower block.
    divisions: (usize, usize),
    measure: &'a str,
    sliding: &'a str,
    enforcement: &'a str,
    law: &'a str,
    /// Conditions of the upper block, in addition to those of the lower, which rests on y = 0.
    conditions: &'a str,
    steps: usize,
    path: &'a str,
}

impl Default for Blocks<'_> {
    fn default() -> Self {
        Self {
            poisson: 0.3,
            divisions: (4, 4),
            measure: "node-to-point",
            sliding: "small",
            enforcement: PENALTY,
            law: "",
            conditions: PRESS,
            steps: 1,
            path: "auto",
        }
    }
}

const PRESS: &str = r#"{ set = "lower.left", x = 0 }, { set = "upper.left", x = 0 }, { set = "upper.top", y = { to = -0.01 } }"#;
const PULL: &str = r#"{ set = "lower.left", x = 0 }, { set = "upper.left", x = 0 }, { set = "upper.top", y = { to = 0.01 } }"#;

impl Blocks<'_> {
    fn text(&self) -> String {
        let Self {
            poisson,
            divisions: (upper, lower),
            measure,
            sliding,
            enforcement,
            law,
            conditions,
            steps,
            path,
        } = self;
        let tangential = if law.is_empty() { "" } else { r#", tangential = "10 E/h""# };
        let law = if law.is_empty() { String::new() } else { format!("law = {{ {law} }}") };
        format!(
            r#"
schema = 1
title = "two blocks"
kinematics = "plane-strain"
[materials.m]
young = 1000
poisson = {poisson}
[bodies.lower]
mesh.block = {{ min = [0, 0], max = [1, 1], divisions = [{lower}, {lower}], element = "quad4" }}
material = "m"
[bodies.upper]
mesh.block = {{ min = [0, 1], max = [1, 2], divisions = [{upper}, {upper}], element = "quad4" }}
material = "m"
[interfaces.joint]
slave = "upper.bottom"
master = "lower.top"
measure = "{measure}"
sliding = "{sliding}"
enforcement = {{ {enforcement}{tangential} }}
{law}
[[stages]]
name = "load"
duration = 1
steps = {steps}
conditions = [{{ set = "lower.bottom", y = 0 }}, {conditions}]
[time]
stepper = "implicit"
path = "{path}"
[output]
probes.joint = 5
"#
        )
    }

    fn run(&self) -> (RunReport, Recorder) {
        simulate(&self.text())
    }
}

fn normal(record: &Recorder) -> &[f64] {
    &record.stage_ends().last().unwrap().interfaces[0].normal_traction
}

fn shear(record: &Recorder) -> &[f64] {
    &record.stage_ends().last().unwrap().interfaces[0].shear_traction
}

fn slip(record: &Recorder) -> &[f64] {
    &record.stage_ends().last().unwrap().interfaces[0].slip
}

/// d/(2 (1 - nu²)/E).
const EXACT: f64 = 0.01 * 1000.0 / (2.0 * 0.91);

#[test]
fn pressed_blocks_have_the_pressure_of_the_constraint_at_any_penalty() {
    for path in ["condensed", "full"] {
        for factor in ["0.01", "1", "1e6"] {
            let enforcement = format!(r#"kind = "augmented-lagrangian", normal = "{factor} E/h""#);
            for (measure, divisions) in [("node-to-point", (4, 4)), ("mortar", (4, 5)), ("mortar", (5, 4))] {
                let blocks =
                    Blocks { enforcement: &enforcement, measure, divisions, path, ..Blocks::default() };
                let (report, record) = blocks.run();
                normal(&record).iter().for_each(|p| close(*p, EXACT, 1e-10));
                assert!(report.steps[0].penetration < 1e-15, "{}", report.steps[0].penetration);
                assert!(report.steps[0].iterations <= 2, "a linear problem: {}", report.steps[0].iterations);
                assert_eq!(report.counts.operations.augmentations, 0);
            }
        }
    }
}

#[test]
fn uzawa_ends_at_its_tolerance_with_a_fixed_factor_a_round() {
    for (factor, most) in [(1.0, 40), (10.0, 13), (100.0, 7)] {
        let enforcement = format!(
            r#"kind = "uzawa", normal = "{factor} E/h", penetration = "1e-10 h", augmentations = {most}"#
        );
        let (report, record) = Blocks { enforcement: &enforcement, ..Blocks::default() }.run();
        let step = &report.steps[0];
        assert!(step.penetration <= 0.25e-10, "{}", step.penetration);
        assert!(step.augmentations > 2, "{}", step.augmentations);
        // Share of the error that remains after each round: the compliance of the penalty over that of penalty and
        // bodies together.
        let left = (factor * UNIT).recip() / ((factor * UNIT).recip() + 2.0 * 0.91 / 1000.0);
        let first = EXACT * (1.0 - left) / (factor * UNIT);
        let rounds = (0.25e-10 / first).ln() / left.ln();
        assert_eq!(step.augmentations as f64, rounds.ceil(), "{factor}: {rounds}");
        assert_eq!(report.counts.operations.augmentations, step.augmentations);
        normal(&record).iter().for_each(|p| close(*p, EXACT, 1e-8));
    }
}

#[test]
fn a_tolerance_that_is_not_reached_is_an_outcome_with_the_last_good_state_kept() {
    let enforcement = r#"kind = "uzawa", normal = "0.01 E/h", penetration = "1e-10 h", augmentations = 3"#;
    let text = Blocks { enforcement, steps: 2, ..Blocks::default() }.text();
    let mut record = Recorder::new();
    let report = kinds::bodies::run(&planned(&text), &mut record).unwrap();
    let Outcome::Stopped { time, reason, .. } = &report.outcome else { panic!("{:?}", report.outcome) };
    assert_eq!(*time, 0.0);
    assert!(reason.contains("the gap at node") && reason.contains("after 3 augmentations"), "{reason}");
    assert!(report.steps.is_empty());
}

const SHEARED: &str =
    r#"{ set = "lower.bottom", x = 0 }, { set = "upper.top", y = { to = -0.01 }, x = { to = 0.02 } }"#;

/// Sheared blocks, for which enforcements are compared with each other, since the shear is uniform only far from the
/// sides.
#[test]
fn enforcements_agree_with_friction_on_both_paths() {
    for (measure, divisions) in [("node-to-point", (4, 4)), ("mortar", (4, 5))] {
        let run = |enforcement, path| {
            let law = r#"kind = "coulomb", mu = 0.3"#;
            let blocks = Blocks {
                enforcement,
                law,
                path,
                measure,
                divisions,
                conditions: SHEARED,
                steps: 4,
                ..Blocks::default()
            };
            blocks.run()
        };
        let (_, mixed) = run(MIXED, "condensed");
        let statuses = &mixed.stage_ends().last().unwrap().interfaces[0].status;
        assert!(statuses.contains(&1) && statuses.contains(&2), "{measure}: stick and slip: {statuses:?}");
        let scale = EXACT;
        for (enforcement, path, tolerance) in
            [(MIXED, "full", 1e-9), (UZAWA, "condensed", 1e-6), (UZAWA, "full", 1e-6)]
        {
            let (report, other) = run(enforcement, path);
            for (a, b) in
                normal(&mixed).iter().zip(normal(&other)).chain(shear(&mixed).iter().zip(shear(&other)))
            {
                assert!((a - b).abs() < tolerance * scale, "{measure} {enforcement} {path}: {a} {b}");
            }
            for (a, b) in slip(&mixed).iter().zip(slip(&other)) {
                assert!((a - b).abs() < tolerance * 0.02, "{measure} {enforcement} {path}: slip {a} {b}");
            }
            assert!(report.balance[0].force_residual < 1e-12);
        }
    }
}

/// The relative motion along the interface is slip alone, without that of penalty springs.
#[test]
fn without_penalty_all_tangential_motion_is_slip() {
    let law = r#"kind = "coulomb", mu = 0.3"#;
    let elastic = |enforcement: &str| {
        let blocks = Blocks { enforcement, law, conditions: SHEARED, steps: 4, ..Blocks::default() };
        let (_, record) = blocks.run();
        let fields = &record.stage_ends().last().unwrap().interfaces[0];
        let pairs = fields.relative_displacement.iter().zip(&fields.slip);
        pairs.map(|(r, s)| (r - s).abs()).fold(0.0, f64::max)
    };
    assert!(elastic(PENALTY) > 1e-6, "{}", elastic(PENALTY));
    assert!(elastic(UZAWA) < 1e-10, "{}", elastic(UZAWA));
    assert!(elastic(MIXED) < 1e-13, "{}", elastic(MIXED));
}

#[test]
fn finite_sliding_with_multipliers_leaves_no_gap() {
    for (measure, divisions) in [("node-to-point", (3, 4)), ("mortar", (3, 4))] {
        for law in ["", r#"kind = "coulomb", mu = 0.2"#] {
            let blocks = Blocks {
                enforcement: MIXED,
                law,
                measure,
                divisions,
                sliding: "finite",
                conditions: r#"{ set = "lower.bottom", x = 0 }, { set = "upper.top", y = { to = -0.01 }, x = { to = -0.05 } }"#,
                steps: 10,
                ..Blocks::default()
            };
            let (report, record) = blocks.run();
            let worst = report.steps.iter().map(|s| s.penetration).fold(0.0, f64::max);
            assert!(worst < 1e-13, "{measure} {law}: {worst}");
            assert!(normal(&record).iter().any(|p| *p > 0.0));
            let last = report.steps.last().unwrap();
            assert!(last.residual_ratio < 1e-11, "{}", last.residual_ratio);
        }
    }
}

/// A block that nothing but contact and friction holds.
#[test]
fn a_block_held_by_contact_alone_stands() {
    for path in ["condensed", "full"] {
        let blocks = Blocks {
            enforcement: MIXED,
            law: r#"kind = "coulomb", mu = 0.3"#,
            conditions: r#"{ set = "lower.bottom", x = 0 }, { set = "upper.top", pressure = { to = 10 } }"#,
            poisson: 0.0,
            path,
            ..Blocks::default()
        };
        let (_, record) = blocks.run();
        normal(&record).iter().for_each(|p| close(*p, 10.0, 1e-9));
    }
}

const TIED: &str = r#"kind = "tied""#;

#[test]
fn a_bar_in_tension_passes_the_patch_test_through_tied_mortar_interfaces() {
    for sliding in ["small", "finite"] {
        for divisions in [(4, 5), (5, 4), (8, 13)] {
            for (enforcement, compliance) in
                [(PENALTY, 0.1 / (1000.0 * divisions.0 as f64)), (UZAWA, 0.0), (MIXED, 0.0)]
            {
                let blocks = Blocks {
                    enforcement,
                    divisions,
                    sliding,
                    measure: "mortar",
                    law: TIED,
                    conditions: PULL,
                    ..Blocks::default()
                };
                let (report, record) = blocks.run();
                let exact = 0.01 / (2.0 * 0.91 / 1000.0 + compliance);
                let tolerance = if enforcement == UZAWA { 1e-8 } else { 1e-10 };
                normal(&record).iter().for_each(|p| close(*p, -exact, tolerance));
                fields(&record).cell_stress.iter().for_each(|s| close(s[1], exact, tolerance));
                // Newton's method ends at 1e-11 of the largest force. Where the slave side is finer, its multipliers
                // have weak modes that amplify the remaining error some fifty times, and four hundred times with dual
                // functions.
                let weak = if enforcement == MIXED { 100.0 } else { 1.0 };
                assert!(shear(&record).iter().all(|t| t.abs() < weak * tolerance * exact));
                assert!(
                    report.steps[0].iterations <= 2 || enforcement == UZAWA,
                    "{}",
                    report.steps[0].iterations
                );
            }
        }
    }
}

/// Cubes in uniaxial stress on faces that do not match, pressed without friction or pulled through a bond.
#[test]
fn cubes_pass_the_patch_test_with_multipliers_in_small_and_finite_sliding() {
    let text = |sliding: &str, enforcement: &str, law: &str, top: f64| {
        let tangential = if law.is_empty() { "" } else { r#", tangential = "1 E/h""# };
        format!(
            r#"
schema = 1
title = "two cubes"
kinematics = "3d"
[materials.m]
young = 1000
poisson = 0.3
[bodies.lower]
mesh.block = {{ min = [0, 0, 0], max = [1, 1, 1], divisions = [3, 2, 3], element = "hex8" }}
material = "m"
[bodies.upper]
mesh.block = {{ min = [0, 1, 0], max = [1, 2, 1], divisions = [2, 2, 2], element = "hex8" }}
material = "m"
[interfaces.joint]
slave = "upper.bottom"
master = "lower.top"
measure = "mortar"
sliding = "{sliding}"
enforcement = {{ {enforcement}{tangential} }}
{law}
[[stages]]
name = "load"
duration = 1
steps = 1
conditions = [
    {{ set = "lower.bottom", y = 0 }}, {{ set = "upper.top", y = {{ to = {top} }} }},
    {{ set = "lower.left", x = 0 }}, {{ set = "upper.left", x = 0 }},
    {{ set = "lower.back", z = 0 }}, {{ set = "upper.back", z = 0 }},
]
[time]
stepper = "implicit"
"#
        )
    };
    for sliding in ["small", "finite"] {
        for (law, top) in [("", -0.01), (r#"law = { kind = "tied" }"#, 0.01)] {
            for (enforcement, tolerance) in [(MIXED, 1e-10), (UZAWA, 1e-7)] {
                let (report, record) = simulate(&text(sliding, enforcement, law, top));
                normal(&record).iter().for_each(|p| close(*p, -top * 500.0, tolerance));
                fields(&record).cell_stress.iter().for_each(|s| close(s[1], top * 500.0, tolerance));
                assert!(report.balance[0].force_residual < 1e-12);
            }
        }
    }
}

#[test]
fn a_tied_interface_keeps_the_gap_it_was_tied_at() {
    // The blocks are 1e-3 apart.
    let text = |law| {
        let blocks =
            Blocks { enforcement: MIXED, law, measure: "mortar", conditions: PULL, ..Blocks::default() };
        let box_ = "bodies.upper.mesh.block";
        let [min, max] = ["min[1]", "max[1]"].map(|end| format!("{box_}.{end}"));
        varied(&blocks.text(), &[With(&min, "1.001"), With(&max, "2.001")])
    };
    let (_, record) = simulate(&text(TIED));
    normal(&record).iter().for_each(|p| close(*p, -EXACT, 1e-9));
    let gaps = &record.stage_ends().last().unwrap().interfaces[0].gap;
    assert!(gaps.iter().all(|g| g.abs() < 1e-14), "{gaps:?}");
    let (_, open) = simulate(&text(r#"kind = "coulomb", mu = 0.5"#));
    assert!(normal(&open).iter().all(|p| *p == 0.0), "untied blocks part");
}

/// A cantilever of two halves tied across the middle, compared with the same mesh in one piece.
#[test]
fn a_cantilever_tied_across_its_middle_is_the_cantilever_in_one_piece() {
    let beam = |bodies: &str, clamp: &str, tip: &str, tables: &str| {
        format!(
            r#"
schema = 1
title = "cantilever"
kinematics = "plane-strain"
[materials.m]
young = 1e6
poisson = 0.3
{bodies}
[[stages]]
name = "bend"
duration = 1
steps = 1
conditions = [{{ set = "{clamp}", x = 0, y = 0 }}, {{ set = "{tip}", traction = [0, {{ to = 100 }}] }}]
[time]
stepper = "implicit"
path = "full"
{tables}
"#
        )
    };
    let body = |name: &str, from: f64, to: f64, n: usize| {
        format!(
            "[bodies.{name}]\nmesh.block = {{ min = [{from}, 0], max = [{to}, 1], divisions = [{n}, 4], element = \"quad4\" }}\n\
             material = \"m\"\n"
        )
    };
    let tip = |record: &Recorder| displacements(record, |x| x[0] == 8.0 && x[1] == 1.0)[0].1;
    let (_, whole) = simulate(&beam(&body("beam", 0.0, 8.0, 32), "beam.left", "beam.right", ""));
    let exact = tip(&whole);
    for measure in ["node-to-point", "mortar"] {
        for (enforcement, tolerance) in [(MIXED, 1e-9), (UZAWA, 1e-7), (PENALTY, 1e-2)] {
            let joint = format!(
                "{}{}[interfaces.joint]\nslave = \"left.right\"\nmaster = \"right.left\"\nmeasure = \"{measure}\"\n\
                 sliding = \"small\"\nenforcement = {{ {enforcement}, tangential = \"10 E/h\" }}\nlaw = {{ {TIED} }}\n",
                body("left", 0.0, 4.0, 16),
                body("right", 4.0, 8.0, 16),
            );
            let (report, halves) = simulate(&beam(&joint, "left.left", "right.right", ""));
            let found = tip(&halves);
            close(found[1], exact[1], tolerance);
            close(found[0], exact[0], tolerance);
            assert_eq!(report.results[0].status, [0, 5, 0], "all points are bonded");
            if enforcement == PENALTY {
                assert!((found[1] / exact[1] - 1.0).abs() > 1e-5, "the springs of a penalty show");
            }
        }
    }
}

#[test]
fn the_plan_says_how_contact_is_enforced_and_counts_the_unknowns() {
    let plan = |enforcement, law| {
        let text = Blocks { enforcement, law, ..Blocks::default() }.text();
        planned(&text).summary().clone()
    };
    let coulomb = r#"kind = "coulomb", mu = 0.3"#;
    let penalty = plan(PENALTY, coulomb);
    assert!(penalty.physics[1].contains("node-to-point penalty contact"), "{:?}", penalty.physics);
    let mixed = plan(MIXED, coulomb);
    assert_eq!(mixed.system_dofs, penalty.system_dofs + 10);
    assert!(mixed.physics[1].contains("10 multipliers as unknowns"), "{:?}", mixed.physics);
    let uzawa = plan(UZAWA, "");
    assert!(
        uzawa.physics[1].contains("Uzawa's method to a penetration of 2.50e-11 m"),
        "{:?}",
        uzawa.physics
    );
    let tied = plan(MIXED, TIED);
    assert!(
        tied.physics[1].contains("tied") && tied.physics[1].contains("no friction"),
        "{:?}",
        tied.physics
    );
    assert_eq!(tied.state_bytes, Some(0));
}
