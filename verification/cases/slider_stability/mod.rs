//! Growth rates of small perturbations of steady sliding against the eigenvalues of the linear theory.

use super::slider::{self, Kind, Set, V_REF};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_driver::slider::Plan;
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::History;
use asperity_friction::strength::{Parameters, cut_off::CutOff};
use nalgebra::{Complex, DMatrix};
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_stability",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::AgeingLaw, Capability::SlipLaw],
    quick: true,
    run,
};

/// Stiffness in units of the critical one.
const RATIOS: [f64; 7] = [0.5, 0.9, 1.0 - 1e-4, 1.0, 1.0 + 1e-4, 1.1, 2.0];

/// Perturbation of ln V and of the states: the square of it, over the size of the nonlinear terms, is what central
/// differences leave.
const KICK: f64 = 1e-4;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    quasi_static(ledger)?;
    damped(ledger)?;
    inertial(ledger)?;
    cut_off(ledger)
}

/// `m λ³ + ... = 0` in units of V/L: `(m λ² + a' λ - (b - κ))(λ + 1) + b = 0`, with m = M V²/(f_n L), a' = a + η V/f_n and
/// κ = k L/f_n; without inertia `a' λ² + (a' - b + κ) λ + κ = 0`.
fn theory(set: &Set, a: f64, b: f64) -> Vec<Complex<f64>> {
    let kappa = set.stiffness * set.length / set.normal;
    let a = a + set.damping * set.load / set.normal;
    let m = set.mass.map(|mass| mass * set.load * set.load / (set.normal * set.length));
    let c = |x: f64| Complex::new(x, 0.0);
    match m {
        None => {
            let (half, product) = (0.5 * (a - b + kappa) / a, kappa / a);
            let root = c(half * half - product).sqrt();
            vec![c(-half) + root, c(-half) - root]
        }
        Some(m) => {
            // Companion matrix of λ³ + (m + a') λ²/m + (a' - b + κ) λ/m + κ/m.
            let row = [-(m + a) / m, -(a - b + kappa) / m, -kappa / m];
            let companion =
                DMatrix::from_row_slice(3, 3, &[row[0], row[1], row[2], 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
            companion.complex_eigenvalues().iter().copied().collect()
        }
    }
}

/// Eigenvalues from the time integration, in units of V/L: those of the flow over `time`, found from perturbed starts of both
/// signs.
fn measured(plan: &Plan, set: &Set, time: f64) -> Result<Vec<Complex<f64>>, CaseError> {
    let n = plan.start.len();
    let scales = plan.system.scales();
    let ends = |column: usize, sign: f64| -> Result<Vec<f64>, CaseError> {
        let mut plan = Plan { end: time, ..plan.clone() };
        plan.start[column] += sign * KICK * scales[column];
        Ok(slider::finish(&plan)?.unknowns)
    };
    let mut flow = DMatrix::zeros(n, n);
    for column in 0..n {
        let (up, down) = (ends(column, 1.0)?, ends(column, -1.0)?);
        for row in 0..n {
            flow[(row, column)] = (up[row] - down[row]) / (2.0 * KICK * scales[column]);
        }
    }
    let unit = set.load / set.length;
    Ok(flow.complex_eigenvalues().iter().map(|e| e.ln() / (time * unit)).collect())
}

/// Largest distance of a measured eigenvalue from the nearest of the theory that the time resolves.
fn distance(found: &[Complex<f64>], expected: &[Complex<f64>]) -> f64 {
    let nearest = |e: &Complex<f64>| found.iter().map(|f| (f - e).norm()).fold(f64::INFINITY, f64::min);
    expected.iter().map(nearest).fold(0.0, f64::max)
}

/// One stiffness after the other.
fn sweep(
    ledger: &mut Ledger,
    name: &str,
    sets: impl Fn(f64) -> Set,
    kind: Kind,
    bound: (f64, &str),
) -> Result<(), CaseError> {
    let (result, cost) = Cost::of(|| -> Result<_, CaseError> {
        let mut largest: f64 = 0.0;
        let mut growth = Vec::new();
        for ratio in RATIOS {
            let set = sets(ratio);
            let plan = set.plan(kind, 1.0, 1.0)?;
            let expected = theory(&set, set.a, set.b);
            // A fraction of a period, so that the logarithm has one branch.
            let found = measured(&plan, &set, 0.5 * set.length / set.load)?;
            largest = largest.max(distance(&found, &expected));
            growth.push((
                ratio,
                expected[0].re,
                found.iter().map(|f| f.re).fold(f64::NEG_INFINITY, f64::max),
            ));
        }
        Ok((largest, growth))
    });
    let (largest, growth) = result?;
    ledger.table(
        format!("growth rates, {name} [V/L]"),
        &["k/k_c", "theory", "measured"],
        growth.iter().map(|(k, t, f)| [format!("{k}"), format!("{t:.12}"), format!("{f:.12}")]),
    );
    ledger
        .claim(format!("eigenvalues, {name}, largest error over k/k_c = 0.5 to 2"))
        .unit("V/L")
        .value(largest)
        .at_most(bound.0)
        .evidence(Evidence::Exact, "characteristic polynomial of the linearised equations")
        .because(bound.1)
        .why_not_tighter("the bound is that of the least favourable stiffness")
        .cost(&cost)
        .record();
    Ok(())
}

const DIFFERENCES: &str = "central differences at 1e-4 leave some 1e-8 times the third derivatives of the flow; e^x gives those a factor of (b/a)^2 to (b/a)^3, and the integration 1e-13 over 1e-4";

fn quasi_static(ledger: &mut Ledger) -> Result<(), CaseError> {
    let sets = |ratio| Set { damping: 0.0, ..slider::MILD }.at(ratio);
    sweep(ledger, "quasi-static, ageing law", sets, Kind::Ageing, (1e-7, DIFFERENCES))?;
    sweep(ledger, "quasi-static, slip law", sets, Kind::Slip, (1e-7, DIFFERENCES))
}

/// Damping of the size of the direct effect, a f_n/V.
fn damped(ledger: &mut Ledger) -> Result<(), CaseError> {
    let sets = |ratio| Set { damping: 2e10, ..slider::MILD }.at(ratio);
    sweep(ledger, "damped, ageing law", sets, Kind::Ageing, (1e-7, DIFFERENCES))?;
    sweep(ledger, "damped, slip law", sets, Kind::Slip, (1e-7, DIFFERENCES))
}

/// Mass for which the oscillator is as slow as the state: m of the size of a.
fn inertial(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mass = 0.02 * 5e6 * 1e-5 / 1e-12;
    let sets = |ratio| Set { damping: 0.0, mass: Some(mass), ..slider::MILD }.at(ratio);
    sweep(ledger, "inertial, ageing law", sets, Kind::Ageing, (1e-7, DIFFERENCES))?;
    sweep(ledger, "inertial, slip law", sets, Kind::Slip, (1e-7, DIFFERENCES))
}

/// With cut-off rates the effects are a V1/(V + V1) and b V2/(V + V2).
fn cut_off(ledger: &mut Ledger) -> Result<(), CaseError> {
    let base = Set { damping: 0.0, ..slider::MILD };
    let (v1, v2) = (3e-6, 2e-6);
    let (a, b) = (base.a * v1 / (base.load + v1), base.b * v2 / (base.load + v2));
    let (result, cost) = Cost::of(|| -> Result<f64, CaseError> {
        let mut largest: f64 = 0.0;
        for ratio in RATIOS {
            let stiffness = ratio * base.normal * (b - a).abs() / base.length;
            let set = Set { stiffness, ..base };
            let form = CutOff::new(Parameters::new(slider::MU0, set.a, V_REF)?, v1)?;
            let ageing = Ageing::new(set.b, set.length, V_REF)?.with_cut_off(v2)?;
            let law = Arc::new(RateLaw::new(form, ageing, set.load, None)?);
            let plan = slider::plan(set.slider(law), History::Constant(set.load), set.load, 1.0, 1.0)?;
            let found = measured(&plan, &set, 0.5 * set.length / set.load)?;
            largest = largest.max(distance(&found, &theory(&set, a, b)));
        }
        Ok(largest)
    });
    ledger
        .claim("eigenvalues, quasi-static, cut-off law, largest error over the stiffnesses")
        .unit("V/L")
        .value(result?)
        .at_most(1e-7)
        .evidence(Evidence::Exact, "characteristic polynomial with the effects a V1/(V + V1), b V2/(V + V2)")
        .because(DIFFERENCES)
        .why_not_tighter("the bound is that of the least favourable stiffness")
        .covers(&[Capability::Slider, Capability::LawFamily])
        .cost(&cost)
        .record();
    Ok(())
}
