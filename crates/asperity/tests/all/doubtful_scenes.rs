//! Every file in `doubtful_scenes` gives one warning when it is planned, at the position and with the text in its first
//! line: `# warn: LINE:COLUMN part of the message`. Further tests are of conditions in runs that their models do not
//! describe.

use crate::common::{SANDWICH, varied};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, bodies};
use asperity_run::report::{Outcome, Stop};
use asperity_run::{Place, Warning};
use asperity_vary::Change::{Add, With, WithOrSame, Without};
use asperity_vary::SceneText;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

fn here(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)
}

fn files(folder: &str) -> Vec<(String, String)> {
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(here(folder)).unwrap().map(|e| e.unwrap().path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "toml"));
    files.sort();
    let name = |f: &PathBuf| f.file_name().unwrap().to_string_lossy().into_owned();
    files.iter().map(|f| (name(f), std::fs::read_to_string(f).unwrap())).collect()
}

fn file(name: &str) -> String {
    std::fs::read_to_string(here("tests/doubtful_scenes").join(name)).unwrap()
}

fn warnings(text: &str) -> Vec<Warning> {
    let scene = scene::read_in(text, &here("tests/meshes")).unwrap();
    let mut warnings = match asperity_plan::plan_scene(&scene).unwrap() {
        ScenePlan::Bodies(plan) => plan.summary().warnings.clone(),
        ScenePlan::Faults(plan) => plan.warnings.clone(),
        ScenePlan::Dynamic(mut plan) => plan.warnings_mut().to_vec(),
    };
    warnings.iter_mut().for_each(|w| asperity_scene::warning::locate(w, text));
    warnings
}

fn complaint(text: &str) -> Option<String> {
    let first = text.lines().next().unwrap_or_default();
    let (place, part) = first.strip_prefix("# warn: ").and_then(|e| e.split_once(' ')).unwrap();
    let found = warnings(text);
    let told: Vec<String> = found.iter().map(ToString::to_string).collect();
    let [Warning { place: Some(Place { line, column }), message, .. }] = &found[..] else {
        return Some(format!("expected one warning with a place, found {told:?}"));
    };
    (format!("{line}:{column}") != place || !message.contains(part))
        .then(|| format!("expected {place} {part}\n   found {told:?}"))
}

#[test]
fn every_doubtful_scene_is_warned_of_once_at_its_place() {
    let files = files("tests/doubtful_scenes");
    assert!(files.len() >= 9, "only {} files", files.len());
    let wrong: Vec<String> =
        files.iter().filter_map(|(name, text)| complaint(text).map(|c| format!("{name}: {c}"))).collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), files.len(), wrong.join("\n"));
}

/// The sandwich with this law, cells of 5 mm and a pressure of some 10 MPa.
fn sandwich(law: &str, allowed: bool) -> RunReport {
    let sizes = ["bodies.A.mesh.block.size", "bodies.B.mesh.block.size"].map(|path| With(path, "5 mm"));
    let text = SceneText::new(SANDWICH).changed(&sizes).with("interfaces.fault.law", law);
    let text = if allowed { text.add("interfaces.fault.under_resolved", "allow") } else { text };
    let text = text.text().unwrap();
    let plan = bodies::plan(&scene::read(&text).unwrap()).unwrap();
    kinds::bodies::run(&plan, &mut Recorder::new()).unwrap()
}

fn ageing(l: &str) -> String {
    format!(
        "{{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.005, b = 0.02, l = \"{l}\", v_ref = \"1 um/s\", v_initial = \"1 um/s\" }}"
    )
}

