//! Linear viscoelasticity: exact at constant strain rate, second order otherwise.

mod sheet;

use super::body::{self, Body, Entry, Work};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Floor, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::maxwell::{Branch, Maxwell};
use asperity_fem::nonlinear::{Kinematics, Material};
use asperity_fem::surface;

/// See the README.
pub const CASE: Case = Case {
    name: "maxwell_relaxation",
    readme: include_str!("README.md"),
    covers: &[Capability::Viscoelasticity],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;
const POISSON: f64 = 0.3;
const BULK: f64 = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
const VISCOSITY: f64 = 1.7;
const TIME: f64 = VISCOSITY / SHEAR;
/// Share of the Maxwell branch in the stiffness of the standard linear solid, and its relaxation time.
const SHARE: f64 = 0.6;
const SOLID_TIME: f64 = 0.9 / (SHARE * SHEAR);

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    strains(ledger)?;
    creep(ledger)?;
    sheet::claims(ledger)?;
    cylinder(ledger)
}

fn fluid() -> Result<Material, CaseError> {
    Ok(Material::Maxwell(Maxwell::new(&Elastic::new(YOUNG, POISSON)?, VISCOSITY)?))
}

fn solid() -> Result<Material, CaseError> {
    let branch = Branch { share: SHARE, viscosity: 0.9 };
    Ok(Material::Maxwell(Maxwell::generalised(&Elastic::new(YOUNG, POISSON)?, &[branch])?))
}

/// Shear stress and mean stress after a shear and a dilatation applied at once and another shear at a constant rate until
/// `end`, in `steps` steps.
fn driven(
    material: Material,
    jump: [f64; 2],
    rate: f64,
    end: f64,
    steps: usize,
) -> Result<([f64; 2], Work), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2; 2])?;
    let mesh = body::distorted(mesh, [1.0; 2], 0.5, 0.2);
    let mut body = Body::new(mesh, body::model(material, Idealisation::PlaneStrain, Kinematics::Small), &[])?;
    let at = |body: &Body<2>, t: f64| {
        body::field(&body.mesh, |[x, y]| [(jump[0] + rate * t) * y + 0.5 * jump[1] * x, 0.5 * jump[1] * y])
    };
    let u = at(&body, 0.0);
    body.follow(u, 0.0)?;
    for k in 1..=steps {
        let u = at(&body, end * k as f64 / steps as f64);
        body.follow(u, end / steps as f64)?;
    }
    let s = body.block.stress_at_points()[5];
    Ok(([s[3], (s[0] + s[1] + s[2]) / 3.0], body.work))
}

/// A constructor of a material.
type Make<'a> = &'a dyn Fn() -> Result<Material, CaseError>;

