//! Stacks of bodies that can move together are refused by name, with every element and enforcement, and those that something holds
//! are not.

use crate::common::varied;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use asperity_vary::Change::{Add, Push, With};
use std::fmt::Write as _;
use std::path::Path;

/// Enforcements, as kind and further keys.
const ENFORCEMENTS: [&str; 3] =
    ["\"penalty\"", "\"uzawa\", penetration = \"1 nm\"", "\"augmented-lagrangian\""];
const HELD: &str = "{ set = \"c.bottom\", x = 0, y = 0 }";
const PRESSED: &str = "{ set = \"a.top\", pressure = \"1 MPa\" }";

/// Differences of stacks.
#[derive(Clone, Copy)]
struct Stack {
    element: &'static str,
    enforcement: &'static str,
    measure: &'static str,
    sliding: &'static str,
    /// Coefficients of friction of the upper and the lower interface.
    mu: [f64; 2],
    /// Conditions of the first stage.
    conditions: &'static str,
    /// Interfaces without friction in the second stage.
    frictionless: &'static str,
}

const STUCK: Stack = Stack {
    element: "quad4",
    enforcement: ENFORCEMENTS[0],
    measure: "mortar",
    sliding: "small",
    mu: [0.6, 0.6],
    conditions: "",
    frictionless: "",
};

impl Stack {
    /// Three blocks on each other, of which the lowest is held.
    fn text(&self) -> String {
        let space = self.element.starts_with("hex") || self.element.starts_with("tet");
        let mut text = format!(
            "schema = 1\ntitle = \"a stack\"\nkinematics = \"{}\"\n[materials.rock]\nyoung = \"10 GPa\"\npoisson = 0.25\n",
            if space { "3d" } else { "plane-strain" }
        );
        let depth = if space { [", 0", ", 2"] } else { ["", ""] };
        for (name, bottom) in [("a", 2), ("b", 1), ("c", 0)] {
            let _ = writeln!(
                text,
                "[bodies.{name}]\nmaterial = \"rock\"\nmesh.block = {{ min = [0, {bottom}{}], max = [2, {}{}], size = 1, element = \"{}\" }}",
                depth[0],
                bottom + 1,
                depth[1],
                self.element
            );
        }
        for (name, sides, mu) in [("upper", ["a", "b"], self.mu[0]), ("lower", ["b", "c"], self.mu[1])] {
            let _ = writeln!(
                text,
                "[interfaces.{name}]\nslave = \"{}.bottom\"\nmaster = \"{}.top\"\nmeasure = \"{}\"\nsliding = \"{}\"\n\
                 enforcement = {{ normal = \"1 E/h\", tangential = \"1 E/h\", kind = {} }}\nlaw = {{ kind = \"coulomb\", mu = {mu} }}",
                sides[0], sides[1], self.measure, self.sliding, self.enforcement
            );
        }
        let held = if space { "{ set = \"c.bottom\", x = 0, y = 0, z = 0 }" } else { HELD };
        let _ = writeln!(
            text,
            "[[stages]]\nname = \"press\"\nduration = \"1 s\"\nconditions = [{held}, {PRESSED}{}]\n\
             [[stages]]\nname = \"slide\"\nduration = \"1 s\"\nfrictionless = [{}]\n[time]\nstepper = \"implicit\"",
            self.conditions, self.frictionless
        );
        text
    }
}

/// Message of the refusal of a scene.
fn refusal(text: &str) -> Option<String> {
    let scene = scene::read_in(text, Path::new(".")).unwrap_or_else(|e| panic!("{e}\n{text}"));
    bodies::plan(&scene).err().map(|e| e.message)
}

const BOTH: &str =
    "bodies `a` and `b` are free to move as one in stage `slide`: nothing holds their translation in x";

/// Every element, measure, sliding and enforcement that goes with the others.
fn kinds() -> Vec<Stack> {
    let mut kinds = Vec::new();
    let meshes = [
        ("quad4", "node-to-point", "finite"),
        ("quad4", "mortar", "finite"),
        ("tri3", "node-to-point", "small"),
        ("tri6", "mortar", "small"),
        ("tri6", "node-to-point", "finite"),
        ("quad8", "node-to-point", "small"),
        ("quad9", "mortar", "small"),
        ("hex8", "mortar", "finite"),
        ("hex27", "node-to-point", "small"),
        ("hex20", "mortar", "small"),
        ("tet10", "mortar", "small"),
        ("tet4", "node-to-point", "finite"),
    ];
    for (element, measure, sliding) in meshes {
        for enforcement in ENFORCEMENTS {
            kinds.push(Stack { element, enforcement, measure, sliding, ..STUCK });
        }
    }
    kinds
}

#[test]
fn bodies_that_rub_on_each_other_and_slide_on_a_third_are_named() {
    for kind in kinds() {
        let text = Stack { frictionless: "\"lower\"", ..kind }.text();
        let message = refusal(&text);
        assert!(message.as_ref().is_some_and(|m| m.starts_with(BOTH)), "{message:?}\n{text}");
        assert_eq!(refusal(&kind.text()), None, "{}", kind.text());
    }
}

#[test]
fn a_coefficient_of_zero_holds_nothing() {
    let message = refusal(&Stack { mu: [0.6, 0.0], ..STUCK }.text());
    let both = "bodies `a` and `b` are free to move as one in stage `press`";
    assert!(message.as_ref().is_some_and(|m| m.starts_with(both)), "{message:?}");
    let message = refusal(&Stack { mu: [0.0, 0.6], ..STUCK }.text());
    assert!(
        message.as_ref().is_some_and(|m| m.starts_with("body `a` is free to move in stage `press`")),
        "{message:?}"
    );
}

