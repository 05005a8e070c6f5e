//! Displacements of bodies around a slipping fault in 3D, below a free surface and between two rocks.

use crate::cases::okada::Rectangle;
use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_plan::faults::{BodiesView, Plan};
use std::collections::BTreeMap;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_free_surface",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Solid3d],
    quick: true,
    run,
};

/// Distance over which slip decreases to zero \[m\].
const REACH: f64 = 6e3;
/// Half size of the box \[m\]: displacements at its sides are those of a double couple, about (REACH/FAR)² of slip.
const FAR: f64 = 120e3;
/// Width of the rim of the slip area where the tractions of the two sides are not compared \[m\].
const RIM: f64 = 2.2e3;
/// Length of the rectangles of the reference \[m\].
const PIECE: f64 = 250.0;
const POISSON: f64 = 0.25;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    table(ledger);
    surface(ledger)?;
    contact(ledger)
}

/// Claims the reference solution against its published table.
fn table(ledger: &mut Ledger) {
    let printed = [
        [-8.689e-3, -4.298e-3, -2.747e-3],
        [-4.682e-3, -3.527e-2, -3.564e-2],
        [-2.660e-4, 1.056e-2, 3.214e-3],
    ];
    let mut worst = 0.0_f64;
    for (k, expected) in printed.iter().enumerate() {
        let mut slip = [0.0; 3];
        slip[k] = 1.0;
        let fault = Rectangle { depth: 4.0, dip: 70f64.to_radians(), size: [3.0, 2.0], slip, ratio: 0.5 };
        let found = fault.surface(2.0, 3.0);
        worst = found.iter().zip(expected).map(|(u, e)| (u / e - 1.0).abs()).fold(worst, f64::max);
    }
    ledger
        .claim("the reference against table 2, case 2 of Okada (1985), all three kinds of slip: largest relative difference")
        .value(worst)
        .at_most(5e-4)
        .evidence(Evidence::Exact, "x = 2, y = 3, d = 4, dip 70 degrees, L = 3, W = 2, equal Lame constants")
        .because("four printed digits: half a unit of the last of 1.056")
        .record();
    let upright = |y: f64| {
        let fault = Rectangle {
            depth: 2.0,
            dip: std::f64::consts::FRAC_PI_2,
            size: [3.0, 2.0],
            slip: [1.0, 0.5, 0.0],
            ratio: 0.4,
        };
        fault.surface(1.0, y)
    };
    let (hanging, foot) = (upright(-1e-9), upright(1e-9));
    ledger
        .claim("jump of the reference at an upright fault that reaches the surface less its slip, both directions")
        .value((hanging[0] - foot[0] - 1.0).abs().max((hanging[2] - foot[2] - 0.5).abs()))
        .at_most(1e-6)
        .evidence(Evidence::Exact, "the jump of a dislocation is its slip")
        .because("displacements 1e-9 beside the fault, whose slope is of order one")
        .why_not_tighter("the slope is bounded, not known: at this place it happens to be small")
        .record();
}

/// Slip \[m\] at a depth and a distance along the strike.
fn slip(depth: f64, along: f64) -> f64 {
    let part = |x: f64| (1.0 - (x / REACH).powi(2)).max(0.0).powi(2);
    part(depth) * part(along)
}

