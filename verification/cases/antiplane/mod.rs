//! Bodies in antiplane motion as scenes: a crack and a prism; initial stress.

mod prestress;

use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::Samples;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use asperity_run::report::Outcome;
use asperity_vary::SceneText;
use std::f64::consts::{PI, SQRT_2};

/// See the README.
pub const CASE: Case = Case {
    name: "antiplane",
    readme: include_str!("README.md"),
    covers: &[Capability::Antiplane, Capability::Quadrilaterals, Capability::Loads],
    quick: true,
    run,
};

/// Elements along a unit length.
const SIZES: [u32; 4] = [8, 16, 32, 64];
/// Factor of the bound over the error predicted from the last two levels.
const ROOM: f64 = 1.5;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    crack(ledger, "quad4")?;
    crack(ledger, "quad9")?;
    prism(ledger)?;
    prestress::claims(ledger)
}

/// Runs a scene and returns its last samples.
fn simulate(text: &str) -> Result<(Samples, Cost), CaseError> {
    let (result, cost) = Cost::measure(|| {
        let scene = scene::read(text).map_err(|e| e.to_string())?;
        let plan = bodies::plan(&scene).map_err(|e| e.to_string())?;
        let mut record = Recorder::new();
        let report = kinds::bodies::run(&plan, &mut record).map_err(|e| e.to_string())?;
        let last = record.samples().last().cloned().ok_or("no step was taken")?;
        Ok::<_, CaseError>((report, last))
    });
    let (report, samples) = result?;
    if report.outcome != Outcome::Completed {
        return Err(format!("{:?}", report.outcome).into());
    }
    Ok((samples, cost.count("unknowns", report.plan.dofs as f64)))
}

/// The scene with another cell size and element; the keys of both are given.
fn refined(text: &str, [size, of_kind]: [&str; 2], n: u32, element: &str) -> Result<String, CaseError> {
    let scene = SceneText::new(text).with_or_same(size, 1.0 / f64::from(n)).with_or_same(of_kind, element);
    Ok(scene.text()?)
}

const FAULT: [&str; 2] = ["bodies.B.mesh.fault.spacing", "bodies.B.mesh.fault.element"];
const BLOCK: [&str; 2] = ["bodies.B.mesh.block.size", "bodies.B.mesh.block.element"];

fn crack(ledger: &mut Ledger, element: &str) -> Result<(), CaseError> {
    let mut levels = Vec::new();
    let mut finest = (Samples::default(), Cost::default());
    for n in SIZES {
        finest = simulate(&refined(include_str!("crack.toml"), FAULT, n, element)?)?;
        levels.push((1.0 / f64::from(n), finest.0.forces[1][2] - SQRT_2));
    }
    let (samples, cost) = finest;
    ledger
        .order(format!("force that tears the crack, {element}"))
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .evidence(Evidence::Exact, "conformal map: sqrt 2 times G times the displacement of a half")
        .because("the energy of r^(1/2) sin(theta/2) at the tip, which uniform meshes of any order miss by O(h)")
        .finest(
            ROOM * (levels[2].1 - levels[3].1),
            "1.5 times what the last two levels of a first-order error let expect, without use of the reference",
        )
        .covers(&[Capability::Antiplane, Capability::Quadrilaterals])
        .cost(&cost)
        .record();
    ledger
        .claim(format!("forces on the two sides over each other, {element}"))
        .value(-samples.forces[0][2] / samples.forces[1][2])
        .equals(1.0)
        .absolute(1e-10)
        .evidence(Evidence::Exact, "balance of forces: the other sides are free")
        .because("the residual of the free nodes is 1e-14 to 1e-11 of the forces, and no node belongs to both sides")
        .why_not_tighter("the bound is that of the stepper's convergence")
        .covers(&[Capability::Antiplane])
        .cost(&cost)
        .record();
    Ok(())
}

/// Displacement at the centre of the prism; successive terms of the series fall by a factor of exp(-pi) or more.
fn middle() -> f64 {
    let term = |k: i32| {
        let n = f64::from(2 * k + 1);
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        sign / (n.powi(3) * (0.5 * n * PI).cosh())
    };
    0.125 - 4.0 / PI.powi(3) * (0..15).rev().map(term).sum::<f64>()
}

fn prism(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = middle();
    let (mut levels, mut cost) = (Vec::new(), Cost::default());
    for n in SIZES {
        let (samples, spent) = simulate(&refined(include_str!("prism.toml"), BLOCK, n, "quad4")?)?;
        levels.push((1.0 / f64::from(n), (samples.points[0].displacement[2] - exact).abs()));
        cost = spent;
    }
    ledger
        .order("displacement of the middle of the prism, quad4")
        .levels(&levels)
        .expected(2.0)
        .within(0.1)
        .evidence(Evidence::Exact, "series of the torsion function of a square")
        .because("nodal values of bilinear elements; the r^2 ln r of the corners is weaker")
        .finest(
            ROOM * (levels[2].1 - levels[3].1) / 3.0,
            "1.5 times what the last two levels of a second-order error let expect",
        )
        .covers(&[Capability::Antiplane, Capability::Loads])
        .cost(&cost)
        .record();
    Ok(())
}