#[test]
fn a_spring_or_a_condition_at_any_body_of_a_stack_holds_it() {
    for held in ["{ set = \"a.left\", x = 0 }", "{ set = \"b.right\", x = { spring = 1e6, rate = 0 } }"] {
        let conditions = Box::leak(format!(", {held}").into_boxed_str());
        let text = Stack { frictionless: "\"lower\"", conditions, ..STUCK }.text();
        assert_eq!(refusal(&text), None, "{text}");
    }
}

/// A wedge under a frictionless slope: as it moves aside, the body above sinks. Only friction holds the two.
const WEDGE: &str = r#"
schema = 1
title = "a wedge"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.above]
material = "rock"
mesh.quadrilateral = { corners = [[0, 1], [2, 2], [2, 4], [0, 4]], divisions = [2, 2], element = "tri6" }
[bodies.wedge]
material = "rock"
mesh.quadrilateral = { corners = [[0, 0], [2, 0], [2, 2], [0, 1]], divisions = [2, 2], element = "tri6" }
[interfaces.slope]
slave = "above.bottom"
master = "wedge.top"
measure = "mortar"
sliding = "small"
enforcement = { kind = "augmented-lagrangian", normal = "1 E/h", tangential = "1 E/h" }
law = { kind = "coulomb", mu = 0.6 }
[[stages]]
name = "press"
duration = "1 s"
conditions = [{ set = "wedge.bottom", y = 0 }, { set = "above.left", x = 0 }, { set = "above.top", pressure = "1 MPa" }]
[time]
stepper = "implicit"
"#;

#[test]
fn a_wedge_that_contact_drives_aside_is_named() {
    assert_eq!(refusal(WEDGE), None);
    let text = varied(WEDGE, &[Add("stages[0].frictionless", "[\"slope\"]")]);
    let message = refusal(&text);
    let words = "bodies `above` and `wedge` are free to move together in stage `press`: contact passes the translation in y of body \
                 `above` on, and nothing holds it";
    assert_eq!(message.as_deref(), Some(words));
}

/// Rings on a shaft. The outer one rubs on the inner one, which slides along the shaft.
const RINGS: &str = r#"
schema = 1
title = "rings on a shaft"
kinematics = "axisymmetric"
[materials.steel]
young = "200 GPa"
poisson = 0.3
[bodies.shaft]
material = "steel"
mesh.block = { min = [0, 0], max = [1, 4], size = 1, element = "quad8" }
[bodies.inner]
material = "steel"
mesh.block = { min = [1, 1], max = [2, 3], size = 1, element = "quad8" }
[bodies.outer]
material = "steel"
mesh.block = { min = [2, 1], max = [3, 3], size = 1, element = "quad8" }
[interfaces.bore]
slave = "inner.left"
master = "shaft.right"
measure = "mortar"
sliding = "small"
enforcement = { kind = "augmented-lagrangian", normal = "1 E/h" }
[interfaces.fit]
slave = "outer.left"
master = "inner.right"
measure = "mortar"
sliding = "small"
enforcement = { kind = "augmented-lagrangian", normal = "1 E/h", tangential = "1 E/h" }
law = { kind = "coulomb", mu = 0.3 }
[[stages]]
name = "press"
duration = "1 s"
conditions = [{ set = "shaft.bottom", y = 0 }, { set = "outer.right", pressure = "1 MPa" }]
[time]
stepper = "implicit"
"#;

#[test]
fn rings_that_slide_together_along_a_shaft_are_named() {
    let message = refusal(RINGS);
    let both = "bodies `inner` and `outer` are free to move as one in stage `press`: nothing holds their translation in y";
    assert!(message.as_ref().is_some_and(|m| m.starts_with(both)), "{message:?}");
    let text = varied(RINGS, &[Push("stages[0].conditions", "{ set = \"outer.bottom\", y = 0 }")]);
    assert_eq!(refusal(&text), None);
}

/// A cylinder pressed onto a plane without friction.
const CYLINDER: &str = r#"
schema = 1
title = "a cylinder on a plane"
kinematics = "plane-strain"
[materials.steel]
young = "200 GPa"
poisson = 0.3
[bodies.cylinder]
material = "steel"
mesh.block = { min = [-0.4, 0], max = [0.4, 0.5], divisions = [8, 2], element = "quad9", curves.bottom = { kind = "circle", radius = 1, apex = { x = 0 } } }
[bodies.plane]
material = "steel"
mesh.block = { min = [-1, -1], max = [1, 0], divisions = [4, 2], element = "quad9" }
[interfaces.skin]
slave = "cylinder.bottom"
master = "plane.top"
measure = "node-to-point"
sliding = "finite"
enforcement = { kind = "augmented-lagrangian", normal = "1 E/h" }
[[stages]]
name = "press"
duration = 1
conditions = [{ set = "plane.bottom", x = 0, y = 0 }, { set = "cylinder.top", pressure = "1 MPa" }]
[time]
stepper = "implicit"
"#;

#[test]
fn a_round_body_is_free_along_a_plane_whichever_is_the_slave() {
    let exchanged =
        [With("interfaces.skin.slave", "plane.top"), With("interfaces.skin.master", "cylinder.bottom")];
    for changes in [&[][..], &exchanged] {
        let message = refusal(&varied(CYLINDER, changes));
        let words = "body `cylinder` is free to move in stage `press`: nothing holds its translation in x";
        assert_eq!(message.as_deref(), Some(words));
    }
}