/// Half of the problem, z > 0, with cells of this size \[m\] at the fault and up to the distance `near`, and the shear moduli of
/// both sides \[Pa\].
fn plan(size: f64, near: f64, moduli: [f64; 2]) -> Result<Plan, CaseError> {
    let zone =
        |from: f64, to: f64| format!("{{ size = {size:?}, from = {from:?}, to = {to:?}, ratio = 1.5 }}");
    let others = format!("{}, {}", zone(-REACH, 0.0), zone(0.0, REACH));
    let body = |name: &str, modulus: f64, x: [f64; 2], cells: String| {
        format!(
            "[materials.{name}]\nyoung = {:?}\npoisson = {POISSON}\ndensity = 2670\n[bodies.{name}]\nmaterial = \"{name}\"\n\
             mesh.block = {{ min = [{:?}, {:?}, 0.0], max = [{:?}, 0.0, {FAR:?}], spacing = [{cells}, {others}], element = \"hex8\" }}\n",
            2.0 * (1.0 + POISSON) * modulus,
            x[0],
            -FAR,
            x[1]
        )
    };
    let bodies = body("L", moduli[0], [-FAR, 0.0], zone(-near, 0.0))
        + &body("R", moduli[1], [0.0, FAR], zone(0.0, near));
    let text = format!(
        r#"schema = 1
title = "free surface"
kinematics = "3d"
{bodies}
[faults.main]
minus = "L.right"
plus = "R.left"
rake = [0, 0, 1]
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.01, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal = "50 MPa"
under_resolved = "allow"
rate = "1e-9 m/s"
creep = {{ outside = {{ y = {{ from = {:?} }}, z = {{ to = {REACH:?} }} }}, rate = 0.0 }}
[[stages]]
name = "all"
duration = "1 yr"
conditions = [{{ set = "L.left", x = 0, y = 0, z = 0 }}, {{ set = "R.right", x = 0, y = 0, z = 0 }}, {{ set = "L.back", x = 0, y = 0 }}, {{ set = "R.back", x = 0, y = 0 }}]
[time]
stepper = "fault-ode"
[output]
bodies = true
"#,
        -REACH,
    );
    seas::plan(&text)
}

/// Bodies, slip of all points \[m\] and displacements of all nodes \[m\].
type DisplacedBodies<'a> = (&'a BodiesView, Vec<f64>, Vec<[f64; 3]>);

/// Displacements of all nodes under the slip of the problem, and that slip.
fn displaced(plan: &Plan) -> Result<DisplacedBodies<'_>, CaseError> {
    let view = plan.bodies.as_ref().ok_or("the plan has not kept its bodies")?;
    let values: Vec<f64> = plan.points.iter().map(|p| slip(-p.at[1], p.at[2])).collect();
    let displacement = view.bodies.vectors(&values, 0.0);
    Ok((view, values, displacement))
}

/// Displacement of the surface at x and z due to the slip of the problem, of plus relative to minus along z.
fn reference(x: f64, z: f64) -> [f64; 3] {
    let pieces = (REACH / PIECE) as i32;
    let mut u = [0.0; 3];
    for i in -pieces..pieces {
        for j in 0..pieces {
            let (along, top) = (f64::from(i) * PIECE, f64::from(j) * PIECE);
            let fault = Rectangle {
                depth: top + PIECE,
                dip: std::f64::consts::FRAC_PI_2,
                size: [PIECE, PIECE],
                // The hanging wall of an upright fault lies at y < 0 of the reference, which is minus.
                slip: [-slip(top + 0.5 * PIECE, along + 0.5 * PIECE), 0.0, 0.0],
                ratio: 1.0 - 2.0 * POISSON,
            };
            // x, y, z of the reference are z, x, y here.
            let part = fault.surface(z - along, x);
            u = [u[0] + part[1], u[1] + part[2], u[2] + part[0]];
        }
    }
    u
}

/// Draws displacements of the surface on those of dislocations.
fn overlay(ledger: &mut Ledger, view: &BodiesView, displacement: &[[f64; 3]]) {
    const FARTHEST: f64 = 12e3;
    let across = |z: f64| {
        let mut found: Vec<(f64, [f64; 3])> = (view.nodes.iter().zip(displacement))
            .filter(|(x, _)| x[1] == 0.0 && x[2] == z && x[0] > 0.0 && x[0] < FARTHEST)
            .map(|(x, u)| (x[0], *u))
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found
    };
    let mut diagram =
        Plot::xy("Displacement of the surface", "distance from the fault [km]", "displacement [m]");
    for (name, z, c) in [("along slip at z = 0", 0.0, 2), ("across the fault at z = 4 km", 4e3, 0)] {
        let found = across(z);
        let exact: Vec<(f64, f64)> = found.iter().map(|(x, _)| (x / 1e3, reference(*x, z)[c])).collect();
        let points: Vec<(f64, f64)> = found.iter().map(|(x, u)| (x / 1e3, u[c])).collect();
        diagram = diagram
            .series(Series::line(format!("{name}, dislocations"), &exact))
            .series(Series::points(format!("{name}, this code"), &points));
    }
    ledger.plot(diagram);
}

