//! Oblique slip on a vertical and on a dipping surface in an infinite body.

use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_plan::faults::Plan;
use std::f64::consts::TAU;

const POISSON: f64 = 0.25;
/// Shear modulus \[Pa\].
const ROCK: f64 = 32e9;
/// Width of the Gaussian \[m\]: slip exp(-r²/2s²).
const WIDTH: f64 = 1000.0;
/// Half length of the part that may slip \[m\].
const PART: f64 = 3.5 * WIDTH;
/// Half size of the box \[m\].
const FAR: f64 = 12.0 * WIDTH;
/// Slip along the rake and across it \[-\].
const DIRECTION: [f64; 2] = [0.8, 0.6];

/// Tractions along both directions at a point of a Gaussian, from the stiffness of each wave vector n k \[Pa/m\]. A wave of slip
/// s causes the traction `-(G k/2) (s + ν/(1-ν) n (n·s))`.
fn waves(at: [f64; 2]) -> [f64; 2] {
    // The integrand is even and smooth in k and periodic in the angle: equal steps converge faster than any power.
    let (steps, angles, most) = (300, 128, 9.0);
    let dk = most / f64::from(steps);
    let mut sum = [0.0; 2];
    for i in 1..steps {
        let k = f64::from(i) * dk;
        let shell = k * k * (-0.5 * k * k).exp();
        for j in 0..angles {
            let (s, c) = (TAU * f64::from(j) / f64::from(angles)).sin_cos();
            let wave = shell * (k / WIDTH * (at[0] * c + at[1] * s)).cos();
            let along = POISSON / (1.0 - POISSON) * (DIRECTION[0] * c + DIRECTION[1] * s);
            sum = [sum[0] + wave * (DIRECTION[0] + along * c), sum[1] + wave * (DIRECTION[1] + along * s)];
        }
    }
    sum.map(|v| -ROCK / (2.0 * WIDTH) * v * dk / f64::from(angles))
}

/// Coordinates from -FAR to FAR, with spacing `size` in the slipping part and growing spacing beyond.
fn places(size: f64) -> Vec<f64> {
    let mut half = vec![0.0];
    let (mut x, mut step) = (0.0, size);
    while x < FAR {
        if x >= PART {
            step *= 1.5;
        }
        x += step;
        half.push(x);
    }
    let below = half.iter().skip(1).rev().map(|x| -x);
    below.chain(half.iter().copied()).collect()
}

/// A fault of this dip \[degrees\] through the middle of a box, with cells of this size \[m\].
fn plan(dip: f64, size: f64) -> Result<Plan, CaseError> {
    let (s, c) = dip.to_radians().sin_cos();
    let end = FAR / s;
    let heights = places(size);
    let text = format!(
        r#"schema = 1
title = "oblique slip"
kinematics = "3d"
[materials.rock]
young = {:?}
poisson = {POISSON}
[bodies.rock]
material = "rock"
mesh.fault = {{ trace = [[{:?}, {FAR:?}], [{:?}, {:?}]], spacing = {{ size = {size:?}, from = {:?}, to = {:?}, ratio = 1.5 }}, thickness = {size:?}, min = [{:?}, {:?}], max = [{:?}, {FAR:?}], growth = 1.5, element = "quad4" }}
extrude = {heights:?}
[faults.main]
minus = "rock.fault.minus"
plus = "rock.fault.plus"
rake = [0, 0, 1]
slip = "free"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.01, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal = "50 MPa"
under_resolved = "allow"
rate = "1e-9 m/s"
damping = 5e6
creep = {{ outside = {{ y = {{ from = {:?}, to = {:?} }}, z = {{ from = {:?}, to = {:?} }} }}, rate = 0.0 }}
[[stages]]
name = "all"
duration = "1 yr"
conditions = [{{ set = "rock.left", x = 0, y = 0, z = 0 }}, {{ set = "rock.right", x = 0, y = 0, z = 0 }}]
[time]
stepper = "fault-ode"
"#,
        2.0 * (1.0 + POISSON) * ROCK,
        end * c,
        -end * c,
        -FAR,
        end - PART,
        end + PART,
        -FAR - end * c,
        -FAR,
        FAR + end * c,
        -PART * s,
        PART * s,
        -PART,
        PART,
    );
    seas::plan(&text)
}

/// Largest errors of the shear tractions and of the normal traction, over the largest shear traction.
fn errors(plan: &Plan) -> [f64; 2] {
    let n = plan.points.len();
    let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let place = |p: usize| {
        let view = &plan.points[p];
        [dot(&view.at, &view.slides), view.across.map_or(f64::NAN, |e| dot(&view.at, &e))]
    };
    let gauss = |p: usize| {
        let [x, y] = place(p);
        (-0.5 * (x * x + y * y) / (WIDTH * WIDTH)).exp()
    };
    let slip: Vec<f64> = DIRECTION.iter().flat_map(|d| (0..n).map(move |p| d * gauss(p))).collect();
    let shear = plan.problem.fault.operator.shear_of(&slip);
    let normal = plan.problem.fault.operator.normal_of(&slip);
    let scale = waves([0.0, 0.0]).map(f64::abs).into_iter().fold(0.0, f64::max);
    let (mut worst, mut opening) = (0.0_f64, 0.0_f64);
    for p in 0..n {
        let at = place(p);
        if at[0].hypot(at[1]) < 2.5 * WIDTH {
            let expected = waves(at);
            worst = worst.max((shear[p] - expected[0]).abs()).max((shear[n + p] - expected[1]).abs());
            opening = opening.max(normal[p].abs());
        }
    }
    [worst / scale, opening / scale]
}

/// Tractions of a Gaussian of oblique slip.
pub(super) fn gaussian(ledger: &mut Ledger) -> Result<(), CaseError> {
    for dip in [90.0, 60.0] {
        let (mut levels, mut last) = (Vec::new(), None);
        for size in [WIDTH, 0.7 * WIDTH, 0.5 * WIDTH] {
            let (found, cost) = Cost::measure(|| plan(dip, size));
            let plan = found?;
            let [shear, normal] = errors(&plan);
            levels.push((size, shear));
            last = Some((normal, cost.count("points", plan.points.len() as f64)));
        }
        let (normal, cost) = last.ok_or("no level")?;
        ledger
            .order(format!("both shear tractions of a Gaussian of oblique slip on a plane in space, dip {dip}, largest error over the largest traction"))
            .levels(&levels)
            .expected(1.5)
            .within(0.5)
            .or_better()
            .evidence(Evidence::SemiAnalytic, "stiffness of a plane against harmonic slip in two directions, which knows no dip")
            .because("second order of trilinear cells and nodal areas, and what does not fall: cells that grow by 1.5 away from the part that slips, the box")
            .finest(6e-2, "3 (h/s)^2/12 = 6 % for averages over cells of s/2")
            .covers(&[Capability::FaultCycles, Capability::Solid3d])
            .cost(&cost)
            .record();
        ledger
            .claim(format!("change of normal traction under a Gaussian of oblique slip over the largest shear traction, dip {dip}, cells of half its width"))
            .value(normal)
            .at_most(if dip == 90.0 { 1e-9 } else { 1e-2 })
            .evidence(Evidence::Exact, "slip on a plane in an infinite body changes no normal traction there")
            .because("none by symmetry of an upright mesh; of a dipping one cells differ on both sides, by a part of the error of shear")
            .why_not_tighter("of the dipping mesh, whose cells differ on both sides, rounding is larger")
            .covers(&[Capability::FaultCycles])
            .cost(&cost)
            .record();
    }
    Ok(())
}
