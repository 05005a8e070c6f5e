//! The plus side of a surface along which the mesh of a file is split follows its position, not the order of the file.

use crate::common::told;
use crate::resume::text;
use std::fmt::Write as _;
use std::process::Command;

/// Corners of a plane mesh of 4 x 4 squares of 1 km.
const N: usize = 5;

fn node([x, y]: [usize; 2]) -> usize {
    x + N * y + 1
}

/// Edges along a path of corners.
fn path(points: &[[usize; 2]]) -> Vec<[usize; 2]> {
    points.windows(2).map(|w| [node(w[0]), node(w[1])]).collect()
}

/// A file of Gmsh with the edges of a surface `fall` and its cells in these orders.
fn gmsh(fall: &[[usize; 2]], cells: &[usize]) -> String {
    let mut out =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n2 1 \"rock\"\n1 2 \"fall\"\n1 3 \"left\"\n\
                   1 4 \"right\"\n$EndPhysicalNames\n$Nodes\n25\n"
            .to_string();
    for n in 0..N * N {
        let _ = writeln!(out, "{} {} {} 0", n + 1, n % N, n / N);
    }
    let side = |x: usize| path(&(0..N).map(|y| [x, y]).collect::<Vec<_>>());
    let groups = [(2, fall.to_vec()), (3, side(0)), (4, side(N - 1))];
    let edges = groups
        .iter()
        .flat_map(|(group, edges)| edges.iter().map(move |[a, b]| format!("1 2 {group} {group} {a} {b}")));
    let squares = cells.iter().map(|c| {
        let n = c % (N - 1) + c / (N - 1) * N + 1;
        format!("3 2 1 1 {n} {} {} {}", n + 1, n + N + 1, n + N)
    });
    let all: Vec<String> = edges.chain(squares).collect();
    let _ = writeln!(out, "$EndNodes\n$Elements\n{}", all.len());
    all.iter().enumerate().for_each(|(k, line)| out += &format!("{} {line}\n", k + 1));
    out + "$EndElements\n"
}

/// The same geometry in files of several orders.
fn orders(fall: &[[usize; 2]]) -> Vec<String> {
    let cells: Vec<usize> = (0..(N - 1) * (N - 1)).collect();
    let shuffled: Vec<usize> = cells.iter().map(|c| (c * 7 + 3) % cells.len()).collect();
    let reversed: Vec<[usize; 2]> = fall.iter().rev().map(|[a, b]| [*b, *a]).collect();
    let turned = |(k, [a, b]): (usize, &[usize; 2])| if k % 2 == 0 { [*a, *b] } else { [*b, *a] };
    let mixed: Vec<[usize; 2]> = fall.iter().enumerate().map(turned).collect();
    vec![gmsh(fall, &cells), gmsh(&reversed, &cells), gmsh(&mixed, &shuffled), gmsh(fall, &shuffled)]
}

/// Faults through cycles, a rupture, and contact: kinematics, surface, conditions of the sides left and right, stepper.
const KINDS: [[&str; 5]; 3] = [
    [
        "antiplane",
        "[faults.main]\nminus = \"B.fall.minus\"\nplus = \"B.fall.plus\"\nlaw = { kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.010, b = 0.015, l = \"40 cm\", v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\" }\nnormal = \"50 MPa\"\nunder_resolved = \"allow\"\nrate = 1e-9\ndamping = \"radiation\"\n",
        "z = 0",
        "z = { rate = 1e-9 }",
        "fault-ode",
    ],
    [
        "antiplane",
        "[faults.main]\nminus = \"B.fall.minus\"\nplus = \"B.fall.plus\"\nlaw = { kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.3, d_c = \"20 cm\" }\nnormal = \"50 MPa\"\nshear = \"31 MPa\"\nunder_resolved = \"allow\"\n[output]\nsampling = \"50 ms\"\n",
        "absorbing = true",
        "absorbing = true",
        "explicit",
    ],
    [
        "plane-strain",
        "[interfaces.main]\nslave = \"B.fall.minus\"\nmaster = \"B.fall.plus\"\nmeasure = \"node-to-point\"\nsliding = \"small\"\nenforcement = { kind = \"penalty\", normal = \"1e13 Pa/m\", tangential = \"1e13 Pa/m\" }\nlaw = { kind = \"coulomb\", mu = 0.5 }\n",
        "x = 0, y = 0",
        "x = { to = \"-1 mm\" }, y = 0",
        "implicit",
    ],
];

/// Lines that `asperity check` prints, and its refusal, of a scene of one kind with a split mesh.
fn checked([kinematics, surface, left, right, stepper]: [&str; 5], mesh: &str, more: &str) -> [String; 2] {
    let scene = format!(
        "schema = 1\ntitle = \"split\"\nkinematics = \"{kinematics}\"\n[materials.rock]\nyoung = \"80 GPa\"\npoisson = 0.25\ndensity = 2670\n\
         [bodies.B]\nmaterial = \"rock\"\nmesh.gmsh = {{ file = \"m.msh\", unit = \"km\", split = [\"fall\"]{more} }}\n{surface}\
         [[stages]]\nname = \"s\"\nduration = \"1 s\"\nconditions = [{{ set = \"B.left\", {left} }}, {{ set = \"B.right\", {right} }}]\n\
         [time]\nstepper = \"{stepper}\"\n",
    );
    let here = tempfile::tempdir().unwrap();
    std::fs::write(here.path().join("m.msh"), mesh).unwrap();
    std::fs::write(here.path().join("scene.toml"), scene).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    let output = command.current_dir(here.path()).args(["check", "scene.toml"]).output().unwrap();
    [text(&output.stdout), told(&output)]
}

#[test]
fn the_plus_side_is_that_of_larger_x_or_y_whatever_the_order_of_the_file_in_every_kind_of_run() {
    let upright = path(&[[2, 0], [2, 1], [2, 2], [2, 3], [2, 4]]);
    let level = path(&[[1, 2], [2, 2], [3, 2]]);
    for kind in KINDS {
        for (fall, normal) in [(&upright, "(1.0000, 0.0000)"), (&level, "(0.0000, 1.0000)")] {
            let note = format!(
                "the mean normal of `B.fall` from its minus to its plus side is {normal}: the side of"
            );
            for mesh in orders(fall) {
                let [printed, refused] = checked(kind, &mesh, "");
                assert!(printed.contains(&note), "{kind:?}\n{printed}\n{refused}");
            }
        }
        let [printed, refused] = checked(
            kind,
            &gmsh(&upright, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]),
            ", plus.fall = [-1, 0.3]",
        );
        assert!(
            printed.contains("plus side is (-1.0000, 0.0000): as `plus` says"),
            "{kind:?}\n{printed}\n{refused}"
        );
    }
}

#[test]
fn parts_of_one_fault_that_disagree_are_refused_unless_a_direction_is_given() {
    let parts = [path(&[[1, 3], [2, 3], [3, 3], [3, 2]]), path(&[[1, 1], [2, 1], [2, 2]])].concat();
    for mesh in orders(&parts) {
        let [_, refused] = checked(KINDS[0], &mesh, "");
        assert!(refused.contains("do not agree on a plus side"), "{refused}");
        let [printed, refused] = checked(KINDS[0], &mesh, ", plus.fall = [0, 1]");
        assert!(printed.contains("plus side is (0.0000, 0.6000): as `plus` says"), "{printed}\n{refused}");
    }
    let [_, refused] = checked(KINDS[0], &orders(&parts)[0], ", plus.fal = [0, 1]");
    assert!(refused.contains("`fal`, along which the body is not split"), "{refused}");
}