/// Claims displacements of the surface.
fn surface(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut levels, mut last) = (Vec::new(), None);
    for size in [2e3, 1e3, 0.5e3] {
        let (found, cost) = Cost::measure(|| plan(size, 4e3, [30e9; 2]));
        let plan = found?;
        let (view, _, displacement) = displaced(&plan)?;
        // Nodes of the coarser mesh, at the fault and away from it.
        let mut worst = 0.0_f64;
        for (node, u) in view.nodes.iter().zip(&displacement) {
            let even = |v: f64| (v / 2e3 - (v / 2e3).round()).abs() < 1e-9;
            let near = node[0].abs() <= 2.0 * 2e3 && node[2] <= 10e3 && node[0] != 0.0;
            if node[1] == 0.0 && near && even(node[0]) && even(node[2]) {
                let expected = reference(node[0], node[2]);
                worst = (0..3).map(|c| (u[c] - expected[c]).abs()).fold(worst, f64::max);
            }
        }
        if size < 1e3 {
            overlay(ledger, view, &displacement);
        }
        levels.push((size, worst));
        last = Some(cost.count("degrees of freedom", plan.dofs as f64));
    }
    let cost = last.ok_or("no level")?;
    ledger
        .order("displacement of the free surface by slip of 1 m along a vertical fault, largest error of a component")
        .levels(&levels)
        .expected(2.0)
        .within(0.5)
        .or_better()
        .evidence(Evidence::SemiAnalytic, "rectangular dislocations of 250 m below a free surface (Okada 1985)")
        .because("trilinear displacements, with what the sides of the box and rectangles add")
        .finest(2e-3, "slip changes by its whole over twelve cells: (0.5 km/6 km)^2/3")
        .covers(&[Capability::FaultCycles, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}

/// Claims displacement jump, opening and tractions between two rocks.
fn contact(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut between, mut against) = (Vec::new(), Vec::new());
    let mut last = None;
    for size in [1.5e3, 1e3, 0.75e3] {
        let moduli = [10e9, 40e9];
        let (found, cost) = Cost::measure(|| plan(size, 3e3, moduli));
        let plan = found?;
        let (view, values, displacement) = displaced(&plan)?;
        let (mut jump, mut opening) = (0.0_f64, 0.0_f64);
        for (&[minus, plus], s) in view.sides.iter().zip(&values) {
            let d: [f64; 3] = std::array::from_fn(|c| displacement[plus][c] - displacement[minus][c]);
            jump = jump.max((d[2] - s).abs()).max(d[1].abs());
            opening = opening.max(d[0].abs());
        }
        let cost = cost.count("degrees of freedom", plan.dofs as f64);
        for (name, value) in [("jump less slip, in both directions", jump), ("opening", opening)] {
            ledger
                .claim(format!("{name} of the recovered displacements over slip, cells of {size} m"))
                .value(value)
                .at_most(1e-12)
                .evidence(Evidence::Exact, "the jump is a degree of freedom, the opening is held")
                .because("rounding of sums of displacements")
                .why_not_tighter(
                    "rounding depends on the mesh; a jump on a wrong side is of the order of one",
                )
                .covers(&[Capability::FaultCycles])
                .cost(&cost)
                .record();
        }
        let sides = tractions(&plan, view, &displacement, size, moduli)?;
        let scale = sides.iter().fold(0.0_f64, |l, t| l.max(t[2].abs()));
        let largest = |f: &dyn Fn(&[f64; 3]) -> f64| sides.iter().map(f).fold(0.0, f64::max) / scale;
        between.push((size, largest(&|t| (t[0] - t[1]).abs())));
        against.push((size, largest(&|t| (0.5 * (t[0] + t[1]) - t[2]).abs())));
        last = Some(cost);
    }
    let cost = last.ok_or("no level")?;
    for (name, levels, finest) in [
        ("of both sides from the stresses of their cells, difference", &between, 0.1),
        ("of both sides in the mean against those of the operator, difference", &against, 0.1),
    ] {
        ledger
            .order(format!("shear tractions between two rocks {name} over the largest"))
            .levels(levels)
            .expected(1.5)
            .within(0.5)
            .or_better()
            .evidence(Evidence::Exact, "tractions are opposite on both sides")
            .because("one-sided differences of second order, of stress that falls off within three cells of the coarsest mesh: k h from 1.1 to 0.55 is on the way to the limit")
            .finest(finest, "(k h)^2/3 for stress that falls off as exp(-k x), k h = 0.55 for slip over 6 km in two directions and cells of 0.75 km")
            .covers(&[Capability::FaultCycles])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Displacements of the nodes of bodies \[m\].
struct Displacements<'a> {
    values: &'a [[f64; 3]],
    /// Nodes by position \[mm\]: two on the fault.
    nodes: BTreeMap<[i64; 3], Vec<usize>>,
    /// Size of the cells \[m\].
    size: f64,
}

impl<'a> Displacements<'a> {
    fn new(places: &[[f64; 3]], values: &'a [[f64; 3]], size: f64) -> Self {
        let mut nodes: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
        for (n, x) in places.iter().enumerate() {
            nodes.entry(Self::key(x)).or_default().push(n);
        }
        Self { values, nodes, size }
    }

    fn key(x: &[f64; 3]) -> [i64; 3] {
        x.map(|c| (c * 1e3).round() as i64)
    }

    /// Displacement of a node off the fault.
    fn at(&self, x: &[f64; 3]) -> Result<[f64; 3], CaseError> {
        let node = self.nodes.get(&Self::key(x)).and_then(|nodes| nodes.first());
        Ok(node.map(|n| self.values[*n]).ok_or("no cell beside the fault")?)
    }

    /// Shear strain along z at the centre of a face of the fault on its side minus (0) or plus (1). Its corners are pairs of nodes.
    fn shear(&self, corners: &[[usize; 2]], places: &[[f64; 3]], side: usize) -> Result<f64, CaseError> {
        let sign = [-1.0, 1.0][side];
        let (mut by_x, mut by_z) = (0.0, 0.0);
        let beside = |x: &[f64; 3], cells: f64| self.at(&[sign * cells * self.size, x[1], x[2]]);
        let middle = places.iter().map(|x| x[2]).sum::<f64>() / 4.0;
        for (corner, x) in corners.iter().zip(places) {
            let (u, v, w) = (self.values[corner[side]], beside(x, 1.0)?, beside(x, 2.0)?);
            // One-sided differences of second order, averaged over four corners.
            by_x += sign * (4.0 * v[2] - 3.0 * u[2] - w[2]) / (8.0 * self.size);
            by_z += (x[2] - middle).signum() * u[0] / (2.0 * self.size);
        }
        Ok(by_x + by_z)
    }
}

/// Shear tractions along z at the centres of fault faces in the inner part of the slip area: from the cells of minus and plus,
/// and from the operator.
fn tractions(
    plan: &Plan,
    view: &BodiesView,
    displacement: &[[f64; 3]],
    size: f64,
    moduli: [f64; 2],
) -> Result<Vec<[f64; 3]>, CaseError> {
    let bodies = Displacements::new(&view.nodes, displacement, size);
    let points: BTreeMap<usize, usize> = view.sides.iter().enumerate().map(|(p, s)| (s[0], p)).collect();
    let values: Vec<f64> = plan.points.iter().map(|p| slip(-p.at[1], p.at[2])).collect();
    let shear = plan.problem.fault.operator.shear_of(&values);
    let faces = plan.faults.first().ok_or("no fault")?.faces.iter();
    let mut found = Vec::new();
    for face in faces {
        let corners: Vec<[usize; 2]> = face.iter().map(|&p| view.sides[p]).collect();
        let places: Vec<[f64; 3]> = corners.iter().map(|c| view.nodes[c[0]]).collect();
        // Leave out the rim, where slip curves strongly, and the surface, where tributary areas are halved.
        if places.iter().any(|x| x[1] > -1.4e3 || x[1] < RIM - REACH || x[2] > REACH - RIM) {
            continue;
        }
        let [minus, plus] = [0, 1].map(|k| bodies.shear(&corners, &places, k));
        let operator = corners.iter().map(|c| shear[points[&c[0]]]).sum::<f64>() / 4.0;
        found.push([moduli[0] * minus?, moduli[1] * plus?, operator]);
    }
    Ok(found)
}
