//! Faults in homogeneous rock without bodies: tractions of dipping faults, cracks, long rectangles, and the cycles of BP1.

mod coulomb;
mod depths;
mod earth;
mod fields;
mod files;
mod grids;
mod locking;
mod receivers;
mod surface;
pub mod triangles;
mod turning;

use crate::cases::fault_operator::matrix;
use crate::cases::{body_plots, dislocation, seas};
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_vary::SceneText;
use dislocation::Stress;
use nalgebra::{Complex, DMatrix, DVector};

/// See the README.
pub const CASE: Case = Case {
    name: "fault_medium",
    readme: include_str!("README.md"),
    covers: &[Capability::Medium, Capability::FaultCycles],
    quick: true,
    run,
};

const POISSON: f64 = 0.25;
const SHEAR_MODULUS: f64 = 32e9;
/// Half length of the cracks \[m\].
const A: f64 = 1000.0;
/// Width down dip of the faults below a free surface \[m\].
const WIDTH: f64 = 10e3;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    dipping(ledger)?;
    long_rectangles(ledger)?;
    cracks(ledger)?;
    disc(ledger)?;
    grid(ledger)?;
    plane(ledger)?;
    triangles::run(ledger)?;
    depths::run(ledger)?;
    fields::run(ledger)?;
    files::run(ledger)?;
    cycles(ledger)?;
    receivers::run(ledger)?;
    locking::run(ledger)?;
    surface::run(ledger)?;
    coulomb::run(ledger)?;
    grids::run(ledger)
}

/// A scene without loads; `fault` holds its geometry.
fn still(kinematics: &str, kind: &str, fault: &str) -> String {
    format!(
        r#"
schema = 1
title = "fault in a medium"
kinematics = "{kinematics}"
[materials.rock]
young = "80 GPa"
poisson = {POISSON}
[medium]
kind = "{kind}"
material = "rock"
[faults.main]
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal = "50 MPa"
rate = "1e-9 m/s"
{fault}
[[stages]]
name = "still"
duration = "1 yr"
[time]
stepper = "fault-ode"
"#
    )
}

/// A straight line from the surface with this dip \[degrees\].
fn line(kinematics: &str, dip: f64, cells: f64) -> String {
    let (s, c) = dip.to_radians().sin_cos();
    let c = if dip == 90.0 { 0.0 } else { c };
    let geometry = format!(
        "line = {{ trace = [[0.0, 0.0], [{:?}, {:?}]], spacing = {:?} }}",
        WIDTH * c,
        -WIDTH * s,
        WIDTH / cells
    );
    still(kinematics, "half-space", &geometry)
}

/// Largest difference of two matrices over the largest entry of the second.
fn difference(found: &DMatrix<f64>, wanted: &DMatrix<f64>) -> f64 {
    (found - wanted).amax() / wanted.amax()
}

/// Tractions of a fault of this dip from single dislocations: shear along the fault upwards, and normal, compression positive.
fn dislocations(dip: f64, cells: usize) -> [DMatrix<f64>; 2] {
    let (s, c) = dip.to_radians().sin_cos();
    let size = WIDTH / cells as f64;
    let point = |along: f64| Complex::new(along * c, -along * s);
    let pull = |k: usize, j: usize| {
        let mut stress = Stress::default();
        let (at, b) = (point((k as f64 + 0.5) * size), Complex::new(c, -s));
        if j > 0 {
            dislocation::add(&mut stress, at, point(j as f64 * size), b, SHEAR_MODULUS, POISSON);
        }
        dislocation::add(&mut stress, at, point((j as f64 + 1.0) * size), -b, SHEAR_MODULUS, POISSON);
        stress.on([-c, s], [s, c])
    };
    [DMatrix::from_fn(cells, cells, |k, j| pull(k, j).0), DMatrix::from_fn(cells, cells, |k, j| pull(k, j).1)]
}

