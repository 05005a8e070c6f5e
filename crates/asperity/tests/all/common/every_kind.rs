//! Runs of every kind, which together leave the files that tables and fields describe.

use super::written::{ColumnDescription, described};
use super::{cycles, sliders, varied};
use crate::{dynamic, located};
use asperity_vary::Change::{Add, With};
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;
use std::sync::LazyLock;

/// Kinds of run, in the order of the pages.
pub const KINDS: [&str; 4] = ["bodies", "faults", "dynamics", "sliders"];

/// A plastic block with mass, which a spring pulls along a plane.
const DRAWN: &str = r#"schema = 1
title = "a block drawn along a plane by a spring"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
density = 2700
plasticity = { yield = "1 GPa", hardening = "perfect" }
[bodies.A]
mesh.block = { min = [-2, 0], max = [0, 2], size = 1, element = "quad4" }
material = "rock"
[bodies.B]
mesh.block = { min = [0, 0], max = [2, 2], size = 1, element = "quad4" }
material = "rock"
[interfaces.joint]
slave = "B.left"
master = "A.right"
measure = "mortar"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.005, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }
[[stages]]
name = "draw"
duration = 0.02
conditions = [{ set = "A.left", x = 0, y = 0 }, { set = "B.right", x = { to = -1e-4 }, y = { spring = 1e10, rate = "1 um/s" } }]
[time]
stepper = "implicit"
inertia = true
[events]
above = "0.1 um/s"
[output]
probes.joint = 3
"#;

/// A fault in a half-space that has an event, beside one that creeps.
const TWO_FAULTS: &str = r#"schema = 1
title = "two faults in a half-space"
kinematics = "plane-strain"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[medium]
kind = "half-space"
material = "rock"
[faults.main]
line = { trace = [[0, 0], [1200, -1600]], spacing = 2000 }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "4 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
under_resolved = "allow"
damping = "radiation"
creep = { rate = 1e-9 }
rate = 1.1e-9
[faults.other]
line = { trace = [[6000, 0], [3600, -3200]], spacing = 1000 }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.020, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
under_resolved = "allow"
damping = "radiation"
rate = 1e-12
[[stages]]
name = "still"
duration = "1000 yr"
[time]
stepper = "fault-ode"
[events]
above = "1e-3 m/s"
slow_above = "1e-8 m/s"
stop_after = 1
[output]
coulomb = { friction = 0.4, dip = "120 deg", rake = "90 deg" }
surface = { spacing = "2 km" }
"#;

/// Columns and arrays of runs of a kind, as the runs describe them.
pub fn files(kind: &str) -> &'static [ColumnDescription] {
    static ALL: LazyLock<BTreeMap<&str, Vec<ColumnDescription>>> = LazyLock::new(|| {
        KINDS.into_iter().map(|kind| (kind, scenes(kind).iter().flat_map(|s| run(s)).collect())).collect()
    });
    &ALL[kind]
}

fn run(scene: &str) -> Vec<ColumnDescription> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let run = run.args(["run", "scene.toml", "--no-plots"]).current_dir(folder.path()).output().unwrap();
    assert!(run.status.success(), "{}\n{scene}", String::from_utf8_lossy(&run.stderr));
    let described = described(&folder.path().join("out/scene"));
    assert!(!described.is_empty(), "a run describes no tables:\n{scene}");
    described
}

