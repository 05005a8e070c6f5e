//! Tractions caused by slip in plane strain: a crack, a fault that slips uniformly, and dipping faults below a free surface.

use crate::cases::{body_plots, dislocation, seas};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_plan::faults::Plan;
use dislocation::Stress;
use nalgebra::{Complex, DMatrix, DVector};

/// See the README.
pub const CASE: Case = Case {
    name: "fault_operator",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain],
    quick: true,
    run,
};

/// Cell size of the faults from the surface \[m\].
const SIZE: f64 = 500.0;
const POISSON: f64 = 0.25;
const SHEAR_MODULUS: f64 = 32e9;
/// Half length of the crack \[m\].
const A: f64 = 1000.0;
/// Depth of the crack's middle and half size of the box over the half length: the free surface and the sides change slip by a
/// fraction of about 1/FAR².
const FAR: f64 = 200.0;

/// A scene with one fault; `conditions` are those of the sides.
fn scene(mesh: &str, fault: &str, conditions: &str) -> String {
    format!(
        r#"
schema = 1
title = "fault operator"
kinematics = "plane-strain"
[materials.rock]
young = "80 GPa"
poisson = {POISSON}
[bodies.crust]
material = "rock"
mesh.fault = {{ {mesh}, growth = 1.25, element = "quad9" }}
[faults.main]
minus = "crust.fault.minus"
plus = "crust.fault.plus"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal = "50 MPa"
rate = "1e-9 m/s"
{fault}
[[stages]]
name = "still"
duration = "1 yr"
conditions = [{conditions}]
[time]
stepper = "fault-ode"
"#
    )
}

const STILL: &str =
    r#"{ set = "crust.left", x = "0 m", y = "0 m" }, { set = "crust.right", x = "0 m", y = "0 m" }"#;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    crack(ledger)?;
    plates(ledger)?;
    surface(ledger)
}

/// Matrix of the operator, column by column, of shear or of normal tractions.
pub(crate) fn matrix(plan: &Plan, normal: bool) -> DMatrix<f64> {
    let n = plan.points.len();
    let (operator, mut unit) = (&plan.problem.fault.operator, vec![0.0; n]);
    let mut all = DMatrix::zeros(n, n);
    for k in 0..n {
        unit[k] = 1.0;
        let column = if normal { operator.normal_of(&unit) } else { operator.shear_of(&unit) };
        all.column_mut(k).copy_from_slice(&column);
        unit[k] = 0.0;
    }
    all
}

/// A buried crack of dip 60 degrees with cells of this size \[m\]; `tip`, if given, is their size at its tips.
fn cracked(size: f64, tip: Option<f64>) -> Result<Plan, CaseError> {
    let (c, s) = (A / 2.0, A * 0.75_f64.sqrt());
    let (depth, box_) = (FAR * A, 2.0 * FAR * A);
    let spacing = match tip {
        None => format!("\"{size} m\""),
        Some(tip) => {
            format!("[[\"0 m\", \"{tip} m\"], [\"{A} m\", \"{size} m\"], [\"{} m\", \"{tip} m\"]]", 2.0 * A)
        }
    };
    let mesh = format!(
        "trace = [[{}, {}], [{}, {}]], spacing = {spacing}, min = [{}, {}], max = [{box_}, 0.0]",
        -c,
        s - depth,
        c,
        -s - depth,
        -box_,
        -box_
    );
    seas::plan(&scene(&mesh, "", STILL))
}

/// Slip under a uniform drop of shear traction against 2 (1 - nu) dtau/G sqrt(a^2 - x^2).
struct Slip {
    /// Error of the slip in the middle.
    middle: f64,
    /// Largest error over the slip in the middle.
    largest: f64,
    cost: Cost,
    /// Largest change of normal traction over the change of shear traction.
    normal: f64,
    /// Distance from the upper tip over a, slip and exact slip over the exact slip in the middle.
    profile: Vec<[f64; 3]>,
}

