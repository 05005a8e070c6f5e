//! Two equal bars that collide.

use super::super::waves::{line, mesh, problem, run};
use super::BAR;
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::inertial::InertialPoints;
use asperity_friction::points::Components;
use asperity_mechanics::dynamics::{Fault, SplitPoint};

/// Cells along a bar of 1 m.
const CELLS: usize = 200;

/// Velocity of the left bar \[m/s\].
const VELOCITY: f64 = 1.0;

struct Collision {
    /// Contact traction over ρ c v/2 through time over l/c.
    history: Vec<(f64, f64)>,
    /// Mean velocities of both bars at the end \[m/s\].
    after: [f64; 2],
    missing: f64,
    /// Largest overlap of the bars at the end of a step over the velocity times l/c \[-\].
    overlap: f64,
}

fn collide() -> Result<Collision, CaseError> {
    let h = 1.0 / CELLS as f64;
    let bars = [0.0, 1.0].map(|x| [line(x, x + 1.0, CELLS), line(0.0, h, 1)]);
    let time = 1.0 / BAR.pressure;
    let mut problem = problem(mesh(&bars, ElementKind::Quad4)?, BAR, Idealisation::PlaneStress, 3.0 * time)?;
    let half = problem.model.mesh.nodes.len() / 2;
    let point = |j: usize| SplitPoint {
        minus: j * (CELLS + 1) + CELLS,
        plus: half + j * (CELLS + 1),
        area: 0.5 * h,
        normal: [1.0, 0.0, 0.0],
        along: vec![[0.0, 1.0, 0.0]],
        gap: 0.0,
    };
    let frictionless = Coulomb::new(0.0, None)?;
    problem.fault = Some(Fault {
        points: vec![point(0), point(1)],
        law: Box::new(InertialPoints(vec![frictionless; 2])),
        normal: vec![0.0; 2],
        shear: Components::new(vec![0.0; 2], 2),
        rate: Components::new(vec![0.0; 2], 2),
        opens: true,
        regularisation: None,
        pulses: Vec::new(),
        forced: Vec::new(),
        onset: None,
        ties: Vec::new(),
    });
    problem.velocity = (0..2 * half).flat_map(|n| [if n < half { VELOCITY } else { 0.0 }, 0.0]).collect();
    let full = 0.5 * BAR.density * BAR.pressure * VELOCITY;
    let mut history = Vec::new();
    let mut overlap: f64 = 0.0;
    let last = run(&problem, |run| {
        history.push(((run.time() - run.dt()) / time, run.fault().normal[0] / full));
        overlap = overlap.max(-run.fault().gap[0] / (VELOCITY * time));
    })?;
    let budget = last.budget();
    let mean = |v: &[f64]| v.iter().step_by(2).sum::<f64>() / half as f64;
    let after = [mean(&last.velocity()[..2 * half]), mean(&last.velocity()[2 * half..])];
    Ok(Collision { history, after, missing: budget.energies().imbalance(), overlap })
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (collision, cost) = Cost::measure(collide);
    let Collision { history, after, missing, overlap } = collision?;
    let step = history[1].0 - history[0].0;
    let impulse: f64 = history.iter().map(|(_, f)| f * step).sum();
    let last = history.iter().rev().find(|(_, f)| *f > 0.5).map_or(f64::NAN, |(t, _)| *t);
    let plateau: Vec<f64> = history.iter().filter(|(t, _)| (0.5..1.5).contains(t)).map(|(_, f)| *f).collect();
    let mean = plateau.iter().sum::<f64>() / plateau.len() as f64;
    const SOURCE: &str = "d'Alembert: each front runs through its bar and back";
    const FRONT: &str = "a front on cells of h spreads over (c t h²)^(1/3), here 3 cells, 1.5 % of the bar";
    let mut claim = |what: &str, value: f64, exact: f64, bound: f64, why: &str| {
        let draft = ledger.claim(what).value(value).equals(exact).absolute(bound);
        draft
            .evidence(Evidence::Exact, SOURCE)
            .because(why)
            .covers(&[Capability::Waves])
            .cost(&cost)
            .record();
    };
    claim("impact of two bars: end of contact over l/c", last, 2.0, 0.03, FRONT);
    claim(
        "impact of two bars: mean traction over rho c v/2 while the fronts run",
        mean,
        1.0,
        0.005,
        "ringing behind the front, whose mean is less than a cell's share of it",
    );
    claim("impact of two bars: impulse over rho l v", impulse / 2.0, 1.0, 0.01, FRONT);
    claim("impact of two bars: velocity of the first bar afterwards [m/s]", after[0], 0.0, 0.01, FRONT);
    claim("impact of two bars: velocity of the second bar afterwards [m/s]", after[1], 1.0, 0.01, FRONT);
    claim(
        "impact of two bars: largest overlap at the end of a step over v l/c",
        overlap,
        0.0,
        1e-12,
        "the traction closes the gap by the end of the step, but for rounding of displacements of v l/c",
    );
    claim(
        "impact of two bars: missing energy over its largest part",
        missing,
        0.0,
        1e-10,
        "rounding of forces of bars that move by a thousand times the length that they are compressed by",
    );
    ledger.plot(
        Plot::xy("Contact traction of two colliding bars", "time over l/c", "traction over rho c v/2")
            .series(Series::line("cells of l/200", &history))
            .series(Series::line("exact", &[(0.0, 1.0), (2.0, 1.0), (2.0, 0.0), (3.0, 0.0)])),
    );
    Ok(())
}
