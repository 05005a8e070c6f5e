//! Extreme meshes, ties, and changes that must not affect results: units, node numbers, the order of bodies.

use super::contact_hard::scenes::{HardContactRun, Pair, block};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use asperity_vary::SceneText;
use std::fmt::Write;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_extremes",
    readme: include_str!("README.md"),
    covers: &[Capability::ContactInvariance],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    invariance(ledger)?;
    exchange(ledger)?;
    meshes(ledger)?;
    along_an_edge(ledger)
}

/// A block pressed on another and pushed over it with friction; lengths are scaled by `length`, stresses by `stress`.
fn pushed(measure: &'static str, length: f64, stress: f64) -> Pair {
    let l = |x: &[f64]| x.iter().map(|v| v * length).collect::<Vec<f64>>();
    let mut pair = Pair::new(
        block(&l(&[-0.5, -1.0]), &l(&[1.5, 0.0]), &[13, 6]),
        block(&l(&[0.0, 0.0]), &l(&[1.0, 0.5]), &[8, 4]),
        &[
            &format!(
                "{{ set = \"lower.bottom\", x = 0, y = 0 }}, {{ set = \"upper.top\", x = 0, y = {{ to = {:?} }} }}",
                -1e-3 * length
            ),
            &format!("{{ set = \"upper.top\", x = {{ to = {:?} }} }}", 0.2 * length),
        ],
    );
    (pair.measure, pair.mu, pair.elastic, pair.steps) = (measure, Some(0.3), (1e9 * stress, 0.3), None);
    pair
}

const MEASURES: [&str; 2] = ["node-to-point", "mortar"];

fn same(
    ledger: &mut Ledger,
    what: &str,
    one: &HardContactRun,
    (setting, other): (&str, &[f64]),
    why: &str,
) -> Result<(), CaseError> {
    ledger
        .claim(format!("normal tractions, {what}"))
        .unit("Pa")
        .values(other)
        .equals_each(&one.end()?.normal_traction)
        .between(setting, &one.scene)
        .relative(1e-9)
        .evidence(Evidence::Exact, "the problem is the same")
        .because(format!(
            "{why}; iterations end at 1e-11 of the largest force, and some tens of steps carry that on"
        ))
        .why_not_tighter("rounding of positions times the penalty is 1e-11 to 1e-10 of the tractions")
        .covers(&[Capability::ContactInvariance])
        .cost(&one.cost)
        .record();
    Ok(())
}

fn invariance(ledger: &mut Ledger) -> Result<(), CaseError> {
    for measure in MEASURES {
        let si = pushed(measure, 1.0, 1.0).run()?;
        let svg = body_plots::recorded(&si.record, "")?;
        ledger.picture(
            format!("Blocks pushed together, {measure}"),
            svg,
            "Mises stress after the first stage.",
        );
        let mm = pushed(measure, 1e3, 1e-6).run()?;
        let pascal: Vec<f64> = mm.end()?.normal_traction.iter().map(|t| t * 1e6).collect();
        same(
            ledger,
            &format!("mm and MPa against m and Pa, {measure}"),
            &si,
            (&mm.scene, &pascal),
            "numbers differ by factors",
        )?;
        ledger
            .claim(format!("Newton iterations in mm and MPa over those in m and Pa, {measure}"))
            .value(mm.report.counts.operations.iterations as f64 / si.report.counts.operations.iterations as f64)
            .equals(1.0)
            .absolute(0.05)
            .evidence(Evidence::Exact, "the problem is the same")
            .because("factors of a thousand are no powers of two: a residual next to its bound may fall on either side of it")
            .why_not_tighter("one iteration in a hundred may differ for rounding")
            .covers(&[Capability::ContactInvariance])
            .record();
        let renamed = SceneText::new(&si.scene)
            .renamed("bodies.lower", "x_lower")
            .with("interfaces.contact.master", "x_lower.top")
            .with("stages[0].conditions[0].set", "x_lower.bottom");
        let swapped = HardContactRun::from_text(&renamed.text()?)?;
        same(
            ledger,
            &format!("bodies in the other order, {measure}"),
            &si,
            (&swapped.scene, &swapped.end()?.normal_traction),
            "only sums change their order",
        )?;
    }
    let blocks = pushed("node-to-point", 1.0, 1.0).run()?;
    let (setting, filed, order) = renumbered(&pushed("node-to-point", 1.0, 1.0))?;
    let fields = filed.stage_ends().last().ok_or("no stage was completed")?;
    let sorted: Vec<f64> = order.iter().map(|&k| fields.interfaces[0].normal_traction[k]).collect();
    same(
        ledger,
        "nodes and cells of a mesh file in another order",
        &blocks,
        (&setting, &sorted),
        "only sums change their order",
    )
}