fn slip(plan: &Plan) -> Result<Slip, CaseError> {
    let (found, cost) = Cost::measure(|| -> Result<(DVector<f64>, f64), CaseError> {
        let n = plan.points.len();
        let shear = matrix(plan, false);
        let slip = shear.lu().solve(&DVector::repeat(n, -1.0)).ok_or("the operator is singular")?;
        let change = if plan.problem.fault.operator.couples_normal() {
            (matrix(plan, true) * &slip).amax()
        } else {
            0.0
        };
        Ok((slip, change))
    });
    let (slip, normal) = found?;
    let peak = 2.0 * (1.0 - POISSON) * A / SHEAR_MODULUS;
    let exact = |along: f64| peak * (1.0 - ((along - A) / A).powi(2)).max(0.0).sqrt();
    let errors: Vec<f64> =
        plan.points.iter().zip(slip.iter()).map(|(p, s)| (s - exact(p.along)) / peak).collect();
    let profile =
        plan.points.iter().zip(slip.iter()).map(|(p, s)| [p.along / A, s / peak, exact(p.along) / peak]);
    let middle = (0..errors.len())
        .min_by(|&i, &j| {
            let off = |k: usize| (plan.points[k].along - A).abs();
            off(i).total_cmp(&off(j))
        })
        .ok_or("no points")?;
    let largest = errors.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
    Ok(Slip {
        middle: errors[middle].abs(),
        largest,
        normal,
        profile: profile.collect(),
        cost: cost.count("points", errors.len() as f64),
    })
}

fn crack(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = "2 (1 - nu) dtau/G sqrt(a^2 - x^2), a crack in the plane under uniform stress";
    let mut levels = Vec::new();
    let mut last = None;
    for cells in [10, 20, 40, 80] {
        let size = 2.0 * A / f64::from(cells);
        let found = slip(&cracked(size, None)?)?;
        levels.push((size, found.middle));
        last = Some(found);
    }
    let last = last.ok_or("no level")?;
    ledger
        .order("slip in the middle of a crack, uniform cells")
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .evidence(Evidence::Exact, exact)
        .because("the square root at the tips, which uniform cells of any order miss by O(h)")
        .finest(
            0.6 * 2.0 / 80.0,
            "cells of 1/40 of the half length; the crack looks longer by a part of a cell at each tip",
        )
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&last.cost)
        .record();
    ledger
        .claim("change of normal over fall of shear traction on a plane crack, 80 cells")
        .value(last.normal)
        .at_most(0.1 * 2.0 / 80.0)
        .evidence(Evidence::Exact, "slip on a plane in an infinite body changes no normal traction there")
        .because("a tenth of h/a, as far as slip itself is off at the tips: cells of a fault that is not upright differ on its sides")
        .why_not_tighter("the largest change sits at the tips and does not fall evenly with the size of cells")
        .covers(&[Capability::FaultCycles])
        .cost(&last.cost)
        .record();
    let tip = A / 1000.0;
    let graded = slip(&cracked(A / 10.0, Some(tip))?)?;
    let curve = |which: usize| graded.profile.iter().map(|row| (row[0], row[which])).collect::<Vec<_>>();
    ledger.plot(
        Plot::xy(
            "Slip of the crack",
            "distance from the upper tip over a [-]",
            "slip over that in the middle [-]",
        )
        .series(Series::line("closed form", &curve(2)))
        .series(Series::points("graded cells", &body_plots::apart(&curve(1)))),
    );
    let cells = "cells from a/1000 at the tips to a/10";
    ledger
        .claim(format!("slip in the middle of the crack, relative error, {cells}"))
        .value(graded.middle)
        .at_most(0.002)
        .evidence(Evidence::Exact, exact)
        .because("0.1 h/a with h at the tips leaves 0.01 %; the larger cells with their lumped interface mass leave 0.1 %")
        .why_not_tighter("both estimates have factors that are not known, and may cancel as here")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&graded.cost)
        .record();
    ledger
        .claim(format!("largest error of slip over the slip in the middle, {cells}"))
        .value(graded.largest)
        .at_most(0.2 * (tip / A).sqrt())
        .evidence(Evidence::Exact, exact)
        .because("at the tips slip changes within a cell by sqrt(2 h/a) of that in the middle; a seventh of it is missed on uniform cells")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&graded.cost)
        .record();
    Ok(())
}

/// A scene with a fault of this dip \[degrees\] with cells of this size \[m\]. It runs from the surface through the box and
/// creeps below 40 km.
pub(crate) fn through(dip: f64, size: f64) -> String {
    let (s, c) = dip.to_radians().sin_cos();
    let (deep, wide) = (1e6, 1e6);
    let bottom = deep * c / s;
    let mesh = format!(
        "trace = [[0.0, 0.0], [{}, {}], [{bottom}, {}]], spacing = [[\"0 km\", \"{size} m\"], [\"40 km\", \"{size} m\"], [\"{} m\", \"200 km\"]], min = [{}, {}], max = [{}, 0.0]",
        40e3 * c,
        -40e3 * s,
        -deep,
        deep / s,
        -wide,
        -deep,
        wide + bottom
    );
    // The plus side slides up-dip past the minus side.
    let half = 0.5e-9;
    let (x, y) = (-half * c, half * s);
    let sides = format!(
        "{{ set = \"crust.left\", x = {{ rate = {} }}, y = {{ rate = {} }} }}, {{ set = \"crust.right\", x = {{ rate = {x} }}, y = {{ rate = {y} }} }}",
        -x, -y
    );
    scene(&mesh, "creep = { beyond = \"40 km\", rate = \"1e-9 m/s\" }", &sides)
}

