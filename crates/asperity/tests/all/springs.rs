//! Sets that springs load, against closed forms.

use crate::common::{close, coarse_sandwich, displacements, simulate, varied};
use asperity::kinds::bodies::RunReport;
use asperity::report::SpringResult;
use asperity_vary::Change::{Add, With, Without};

const YOUNG: f64 = 10e9;
/// Stiffness of the spring \[N/m\].
const SPRING: f64 = 3e9;
/// Stiffness of the sheet: 1 m thick, 1 m wide and 2 m long \[N/m\].
const SHEET: f64 = YOUNG / 2.0;

fn sheet(stages: &str, stepper: &str) -> String {
    format!(
        r#"
schema = 1
title = "a sheet on a spring"
kinematics = "plane-stress"
[materials.m]
young = "10 GPa"
poisson = 0.25
[bodies.B]
mesh.block = {{ min = [0, 0], max = ["2 m", "1 m"], divisions = [4, 3], element = "quad4" }}
material = "m"
{stages}
[time]
stepper = "{stepper}"
[output]
forces.right = {{ set = "B.right" }}
"#
    )
}

fn spring_in_stage<'a>(report: &'a RunReport, stage: &str) -> &'a SpringResult {
    report.springs.iter().find(|s| s.stage == stage).unwrap()
}

#[test]
fn a_spring_and_a_sheet_in_series_share_the_way_of_the_load_point() {
    let stages = r#"
[[stages]]
name = "draw"
duration = "10 s"
conditions = [{ set = "B.left", x = 0 }, { set = "B.bottom", y = 0 }, { set = "B.right", x = { spring = 3e9, rate = "0.2 mm/s" } }]
"#;
    for stepper in ["implicit", "static-explicit"] {
        let (report, record) = simulate(&sheet(stages, stepper));
        let spring = spring_in_stage(&report, "draw");
        assert_eq!((spring.spring.name().as_str(), spring.unit.as_str()), ("B.right.x", "N"));
        let force = SPRING * SHEET / (SPRING + SHEET) * 2e-3;
        close(spring.values.force, force, 1e-10);
        close(spring.values.load_point, 2e-3, 1e-14);
        close(spring.values.displacement, force / SHEET, 1e-10);
        close(report.forces[0].value[0], force, 1e-10);
        for (_, u) in displacements(&record, |x| x[0] == 2.0) {
            close(u[0], force / SHEET, 1e-10);
        }
        for sample in record.samples() {
            let [Some(now)] = sample.springs.as_slice() else { panic!("one spring") };
            close(now.force, SPRING * (now.load_point - now.displacement), 1e-10);
        }
    }
}

#[test]
fn nothing_jumps_when_a_spring_takes_over_or_changes() {
    let hold = r#"conditions = [{ set = "B.left", x = 0 }, { set = "B.bottom", y = 0 }, { set = "B.right", x = { to = "1 mm" } }]"#;
    let spring = |k: &str, rate: &str| {
        format!(r#"conditions = [{{ set = "B.right", x = {{ spring = {k}, rate = {rate} }} }}]"#)
    };
    let stage = |name: &str, conditions: &str| {
        format!("[[stages]]\nname = \"{name}\"\nduration = \"10 s\"\n{conditions}\n")
    };
    let stages = [
        stage("pull", hold),
        stage("attach", &spring("3e9", "0")),
        stage("draw", &spring("3e9", "1e-4")),
        stage("stiffen", &spring("9e9", "0")),
        stage("go on", ""),
        stage("release", r#"conditions = [{ set = "B.right", x = "free" }]"#),
    ]
    .concat();
    for stepper in ["implicit", "static-explicit"] {
        let (report, record) = simulate(&sheet(&stages, stepper));
        assert_eq!(report.springs.len(), 4);
        let further = SPRING / (SPRING + SHEET) * 1e-3;
        for (name, way, moved) in [
            ("attach", 0.0, 0.0),
            ("draw", 1e-3, further),
            ("stiffen", 1e-3, further),
            ("go on", 1e-3, further),
        ] {
            let SpringResult { values, .. } = spring_in_stage(&report, name);
            assert!((values.load_point - way).abs() < 1e-15, "{name}: {values:?}");
            close(values.displacement, 1e-3 + moved, 1e-9);
            close(values.force, SHEET * (1e-3 + moved), 1e-9);
        }
        let left = displacements(&record, |x| x[0] == 2.0);
        assert!(left.iter().all(|(_, u)| u[0].abs() < 1e-12), "{left:?}");
    }
}

#[test]
fn a_set_on_a_spring_moves_as_one_on_both_paths_and_its_load_cell_reads_the_friction() {
    // Constant steps, so that both paths take the same.
    let pulled = [
        With("stages[1].conditions[1].y", r#"{ spring = 2e9, rate = "-1e-3 mm/s" }"#),
        Add("stages[0].steps", "4"),
        Add("stages[1].steps", "40"),
    ];
    let scene = varied(&coarse_sandwich(), &pulled);
    for forward in [false, true] {
        let scene = match forward {
            false => scene.clone(),
            true => varied(&scene, &[With("time.stepper", "static-explicit"), Without("time.tolerance")]),
        };
        let (condensed, record) = simulate(&scene);
        let (full, _) = simulate(&varied(&scene, &[Add("time.path", "full")]));
        let (one, other) =
            (&spring_in_stage(&condensed, "shear").values, &spring_in_stage(&full, "shear").values);
        // Forward steps leave 1e-5 of the largest force.
        let tolerance = if forward { 1e-4 } else { 1e-9 };
        close(one.force, other.force, tolerance);
        close(one.displacement, other.displacement, tolerance);
        let shear = condensed.results.iter().find(|r| r.stage == "shear").unwrap();
        // The block is in balance along y: spring and friction on 50 mm.
        close(one.force.abs(), shear.mean_shear_traction.abs() * 50e-3, 1e-3);
        close(one.friction, shear.mean_shear_traction.abs() / shear.mean_normal_traction, 1e-3);
        let top = displacements(&record, |x| (x[1] - 60e-3).abs() < 1e-12);
        for (_, u) in &top {
            close(u[1], top[0].1[1], 1e-12);
        }
        assert!(one.displacement < -1e-6);
    }
}
