//! Uniaxial stress: hardening, unloading and reversal; hardening at large strain.

mod budget;

use super::body::{self, Body, Work};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::mesh::Mesh;
use asperity_fem::nonlinear::{Kinematics, Model};

/// See the README.
pub const CASE: Case = Case {
    name: "uniaxial_hardening",
    readme: include_str!("README.md"),
    covers: &[Capability::Plasticity],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;
const POISSON: f64 = 0.3;
const YIELD: f64 = 0.02;
const MODULUS: f64 = 0.3;
/// Loading, unloading, reloading, compression beyond yield, tension.
const PATH: [f64; 8] = [0.005, 0.012, 0.03, 0.024, 0.05, 0.08, 0.02, 0.1];
/// Forces are some 1e-3; rounding of stiffness times displacement leaves 1e-17.
const BALANCED: f64 = 2e-15;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let curves = [
        Curve {
            name: "linear hardening",
            law: Hardening::linear(YIELD, MODULUS)?,
            exact: |e| YIELD + MODULUS * e,
        },
        Curve {
            name: "power law",
            law: Hardening::swift(YIELD, 0.01, 0.4)?,
            exact: |e| YIELD * (1.0 + e / 0.01).powf(0.4),
        },
        Curve {
            name: "table",
            law: Hardening::table(&[[0.0, YIELD], [0.01, 0.03], [0.04, 0.035]])?,
            exact: |e| (YIELD + e).min(0.03 + (e - 0.01) / 6.0).min(0.035),
        },
    ];
    let mut plot = Plot::xy("Uniaxial stress", "strain [-]", "stress [E/2.5]");
    for hardening in &curves {
        small(ledger, hardening)?;
        let mut bar = Bar::new(hardening.exact);
        let mut curve = vec![(0.0, 0.0)];
        for strain in PATH {
            let from = curve[curve.len() - 1].0;
            for k in 1..=20 {
                let now = from + (strain - from) * f64::from(k) / 20.0;
                curve.push((now, bar.to(now)));
            }
        }
        plot = plot.series(Series::line(hardening.name, &curve));
    }
    ledger.plot(plot.caption("Exact curves; the program's points lie on them to rounding."));
    slope(ledger, &curves[0].law)?;
    large(ledger)?;
    budget::run(ledger)
}

/// A hardening curve, and the yield stress at a plastic strain written once more.
struct Curve {
    name: &'static str,
    law: Hardening,
    exact: fn(f64) -> f64,
}

/// Exact solution of the bar in one dimension.
struct Bar {
    strength: fn(f64) -> f64,
    /// Plastic strain with its sign, and accumulated plastic strain.
    plastic: f64,
    total: f64,
}

impl Bar {
    fn new(strength: fn(f64) -> f64) -> Self {
        Self { strength, plastic: 0.0, total: 0.0 }
    }

    /// Takes the bar to a strain and returns its stress.
    fn to(&mut self, strain: f64) -> f64 {
        let trial = YOUNG * (strain - self.plastic);
        let beyond = trial.abs() - (self.strength)(self.total);
        if beyond <= 0.0 {
            return trial;
        }
        let flow =
            body::root(0.0, beyond / YOUNG, |d| YOUNG * d + (self.strength)(self.total + d) - trial.abs());
        self.total += flow;
        self.plastic += flow * trial.signum();
        YOUNG * (strain - self.plastic)
    }
}

/// Result of [`stretched`].
type StretchResult = (Vec<Vec<[f64; 2]>>, f64, Work);

/// A function that runs one idealisation.
type Run<'a> = Box<dyn Fn() -> Result<StretchResult, CaseError> + 'a>;

