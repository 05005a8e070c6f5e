//! Half-plane and half-space under point, strip and disc loads.

mod fields;

use super::bodies::{self, Body, Field, Level, Orders};
use super::bodies_patch::capability;
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::Mesh;
use fields::{Boussinesq, Disc, Flamant, Strip};
use std::f64::consts::{FRAC_PI_2, PI};

/// See the README.
pub const CASE: Case = Case {
    name: "flamant_boussinesq",
    readme: include_str!("README.md"),
    covers: &[Capability::PlaneStrain, Capability::Axisymmetric, Capability::Loads],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;
const POISSON: f64 = 0.3;
const FORCE: f64 = 0.01;
/// Radius of the bodies; depth and half width of the boxes.
const SIZE: f64 = 4.0;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let material = Elastic::new(YOUNG, POISSON)?;
    points(ledger, &material)?;
    strip(ledger, &material)?;
    disc(ledger, &material)
}

/// The unit square mapped to 1 < r < 4 with geometric cell sizes and to angles from 0 to `angle`; positions on the axis are exact.
fn annulus(kind: ElementKind, [n, m]: [usize; 2], angle: f64) -> Result<Mesh<2>, CaseError> {
    let mesh = bodies::unit_block(kind, [n, m])?;
    Ok(bodies::mapped(mesh, |x| {
        let r = SIZE.powf(x[0]);
        let (sine, cosine) = (angle * x[1]).sin_cos();
        let (first, last) = (x[1] == 0.0, x[1] == 1.0);
        [
            if last && angle == FRAC_PI_2 { 0.0 } else { r * cosine },
            if first || (last && angle == PI) { 0.0 } else { r * sine },
        ]
    }))
}

/// Point loads, with their neighbourhood excluded.
fn points(ledger: &mut Ledger, material: &Elastic) -> Result<(), CaseError> {
    use ElementKind::{Quad4, Quad8, Quad9, Tri6};
    let mut plot = Plot::work_precision("Point loads", "relative error of the displacement, L2", "unknowns");
    let flamant = Flamant::new(material, FORCE);
    for kind in [Quad4, Tri6, Quad8, Quad9] {
        let space = Idealisation::PlaneStrain;
        let levels = study(kind, space, &flamant, |kind, n| {
            let body = Body::new(annulus(kind, [n, 2 * n], PI)?, material, space, Formulation::Standard)?;
            Ok(body.pull(&["left"], &flamant).hold(&["right"], &flamant))
        })?;
        let name = format!("line force on a half-plane, {}", kind.name());
        plot = enter(ledger, plot, &name, (kind, Capability::PlaneStrain, "Flamant"), &levels);
    }
    let boussinesq = Boussinesq::new(material, FORCE);
    for kind in [Quad4, Quad9] {
        let space = Idealisation::Axisymmetric;
        let levels = study(kind, space, &boussinesq, |kind, n| {
            let mesh = annulus(kind, [n, n + n / 2], FRAC_PI_2)?;
            let body = Body::new(mesh, material, space, Formulation::Standard)?;
            Ok(body.pull(&["left"], &boussinesq).hold(&["right"], &boussinesq).fix("top", 0, 0.0))
        })?;
        let name = format!("point force on a half-space, {}", kind.name());
        plot = enter(ledger, plot, &name, (kind, Capability::Axisymmetric, "Boussinesq"), &levels);
    }
    ledger.plot(plot);
    let body =
        Body::new(annulus(Quad9, [16, 32], PI)?, material, Idealisation::PlaneStrain, Formulation::Standard)?;
    let body = body.pull(&["left"], &flamant).hold(&["right"], &flamant);
    body_plots::displacement(ledger, "Line force on a half-plane", &body.mesh, &body.solve()?.u, false)
}

fn study(
    kind: ElementKind,
    space: Idealisation,
    field: &dyn Field<2>,
    build: impl Fn(ElementKind, usize) -> Result<Body<2>, CaseError>,
) -> Result<Vec<Level>, CaseError> {
    let sizes = if kind.order() == 1 { [16, 32, 64] } else { [8, 16, 32] };
    let one = |n: usize| {
        bodies::level(1.0 / n as f64, kind, (space, Formulation::Standard), field, |kind, _| build(kind, n))
    };
    sizes.into_iter().map(one).collect()
}

