//! Thick-walled cylinder under internal pressure, from first yield to the limit load.

use super::body::{self, Body, Entry, Work};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::block::von_mises;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::mesh::Mesh;
use asperity_fem::nonlinear::{Kinematics, Model};
use std::f64::consts::{FRAC_PI_2, TAU};

/// See the README.
pub const CASE: Case = Case {
    name: "elastic_plastic_cylinder",
    readme: include_str!("README.md"),
    covers: &[Capability::Plasticity],
    quick: true,
    run,
};

const INNER: f64 = 100.0;
const OUTER: f64 = 200.0;
const YOUNG: f64 = 210.0;
const POISSON: f64 = 0.3;
const YIELD: f64 = 0.24;
/// Pressures \[GPa\] and outer displacements \[mm\] of the reference.
const REFERENCE: [(f64, f64); 5] =
    [(0.10, 0.057_777_8), (0.12, 0.070_420_4), (0.14, 0.087_287_2), (0.16, 0.111_644_7), (0.18, 0.154_017)];
/// Relative uncertainty of the reference.
const UNCERTAINTY: f64 = 1e-5;
const SOURCE: &str = "radial finite elements of another program, 1e-5 relative (Hill's formula beside)";
/// Forces are a few GPa mm; rounding of stiffness times displacement leaves 1e-13.
const BALANCED: f64 = 1e-10;
/// The same for the limit load, where displacements are 6 mm and stiffness entries 1e6.
const BALANCED_FAR: f64 = 1e-8;
/// Height of the slice \[mm\].
const HEIGHT: f64 = 4.0;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    first_yield(ledger)?;
    displacements(ledger)?;
    meshes(ledger)?;
    load_steps(ledger)?;
    limit_load(ledger)
}

/// A ring in the plane or a slice of a body of revolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Ring,
    Slice,
}

impl Shape {
    fn idealisation(self) -> Idealisation {
        if self == Shape::Ring { Idealisation::PlaneStrain } else { Idealisation::Axisymmetric }
    }

    fn mesh(self, kind: ElementKind, n: usize) -> Result<Mesh<2>, CaseError> {
        match self {
            Shape::Ring => body::ring(kind, [INNER, OUTER], [n, n]),
            Shape::Slice => body::grid(kind, [INNER, 0.0], [OUTER, HEIGHT], [n, 1]),
        }
    }

    /// The cylinder with symmetry conditions; the inner displacement is prescribed if `inner`.
    fn body(self, kind: ElementKind, n: usize, inner: bool) -> Result<Body<2>, CaseError> {
        let mesh = self.mesh(kind, n)?;
        let material = body::j2(YOUNG, POISSON, Hardening::perfect(YIELD)?)?;
        let options: Model = body::averaged(body::model(material, self.idealisation(), Kinematics::Small));
        let mut fixed: Vec<usize> = body::side(&mesh, "bottom")?.iter().map(|n| 2 * n + 1).collect();
        let across = usize::from(self == Shape::Slice);
        fixed.extend(body::side(&mesh, "top")?.iter().map(|n| 2 * n + across));
        if inner {
            fixed.extend(body::side(&mesh, "left")?.iter().flat_map(|n| [2 * n, 2 * n + 1]));
        }
        Body::new(mesh, options, &fixed)
    }
}

/// Pressure at which the Mises stress of Lamé's solution at radius `r` reaches the yield stress.
fn yields_at(r: f64) -> f64 {
    // Stresses of a unit pressure: A - B/r², A + B/r², 2 nu A.
    let a = INNER * INNER / (OUTER * OUTER - INNER * INNER);
    let b = a * OUTER * OUTER / (r * r);
    YIELD / (3.0 * b * b + (a * (1.0 - 2.0 * POISSON)).powi(2)).sqrt()
}

