//! A round block dragged over a flat one: oscillation of friction from facets and its decay with facet size.

use super::texts::simulate;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_facets",
    readme: include_str!("README.md"),
    covers: &[
        Capability::PenaltyContact3d,
        Capability::Coulomb,
        Capability::Mortar,
        Capability::QuadraticSolids,
    ],
    quick: false,
    run,
};

/// Cells across the round block.
const CELLS: [usize; 3] = [6, 9, 12];
/// Number of cells at which the contact measures are compared.
const COMPARED: usize = 9;
const MORTAR: Change<'_> = With("interfaces.contact.measure", "mortar");
const TETRAHEDRA: [Change<'_>; 2] =
    [With("bodies.flat.mesh.block.element", "tet4"), With("bodies.round.mesh.block.element", "tet4")];
const QUADRATIC: [Change<'_>; 3] = [
    MORTAR,
    With("bodies.flat.mesh.block.element", "tet10"),
    With("bodies.round.mesh.block.element", "tet10"),
];
/// Cells across the round block of tetrahedra of ten nodes.
const QUADRATIC_CELLS: [usize; 2] = [6, 9];
const ANGLE: f64 = 25.0;
const MU: f64 = 0.3;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    let mut levels = Vec::new();
    let mut plain = None;
    for cells in CELLS {
        let way = Way::new(cells, &[])?;
        rows.push(way.row("node-to-point", cells));
        levels.push((1.0 / cells as f64, way.swing()));
        if cells == COMPARED {
            plain = Some(way);
        }
    }
    let mut tetrahedra = Vec::new();
    for cells in CELLS {
        let way = Way::new(cells, &TETRAHEDRA)?;
        rows.push(way.row("node-to-point, tet4", cells));
        tetrahedra.push((1.0 / cells as f64, way.swing()));
    }
    ledger
        .order("distance of friction from its mean along the way over mu N, root of the mean square, node-to-point, faces of tetrahedra")
        .levels(&tetrahedra)
        .expected(1.0)
        .within(0.4)
        .or_better()
        .finest(0.06, "kinks of 2 h/R = 0.16 between triangles, which are flat, shared by a dozen nodes without common sign")
        .because("neighbouring triangles of the dent differ in direction by h/R, with them forces of nodes that pass from one to the next")
        .why_not_tighter("the way starts and ends anywhere among the cells, and the number of nodes in contact changes along it")
        .evidence(Evidence::Exact, "a steady motion over a homogeneous body: the continuum has none")
        .covers(&[Capability::PenaltyContact3d, Capability::Coulomb])
        .record();
    ledger
        .order("distance of friction from its mean along the way over mu N, root of the mean square, node-to-point")
        .levels(&levels)
        .expected(1.0)
        .within(0.4)
        .or_better()
        .finest(0.03, "kinks of h/R = 0.08 between facets, shared by a dozen nodes without common sign")
        .because("neighbouring facets of the dent differ in direction by h/R, and with them the forces of nodes that pass from one to the next")
        .why_not_tighter("the way starts and ends anywhere among the cells, and the number of nodes in contact changes along it")
        .evidence(Evidence::Exact, "a steady motion over a homogeneous body: the continuum has none")
        .covers(&[Capability::PenaltyContact3d, Capability::Coulomb])
        .record();
    let plain = plain.ok_or("nothing to compare with")?;
    let smoothed = Way::new(COMPARED, &[Add("interfaces.contact.smoothing", "cubic")])?;
    ledger
        .claim("distance of friction from its mean along the way, smoothed faces over plain ones on the same mesh")
        .value(smoothed.swing() / plain.swing())
        .at_most(0.5)
        .evidence(Evidence::ConvergedSelf, "both vanish in the continuum")
        .because("normals that do not jump leave the chord error of faces, of second order in h, instead of the kinks")
        .why_not_tighter("nodes that enter and leave the contact remain")
        .covers(&[Capability::PenaltyContact3d, Capability::Coulomb])
        .cost(&smoothed.cost)
        .record();
    rows.push(smoothed.row("smoothed", COMPARED));
    rows.push(Way::new(COMPARED, &[MORTAR])?.row("mortar", COMPARED));
    let both = [&[MORTAR][..], &TETRAHEDRA].concat();
    rows.push(Way::new(COMPARED, &both)?.row("mortar, tet4", COMPARED));
    rows.extend(quadratic(ledger)?);
    let head = [
        "measure",
        "cells",
        "across [% of mu N]",
        "pulse [% of mu N]",
        "T/(mu N)",
        "N [MN]",
        "range of N [%]",
        "iterations",
        "wall [s]",
    ];
    ledger.table("friction of a round block dragged at 25 degrees", &head, rows);
    Ok(())
}

