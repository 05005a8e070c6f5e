//! Bodies about an axis at large strain: a ring displaced evenly, a disc expanded by displacements and by loads.

use crate::cases::body::{self, Body, Entry, Work};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::nonlinear::{Kinematics, Limits, Material, Model};

use super::{BULK, HIGHER, POISSON, SHEAR, STRETCH, YOUNG, missed, study};

const LAME: f64 = BULK - 2.0 * SHEAR / 3.0;
/// Modulus of equal strains along the radius and around the axis.
const PLANE: f64 = 2.0 * (LAME + SHEAR);
/// Nominal traction on the rim over `PLANE`: tau/l with the Kirchhoff stress tau = PLANE ln l.
const LOAD: f64 = 0.2;

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    ring(ledger)?;
    disc(ledger)?;
    loaded(ledger)
}

/// A slice between the radii, held along the axis; its model admits forward steps of any size.
fn slice(radii: [f64; 2]) -> Result<(Body<2>, Vec<Entry>), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [radii[0], 0.0], [radii[1], 0.5], [4, 2])?;
    let limits = Limits { strain: 1.0, rotation: 1.0, ..Limits::default() };
    let material = Material::Elastic(Elastic::new(YOUNG, POISSON)?);
    let options =
        Model { limits, ..body::model(material, Idealisation::Axisymmetric, Kinematics::UpdatedLagrangian) };
    let on_axis = body::side(&mesh, "left")?.into_iter().filter(|_| radii[0] == 0.0).map(|n| 2 * n);
    let flat = (0..mesh.nodes.len()).map(|n| 2 * n + 1);
    let held: Vec<Entry> = on_axis.chain(flat).map(|dof| (dof, 0.0)).collect();
    Ok((Body::new(mesh, options, &body::dofs(&held))?, held))
}

/// Stress along the radius, the axis and around it of the first point after displacements along the radius that grow evenly
/// to `radial`.
fn displaced(
    radii: [f64; 2],
    steps: usize,
    radial: impl Fn(f64) -> f64,
) -> Result<([f64; 3], f64, Work), CaseError> {
    let (mut body, _) = slice(radii)?;
    let radius = body::points(&body.mesh, Idealisation::Axisymmetric)[0][0];
    for k in 1..=steps {
        let share = k as f64 / steps as f64;
        let u = body::field(&body.mesh, |[r, _]| [share * radial(r), 0.0]);
        body.follow(u, 1.0)?;
    }
    let s = body.block.stress_at_points()[0];
    Ok(([s[0], s[1], s[2]], radius, body.work))
}

/// A ring whose points all move outwards by as much: the strain is around the axis alone.
fn ring(ledger: &mut Ledger) -> Result<(), CaseError> {
    let radii = [1.0, 2.0];
    let (_, radius, _) = displaced(radii, 1, |_| 0.0)?;
    // The first point is stretched to `STRETCH`.
    let out = (STRETCH - 1.0) * radius;
    for (what, part, modulus) in [
        ("around the axis", 2, LAME + 2.0 * SHEAR),
        ("along the radius", 0, LAME),
        ("along the axis", 1, LAME),
    ] {
        let exact = modulus * STRETCH.ln() / STRETCH;
        study(
            ledger,
            &format!("stress {what} of a ring displaced outwards evenly, where r = 1.3 R"),
            "lambda ln(r/R) R/r, and 2 G ln(r/R) R/r more around the axis",
            exact,
            1.0,
            |n| displaced(radii, n, |_| out).map(|(s, _, work)| (s[part], work)),
        )?;
    }
    Ok(())
}