/// Loads do not determine the normal traction of this interface, since its sides are moved.
#[test]
fn an_interface_pressed_beyond_what_its_points_resolve_stops_before_it_slides() {
    let weakening = |d_c| format!("{{ kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.3, d_c = \"{d_c}\" }}");
    // Under 10 MPa the cohesive zone is 1 mm for L = 10 nm, and 3 mm for d_c = 0.5 um; sliding begins after some 5 s.
    for (law, wide) in [(ageing("10 nm"), ageing("5 um")), (weakening("0.5 um"), weakening("50 um"))] {
        let report = sandwich(&law, false);
        let Outcome::Stopped { stage, time, reason, kind: Stop::UnderResolved { interface, position } } =
            &report.outcome
        else {
            panic!("{law}: {:?}", report.outcome)
        };
        assert_eq!((stage.as_deref().unwrap(), interface.as_str(), position[0]), ("shear", "fault", 0.025));
        assert!(
            reason.contains("under_resolved = \"allow\"") && reason.contains("less than one point"),
            "{reason}"
        );
        // The last state before the stop is kept: nothing has slid.
        assert_eq!(report.steps.last().unwrap().time, *time);
        assert!(report.results.last().unwrap().status[2] == 0, "{:?}", report.results.last());
        // The warning about the normal traction came at the end of the stage that applies it.
        let few = |r: &RunReport| {
            r.warnings.iter().filter(|w| w.message.contains("at the end of stage `press`")).count()
        };
        assert_eq!(few(&report), 1, "{:?}", report.warnings);
        let allowed = sandwich(&law, true);
        assert!(
            !matches!(allowed.outcome, Outcome::Stopped { kind: Stop::UnderResolved { .. }, .. }),
            "{:?}",
            allowed.outcome
        );
        assert_eq!(few(&allowed), 1);
        let resolved = sandwich(&wide, false);
        assert_eq!(
            (resolved.outcome.clone(), few(&resolved)),
            (Outcome::Completed, 0),
            "{:?}",
            resolved.warnings
        );
    }
}

#[test]
fn points_resolve_an_interface_up_to_the_normal_traction_of_the_published_lengths() {
    for (law, length) in [
        // G' L/b and, over the drop of the coefficient, 9π/32 G' d_c, with two equal sides in plane strain.
        (ageing("1 um"), 1e-6 / 0.02),
        (
            "{ kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.35, d_c = \"1 um\" }".into(),
            9.0 * PI / 32.0 * 1e-6 / 0.25,
        ),
    ] {
        let text = file("interface_few_points.toml");
        let text = SceneText::new(&text)
            .with("interfaces.gouge.law", &law)
            .add("interfaces.gouge.under_resolved", "allow")
            .text()
            .unwrap();
        let bodies::AnyPlan::Two(plan) = bodies::plan(&scene::read(&text).unwrap()).unwrap() else {
            panic!("a plane scene")
        };
        let modulus = 80e9 / 2.5 / 0.75;
        let one = plan.problem.interfaces[0].resolved.as_ref().unwrap().one;
        assert!((one / (modulus * length / 0.1) - 1.0).abs() < 1e-9, "{law}: {one:e}");
    }
}

fn found(text: &str) -> Vec<String> {
    let plan = bodies::plan(&scene::read(text).unwrap()).unwrap();
    let report = kinds::bodies::run(&plan, &mut Recorder::new()).unwrap();
    assert_eq!(report.outcome, asperity_run::report::Outcome::Completed);
    report.warnings.into_iter().map(|w| w.message).collect()
}

fn bar(strain: &str, to: &str) -> String {
    varied(
        &file("tolerance_without_interface.toml"),
        &[
            With("stages[0].conditions[2].x.to", to),
            Without("time.tolerance"),
            Add("bodies.A.strain", strain),
        ],
    )
}

#[test]
fn strain_beyond_a_few_per_cent_is_told_where_it_is_taken_as_small() {
    // A bar of 4 m that is extended by 0.4 m has a strain of a tenth; by 0.1 m, of a fortieth.
    let told = found(&bar("small", "400 mm"));
    assert!(told.len() == 1 && told[0].contains("body `A` is strained by 0.100 in stage `pull`"), "{told:?}");
    assert_eq!(found(&bar("small", "100 mm")), Vec::<String>::new());
    assert_eq!(found(&bar("finite", "400 mm")), Vec::<String>::new());
}