/// Outer displacement of Hill's solution at a pressure.
fn hill(p: f64) -> f64 {
    let y = 2.0 * YIELD / 3.0_f64.sqrt();
    let flexible = (1.0 - POISSON * POISSON) / YOUNG;
    let ratio = OUTER / INNER;
    let elastic = 0.5 * y * (1.0 - 1.0 / (ratio * ratio));
    if p <= elastic {
        return 2.0 * p * OUTER * flexible / (ratio * ratio - 1.0);
    }
    let front =
        body::root(INNER, OUTER, |c| y * ((c / INNER).ln() + 0.5 * (1.0 - c * c / (OUTER * OUTER))) - p);
    y * front * front * flexible / OUTER
}

fn scaled(load: &[Entry], p: f64) -> Vec<Entry> {
    load.iter().map(|&(dof, f)| (dof, p * f)).collect()
}

/// Outer displacements at the reference pressures, each interval in `steps` load steps, and the final body.
fn pressed(
    shape: Shape,
    kind: ElementKind,
    n: usize,
    steps: usize,
) -> Result<(Vec<f64>, Body<2>), CaseError> {
    let mut body = shape.body(kind, n, false)?;
    let load = body::unit_pressure(&body.mesh, "left", shape.idealisation())?;
    // A node on the axis of x: its displacement is radial.
    let outer = body::side(&body.mesh, "right")?[0];
    let (mut found, mut from) = (Vec::new(), 0.0);
    for (p, _) in REFERENCE {
        for k in 1..=steps {
            let now = from + (p - from) * k as f64 / steps as f64;
            body.implicit(&[], &scaled(&load, now), 1.0, BALANCED, None)?;
        }
        from = p;
        found.push(body.u[2 * outer]);
    }
    Ok((found, body))
}

fn first_yield(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = yields_at(INNER);
    let (mut levels, mut cost, mut at_point) = (Vec::new(), Cost::default(), 0.0);
    for n in [8, 16, 32, 64] {
        let mut body = Shape::Slice.body(ElementKind::Quad9, n, false)?;
        let load = body::unit_pressure(&body.mesh, "left", Idealisation::Axisymmetric)?;
        let (step, c) = Cost::measure(|| body.forward(&[], &scaled(&load, 0.2), 1.0));
        let found = 0.2 * step?.fraction;
        let first = body::points(&body.mesh, Idealisation::Axisymmetric)[0][0];
        levels.push(((OUTER - INNER) / n as f64, (found / exact - 1.0).abs()));
        (cost, at_point) = (c.counts(&body.work), found / yields_at(first) - 1.0);
    }
    ledger
        .claim("pressure at first yield by the limit r1, relative to Lame at the first quadrature point, 64 cells")
        .value(at_point.abs())
        .at_most(5e-5)
        .evidence(Evidence::Exact, "Lame's stresses in the Mises condition at the radius of the point")
        .because("strains of parabolas err by u''' h^2 (3 xi^2 - 1)/24 at the outer points: 0.2 (h/a)^2 = 5e-5")
        .why_not_tighter("averaged dilatation takes away a part of it")
        .covers(&[Capability::Plasticity, Capability::BodyLimits])
        .cost(&cost)
        .record();
    ledger
        .order("pressure at first yield against that at the inner radius, relative, in the mesh")
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .finest(4.4e-3, "the first point lies 0.1127 h = 0.18 mm inside, where stresses are 2 x 0.18/100 smaller, plus a quarter of that")
        .evidence(Evidence::Exact, "0.1037503 GPa: Lame with the Mises condition at r = a")
        .because("yield is judged at quadrature points, whose distance from the surface is proportional to h")
        .covers(&[Capability::Plasticity, Capability::BodyLimits])
        .cost(&cost)
        .record();
    Ok(())
}

