//! Ruptures of a plane fault with waves, against a spectral boundary integral.

mod fault;
mod precision;
mod reference;
mod transition;

use super::waves::{Rock, line, mesh, nodes_on, problem, run as steps};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_mechanics::dynamics::{Budget, Explicit, Problem, dashpots};
use reference::{Parameters, Reference};

/// See the README.
pub const CASE: Case = Case {
    name: "dynamic_rupture",
    readme: include_str!("README.md"),
    covers: &[Capability::DynamicRupture, Capability::PlaneStrain, Capability::Antiplane],
    quick: true,
    run,
};

/// Spacing of nodes \[m\].
const SPACING: f64 = 100.0;

/// Half length and half width of the rock \[m\], at whose sides waves are absorbed, and the end of a run \[s\].
#[derive(Clone, Copy, Debug)]
struct Span {
    extent: [f64; 2],
    end: f64,
}

/// Until the fronts have passed 15 km.
const WHOLE: Span = Span { extent: [24e3, 12e3], end: 6.5 };

/// Slip rates that mark the front \[m/s\].
const FRONTS: [&str; 2] = ["0.001", "0.1"];

/// Result of a run.
struct Rupture {
    /// Positions of the points \[m\].
    at: Vec<f64>,
    /// Times at which the slip rate passes each of [`FRONTS`] \[s\]; NaN where it does not.
    times: [Vec<f64>; 2],
    /// Slip rate at 4.5 km through time \[m/s\].
    history: Vec<(f64, f64)>,
    budget: Budget,
    cost: Cost,
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Reference::read()?;
    for (name, title) in [
        ("tpv205_III", "TPV205-2D, antiplane"),
        ("tpv205_II", "TPV205-2D, plane strain"),
        ("tpv3_III", "TPV3 in section, antiplane"),
        ("tpv3_II", "TPV3 in section, plane strain"),
        ("tpv101_III", "TPV101-2D, antiplane"),
        ("tpv101_II", "TPV101-2D, plane strain"),
        ("tpv104_III", "TPV104 in section, antiplane"),
    ] {
        claims(ledger, &reference, name, title)?;
    }
    precision::claims(ledger, &reference)?;
    nucleation(ledger, &reference)?;
    transition::claims(ledger, &reference)
}

/// Runs a problem on quad9 with nodes this far apart.
fn rupture(parameters: &Parameters, spacing: f64) -> Result<Rupture, CaseError> {
    rupture_of(ElementKind::Quad9, parameters, spacing, WHOLE)
}

/// A problem on quad4 or quad9 with nodes this far apart.
fn fault_between_rocks(
    kind: ElementKind,
    parameters: &Parameters,
    spacing: f64,
    Span { extent, end }: Span,
) -> Result<Problem<2>, CaseError> {
    let rock = Rock { density: parameters.density, pressure: parameters.cp, shear: parameters.cs };
    let size = if kind == ElementKind::Quad9 { 2.0 * spacing } else { spacing };
    let [nx, ny] = extent.map(|l| (l / size).round() as usize);
    // Where both halves of the fault are alike, one is computed.
    let half = parameters.is_even();
    let x = if half { line(0.0, extent[0], nx) } else { line(-extent[0], extent[0], 2 * nx) };
    let parts = [[x.clone(), line(-extent[1], 0.0, ny)], [x, line(0.0, extent[1], ny)]];
    let space = if parameters.antiplane { Idealisation::Antiplane } else { Idealisation::PlaneStrain };
    let mut problem = problem(mesh(&parts, kind)?, rock, space, end)?;
    let left = if half { &[][..] } else { &["b0.left", "b1.left"] };
    let sides = left.iter().chain(&["b0.right", "b0.bottom", "b1.right", "b1.top"]);
    let sides: Vec<_> = sides.flat_map(|&s| problem.model.mesh.side_sets[s].clone()).collect();
    problem.absorbing = dashpots(&problem.model, &problem.density, &sides);
    if half && !parameters.antiplane {
        // Displacement across the fault is odd along it.
        let middle = ["b0.left", "b1.left"].map(|side| side_nodes(&problem.model.mesh, side)).concat();
        problem.stages[0].fixed = middle.into_iter().map(|n| 2 * n + 1).collect();
    }
    problem.courant = 0.8;
    problem.fault = Some(fault::between(&problem.model, parameters, spacing)?);
    Ok(problem)
}

/// Runs a problem on quad4 or quad9 with nodes this far apart.
fn rupture_of(
    kind: ElementKind,
    parameters: &Parameters,
    spacing: f64,
    span: Span,
) -> Result<Rupture, CaseError> {
    let problem = fault_between_rocks(kind, parameters, spacing, span)?;
    let at: Vec<f64> = nodes_on(&problem.model, "b0.top").iter().map(|(_, x)| *x).collect();
    let mut times = [vec![f64::NAN; at.len()], vec![f64::NAN; at.len()]];
    let mut before = vec![0.0; at.len()];
    let watched = at.iter().position(|x| (x - 4500.0).abs() < 0.1 * spacing).unwrap_or(0);
    let mut history = Vec::new();
    let (result, cost) = Cost::measure(|| {
        steps(&problem, |run| {
            pass(run, &mut before, &mut times);
            history.push((run.time() - run.dt(), run.fault().rate.size(watched)));
        })
    });
    let last = result?;
    let cost = cost.count("cells", last.product().cells() as f64).count("steps", last.steps() as f64);
    let budget = last.budget();
    Ok(Rupture { at, times, history, budget, cost })
}

