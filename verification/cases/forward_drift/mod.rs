//! Forward steps on an elasto-plastic path: accuracy of yield events and order of the drift.

use super::body::{self, Body, Entry};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::block::von_mises;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::nonlinear::{Kinematics, Limits, Model};

/// See the README.
pub const CASE: Case = Case {
    name: "forward_drift",
    readme: include_str!("README.md"),
    covers: &[Capability::BodyLimits, Capability::Plasticity],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;
const POISSON: f64 = 0.3;
const YIELD: f64 = 0.02;
/// Lateral displacement of the top edge over the edge length; the upward displacement is a fifth of it.
const END: f64 = 0.1;
/// Quadrature points of nine cells.
const POINTS: u64 = 36;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plot = Plot::work_precision(
        "Work and precision",
        "unbalanced force over the largest reaction [-]",
        "time [s]",
    );
    for carry in [false, true] {
        let work = equal_steps(ledger, carry)?;
        let name = if carry { "unbalanced force carried" } else { "unbalanced force left" };
        plot = plot.series(Series::marked(name, &work));
    }
    ledger.plot(plot.caption("Small strain, 50 to 400 steps and the yield events."));
    events(ledger)?;
    for carry in [false, true] {
        limited_steps(ledger, carry)?;
    }
    Ok(())
}

/// The square and the displacement increments of its edges over the whole path.
fn square(kinematics: Kinematics, limits: Limits, carry: bool) -> Result<(Body<2>, Vec<Entry>), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [3; 2])?;
    let mesh = body::distorted(mesh, [1.0; 2], 1.0 / 3.0, 0.2);
    let material = body::j2(YOUNG, POISSON, Hardening::swift(YIELD, 0.01, 0.4)?)?;
    let options = Model { limits, ..body::model(material, Idealisation::PlaneStrain, kinematics) };
    let mut held = body::moved(&mesh, &body::side(&mesh, "bottom")?, |_| [0.0; 2]);
    held.extend(body::moved(&mesh, &body::side(&mesh, "top")?, |_| [END, 0.2 * END]));
    let fixed = body::dofs(&held);
    let mut body = Body::new(mesh, options, &fixed)?;
    body.carry = carry;
    Ok((body, held))
}

/// Results of a run of forward steps.
#[derive(Default)]
struct Run {
    /// Largest unbalanced force over the largest reaction, over the second half of the path.
    drift: f64,
    /// Steps that ended with a point at yield.
    yields: u64,
    /// Largest relative distance of the most stressed elastic point from yield at the end of such a step.
    missed: f64,
    /// Largest relative excess of an elastic point over the yield stress in any step.
    beyond: f64,
    /// Points in plastic flow at the end.
    plastic: u64,
    cost: Cost,
}

/// Runs the whole path in steps of at most 1/`steps`. Returns the body as well.
fn driven(
    kinematics: Kinematics,
    limits: Limits,
    carry: bool,
    steps: usize,
) -> Result<(Run, Body<2>), CaseError> {
    let (mut body, path) = square(kinematics, limits, carry)?;
    let mut run = Run::default();
    let (outcome, cost) = Cost::measure(|| -> Result<(), CaseError> {
        let mut done = 0.0;
        while done < 1.0 - 1e-12 {
            let part = (1.0 / steps as f64).min(1.0 - done);
            let increments: Vec<Entry> = path.iter().map(|&(dof, x)| (dof, part * x)).collect();
            let end = body.forward(&increments, &[], part)?;
            done += part * end.fraction;
            if done >= 0.5 {
                run.drift = run.drift.max(drift(&mut body, &path)?);
            }
            let plastic = body.block.plastic_strain_at_points().ok_or("no plastic strain is kept")?;
            let elastic = body
                .block
                .stress_at_points()
                .iter()
                .zip(plastic)
                .filter(|(_, e)| *e < 1e-12)
                .fold(f64::NEG_INFINITY, |m, (s, _)| m.max(von_mises(s) / YIELD - 1.0));
            run.beyond = run.beyond.max(elastic);
            if end.limit.is_some_and(|l| l.limit == "r1") {
                run.yields += 1;
                run.missed = run.missed.max(elastic.abs());
            }
        }
        Ok(())
    });
    outcome?;
    run.cost = cost.counts(&body.work);
    let plastic = body.block.plastic_strain_at_points().ok_or("no plastic strain is kept")?;
    run.plastic = plastic.iter().filter(|e| **e > 1e-12).count() as u64;
    Ok((run, body))
}

