//! Growth rates of small perturbations of steady sliding against the eigenvalues of the linear theory.

use super::slider::{self, Kind, Set, V_REF};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_cycles::slider::{Problem, critical_stiffness};
use asperity_friction::component::Component;
use asperity_friction::evolution::{Evolution, ageing::Ageing, nagata::Nagata, slip::Slip};
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, SliderLaw};
use asperity_friction::strength::{Parameters, cut_off::CutOff, regularised::Regularised};
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

/// Perturbation of ln V and of the states. The error of central differences is its square over the size of the
/// nonlinear terms.
const KICK: f64 = 1e-4;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    quasi_static(ledger)?;
    damped(ledger)?;
    inertial(ledger)?;
    cut_off(ledger)?;
    critical(ledger)
}

/// Roots of the characteristic equation in units of V/L: `(m λ² + a' λ - (b - κ))(λ + 1) + b = 0`, with
/// m = M V²/(f_n L), a' = a + η V/f_n and κ = k L/f_n; without inertia `a' λ² + (a' - b + κ) λ + κ = 0`.
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

/// Eigenvalues from time integration, in units of V/L: those of the flow over `time`, by central differences of
/// perturbed starts.
fn measured(plan: &Problem, set: &Set, time: f64) -> Result<Vec<Complex<f64>>, CaseError> {
    let n = plan.start.len();
    let scales = plan.system.scales();
    let ends = |column: usize, sign: f64| -> Result<Vec<f64>, CaseError> {
        let mut plan = Problem { end: time, ..plan.clone() };
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

/// Compares eigenvalues at each of the stiffnesses.
fn sweep(
    ledger: &mut Ledger,
    name: &str,
    sets: impl Fn(f64) -> Set,
    kind: Kind,
    bound: (f64, &str),
) -> Result<(), CaseError> {
    let (result, cost) = Cost::measure(|| -> Result<_, CaseError> {
        let mut largest: f64 = 0.0;
        let mut growth = Vec::new();
        for ratio in RATIOS {
            let set = sets(ratio);
            let plan = set.plan(kind, 1.0, 1.0)?;
            let expected = theory(&set, set.a, set.b);
            // The time is a fraction of a period, so that the logarithm has one branch.
            let found = measured(&plan, &set, 0.5 * set.length / set.load)?;
            largest = largest.max(distance(&found, &expected));
            let fastest =
                |roots: &[Complex<f64>]| roots.iter().map(|s| s.re).fold(f64::NEG_INFINITY, f64::max);
            growth.push((ratio, fastest(&expected), fastest(&found)));
        }
        Ok((largest, growth))
    });
    let (largest, growth) = result?;
    let theory: Vec<(f64, f64)> = growth.iter().map(|(k, t, _)| (*k, *t)).collect();
    let measured: Vec<(f64, f64)> = growth.iter().map(|(k, _, f)| (*k, *f)).collect();
    ledger.plot(
        Plot::xy(format!("Growth rates, {name}"), "k/k_c [-]", "growth rate [V/L]")
            .series(Series::line("theory", &theory))
            .series(Series::points("measured", &measured)),
    );
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

/// Eigenvalues with damping of the size of the direct effect, a f_n/V.
fn damped(ledger: &mut Ledger) -> Result<(), CaseError> {
    let sets = |ratio| Set { damping: 2e10, ..slider::MILD }.at(ratio);
    sweep(ledger, "damped, ageing law", sets, Kind::Ageing, (1e-7, DIFFERENCES))?;
    sweep(ledger, "damped, slip law", sets, Kind::Slip, (1e-7, DIFFERENCES))
}

/// Eigenvalues with a mass for which the oscillator is as slow as the state: m of the size of a.
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
    let (result, cost) = Cost::measure(|| -> Result<f64, CaseError> {
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

/// A law with these states and the a of the set.
fn law<E: Evolution + 'static>(set: &Set, states: Vec<E>) -> Result<Arc<dyn SliderLaw>, CaseError> {
    let form = Regularised(Parameters::new(slider::MU0, set.a, V_REF)?);
    let parts = states.into_iter().map(|e| Component::new(e, 0.0)).collect::<Result<Vec<_>, _>>()?;
    Ok(Arc::new(RateLaw::with_parts(form, parts, set.load, set.normal, None)?))
}

/// A law with its name.
type NamedLaw = (&'static str, Arc<dyn SliderLaw>);

/// Laws with several states, given by their b and L \[-, m\], and Nagata's law, which remembers shear traction.
fn laws(set: &Set) -> Result<Vec<NamedLaw>, CaseError> {
    let slips = |list: &[(f64, f64)]| {
        list.iter().map(|&(b, l)| Slip::new(b, l, V_REF)).collect::<Result<Vec<_>, _>>()
    };
    let ages = |list: &[(f64, f64)]| {
        list.iter().map(|&(b, l)| Ageing::new(b, l, V_REF)).collect::<Result<Vec<_>, _>>()
    };
    Ok(vec![
        ("slip law, two states", law(set, slips(&[(0.012, 1e-5), (0.003, 1e-4)])?)?),
        ("ageing law, two states", law(set, ages(&[(0.012, 1e-5), (0.008, 2e-5)])?)?),
        (
            "slip law, two states of which one strengthens",
            law(set, slips(&[(0.016, 1e-5), (-0.003, 5e-5)])?)?,
        ),
        ("slip law, three states", law(set, slips(&[(0.006, 1e-5), (0.005, 3e-5), (0.004, 2e-4)])?)?),
        ("Nagata law, c = 0.5", law(set, vec![Nagata::new(0.015, 1e-5, V_REF, 0.5)?])?),
        ("Nagata law, c = 2", law(set, vec![Nagata::new(0.015, 1e-5, V_REF, 2.0)?])?),
    ])
}

/// Growth of perturbations on both sides of the critical stiffness that plans print, by time integration.
fn critical(ledger: &mut Ledger) -> Result<(), CaseError> {
    let base = Set { damping: 0.0, ..slider::MILD };
    let mass = 0.005 * base.normal * base.length / (base.load * base.load);
    let sets = [base, Set { damping: 1e10, ..base }, Set { damping: 1e10, mass: Some(mass), ..base }];
    let (mut wrong, mut marginal, mut rows) = (0, 0.0_f64, Vec::new());
    let (done, cost) = Cost::measure(|| -> Result<(), CaseError> {
        for set in sets {
            for (name, law) in laws(&set)? {
                let k = critical_stiffness(&set.slider(law.clone()), set.load, set.normal);
                let growth = |share: f64| -> Result<f64, CaseError> {
                    let slider = Set { stiffness: share * k, ..set }.slider(law.clone());
                    let plan = slider::plan(slider, History::Constant(set.load), set.load, 1.0, 1.0)?;
                    let found = measured(&plan, &set, 0.5 * set.length / set.load)?;
                    Ok(found.iter().map(|e| e.re).fold(f64::NEG_INFINITY, f64::max))
                };
                let [below, at, above] = [growth(0.99)?, growth(1.0)?, growth(1.01)?];
                wrong += u64::from(below <= 0.0) + u64::from(above >= 0.0);
                marginal = marginal.max(at.abs());
                let more = if set.mass.is_some() {
                    ", damped, with mass"
                } else if set.damping > 0.0 {
                    ", damped"
                } else {
                    ""
                };
                rows.push([
                    format!("{name}{more}"),
                    format!("{k:.6e}"),
                    format!("{below:.3e}"),
                    format!("{at:.1e}"),
                    format!("{above:.3e}"),
                ]);
            }
        }
        Ok(())
    });
    done?;
    ledger.table(
        "largest growth rate [V/L] beside the critical stiffness",
        &["law", "k_c [Pa/m]", "at 0.99 k_c", "at k_c", "at 1.01 k_c"],
        rows,
    );
    ledger
        .claim("several states, memory of shear traction, damping and mass: sides of k_c (1 per cent off) on which perturbations do not grow below it or do not decay above it, of 36")
        .count(wrong, 0)
        .evidence(Evidence::SemiAnalytic, "integrations of perturbed starts on either side")
        .because("k_c parts growth from decay")
        .covers(&[Capability::Slider, Capability::SeveralStates, Capability::LawFamily])
        .cost(&cost)
        .record();
    ledger
        .claim("several states, memory of shear traction, damping and mass: largest growth or decay of the slowest perturbation at k = k_c")
        .unit("V/L")
        .value(marginal)
        .at_most(1e-6)
        .evidence(Evidence::SemiAnalytic, "integrations of perturbed starts at k_c")
        .because(DIFFERENCES)
        .why_not_tighter("larger b/a than in the sweeps above, with states of different lengths, give the third derivatives of the flow a larger factor")
        .covers(&[Capability::Slider, Capability::SeveralStates, Capability::LawFamily])
        .cost(&cost)
        .record();
    Ok(())
}