/// Nodes of a side.
fn side_nodes(mesh: &Mesh<2>, side: &str) -> Vec<usize> {
    nodes_of_sides(mesh, &mesh.side_sets[side])
}

/// Notes where the slip rate has passed a front in the last step.
fn pass(run: &Explicit<'_, 2>, before: &mut [f64], times: &mut [Vec<f64>; 2]) {
    let time = run.time() - run.dt();
    for (k, (before, now)) in before.iter_mut().zip(run.fault().rate.all()).enumerate() {
        let now = now.abs();
        for (times, front) in times.iter_mut().zip([1e-3, 0.1]) {
            if times[k].is_nan() && now >= front {
                times[k] = time - run.dt() * (now - front) / (now - *before);
            }
        }
        *before = now;
    }
}

/// Largest relative difference of rupture times, and differences by position.
fn differences(rupture: &Rupture, reference: &Reference, name: &str, front: usize) -> Vec<(f64, f64)> {
    let expected = reference.times(name, FRONTS[front]);
    let found = |x: f64| rupture.at.iter().position(|a| (a - x).abs() < 1.0).map(|k| rupture.times[front][k]);
    let rows = expected.iter().filter_map(|&(x, t)| Some((x, found(x)? / t - 1.0)));
    rows.collect()
}

fn largest(rows: &[(f64, f64)]) -> f64 {
    // A place that the front did not reach is the largest difference of all.
    rows.iter().map(|r| r.1.abs()).fold(0.0, |m, d| if d.is_nan() { f64::INFINITY } else { f64::max(m, d) })
}

fn claims(ledger: &mut Ledger, reference: &Reference, name: &str, title: &str) -> Result<(), CaseError> {
    let parameters = reference.parameters(name)?;
    let found = rupture(&parameters, SPACING)?;
    let mut rows = differences(&found, reference, name, 1);
    rows.retain(|(x, _)| x.abs() >= parameters.nucleated());
    ledger
        .claim(format!("{title}: rupture times on nodes 100 m apart"))
        .norm("largest relative difference over all places from 2 km, or the border of the imposed traction, to 15 km from the hypocentre")
        .value(largest(&rows))
        .at_most(0.01)
        .uncertainty(1e-3)
        .evidence(Evidence::OtherCode, "spectral boundary integral (verification/independent/dynamic_rupture.py)")
        .because("the accuracy asked of a mesh with three to five nodes in the cohesive zone (Day et al. 2005, Kaneko et al. 2008)")
        .covers(&[Capability::DynamicRupture])
        .cost(&found.cost)
        .record();
    drawn(ledger, &found, reference, (name, title));
    Ok(())
}

/// Claims the energy balance of a run with nodes 100 m apart, and draws it.
fn drawn(ledger: &mut Ledger, found: &Rupture, reference: &Reference, (name, title): (&str, &str)) {
    let budget = found.budget;
    ledger
        .claim(format!("{title}: missing energy over its largest part"))
        .value(budget.energies().imbalance())
        .at_most(1e-13)
        .evidence(Evidence::Exact, "central differences keep the balance of energy but for rounding")
        .because("a step rounds by 1e-16, and some thousand steps at most by their sum")
        .why_not_tighter("roundings of single steps cancel in part")
        .covers(&[Capability::DynamicRupture])
        .record();
    let expected = reference.times(name, FRONTS[1]);
    let times: Vec<(f64, f64)> = found.at.iter().copied().zip(found.times[1].iter().copied()).collect();
    let drawn: Vec<(f64, f64)> =
        times.into_iter().filter(|(x, t)| x.abs() <= 15e3 && t.is_finite()).collect();
    ledger.plot(
        Plot::xy(format!("{title}: rupture times"), "distance along the fault [m]", "time [s]")
            .series(Series::line("nodes 100 m apart", &drawn))
            .series(Series::points("boundary integral", &expected)),
    );
    let rates = reference.history(name, 4500.0);
    if !rates.is_empty() {
        ledger.plot(
            Plot::xy(format!("{title}: slip rate at 4.5 km"), "time [s]", "slip rate [m/s]")
                .series(Series::line("nodes 100 m apart", &found.history))
                .series(Series::points("boundary integral", &rates)),
        );
    }
}

/// Rupture within the imposed traction of TPV104, on half the spacing.
fn nucleation(ledger: &mut Ledger, reference: &Reference) -> Result<(), CaseError> {
    let name = "tpv104_III";
    let found = rupture(&reference.parameters(name)?, 0.5 * SPACING)?;
    ledger
        .claim("TPV104 in section, antiplane: rupture times on nodes 50 m apart, from 2 km on")
        .norm("largest relative difference over all places from 2 to 15 km from the hypocentre")
        .value(largest(&differences(&found, reference, name, 1)))
        .at_most(0.01)
        .uncertainty(1e-3)
        .evidence(
            Evidence::OtherCode,
            "spectral boundary integral (verification/independent/dynamic_rupture.py)",
        )
        .because("the accuracy of the other claims, where the slip rate rises without a front")
        .covers(&[Capability::DynamicRupture])
        .cost(&found.cost)
        .record();
    Ok(())
}
