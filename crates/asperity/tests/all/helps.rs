//! Helps that name an alternative lead to scenes that are accepted: each is followed as a user would.

use crate::common::varied;
use asperity_plan::ScenePlan;
use asperity_plan::bodies;
use asperity_plan::reading::diagnostic::Diagnostic;
use asperity_plan::reading::scene;
use asperity_run::Warning;
use asperity_vary::Change::{self, Add, With, Without};

/// Two blocks in contact, `upper` on `lower`.
const IN_SPACE: &str = r#"
schema = 1
title = "two blocks"
kinematics = "3d"
[materials.rock]
young = "50 GPa"
poisson = 0.25
[bodies.upper]
material = "rock"
formulation = "standard"
mesh.block = { min = [0, 0, 0], max = ["2 m", "1 m", "2 m"], size = "1 m", element = "hex8" }
[bodies.lower]
material = "rock"
formulation = "standard"
mesh.block = { min = [0, "-1 m", 0], max = ["2 m", 0, "2 m"], size = "1 m", element = "hex8" }
[interfaces.c]
slave = "upper.bottom"
master = "lower.top"
measure = "mortar"
sliding = "small"
enforcement = { kind = "penalty", normal = "10 E/h", tangential = "10 E/h" }
law = { kind = "coulomb", mu = 0.4 }
[[stages]]
name = "press"
duration = "1 s"
conditions = [
    { set = "lower.bottom", x = 0, y = 0, z = 0 },
    { set = "upper.top", x = 0, y = { to = "-1 mm" }, z = 0 },
]
[time]
stepper = "implicit"
"#;

/// The same in a plane.
fn in_plane() -> String {
    varied(
        IN_SPACE,
        &[
            With("kinematics", "\"plane-strain\""),
            With(
                "bodies.upper.mesh.block",
                r#"{ min = [0, 0], max = ["2 m", "1 m"], size = "1 m", element = "quad4" }"#,
            ),
            With(
                "bodies.lower.mesh.block",
                r#"{ min = [0, "-1 m"], max = ["2 m", 0], size = "1 m", element = "quad4" }"#,
            ),
            With(
                "stages[0].conditions",
                r#"[{ set = "lower.bottom", x = 0, y = 0 }, { set = "upper.top", x = 0, y = { to = "-1 mm" } }]"#,
            ),
        ],
    )
}

fn elements(scene: &str, element: &str) -> String {
    let quoted = format!("\"{element}\"");
    let paths = ["bodies.upper.mesh.block.element", "bodies.lower.mesh.block.element"];
    varied(scene, &paths.map(|path| Change::WithOrSame(path, &quoted)))
}

fn b_bar(scene: &str) -> String {
    let paths = ["bodies.upper.formulation", "bodies.lower.formulation"];
    varied(scene, &paths.map(|path| Change::WithOrSame(path, "\"b-bar\"")))
}

fn planned(text: &str) -> Result<Vec<Warning>, Diagnostic> {
    let scene = scene::read(text).unwrap_or_else(|e| panic!("{e:?}\n{text}"));
    Ok(match asperity_plan::plan_scene(&scene)? {
        ScenePlan::Bodies(plan) => plan.summary().warnings.clone(),
        ScenePlan::Faults(plan) => plan.warnings.clone(),
        ScenePlan::Dynamic(mut plan) => plan.warnings_mut().to_vec(),
    })
}

/// Compares the help of a refusal, and checks that every scene that it leads to is accepted.
fn leads_to(refused: &str, help: &str, accepted: &[String]) {
    let error = planned(refused).err().unwrap_or_else(|| panic!("accepted:\n{refused}"));
    assert_eq!(error.help.as_deref(), Some(help), "{}", error.message);
    for scene in accepted {
        planned(scene).unwrap_or_else(|e| panic!("{}: {:?}\n{scene}", e.message, e.help));
    }
}

const FINITE: Change<'static> = With("interfaces.c.sliding", "\"finite\"");
const MORTAR: Change<'static> = With("interfaces.c.measure", "\"mortar\"");
const NODES: Change<'static> = With("interfaces.c.measure", "\"node-to-point\"");

#[test]
fn finite_sliding_of_second_order_is_accepted_of_mortar_and_leads_nodes_to_it() {
    let mortar = varied(&elements(IN_SPACE, "tet10"), &[FINITE]);
    let in_plane = varied(&elements(&in_plane(), "quad8"), &[FINITE]);
    for scene in [&mortar, &in_plane, &varied(&in_plane, &[NODES])] {
        planned(scene).unwrap_or_else(|e| panic!("{}: {:?}\n{scene}", e.message, e.help));
    }
    let nodes = varied(&mortar, &[NODES]);
    leads_to(
        &nodes,
        "use `measure = \"mortar\"`, or use elements of first order or hex27 there",
        &[varied(&nodes, &[MORTAR]), elements(&nodes, "tet4"), elements(&nodes, "hex27")],
    );
}

