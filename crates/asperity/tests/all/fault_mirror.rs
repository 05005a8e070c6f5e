//! Operators of faults between bodies in space: of bodies that are antisymmetric about the fault, one side is condensed for both, and
//! the compressed operator has the tractions of the dense one.

use crate::common::varied;
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::Change::{self, With, Without};

const SCENE: &str = r#"schema = 1
title = "two blocks"
kinematics = "3d"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[materials.soft]
young = "60 GPa"
poisson = 0.25
density = 2670
[bodies.west]
material = "rock"
mesh.block = { min = ["-6 km", "-5 km", "-7 km"], max = ["0 km", "0 km", "7 km"], divisions = [3, 5, 7], element = "hex8" }
[bodies.east]
material = "rock"
mesh.block = { min = ["0 km", "-5 km", "-7 km"], max = ["6 km", "0 km", "7 km"], divisions = [3, 5, 7], element = "hex8" }
[faults.main]
minus = "west.right"
plus = "east.left"
rake = [0, 0.6, 0.8]
slip = "free"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.01, b = 0.015, l = "0.2 m", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
rate = "1e-9 m/s"
damping = "radiation"
under_resolved = "allow"
creep = { outside = { y = { from = "-4 km" } }, rate = "1e-9 m/s" }
[[stages]]
name = "cycles"
duration = "100 yr"
conditions = [{ set = "west.left", x = 0, y = { rate = "-0.3e-9 m/s" }, z = { rate = "-0.4e-9 m/s" } }, { set = "east.right", x = 0, y = { rate = "0.3e-9 m/s" }, z = { rate = "0.4e-9 m/s" } }]
[time]
stepper = "fault-ode"
[output]
bodies = false
"#;

fn planned(changes: &[Change<'_>]) -> Plan {
    let text = varied(SCENE, changes);
    match plan_scene(&scene::read(&text).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

/// True if one side represents both.
fn mirrored(plan: &Plan) -> bool {
    plan.notes.iter().any(|note| note.contains("one side is condensed for both"))
}

/// Displacements of the bodies need both sides.
const BOTH: Change<'_> = With("output.bodies", "true");

#[test]
fn one_side_gives_the_tractions_of_both() {
    for further in [None, Some(Without("faults.main.slip"))] {
        let changes: Vec<Change<'_>> = further.into_iter().collect();
        let one = planned(&changes);
        let both = planned(&[changes, vec![BOTH]].concat());
        assert!(mirrored(&one) && !mirrored(&both));
        let (a, b) = (&one.problem.fault.operator, &both.problem.fault.operator);
        let (n, components) = (a.points(), a.components());
        assert!(!a.couples_normal() && !b.couples_normal() && components == b.components());
        let close = |a: &[f64], b: &[f64]| {
            let largest = b.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            let off = a.iter().zip(b).fold(0.0_f64, |l, (a, b)| l.max((a - b).abs()));
            assert!(largest > 0.0 && off < 1e-11 * largest, "{off:e} of {largest:e}");
        };
        let slip: Vec<f64> = (0..components * n).map(|k| (k as f64).sin()).collect();
        let product = |plan: &Plan| plan.problem.fault.operator.shear_of(&slip);
        close(&product(&one), &product(&both));
        close(a.stiffness().all(), b.stiffness().all());
        // Motions of the far sides and creep.
        let rates = |plan: &Plan| plan.problem.loading.rates(1.0, n, false).0;
        close(&rates(&one), &rates(&both));
        assert!(one.memory_bytes < both.memory_bytes);
    }
}

#[test]
fn what_is_not_antisymmetric_is_condensed_as_a_whole() {
    let plans: [&[Change<'_>]; 5] = [
        &[With("bodies.east.material", "\"soft\"")],
        &[With("bodies.east.mesh.block.divisions", "[4, 5, 7]")],
        &[With("bodies.east.mesh.block.max", "[\"7 km\", \"0 km\", \"7 km\"]")],
        &[With("stages[0].conditions[1].z.rate", "\"0.3e-9 m/s\"")],
        &[With("stages[0].conditions[1].x", "{ rate = \"1e-12 m/s\" }")],
    ];
    for changes in plans {
        assert!(!mirrored(&planned(changes)), "{changes:?}");
    }
    assert!(mirrored(&planned(&[])));
}

#[test]
fn compressed_tractions_of_two_directions_are_those_of_all_entries() {
    let fine: [Change<'_>; 2] = [
        With("bodies.west.mesh.block.divisions", "[2, 14, 20]"),
        With("bodies.east.mesh.block.divisions", "[2, 14, 20]"),
    ];
    let soft = [fine[0], fine[1], With("bodies.east.material", "\"soft\"")];
    for (changes, presses) in [(&fine[..], false), (&soft[..], true)] {
        let scene = scene::read(&varied(SCENE, changes)).unwrap();
        let dense = plan_with(&scene, Form::Dense).unwrap();
        let compressed = plan_with(&scene, Form::Compressed { tolerance: 1e-12 }).unwrap();
        let (a, b) = (&dense.problem.fault.operator, &compressed.problem.fault.operator);
        let n = a.points();
        assert!(n > 128 && b.bytes() < a.bytes(), "{n} points, {}", b.words());
        assert_eq!([a.couples_normal(), b.couples_normal()], [presses; 2]);
        let slip: Vec<f64> = (0..2 * n).map(|k| ((k * 7919) % 1000) as f64 / 1000.0).collect();
        let product = |plan: &Plan| {
            let operator = &plan.problem.fault.operator;
            [operator.shear_of(&slip), operator.normal_of(&slip)].concat()
        };
        let (exact, found) = (product(&dense), product(&compressed));
        for part in [0..n, n..2 * n, 2 * n..3 * n] {
            let largest = exact[part.clone()].iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            let off = part.clone().fold(0.0_f64, |l, k| l.max((exact[k] - found[k]).abs()));
            assert!(off <= 1e-10 * largest, "{part:?}: {off:e} of {largest:e}");
        }
        let [a, b] = [a.stiffness(), b.stiffness()];
        let same = a.all().iter().zip(b.all()).all(|(a, b)| (a / b - 1.0).abs() < 1e-12);
        assert!(same, "stiffness");
    }
}