fn displacements(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (outcome, cost) = Cost::measure(|| pressed(Shape::Slice, ElementKind::Quad9, 64, 10));
    let (slice, body) = outcome?;
    let cost = cost.counts(&body.work);
    let lame = hill(REFERENCE[0].0);
    ledger
        .claim("outer displacement below yield, P = 0.10 GPa, slice of 64 quad9")
        .unit("mm")
        .value(slice[0])
        .equals(lame)
        .relative(1e-8)
        .evidence(Evidence::Exact, "Lame")
        .because(
            "functionals of quad9 err as (h/a)^4 = 6e-8, times 1/180 of interpolation by parabolas and more",
        )
        .why_not_tighter("the estimate is a power, without its constant")
        .cost(&cost)
        .record();
    judge(ledger, "slice of 64 quad9, 10 load steps of 0.002 GPa each", &slice, 5e-5, &cost);
    let (outcome, cost) = Cost::measure(|| pressed(Shape::Ring, ElementKind::Quad9, 16, 10));
    let (ring, ring_body) = outcome?;
    let cost = cost.counts(&ring_body.work);
    judge(ledger, "quarter ring of 16 x 16 quad9, 10 load steps of 0.002 GPa each", &ring, 2e-4, &cost);
    let (same, _) = pressed(Shape::Slice, ElementKind::Quad9, 16, 10)?;
    ledger
        .claim("ring against slice, 16 quad9 along the radius, the same load steps: outer displacement at five pressures")
        .unit("mm")
        .values(&ring)
        .equals_each(&same)
        .relative(1e-5)
        .evidence(Evidence::ConvergedSelf, "the same problem in the other idealisation: other mesh, quadrature, dilatation and strains")
        .because("the error along the radius is the same in both; arcs of pi/32 as parabolas err by (pi/32)^4/10")
        .why_not_tighter("the estimate is a power with a guessed constant")
        .cost(&cost)
        .record();
    let stresses = body.block.stress_at_points();
    let outside = stresses.iter().map(|s| von_mises(s) / YIELD - 1.0).fold(0.0, f64::max);
    ledger
        .claim(
            "largest Mises stress at P = 0.18 GPa above the yield stress, relative, all points of the slice",
        )
        .value(outside)
        .at_most(1e-13)
        .evidence(Evidence::Exact, "a returned stress lies on the yield surface")
        .because("a return without hardening is one division")
        .why_not_tighter("rounding of sums of six squares")
        .record();
    ledger.table(
        "Outer displacement [mm]",
        &["P [GPa]", "slice", "ring", "reference (J2)", "Hill (Tresca)"],
        (0..REFERENCE.len()).map(|k| {
            let (p, reference) = REFERENCE[k];
            [p, slice[k], ring[k], reference, hill(p)].map(|x| format!("{x:.7}"))
        }),
    );
    profiles(ledger, &body, &stresses);
    Ok(())
}

fn judge(ledger: &mut Ledger, what: &str, found: &[f64], bound: f64, cost: &Cost) {
    for ((p, reference), u) in REFERENCE.into_iter().zip(found).skip(1) {
        ledger
            .claim(format!("outer displacement at P = {p:.2} GPa, {what}"))
            .unit("mm")
            .value(*u)
            .equals(reference)
            .uncertainty(UNCERTAINTY * reference)
            .relative(bound)
            .evidence(Evidence::OtherCode, SOURCE)
            .because("reference 1e-5; load steps of first order, 1/10 of the interval, turn the stress by 1e-4 each; front within a cell, (h/b)^2/10")
            .why_not_tighter("the errors of mesh and load step have opposite signs")
            .cost(cost)
            .record();
    }
}