fn strains(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (jump, rate) = ([0.02, 0.03], 0.01);
    let grown = |x: f64| 1.0 - (-x).exp();
    let held = |time: f64, t: f64| (-t / time).exp();
    let cases: [(&str, Make<'_>, f64, f64, f64); 4] = [
        (
            "Maxwell, strain held for 2.5 relaxation times",
            &fluid,
            0.0,
            2.5 * TIME,
            SHEAR * jump[0] * held(TIME, 2.5 * TIME),
        ),
        (
            "Maxwell, constant rate for 3 relaxation times",
            &fluid,
            rate,
            3.0 * TIME,
            SHEAR * jump[0] * held(TIME, 3.0 * TIME) + VISCOSITY * rate * grown(3.0),
        ),
        (
            "standard linear solid, strain held for 1.5 relaxation times",
            &solid,
            0.0,
            1.5 * SOLID_TIME,
            SHEAR * jump[0] * (1.0 - SHARE + SHARE * held(SOLID_TIME, 1.5 * SOLID_TIME)),
        ),
        (
            "standard linear solid, constant rate for 2 relaxation times",
            &solid,
            rate,
            2.0 * SOLID_TIME,
            SHEAR * jump[0] * (1.0 - SHARE + SHARE * held(SOLID_TIME, 2.0 * SOLID_TIME))
                + SHEAR * (1.0 - SHARE) * rate * 2.0 * SOLID_TIME
                + 0.9 * rate * grown(2.0),
        ),
    ];
    for (what, material, rate, end, shear) in cases {
        let (mut found, mut pressures, mut last) = (Vec::new(), Vec::new(), Cost::default());
        for steps in [1, 7, 100] {
            let (outcome, cost) = Cost::measure(|| driven(material()?, jump, rate, end, steps));
            let ([s, p], work) = outcome?;
            found.push(s);
            pressures.push(p);
            last = cost.counts(&work);
        }
        ledger
            .claim(format!("shear stress, {what}, in 1, 7 and 100 steps"))
            .values(&found)
            .equals_each(&[shear; 3])
            .relative(1e-13)
            .evidence(Evidence::Exact, "closed form")
            .because("the update is exact at a constant rate: rounding of 100 exponentials and of strains from nodal positions")
            .why_not_tighter("1e-16 for each step and operation add up at worst")
            .cost(&last)
            .record();
        ledger
            .claim(format!("mean stress, {what}, in 1, 7 and 100 steps"))
            .values(&pressures)
            .equals_each(&[BULK * jump[1]; 3])
            .relative(1e-13)
            .evidence(Evidence::Exact, "the bulk does not relax")
            .because("rounding of 100 sums")
            .why_not_tighter("1e-16 for each step and operation add up at worst")
            .record();
    }
    let times: Vec<f64> = (0..=20).map(|k| 0.15 * f64::from(k)).collect();
    let curve = |f: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> { times.iter().map(|&t| (t, f(t))).collect() };
    ledger.plot(
        Plot::xy(
            "Relaxation at held strain",
            "time over the relaxation time [-]",
            "shear stress over G gamma [-]",
        )
        .series(Series::line("Maxwell", &curve(&|t| (-t).exp())))
        .series(Series::line("standard linear solid", &curve(&|t| 1.0 - SHARE + SHARE * (-t).exp())))
        .caption("Exact curves; the program's points lie on them to rounding, in any number of steps."),
    );
    Ok(())
}

/// Displacement of the top of a square in antiplane shear under a traction of 0.05 held until `end`.
fn crept(material: Material, end: f64, steps: usize) -> Result<(f64, Work), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2; 2])?;
    let mesh = body::distorted(mesh, [1.0; 2], 0.5, 0.2);
    let load = surface::integrate(&mesh, &mesh.side_sets["top"], Idealisation::Antiplane, |point, value| {
        value[0] = 0.05 * surface::length(&point.normal);
    });
    let fixed = body::side(&mesh, "bottom")?;
    let top = body::side(&mesh, "top")?[0];
    let mut body =
        Body::new(mesh, body::model(material, Idealisation::Antiplane, Kinematics::Small), &fixed)?;
    // Forces are 0.01; rounding of stiffness times displacement leaves 1e-17.
    let balanced = 1e-15;
    body.implicit(&[], &load, 0.0, balanced, None)?;
    for _ in 0..steps {
        body.implicit(&[], &load, end / steps as f64, balanced, None)?;
    }
    Ok((body.u[top], body.work))
}

fn creep(ledger: &mut Ledger) -> Result<(), CaseError> {
    let end = 3.0 * TIME;
    let exact = 0.05 / SHEAR + 0.05 * end / VISCOSITY;
    let (mut found, mut last) = (Vec::new(), Cost::default());
    for steps in [1, 7, 100] {
        let (outcome, cost) = Cost::measure(|| crept(fluid()?, end, steps));
        let (u, work) = outcome?;
        found.push(u);
        last = cost.counts(&work);
    }
    ledger
        .claim("creep of a Maxwell material in 1, 7 and 100 steps")
        .values(&found)
        .equals_each(&[exact; 3])
        .relative(1e-11)
        .evidence(Evidence::Exact, "tau/G + tau t/eta")
        .because(
            "a constant stress makes a constant rate; forces are balanced to 1e-15 of 1e-2, a hundred times",
        )
        .why_not_tighter("Newton's method is exact after one iteration of a linear problem and leaves less")
        .cost(&last)
        .record();
    let (stiff, soft) = (SHEAR, (1.0 - SHARE) * SHEAR);
    let end = 2.0 * SOLID_TIME;
    let retarded = SOLID_TIME * stiff / soft;
    let exact = 0.05 * (1.0 / soft - (1.0 / soft - 1.0 / stiff) * (-end / retarded).exp());
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for steps in [4, 8, 16, 32] {
        let (outcome, cost) = Cost::measure(|| crept(solid()?, end, steps));
        let (u, work) = outcome?;
        levels.push((1.0 / steps as f64, (u / exact - 1.0).abs()));
        last = cost.counts(&work);
    }
    ledger
        .order("creep of a standard linear solid over 2 relaxation times, relative, in the step")
        .levels(&levels)
        .expected(2.0)
        .within(0.05)
        .finest((2.0_f64 / 32.0).powi(2) / 12.0, "the square of the step over the relaxation time, over twelve: the error of a rate held over the step in an exponential")
        .evidence(Evidence::Exact, "tau (1/G_inf - (1/G_inf - 1/G_0) exp(-t/lambda)), lambda = T G_0/G_inf")
        .because("the rate is held over a step at its mean: order 2")
        .why_not_tighter("the retarded part is 60 % of the compliance and has nearly come to rest")
        .cost(&last)
        .record();
    Ok(())
}