/// Claims that plates in rigid motion along a uniformly slipping fault are free of stress.
fn plates(ledger: &mut Ledger) -> Result<(), CaseError> {
    for dip in [90.0, 60.0, 30.0] {
        let (plan, cost) = Cost::measure(|| seas::plan(&through(dip, SIZE)));
        let plan = plan?;
        let n = plan.points.len();
        let couples = plan.problem.fault.operator.couples_normal();
        let (mut shear, mut normal) = plan.problem.loading.rates(1.0, n, couples);
        let scale = shear.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let exerted = plan.problem.fault.operator.shear_of(&vec![1e-9; n]);
        shear.iter_mut().zip(&exerted).for_each(|(s, e)| *s += e);
        if couples {
            let exerted = plan.problem.fault.operator.normal_of(&vec![1e-9; n]);
            normal.iter_mut().zip(&exerted).for_each(|(s, e)| *s += e);
        }
        let largest = shear.iter().chain(&normal).fold(0.0_f64, |m, v| m.max(v.abs()));
        ledger
            .claim(format!("tractions where the whole fault slips as the plates move, over those of the loads alone, dip {dip}"))
            .value(largest / scale)
            .at_most(1e-7)
            .evidence(Evidence::Exact, "a rigid motion of both sides")
            .because("rounding of a condensed stiffness of 1e5 unknowns whose cells differ 400 times in size")
            .why_not_tighter("rounding depends on the order of elimination; a border that holds the fault adds 1e-3")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Shear and normal tractions due to `slip` on a plane of this dip from the surface, from pieces of constant slip of length
/// `piece` \[m\] with dislocations at their ends, at the midpoint of a piece.
fn tractions(dip: f64, slip: impl Fn(f64) -> f64, piece: f64, deepest: f64, at: f64) -> (f64, f64) {
    let (s, c) = dip.to_radians().sin_cos();
    let point = |along: f64| Complex::new(along * c, -along * s);
    let mut stress = Stress::default();
    // The point `at` is the midpoint of a piece, half a piece away from the dislocations at its ends.
    let shift = at - piece * ((at / piece).floor() + 0.5);
    let pieces = (deepest / piece).ceil() as usize + 1;
    for k in 0..=pieces {
        // Slip is constant between two ends; the first piece begins at the surface.
        let (top, bottom) = ((k as f64 * piece + shift).max(0.0), (k as f64 + 1.0) * piece + shift);
        if bottom <= 0.0 {
            continue;
        }
        // The plus side, above the fault, slides up-dip; a circuit about the upper end leads from plus to minus.
        let b = Complex::new(c, -s) * slip(0.5 * (top + bottom));
        let z = point(at);
        if top > 0.0 {
            dislocation::add(&mut stress, z, point(top), b, SHEAR_MODULUS, POISSON);
        }
        dislocation::add(&mut stress, z, point(bottom), -b, SHEAR_MODULUS, POISSON);
    }
    stress.on([-c, s], [s, c])
}

/// Down-dip extent of slip \[m\].
const DEEPEST: f64 = 30e3;
/// Length of the pieces of the reference \[m\]: the error is of second order in their length over the length scale of slip.
const PIECE: f64 = 25.0;
/// Tractions are compared below this distance from the surface \[m\]: nodal tractions are averages over the adjacent cells, the
/// reference is pointwise.
const BELOW: f64 = 2000.0;

/// A name and slip \[m\] against distance from the surface \[m\].
type Slips = (&'static str, fn(f64) -> f64);

/// Slip that reaches the surface, and slip that does not.
fn slips() -> [Slips; 2] {
    [
        ("to the surface", |x| (1.0 - (x / DEEPEST).powi(2)).max(0.0).powi(3)),
        ("at depth", |x| (1.0 - ((x - 18e3) / 12e3).powi(2)).max(0.0).powi(3)),
    ]
}

/// Largest error of shear and of normal tractions over the largest shear traction.
fn errors(plan: &Plan, dip: f64, slip: impl Fn(f64) -> f64 + Copy) -> [f64; 2] {
    let values: Vec<f64> = plan.points.iter().map(|p| slip(p.along)).collect();
    let shear = plan.problem.fault.operator.shear_of(&values);
    let normal = plan.problem.fault.operator.normal_of(&values);
    let (mut worst, mut scale) = ([0.0_f64; 2], 0.0_f64);
    for (p, point) in plan.points.iter().enumerate().filter(|(_, p)| p.along > BELOW && p.along < DEEPEST) {
        let (t, f) = tractions(dip, slip, PIECE, DEEPEST, point.along);
        scale = scale.max(t.abs());
        worst = [worst[0].max((shear[p] - t).abs()), worst[1].max((normal[p] - f).abs())];
    }
    worst.map(|w| w / scale)
}

/// Draws the tractions of a slip on those of dislocations.
fn overlay(ledger: &mut Ledger, plan: &Plan, dip: f64, (name, slip): Slips) {
    let values: Vec<f64> = plan.points.iter().map(|p| slip(p.along)).collect();
    let operator = &plan.problem.fault.operator;
    let found = [operator.shear_of(&values), operator.normal_of(&values)];
    let near = |p: &usize| plan.points[*p].along > BELOW && plan.points[*p].along < DEEPEST;
    let points: Vec<usize> = (0..values.len()).filter(near).collect();
    let exact = points.iter().map(|&p| tractions(dip, slip, PIECE, DEEPEST, plan.points[p].along));
    let exact: Vec<(f64, f64)> = exact.collect();
    let at = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        points.iter().enumerate().map(|(k, &p)| (plan.points[p].along / 1e3, value(k) / 1e6)).collect()
    };
    ledger.plot(
        Plot::xy(
            format!("Slip {name}, dip {dip} degrees"),
            "distance from the surface [km]",
            "traction [MPa]",
        )
        .series(Series::line("shear, dislocations", &at(&|k| exact[k].0)))
        .series(Series::points("shear, this code", &body_plots::apart(&at(&|k| found[0][points[k]]))))
        .series(Series::line("normal, dislocations", &at(&|k| exact[k].1)))
        .series(Series::points("normal, this code", &body_plots::apart(&at(&|k| found[1][points[k]])))),
    );
}

const REFERENCE: &str = "edge dislocations below a free surface by complex potentials, pieces of 25 m";

/// Dipping faults below a free surface against dislocations.
fn surface(ledger: &mut Ledger) -> Result<(), CaseError> {
    for dip in [90.0, 60.0, 30.0] {
        let (plan, cost) = Cost::measure(|| seas::plan(&through(dip, SIZE)));
        let plan = plan?;
        if dip < 45.0 {
            overlay(ledger, &plan, dip, slips()[1]);
        }
        for (name, slip) in slips() {
            for (kind, error) in ["shear", "normal"].into_iter().zip(errors(&plan, dip, slip)) {
                ledger
                    .claim(format!(
                        "{kind} tractions of slip {name}, dip {dip}, cells of 500 m: largest error over the largest shear traction"
                    ))
                    .value(error)
                    .at_most(if dip < 45.0 { 1.5e-2 } else { 4e-3 })
                    .evidence(Evidence::SemiAnalytic, REFERENCE)
                    .because(
                        "(500 m/12 km)^2 = 0.2 % for the lumped interface mass over slip of that scale, twice for the second derivative;                          at 30 degrees cells are sheared by 60 degrees and have errors several times larger",
                    )
                    .why_not_tighter("an estimate for slip of that scale, of whose factor the shape of slip decides")
                    .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
                    .cost(&cost)
                    .record();
            }
        }
    }
    let (name, slip) = slips()[1];
    for dip in [60.0, 30.0] {
        let mut levels = Vec::new();
        let mut total = None;
        for size in [2000.0, 1000.0, SIZE] {
            let (plan, cost) = Cost::measure(|| seas::plan(&through(dip, size)));
            levels.push((size, errors(&plan?, dip, slip)[0]));
            total = Some(cost);
        }
        let order = ledger
            .order(format!("shear tractions of slip {name}, dip {dip}"))
            .levels(&levels)
            .expected(2.0)
            .within(0.3)
            .or_better()
            .evidence(Evidence::SemiAnalytic, REFERENCE)
            .because("lumped interface mass: tractions are averages over the cells around a node")
            .finest(if dip < 45.0 { 1.5e-2 } else { 4e-3 }, "as above")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain]);
        match &total {
            Some(cost) => order.cost(cost).record(),
            None => order.record(),
        }
    }
    Ok(())
}