/// Plots stresses along the radius at the last pressure, and displacements, with Hill's solution.
fn profiles(ledger: &mut Ledger, body: &Body<2>, stresses: &[[f64; 6]]) {
    let radii: Vec<f64> = body::points(&body.mesh, Idealisation::Axisymmetric).iter().map(|x| x[0]).collect();
    let series = |i: usize| -> Vec<(f64, f64)> {
        // A cell has three by three points: take those of one height.
        radii.iter().zip(stresses).step_by(3).map(|(r, s)| (*r, s[i])).collect()
    };
    let y = 2.0 * YIELD / 3.0_f64.sqrt();
    let front = (hill(0.18) * OUTER * YOUNG / (y * (1.0 - POISSON * POISSON))).sqrt();
    let grid: Vec<f64> = (0..=100).map(|k| INNER + f64::from(k)).collect();
    let closed = |sign: f64| -> Vec<(f64, f64)> {
        let at = |r: f64| {
            if r < front {
                let hoop = if sign > 0.0 { y } else { 0.0 };
                y * (-0.5 - (front / r).ln() + 0.5 * (front / OUTER).powi(2)) + hoop
            } else {
                0.5 * y * (front / OUTER).powi(2) * (1.0 + sign * (OUTER / r).powi(2))
            }
        };
        grid.iter().map(|&r| (r, at(r))).collect()
    };
    ledger.plot(
        Plot::xy("Stress at P = 0.18 GPa", "radius [mm]", "stress [GPa]")
            .series(Series::points("radial", &series(0)))
            .series(Series::points("hoop", &series(2)))
            .series(Series::points("axial", &series(1)))
            .series(Series::line("radial, Hill", &closed(-1.0)))
            .series(Series::line("hoop, Hill", &closed(1.0)))
            .caption("J2 with nu = 0.3 against Hill's solution for Tresca."),
    );
    let curve: Vec<(f64, f64)> = (0..=190).map(|k| 0.001 * f64::from(k)).map(|p| (hill(p), p)).collect();
    let reference: Vec<(f64, f64)> = REFERENCE.iter().map(|&(p, u)| (u, p)).collect();
    ledger.plot(
        Plot::xy("Pressure and displacement", "outer displacement [mm]", "pressure [GPa]")
            .series(Series::line("Hill", &curve))
            .series(Series::points("reference (J2)", &reference)),
    );
}

fn meshes(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plot = Plot::work_precision(
        "Work and precision",
        "relative error of the outer displacement at P = 0.18 GPa [-]",
        "time [s]",
    );
    for (kind, sizes, bound) in
        [(ElementKind::Quad4, [8, 16, 32], 5e-3), (ElementKind::Quad9, [2, 4, 8], 5e-3)]
    {
        let (mut levels, mut work, mut last) = (Vec::new(), Vec::new(), Cost::default());
        for n in sizes {
            let (outcome, cost) = Cost::measure(|| pressed(Shape::Ring, kind, n, 10));
            let (found, body) = outcome?;
            let error = (found[4] / REFERENCE[4].1 - 1.0).abs();
            levels.push((1.0 / n as f64, error));
            work.push((error, cost.wall.unwrap_or(f64::NAN)));
            last = cost.counts(&body.work);
        }
        let name = kind.name();
        ledger
            .order(format!("outer displacement at P = 0.18 GPa, relative, in the mesh, quarter ring of {name}"))
            .levels(&levels)
            .expected(2.0)
            .within(0.4)
            .or_better()
            .finest(bound, "n cells along the radius: 4 (h/b)^2 for quad4 near the limit load; the same for quad9 of four times the size")
            .evidence(Evidence::OtherCode, SOURCE)
            .because("strains of the exact solution bend at the front: order 2 for any element, with a factor that depends on where in a cell the front lies")
            .why_not_tighter("where the front lies in a cell decides the factor")
            .cost(&last)
            .record();
        plot = plot.series(Series::marked(name, &work));
    }
    ledger.plot(plot.caption("Quarter ring with averaged dilatation, the same 50 load steps."));
    Ok(())
}