/// A bar of 10 m by 1 m held at one end, which bends by a shear traction at the other, or stretches by a normal one.
fn cantilever(element: &str, divisions: [usize; 2], traction: [&str; 2]) -> String {
    format!(
        r#"
schema = 1
title = "a bar"
kinematics = "plane-stress"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.bar]
mesh.block = {{ min = [0, 0], max = [10, 1], divisions = {divisions:?}, element = "{element}" }}
material = "rock"
[[stages]]
name = "load"
duration = 1
conditions = [
    {{ set = "bar.left", x = 0, y = 0 }},
    {{ set = "bar.right", traction = {traction:?} }},
]
[time]
stepper = "implicit"
"#
    )
}

#[test]
fn a_bar_that_bends_within_its_cells_is_told() {
    let (shear, pull) = (["0 Pa", "-1 kPa"], ["1 MPa", "0 Pa"]);
    let bends = |told: &[String]| told.iter().any(|w| w.contains("body `bar` bends within its cells"));
    for (element, divisions) in [("quad4", [10, 1]), ("quad4", [20, 2]), ("quad4", [5, 8]), ("tri3", [20, 2])]
    {
        let told = found(&cantilever(element, divisions, shear));
        assert!(bends(&told), "{element} {divisions:?}: {told:?}");
    }
    for (element, divisions) in [("quad4", [40, 4]), ("quad8", [10, 1]), ("tri3", [60, 6])] {
        let told = found(&cantilever(element, divisions, shear));
        assert!(told.is_empty(), "{element} {divisions:?}: {told:?}");
    }
    // Without bending there is nothing to tell, however coarse the cells.
    assert_eq!(found(&cantilever("quad4", [10, 1], pull)), Vec::<String>::new());
    assert_eq!(found(&cantilever("tri3", [10, 1], pull)), Vec::<String>::new());
}

#[test]
fn rock_that_rests_under_its_weight_does_not_bend() {
    let scene = r#"
schema = 1
title = "rock at rest"
kinematics = "plane-strain"
[materials.rock]
young = "50 GPa"
poisson = 0.25
density = 2700
[bodies.b]
material = "rock"
mesh.block = { min = [0, 0], max = ["1.3 km", "1 m"], divisions = [7, 9], element = "quad4" }
gravity = [0, -9.81]
initial_stress = { kind = "lithostatic", level = "1 m", k0 = 0.3333 }
[[stages]]
name = "rest"
duration = 1
conditions = [{ set = "b.left", x = 0 }, { set = "b.right", x = 0 }, { set = "b.bottom", y = 0 }]
[time]
stepper = "implicit"
"#;
    assert_eq!(found(scene), Vec::<String>::new());
}

/// A rod of 1 m and this height, of steel and large strain, held at one end, under tractions along and across it at the other.
fn rod(height: &str, along: &str, across: &str) -> Vec<String> {
    found(&format!(
        r#"
schema = 1
title = "a rod"
kinematics = "plane-stress"
[materials.steel]
young = "200 GPa"
poisson = 0
[bodies.rod]
mesh.block = {{ min = [0, 0], max = [1, "{height}"], divisions = [20, 1], element = "quad8" }}
material = "steel"
strain = "finite"
[[stages]]
name = "load"
duration = 1
conditions = [
    {{ set = "rod.left", x = 0, y = 0 }},
    {{ set = "rod.right", traction = [{along}, {across}] }},
]
[time]
stepper = "implicit"
"#
    ))
}

