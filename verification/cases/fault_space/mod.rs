//! Faults in three dimensions: slip along a rake, with slip across the rake and opening constrained to zero.

mod mirrored;

use crate::cases::fault_operator::matrix;
use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_plan::faults::Plan;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::fmt::Write as _;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_space",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    slab(ledger)?;
    both_directions(ledger)?;
    mirrored::claims(ledger)?;
    gaussian(ledger)?;
    penny(ledger)?;
    blocks(ledger)
}

const POISSON: f64 = 0.25;
/// Shear modulus \[Pa\].
const ROCK: f64 = 32e9;

/// Two blocks with a fault between them.
struct Blocks<'a> {
    kinematics: &'a str,
    /// Shear moduli of the left and the right block \[Pa\].
    moduli: [f64; 2],
    /// Extent along x of the left block, mirrored in the right one \[m\].
    wide: f64,
    /// Values of `min` and `max` along the other axes.
    ends: &'a [[f64; 2]],
    /// Keys of the cell sizes of the left and the right block.
    cells: [&'a str; 2],
    /// Further keys of the fault.
    fault: &'a str,
    conditions: &'a str,
    /// Text after `[time]`.
    rest: &'a str,
    duration: &'a str,
}

impl Blocks<'_> {
    fn plan(&self) -> Result<Plan, CaseError> {
        let element = if self.ends.len() == 2 { "hex8" } else { "quad4" };
        let mut text = format!("schema = 1\ntitle = \"blocks\"\nkinematics = \"{}\"\n", self.kinematics);
        let xs = [[-self.wide, 0.0], [0.0, self.wide]];
        for (((name, modulus), x), cells) in ["L", "R"].iter().zip(self.moduli).zip(xs).zip(self.cells) {
            let end = |k: usize| {
                let others = self.ends.iter().map(|e| format!(", {:?}", e[k]));
                format!("[{:?}{}]", x[k], others.collect::<String>())
            };
            let _ = write!(
                text,
                "[materials.{name}]\nyoung = {:?}\npoisson = {POISSON}\ndensity = 2670\n[bodies.{name}]\nmaterial = \"{name}\"\n\
                 mesh.block = {{ min = {}, max = {}, {cells}, element = \"{element}\" }}\n",
                2.0 * (1.0 + POISSON) * modulus,
                end(0),
                end(1)
            );
        }
        let _ = write!(
            text,
            r#"
[faults.main]
minus = "L.right"
plus = "R.left"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.01, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal = "50 MPa"
under_resolved = "allow"
rate = "1.1e-9 m/s"
{}
[[stages]]
name = "all"
duration = "{}"
conditions = [{}]
[time]
stepper = "fault-ode"
{}"#,
            self.fault, self.duration, self.conditions, self.rest
        );
        seas::plan(&text)
    }
}

/// A condition on these sides of both blocks.
fn on(sides: &[&str], motion: &str) -> String {
    let of = |name: &str| {
        sides.iter().map(|s| format!("{{ set = \"{name}.{s}\", {motion} }}, ")).collect::<String>()
    };
    of("L") + &of("R")
}

/// A slab one layer of cells thick against the plane model, for each way in which its faces are constrained.
fn slab(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (kinematics, rake, faces, ends) in [
        ("plane-strain", "[0, 1, 0]", "z = 0", "x = 0, y = 0"),
        ("antiplane", "[0, 0, 1]", "x = 0, y = 0", "z = 0"),
    ] {
        let far =
            |motion: &str| format!("{{ set = \"L.left\", {motion} }}, {{ set = \"R.right\", {motion} }}, ");
        let creep = r#"creep = { outside = { y = { from = "-6 km" } }, rate = 0.0 }"#;
        let plane = Blocks {
            kinematics,
            moduli: [10e9, 40e9],
            wide: 6e3,
            ends: &[[-8e3, 0.0]],
            cells: ["divisions = [6, 8]"; 2],
            fault: creep,
            conditions: &far(ends),
            rest: "",
            duration: "1 yr",
        };
        let solid = Blocks {
            kinematics: "3d",
            ends: &[[-8e3, 0.0], [0.0, 1e3]],
            cells: ["divisions = [6, 8, 1]"; 2],
            fault: &format!("{creep}\nrake = {rake}"),
            conditions: &(far("x = 0, y = 0, z = 0") + &on(&["back", "front"], faces)),
            ..plane
        };
        let (plans, cost) = Cost::measure(|| Ok::<_, CaseError>((plane.plan()?, solid.plan()?)));
        let (plane, solid) = plans?;
        let motion = format!("{kinematics} motion between two media");
        against_plane(ledger, &motion, (&plane, &solid), &cost);
    }
    Ok(())
}

