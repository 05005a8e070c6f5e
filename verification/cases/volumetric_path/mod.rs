//! Paths that change the volume, where the stress rate is that of the Kirchhoff stress.

mod disc;

use super::body::{self, Body, Work};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::nonlinear::{Kinematics, Material};
use asperity_fem::term::{ForwardTerm, Instant, Linearized};

/// See the README.
pub const CASE: Case = Case {
    name: "volumetric_path",
    readme: include_str!("README.md"),
    covers: &[Capability::FiniteStrain],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;
const POISSON: f64 = 0.3;
const BULK: f64 = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
const STRETCH: f64 = 1.3;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    cube(ledger)?;
    bar(ledger)?;
    sheet(ledger)?;
    disc::claims(ledger)?;
    cycle(ledger)?;
    symmetry(ledger)
}

fn solid() -> Result<Body<3>, CaseError> {
    let mesh = body::grid::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2; 3])?;
    let mesh = body::distorted(mesh, [1.0; 3], 0.5, 0.1);
    let material = Material::Elastic(Elastic::new(YOUNG, POISSON)?);
    Body::new(mesh, body::model(material, Idealisation::ThreeD, Kinematics::UpdatedLagrangian), &[])
}

/// A body after stretches to `STRETCH` along the given axes in equal steps.
fn stretched_body(axes: [f64; 3], steps: usize) -> Result<Body<3>, CaseError> {
    let mut body = solid()?;
    for k in 1..=steps {
        let s = (STRETCH - 1.0) * k as f64 / steps as f64;
        let u = body::field(&body.mesh, |x| std::array::from_fn(|c| s * axes[c] * x[c]));
        body.follow(u, 1.0)?;
    }
    Ok(body)
}

/// Stress after stretches to `STRETCH` along the given axes in equal steps, its spread over the points, and the work.
fn stretched(axes: [f64; 3], steps: usize) -> Result<([f64; 6], f64, Work), CaseError> {
    let body = stretched_body(axes, steps)?;
    let stresses = body.block.stress_at_points();
    let spread = body::largest_difference(&stresses, &stresses[0]);
    Ok((stresses[0], spread, body.work))
}

/// Relative error of the logarithmic strain from `steps` steps to `STRETCH`: each step misses dl^3/(12 l^3).
fn missed(steps: usize) -> f64 {
    let d = (STRETCH - 1.0) / steps as f64;
    // Sum of d^3/(12 l^3), as an integral: d^2/24 (1 - 1/l^2).
    d * d / 24.0 * (1.0 - STRETCH.powi(-2)) / STRETCH.ln()
}

/// Factor on the estimate for terms of higher order.
const HIGHER: f64 = 1.05;

fn study(
    ledger: &mut Ledger,
    what: &str,
    source: &str,
    exact: f64,
    times: f64,
    run: impl Fn(usize) -> Result<(f64, Work), CaseError>,
) -> Result<f64, CaseError> {
    let (mut levels, mut last, mut value) = (Vec::new(), Cost::default(), f64::NAN);
    for steps in [10, 20, 40, 80] {
        let (outcome, cost) = Cost::measure(|| run(steps));
        let (found, work) = outcome?;
        levels.push((1.0 / steps as f64, (found / exact - 1.0).abs()));
        (last, value) = (cost.counts(&work), found);
    }
    ledger
        .order(format!("{what}, relative, in the step"))
        .levels(&levels)
        .expected(2.0)
        .within(0.02)
        .finest(HIGHER * times * missed(80), "a step misses dl^3/(12 l^3) of the logarithmic strain; the sum over 80, relative, times what the quantity makes of it, and 5 % for higher powers")
        .evidence(Evidence::Exact, source)
        .because("the midpoint strain is the logarithmic one but for a third power")
        .why_not_tighter("the error has few higher terms here; a tolerance near zero would judge those")
        .cost(&last)
        .record();
    Ok(value)
}

fn cube(ledger: &mut Ledger) -> Result<(), CaseError> {
    let j = STRETCH.powi(3);
    let exact = BULK * j.ln() / j;
    let found = study(ledger, "mean stress of a cube at l = 1.3", "K ln J/J", exact, 1.0, |n| {
        stretched([1.0; 3], n).map(|(s, _, work)| ((s[0] + s[1] + s[2]) / 3.0, work))
    })?;
    ledger
        .claim("how much more the rate of the Cauchy stress would give, K ln J, against what was found")
        .value(BULK * j.ln() / found)
        .equals(j)
        .relative(HIGHER * missed(80))
        .evidence(Evidence::Exact, "the two differ by J = 2.197")
        .because("as for the stress itself")
        .record();
    let body = stretched_body([1.0; 3], 10)?;
    body_plots::displacement(ledger, "Cube expanded to l = 1.3", &body.mesh, &body.u, true)?;
    let (stress, spread, _) = stretched([1.0; 3], 80)?;
    let deviator = (0..3).map(|i| (stress[i] - found).abs()).chain((3..6).map(|i| stress[i].abs()));
    ledger
        .claim("deviator and spread over the points of the stress of the cube, over K")
        .value(deviator.fold(spread, f64::max) / BULK)
        .at_most(1e-13)
        .evidence(Evidence::Exact, "a uniform isotropic state")
        .because("rounding of 80 steps")
        .why_not_tighter("1e-16 for each step and operation add up at worst")
        .record();
    let stretches: Vec<f64> = (1..=30).map(|k| 1.0 + 0.01 * f64::from(k)).collect();
    let curve =
        |f: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> { stretches.iter().map(|&l| (l, f(l))).collect() };
    ledger.plot(
        Plot::xy("Expansion of a cube", "stretch of the edges [-]", "mean stress over K [-]")
            .series(Series::line("Kirchhoff (the program)", &curve(&|l| 3.0 * l.ln() / l.powi(3))))
            .series(Series::line("Cauchy", &curve(&|l| 3.0 * l.ln())))
            .series(Series::points("found, 80 steps", &[(STRETCH, found / BULK)])),
    );
    Ok(())
}

