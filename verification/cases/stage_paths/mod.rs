//! Loads and motions that carry over from stage to stage, and the forces and stresses that a run reports.

mod noisy;

use super::texts;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_vary::Change::{self, With};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "stage_paths",
    readme: include_str!("README.md"),
    covers: &[Capability::Stages, Capability::Loads, Capability::Outputs],
    quick: true,
    run,
};

/// P-wave modulus, E (1 - ν)/((1 + ν)(1 - 2 ν)) \[Pa\].
const MODULUS: f64 = 10e9 * 0.75 / (1.25 * 0.5);
/// Length of the bar \[m\]; its height is 1 m.
const LENGTH: f64 = 2.0;
/// Tractions of the first four stages at the ends of their steps \[MPa\].
const TRACTIONS: [f64; 9] = [1.0, 2.0, 2.5, 3.0, 2.0, 1.0, 2.5, 4.0, 4.0];
/// Displacements of the moved side at the ends of the steps of the next four stages \[mm\], the first two from where it was.
const MOVED: [f64; 9] = [1.0, 2.0, f64::NAN, 5.0, 5.0, 3.0, 1.0, 1.5, 2.0];
/// Bound on ratios: rounding of a dozen unknowns, or the 1e-11 at which the balance of forces ends.
const ROUNDING: f64 = 1e-10;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    stages(ledger, "implicit", &[])?;
    stages(ledger, "static-explicit", &[With("time.stepper", "static-explicit")])?;
    springs(ledger, "implicit")?;
    springs(ledger, "static-explicit")?;
    column(ledger)?;
    noisy::claims(ledger)
}

/// Displacements of the drawn side at the ends of all steps \[m\].
fn path() -> Vec<f64> {
    let drawn = |traction: f64| traction * 1e6 * LENGTH / MODULUS;
    let mut path = TRACTIONS.map(drawn).to_vec();
    let start = drawn(TRACTIONS[TRACTIONS.len() - 1]);
    path.extend(MOVED.iter().enumerate().map(|(k, mm)| match k {
        0 | 1 => start + 1e-3 * mm,
        2 => 0.5 * (start + 2e-3 + 5e-3),
        _ => 1e-3 * mm,
    }));
    path.push(start);
    path
}