/// Unbalanced force over the largest reaction.
fn drift(body: &mut Body<2>, path: &[Entry]) -> Result<f64, CaseError> {
    let u = body.u.clone();
    let r = body.forces(&u, 0.0).map_err(|refusal| refusal.to_string())?;
    let reaction = path.iter().fold(0.0, |m: f64, (dof, _)| m.max(r[*dof].abs()));
    Ok(body.drift(&[])? / reaction)
}

fn equal_steps(ledger: &mut Ledger, carry: bool) -> Result<Vec<(f64, f64)>, CaseError> {
    let (mut levels, mut work, mut last) = (Vec::new(), Vec::new(), Cost::default());
    for steps in [50, 100, 200, 400] {
        let (run, _) = driven(Kinematics::Small, Limits::default(), carry, steps)?;
        levels.push((1.0 / steps as f64, run.drift));
        work.push((run.drift, run.cost.wall.unwrap_or(f64::NAN)));
        last = run.cost;
    }
    // One of 400 steps rotates the flow direction by at most 2 G de/q = 0.012 at yield and less later; its error is half the square.
    let (order, bound, because) = if carry {
        (2.0, 1e-4, "a step misses half the square of the angle 2 G de/q by which a point may turn, 7e-5")
    } else {
        (
            1.0,
            2e-2,
            "400 steps miss half the square of the angle 2 G de/q by which a point may turn, 7e-5 each, if all were of one sign",
        )
    };
    let how = if carry { "carried" } else { "left" };
    ledger
        .order(format!("largest unbalanced force over the reaction, second half of the path, small strain, force {how}"))
        .levels(&levels)
        .expected(order)
        .within(0.1)
        .finest(bound, because)
        .evidence(Evidence::Exact, "equilibrium")
        .because("a step leaves a force of second order; left, they add up to first order; carried, only the last one remains; the next term is of the size of the angle, 0.1 and less")
        .why_not_tighter("angles are largest at first yield and fall as the flow settles")
        .cost(&last)
        .record();
    Ok(work)
}

fn events(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (run, body) = driven(Kinematics::Small, Limits::default(), false, 50)?;
    body_plots::displacement(ledger, "The square at the end of its path", &body.mesh, &body.u, true)?;
    ledger
        .claim("steps that end with a point at yield, 36 points, all of them in plastic flow at the end")
        .count(run.yields.min(run.plastic), POINTS)
        .evidence(Evidence::Exact, "each point yields once on a path that does not turn back")
        .because("the limit r1 stops for each point")
        .cost(&run.cost)
        .record();
    ledger
        .claim("most stressed elastic point at the end of such a step: distance from yield, relative")
        .value(run.missed)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "closed form of r1")
        .because("the root of a square, and the product of fraction and increment; rounding")
        .why_not_tighter("rounding of the increments, which are solutions of a linear system")
        .cost(&run.cost)
        .record();
    ledger
        .claim("excess of an elastic point over its yield stress at the end of any step, relative")
        .value(run.beyond)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "no step passes an event")
        .because("as above")
        .why_not_tighter("rounding of the increments, which are solutions of a linear system")
        .record();
    Ok(())
}

fn limited_steps(ledger: &mut Ledger, carry: bool) -> Result<(), CaseError> {
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for strain in [4e-3, 2e-3, 1e-3, 5e-4] {
        let limits = Limits { strain, rotation: strain, ..Limits::default() };
        let (run, _) = driven(Kinematics::UpdatedLagrangian, limits, carry, 1)?;
        levels.push((strain, run.drift));
        last = run.cost;
    }
    let (order, bound, because) = if carry {
        (
            2.0,
            3e-4,
            "the last step misses half the square of the angle 2 G de/q = 0.025 by which a point may turn",
        )
    } else {
        (
            1.0,
            5e-2,
            "200 steps miss half the square of the angle 2 G de/q = 0.025 by which a point may turn, if all were of one sign",
        )
    };
    let how = if carry { "carried" } else { "left" };
    ledger
        .order(format!("largest unbalanced force over the reaction, second half of the path, large deformation, steps chosen by r1, r2 and r3 alone, force {how}, in the limit on strain and rotation"))
        .levels(&levels)
        .expected(order)
        .within(0.1)
        .finest(bound, because)
        .evidence(Evidence::Exact, "equilibrium")
        .because("a step leaves a force of second order; left, they add up to first order; carried, only the last one remains; the next term is of the size of the angle, 0.1 and less")
        .why_not_tighter("angles are largest at first yield and fall as the flow settles")
        .covers(&[Capability::BodyLimits, Capability::Plasticity, Capability::FiniteStrain])
        .cost(&last)
        .record();
    Ok(())
}