/// Scenes of a kind of run.
fn scenes(kind: &str) -> Vec<String> {
    match kind {
        "bodies" => {
            vec![interface("plane-strain", 1, 1e-3, true), interface("3d", 1, 1e-3, true), DRAWN.to_owned()]
        }
        "faults" => vec![
            varied(
                &fault("antiplane", 2, 1.0, None),
                &[Add("output.coulomb", r#"{ friction = 0.4, dip = "90 deg", rake = "0 deg" }"#)],
            ),
            varied(cycles::SCENE, &[With("events.stop_after", "1")]),
            include_str!("../../../../../scenes/fault-opening.toml").to_owned(),
            include_str!("../../../../../scenes/thermal-pressurisation.toml").to_owned(),
            varied(
                &fault("3d", 1, 1.0, Some(([0.0, 0.5, 0.5], "free"))),
                &[
                    With("stages[0].conditions[1].y", "{ spring = 1e15, rate = 0.5e-9 }"),
                    Add("output.points", r#"{ inside = { body = "B", at = [1500, 1000, 1000] } }"#),
                    Add("output.forces", r#"{ pushed = { set = "B.right" } }"#),
                ],
            ),
            varied(
                located::STRIKE_SLIP,
                &[
                    Add("output.receivers", r#"{ near = ["2 km", "-1 km", 0] }"#),
                    Add(
                        "output.coulomb",
                        r#"{ friction = 0.4, strike = "70 deg", dip = "90 deg", rake = "0 deg", depth = "2 km", map = { spacing = "4 km" }, points = { a = ["3 km", "-2 km", 0] } }"#,
                    ),
                ],
            ),
            TWO_FAULTS.to_owned(),
        ],
        "dynamics" => vec![
            varied(dynamic::SCENE, &[With("stages[0].duration", "0.2 s")]),
            varied(dynamic::IN_SPACE, &[With("stages[0].duration", "0.1 s")]),
        ],
        _ => vec![sliders::CYCLE.to_owned()],
    }
}

/// Conditions of a side: a value for each axis.
fn side(set: &str, values: [&str; 3], axes: usize) -> String {
    let each = ["x", "y", "z"].iter().zip(values).take(axes).filter(|(_, v)| !v.is_empty());
    let parts: Vec<String> = each.map(|(axis, value)| format!("{axis} = {value}")).collect();
    format!("{{ set = \"{set}\", {} }}", parts.join(", "))
}

/// Blocks in contact, B pushed along an axis, with A as the master or B.
pub fn interface(kinematics: &str, axis: usize, push: f64, b_is_slave: bool) -> String {
    let space = kinematics == "3d";
    let (axes, element) = if space { (3, "hex8") } else { (2, "quad4") };
    let corner = |x: [f64; 3]| format!("{:?}", &x[..axes]);
    let (slave, master) = if b_is_slave { ("B.left", "A.right") } else { ("A.right", "B.left") };
    let moved = format!("{{ to = {push:e} }}");
    let mut values = ["-1e-4", "0", "0"];
    values[axis] = &moved;
    // In axisymmetry, x is the radius.
    let from = if kinematics == "axisymmetric" { 4.0 } else { 0.0 };
    let position = format!("{:?}", &[from + 1.5, 1.0, 1.0][..axes]);
    format!(
        r#"schema = 1
title = "signs"
kinematics = "{kinematics}"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.A]
mesh.block = {{ min = {}, max = {}, size = 1, element = "{element}" }}
material = "rock"
[bodies.B]
mesh.block = {{ min = {}, max = {}, size = 1, element = "{element}" }}
material = "rock"
[interfaces.joint]
slave = "{slave}"
master = "{master}"
measure = "mortar"
sliding = "small"
enforcement = {{ kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }}
law = {{ kind = "coulomb", mu = 0.3 }}
[[stages]]
name = "push"
duration = 1
conditions = [{}, {}]
[time]
stepper = "implicit"
[output]
probes.joint = 3
points.inside = {{ body = "B", at = {position} }}
forces.pushed = {{ set = "B.right" }}
"#,
        corner([from - 2.0, 0.0, 0.0]),
        corner([from, 2.0, 2.0]),
        corner([from, 0.0, 0.0]),
        corner([from + 2.0, 2.0, 2.0]),
        side("A.left", ["0", "0", "0"], axes),
        side("B.right", values, axes),
    )
}

/// Blocks with a fault between them, whose sides are driven along an axis.
pub fn fault(kinematics: &str, axis: usize, push: f64, rake: Option<([f64; 3], &str)>) -> String {
    let axes = if kinematics == "3d" { 3 } else { 2 };
    let (element, divisions) = if axes == 3 { ("hex8", "[1, 2, 2]") } else { ("quad4", "[1, 2]") };
    let corner = |x: [f64; 3]| format!("{:?}", &x.map(|x| 1e3 * x)[..axes]);
    let driven = |set: &str, sign: f64| {
        let moved = format!("{{ rate = {:e} }}", 0.5e-9 * sign * push);
        let mut values = if kinematics == "antiplane" { [""; 3] } else { ["0"; 3] };
        values[axis] = &moved;
        side(set, values, if kinematics == "antiplane" { 3 } else { axes })
    };
    let rate = push * rake.map_or(1.0, |(rake, _)| rake[axis].signum());
    let rake = rake.map_or(String::new(), |(rake, slip)| format!("rake = {rake:?}\nslip = \"{slip}\"\n"));
    // With catalogues for other programs.
    let place = "[place]\nepoch = \"2000-01-01T00:00:00Z\"\nlatitude = 0\nlongitude = 0\nstrike = 0\nlength = \"1 km\"\n";
    let place = if kinematics == "antiplane" { place } else { "" };
    let station = if axes == 3 { "[[0, 1000, 1000]]" } else { "[\"0 km\"]" };
    format!(
        r#"schema = 1
title = "signs"
kinematics = "{kinematics}"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.A]
mesh.block = {{ min = {}, max = {}, divisions = {divisions}, element = "{element}" }}
material = "rock"
[bodies.B]
mesh.block = {{ min = {}, max = {}, divisions = {divisions}, element = "{element}" }}
material = "rock"
[faults.main]
minus = "A.right"
plus = "B.left"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = 0.01, v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal = "50 MPa"
under_resolved = "allow"
rate = {:e}
damping = "radiation"
{rake}[[stages]]
name = "cycles"
duration = "150 yr"
conditions = [{}, {}]
[time]
stepper = "fault-ode"
[events]
above = "1e-4 m/s"
stop_after = 1
[output]
bodies = true
stations.main = {station}
{place}"#,
        corner([-2.0, 0.0, 0.0]),
        corner([0.0, 2.0, 2.0]),
        corner([0.0, 0.0, 0.0]),
        corner([2.0, 2.0, 2.0]),
        1.1e-9 * rate,
        driven("A.left", -1.0),
        driven("B.right", 1.0),
    )
}
