//! Quadratic convergence of Newton's method, which needs the exact tangent.

use super::texts::{BodyRun, simulate};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_output::bodies::view::StepRecord;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "newton_convergence",
    readme: include_str!("README.md"),
    covers: &[Capability::Tangents, Capability::Implicit],
    quick: true,
    run,
};

/// Residual below which an iteration is near the solution.
const NEAR: f64 = 0.1;
/// Residual below which rounding may affect it.
const ROUNDING: f64 = 1e-12;

/// A scene and the bound on the constant of its quadratic convergence.
struct Nonlinear {
    name: &'static str,
    scene: SceneText,
    bound: f64,
    because: &'static str,
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    for case in scenes() {
        let done = simulate(&case.scene.clone().text()?)?;
        let mut constants: Vec<f64> = done.report.steps.iter().filter_map(constant).collect();
        constants.sort_by(f64::total_cmp);
        let median = constants.get(constants.len() / 2).copied().unwrap_or(f64::NAN);
        claims(ledger, &case, median, constants.len(), &done);
        let largest = constants.last().copied().unwrap_or(f64::NAN);
        rows.push([
            case.name.to_owned(),
            format!("{median:.1e}"),
            format!("{largest:.1e}"),
            constants.len().to_string(),
        ]);
    }
    ledger.table("Residual over the square of that before", &["problem", "median", "largest", "steps"], rows);
    Ok(())
}

/// Residual over the square of the previous one, for the last iteration of a step that is near the solution and above
/// rounding.
fn constant(step: &StepRecord) -> Option<f64> {
    let pairs = step.residuals.iter().zip(step.residuals.iter().skip(1));
    pairs
        .filter(|(before, after)| **before < NEAR && **after > ROUNDING)
        .map(|(before, after)| after / before.powi(2))
        .next_back()
}

fn claims(ledger: &mut Ledger, case: &Nonlinear, median: f64, steps: usize, done: &BodyRun) {
    ledger
        .claim(format!("{}: residual over the square of that before", case.name))
        .norm("median over the steps, of the last iteration above rounding")
        .value(median)
        .at_most(case.bound)
        .evidence(Evidence::Exact, "Newton's method is of second order with the exact derivative, and of first order otherwise")
        .because(case.because)
        .why_not_tighter("convergence of first order by a factor of 1e-3 an iteration gives 1e3 at a residual of 1e-6, and more below")
        .cost(&done.cost)
        .record();
    ledger
        .claim(format!("{}: steps with such an iteration", case.name))
        .value(steps as f64)
        .at_least(3.0)
        .evidence(Evidence::Exact, "a step that is nonlinear takes several iterations")
        .because("a median wants some values")
        .why_not_tighter("their number depends on the lengths of steps")
        .cost(&done.cost)
        .record();
}

/// Reason for the bound where strains and gaps are geometrically nonlinear.
const GEOMETRY: &str = "the second derivative of the forces, times a displacement of the size of a cell, is of the size of the forces";
/// Reason for the bound under rate-dependent friction.
const RATE: &str = "friction changes e-fold over a/F of its size, here 1/60, so that its second derivative over its first is 60 times larger";

fn scenes() -> Vec<Nonlinear> {
    let geometric = |name, scene| Nonlinear { name, scene, bound: 1.0, because: GEOMETRY };
    vec![
        geometric("mortar, finite sliding", ironing()),
        geometric("mortar, finite strain", finite(soft(ironing()))),
        geometric("points on facets", points(soft(ironing()))),
        geometric("points on curved faces", curved(points(soft(ironing())))),
        geometric(
            "points on a smoothed surface",
            points(soft(ironing())).add("interfaces.contact.smoothing", "cubic"),
        ),
        geometric("points in space", in_space()),
        geometric("mortar in space", in_space().with("interfaces.contact.measure", "mortar")),
        geometric("plastic cylinder", cylinder()),
        geometric(
            "plastic cylinder, finite strain",
            cylinder()
                .add("bodies.wall.strain", "finite")
                .with("stages[0].conditions[2].pressure.to", "150 MPa"),
        ),
        Nonlinear { name: "friction of rate", scene: sandwich(), bound: 600.0, because: RATE },
    ]
}

/// A die dragged over a slab in steps longer than a cell.
fn ironing() -> SceneText {
    SceneText::new(include_str!("../../../scenes/ironing.toml"))
        .with("bodies.slab.mesh.block.divisions", "[36, 5]")
        .with("bodies.die.mesh.block.divisions", "[8, 4]")
        .with("stages[0].steps", 2)
        .with("stages[1].steps", 12)
}

/// The scene with penalties so low that gaps are large.
fn soft(scene: SceneText) -> SceneText {
    scene.with(
        "interfaces.contact.enforcement",
        r#"{ kind = "penalty", normal = "1 E/h", tangential = "1 E/h" }"#,
    )
}

fn points(scene: SceneText) -> SceneText {
    scene.with("interfaces.contact.measure", "node-to-point")
}

fn curved(scene: SceneText) -> SceneText {
    scene.with("bodies.die.mesh.block.divisions", "[4, 2]").with("bodies.die.mesh.block.element", "quad9")
}

fn finite(scene: SceneText) -> SceneText {
    scene.add("bodies.slab.strain", "finite").add("bodies.die.strain", "finite")
}

fn cylinder() -> SceneText {
    SceneText::new(include_str!("../../../scenes/cylinder.toml"))
}

/// Steps take 10 ms and more; where iterations fail, the run stops instead of taking a hundred thousand steps.
fn sandwich() -> SceneText {
    SceneText::new(include_str!("../../../scenes/sandwich.toml"))
        .with("bodies.A.mesh.block.size", "5 mm")
        .with("bodies.B.mesh.block.size", "5 mm")
        .add("time.min_step", "1 ms")
}

fn in_space() -> SceneText {
    SceneText::new(include_str!("space.toml"))
}