fn bar(ledger: &mut Ledger) -> Result<(), CaseError> {
    let modulus = BULK + 4.0 / 3.0 * SHEAR;
    let exact = modulus * STRETCH.ln() / STRETCH;
    study(
        ledger,
        "axial stress of a bar of constant width at l = 1.3",
        "(K + 4G/3) ln(l)/l",
        exact,
        1.0,
        |n| stretched([1.0, 0.0, 0.0], n).map(|(s, _, work)| (s[0], work)),
    )?;
    Ok(())
}

fn sheet(ledger: &mut Ledger) -> Result<(), CaseError> {
    let log = -2.0 * POISSON / (1.0 - POISSON) * STRETCH.ln();
    let exact = YOUNG / (1.0 - POISSON) * STRETCH.ln() / (STRETCH * STRETCH * log.exp());
    let run = |steps: usize| -> Result<(f64, f64, Work), CaseError> {
        let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2; 2])?;
        let material = Material::Elastic(Elastic::new(YOUNG, POISSON)?);
        let options = body::model(material, Idealisation::PlaneStress, Kinematics::UpdatedLagrangian);
        let mut body = Body::new(mesh, options, &[])?;
        for k in 1..=steps {
            let s = (STRETCH - 1.0) * k as f64 / steps as f64;
            let u = body::field(&body.mesh, |x| x.map(|x| s * x));
            body.follow(u, 1.0)?;
        }
        let thickness = body.block.thickness_strain_at_points().ok_or("no thickness is kept")?[0];
        Ok((body.block.stress_at_points()[0][0], thickness, body.work))
    };
    study(
        ledger,
        "stress of a sheet in plane stress at l = 1.3",
        "E/(1 - nu) ln l over l^2 exp(-2 nu/(1 - nu) ln l)",
        exact,
        // The thickness strain has the same relative error, and the stress is the force over the area.
        1.0 - log,
        |n| run(n).map(|(s, _, work)| (s, work)),
    )?;
    study(ledger, "logarithm of the thickness of the sheet", "-2 nu/(1 - nu) ln l", log, 1.0, |n| {
        run(n).map(|(_, t, work)| (t, work))
    })?;
    Ok(())
}

fn cycle(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut body = solid()?;
    let stretches = (1..=20).chain((-10..20).rev()).chain(-9..=0).map(|k| 0.015 * f64::from(k));
    for s in stretches {
        let u = body::field(&body.mesh, |x| x.map(|x| s * x));
        body.follow(u, 1.0)?;
    }
    let stresses = body.block.stress_at_points();
    ledger
        .claim("stress over K after expansion to l = 1.3, compression to 0.85 and back, the same stretches there and back")
        .value(body::largest_difference(&stresses, &[0.0; 6]) / BULK)
        .at_most(1e-13)
        .evidence(Evidence::Exact, "the midpoint strain of a step back is that of the step forth, with the other sign")
        .because("rounding of 60 steps")
        .why_not_tighter("1e-16 for each step and operation add up at worst")
        .cost(&Cost::default().counts(&body.work))
        .record();
    Ok(())
}

fn symmetry(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut body = solid()?;
    // A state with shear, stretch and volume.
    let u = body::field(&body.mesh, |x| [0.1 * x[0] + 0.2 * x[1], 0.05 * x[1] - 0.1 * x[2], 0.15 * x[2]]);
    body.follow(u, 1.0)?;
    let pattern = body.block.pattern().clone();
    let (mut values, mut constant) = (vec![0.0; pattern.values()], vec![0.0; body.u.len()]);
    body.block
        .rate(Instant { time: 1.0, dt: 1.0 }, &mut values, &mut constant)
        .map_err(|refusal| refusal.to_string())?;
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let mut skew = 0.0_f64;
    let mut rest = &values[..];
    for block in pattern.blocks() {
        let n = block.len();
        let (k, after) = rest.split_at(n * n);
        rest = after;
        for i in 0..n {
            for j in 0..i {
                skew = skew.max((k[n * i + j] - k[n * j + i]).abs());
            }
        }
    }
    ledger
        .claim("skew part of the rate tangent over its largest entry, at strains of 0.2")
        .value(skew / largest)
        .at_most(1e-14)
        .evidence(Evidence::Exact, "with the rate of the Kirchhoff stress C_ijkl + (s_jl d_ik - s_ik d_jl - s_il d_jk - s_jk d_il)/2 has the major symmetry")
        .because("rounding of sums of some ten products")
        .why_not_tighter("rounding")
        .covers(&[Capability::FiniteStrain, Capability::Tangents])
        .record();
    Ok(())
}
