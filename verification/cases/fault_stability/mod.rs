//! Growth rates of perturbations of steady sliding, by wavelength, against linear theory.

use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_cycles::{Equations, Layout, run as integrate};
use asperity_ode::{Clock, Outcome, Problem};
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;
use modes::Mode;
use nalgebra::{Complex, Matrix2};
use std::f64::consts::PI;

mod lengths;
mod modes;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_stability",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::AgeingLaw, Capability::SlipLaw],
    quick: true,
    run,
};

/// Length of the fault \[m\].
const WIDTH: f64 = 2000.0;
/// Thickness of a layer \[m\].
const THICKNESS: f64 = 1000.0;
const SHEAR_MODULUS: f64 = 30e9;
const POISSON: f64 = 0.25;
const NORMAL: f64 = 50e6;
const A: f64 = 0.010;
const B: f64 = 0.015;
/// Slip rate \[m/s\].
const RATE: f64 = 1e-6;
/// The mode of the critical wavelength between half-spaces.
const CRITICAL: usize = 4;
/// Highest mode compared: the coarsest mesh has three cells per wavelength.
const HIGHEST: usize = 6;

/// L \[m\]: the critical wavelength π G L/(σ (b - a)) is 2 W/4.
fn length() -> f64 {
    2.0 * WIDTH / CRITICAL as f64 * NORMAL * (B - A) / (PI * SHEAR_MODULUS)
}

/// A variant of the scene.
#[derive(Clone, Copy)]
struct Variant {
    size: f64,
    element: &'static str,
    evolution: &'static str,
    /// η \[Pa s/m\].
    damping: f64,
    sides: Sides,
}

/// Motion and boundary conditions of the outer faces.
#[derive(Clone, Copy, PartialEq)]
enum Sides {
    /// Antiplane, both outer faces fixed.
    Held,
    /// Antiplane, outer face of B free.
    OneFree,
    /// Plane strain, both outer faces fixed, layers twice as thick.
    Plane,
}

const FIRST: Variant =
    Variant { size: 62.5, element: "quad9", evolution: "ageing", damping: 0.0, sides: Sides::Held };

impl Variant {
    fn plan(&self) -> Result<Plan, CaseError> {
        let scene = SceneText::new(include_str!("scene.toml"))
            .with_or_same("bodies.A.mesh.block.size", format!("{} m", self.size))
            .with_or_same("bodies.B.mesh.block.size", format!("{} m", self.size))
            .with_or_same("bodies.A.mesh.block.element", self.element)
            .with_or_same("bodies.B.mesh.block.element", self.element)
            .with_or_same("faults.main.law.evolution", self.evolution)
            .with_or_same("faults.main.damping", format!("{:e}", self.damping));
        let scene = match self.sides {
            Sides::Held => scene,
            // The traction does not change while B moves as a whole.
            Sides::OneFree => scene.with("stages[0].conditions[0].z", 0).without("stages[0].conditions[1]"),
            Sides::Plane => {
                let held = scene
                    .with("kinematics", "plane-strain")
                    .with("bodies.A.mesh.block.min[0]", "-2 km")
                    .with("bodies.B.mesh.block.max[0]", "2 km")
                    .with(
                        "stages[0].conditions[0]",
                        r#"{ set = "A.left", x = 0, y = { rate = "-0.5 um/s" } }"#,
                    )
                    .with(
                        "stages[0].conditions[1]",
                        r#"{ set = "B.right", x = 0, y = { rate = "0.5 um/s" } }"#,
                    );
                ["A.bottom", "A.top", "B.bottom", "B.top"].iter().fold(held, |scene, set| {
                    scene.push("stages[0].conditions", format!("{{ set = \"{set}\", x = 0 }}"))
                })
            }
        };
        seas::plan(&scene.text()?)
    }