/// Mortar contact of tetrahedra of ten nodes. Returns the rows of its runs.
fn quadratic(ledger: &mut Ledger) -> Result<Vec<[String; 9]>, CaseError> {
    let mut ways = Vec::new();
    for cells in QUADRATIC_CELLS {
        ways.push((cells, Way::new(cells, &QUADRATIC)?));
    }
    let covers = [Capability::Mortar, Capability::Coulomb, Capability::QuadraticSolids];
    let steady = "a steady motion over a homogeneous body: the continuum has none";
    if let Some((_, finest)) = ways.last() {
        ledger
            .claim("distance of friction from its mean along the way over mu N, root of the mean square, mortar, tet10")
            .value(finest.swing())
            .at_most(4e-3)
            .evidence(Evidence::Exact, steady)
            .because("slopes of quadratic faces jump by (h/R)^2/6 = 0.2 % from one to the next")
            .why_not_tighter("the way starts and ends anywhere among the cells")
            .covers(&covers)
            .cost(&finest.cost)
            .record();
        ledger
            .claim("largest less smallest normal force along the way over its mean, mortar, tet10")
            .value(finest.range)
            .at_most(0.01)
            .evidence(Evidence::Exact, steady)
            .because("nodes that enter and leave the contact bear little, and averages see them come")
            .covers(&covers)
            .cost(&finest.cost)
            .record();
    }
    Ok(ways.iter().map(|(cells, way)| way.row("mortar, tet10", *cells)).collect())
}

/// Statistics of the force during sliding.
struct Way {
    /// Root mean square of friction across the sliding direction, over mu N.
    across: f64,
    /// Root mean square deviation of friction along the sliding direction from its mean, over mu N.
    pulse: f64,
    /// Mean friction along the sliding direction, over mu N.
    ratio: f64,
    /// Mean normal force \[N\].
    normal: f64,
    /// Its largest less its smallest value, over the mean.
    range: f64,
    cost: Cost,
    iterations: usize,
}

impl Way {
    fn new(cells: usize, changes: &[Change<'_>]) -> Result<Self, CaseError> {
        let flat = format!("[{}, {}, {}]", 3 * cells / 2, cells / 3, 3 * cells / 2);
        let round = format!("[{cells}, {}, {cells}]", cells / 2);
        let scene = SceneText::new(include_str!("scene.toml"))
            .with_or_same("bodies.flat.mesh.block.divisions", flat)
            .with_or_same("bodies.round.mesh.block.divisions", round)
            .changed(changes);
        let done = simulate(&scene.text()?)?;
        let (s, c) = ANGLE.to_radians().sin_cos();
        let (mut along, mut across, mut normal) = (Vec::new(), Vec::new(), Vec::new());
        for (time, sample) in done.record.times().iter().zip(done.record.samples()) {
            if *time > 2.0 {
                let force = sample.forces[0];
                let bound = MU * -force[1];
                along.push((c * force[0] + s * force[2]) / bound);
                across.push((c * force[2] - s * force[0]) / bound);
                normal.push(-force[1]);
            }
        }
        let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
        let size = |v: &[f64], about: f64| {
            (v.iter().map(|v| (v - about).powi(2)).sum::<f64>() / v.len() as f64).sqrt()
        };
        let ratio = mean(&along);
        let ends =
            |v: &[f64]| v.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
        let [least, most] = ends(&normal);
        Ok(Self {
            across: size(&across, 0.0),
            pulse: size(&along, ratio),
            ratio,
            normal: mean(&normal),
            range: (most - least) / mean(&normal),
            cost: done.cost,
            iterations: done.report.counts.operations.iterations,
        })
    }

    /// Root mean square deviation of friction along the sliding direction, over mu N.
    fn swing(&self) -> f64 {
        self.across.hypot(self.pulse)
    }

    fn row(&self, measure: &str, cells: usize) -> [String; 9] {
        [
            measure.to_owned(),
            format!("{cells}"),
            format!("{:.2}", 100.0 * self.across),
            format!("{:.2}", 100.0 * self.pulse),
            format!("{:.4}", self.ratio),
            format!("{:.3}", self.normal * 1e-6),
            format!("{:.2}", 100.0 * self.range),
            format!("{}", self.iterations),
            format!("{:.1}", self.cost.wall.unwrap_or(f64::NAN)),
        ]
    }
}
