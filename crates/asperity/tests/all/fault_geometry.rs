//! Sides, segments, traces and supports of faults: changes that must not matter, refusals, and warnings.

use crate::common::varied;
use asperity_ode::Outcome;
use asperity_plan::faults::Plan;
use asperity_plan::reading::diagnostic::Diagnostic;
use asperity_plan::reading::{diagnostic, scene};
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::Change::With;
use asperity_vary::SceneText;
use std::fmt::Write as _;
use std::path::Path;

const LAW: &str = r#"law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "30 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
under_resolved = "allow"
rate = "1e-9 m/s"
damping = "radiation"
"#;

/// A scene of these bodies, faults and conditions.
fn text(kinematics: &str, parts: &str, conditions: &str) -> String {
    format!(
        "schema = 1\ntitle = \"sides\"\nkinematics = \"{kinematics}\"\n[materials.rock]\nyoung = \"80 GPa\"\npoisson = 0.25\ndensity = 2670\n\
         {parts}\n[[stages]]\nname = \"cycles\"\nduration = \"3000 yr\"\nconditions = [{conditions}]\n[time]\nstepper = \"fault-ode\"\n\
         [events]\nabove = \"1 mm/s\"\nstop_after = 2\n"
    )
}

fn planned(text: &str, folder: &Path) -> Result<Plan, Diagnostic> {
    let scene = scene::read_in(text, folder).unwrap_or_else(|e| panic!("{e}\n{text}"));
    match plan_scene(&scene)? {
        ScenePlan::Faults(plan) => Ok(*plan),
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

fn plan(text: &str) -> Plan {
    planned(text, Path::new(".")).unwrap_or_else(|e| panic!("{e} {:?}\n{text}", e.help))
}

/// Corners of the cells of a grid, by their numbers along each axis.
struct Grid {
    lines: Vec<Vec<f64>>,
}

impl Grid {
    /// A node by its numbers, counted from 1 as files do.
    fn node(&self, at: &[usize]) -> usize {
        at.iter().zip(&self.lines).rev().fold(0, |n, (i, line)| n * line.len() + i) + 1
    }

    /// As a file of Gmsh's version 2.2: cells of a group `rock`, and faces with their groups.
    fn file(&self, faces: &[(&str, Vec<Vec<usize>>)]) -> String {
        let d = self.lines.len();
        let mut out = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n");
        let _ = writeln!(out, "{}\n{d} 1 \"rock\"", faces.len() + 1);
        for (k, (name, _)) in faces.iter().enumerate() {
            let _ = writeln!(out, "{} {} \"{name}\"", d - 1, k + 2);
        }
        let counts: Vec<usize> = self.lines.iter().map(Vec::len).collect();
        let total: usize = counts.iter().product();
        let _ = writeln!(out, "$EndPhysicalNames\n$Nodes\n{total}");
        let split = |mut n: usize, counts: &[usize]| -> Vec<usize> {
            counts
                .iter()
                .map(|c| {
                    let i = n % c;
                    n /= c;
                    i
                })
                .collect()
        };
        for n in 0..total {
            let at = split(n, &counts);
            let x: Vec<String> = at.iter().zip(&self.lines).map(|(&i, l)| l[i].to_string()).collect();
            let z = if d == 2 { " 0" } else { "" };
            let _ = writeln!(out, "{} {}{z}", n + 1, x.join(" "));
        }
        let cells: Vec<usize> = counts.iter().map(|c| c - 1).collect();
        let mut elements: Vec<String> = Vec::new();
        let around: &[[usize; 2]] = &[[0, 0], [1, 0], [1, 1], [0, 1]];
        for c in 0..cells.iter().product() {
            let at = split(c, &cells);
            let layer = |z: Option<usize>| -> Vec<String> {
                let corner = |[i, j]: &[usize; 2]| {
                    let mut x = vec![at[0] + i, at[1] + j];
                    x.extend(z);
                    self.node(&x).to_string()
                };
                around.iter().map(corner).collect()
            };
            let (kind, nodes) = if d == 2 {
                (3, layer(None))
            } else {
                (5, [layer(Some(at[2])), layer(Some(at[2] + 1))].concat())
            };
            elements.push(format!("{kind} 2 1 1 {}", nodes.join(" ")));
        }
        for (k, (_, list)) in faces.iter().enumerate() {
            for nodes in list {
                let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
                elements.push(format!(
                    "{} 2 {} {} {}",
                    if d == 2 { 1 } else { 3 },
                    k + 2,
                    k + 2,
                    nodes.join(" ")
                ));
            }
        }
        let _ = writeln!(out, "$EndNodes\n$Elements\n{}", elements.len());
        for (k, element) in elements.iter().enumerate() {
            let _ = writeln!(out, "{} {element}", k + 1);
        }
        out + "$EndElements\n"
    }
}

/// Cells of 1 km by 500 m, 12 km wide and 24 km deep.
fn plane() -> Grid {
    Grid {
        lines: vec![
            (0..13).map(|i| f64::from(i) - 6.0).collect(),
            (0..49).map(|j| 0.5 * f64::from(j) - 24.0).collect(),
        ],
    }
}

/// Edges of the middle line of the plane between two rows, upwards: minus is to the left.
fn upright(grid: &Grid, rows: std::ops::Range<usize>) -> Vec<Vec<usize>> {
    rows.map(|j| vec![grid.node(&[6, j]), grid.node(&[6, j + 1])]).collect()
}

/// Sides of a grid in the plane.
fn borders(grid: &Grid) -> [(&'static str, Vec<Vec<usize>>); 2] {
    let side = |i: usize| (0..48).map(|j| vec![grid.node(&[i, j]), grid.node(&[i, j + 1])]).collect();
    [("left", side(0)), ("right", side(12))]
}

/// A scene of the plane split along these lines, with a fault of the same properties on each.
fn plan_of_lines(
    kinematics: &str,
    lines: &[(&str, Vec<Vec<usize>>)],
    more: &str,
) -> Result<Plan, Diagnostic> {
    let grid = plane();
    let mut faces: Vec<_> = borders(&grid).to_vec();
    faces.extend(lines.iter().cloned());
    let names: Vec<String> = lines.iter().map(|(name, _)| format!("\"{name}\"")).collect();
    let mut parts = format!(
        "[bodies.B]\nmaterial = \"rock\"\nmesh.gmsh = {{ file = \"grid.msh\", unit = \"km\", split = [{}] }}\n",
        names.join(", ")
    );
    for (name, _) in lines {
        let _ = writeln!(
            parts,
            "[faults.{name}]\nminus = \"B.{name}.minus\"\nplus = \"B.{name}.plus\"\n{LAW}\
             profiles.a = {{ along = \"y\", points = [[\"-20 km\", 0.025], [\"-16 km\", 0.010]] }}\n\
             profiles.l = {{ along = \"y\", points = [[\"-10 km\", 0.031], [\"-2 km\", 0.030]] }}"
        );
    }
    parts += more;
    let moves = if kinematics == "antiplane" { "z" } else { "x = 0, y" };
    let conditions = format!(
        "{{ set = \"B.left\", {moves} = {{ rate = \"-0.5e-9 m/s\" }} }}, {{ set = \"B.right\", {moves} = {{ rate = \"0.5e-9 m/s\" }} }}"
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("grid.msh"), grid.file(&faces)).unwrap();
    // States younger than those of steady sliding, which is an unstable balance that only rounding would disturb.
    let younger = |scene: SceneText, (name, _): &(&str, _)| {
        scene.with(&format!("faults.{name}.law.v_initial"), "1e-8 m/s")
    };
    let scene = SceneText::new(&text(kinematics, &parts, &conditions));
    planned(&lines.iter().fold(scene, younger).text().unwrap(), folder.path())
}

/// Points of a plan in the order of their coordinates.
fn order(plan: &Plan) -> Vec<usize> {
    let mut order: Vec<usize> = (0..plan.points.len()).collect();
    order.sort_by(|&a, &b| plan.points[a].at.partial_cmp(&plan.points[b].at).unwrap());
    order
}

/// Tractions at all points that unit slip of one causes, shear before normal, both in the order of coordinates.
fn responses(plan: &Plan) -> Vec<Vec<f64>> {
    let (order, n) = (order(plan), plan.points.len());
    let response = |&p: &usize| {
        let mut slip = vec![0.0; n];
        slip[p] = 1.0;
        let operator = &plan.problem.fault.operator;
        let (shear, normal) = (operator.shear_of(&slip), operator.normal_of(&slip));
        order.iter().map(|&p| shear[p]).chain(order.iter().map(|&p| normal[p])).collect()
    };
    order.iter().map(response).collect()
}

/// Asserts that two plans have the same points, operator, loads and starts, but for rounding of the elimination.
fn same(a: &Plan, b: &Plan) {
    let close = |x: f64, y: f64, scale: f64| assert!((x - y).abs() <= 1e-10 * scale, "{x} {y}");
    let n = a.points.len();
    assert_eq!(n, b.points.len());
    let (p, q) = (order(a), order(b));
    let load = |plan: &Plan| plan.problem.loading.rates(1.0, n, plan.problem.fault.operator.couples_normal());
    let (of_a, of_b) = (load(a), load(b));
    let strongest = of_a.0.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
    for (&i, &j) in p.iter().zip(&q) {
        let (x, y) = (&a.points[i], &b.points[j]);
        // If minus and plus are exchanged, the other side moves.
        let along: f64 = x.slides.iter().zip(&y.slides).map(|(a, b)| a * b).sum();
        assert!(x.at == y.at && (along.abs() - 1.0).abs() < 1e-12, "{x:?} {y:?}");
        close(x.area, y.area, x.area);
        close(of_a.0[i], of_b.0[j], strongest);
        close(a.problem.fault.normal[i], b.problem.fault.normal[j], 50e6);
        close(a.problem.start[i], b.problem.start[j], a.problem.start[i].abs());
    }
    let (x, y) = (responses(a), responses(b));
    let strongest = x.iter().flatten().fold(0.0_f64, |l, v| l.max(v.abs()));
    x.iter().flatten().zip(y.iter().flatten()).for_each(|(x, y)| close(*x, *y, strongest));
}

/// Onsets of the first two events \[s\].
fn onsets(plan: &Plan) -> Vec<f64> {
    let out = plan.problem.run(&plan.problem.settings, &mut ()).unwrap();
    assert_eq!(out.outcome, Outcome::Stopped);
    out.events().iter().map(|e| e.onset.seconds()).collect()
}

#[test]
fn segments_that_meet_end_to_end_are_one_fault() {
    let grid = plane();
    for kinematics in ["antiplane", "plane-strain"] {
        let whole = plan_of_lines(kinematics, &[("fault", upright(&grid, 0..48))], "").unwrap();
        let lines = [("lower", upright(&grid, 0..20)), ("upper", upright(&grid, 20..48))];
        let parts = plan_of_lines(kinematics, &lines, "").unwrap();
        same(&whole, &parts);
        let met = |note: &&String| note.contains("`lower` and `upper` meet: the point at (0, -14000) m");
        assert_eq!(parts.notes.iter().filter(met).count(), 1, "{:?}", parts.notes);
        assert_eq!(parts.faults[0].points.len(), 21);
        let (x, y) = (onsets(&whole), onsets(&parts));
        // Only the numbers of the points differ, and with them the order of sums.
        assert!(x.len() == 2 && x.iter().zip(&y).all(|(x, y)| (x / y - 1.0).abs() < 1e-7), "{x:?} {y:?}");
        // A segment whose sides are exchanged is the same segment.
        let turned = upright(&grid, 20..48).into_iter().map(|e| vec![e[1], e[0]]).collect();
        same(
            &whole,
            &plan_of_lines(kinematics, &[("lower", upright(&grid, 0..20)), ("upper", turned)], "").unwrap(),
        );
    }
}

#[test]
fn a_patch_inside_a_plane_and_the_plane_around_it_are_one_fault() {
    let grid = Grid {
        lines: vec![
            vec![-4.0, -1.0, 0.0, 1.0, 4.0],
            (0..8).map(f64::from).collect(),
            (0..7).map(f64::from).collect(),
        ],
    };
    let faces = |take: &dyn Fn(usize, usize) -> bool| -> Vec<Vec<usize>> {
        let all = (0..7).flat_map(|j| (0..6).map(move |k| (j, k))).filter(|&(j, k)| take(j, k));
        all.map(|(j, k)| {
            [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| grid.node(&[2, j + a, k + b])).to_vec()
        })
        .collect()
    };
    let side = |i: usize| -> Vec<Vec<usize>> {
        let all = (0..7).flat_map(|j| (0..6).map(move |k| (j, k)));
        all.map(|(j, k)| {
            [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| grid.node(&[i, j + a, k + b])).to_vec()
        })
        .collect()
    };
    let of = |surfaces: &[(&str, Vec<Vec<usize>>)]| {
        let mut all = vec![("left", side(0)), ("right", side(4))];
        all.extend(surfaces.iter().cloned());
        let names: Vec<String> = surfaces.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let mut parts = format!(
            "[bodies.B]\nmaterial = \"rock\"\nmesh.gmsh = {{ file = \"grid.msh\", unit = \"km\", split = [{}] }}\n",
            names.join(", ")
        );
        for (name, _) in surfaces {
            let _ = writeln!(
                parts,
                "[faults.{name}]\nminus = \"B.{name}.minus\"\nplus = \"B.{name}.plus\"\nrake = [0, 0.6, 0.8]\n{LAW}"
            );
        }
        let conditions = "{ set = \"B.left\", x = 0, y = 0, z = 0 }, { set = \"B.right\", x = 0, y = { rate = 1e-9 }, z = { rate = 1e-9 } }";
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("grid.msh"), grid.file(&all)).unwrap();
        planned(&text("3d", &parts, conditions), folder.path()).unwrap_or_else(|e| panic!("{e}"))
    };
    let inner = |j: usize, k: usize| (2..5).contains(&j) && (2..4).contains(&k);
    let whole = of(&[("fault", faces(&|_, _| true))]);
    let parts = of(&[("patch", faces(&inner)), ("rim", faces(&|j, k| !inner(j, k)))]);
    same(&whole, &parts);
    // 4 x 3 nodes of the patch, of which 10 are on its border.
    assert_eq!(parts.faults[0].points.len(), 12);
    let met = |note: &String| note.contains("meet: 10 points, the first at");
    assert!(parts.notes.iter().any(met), "{:?}", parts.notes);
}

#[test]
fn faces_of_two_faults_and_branches_are_refused_with_words() {
    let grid = plane();
    let lines = [("lower", upright(&grid, 0..20)), ("upper", upright(&grid, 20..48))];
    let again = format!("[faults.more]\nminus = \"B.upper.minus\"\nplus = \"B.upper.plus\"\n{LAW}");
    let error = plan_of_lines("antiplane", &lines, &again).unwrap_err();
    assert!(error.message.contains("faults `more` and `upper` both have the face at (0, "), "{error}");
    assert!(error.help.unwrap().contains("a face belongs to one fault") && !error.span.is_empty());
    let turned = format!("[faults.more]\nminus = \"B.upper.plus\"\nplus = \"B.upper.minus\"\n{LAW}");
    assert!(plan_of_lines("antiplane", &lines, &turned).unwrap_err().message.contains("both have the face"));
    // A branch to the right at 12 km.
    let branch: Vec<Vec<usize>> =
        (6..10).map(|i| vec![grid.node(&[i, 24]), grid.node(&[i + 1, 24])]).collect();
    let error = plan_of_lines("antiplane", &[("main", upright(&grid, 0..48)), ("splay", branch.clone())], "")
        .unwrap_err();
    assert!(error.message.contains("branch") && error.message.contains("(0, -12000) m"), "{error}");
    assert!(error.message.contains("more than two sides meet there") && !error.span.is_empty(), "{error}");
    // In one set.
    let both = [upright(&grid, 0..48), branch.clone()].concat();
    let error = plan_of_lines("antiplane", &[("main", both)], "").map(|_| ()).unwrap_err();
    assert!(error.message.contains("branch"), "{error}");
    // One cell away, it is a separate fault.
    let apart =
        plan_of_lines("antiplane", &[("main", upright(&grid, 0..48)), ("splay", branch[1..].to_vec())], "")
            .unwrap();
    assert_eq!(apart.faults.len(), 2);
    assert!(apart.notes.iter().all(|note| !note.contains("meet")), "{:?}", apart.notes);
}

/// Two adjacent blocks with these divisions; the right one has this depth \[km\].
fn blocks(left: usize, right: usize, depth: usize, swapped: bool) -> String {
    let sides = ["A.right", "B.left"];
    let [minus, plus] = if swapped { [sides[1], sides[0]] } else { sides };
    format!(
        "[bodies.A]\nmaterial = \"rock\"\nmesh.block = {{ min = [\"-10 km\", \"-20 km\"], max = [0, 0], divisions = [4, {left}], element = \"quad4\" }}\n\
         [bodies.B]\nmaterial = \"rock\"\nmesh.block = {{ min = [0, \"-{depth} km\"], max = [\"10 km\", 0], divisions = [4, {right}], element = \"quad4\" }}\n\
         [faults.main]\nminus = \"{minus}\"\nplus = \"{plus}\"\n{LAW}"
    )
}

const SIDES: &str =
    r#"{ set = "A.left", z = { rate = "-0.5e-9 m/s" } }, { set = "B.right", z = { rate = "0.5e-9 m/s" } }"#;

#[test]
fn nodes_of_one_side_alone_are_refused_whichever_side_it_is() {
    let refused = |left, right, swapped| {
        let error = planned(&text("antiplane", &blocks(left, right, 20, swapped), SIDES), Path::new("."))
            .unwrap_err();
        assert!(error.message.contains("do not lie on each other"), "{error}");
        error.message
    };
    for swapped in [false, true] {
        let message = refused(10, 20, swapped);
        let own = if swapped { "minus" } else { "plus" };
        assert!(message.contains(&format!(" of the {own} side ")), "{message}");
        refused(20, 10, swapped);
    }
    // Every second of the 21 nodes.
    assert!(refused(10, 20, false).contains("10 of them, the first at (0, -"));
    // A plus side that reaches deeper than the minus side is free there.
    let deeper = plan(&text("antiplane", &blocks(10, 12, 24, false), SIDES));
    assert_eq!(deeper.points.len(), 11);
}

#[test]
fn sides_of_one_set_of_nodes_are_refused_with_words() {
    let text = text("antiplane", &blocks(10, 10, 20, false), SIDES);
    let error = planned(&varied(&text, &[With("faults.main.plus", "A.right")]), Path::new(".")).unwrap_err();
    assert!(error.message.contains("both sides of fault `main` are the same nodes"), "{error}");
}

/// A fault that dips by 60 degrees through a box.
fn dipping(swapped: bool, conditions: &str) -> Result<Plan, Diagnostic> {
    let [minus, plus] = if swapped { ["plus", "minus"] } else { ["minus", "plus"] };
    let parts = format!(
        "[bodies.B]\nmaterial = \"rock\"\nmesh.fault = {{ trace = [[0, 0], [\"10 km\", \"-17.320508 km\"]], spacing = \"1 km\", \
         min = [\"-20 km\", \"-17.320508 km\"], max = [\"30 km\", 0], growth = 1.5, element = \"quad4\" }}\n\
         [faults.main]\nminus = \"B.fault.{minus}\"\nplus = \"B.fault.{plus}\"\n{LAW}"
    );
    planned(&text("plane-strain", &parts, conditions), Path::new("."))
}

#[test]
fn minus_and_plus_may_be_exchanged_whatever_holds_one_of_them() {
    // Sides that end at the surface only.
    let free = r#"{ set = "B.left", x = 0, y = 0 }, { set = "B.right", x = 0, y = { rate = -1e-9 } }"#;
    same(&dipping(false, free).unwrap(), &dipping(true, free).unwrap());
    // Blocks whose bottoms end at the fault: one held, or both in other components.
    let held = |conditions: &str| {
        let of = |swapped| {
            let parts = blocks(10, 10, 20, swapped);
            planned(&text("plane-strain", &parts, conditions), Path::new("."))
                .unwrap_or_else(|e| panic!("{e}"))
        };
        same(&of(false), &of(true));
    };
    let sides = r#"{ set = "A.left", x = 0, y = 0 }, { set = "B.right", x = 0, y = { rate = 1e-9 } }"#;
    for bottom in [
        r#"{ set = "A.bottom", x = 0, y = 0 }"#,
        r#"{ set = "B.bottom", x = 0 }"#,
        r#"{ set = "B.bottom", x = 0, y = { rate = 1e-9 } }"#,
    ] {
        held(&format!("{sides}, {bottom}"));
    }
}

#[test]
fn supports_across_an_oblique_fault_are_refused_with_set_and_place() {
    let sides = r#"{ set = "B.left", x = { rate = -1e-9 } }, { set = "B.right", x = { rate = 1e-9 } }"#;
    for swapped in [false, true] {
        let error = dipping(swapped, &format!("{sides}, {{ set = \"B.bottom\", y = 0 }}")).unwrap_err();
        assert!(
            error.message.contains("`B.bottom`: conditions hold y on both sides of a fault that is oblique"),
            "{error}"
        );
        assert!(error.message.contains("at (10000, -17320.508) m") && !error.span.is_empty(), "{error}");
        assert!(error.help.unwrap().contains("let the fault end inside the bodies"));
    }
}

/// Warnings of a plan, each with the text that it refers to.
fn warnings(text: &str) -> Vec<(String, String)> {
    let at = |w: &asperity_run::Warning| (w.message.clone(), text[w.span.clone()].to_string());
    // Cells are coarse here on purpose, nothing is radiated, and the start is steady.
    let all = ["cohesive zone", "nothing is radiated", "start in steady slip"];
    let meant = |w: &str| all.iter().any(|words| w.contains(words));
    plan(text).warnings.iter().filter(|w| !meant(&w.message)).map(at).collect()
}

#[test]
fn profiles_that_take_no_point_are_refused_or_warned_of() {
    let scene = |profiles: &str| text("antiplane", &(blocks(10, 10, 20, false) + profiles), SIDES);
    let quiet =
        scene("profiles.a = { along = \"distance\", points = [[\"15 km\", 0.010], [\"18 km\", 0.025]] }\n");
    assert_eq!(warnings(&quiet), []);
    let metres = scene("profiles.a = { along = \"y\", points = [[\"15 km\", 0.010], [\"18 km\", 0.025]] }\n");
    let error = planned(&metres, Path::new(".")).unwrap_err();
    assert!(error.message.contains("the profile of `a` does not vary over fault `main`"), "{error}");
    assert!(
        error.message.contains("from 15000 m to 18000 m along y, the sliding points from -20000 m to 0 m"),
        "{error}"
    );
    let list = "profiles.a = [{ along = \"y\", points = [[\"-15 km\", 0.010], [\"-3 km\", 0.025]] }, { along = \"y\", points = [[0, 0.005]] }]\n";
    let found = warnings(&scene(list));
    assert!(found.len() == 1 && found[0].0.contains("takes no point"), "{found:?}");
    assert_eq!(found[0].1, "[[0, 0.005]]");
}

#[test]
fn loads_and_creep_against_the_sense_of_slip_are_warned_of() {
    let creep = "creep = { beyond = \"15 km\", rate = \"1e-9 m/s\" }\n";
    let parts = blocks(10, 10, 20, false) + creep;
    assert_eq!(warnings(&text("antiplane", &parts, SIDES)), []);
    let with = text("antiplane", &parts, SIDES);
    let against = ["5e-9 m/s", "-5e-9 m/s"];
    let [left, right] = [0, 1].map(|k| format!("stages[0].conditions[{k}].z.rate"));
    let found = warnings(&varied(&with, &[With(&left, against[0]), With(&right, against[1])]));
    assert!(
        found.len() == 1 && found[0].0.contains("the loads drive fault `main` against `rate`"),
        "{found:?}"
    );
    assert!(found[0].0.contains("the plus side `B.left` slip along (0.000, 0.000, 1.000)"), "{found:?}");
    assert_eq!(found[0].1, "\"1e-9 m/s\"");
    let found = warnings(&varied(&with, &[With("faults.main.creep.rate", "-1e-12 m/s")]));
    assert!(found.len() == 1 && found[0].0.contains("fault `main` creeps against its `rate`"), "{found:?}");
    assert_eq!(found[0].1, "\"-1e-12 m/s\"");
}

#[test]
fn stations_less_than_a_cell_off_are_taken() {
    let scene = |at: &str| {
        text("antiplane", &blocks(10, 10, 20, false), SIDES)
            + &format!("[output]\nstations.main = [\"{at}\"]\n")
    };
    assert_eq!(plan(&scene("21 km")).faults[0].stations[0].1, 10);
    let text = scene("45 km");
    let error = planned(&text, Path::new(".")).unwrap_err();
    assert!(
        error.message.contains("the station at 45000 m along fault `main` lies off its sliding points"),
        "{error}"
    );
    assert!(error.message.contains("from 0 m to 20000 m along it: the nearest one is at 20000 m"), "{error}");
    assert_eq!(diagnostic::line_column(&text, error.span.start).0, text.lines().count());
}

/// A listric fault until its third event: an arc of 45 degrees of the circle of radius 40 km about (40, 0) km, down from
/// the surface, in this many segments.
fn listric(segments: usize, more: &str) -> Plan {
    let vertex = |k: usize| {
        let (s, c) = (std::f64::consts::FRAC_PI_4 * k as f64 / segments as f64).sin_cos();
        format!("[\"{} km\", \"{} km\"]", 40.0 * (1.0 - c), -40.0 * s)
    };
    let trace: Vec<String> = (0..=segments).map(vertex).collect();
    let parts = format!(
        "[bodies.B]\nmaterial = \"rock\"\nmesh.fault = {{ trace = [{}], spacing = [[0, \"1 km\"]], min = [\"-100 km\", \"-100 km\"], \
         max = [\"140 km\", 0], growth = 1.3, element = \"quad9\"{more} }}\n\
         [faults.main]\nminus = \"B.fault.minus\"\nplus = \"B.fault.plus\"\n{LAW}",
        trace.join(", ")
    );
    let conditions = r#"{ set = "B.left", x = { rate = "-0.5e-9 m/s" }, y = 0 }, { set = "B.right", x = { rate = "0.5e-9 m/s" }, y = 0 }"#;
    let text = text("plane-strain", &parts, conditions);
    plan(&varied(&text, &[With("faults.main.rate", "-1e-9 m/s"), With("faults.main.law.l", "60 mm")]))
}

#[test]
fn a_listric_fault_of_few_vertices_is_that_of_many() {
    // Work of the shear tractions due to a bump of slip on that slip, work of its normal tractions on an opening of the
    // same size, and the largest normal traction.
    let measure = |plan: &Plan| {
        let n = plan.points.len();
        let length = plan.points[n - 1].along;
        let bump = |p: usize| (std::f64::consts::PI * plan.points[p].along / length).sin().powi(4);
        let slip: Vec<f64> = (0..n).map(bump).collect();
        let shear = plan.problem.fault.operator.shear_of(&slip);
        let normal = plan.problem.fault.operator.normal_of(&slip);
        let work = |t: &[f64]| (0..n).map(|p| plan.points[p].area * t[p] * slip[p]).sum::<f64>();
        (work(&shear), work(&normal), normal.iter().fold(0.0_f64, |l, v| l.max(v.abs())))
    };
    let dense = measure(&listric(32, ""));
    let curve = measure(&listric(3, ""));
    let corners = measure(&listric(3, ", interpolation = \"polyline\""));
    let far = |a: f64, b: f64| (a / b - 1.0).abs();
    // Both have errors of second order in the size of cells, with fifteen along the bump: (1/15)^2 = 0.4 %, and the
    // cells end at other positions.
    assert!(far(curve.0, dense.0) < 0.005 && far(curve.1, dense.1) < 0.02, "{curve:?} {dense:?}");
    // Normal tractions alternate at the corners of cells, by an amount that depends on where cells end.
    assert!(far(curve.2, dense.2) < 0.1, "{curve:?} {dense:?}");
    // Corners of 15 degrees cause much larger normal tractions than a bend of 1.4 degrees per cell.
    assert!(corners.2 > 2.0 * dense.2, "{corners:?} {dense:?}");
    assert!(
        listric(3, ", interpolation = \"polyline\"").notes[0]
            .contains("turns by up to 15.0 degrees from one cell")
    );
    assert!(
        listric(3, "").notes[0].contains("is a smooth curve through the 4 vertices of its trace, at most")
    );
}