fn stages(ledger: &mut Ledger, name: &str, changes: &[Change<'_>]) -> Result<(), CaseError> {
    let done = texts::simulate(&SceneText::new(include_str!("scene.toml")).changed(changes).text()?)?;
    let exact = path();
    let samples = done.record.samples();
    let found: Vec<f64> = samples.iter().map(|s| s.points[0].displacement[0]).collect();
    ledger
        .claim(format!("displacement of the drawn side at the end of each step, nine stages, {name} steps"))
        .unit("m")
        .values(&found)
        .equals_each(&exact)
        .relative(ROUNDING)
        .evidence(
            Evidence::Exact,
            "uniaxial strain: traction over modulus times length, or the motion prescribed",
        )
        .because("a uniform strain lies in the space of the cells; balance of forces to 1e-11")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .cost(&done.cost)
        .record();
    for (set, sign) in [("right", 1.0), ("left", -1.0)] {
        let forces: Vec<f64> = done.force(set)?.iter().map(|f| sign * f[0]).collect();
        ledger
            .claim(format!("force on the {set} side at the end of each step, nine stages, {name} steps"))
            .unit("N/m")
            .values(&forces)
            .equals_each(&exact.iter().map(|u| u * MODULUS / LENGTH).collect::<Vec<_>>())
            .relative(ROUNDING)
            .evidence(Evidence::Exact, "uniaxial strain: modulus times strain times height")
            .because("as for displacements; what drives the side, load or motion, is part of the force")
            .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
            .cost(&done.cost)
            .record();
    }
    energies(ledger, name, &exact, &done);
    Ok(())
}

/// Energies at the end. The traction acts on while the side is moved, and the release lets go what the motions have done.
fn energies(ledger: &mut Ledger, name: &str, path: &[f64], done: &texts::BodyRun) {
    let (stiffness, start, before) = (MODULUS / LENGTH, path[path.len() - 1], path[path.len() - 2]);
    let half = |u: f64| 0.5 * stiffness * u * u;
    let (stored, let_go) = (half(start), half(before - start));
    ledger
        .claim(format!("work of loads, elastic energy, work of motions and energy out of balance, nine stages, {name} steps"))
        .unit("J/m")
        .values(&["loads", "elastic", "motions", "unbalanced"].map(|part| done.report.energy.part(part)))
        .equals_each(&[stored, stored, let_go, let_go])
        .relative(10.0 * ROUNDING)
        .evidence(Evidence::Exact, "a spring k under the force k a, moved from a to b and released: k a²/2 is stored, k (b - a)²/2 lost")
        .because("forces are linear in every step, so that the trapezoidal rule is exact; ten times the rounding of single forces, since at 5 mm the bar stores ten times what is left")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .cost(&done.cost)
        .record();
}

/// Way by which the bar is stretched before a spring takes over \[m\], its stiffness \[N/m\], and the way of its load point in the last
/// stage \[m\].
const STRETCHED: f64 = 1e-3;
const SPRING: f64 = 2e9;
const DRAWN: f64 = 3e-3;

/// A spring takes over the force that held the bar, keeps it, and draws it on.
fn springs(ledger: &mut Ledger, stepper: &str) -> Result<(), CaseError> {
    let spring = |rate: f64| format!("{{ spring = {SPRING:?}, rate = {rate:?} }}");
    let scene = SceneText::new(include_str!("scene.toml"));
    let scene = (3..9).rev().fold(scene, |scene, k| scene.without(&format!("stages[{k}]")));
    let scene = scene
        .without("stages[0].conditions[3].traction")
        .add("stages[0].conditions[3].x", format!("{{ to = {STRETCHED:?} }}"))
        .without("stages[1].conditions[0].traction")
        .add("stages[1].conditions[0].x", spring(0.0))
        .without("stages[2].conditions[0].traction")
        .add("stages[2].conditions[0].x", spring(0.5 * DRAWN))
        .with_or_same("time.stepper", stepper);
    let done = texts::simulate(&scene.text()?)?;
    let springs = done.record.samples().iter().filter_map(|s| *s.springs.first()?);
    let found: Vec<f64> = springs.flat_map(|s| [s.force, s.load_point, s.displacement]).collect();
    // Two steps while the load point is at rest, and four while it is drawn.
    let bar = MODULUS / LENGTH;
    let exact: Vec<f64> = [0.0, 0.0, 0.25, 0.5, 0.75, 1.0]
        .into_iter()
        .flat_map(|share| {
            let drawn = share * DRAWN;
            let moved = drawn * SPRING / (bar + SPRING);
            [bar * (STRETCHED + moved), drawn, STRETCHED + moved]
        })
        .collect();
    if found.len() != exact.len() {
        return Err(format!("{} values of springs", found.len()).into());
    }
    ledger
        .claim(format!("spring that takes over the force that held a bar: force, way of its load point and of the bar at the end of each step, over those of the last, {stepper} steps"))
        .values(&found.iter().enumerate().map(|(k, v)| v / exact[15 + k % 3]).collect::<Vec<_>>())
        .equals_each(&exact.iter().enumerate().map(|(k, v)| v / exact[15 + k % 3]).collect::<Vec<_>>())
        .absolute(ROUNDING)
        .evidence(Evidence::Exact, "uniaxial strain: the force that held it stays, and bar and spring share the way that is drawn")
        .because("a uniform strain lies in the space of the cells; balance of forces to 1e-11")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Stresses at corners, on edges and within cells, and forces on sets that share nodes with loaded ones.
fn column(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = texts::simulate(include_str!("column.toml"))?;
    let sample = done.record.samples().last().ok_or("no step was taken")?;
    // The points in the order of their names: corner, edge, inside, top.
    let along = [0.0, 2.0, 4.7, 8.0].map(|y: f64| -1e6 - WEIGHT * (HEIGHT - y));
    let exact: Vec<f64> = along.iter().flat_map(|yy| [yy / 3.0, *yy]).collect();
    let found: Vec<f64> = sample.points.iter().flat_map(|p| [p.stress[0], p.stress[1]]).collect();
    let cost = &done.cost;
    compared(
        ledger,
        "stresses xx and yy at a corner, on an edge, within a cell and at the top",
        "Pa",
        (&found, &exact),
        cost,
    );
    let force =
        |name: &str| done.force(name)?.last().copied().ok_or_else(|| CaseError::from("no step was taken"));
    let (bottom, left, top) = (force("bottom")?, force("left")?, force("top")?);
    let across = HEIGHT * (1e6 + 0.5 * WEIGHT * HEIGHT) / 3.0;
    let found = [bottom[1], left[0], top[1]];
    let exact = [WIDTH * (1e6 + WEIGHT * HEIGHT), across, -1e6 * WIDTH];
    compared(
        ledger,
        "forces on the bottom, along y, the left side, along x, and the top",
        "N/m",
        (&found, &exact),
        cost,
    );
    // Loads on the top, and the weight, are not of the left side, although it shares nodes with them. The corner that it shares
    // with the bottom takes the reaction on its part of a cell of 1 m: a sixth, by Simpson's rule.
    let corner = (1e6 + WEIGHT * HEIGHT) / 6.0;
    compared(
        ledger,
        "force on the left side, along y, which is that on its lowest node",
        "N/m",
        (&[left[1]], &[corner]),
        cost,
    );
    Ok(())
}

/// ρ g \[N/m3\], height and width of the column \[m\].
const WEIGHT: f64 = 2.7e4;
const HEIGHT: f64 = 8.0;
const WIDTH: f64 = 2.0;

fn compared(ledger: &mut Ledger, name: &str, unit: &str, (found, exact): (&[f64], &[f64]), cost: &Cost) {
    ledger
        .claim(format!("column under weight and pressure: {name}"))
        .unit(unit)
        .values(found)
        .equals_each(exact)
        .relative(ROUNDING)
        .evidence(Evidence::Exact, "uniaxial strain: -p - rho g (H - y), a third of it across for nu = 1/4")
        .because(
            "displacements are parabolas, which lie in the space of quad9; its stresses are linear: rounding",
        )
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .cost(cost)
        .record();
}
