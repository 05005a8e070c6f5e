//! A rigid flat punch on a half-plane: pressure away from its edges.

use super::hertz::{self, Tractions};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_plan::reading::scene::model::{Measure, Scene, Sliding};
use asperity_vary::SceneText;
use std::f64::consts::PI;

/// See the README.
pub const CASE: Case = Case {
    name: "flat_punch",
    readme: include_str!("README.md"),
    covers: &[Capability::Mortar, Capability::PenaltyContact2d],
    quick: true,
    run,
};

/// Half-width \[m\].
const A: f64 = 1e-3;
/// Fraction of the half-width over which pressures are compared.
const INNER: f64 = 0.8;
/// Cells per half-width of the scene.
const N: f64 = 20.0;
const EXACT: &str = "P/(pi sqrt(a^2 - x^2)), a rigid punch on a half-plane (Sadowsky)";

const MEASURES: [(&str, Measure, Capability); 2] = [
    ("mortar", Measure::Mortar, Capability::Mortar),
    ("node-to-point", Measure::NodeToPoint, Capability::PenaltyContact2d),
];

fn scene(text: &str, measure: Measure, n: f64) -> Result<Scene, CaseError> {
    Ok(hertz::refined(hertz::measured(hertz::read(text)?, measure, Sliding::Small), n / N))
}

/// Relative L2 error of the averaged pressure within the inner part, at the load of the run.
fn error(at: &Tractions) -> f64 {
    // The scene models half of the punch.
    let load = 2.0 * at.load[1];
    let (mut error, mut norm) = (0.0, 0.0);
    for ((x, area), p) in at.x.iter().zip(&at.area).zip(&at.p).filter(|((x, _), _)| **x <= INNER * A) {
        let exact = load / (PI * (A * A - x * x).sqrt());
        error += area * (p - exact).powi(2);
        norm += area * exact * exact;
    }
    (error / norm).sqrt()
}

fn solve(scene: &Scene) -> Result<(f64, Cost), CaseError> {
    let done = hertz::simulate(scene)?;
    Ok((error(&done.tractions("press")?), done.cost))
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let uniform = include_str!("scene.toml");
    // Cells eight times smaller near the edge.
    let edge = |axis: usize, body: &str, from: &str, to: &str| {
        let spacing = |key: &str| format!("bodies.{body}.mesh.block.spacing[{axis}].{key}");
        [("size", "0.00625 mm"), ("from", from), ("to", to)]
            .map(|(key, value)| (spacing(key), value.to_owned()))
    };
    let finer = [
        edge(0, "ground", "0.9 mm", "1.1 mm"),
        edge(1, "ground", "-0.1 mm", "0 mm"),
        edge(0, "punch", "0.9 mm", "1 mm"),
        edge(1, "punch", "0 mm", "0.1 mm"),
    ];
    let graded = finer.iter().flatten().fold(SceneText::new(uniform), |scene, (key, value)| {
        // One end of some parts does not change.
        scene.with_or_same(key, value)
    });
    let graded = graded.text()?;
    for (name, measure, capability) in MEASURES {
        let mut levels = Vec::new();
        let mut last = None;
        // With 10 cells the last node compared lies two cells from the edge, where the error has not reached its asymptotic order.
        for n in [20.0, 40.0, 80.0] {
            let (error, cost) = solve(&scene(uniform, measure, n)?)?;
            levels.push((A / n, error));
            last = Some(cost);
        }
        let cost = last.ok_or("no level")?;
        ledger
            .order(format!("pressure in L2 over |x| <= 0.8 a, {name}, uniform cells"))
            .levels(&levels)
            .expected(1.0)
            .within(0.15)
            .evidence(Evidence::Exact, EXACT)
            .because("the square root at the edge, which moves the edge by a part of a cell")
            .finest(0.5 / 80.0, "half a cell over the half-width")
            .covers(&[capability])
            .cost(&cost)
            .record();
        let (error, cost) = solve(&scene(&graded, measure, N)?)?;
        ledger
            .claim(format!("pressure in L2 over |x| <= 0.8 a, relative error, {name}, cells of a/160 at the edge"))
            .value(error)
            .at_most(0.5 / 160.0)
            .evidence(Evidence::Exact, EXACT)
            .because("half a cell at the edge over the half-width; the penalty of 100 E/h moves the ground by a hundredth of a cell")
            .covers(&[capability])
            .cost(&cost)
            .record();
    }
    Ok(())
}