    /// Stiffness of the bodies under slip of mode `n` \[Pa/m\].
    fn stiffness(&self, n: usize) -> f64 {
        let k = PI * n as f64 / WIDTH;
        let tanh = (k * THICKNESS).tanh();
        match (self.sides, n) {
            (Sides::Held, 0) => SHEAR_MODULUS / (2.0 * THICKNESS),
            (Sides::Held, _) => SHEAR_MODULUS * k / (2.0 * tanh),
            (Sides::OneFree, 0) => 0.0,
            (Sides::OneFree, _) => SHEAR_MODULUS * k / (tanh + 1.0 / tanh),
            (Sides::Plane, _) => SHEAR_MODULUS * k / (2.0 * (1.0 - POISSON)),
        }
    }

    /// Roots s of the theory over V/L.
    fn theory(&self, n: usize) -> [Complex<f64>; 2] {
        let a = A + self.damping * RATE / NORMAL;
        let kappa = self.stiffness(n) * length() / NORMAL;
        let (half, product) = (0.5 * (a - B + kappa) / a, kappa / a);
        let root = Complex::new(half * half - product, 0.0).sqrt();
        [root - half, -root - half]
    }
}

/// Largest distance between a root and the nearest theoretical one.
fn distance(found: &[Complex<f64>; 2], expected: &[Complex<f64>; 2]) -> f64 {
    let nearest = |e: &Complex<f64>| found.iter().map(|f| (f - e).norm()).fold(f64::INFINITY, f64::min);
    expected.iter().map(nearest).fold(0.0, f64::max)
}

/// Eigenvalues of a real matrix.
fn eigenvalues(m: &Matrix2<f64>) -> [Complex<f64>; 2] {
    let half = 0.5 * m.trace();
    let root = Complex::new(half * half - m.determinant(), 0.0).sqrt();
    [root + half, -root + half]
}

/// Perturbation of m and of ln θ: the error of central differences is its square times third derivatives of order one.
const KICK: f64 = 1e-5;

/// Growth rates of a mode over V/L from the linearised equations, and the largest rate outside the mode over V/L.
fn linearised(plan: &Plan, mode: &Mode) -> ([Complex<f64>; 2], f64) {
    let (shear, normal) =
        plan.problem.loading.rates(1.0, plan.points.len(), plan.problem.fault.operator.couples_normal());
    let equations = Equations::new(&plan.problem.fault, shear, normal);
    let layout = equations.layout();
    let (mut y, mut up, mut down) =
        (plan.problem.start.clone(), vec![0.0; layout.size()], vec![0.0; layout.size()]);
    let mut matrix = Matrix2::zeros();
    let mut beside = 0.0_f64;
    let parts = [layout.m(), layout.states()];
    for (column, part) in parts.iter().enumerate() {
        let scale = scale(plan, column);
        for (sign, out) in [(1.0, &mut up), (-1.0, &mut down)] {
            y.copy_from_slice(&plan.problem.start);
            y[part.clone()].iter_mut().zip(&mode.shape).for_each(|(y, c)| *y += sign * KICK * scale * c);
            equations.rates(Clock::new(0.0, 0.0), &y, out);
        }
        for (row, part) in parts.iter().enumerate() {
            let unit = 2.0 * KICK * self::scale(plan, row) * RATE / length();
            let change: Vec<f64> = part.clone().map(|i| (up[i] - down[i]) / unit).collect();
            let along = mode.amplitude(&change);
            matrix[(row, column)] = along;
            beside = change.iter().zip(&mode.shape).fold(beside, |b, (d, c)| b.max((d - along * c).abs()));
        }
    }
    (eigenvalues(&matrix), beside)
}

/// Change of m or of the state that corresponds to a unit change of ln V.
fn scale(plan: &Plan, part: usize) -> f64 {
    if part == 0 { 1.0 } else { plan.problem.fault.law.state_scale(0) }
}