fn enter(
    ledger: &mut Ledger,
    plot: Plot,
    name: &str,
    (kind, space, source): (ElementKind, Capability, &'static str),
    levels: &[Level],
) -> Plot {
    let p = kind.order() as f64;
    let orders = Orders {
        expected: [p + 1.0, p],
        within: [0.1, 0.1],
        or_better: false,
        loaded: true,
        because: "with the neighbourhood of the force cut out the solution is smooth, and the meshes follow a smooth map"
            .into(),
        covers: vec![space, capability(kind), Capability::Loads],
        evidence: (Evidence::Exact, source),
    };
    bodies::claim(ledger, name, levels, &orders);
    let points: Vec<(f64, f64)> = levels.iter().map(|l| (l.errors[0], l.unknowns as f64)).collect();
    plot.series(Series::marked(name, &points))
}

/// Uniform pressure on |x| < 1 in a box of 8 x 4.
fn strip(ledger: &mut Ledger, material: &Elastic) -> Result<(), CaseError> {
    let field = Strip(Flamant::new(material, FORCE));
    for kind in [ElementKind::Quad4, ElementKind::Quad9] {
        let build = |kind: ElementKind, n: usize| {
            let mesh = bodies::unit_block(kind, [2 * n, n])?;
            let mesh = bodies::mapped(mesh, |x| [SIZE * (2.0 * x[0] - 1.0), SIZE * x[1]]);
            let body = Body::new(mesh, material, Idealisation::PlaneStrain, Formulation::Standard)?;
            let body = body.load(&["bottom"], |point, t| {
                // Element boundaries coincide with the edges of the strip, so that quadrature points lie clearly inside or outside.
                t[1] = if point.position[0].abs() < 1.0 { -FORCE * point.normal[1] } else { 0.0 };
            });
            Ok(body.hold(&["left", "right", "top"], &field))
        };
        let levels = study(kind, Idealisation::PlaneStrain, &field, build)?;
        let orders = Orders {
            expected: [2.0, 1.0],
            within: [0.2, 0.2],
            or_better: true,
            loaded: true,
            because: "r ln r at the edges of the strip; for first order the logarithm takes 1/(2 ln(1/h)) = 0.1 off the \
                      gradient and twice that off the displacement"
                .into(),
            covers: vec![Capability::PlaneStrain, capability(kind), Capability::Loads],
            evidence: (Evidence::Exact, "integral of Flamant's solution over the strip"),
        };
        bodies::claim(ledger, &format!("pressure on a strip, {}", kind.name()), &levels, &orders);
        let n = 32;
        let (solved, cost) = Cost::measure(|| {
            let body: Body<2> = build(kind, n)?;
            let solved = body.solve()?;
            Ok::<_, CaseError>((body.at(&solved.u, [0.0, 0.0])[1], solved.work))
        });
        let (centre, work) = solved?;
        ledger
            .claim(format!("settlement of the strip's centre, {}, 8 elements in its half width", kind.name()))
            .value(centre)
            .equals(field.at(&[0.0, 0.0]).0[1])
            // h/a = 1/8; the error of a point value away from the edges is the product of two energy errors.
            .relative(1.0 / 64.0)
            .evidence(Evidence::Exact, "integral of Flamant's solution over the strip")
            .because("(h/a)^2, a the half width, with constant one: product of the energy errors of solution and dual")
            .why_not_tighter("the constant is not known beforehand; one is the natural unit")
            .covers(&[Capability::PlaneStrain, capability(kind), Capability::Loads])
            .cost(&Cost { work: work.work, ..cost })
            .record();
    }
    Ok(())
}

/// Settlement on the axis under a uniform pressure on r < 1:
/// p (1+ν)/E (2(1-ν) (√(1+z²) - z) + z - z²/√(1+z²)).
fn settlement(z: f64) -> f64 {
    let root = (1.0 + z * z).sqrt();
    FORCE * (1.0 + POISSON) / YOUNG * (2.0 * (1.0 - POISSON) * (root - z) + z - z * z / root)
}

/// Uniform pressure on r < 1 in a cylinder of radius and height 4.
fn disc(ledger: &mut Ledger, material: &Elastic) -> Result<(), CaseError> {
    let field = Disc::new(material, FORCE);
    for kind in [ElementKind::Quad4, ElementKind::Quad9] {
        let mut points = Vec::new();
        let mut last = Cost::default();
        for n in if kind.order() == 1 { [16, 32, 64] } else { [8, 16, 32] } {
            let (solved, cost) = Cost::measure(|| {
                let mesh = bodies::mapped(bodies::unit_block(kind, [n; 2])?, |x| x.map(|x| SIZE * x));
                let body = Body::new(mesh, material, Idealisation::Axisymmetric, Formulation::Standard)?;
                let body = body
                    .load(&["bottom"], |point, t| {
                        t[1] = if point.position[0] < 1.0 { -FORCE * point.normal[1] } else { 0.0 };
                    })
                    .hold(&["right", "top"], &field)
                    .fix("left", 0, 0.0);
                let solved = body.solve()?;
                Ok::<_, CaseError>((body, solved))
            });
            let (body, solved) = solved?;
            let error = body
                .mesh
                .nodes
                .iter()
                .enumerate()
                .filter(|(_, x)| x[0] == 0.0)
                .map(|(node, x)| (solved.u[2 * node + 1] - settlement(x[1])).abs())
                .fold(0.0, f64::max);
            points.push((SIZE / n as f64, error / settlement(0.0)));
            last = Cost { work: solved.work.work, ..cost };
        }
        let h = points.last().map_or(f64::NAN, |p| p.0);
        // Largest errors of first-order elements contain a logarithm: the order expected is the slope of h² ln(a/h) between these
        // meshes.
        let logarithmic = |h: f64| h * h * (1.0 / h).ln();
        let coarsest = points.first().map_or(f64::NAN, |p| p.0);
        let expected = if kind.order() == 1 {
            (logarithmic(coarsest) / logarithmic(h)).ln() / (coarsest / h).ln()
        } else {
            2.0
        };
        ledger
            .order(format!("settlement along the axis under a disc, {}", kind.name()))
            .norm("largest over the nodes of the axis, relative to the settlement of the centre")
            .levels(&points)
            .expected(expected)
            .within(0.2)
            .or_better()
            .evidence(Evidence::Exact, "Boussinesq's solution integrated over the disc, closed form on the axis")
            .because(
                "r ln r at the edge of the disc: order 2 whatever the element; in the largest norm elements of first order \
                 have h^2 ln(1/h) (Haverkamp 1984), whose slope between these meshes is what is expected",
            )
            .finest(h * h, "(h/a)^2 with constant one: product of the energy errors of solution and dual")
            .why_not_tighter("the constant is not known beforehand; one is the natural unit")
            .covers(&[Capability::Axisymmetric, capability(kind), Capability::Loads])
            .cost(&last)
            .record();
    }
    Ok(())
}