/// Runs a scene with the upper block from a mesh file whose nodes and cells are shuffled. Returns the scene, the record and the slave
/// nodes from left to right.
fn renumbered(pair: &Pair) -> Result<(String, Recorder, Vec<usize>), CaseError> {
    let (nx, ny) = (8, 4);
    let number = |i: usize, j: usize| (j * (nx + 1) + i) * 17 % ((nx + 1) * (ny + 1)) + 1;
    let mut nodes = vec![String::new(); (nx + 1) * (ny + 1)];
    for j in 0..=ny {
        for i in 0..=nx {
            let (x, y) = (i as f64 / nx as f64, 0.5 * j as f64 / ny as f64);
            nodes[number(i, j) - 1] = format!("{} {x:?} {y:?} 0\n", number(i, j));
        }
    }
    let mut cells = Vec::new();
    for i in 0..nx {
        cells.push(format!("1 2 1 1 {} {}\n", number(i, 0), number(i + 1, 0)));
        cells.push(format!("1 2 2 2 {} {}\n", number(i + 1, ny), number(i, ny)));
        for j in 0..ny {
            let corners = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
            cells.push(format!("3 2 3 3 {} {} {} {}\n", corners[0], corners[1], corners[2], corners[3]));
        }
    }
    cells.reverse();
    let mut text = String::from(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"bottom\"\n1 2 \"top\"\n2 3 \"block\"\n$EndPhysicalNames\n",
    );
    write!(text, "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n", nodes.len(), nodes.concat(), cells.len())?;
    for (k, cell) in cells.iter().enumerate() {
        write!(text, "{} {cell}", k + 1)?;
    }
    text += "$EndElements\n";
    let folder = std::env::temp_dir().join(format!("asperity-contact-extremes-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("upper.msh"), text)?;
    let mut pair = pair.clone();
    pair.meshes[1] = "mesh.gmsh = { file = \"upper.msh\" }".into();
    let mut scene = scene::read(&pair.text()).map_err(|e| e.to_string())?;
    scene.folder.clone_from(&folder);
    let plan = bodies::plan(&scene).map_err(|e| e.to_string());
    std::fs::remove_dir_all(&folder)?;
    let mut record = Recorder::new();
    kinds::bodies::run(&plan?, &mut record)?;
    let positions = &record.setup().interfaces[0].positions;
    let mut order: Vec<usize> = (0..positions.len()).collect();
    order.sort_by(|a, b| positions[*a][0].total_cmp(&positions[*b][0]));
    Ok((pair.text(), record, order))
}

/// Exchange of slave and master, and a mirror image, on matching meshes: every slave node lies on a vertex of the master.
fn exchange(ledger: &mut Ledger) -> Result<(), CaseError> {
    for measure in MEASURES {
        let press =
            "{ set = \"lower.bottom\", x = 0, y = 0 }, { set = \"upper.top\", x = 0, y = { to = -0.01 } }";
        let mut pair = Pair::new(
            block(&[0.0, -1.0], &[1.0, 0.0], &[8, 8]),
            block(&[0.0, 0.0], &[1.0, 0.5], &[8, 4]),
            &[press],
        );
        (pair.measure, pair.sliding) = (measure, "small");
        let one = pair.run()?;
        let mirrored: Vec<f64> = one.end()?.normal_traction.iter().rev().copied().collect();
        // The same run, read in reverse order.
        let read = ("from the right", mirrored.as_slice());
        same(ledger, &format!("read from the right, {measure}"), &one, read, "the scene is symmetric")?;
        pair.sets.reverse();
        let other = pair.run()?;
        same(
            ledger,
            &format!("slave and master exchanged, {measure}"),
            &one,
            (&other.scene, &other.end()?.normal_traction),
            "node meets node with the same area",
        )?;
        (pair.sliding, pair.mu) = ("finite", Some(0.2));
        pair.sets.reverse();
        let one = pair.run()?;
        let mirrored: Vec<f64> = one.end()?.normal_traction.iter().rev().copied().collect();
        ledger
            .claim(format!("normal tractions read from the right, nodes on vertices, finite sliding with friction, {measure}"))
            .unit("Pa")
            .values(&mirrored)
            .equals_each(&one.end()?.normal_traction)
            .relative(if measure == "mortar" { 1e-9 } else { 1e-5 })
            .evidence(Evidence::Exact, "the scene is symmetric")
            .because(
                "mortar averages the normals at a node; a node on a vertex of a node-to-point master takes that of one of the two \
                 segments, 3e-3 apart here, and pressures feel the square of half of it",
            )
            .why_not_tighter("which segment holds a node on a vertex is left to the order of the segments")
            .covers(&[Capability::ContactInvariance])
            .cost(&one.cost)
            .record();
    }
    Ok(())
}

/// Uniform pressure across a hundred elements against one, and across elements a thousand times as long as thick.
fn meshes(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (measure, lower, upper, named) in [
        ("node-to-point", [1, 2], [100, 2], "a hundred slave elements on one"),
        ("mortar", [1, 2], [100, 2], "a hundred slave elements on one"),
        ("mortar", [100, 2], [1, 2], "one slave element on a hundred"),
        ("node-to-point", [2, 500], [2, 500], "elements 1:250 along the interface"),
        ("mortar", [3, 500], [2, 500], "elements 1:250 along the interface that do not match"),
        ("node-to-point", [2, 1000], [2, 1000], "elements 1:500"),
        ("mortar", [100, 1], [200, 1], "elements 100:1 and 200:1 across the interface"),
    ] {
        for sliding in ["small", "finite"] {
            let press = "{ set = \"lower.bottom\", x = 0, y = 0 }, { set = \"upper.top\", x = 0, y = { to = -0.01 } }";
            let mut pair = Pair::new(
                block(&[0.0, -1.0], &[1.0, 0.0], &lower),
                block(&[0.0, 0.0], &[1.0, 1.0], &upper),
                &[press],
            );
            (pair.measure, pair.sliding, pair.elastic) = (measure, sliding, (1e9, 0.0));
            pair.penalty = "1e11".into();
            let done = pair.run()?;
            let end = done.end()?;
            ledger
                .claim(format!("pressure at every slave node, {named}, {measure}, {sliding} sliding"))
                .unit("Pa")
                .values(&end.normal_traction)
                .equals_each(&vec![0.01 / (2.0 / 1e9 + 1.0 / 1e11); end.gap.len()])
                .relative(1e-8)
                .evidence(Evidence::Exact, "columns and penalty spring in series, without Poisson's effect")
                .because("rounding of positions times the penalty, and of thin elements' stiffness, 1000 times that of a column")
                .why_not_tighter("the condition of a stack of a thousand thin elements is 1e6 to 1e7, a tenth of which is seen")
                .covers(&[Capability::ContactInvariance])
                .cost(&done.cost)
                .record();
        }
    }
    Ok(())
}

/// Slave nodes that slide over vertices along edges shared by two master faces.
fn along_an_edge(ledger: &mut Ledger) -> Result<(), CaseError> {
    for measure in MEASURES {
        let mut pair = Pair::new(
            block(&[0.0, -1.0, 0.0], &[2.0, 0.0, 2.0], &[8, 2, 4]),
            block(&[0.25, 0.0, 0.5], &[0.75, 0.5, 1.5], &[2, 2, 2]),
            &[
                "{ set = \"lower.bottom\", x = 0, y = 0, z = 0 }, { set = \"upper.top\", x = 0, y = { to = -1e-3 }, z = 0 }",
                "{ set = \"upper.top\", x = { to = 0.8 } }",
            ],
        );
        (pair.kinematics, pair.measure, pair.mu, pair.steps) = ("3d", measure, Some(0.3), Some(8));
        let done = pair.run()?;
        done.end()?;
        let force = &done.report.balance[0].slave_force;
        ledger
            .claim(format!("lateral force over normal force, nodes sliding along edges, {measure}"))
            .value((force[2] / force[1]).abs())
            .at_most(if measure == "mortar" { 1e-9 } else { 5e-4 })
            .evidence(Evidence::Exact, "the scene is symmetric about the plane of the motion")
            .because(
                "mortar averages the normals at a node; a node on an edge of a node-to-point master takes that of one of the two \
                 faces, half a kink of 1e-3 from the mean",
            )
            .why_not_tighter("not all nodes need be on the same side, and most kinks are smaller")
            .covers(&[Capability::ContactInvariance])
            .cost(&done.cost)
            .record();
        ledger
            .claim(format!("friction over normal force, nodes sliding along edges and over vertices, {measure}"))
            .value(force[0].abs() / force[1].abs())
            .equals(0.3)
            .absolute(0.01)
            .evidence(Evidence::Exact, "Coulomb's law where all points slip")
            .because("the block's edges dig in by 1e-3 of its size and turn the forces there by as much, times three for the edges' share")
            .why_not_tighter("the deformed surface is not flat")
            .covers(&[Capability::ContactInvariance, Capability::Coulomb])
            .record();
    }
    Ok(())
}