#[test]
fn nodes_without_areas_lead_to_mortar() {
    let nodes = varied(&elements(IN_SPACE, "hex20"), &[NODES]);
    let help = "use `measure = \"mortar\"`, or use elements of first order or hex27 there";
    leads_to(&nodes, help, &[varied(&nodes, &[MORTAR]), elements(&nodes, "hex8"), elements(&nodes, "hex27")]);
    let smoothed = varied(
        &nodes,
        &[With("bodies.lower.mesh.block.element", "\"hex8\""), Add("interfaces.c.smoothing", "\"cubic\"")],
    );
    leads_to(
        &smoothed,
        "use `measure = \"mortar\"` without `smoothing`, or use elements of first order or hex27 there",
        &[
            varied(&smoothed, &[MORTAR, Without("interfaces.c.smoothing")]),
            varied(&smoothed, &[With("bodies.upper.mesh.block.element", "\"hex8\"")]),
            varied(&smoothed, &[With("bodies.upper.mesh.block.element", "\"hex27\"")]),
        ],
    );
}

#[test]
fn b_bar_without_effect_leads_to_elements_that_do_not_lock() {
    let small = b_bar(&elements(IN_SPACE, "tet4"));
    let better = b_bar(&elements(&small, "hex8"));
    let help = "use hex8 with `formulation = \"b-bar\"`, or tet10";
    leads_to(&small, help, &[better.clone(), elements(&small, "tet10")]);
    // Contact with finite sliding has no faces of second order.
    let finite = varied(&small, &[FINITE]);
    leads_to(&finite, "use hex8 with `formulation = \"b-bar\"`", &[varied(&better, &[FINITE])]);
    let wedges = b_bar(&elements(IN_SPACE, "wedge6"));
    leads_to(
        &wedges,
        "use hex8 with `formulation = \"b-bar\"`, or wedge15",
        &[better, elements(&wedges, "wedge15")],
    );
    let in_plane = b_bar(&elements(&in_plane(), "tri3"));
    let help = "use quad4 with `formulation = \"b-bar\"`, or tri6";
    leads_to(&in_plane, help, &[elements(&in_plane, "quad4"), elements(&in_plane, "tri6")]);
}

#[test]
fn remedies_of_locking_end_its_warning() {
    let soft = |scene: &str| varied(scene, &[With("materials.rock.poisson", "0.49")]);
    for (scene, kind, remedies) in [
        (soft(&in_plane()), "quad4", ["quad4", "quad8"]),
        (soft(&in_plane()), "tri3", ["quad4", "tri6"]),
        (soft(IN_SPACE), "hex8", ["hex8", "hex20"]),
        (soft(IN_SPACE), "tet4", ["hex8", "tet10"]),
        (soft(IN_SPACE), "wedge6", ["hex8", "wedge15"]),
    ] {
        let warnings = |text: &str| planned(text).unwrap_or_else(|e| panic!("{e:?}\n{text}"));
        let locks = |text: &str| warnings(text).into_iter().find(|w| w.message.contains("locks"));
        let first = elements(&scene, kind);
        let help = locks(&first).unwrap_or_else(|| panic!("{kind} unnoticed")).help.unwrap();
        assert!(help.ends_with(&format!(", or {}", remedies[1])), "{help}");
        assert!(help.contains("b-bar"), "{help}");
        assert_eq!(locks(&b_bar(&elements(&scene, remedies[0]))), None);
        assert_eq!(locks(&elements(&scene, remedies[1])), None);
        // Of a stepper nothing of this depends.
        let forward = varied(&first, &[With("time.stepper", "\"static-explicit\"")]);
        assert!(locks(&forward).is_some(), "{kind}");
    }
}

#[test]
fn a_condensation_beyond_its_memory_leads_to_the_full_system() {
    let open = varied(
        &in_plane(),
        &[
            // A thin body has many points of contact and small factors.
            With(
                "bodies.upper.mesh.block",
                r#"{ min = [0, 0], max = ["2 m", "20 mm"], size = "5 mm", element = "quad4" }"#,
            ),
            With("bodies.lower.mesh.block.size", "\"50 mm\""),
            Without("interfaces.c.law"),
            Without("interfaces.c.enforcement.tangential"),
            Add("solver", "{ memory = \"2.5 MB\" }"),
        ],
    );
    let plan = bodies::plan(&scene::read(&open).unwrap()).unwrap_or_else(|e| panic!("{}", e.message));
    let path = &plan.summary().path;
    assert_eq!(path, "full: condensed bodies need more memory than is allowed");
    let asked = varied(&open, &[Add("time.path", "\"condensed\"")]);
    let error = planned(&asked).err().unwrap_or_else(|| panic!("accepted"));
    let help = error.help.unwrap();
    assert!(
        help.starts_with("use `path = \"full\"` in `[time]`, or raise `memory`"),
        "{}: {help}",
        error.message
    );
    planned(&varied(&open, &[Add("time.path", "\"full\"")])).unwrap_or_else(|e| panic!("{}", e.message));
}