/// Largest error of growth rates over V/L of these modes.
fn errors(variant: &Variant, which: &[usize]) -> Result<(f64, f64, Vec<[f64; 6]>), CaseError> {
    let plan = variant.plan()?;
    let found = modes::softest(&plan, HIGHEST + 1)?;
    let (mut worst, mut beside, mut rows) = (0.0_f64, 0.0_f64, Vec::new());
    for &n in which {
        let (roots, rest) = linearised(&plan, &found[n]);
        let expected = variant.theory(n);
        worst = worst.max(distance(&roots, &expected));
        beside = beside.max(rest);
        rows.push([
            n as f64,
            found[n].stiffness,
            variant.stiffness(n),
            roots[0].re,
            expected[0].re,
            expected[0].im,
        ]);
    }
    Ok((worst, beside, rows))
}

const THEORY: &str = "roots of A s^2 + (A w - sigma b w + K V) s + K V w = 0";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    orders(ledger)?;
    variants(ledger)?;
    critical(ledger)?;
    in_time(ledger)?;
    lengths::claims(ledger)
}

/// Modes compared with theory: in plane strain, those that the outer faces affect by less than 1e-6.
fn which(sides: Sides) -> &'static [usize] {
    if sides == Sides::Plane { &[3, 4, 5, 6] } else { &[0, 1, 2, 3, 4, 5, 6] }
}