fn load_steps(ledger: &mut Ledger) -> Result<(), CaseError> {
    let n = 16;
    let reference = pressed(Shape::Slice, ElementKind::Quad9, n, 256)?.0[4];
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for steps in [1, 2, 4, 8, 16] {
        let (outcome, cost) = Cost::measure(|| pressed(Shape::Slice, ElementKind::Quad9, n, steps));
        let (found, body) = outcome?;
        levels.push((1.0 / steps as f64, (found[4] / reference - 1.0).abs()));
        last = cost.counts(&body.work);
    }
    ledger
        .order("outer displacement at P = 0.18 GPa, relative, in the load step")
        .levels(&levels)
        .expected(1.0)
        .within(0.25)
        .finest(1e-4, "the axial stress relaxes by 0.1 Y while the front passes; the return errs by that times the step over 0.08 GPa, over ten")
        .evidence(Evidence::ConvergedSelf, "256 load steps per interval on the same mesh")
        .because("radial return is of first order in the step where the direction of the stress changes")
        .why_not_tighter("the estimate of the finest error is a product of sizes, without a constant")
        .cost(&last)
        .record();
    Ok(())
}

/// Limit pressure from the reaction at a prescribed inner displacement far beyond yield.
fn limit(shape: Shape, kind: ElementKind, n: usize) -> Result<(f64, Work), CaseError> {
    let mut body = shape.body(kind, n, true)?;
    let inner = body::side(&body.mesh, "left")?;
    let direction: Vec<[f64; 2]> = match shape {
        Shape::Ring => inner.iter().map(|&n| body.mesh.nodes[n].map(|x| x / INNER)).collect(),
        Shape::Slice => vec![[1.0, 0.0]; inner.len()],
    };
    let mut force = 0.0;
    for displacement in (1..=60).map(|k| 0.1 * f64::from(k)) {
        let entries = inner
            .iter()
            .zip(&direction)
            .flat_map(|(&n, d)| [(2 * n, displacement * d[0]), (2 * n + 1, displacement * d[1])]);
        let r = body.implicit(&entries.collect::<Vec<_>>(), &[], 1.0, BALANCED_FAR, None)?;
        force = inner.iter().zip(&direction).map(|(&n, d)| r[2 * n] * d[0] + r[2 * n + 1] * d[1]).sum();
    }
    let area = if shape == Shape::Ring { INNER * FRAC_PI_2 } else { TAU * INNER * HEIGHT };
    Ok((force / area, body.work))
}

fn limit_load(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = 2.0 * YIELD / 3.0_f64.sqrt() * (OUTER / INNER).ln();
    for (kind, sizes, order, bound, because) in [
        (
            ElementKind::Quad4,
            [8, 16, 32],
            2.0,
            5e-4,
            "(h/a)^2/12 = 8e-5 of the mean of 1/r, and twice that at the inner edge",
        ),
        (ElementKind::Quad9, [2, 4, 8], 4.0, 5e-4, "(h/a)^4 = 2e-4"),
    ] {
        let (mut levels, mut last) = (Vec::new(), Cost::default());
        for n in sizes {
            let (outcome, cost) = Cost::measure(|| limit(Shape::Slice, kind, n));
            let (found, work) = outcome?;
            levels.push((1.0 / n as f64, (found / exact - 1.0).abs()));
            last = cost.counts(&work);
        }
        ledger
            .order(format!("limit load, relative, in the mesh, slice of {}", kind.name()))
            .levels(&levels)
            .expected(order)
            .within(0.4)
            .or_better()
            .finest(bound, because)
            .evidence(Evidence::Exact, "2 Y/sqrt(3) ln(b/a) = 0.192091 GPa")
            .because("the dissipation of the best velocity field errs by the square of its strain error")
            .why_not_tighter("a power without its constant")
            .cost(&last)
            .record();
    }
    let (outcome, cost) = Cost::measure(|| limit(Shape::Ring, ElementKind::Quad9, 8));
    let (ring, work) = outcome?;
    ledger
        .claim("limit load, quarter ring of 8 x 8 quad9")
        .unit("GPa")
        .value(ring)
        .equals(exact)
        .relative(5e-4)
        .evidence(Evidence::Exact, "2 Y/sqrt(3) ln(b/a) = 0.192091 GPa")
        .because("(h/a)^4 = 2e-4 as for the slice, and arcs as parabolas, (h/a)^4 too")
        .why_not_tighter("a power without its constant")
        .cost(&cost.counts(&work))
        .record();
    Ok(())
}