const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const PRESSURE: f64 = 0.01;

/// Radial displacement of the cylinder.
fn exact_cylinder(r: f64, t: f64) -> f64 {
    let ring = PRESSURE * INNER * INNER / (OUTER * OUTER - INNER * INNER);
    let start = 1.0 / (BULK + SHEAR / 3.0);
    let beta = BULK * start / TIME;
    let plane = 1.0 / BULK + (start - 1.0 / BULK) * (-beta * t).exp();
    ring * (0.5 * r * plane + 0.5 * OUTER * OUTER / r * (1.0 / SHEAR + t / VISCOSITY))
}

/// Displacements of the inner and outer face at `end`, and the body.
fn pressed(cells: usize, end: f64, steps: usize) -> Result<([f64; 2], Body<2>), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad9, [INNER, 0.0], [OUTER, 0.05], [cells, 1])?;
    let load: Vec<Entry> = body::unit_pressure(&mesh, "left", Idealisation::Axisymmetric)?
        .into_iter()
        .map(|(dof, f)| (dof, PRESSURE * f))
        .collect();
    let mut fixed: Vec<usize> = body::side(&mesh, "bottom")?.iter().map(|n| 2 * n + 1).collect();
    fixed.extend(body::side(&mesh, "top")?.iter().map(|n| 2 * n + 1));
    let (inner, outer) = (body::side(&mesh, "left")?[0], body::side(&mesh, "right")?[0]);
    let mut body =
        Body::new(mesh, body::model(fluid()?, Idealisation::Axisymmetric, Kinematics::Small), &fixed)?;
    // Forces are 1e-3; rounding of stiffness times displacement leaves 1e-16.
    let balanced = 1e-14;
    body.implicit(&[], &load, 0.0, balanced, None)?;
    for _ in 0..steps {
        body.implicit(&[], &load, end / steps as f64, balanced, None)?;
    }
    Ok(([body.u[2 * inner], body.u[2 * outer]], body))
}

fn cylinder(ledger: &mut Ledger) -> Result<(), CaseError> {
    let end = 2.0 * TIME;
    let exact = [exact_cylinder(INNER, end), exact_cylinder(OUTER, end)];
    let (mut levels, mut work, mut last) = (Vec::new(), Vec::new(), Cost::default());
    for steps in [2, 4, 8, 16] {
        let (outcome, cost) = Cost::measure(|| pressed(32, end, steps));
        let (found, body) = outcome?;
        let error = (found[0] - exact[0]).hypot(found[1] - exact[1]) / exact[0];
        levels.push((1.0 / steps as f64, error));
        work.push((error, cost.wall.unwrap_or(f64::NAN)));
        last = cost.counts(&body.work);
        if steps == 16 {
            body_plots::displacement(ledger, "Slice of the cylinder at the end", &body.mesh, &body.u, false)?;
        }
    }
    ledger
        .order("displacements of a Maxwell cylinder under constant pressure over 2 relaxation times, relative, in the step")
        .levels(&levels)
        .expected(2.0)
        .within(0.1)
        .floor(Floor::Space, 2e-8)
        .finest(3e-5, "(2/16)^2/12 = 1.3e-3 of the part that relaxes, (r/2)(1/K - 1/(K + G/3)) of 2 %, at both faces")
        .evidence(Evidence::Exact, "elastic solution with G s/(s + 1/tau), transformed back")
        .because("the strain rate varies while the plane part relaxes and is held over a step")
        .why_not_tighter("the part that relaxes has nearly done so at the end")
        .cost(&last)
        .record();
    let (outcome, cost) = Cost::measure(|| pressed(32, 0.0, 1));
    let (found, body) = outcome?;
    ledger
        .claim("displacements of the cylinder at the moment of loading")
        .values(&found)
        .equals_each(&[exact_cylinder(INNER, 0.0), exact_cylinder(OUTER, 0.0)])
        .relative(1e-7)
        .evidence(Evidence::Exact, "Lame; a step of no length is elastic")
        .because("(h/a)^4 = 1e-6 with a constant of a tenth")
        .why_not_tighter("a power with a guessed constant")
        .cost(&cost.counts(&body.work))
        .record();
    ledger.plot(
        Plot::work_precision("Work and precision of the cylinder", "relative error [-]", "time [s]")
            .series(Series::marked("2 to 16 steps", &work)),
    );
    Ok(())
}
