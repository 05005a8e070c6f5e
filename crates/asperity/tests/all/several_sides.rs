//! Interfaces between more than two sides: pairs with the same contact, and masters of several bodies.

use crate::common::{displacements, simulate, varied};
use asperity_vary::Change::{With, Without};

/// A block on two others, which press each other.
const SCENE: &str = r#"
schema = 1
title = "a block on two"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies]
upper = { mesh.block = { min = ["-1 m", 0], max = ["1.2 m", "1 m"], divisions = [7, 4], element = "quad4" }, material = "rock" }
left = { mesh.block = { min = ["-2 m", "-1 m"], max = [0, 0], divisions = [6, 3], element = "quad4" }, material = "rock" }
right = { mesh.block = { min = [0, "-1 m"], max = ["2 m", 0], divisions = [8, 3], element = "quad4" }, material = "rock" }
[interfaces.joint]
pairs = [
    { slave = "left.right", master = "right.left" },
    { slave = "upper.bottom", master = ["left.top", "right.top"] },
]
measure = "mortar"
sliding = "finite"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "coulomb", mu = 0.4 }
[[stages]]
name = "press"
duration = "1 s"
frictionless = ["joint-1"]
conditions = [
    { set = "left.left", x = { to = "0.1 mm" } },
    { set = "left.bottom", y = 0 },
    { set = "right.right", symmetry = true },
    { set = "right.bottom", y = 0 },
    { set = "upper.top", x = 0, pressure = { to = "1 MPa" } },
]
[[stages]]
name = "drag"
duration = "1 s"
steps = 10
conditions = [{ set = "upper.top", x = { to = "0.4 m" } }, { set = "left.left", x = "hold" }]
[time]
stepper = "implicit"
"#;

/// Displacements of all nodes at the end.
fn end(text: &str) -> Vec<([f64; 3], [f64; 3])> {
    displacements(&simulate(text).1, |_| true)
}

#[test]
fn pairs_are_interfaces_of_their_own() {
    let own = |name: &str, slave: &str, master: &str| {
        let key = |key: &str| format!("interfaces.{name}.{key}");
        [
            (key("slave"), slave.to_owned()),
            (key("master"), master.to_owned()),
            (key("measure"), "\"mortar\"".into()),
            (key("sliding"), "\"finite\"".into()),
            (
                key("enforcement"),
                r#"{ kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }"#.into(),
            ),
            (key("law"), r#"{ kind = "coulomb", mu = 0.4 }"#.into()),
        ]
    };
    let written = [
        own("joint-1", "\"left.right\"", "\"right.left\""),
        own("joint-2", "\"upper.bottom\"", "[\"left.top\", \"right.top\"]"),
    ];
    let tables: String = written.iter().flatten().map(|(key, value)| format!("{key} = {value}\n")).collect();
    let rest = varied(SCENE, &[Without("interfaces.joint")]);
    assert_eq!(end(SCENE), end(&format!("{tables}{rest}")));
}

#[test]
fn the_order_of_masters_decides_nothing() {
    let reversed = [With(
        "interfaces.joint.pairs[1]",
        r#"{ slave = "upper.bottom", master = ["right.top", "left.top"] }"#,
    )];
    let [one, other] = [end(SCENE), end(&varied(SCENE, &reversed))];
    let largest = one.iter().flat_map(|(_, u)| u).fold(0.0, |most: f64, c| most.max(c.abs()));
    for ((x, a), (_, b)) in one.iter().zip(&other) {
        for (a, b) in a.iter().zip(b) {
            // What Newton's method leaves of forces, over the stiffness.
            assert!((a - b).abs() < 1e-9 * largest, "{x:?}: {a:e} is not {b:e}");
        }
    }
}