/// Claims tractions of uniform slip across a slab against those of the plane model.
fn against_plane(ledger: &mut Ledger, motion: &str, (plane, solid): (&Plan, &Plan), cost: &Cost) {
    let largest = matrix(plane, false).amax();
    for normal in [false, true] {
        let (flat, full) = (matrix(plane, normal), matrix(solid, normal));
        let same = |p: usize, q: usize| (plane.points[p].at[1] - solid.points[q].at[1]).abs() < 1.0;
        let uniform = DMatrix::from_fn(full.nrows(), flat.ncols(), |q, p| f64::from(u8::from(same(p, q))));
        let couples = plane.problem.fault.operator.couples_normal() || !normal;
        let expected = if couples { flat } else { 0.0 * flat };
        let kind = if normal { "normal" } else { "shear" };
        ledger
            .claim(format!("{kind} tractions of slip that is uniform across a slab held in {motion}, against the plane, over the largest"))
            .value((&full * &uniform - &uniform * &expected).amax() / largest)
            .at_most(1e-11)
            .evidence(Evidence::Exact, "displacements of the plane, uniform across the slab, lie in its finite-element space")
            .because("rounding")
            .why_not_tighter("rounding grows with the condition of the condensed stiffness, some 1e4; a wrong area is of the order of one")
            .covers(&[Capability::FaultCycles])
            .cost(cost)
            .record();
    }
}