/// Takes a box through axial strains. Returns axial stress and plastic strain at every point after each strain, and the
/// largest of the other stress components.
fn stretched<const D: usize>(mesh: Mesh<D>, options: Model, axis: usize) -> Result<StretchResult, CaseError> {
    let planes = &["left", "bottom", "back"][..D];
    let end = body::side(&mesh, ["right", "top"][axis])?;
    let mut held = Vec::new();
    for (c, name) in planes.iter().enumerate() {
        held.extend(body::side(&mesh, name)?.iter().map(|n| n * D + c));
    }
    held.extend(end.iter().map(|n| n * D + axis));
    let mut body = Body::new(mesh, options, &held)?;
    let (mut found, mut others) = (Vec::new(), 0.0_f64);
    for strain in PATH {
        let entries: Vec<_> = end.iter().map(|n| (n * D + axis, strain)).collect();
        body.implicit(&entries, &[], 1.0, BALANCED, None)?;
        let plastic = body.block.plastic_strain_at_points().ok_or("no plastic strain is kept")?;
        let stresses = body.block.stress_at_points();
        for s in &stresses {
            others = (0..6).filter(|i| *i != axis).map(|i| s[i].abs()).fold(others, f64::max);
        }
        found.push(stresses.iter().zip(plastic).map(|(s, e)| [s[axis], e]).collect());
    }
    Ok((found, others, body.work))
}

fn small(ledger: &mut Ledger, Curve { name, law, exact }: &Curve) -> Result<(), CaseError> {
    let options =
        |i| Ok::<_, CaseError>(body::model(body::j2(YOUNG, POISSON, law.clone())?, i, Kinematics::Small));
    let square = |kind| body::grid::<2>(kind, [0.0; 2], [1.0; 2], [2; 2]);
    let quads = || Ok::<_, CaseError>(body::distorted(square(ElementKind::Quad4)?, [1.0; 2], 0.5, 0.2));
    let cube = || {
        let cube = body::grid::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2; 3])?;
        Ok::<_, CaseError>(body::distorted(cube, [1.0; 3], 0.5, 0.2))
    };
    let runs: [(&str, Run<'_>); 3] = [
        ("hex8", Box::new(|| stretched::<3>(cube()?, options(Idealisation::ThreeD)?, 0))),
        (
            "plane stress, quad4",
            Box::new(|| stretched::<2>(quads()?, options(Idealisation::PlaneStress)?, 0)),
        ),
        (
            "axisymmetric, quad9 with averaged dilatation",
            Box::new(|| {
                let options = body::averaged(options(Idealisation::Axisymmetric)?);
                stretched::<2>(square(ElementKind::Quad9)?, options, 1)
            }),
        ),
    ];
    for (what, run) in runs {
        let (outcome, cost) = Cost::measure(&run);
        let (found, others, work) = outcome?;
        let mut bar = Bar::new(*exact);
        let (mut stress, mut plastic) = (0.0_f64, 0.0_f64);
        for (strain, points) in PATH.into_iter().zip(&found) {
            let exact = bar.to(strain);
            for [s, e] in points {
                stress = worst(stress, s - exact);
                plastic = worst(plastic, e - bar.total);
            }
        }
        ledger
            .claim(format!("uniaxial stress over Y0 along the path, {name}, {what}: all points, all components"))
            .value(stress.max(others) / YIELD)
            .at_most(1e-11)
            .evidence(Evidence::Exact, "|s| = Y(e_p), s = E (e - e_p) in one dimension")
            .because("forces are balanced to 2e-15 on areas of a quarter of 1/4 down to 1/16, that is to 1e-12 of Y0, times ten")
            .why_not_tighter("the last iteration of Newton's method leaves less than it must")
            .cost(&cost.clone().counts(&work))
            .record();
        ledger
            .claim(format!("plastic strain along the path, {name}, {what}: all points"))
            .value(plastic)
            .at_most(1e-12)
            .evidence(Evidence::Exact, "|s| = Y(e_p), s = E (e - e_p) in one dimension")
            .because("the stress to 1e-11 of Y0 = E/125 over E, and the slope of the hardening curve, down to 0.04 E")
            .why_not_tighter("as for the stress")
            .record();
    }
    Ok(())
}

/// The larger magnitude; NaN is kept.
fn worst(so_far: f64, difference: f64) -> f64 {
    if difference.is_nan() || difference.abs() > so_far { difference.abs() } else { so_far }
}