#[test]
fn a_rod_beyond_its_load_of_buckling_is_told() {
    // It buckles at π² E I/(4 L²) = 0.329 MN, a traction of 16.4 MPa.
    let unstable = |told: &[String]| told.iter().any(|w| w.contains("ends in an unstable equilibrium"));
    let straight = rod("20 mm", r#"{ to = "-25 MPa" }"#, "0");
    assert!(unstable(&straight), "{straight:?}");
    for load in ["-15 MPa", "200 MPa"] {
        let told = rod("20 mm", &format!(r#"{{ to = "{load}" }}"#), "0");
        assert!(!unstable(&told), "{load}: {told:?}");
    }
}

#[test]
fn a_rod_that_turns_far_within_a_step_is_told() {
    let turns = |told: &[String]| told.iter().any(|w| w.contains("turns or stretches by"));
    let at_once = rod("50 mm", "0", r#""60 MPa""#);
    assert!(turns(&at_once), "{at_once:?}");
    let grows = rod("50 mm", "0", r#"{ to = "60 MPa" }"#);
    assert!(!turns(&grows), "{grows:?}");
}

#[test]
fn steps_longer_than_a_vibration_that_add_energy_are_told() {
    let beam = |steps: usize| {
        found(&format!(
            r#"
schema = 1
title = "a beam under a sudden load, of a period of 24.8 ms"
kinematics = "plane-stress"
[materials.steel]
young = "200 GPa"
poisson = 0
density = 8000
[bodies.beam]
mesh.block = {{ min = [0, 0], max = [1, "50 mm"], divisions = [20, 2], element = "quad8" }}
material = "steel"
[[stages]]
name = "load"
duration = "100 ms"
steps = {steps}
conditions = [{{ set = "beam.left", x = 0, y = 0 }}, {{ set = "beam.right", traction = [0, "0.1 MPa"] }}]
[time]
stepper = "implicit"
inertia = true
"#
        ))
    };
    let adds = |told: &[String]| told.iter().any(|w| w.contains("the time integration has added 0.9"));
    let (coarse, fine) = (beam(3), beam(400));
    assert!(adds(&coarse), "{coarse:?}");
    assert_eq!(fine, Vec::<String>::new());
}

/// Two blocks with cells of 1 m; the second is driven past the first for 50 s.
fn driven(sliding: &str, rate: &str) -> String {
    varied(
        &file("material_of_no_body.toml"),
        &[
            WithOrSame("interfaces.fault.sliding", sliding),
            With("stages[1].conditions[1].y.rate", rate),
            Without("time.tolerance"),
        ],
    )
}

#[test]
fn a_side_dragged_off_its_partners_is_told_where_the_pairing_does_not_follow() {
    let told = found(&driven("small", "-30 mm/s"));
    assert!(told.len() == 1 && told[0].contains("interface `fault` slides by 1.49"), "{told:?}");
    assert!(told[0].contains("beyond some 1 m nodes bear on faces that they have left"), "{told:?}");
    assert_eq!(found(&driven("small", "-10 mm/s")), Vec::<String>::new());
}

#[test]
fn a_side_that_turns_is_told_where_its_directions_do_not_follow() {
    let scene = include_str!("../../../../verification/cases/contact_rotation/scene.toml");
    let turned = |sliding: &str, by: &str| {
        let text = varied(
            scene,
            &[
                WithOrSame("interfaces.contact.sliding", sliding),
                WithOrSame("stages[2].conditions[0].rotate.by", by),
                WithOrSame("stages[2].conditions[1].rotate.by", by),
            ],
        );
        found(&text).into_iter().filter(|w| w.contains("turns by")).collect::<Vec<_>>()
    };
    let told = turned("small", "6 deg");
    assert!(
        told.len() == 1 && told[0].contains("the master of interface `contact` turns by 0.1"),
        "{told:?}"
    );
    assert_eq!(turned("small", "1 deg"), Vec::<String>::new());
    assert_eq!(turned("finite", "6 deg"), Vec::<String>::new());
}

#[test]
fn an_interface_that_never_closes_is_told() {
    let told = found(&file("far_apart.toml"));
    assert!(
        told.len() == 1 && told[0].contains("interface `fault` was open at the end of every stage"),
        "{told:?}"
    );
}

#[test]
fn the_start_of_an_interface_is_measured_by_either_measure() {
    // Bodies 3 mm apart; the master overhangs by 1 m at both ends, and faces 5 nodes over 4 m.
    for measure in ["node-to-point", "mortar"] {
        for sliding in ["small", "finite"] {
            let text = varied(
                &file("material_of_no_body.toml"),
                &[
                    WithOrSame("interfaces.fault.measure", measure),
                    WithOrSame("interfaces.fault.sliding", sliding),
                    With("bodies.B.mesh.block.min[0]", "2.003"),
                    With("bodies.B.mesh.block.max[0]", "4.003"),
                ],
            );
            let plan = bodies::plan(&scene::read(&text).unwrap()).unwrap();
            let [start] = &plan.summary().start_gaps[..] else { panic!("one interface") };
            assert_eq!((start.points, start.facing, start.unpaired), (5, 5, 0), "{measure}, {sliding}");
            for gap in start.gap {
                assert!((gap - 3e-3).abs() < 1e-12, "{measure}, {sliding}: {gap}");
            }
            assert!((start.facing_area - 4.0).abs() < 1e-9 && (start.slave_area - 4.0).abs() < 1e-9);
            assert_eq!(start.area_unit, "m");
        }
    }
}

#[test]
fn half_a_side_without_partner_is_counted() {
    // The master ends in the middle of the slave: nodes at 0 and 1 m have no partner, that at 2 m is at the rim.
    let text = varied(&file("material_of_no_body.toml"), &[With("bodies.B.mesh.block.min[1]", "2 m")]);
    let plan = bodies::plan(&scene::read(&text).unwrap()).unwrap();
    let start = &plan.summary().start_gaps[0];
    assert_eq!((start.facing, start.unpaired), (3, 2));
}

/// Two blocks that are pressed together without friction, held with it, and sheared under friction of this form.
fn pressed_first(form: &str, held: &str) -> String {
    format!(
        r#"schema = 1
title = "two blocks"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.A]
mesh.block = {{ min = [0, 0], max = [2, 4], size = 1, element = "quad4" }}
material = "rock"
[bodies.B]
mesh.block = {{ min = [2, 0], max = [4, 4], size = 1, element = "quad4" }}
material = "rock"
[interfaces.fault]
slave = "A.right"
master = "B.left"
measure = "node-to-point"
sliding = "small"
enforcement = {{ kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }}
law = {{ kind = "rate-and-state", evolution = "ageing", {form}, mu0 = 0.6, a = 0.01, b = 0.005, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }}
[[stages]]
name = "press"
duration = 10
frictionless = ["fault"]
conditions = [
    {{ set = "A.left", x = {{ to = "1 mm" }} }}, {{ set = "A.bottom", y = 0 }}, {{ set = "A.top", y = 0 }},
    {{ set = "B.right", x = 0 }}, {{ set = "B.top", y = 0 }}, {{ set = "B.bottom", y = 0 }},
]
{held}
[[stages]]
name = "shear"
duration = 10
conditions = [{{ set = "B.top", y = {{ rate = "-1 um/s" }} }}, {{ set = "B.bottom", y = {{ rate = "-1 um/s" }} }}]
[time]
stepper = "implicit"
"#
    )
}

#[test]
fn bare_and_cut_off_friction_begins_where_something_slides_and_stops_with_the_remedy_where_nothing_does() {
    let held = "[[stages]]\nname = \"rest\"\nduration = 10\n";
    for form in ["form = \"regularised\"", "form = \"bare\"", "form = \"cut-off\", v_cut = \"1 mm/s\""] {
        assert_eq!(found(&pressed_first(form, "")), Vec::<String>::new(), "{form}");
        let plan = bodies::plan(&scene::read(&pressed_first(form, held)).unwrap()).unwrap();
        let report = kinds::bodies::run(&plan, &mut Recorder::new()).unwrap();
        match report.outcome {
            Outcome::Completed => assert!(form.contains("regularised"), "{form}"),
            Outcome::Stopped { stage, reason, .. } => {
                assert!(
                    stage.as_deref() == Some("rest") && !form.contains("regularised"),
                    "{form}: {stage:?}: {reason}"
                );
                assert!(reason.contains("use `form = \"regularised\"`"), "{reason}");
            }
            Outcome::Interrupted { .. } => panic!("{form} was interrupted"),
        }
    }
}