/// Normal tractions of vector slip, between two media below a free surface, against those of slip along each direction alone.
fn both_directions(ledger: &mut Ledger) -> Result<(), CaseError> {
    let creep = r#"creep = { outside = { y = { from = "-3 km" }, z = { from = "-3 km", to = "3 km" } }, rate = 0.0 }"#;
    let with = |more: &str| {
        Blocks {
            kinematics: "3d",
            moduli: [10e9, 40e9],
            wide: 6e3,
            ends: &[[-6e3, 0.0], [-6e3, 6e3]],
            cells: ["divisions = [6, 6, 12]"; 2],
            fault: &format!("{creep}\ndamping = 5e6\n{more}"),
            conditions: "{ set = \"L.left\", x = 0, y = 0, z = 0 }, { set = \"R.right\", x = 0, y = 0, z = 0 }",
            rest: "",
            duration: "1 yr",
        }
        .plan()
    };
    // The normal is along x, so that the second direction, normal x rake, is -y.
    let (plans, cost) = Cost::measure(|| -> Result<_, CaseError> {
        Ok([
            with("rake = [0, 0, 1]\nslip = \"free\"")?,
            with("rake = [0, 0, 1]")?,
            with("rake = [0, -1, 0]")?,
        ])
    });
    let [free, first, second] = plans?;
    let n = free.points.len();
    let wave = |k: usize, p: usize| {
        let [_, y, z] = free.points[p].at;
        (1.0 + (z / 1e3 + k as f64).sin()) * (y / 2e3 + k as f64).cos()
    };
    let slip: Vec<f64> = (0..2 * n).map(|i| wave(i / n, i % n)).collect();
    let found = free.problem.fault.operator.normal_of(&slip);
    let along = first.problem.fault.operator.normal_of(&slip[..n]);
    let across = second.problem.fault.operator.normal_of(&slip[n..]);
    let size = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let off: Vec<f64> = (0..n).map(|p| found[p] - along[p] - across[p]).collect();
    ledger
        .claim("normal tractions of slip in two directions between two media, against the sum of those of slip held along each, over the lesser of the two")
        .value(size(&off) / size(&along).min(size(&across)))
        .at_most(1e-11)
        .between(&first.points, &second.points)
        .evidence(Evidence::Exact, "superposition; tractions of slip along a line are those of the plane above, and of Okada in fault_free_surface")
        .because("rounding")
        .why_not_tighter("rounding grows with the condition of the condensed stiffness, some 1e4; a wrong area is of the order of one")
        .covers(&[Capability::FaultCycles, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}

/// A quarter of an infinite body around a patch of this size \[m\] that may slip along z, with cells of `size`; the planes y = 0 and
/// z = 0 are those of symmetry and antisymmetry. Three cells become one beyond each of the distances \[m\].
fn quarter(patch: f64, size: f64, wide: f64, beyond: &[f64]) -> Result<Plan, CaseError> {
    let zone =
        |from: f64, to: f64| format!("{{ size = {size:?}, from = {from:?}, to = {to:?}, ratio = 1.6 }}");
    let near = 2.0 * size;
    let cells = |side: &str, from: f64, to: f64| {
        let spacing = format!("spacing = [{}, {}, {}]", zone(from, to), zone(0.0, patch), zone(0.0, patch));
        let coarser = format!("coarser = {{ from = \"{side}\", beyond = {beyond:?} }}");
        if beyond.is_empty() { spacing } else { format!("{spacing}, {coarser}") }
    };
    let (left, right) = (cells("right", -near, 0.0), cells("left", 0.0, near));
    let far = "{ set = \"L.left\", x = 0, y = 0, z = 0 }, { set = \"R.right\", x = 0, y = 0, z = 0 }, ";
    Blocks {
        kinematics: "3d",
        moduli: [ROCK; 2],
        wide,
        ends: &[[0.0, wide]; 2],
        cells: [&left, &right],
        fault: &format!(
            "rake = [0, 0, 1]\ncreep = {{ outside = {{ y = {{ to = {patch:?} }}, z = {{ to = {patch:?} }} }}, rate = 0.0 }}"
        ),
        conditions: &(far.to_string() + &on(&["bottom"], "y = 0") + &on(&["back"], "x = 0, y = 0")),
        rest: "",
        duration: "1 yr",
    }
    .plan()
}

/// Width of the Gaussian \[m\]: slip exp(-r²/2s²).
const WIDTH: f64 = 1000.0;

/// Traction at a point of the Gaussian, from the stiffness of each wave vector \[Pa/m\].
fn waves(y: f64, z: f64) -> f64 {
    // The integrand is even and smooth in k and periodic in the angle: equal steps converge faster than any power.
    let (steps, angles, most) = (300, 128, 9.0);
    let dk = most / f64::from(steps);
    let mut sum = 0.0;
    for i in 1..steps {
        let k = f64::from(i) * dk;
        let shell = k * k * (-0.5 * k * k).exp();
        for j in 0..angles {
            let (s, c) = (TAU * f64::from(j) / f64::from(angles)).sin_cos();
            sum += shell * (s * s + c * c / (1.0 - POISSON)) * (k / WIDTH * (y * s + z * c)).cos();
        }
    }
    -ROCK / (2.0 * WIDTH) * sum * dk / f64::from(angles)
}

/// Draws tractions along the two axes of the Gaussian on those from wave vectors.
fn overlay(ledger: &mut Ledger, plan: &Plan, found: &[f64]) {
    let mut diagram =
        Plot::xy("Tractions of a Gaussian of slip", "distance over s [-]", "shear traction [MPa]");
    for (name, along, other) in [("across the slip", 1, 2), ("along the slip", 2, 1)] {
        let on = |p: &usize| {
            plan.points[*p].at[other].abs() < 1e-6 * WIDTH && plan.points[*p].at[along] < 2.5 * WIDTH
        };
        let at = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
            (0..found.len()).filter(on).map(|p| (plan.points[p].at[along] / WIDTH, value(p) / 1e6)).collect()
        };
        let exact = at(&|p| waves(plan.points[p].at[1], plan.points[p].at[2]));
        diagram = diagram
            .series(Series::line(format!("{name}, wave vectors"), &exact))
            .series(Series::points(format!("{name}, this code"), &at(&|p| found[p])));
    }
    ledger.plot(diagram);
}

/// Largest error of the tractions of a Gaussian of slip over the traction in its middle, with cells of this part of its width, as
/// they are or joined with the distance from the plane; and the cost.
fn error(ledger: &mut Ledger, part: f64, joined: bool) -> Result<(f64, Cost), CaseError> {
    let size = WIDTH / part;
    // Farther out the box has too few layers.
    let most = if joined { 6.0 * WIDTH } else { 0.0 };
    let beyond: Vec<f64> = [4.0 * size, 16.0 * size].into_iter().filter(|&x| x < most).collect();
    let (plan, cost) = Cost::measure(|| quarter(4.0 * WIDTH, size, 14.0 * WIDTH, &beyond));
    let plan = plan?;
    let slip: Vec<f64> = plan
        .points
        .iter()
        .map(|p| (-0.5 * (p.at[1].powi(2) + p.at[2].powi(2)) / WIDTH.powi(2)).exp())
        .collect();
    let found = plan.problem.fault.operator.shear_of(&slip);
    let near = plan.points.iter().zip(&found).filter(|(p, _)| p.at[1].hypot(p.at[2]) < 2.5 * WIDTH);
    let errors = near.map(|(p, t)| (t - waves(p.at[1], p.at[2])).abs());
    let error = errors.fold(0.0, f64::max) / middle().abs();
    if part > 2.0 && !joined {
        overlay(ledger, &plan, &found);
    }
    Ok((error, cost.count("points", slip.len() as f64)))
}

/// Traction in the middle of a Gaussian of slip in closed form \[Pa/m\].
fn middle() -> f64 {
    -ROCK / (4.0 * WIDTH) * (1.0 + 1.0 / (1.0 - POISSON)) * FRAC_PI_2.sqrt()
}

/// Tractions of a Gaussian of slip.
fn gaussian(ledger: &mut Ledger) -> Result<(), CaseError> {
    ledger
        .claim("traction in the middle of a Gaussian by wave vectors against its closed form, relative difference")
        .value((waves(0.0, 0.0) / middle() - 1.0).abs())
        .at_most(1e-12)
        .evidence(Evidence::Exact, "-G/(4 s) (1 + 1/(1 - nu)) sqrt(pi/2)")
        .because("equal steps on a smooth even function that has ended: rounding")
        .why_not_tighter("rounding depends on the number of steps")
        .covers(&[Capability::FaultCycles])
        .record();
    for (joined, cells) in [(false, ""), (true, ", cells joined three to one from four and sixteen cells on")]
    {
        let (mut levels, mut last) = (Vec::new(), None);
        for part in [1.0, 2.0, 4.0] {
            let (error, cost) = error(ledger, part, joined)?;
            levels.push((WIDTH / part, error));
            last = Some(cost);
        }
        ledger
            .order(format!("shear tractions of a Gaussian of slip on a plane in space{cells}, largest error over that in the middle"))
            .levels(&levels)
            .expected(1.5)
            .within(0.2)
            .evidence(Evidence::SemiAnalytic, "stiffness of a plane against harmonic slip, G k/2 across and G k/2(1 - nu) along it")
            .because("second order of trilinear cells and nodal areas, and what does not fall: cells that grow by 1.6 away from the plane, the box")
            .finest(2e-2, "3 (h/s)^2/12 = 1.6 % for averages over cells of s/4")
            .covers(&[Capability::FaultCycles])
            .cost(&last.ok_or("no level")?)
            .record();
    }
    Ok(())
}

/// Potency of a circular crack under uniform stress on cells of this size over its radius, relative error.
fn crack(size: f64) -> Result<f64, CaseError> {
    let plan = quarter(1.25, size, 12.0, &[])?;
    let all = matrix(&plan, false);
    let inside: Vec<usize> =
        (0..plan.points.len()).filter(|&p| plan.points[p].at[1].hypot(plan.points[p].at[2]) < 1.0).collect();
    let n = inside.len();
    let part = DMatrix::from_fn(n, n, |i, j| all[(inside[i], inside[j])]);
    let slip = part.lu().solve(&DVector::repeat(n, -1.0)).ok_or("the operator is singular")?;
    let potency: f64 = inside.iter().zip(slip.iter()).map(|(&p, s)| plan.points[p].area * s).sum();
    let exact = 8.0 * (1.0 - POISSON) / (PI * (2.0 - POISSON)) / ROCK * TAU / 3.0;
    Ok((4.0 * potency / exact - 1.0).abs())
}

/// The circular shear crack.
fn penny(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (errors, cost) = Cost::measure(|| {
        [4.0, 8.0, 16.0].into_iter().map(|parts| crack(1.0 / parts)).collect::<Result<Vec<_>, _>>()
    });
    let errors = errors?;
    let exact = "Eshelby: slip 8 (1 - nu)/(pi (2 - nu)) dtau/G sqrt(a^2 - r^2), all along the stress";
    let over_size = errors.iter().zip([4.0, 8.0, 16.0]).map(|(e, parts)| e * parts).fold(0.0, f64::max);
    for (name, value, bound) in [
        ("relative error over h/a, the largest of h/a = 1/4, 1/8, 1/16", over_size, 0.3),
        ("relative error at h/a = 1/16", errors[2], 0.02),
    ] {
        ledger
            .claim(format!("potency of a circular shear crack under uniform stress: {name}"))
            .value(value)
            .at_most(bound)
            .evidence(Evidence::Exact, exact)
            .because("potency goes with the cube of the radius, which cells that follow the circle in steps know to a tenth of their size")
            .why_not_tighter("the steps of a circle come and go with the size of cells: the error is of first order and not monotonic")
            .covers(&[Capability::FaultCycles])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Two 3D blocks through a cycle against antiplane motion.
fn blocks(ledger: &mut Ledger) -> Result<(), CaseError> {
    let rest = "log_rate_tolerance = 1e-7\n[events]\nabove = \"1e-4 m/s\"\nstop_after = 1\n";
    let drawn = |more: &str| {
        format!(
            "{{ set = \"L.left\", z = {{ rate = -0.5e-9 }}{more} }}, {{ set = \"R.right\", z = {{ rate = 0.5e-9 }}{more} }}, "
        )
    };
    let plane = Blocks {
        kinematics: "antiplane",
        moduli: [ROCK; 2],
        wide: 1e3,
        ends: &[[0.0, 1e3]],
        cells: ["divisions = [1, 1]"; 2],
        fault: "damping = \"radiation\"",
        conditions: &drawn(""),
        rest,
        duration: "1000 yr",
    };
    let solid = Blocks {
        kinematics: "3d",
        ends: &[[0.0, 1e3], [0.0, 2e3]],
        cells: ["divisions = [1, 1, 2]"; 2],
        // The component of the rake normal to the fault and its length do not matter.
        fault: "damping = \"radiation\"\nrake = [0.3, 0, 2]",
        conditions: &(drawn(", x = 0, y = 0") + &on(&["back", "front"], "x = 0, y = 0")),
        ..plane
    };
    let (plane, solid) = (plane.plan()?, solid.plan()?);
    let first = |plan: &Plan| seas::found(plan, &plan.problem.settings, |_| {});
    let (a, b) = (first(&plane)?, first(&solid)?);
    let moment = |plan: &Plan, slip: &[f64]| -> f64 {
        slip.iter().zip(&plan.points).map(|(s, p)| s * p.area * p.shear_modulus).sum()
    };
    let moments = (
        moment(&plane, a.events[0].details.slip.component(0)),
        moment(&solid, b.events[0].details.slip.component(0)),
    );
    for (name, value, bound) in [
        ("onset", b.onsets[0] / a.onsets[0], 1e-6),
        ("slip", b.events[0].details.slip.component(0)[0] / a.events[0].details.slip.component(0)[0], 1e-4),
        ("moment over that per metre times 2 km", moments.1 / (2e3 * moments.0), 1e-4),
    ] {
        ledger
            .claim(format!("first event of two blocks in space against antiplane motion: {name}, relative difference"))
            .value((value - 1.0).abs())
            .at_most(bound)
            .evidence(Evidence::Exact, "simple shear, the same in both")
            .because("the tolerance 1e-7 of ln V gathered over a cycle; slip between the thresholds follows within a step")
            .why_not_tighter("tolerances of steps add up by chance; here most cancel")
            .covers(&[Capability::FaultCycles, Capability::Events])
            .cost(&b.cost)
            .record();
    }
    Ok(())
}
