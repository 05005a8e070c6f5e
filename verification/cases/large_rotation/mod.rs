//! Rotations: objectivity of stresses and forces; viscous bodies; forward steps of a turning strip.

mod viscous;

use super::body::{self, Body};
use crate::cases::body_plots;
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::nonlinear::{Kinematics, Limits, Material, Model};
use std::f64::consts::FRAC_PI_2;

/// See the README.
pub const CASE: Case = Case {
    name: "large_rotation",
    readme: include_str!("README.md"),
    covers: &[Capability::FiniteStrain],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;
const POISSON: f64 = 0.3;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    circle(ledger)?;
    forces(ledger)?;
    viscous::claims(ledger)?;
    for carry in [false, true] {
        turning(ledger, carry)?;
    }
    Ok(())
}

fn circle(ledger: &mut Ledger) -> Result<(), CaseError> {
    let start = [0.3, -0.1, 0.2, 0.15, 0.0, 0.0];
    let mut drifts = Vec::new();
    for degrees in [1.0_f64, 7.5, 45.0, 120.0] {
        let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2; 2])?;
        let mesh = body::distorted(mesh, [1.0; 2], 0.5, 0.2);
        let material = Material::Elastic(Elastic::new(YOUNG, POISSON)?);
        let options = body::model(material, Idealisation::PlaneStrain, Kinematics::UpdatedLagrangian);
        let mut body = Body::new(mesh, options, &[])?;
        body.block.prestress(|_, _| start)?;
        let (worst, cost) = Cost::measure(|| -> Result<f64, CaseError> {
            let mut worst = 0.0_f64;
            for k in 1..=(360.0 / degrees) as usize {
                let angle = (degrees * k as f64).to_radians();
                let u = body::field(&body.mesh, |x| body::turned(angle, x));
                body.follow(u, 1.0)?;
                let exact = body::turned_stress(angle, &start);
                worst = worst.max(body::largest_difference(&body.block.stress_at_points(), &exact));
            }
            Ok(worst)
        });
        let worst = worst? / 0.3;
        let shrunk = (0.5 * degrees).to_radians().cos();
        drifts.push((degrees, worst));
        ledger
            .claim(format!("stress over its largest component, all steps of a full circle, {degrees} degrees each"))
            .value(worst)
            .at_most(1e-12 / (shrunk * shrunk))
            .evidence(Evidence::Exact, "R s R^T")
            .because("rounding of up to 360 steps in strains of 1e-16 times E over the stress of 0.1 E, over the square of the cosine by which the midpoint configuration shrinks")
            .why_not_tighter("rounding of the steps adds up at worst")
            .cost(&cost.counts(&body.work))
            .record();
    }
    // Drift of the simplest update, s + (w s - s w): the deviator grows by sqrt(1 + 4 d^2) a step, where d is the angle
    // of the step.
    let plain: Vec<(f64, f64)> = drifts
        .iter()
        .map(|(degrees, _)| {
            (*degrees, (0.5 * (360.0 / degrees) * (4.0 * degrees.to_radians().powi(2)).ln_1p()).exp_m1())
        })
        .collect();
    ledger.plot(
        Plot::xy("Drift of the stress over a full circle", "step [degrees]", "relative drift [-]")
            .axes(Axis::Log, Axis::Log)
            .series(Series::marked("the program", &drifts))
            .series(Series::line("without a rotation: s + w s - s w, not in the program", &plain)),
    );
    Ok(())
}

fn forces(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, averaged) in [("standard", false), ("averaged dilatation", true)] {
        let mesh = body::grid::<2>(ElementKind::Quad9, [0.0; 2], [1.0; 2], [2; 2])?;
        let material = body::j2(YOUNG, POISSON, Hardening::swift(0.02, 0.01, 0.4)?)?;
        let mut options = body::model(material, Idealisation::PlaneStrain, Kinematics::UpdatedLagrangian);
        if averaged {
            options = body::averaged(options);
        }
        let mut body = Body::new(mesh, options, &[])?;
        let u = body::field(&body.mesh, |[x, y]| [0.06 * y * (1.0 + x), 0.04 * x * x - 0.03 * y]);
        let before = body.follow(u.clone(), 1.0)?;
        let angle = 100.0_f64.to_radians();
        let after: Vec<f64> = (body.mesh.nodes.iter().zip(u.chunks_exact(2)))
            .flat_map(|(x, u)| {
                let turn = body::turned(angle, [x[0] + u[0], x[1] + u[1]]);
                [u[0] + turn[0], u[1] + turn[1]]
            })
            .collect();
        let found = body.follow(after, 0.0)?;
        let (s, c) = angle.sin_cos();
        let exact: Vec<f64> =
            before.chunks_exact(2).flat_map(|f| [c * f[0] - s * f[1], s * f[0] + c * f[1]]).collect();
        let scale = before.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        let scaled = |f: &[f64]| -> Vec<f64> { f.iter().map(|f| f / scale).collect() };
        ledger
            .claim(format!("nodal forces over the largest, body in plastic flow turned by 100 degrees in one step, quad9, {name}"))
            .values(&scaled(&found))
            .equals_each(&scaled(&exact))
            .absolute(1e-12)
            .evidence(Evidence::Exact, "R f")
            .because("positions of 1 to 2 round to 4e-16, over nodes 1/4 apart that is a strain of 2e-15, times E/Y = 125, and a few of them add up")
            .why_not_tighter("rounding")
            .covers(&[Capability::FiniteStrain, Capability::Plasticity])
            .cost(&Cost::default().counts(&body.work))
            .record();
    }
    Ok(())
}

