//! Faults that cross, fold over themselves, or lie too close to each other in a medium are refused, with both places.

use asperity_plan::plan_scene;
use asperity_plan::reading::scene;
use std::fmt::Write as _;
use std::path::Path;

/// A scene with faults of these geometries.
fn text(kinematics: &str, faults: &[String]) -> String {
    let mut text = format!(
        "schema = 1\ntitle = \"apart\"\nkinematics = \"{kinematics}\"\n[materials.rock]\nyoung = \"80 GPa\"\npoisson = 0.25\ndensity = 2670\n\
         [medium]\nkind = \"half-space\"\nmaterial = \"rock\"\n"
    );
    for (k, geometry) in faults.iter().enumerate() {
        let _ = writeln!(
            text,
            "[faults.f{k}]\n{geometry}\n{}\
             law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.010, b = 0.015, l = \"40 cm\", v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\" }}\n\
             normal = \"50 MPa\"\nunder_resolved = \"allow\"\nrate = 1e-9\ndamping = \"radiation\"\ncreep = {{ rate = 1e-9 }}",
            if kinematics == "3d" { "rake = [0.6, 0.3, 1]\n" } else { "" }
        );
    }
    text + "[[stages]]\nname = \"cycles\"\nduration = \"100 yr\"\n[time]\nstepper = \"fault-ode\"\n"
}

/// A line through these vertices \[km\] with cells of this size \[km\].
fn line(trace: &[[f64; 2]], size: f64) -> String {
    format!(
        "line = {{ trace = {:?}, spacing = {}, interpolation = \"polyline\" }}",
        metres(trace),
        size * 1e3
    )
}

fn metres<const D: usize>(x: &[[f64; D]]) -> Vec<[f64; D]> {
    x.iter().map(|x| x.map(|c| 1e3 * c)).collect()
}

/// A rectangle \[km\].
fn rectangle([from, to]: [[f64; 3]; 2], dip: f64, width: f64, size: f64) -> String {
    let ends = metres(&[from, to]);
    format!(
        "rectangle = {{ from = {:?}, to = {:?}, dip = \"{dip} deg\", width = \"{width} km\", size = \"{size} km\" }}",
        ends[0], ends[1]
    )
}

/// Refusal of a scene by its plan.
fn refused(kinematics: &str, faults: &[String], folder: &Path) -> Option<String> {
    let scene = scene::read_in(&text(kinematics, faults), folder).unwrap_or_else(|e| panic!("{e}"));
    plan_scene(&scene).err().map(|e| e.message)
}

#[track_caller]
fn assert_refused(kinematics: &str, faults: &[String], words: &str) {
    let message = refused(kinematics, faults, Path::new("."));
    assert!(message.as_ref().is_some_and(|m| m.contains(words)), "{message:?} has no `{words}`: {faults:?}");
}

#[track_caller]
fn assert_planned(kinematics: &str, faults: &[String]) {
    assert_eq!(refused(kinematics, faults, Path::new(".")), None, "{faults:?}");
}

#[test]
fn a_line_neither_crosses_itself_nor_folds_back() {
    for kinematics in ["antiplane", "plane-strain"] {
        let one = |trace: &[[f64; 2]]| vec![line(trace, 0.5)];
        assert_refused(
            kinematics,
            &one(&[[0.0, 0.0], [0.0, -20.0], [0.0, -10.0], [0.0, -40.0]]),
            "crosses itself or lies on itself",
        );
        // At a vertex of both parts, and within cells.
        for y in [-10.0, -10.2] {
            let crosses = [[0.0, 0.0], [0.0, -20.0], [10.0, -20.0], [10.0, y], [-10.0, y]];
            assert_refused(kinematics, &one(&crosses), "crosses itself or lies on itself");
        }
        // Its end comes within 100 m of its beginning.
        assert_refused(
            kinematics,
            &one(&[[0.0, 0.0], [0.0, -5.0], [3.0, -5.0], [0.1, -2.0]]),
            "close to itself",
        );
        // Corners of a right angle, and of 35 degrees between the legs, are bends.
        assert_planned(kinematics, &one(&[[0.0, 0.0], [0.0, -5.0], [5.0, -5.0], [5.0, -9.0]]));
        let sharp = 35f64.to_radians();
        assert_planned(
            kinematics,
            &one(&[[0.0, -1.0], [0.0, -9.0], [8.0 * sharp.sin(), -9.0 + 8.0 * sharp.cos()]]),
        );
    }
    // A spline whose cells grow away from the middle.
    let spline = "line = { trace = [[0, 0], [3e3, -1e4], [0, -2e4]], spacing = { from = 8e3, to = 1e4, size = 200, ratio = 1.5 } }";
    assert_planned("antiplane", &[spline.to_string()]);
}