/// A disc of constant thickness expanded evenly.
fn disc(ledger: &mut Ledger) -> Result<(), CaseError> {
    let expand = |r: f64| (STRETCH - 1.0) * r;
    for (what, part, modulus) in
        [("around the axis", 2, PLANE), ("along the radius", 0, PLANE), ("along the axis", 1, 2.0 * LAME)]
    {
        let exact = modulus * STRETCH.ln() / (STRETCH * STRETCH);
        study(
            ledger,
            &format!("stress {what} of a disc of constant thickness at l = 1.3"),
            "2 (lambda + G) ln(l)/l^2, along the axis 2 lambda ln(l)/l^2",
            exact,
            1.0,
            |n| displaced([0.0, 1.0], n, expand).map(|(s, _, work)| (s[part], work)),
        )?;
    }
    Ok(())
}

/// Stretch of the disc under a load that grows evenly, in forward or implicit steps.
fn stretch(steps: usize, forward: bool) -> Result<(f64, Work), CaseError> {
    let (mut body, held) = slice([0.0, 1.0])?;
    let tension: Vec<Entry> = body::unit_pressure(&body.mesh, "right", Idealisation::Axisymmetric)?
        .into_iter()
        .map(|(dof, f)| (dof, -LOAD * PLANE * f))
        .collect();
    let rim = body::side(&body.mesh, "right")?[0];
    // Forces are 1; rounding of stiffness times displacement leaves 1e-15.
    let balanced = 1e-13;
    for k in 1..=steps {
        let scaled = |share: f64| -> Vec<Entry> { tension.iter().map(|(d, f)| (*d, share * f)).collect() };
        if forward {
            body.forward(&[], &scaled((steps as f64).recip()), 1.0)?;
        } else {
            body.implicit(&held, &scaled(k as f64 / steps as f64), 1.0, balanced, None)?;
        }
    }
    Ok((1.0 + body.u[2 * rim], body.work))
}

/// Error of the logarithmic strain with steps even in the load over that with steps even in the stretch: both the integral of
/// dl^2/(12 l^3), with dl/dp = l^2/(1 - ln l) of the load p. The stretch misses l/(1 - ln l) times as much as the logarithm.
fn uneven(end: f64) -> f64 {
    let parts = 1000;
    let each = (end - 1.0) / f64::from(parts);
    let stretches = (0..parts).map(|k| 1.0 + each * (f64::from(k) + 0.5));
    let integral: f64 = stretches.map(|l| each * l / (1.0 - l.ln()).powi(2)).sum();
    LOAD * LOAD * integral / 12.0 / end.ln() / missed(1)
}

/// The disc under a nominal traction on its rim: only the exact tangent leads forward steps along the path.
fn loaded(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = body::root(1.0, 1.5, |l| l.ln() / l - LOAD);
    let source = "root of ln(l)/l = p/(2 (lambda + G))";
    study(
        ledger,
        "strain of a disc under tension on its rim, implicit steps",
        source,
        exact - 1.0,
        uneven(exact) * exact * exact.ln() / ((1.0 - exact.ln()) * (exact - 1.0)),
        |n| stretch(n, false).map(|(l, work)| (l - 1.0, work)),
    )?;
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for steps in [20, 40, 80, 160] {
        let (outcome, cost) = Cost::measure(|| stretch(steps, true));
        let (found, work) = outcome?;
        levels.push(((steps as f64).recip(), (found - exact).abs()));
        last = cost.counts(&work);
    }
    // dl/dp of the path, over that at its start.
    let slope = exact * exact / (1.0 - exact.ln());
    ledger
        .order("stretch of a disc under tension on its rim, forward steps, in the step")
        .levels(&levels)
        .expected(1.0)
        .within(0.05)
        .finest(
            HIGHER * 0.5 * LOAD / 160.0 * slope * slope.ln(),
            "Euler's method leaves half a step times the slope at the end times the logarithm of the slopes' ratio, and 5 % for higher powers",
        )
        .evidence(Evidence::Exact, source)
        .because("each step follows the tangent at its start; with another tangent the path would be another")
        .why_not_tighter("the slope grows threefold along the path, and terms of second order with it")
        .covers(&[Capability::FiniteStrain, Capability::Tangents])
        .cost(&last)
        .record();
    Ok(())
}