/// Stretch of the strip.
const STRETCH: f64 = 0.02;

/// Stretches a strip between its grips and turns it by 90 degrees in `steps` forward steps. Returns the largest error
/// of the stress over the largest stress, and the body.
fn strip(steps: usize, carry: bool) -> Result<(f64, Body<2>, Cost), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [2.0, 1.0], [4, 2])?;
    let mesh = body::distorted(mesh, [2.0, 1.0], 0.5, 0.2);
    let material = Material::Elastic(Elastic::new(YOUNG, POISSON)?);
    let limits = Limits { strain: 1.0, rotation: 1.0, ..Limits::default() };
    let options =
        Model { limits, ..body::model(material, Idealisation::PlaneStrain, Kinematics::UpdatedLagrangian) };
    let mut grips = body::side(&mesh, "left")?;
    grips.extend(body::side(&mesh, "right")?);
    let held = body::moved(&mesh, &grips, |[x, _]| [STRETCH * x, 0.0]);
    let mut body = Body::new(mesh, options, &body::dofs(&held))?;
    body.carry = carry;
    // Forces are 0.05; rounding of stiffness times displacement leaves 1e-16.
    body.implicit(&held, &[], 1.0, 1e-14, None)?;
    let start = body.block.stress_at_points();
    let angle = FRAC_PI_2 / steps as f64;
    let (outcome, cost) = Cost::measure(|| -> Result<(), CaseError> {
        for k in 0..steps {
            let increments = body::moved(&body.mesh, &grips, |[x, y]| {
                let place = [x * (1.0 + STRETCH), y];
                let [a, b] = [k, k + 1].map(|k| body::turned(angle * k as f64, place));
                [b[0] - a[0], b[1] - a[1]]
            });
            body.forward(&increments, &[], 1.0)?;
        }
        Ok(())
    });
    outcome?;
    let found = body.block.stress_at_points();
    let cost = cost.counts(&body.work);
    Ok((turned_error(&start, &found), body, cost))
}

/// Largest error of stresses after a turn by 90 degrees over the largest stress.
fn turned_error(start: &[[f64; 6]], found: &[[f64; 6]]) -> f64 {
    let (mut error, mut scale) = (0.0_f64, 0.0_f64);
    for (found, start) in found.iter().zip(start) {
        let exact = body::turned_stress(FRAC_PI_2, start);
        error = error.max(body::largest_difference(&[*found], &exact));
        scale = exact.iter().fold(scale, |m, s| m.max(s.abs()));
    }
    error / scale
}

fn turning(ledger: &mut Ledger, carry: bool) -> Result<(), CaseError> {
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for steps in [90, 180, 360, 720] {
        let (error, body, cost) = strip(steps, carry)?;
        if carry && steps == 90 {
            body_plots::displacement(ledger, "Strip turned by 90 degrees", &body.mesh, &body.u, true)?;
        }
        levels.push((90.0 / steps as f64, error));
        last = cost;
    }
    // In each step the grips follow chords of their circles and the free nodes tangents: a misfit strain of half the
    // square of the angle.
    let angle = FRAC_PI_2 / 720.0;
    let misfit = 0.5 * angle * angle / STRETCH;
    let (order, bound, because) = if carry {
        (
            2.0,
            2.0 * misfit,
            "the misfit of the last step, half the square of the angle over the stretch, is not yet balanced; at most twice that near the grips",
        )
    } else {
        (
            1.0,
            2.0 * 720.0 * misfit,
            "720 times the misfit of a step, half the square of the angle over the stretch; at most twice that near the grips",
        )
    };
    let how = if carry { "carried" } else { "left" };
    ledger
        .order(format!("stress of a strip turned by 90 degrees in forward steps, over the largest stress, unbalanced force {how}"))
        .levels(&levels)
        .expected(order)
        .within(0.1)
        .finest(bound, because)
        .evidence(Evidence::Exact, "R s R^T of the equilibrium before the rotation")
        .because("grips move on chords, the linear system answers with tangents; what is carried is corrected one step later")
        .why_not_tighter("the misfit strain is an estimate of its size, and the edges are free")
        .covers(&[Capability::FiniteStrain, Capability::BodyLimits])
        .cost(&last)
        .record();
    Ok(())
}