#[test]
fn two_lines_meet_end_to_end_and_do_not_cross_whatever_their_cells() {
    let upright = |size| line(&[[0.0, 0.0], [0.0, -40.0]], size);
    for (big, small) in [(4.0, 0.05), (4.0, 0.1), (0.5, 0.5), (4.0, 2.0)] {
        let level = |from: f64, to: f64| line(&[[from, -4.0], [to, -4.0]], small);
        // Across a vertex of both, within cells, and a branch from a vertex.
        for other in [level(-2.05, 2.05), level(-2.05, 2.0), level(0.0, 4.0), level(-4.0, -0.02)] {
            let words = if other == level(-4.0, -0.02) { "lie too close" } else { "cross or branch" };
            assert_refused("antiplane", &[upright(big), other.clone()], words);
            assert_refused("antiplane", &[other, upright(big)], words);
        }
    }
    let above = line(&[[0.0, 0.0], [0.0, -8.0]], 4.0);
    // The continuation, with smaller cells that grow or with a corner of a right angle.
    assert_planned("antiplane", &[above.clone(), line(&[[0.0, -8.0], [0.0, -12.0]], 0.05)]);
    assert_planned("antiplane", &[above.clone(), line(&[[0.0, -8.0], [4.0, -8.0]], 0.05)]);
    let graded = "line = { trace = [[0, -8e3], [0, -2e4]], spacing = { from = 0, to = 200, size = 100, ratio = 1.5 } }";
    assert_planned("antiplane", &[above.clone(), graded.to_string()]);
    // Sharper than a right angle.
    assert_refused("antiplane", &[above.clone(), line(&[[0.0, -8.0], [4.0, -5.0]], 0.5)], "cross or branch");
    // Beside each other.
    let beside = |x: f64| line(&[[x, 0.0], [x, -8.0]], 4.0);
    assert_refused("antiplane", &[above.clone(), beside(3.5)], "3500.0000 m apart");
    assert_planned("antiplane", &[above, beside(3.7)]);
}

#[test]
fn rectangles_meet_at_edges_and_do_not_cross_whatever_their_cells() {
    let main = || rectangle([[0.0, -1.0, 10.0], [0.0, -1.0, -10.0]], 90.0, 10.0, 2.0);
    let across = |y: f64, size| rectangle([[-5.05, y, 0.0], [5.05, y, 0.0]], 90.0, 4.0, size);
    assert_refused("3d", &[main(), across(-2.0, 0.5)], "cross or branch");
    assert_refused("3d", &[across(-2.0, 2.0), main()], "cross or branch");
    assert_planned("3d", &[main(), across(-13.0, 1.0)]);
    let beside = rectangle([[1.5, -1.0, 10.0], [1.5, -1.0, -10.0]], 90.0, 10.0, 1.0);
    assert_refused("3d", &[main(), beside], "1500.0000 m apart");
    // A ramp that continues the fault at an angle below, with other cells; and one that begins at half its depth.
    let ramp = |y: f64| rectangle([[0.0, y, 10.0], [0.0, y, -10.0]], 40.0, 8.0, 1.0);
    assert_planned("3d", &[main(), ramp(-11.0)]);
    assert_refused("3d", &[main(), ramp(-7.0)], "cross or branch");
}

/// Triangles as a file.
fn stl(triangles: &[[[f64; 3]; 3]]) -> String {
    let mut out = "solid s\n".to_string();
    for triangle in triangles {
        out += "facet\n";
        triangle.iter().for_each(|[x, y, z]| out += &format!("vertex {x} {y} {z}\n"));
        out += "endfacet\n";
    }
    out + "endsolid s\n"
}

/// Two triangles between corners of a sheet in order.
fn sheet([a, b, c, d]: [[f64; 3]; 4]) -> [[[f64; 3]; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

#[test]
fn triangles_neither_fold_nor_cross() {
    let here = tempfile::tempdir().unwrap();
    let of = |triangles: &[[[f64; 3]; 3]]| {
        std::fs::write(here.path().join("f.stl"), stl(triangles)).unwrap();
        refused("3d", &["triangles.stl = { file = \"f.stl\" }".to_string()], here.path())
    };
    let lower = |x: f64, y: f64| sheet([[0.0, -4e3, 0.0], [x, y, 0.0], [x, y, 4e3], [0.0, -4e3, 4e3]]);
    let upper = sheet([[0.0, -1e3, 0.0], [0.0, -4e3, 0.0], [0.0, -4e3, 4e3], [0.0, -1e3, 4e3]]);
    let both = |x, y| [upper, lower(x, y)].concat();
    assert_eq!(of(&both(1e3, -7e3)), None);
    let folded = of(&both(1e3, -1.5e3)).unwrap();
    assert!(folded.contains("itself"), "{folded}");
    // A sheet of the same fault across the other.
    let across = sheet([[-2e3, -2e3, 1e3], [2e3, -2e3, 1e3], [2e3, -2e3, 3e3], [-2e3, -2e3, 3e3]]);
    let crossed = of(&[upper, across].concat()).unwrap();
    assert!(crossed.contains("crosses itself"), "{crossed}");
    let near = across.map(|t| t.map(|[x, y, z]| [x + 2.1e3, y, z]));
    let close = of(&[upper, near].concat()).unwrap();
    assert!(close.contains("close to itself"), "{close}");
}