/// Compares the operator of dipping lines with dislocations of the suite.
fn dipping(ledger: &mut Ledger) -> Result<(), CaseError> {
    let cells = 40;
    for dip in [90.0, 60.0, 10.0, 5.0, 2.0] {
        let (plan, cost) = Cost::measure(|| seas::plan(&line("plane-strain", dip, f64::from(cells))));
        let plan = plan?;
        let wanted = dislocations(dip, cells as usize);
        let mut worst = difference(&matrix(&plan, false), &wanted[0]);
        if plan.problem.fault.operator.couples_normal() {
            worst = worst.max((matrix(&plan, true) - &wanted[1]).amax() / wanted[0].amax());
        }
        ledger
            .claim(format!("shear and normal tractions below a free surface, dip {dip}: largest difference over the largest traction"))
            .value(worst)
            .at_most(1e-13)
            .evidence(Evidence::Exact, "edge dislocations at the ends of cells, with reflected potentials")
            .because("rounding of terms of both ends that cancel, of coordinates 40 times a cell, in both sums")
            .why_not_tighter("a bound for all dips; digits are lost at a flat dip most")
            .covers(&[Capability::Medium, Capability::PlaneStrain])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// A rectangle of this dip \[degrees\], `length` long, of one column of cells.
fn column(dip: f64, length: f64, rake: [f64; 3], cells: usize) -> String {
    let size = WIDTH / cells as f64;
    let [from, to] = [0.5 * length, -0.5 * length];
    // Columns as long as the rectangle; only `size` below the width makes several rows.
    let geometry = format!(
        "rake = {rake:?}\nrectangle = {{ from = [0.0, 0.0, {from:?}], to = [0.0, 0.0, {to:?}], dip = \"{dip} deg\", width = {WIDTH:?}, size = {size:?} }}"
    );
    still("3d", "half-space", &geometry)
}

/// Changes of the shear or normal tractions of a plan with slip.
fn changes(plan: &Plan, slip: &[f64], normal: bool) -> Vec<f64> {
    let operator = &plan.problem.fault.operator;
    if normal { operator.normal_of(slip) } else { operator.shear_of(slip) }
}

/// Compares slip that is uniform along long rectangles with slip in the plane.
fn long_rectangles(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (rows, columns) = (5, 401);
    let length = WIDTH / rows as f64 * columns as f64;
    for dip in [90.0, 30.0, 5.0] {
        let (s, c) = f64::to_radians(dip).sin_cos();
        let mut worst = [0.0_f64; 2];
        let mut spent = None;
        for (rake, kinematics) in [([0.0, 0.0, 1.0], "antiplane"), ([-c, s, 0.0], "plane-strain")] {
            let (found, cost) = Cost::measure(|| seas::plan(&column(dip, length, rake, rows)));
            let found = found?;
            let plane = seas::plan(&line(kinematics, dip, rows as f64))?;
            let slip: Vec<f64> = (0..rows).map(|k| (1.0 + k as f64).sqrt()).collect();
            let long: Vec<f64> = (0..rows * columns).map(|p| slip[p / columns]).collect();
            let middle = |values: &[f64]| -> Vec<f64> {
                (0..rows).map(|row| values[row * columns + columns / 2]).collect()
            };
            let wanted = [false, true].map(|normal| changes(&plane, &slip, normal));
            let scale = wanted[0].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            for normal in [false, true] {
                let found = middle(&changes(&found, &long, normal));
                let off = found.iter().zip(&wanted[usize::from(normal)]);
                let off = off.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / scale;
                worst[usize::from(normal)] = worst[usize::from(normal)].max(off);
            }
            spent = Some(cost);
        }
        for (kind, worst) in ["shear", "normal"].into_iter().zip(worst) {
            let draft = ledger
                .claim(format!("{kind} tractions in the middle of a rectangle {columns} cells long, dip {dip}, against slip in the plane"))
                .value(worst)
                .at_most(0.5 * (2.0 * WIDTH / length).powi(2))
                .evidence(Evidence::Exact, "a rectangle without ends is a strip")
                .because("what lies beyond the ends is missing: a share of (W/x)^2 at the distance x, half the length")
                .why_not_tighter("the factor depends on depth and dip")
                .covers(&[Capability::Medium, Capability::Solid3d]);
            match &spent {
                Some(cost) => draft.cost(cost).record(),
                None => draft.record(),
            }
        }
    }
    Ok(())
}

/// A line of a whole-space with these cells, and a vertical one from the surface of a half-space.
fn cracked(kinematics: &str, kind: &str, cells: u32) -> Result<Plan, CaseError> {
    let upper = if kind == "half-space" { 0.0 } else { A };
    let spacing = (upper + A) / f64::from(cells);
    seas::plan(&still(
        kinematics,
        kind,
        &format!("line = {{ trace = [[0.0, {upper:?}], [0.0, {:?}]], spacing = {spacing:?} }}", -A),
    ))
}

/// Slip under a drop of shear traction of 1 Pa.
fn slip(plan: &Plan) -> Result<DVector<f64>, CaseError> {
    let n = plan.points.len();
    Ok(matrix(plan, false).lu().solve(&DVector::repeat(n, -1.0)).ok_or("the operator is singular")?)
}

/// Claims the potency of cracks under uniform stress.
fn cracks(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut figure =
        Plot::xy("Slip of a crack in plane strain", "y over a [-]", "slip over that in the middle [-]");
    for (kinematics, kind, compliance, what) in [
        ("antiplane", "whole-space", 1.0, "antiplane"),
        ("antiplane", "half-space", 1.0, "antiplane, from the surface"),
        ("plane-strain", "whole-space", 1.0 - POISSON, "plane strain"),
    ] {
        let peak = 2.0 * compliance * A / SHEAR_MODULUS;
        let share = if kind == "half-space" { 0.5 } else { 1.0 };
        let exact = share * peak * A * std::f64::consts::FRAC_PI_2;
        let mut levels = Vec::new();
        let mut spent = None;
        for cells in [20, 40, 80, 160] {
            let (plan, cost) = Cost::measure(|| cracked(kinematics, kind, cells));
            let plan = plan?;
            let slip = slip(&plan)?;
            let found: f64 = plan.points.iter().zip(slip.iter()).map(|(p, s)| p.area * s).sum();
            levels.push((plan.points[0].area, (found / exact - 1.0).abs()));
            spent = Some(cost);
            if kinematics == "plane-strain" && cells == 20 {
                let found = plan.points.iter().zip(slip.iter()).map(|(p, s)| (p.at[1] / A, s / peak));
                let curve = (0..=400).map(|k| f64::from(k) / 200.0 - 1.0);
                let curve: Vec<_> = curve.map(|x| (x, (1.0 - x * x).max(0.0).sqrt())).collect();
                figure = figure
                    .series(Series::line("closed form", &curve))
                    .series(Series::points("20 cells", &body_plots::apart(&found.collect::<Vec<_>>())));
            }
        }
        let cost = spent.ok_or("no level")?;
        ledger
            .order(format!("potency of a crack under uniform stress, {what}"))
            .levels(&levels)
            .expected(1.0)
            .within(0.05)
            .evidence(
                Evidence::Exact,
                "2 (1 - nu) dtau/G sqrt(a^2 - x^2), without (1 - nu) in antiplane motion",
            )
            .because("the square root at the tips, which cells of constant slip miss by O(h)")
            .finest(
                1.001 * 0.5 * levels[levels.len() - 1].0 / A,
                "the potency of n cells of constant slip in a whole-space is that of the crack times 1 + 1/n",
            )
            .covers(&[Capability::Medium])
            .cost(&cost)
            .record();
    }
    ledger.plot(figure);
    Ok(())
}

/// Claims the potency of a circular crack, from the cells whose centres lie in it.
fn disc(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = 8.0 * (1.0 - POISSON) / (std::f64::consts::PI * (2.0 - POISSON)) / SHEAR_MODULUS
        * (2.0 / 3.0 * std::f64::consts::PI * A.powi(3));
    let mut levels = Vec::new();
    let mut spent = None;
    for cells in [12, 24, 36] {
        let size = 2.0 * A / f64::from(cells);
        let geometry = format!(
            "rake = [0, 0, 1]\nslip = \"free\"\nrectangle = {{ from = [0.0, {A:?}, {A:?}], to = [0.0, {A:?}, {:?}], width = {:?}, size = {size:?} }}",
            -A,
            2.0 * A
        );
        let (plan, cost) = Cost::measure(|| seas::plan(&still("3d", "whole-space", &geometry)));
        let plan = plan?;
        let n = plan.points.len();
        let inside: Vec<usize> =
            (0..n).filter(|&p| plan.points[p].at[1].hypot(plan.points[p].at[2]) < A).collect();
        let mut columns = Vec::new();
        let mut unit = vec![0.0; 2 * n];
        let both: Vec<usize> = inside.iter().copied().chain(inside.iter().map(|p| n + p)).collect();
        for &p in &both {
            unit[p] = 1.0;
            let traction = plan.problem.fault.operator.shear_of(&unit);
            unit[p] = 0.0;
            columns.push(DVector::from_iterator(both.len(), both.iter().map(|&q| traction[q])));
        }
        let count = inside.len();
        let drop = DVector::from_fn(2 * count, |k, _| if k < count { -1.0 } else { 0.0 });
        let slip = DMatrix::from_columns(&columns).lu().solve(&drop).ok_or("the operator is singular")?;
        let potency = slip.rows(0, count).sum() * size * size;
        // The staircase has another area than the circle.
        let area = count as f64 * size * size;
        let circle = std::f64::consts::PI * A * A;
        levels.push((size, (potency / exact * (circle / area).powf(1.5) - 1.0).abs()));
        spent = Some(cost);
    }
    let cost = spent.ok_or("no level")?;
    ledger
        .claim("potency of a circular crack of slip that may turn, relative error, 36 cells across")
        .value(levels[levels.len() - 1].1)
        .at_most(1.5 / 36.0 * 2.0)
        .evidence(Evidence::Exact, "8 (1 - nu)/(pi (2 - nu)) dtau/G sqrt(a^2 - r^2), for a radius of equal area")
        .because("the crack is longer by about half a cell at its rim, and its potency grows with the third power of the radius: 3/36")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    ledger
        .claim("fall of that error from 12 to 36 cells across")
        .value(levels[0].1 / levels[levels.len() - 1].1)
        .at_least(2.0)
        .evidence(Evidence::Exact, "8 (1 - nu)/(pi (2 - nu)) dtau/G sqrt(a^2 - r^2), for a radius of equal area")
        .because("the error is of first order, a factor of 3, but for the outline, which differs from one division to the next")
        .why_not_tighter("the outline of cells")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}

/// Plans of a scene with the operator of a grid and with a dense one, and the cost of the first.
fn both_forms(text: &str) -> Result<([Plan; 2], Cost), CaseError> {
    let scene = scene::read(text).map_err(|e| e.to_string())?;
    let (fast, cost) = Cost::measure(|| plan_with(&scene, Form::Fitting));
    let plans = [fast, plan_with(&scene, Form::Dense)];
    let [fast, dense] = plans.map(|p| p.map_err(|e| e.to_string()));
    let (fast, dense) = (fast?, dense?);
    if fast.problem.fault.operator.words() == dense.problem.fault.operator.words() {
        return Err("both forms of the operator are the same".into());
    }
    Ok(([fast, dense], cost))
}

/// Compares products by Fourier transforms along strike and down dip with those of full matrices.
fn plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let geometry = format!(
        "rake = [0.3, 0.1, 1.0]\nslip = \"free\"\nrectangle = {{ from = [0.0, 0.0, {:?}], to = [0.0, 0.0, 0.0], dip = \"30 deg\", width = {WIDTH:?}, size = {:?} }}",
        3.0 * WIDTH,
        WIDTH / 6.0
    );
    let (plans, cost) = both_forms(&still("3d", "whole-space", &geometry))?;
    let [fast, dense] = plans.map(|plan| {
        let operator = &plan.problem.fault.operator;
        let count = operator.points() * operator.components();
        let mut tractions = DMatrix::zeros(count, count);
        for (k, mut column) in tractions.column_iter_mut().enumerate() {
            let slip: Vec<f64> = (0..count).map(|j| f64::from(u8::from(j == k))).collect();
            column.copy_from_slice(&operator.shear_of(&slip));
        }
        tractions
    });
    ledger
        .claim("tractions of a dipping grid in a whole-space by Fourier transforms against the full matrix: largest difference over the largest entry")
        .value(difference(&fast, &dense))
        .at_most(5e-15)
        .evidence(Evidence::Exact, "entries of each pair of cells, added one by one")
        .because("rounding of the transforms: some units in the last place of the largest entry")
        .why_not_tighter("rounding grows with the logarithm of the lengths, by a factor that is not known")
        .covers(&[Capability::Medium])
        .cost(&cost)
        .record();
    Ok(())
}

/// Compares products by the Fourier transform with those of full matrices of the same entries.
fn grid(ledger: &mut Ledger) -> Result<(), CaseError> {
    let ([fast, dense], cost) = both_forms(&column(30.0, 9.0 * WIDTH, [0.3, 0.1, 1.0], 6))?;
    let worst = [false, true].map(|normal| difference(&matrix(&fast, normal), &matrix(&dense, normal)));
    ledger
        .claim("tractions of a dipping grid by Fourier transform against the full matrix, shear and normal: largest difference over the largest entry")
        .value(worst[0].max(worst[1]))
        .at_most(5e-15)
        .evidence(Evidence::Exact, "the same entries, added one by one")
        .because("rounding of the transform: some units in the last place of the largest entry")
        .why_not_tighter("rounding grows with the logarithm of the length, by a factor that is not known")
        .covers(&[Capability::Medium])
        .cost(&cost)
        .record();
    Ok(())
}

/// Runs BP1 in the half-space with cells of this size \[m\] up to some event.
fn bp1(size: f64, events: usize) -> Result<(seas::CycleResults, Vec<(f64, f64)>), CaseError> {
    let text = SceneText::new(include_str!("../../../scenes/bp1-half-space.toml"))
        .with("faults.main.line.spacing", format!("{size} m"))
        .text()?;
    let plan = seas::plan(&text)?;
    let mut settings = plan.problem.settings;
    settings.most_events = Some(events);
    let mut rates = Vec::new();
    let found =
        seas::found(&plan, &settings, |now| rates.push((now.at.seconds() / seas::YEAR, now.largest)))?;
    Ok((found, rates))
}

/// Claims the events of BP1.
fn cycles(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (fine, rates) = bp1(78.125, 3)?;
    let second = seas::independent("bp1", 78.125)?;
    for (k, (found, wanted)) in fine.onsets.iter().zip(&second).enumerate() {
        ledger
            .claim(format!("onset of event {} of BP1, cells of 78 m", k + 1))
            .unit("yr")
            .value(*found)
            .equals(*wanted)
            .absolute(0.004)
            .uncertainty(0.001)
            .evidence(Evidence::OtherCode, seas::INDEPENDENT)
            .because("the same cells and kernels: what differs are errors of steps, 1e-5 of the time")
            .why_not_tighter("errors of steps add up from event to event")
            .covers(&[Capability::Medium, Capability::Antiplane])
            .cost(&fine.cost)
            .record();
    }
    let (finest, _) = bp1(39.0625, 1)?;
    ledger
        .claim("onset of the first event of BP1, cells of 39 m, error")
        .unit("yr")
        .value((finest.onsets[0] - CONVERGED).abs())
        .at_most(0.01)
        .evidence(Evidence::OtherCode, seas::CONVERGED)
        .because("the reference is known to 0.005 yr; 8.7 cells to the cohesive zone leave as much")
        .why_not_tighter("the error of cells of 39 m is not known apart from that of the reference")
        .covers(&[Capability::Medium, Capability::Antiplane])
        .cost(&finest.cost)
        .record();
    let (reference, _) = seas::largest_rates()?;
    ledger.plot(
        Plot::xy("Largest slip rate of BP1", "time [yr]", "V_max [m/s]")
            .axes(Axis::Linear, Axis::Log)
            .series(Series::line("half-space, cells of 78 m", &rates))
            .series(Series::line("boundary elements of 78 m", &reference))
            .caption("Three events; the reference is bp1_largest_rate.py in verification/independent."),
    );
    Ok(())
}

/// Onset of the first event of BP1 \[yr\].
const CONVERGED: f64 = 196.365;