fn slope(ledger: &mut Ledger, hardening: &Hardening) -> Result<(), CaseError> {
    let mesh = body::grid::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2; 3])?;
    let options =
        body::model(body::j2(YOUNG, POISSON, hardening.clone())?, Idealisation::ThreeD, Kinematics::Small);
    let (found, _, _) = stretched::<3>(mesh, options, 0)?;
    let slope = (found[2][0][0] - found[1][0][0]) / (PATH[2] - PATH[1]);
    ledger
        .claim("tangent modulus after yield, linear hardening")
        .value(slope)
        .equals(YOUNG * MODULUS / (YOUNG + MODULUS))
        .relative(1e-11)
        .evidence(Evidence::Exact, "E H/(E + H)")
        .because("the stress to 1e-13 over a difference of 5e-3")
        .why_not_tighter("as for the stress")
        .record();
    Ok(())
}

/// Force on a unit cube stretched to lambda in equal steps, and the cube.
fn pulled(lambda: f64, steps: usize) -> Result<(f64, Body<3>), CaseError> {
    let mesh = body::grid::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2; 3])?;
    let mesh = body::distorted(mesh, [1.0; 3], 0.5, 0.1);
    let material = body::j2(YOUNG, POISSON, Hardening::linear(YIELD, MODULUS)?)?;
    let options = body::model(material, Idealisation::ThreeD, Kinematics::UpdatedLagrangian);
    let end = body::side(&mesh, "right")?;
    let mut held: Vec<usize> = end.iter().map(|n| 3 * n).collect();
    for (c, name) in ["left", "bottom", "back"].iter().enumerate() {
        held.extend(body::side(&mesh, name)?.iter().map(|n| 3 * n + c));
    }
    let mut body = Body::new(mesh, options, &held)?;
    let mut force = 0.0;
    for k in 1..=steps {
        let entries: Vec<_> = end.iter().map(|n| (3 * n, (lambda - 1.0) * k as f64 / steps as f64)).collect();
        let r = body.implicit(&entries, &[], 1.0, 10.0 * BALANCED, None)?;
        force = end.iter().map(|n| r[3 * n]).sum();
    }
    Ok((force, body))
}

fn large(ledger: &mut Ledger) -> Result<(), CaseError> {
    let lambda = 1.5_f64;
    let tangent = YOUNG * MODULUS / (YOUNG + MODULUS);
    let exact = (YIELD + tangent * (lambda.ln() - YIELD / YOUNG)) / lambda;
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    let sizes = [10, 20, 40, 80];
    for steps in sizes {
        let (outcome, cost) = Cost::measure(|| pulled(lambda, steps));
        let (force, body) = outcome?;
        levels.push((1.0 / steps as f64, (force / exact - 1.0).abs()));
        last = cost.counts(&body.work);
        if steps == 10 {
            body_plots::displacement(ledger, "Cube stretched to lambda = 1.5", &body.mesh, &body.u, true)?;
        }
    }
    // Each step replaces ln(1 + x) by x/(1 + x/2), which is x^3/12 smaller, with x up to 0.5/80.
    let bound = tangent * 80.0 * (0.5_f64 / 80.0).powi(3) / 12.0 / (exact * lambda);
    ledger
        .order("force at lambda = 1.5, relative, linear hardening, hex8 at large strain, in the step")
        .levels(&levels)
        .expected(2.0)
        .within(0.05)
        .finest(bound, "80 steps miss dlambda^3/12 of logarithmic strain each, times the tangent modulus")
        .evidence(Evidence::Exact, "F = A_0 tau(ln lambda)/lambda, tau = Y + E H/(E + H) (ln lambda - Y/E)")
        .because("the midpoint strain of a step is its logarithmic strain but for a third power")
        .why_not_tighter("the error has few higher terms here; a tolerance near zero would judge those")
        .covers(&[Capability::Plasticity, Capability::FiniteStrain])
        .cost(&last)
        .record();
    Ok(())
}