fn orders(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (element, sides, words, order) in [
        ("quad4", Sides::Held, "antiplane, both faces held", 2.0),
        ("quad9", Sides::Held, "antiplane, both faces held", 4.0),
        ("quad9", Sides::Plane, "plane strain", 4.0),
    ] {
        let mut levels = Vec::new();
        let (result, cost) = Cost::measure(|| -> Result<(), CaseError> {
            for size in [125.0, 62.5, 31.25] {
                let (worst, ..) = errors(&Variant { size, element, sides, ..FIRST }, which(sides))?;
                levels.push((size, worst));
            }
            Ok(())
        });
        result?;
        ledger
            .order(format!("growth rates per wavelength, {words}, {element}"))
            .unit("V/L")
            .norm("largest error of both roots, modes up to the sixth")
            .levels(&levels)
            .expected(order)
            .within(0.3)
            .evidence(Evidence::Exact, THEORY)
            .because("the stiffness of a smooth mode is an energy: twice the order of its gradients, and so is the lumped interface mass")
            .finest(finest(order), "(k h)^p of the sixth mode, k h = 0.29, over a constant of the method, times K V/A of the fastest decay")
            .why_not_tighter("the constants are those of the element, about 1/12 for linear and 1/700 for quadratic ones, and not part of the theory")
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Bound on the error on the finest mesh: decay is fastest for the sixth mode, K L/(σ a) = 0.75.
fn finest(order: f64) -> f64 {
    let kh = PI * HIGHEST as f64 / WIDTH * 31.25;
    let constant = if order < 3.0 { 12.0 } else { 90.0 };
    0.75 * kh.powf(order) / constant
}

/// Both laws, damping and a free face, on a single mesh.
fn variants(ledger: &mut Ledger) -> Result<(), CaseError> {
    // ηV is of the size of σ (b - a)/2.5.
    let damping = 1e5 / RATE;
    let mut diagram = Plot::xy("Growth of modes", "mode n [-]", "growth rate Re s [V/L]");
    for (words, variant) in [
        ("ageing law", FIRST),
        ("slip law", Variant { evolution: "slip", ..FIRST }),
        ("ageing law, damped", Variant { damping, ..FIRST }),
        ("slip law, damped", Variant { evolution: "slip", damping, ..FIRST }),
        ("ageing law, one face free", Variant { sides: Sides::OneFree, ..FIRST }),
    ] {
        let (result, cost) = Cost::measure(|| errors(&variant, which(variant.sides)));
        let (worst, beside, rows) = result?;
        let curve = |column: usize| rows.iter().map(|row| (row[0], row[column])).collect::<Vec<_>>();
        diagram = diagram
            .series(Series::line(format!("{words}, theory"), &curve(4)))
            .series(Series::points(format!("{words}, this code"), &curve(3)));
        let written = |[n, found, exact, rate, theory, turn]: &[f64; 6]| {
            let [rate, theory, turn] = [rate, theory, turn].map(|s| format!("{s:.8}"));
            [n.to_string(), format!("{found:.6e}"), format!("{exact:.6e}"), rate, theory, turn]
        };
        ledger.table(
            format!("modes, antiplane, {words}, quad9 of 62.5 m"),
            &["n", "stiffness [Pa/m]", "theory", "Re s [V/L]", "theory", "Im s, theory"],
            rows.iter().map(written),
        );
        ledger
            .claim(format!("growth rates of modes 0 to 6, antiplane, {words}, quad9 of 62.5 m, largest error"))
            .unit("V/L")
            .value(worst)
            .at_most(1e-4)
            .evidence(Evidence::Exact, THEORY)
            .because("16 times that of the mesh of half the size, 1e-5 of the stiffness for the sixth mode, ten times over where roots are nearly double")
            .why_not_tighter("what the mesh leaves is judged by the order")
            .cost(&cost)
            .record();
        ledger
            .claim(format!("rates beside the mode that is perturbed, {words}"))
            .unit("V/L")
            .value(beside)
            .at_most(1e-7)
            .evidence(Evidence::Exact, "modes of a uniform fault do not mix")
            .because("squares of the perturbation, 1e-5, and rounding over it")
            .why_not_tighter("the rest is rounding of the condensation")
            .cost(&cost)
            .record();
    }
    ledger.plot(diagram);
    Ok(())
}

/// At the critical wavelength perturbations neither grow nor decay, and oscillate at sqrt(K V w/A).
fn critical(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (result, cost) = Cost::measure(|| -> Result<_, CaseError> {
        let plan = FIRST.plan()?;
        let found = modes::softest(&plan, HIGHEST + 1)?;
        let roots: Vec<_> = (0..=HIGHEST).map(|n| linearised(&plan, &found[n]).0).collect();
        let purity = (1..=HIGHEST).map(|n| found[n].cosine(&plan, n)).fold(f64::INFINITY, f64::min);
        Ok((roots, purity))
    });
    let (roots, purity) = result?;
    ledger
        .claim("growth rate and frequency at the wavelength pi G L/(sigma (b - a))")
        .unit("V/L")
        .values(&[roots[CRITICAL][0].re, roots[CRITICAL][0].im.abs()])
        .equals_each(&[0.0, ((B - A) / A).sqrt()])
        .absolute(5e-5)
        .evidence(Evidence::Exact, "K L = sigma (b - a): s^2 = -(b - a)/a (V/L)^2, between half-spaces")
        .because("layers of one wavelength are stiffer than half-spaces by 2 exp(-4 pi) = 7e-6, the mesh of 62.5 m by 1e-5")
        .why_not_tighter("it is the sum of three errors, which may have either sign")
        .cost(&cost)
        .record();
    let growing = roots.iter().filter(|r| r[0].re.max(r[1].re) > 1e-3).count();
    ledger
        .claim("modes that grow: those longer than the critical wavelength, the uniform one included")
        .count(growing as u64, CRITICAL as u64)
        .evidence(Evidence::Exact, "K(k) < sigma (b - a)/L")
        .because("modes 0 to 3 of 7")
        .cost(&cost)
        .record();
    ledger
        .claim("share of cos(k y) in the eigenvectors of the bodies' operator, least of modes 1 to 6")
        .value(purity)
        .at_least(0.999)
        .evidence(Evidence::Exact, "symmetric ends")
        .because("the square of what cells of a tenth of a wavelength leave; the share of any other cosine is nothing")
        .why_not_tighter("the claim ties eigenvalues to wavelengths; their error is claimed beside this")
        .cost(&cost)
        .record();
    Ok(())
}

/// Growth rates from integration of the scene over half of L/V, started with perturbations of all modes.
fn in_time(ledger: &mut Ledger) -> Result<(), CaseError> {
    for evolution in ["ageing", "slip"] {
        let variant = Variant { evolution, ..FIRST };
        let (result, cost) = Cost::measure(|| flow(&variant));
        let found = result?;
        let worst = |pick: fn(&Flow) -> f64| found.iter().map(pick).fold(0.0, f64::max);
        ledger
            .claim(format!(
                "growth rates of modes 0 to 6 from the integration in time, {evolution} law, largest error"
            ))
            .unit("V/L")
            .value(worst(|f| distance(&f.found, &f.theory)))
            .at_most(1e-4)
            .evidence(Evidence::Exact, THEORY)
            .because("that of the equations linearised on this mesh")
            .why_not_tighter("what the mesh leaves is judged by the order")
            .cost(&cost)
            .record();
        ledger
            .claim(format!("the same against the equations linearised on this mesh, {evolution} law"))
            .unit("V/L")
            .value(worst(|f| distance(&f.found, &f.equations)))
            .at_most(1e-6)
            .evidence(Evidence::Exact, "a flow over a time is the exponential of its linearisation")
            .because("squares of perturbations, seven modes of 1e-4, times third derivatives of order one; the integration leaves 1e-9 of 1e-4")
            .why_not_tighter("the bound is that of errors which add up")
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Initial perturbation of each mode in the integration.
const SEED: f64 = 1e-4;
/// Duration of the integration over L/V: well below half a period of every mode, so that the logarithm has one branch.
const FOLLOWED: f64 = 0.5;

/// Growth rates of a mode over V/L.
struct Flow {
    /// From the integration.
    found: [Complex<f64>; 2],
    /// From the linearised equations.
    equations: [Complex<f64>; 2],
    theory: [Complex<f64>; 2],
}

/// Growth rates of the modes from the integration.
fn flow(variant: &Variant) -> Result<Vec<Flow>, CaseError> {
    let mut plan = variant.plan()?;
    plan.problem.settings.end = FOLLOWED * length() / RATE;
    let modes = modes::softest(&plan, HIGHEST + 1)?;
    let layout = Layout::from_fault(&plan.problem.fault);
    let parts = [layout.m(), layout.states()];
    let end = |column: usize, sign: f64| -> Result<Vec<f64>, CaseError> {
        let mut start = plan.problem.start.clone();
        for mode in &modes {
            let seed = sign * SEED * scale(&plan, column);
            start[parts[column].clone()].iter_mut().zip(&mode.shape).for_each(|(y, c)| *y += seed * c);
        }
        let out =
            integrate(&plan.problem.fault, &plan.problem.loading, start, &plan.problem.settings, &mut ())?;
        match out.outcome {
            Outcome::Completed => Ok(out.unknowns),
            other => Err(format!("the integration ended early: {other:?}").into()),
        }
    };
    let mut matrices = vec![Matrix2::zeros(); modes.len()];
    for column in 0..2 {
        let (up, down) = (end(column, 1.0)?, end(column, -1.0)?);
        for (mode, matrix) in modes.iter().zip(&mut matrices) {
            for (row, part) in parts.iter().enumerate() {
                let unit = 2.0 * SEED * scale(&plan, row);
                let change: Vec<f64> = part.clone().map(|i| (up[i] - down[i]) / unit).collect();
                matrix[(row, column)] = mode.amplitude(&change);
            }
        }
    }
    let of = |(n, matrix): (usize, &Matrix2<f64>)| Flow {
        found: eigenvalues(matrix).map(|e| e.ln() / FOLLOWED),
        equations: linearised(&plan, &modes[n]).0,
        theory: variant.theory(n),
    };
    Ok(matrices.iter().enumerate().map(of).collect())
}
