//! Steady friction over 24 decades of slip rate, and the difference between the two forms of strength.

use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_friction::evolution::{Evolution, ageing::Ageing, nagata::Nagata, prz::Prz, slip::Slip};
use asperity_friction::law::{Drives, Law, RateDependent};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};

/// See the README.
pub const CASE: Case = Case {
    name: "friction_steady_state",
    readme: include_str!("README.md"),
    covers: &[Capability::LawFamily, Capability::AgeingLaw, Capability::SlipLaw],
    quick: true,
    run,
};

const MU0: f64 = 0.6;
const V_REF: f64 = 1e-6;
const LENGTH: f64 = 1e-5;
const NORMAL: f64 = 50e6;

/// Slip rates from 1e-20 to 1e4 m/s, ten a decade.
fn rates() -> Vec<f64> {
    (0..=240).map(|n| 10f64.powf(-20.0 + 0.1 * f64::from(n))).collect()
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, a, b) in [("weakening", 0.01, 0.015), ("strengthening", 0.02, 0.005)] {
        let parameters = || Parameters::new(MU0, a, V_REF);
        steady(ledger, &format!("bare, ageing law, {name}"), (a, b), |v| {
            tractions(Bare(parameters()?), Ageing::new(b, LENGTH, V_REF)?, v)
        })?;
        steady(ledger, &format!("bare, slip law, {name}"), (a, b), |v| {
            tractions(Bare(parameters()?), Slip::new(b, LENGTH, V_REF)?, v)
        })?;
        steady(ledger, &format!("bare, PRZ law, {name}"), (a, b), |v| {
            tractions(Bare(parameters()?), Prz::new(b, LENGTH, V_REF)?, v)
        })?;
        steady(ledger, &format!("bare, Nagata law, {name}"), (a, b), |v| {
            tractions(Bare(parameters()?), Nagata::new(b, LENGTH, V_REF, 2.0)?, v)
        })?;
    }
    parting(ledger)?;
    inverse(ledger)
}

/// Steady shear tractions at slip rates, from initial states and friction coefficient of the law.
fn tractions<F: Form + 'static, E: Evolution + 'static>(
    form: F,
    evolution: E,
    rates: &[f64],
) -> Result<Vec<f64>, CaseError> {
    rates
        .iter()
        .map(|&v| {
            let law = RateLaw::new(form.clone(), evolution.clone(), v, None)?;
            let mut states = vec![0.0; law.states()];
            law.initial(&mut states);
            let mut mu = [0.0];
            law.coefficient(&[NORMAL], &[v], &states, &mut mu)?;
            Ok(mu[0] * NORMAL)
        })
        .collect()
}

/// τ_ss = f_n (μ0 + (a - b) ln(V/Vref)).
fn formula((a, b): (f64, f64), v: f64) -> f64 {
    NORMAL * (MU0 + (a - b) * (v / V_REF).ln())
}

fn steady(
    ledger: &mut Ledger,
    name: &str,
    effects: (f64, f64),
    law: impl Fn(&[f64]) -> Result<Vec<f64>, CaseError>,
) -> Result<(), CaseError> {
    let rates = rates();
    let (found, cost) = Cost::measure(|| law(&rates));
    let expected: Vec<f64> = rates.iter().map(|&v| formula(effects, v)).collect();
    ledger
        .claim(format!("steady traction, {name}, 1e-20 to 1e4 m/s"))
        .unit("Pa")
        .values(&found?)
        .equals_each(&expected)
        .absolute(NORMAL * 1e-14)
        .evidence(Evidence::Exact, "tau_ss = f_n (mu0 + (a - b) ln(V/Vref))")
        .because("sums of logarithms up to 46 times a or b of 0.02, rounded a few times: 1e-14 of f_n")
        .why_not_tighter("the bound is that of the largest logarithm")
        .cost(&cost)
        .record();
    Ok(())
}

/// The regularised form exceeds the unregularised one by `a ln[(1 + sqrt(1 + 4 e^(-2m)))/2]` with m = μ_bare/a: a e^(-2m) for
/// large m.
fn parting(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (a, b) = (0.02, 0.005);
    let rates: Vec<f64> = (0..=260).map(|n| 10f64.powf(-30.0 + 0.1 * f64::from(n))).collect();
    let form = Regularised(Parameters::new(MU0, a, V_REF)?);
    let (found, cost) = Cost::measure(|| tractions(form, Slip::new(b, LENGTH, V_REF)?, &rates));
    let found = found?;
    let bare: Vec<f64> = rates.iter().map(|&v| formula((a, b), v)).collect();
    let expected: Vec<f64> = bare
        .iter()
        .map(|t| {
            let m = t / NORMAL / a;
            // asinh(e^m/2), evaluated without overflow for both signs of m.
            if m > 0.0 {
                t + NORMAL * a * (0.5 * (1.0 + (1.0 + 4.0 * (-2.0 * m).exp()).sqrt())).ln()
            } else {
                NORMAL * a * (0.5 * m.exp()).asinh()
            }
        })
        .collect();
    ledger
        .claim("steady traction, regularised, slip law, 1e-30 to 1e-4 m/s")
        .unit("Pa")
        .values(&found)
        .equals_each(&expected)
        .absolute(NORMAL * 1e-14)
        .evidence(Evidence::Exact, "f_n a asinh(e^(mu_bare/a)/2)")
        .because("as the bare form")
        .why_not_tighter("the bound is that of the largest logarithm")
        .cost(&cost)
        .record();
    // Slip rate at which the two differ by one percent of a: e^(-2m) = 0.01.
    let parted =
        rates.iter().zip(found.iter().zip(&bare)).rev().find(|(_, (r, b))| (*r - *b) > 0.01 * a * NORMAL);
    let m = 0.5 * 100f64.ln();
    let at = (V_REF.ln() + (m * a - MU0) / (a - b)) / std::f64::consts::LN_10;
    ledger
        .claim("log10 of the slip rate below which the forms part by a/100")
        .value(parted.map_or(f64::NAN, |p| p.0.log10()))
        .equals(at)
        .absolute(0.1)
        .evidence(Evidence::SemiAnalytic, "a e^(-2 mu/a) = a/100 on the steady line")
        .because("rates are sampled ten a decade")
        .why_not_tighter("the sampling")
        .record();
    let curve = |values: &[f64]| -> Vec<(f64, f64)> {
        rates.iter().zip(values).map(|(v, t)| (*v, t / NORMAL)).collect()
    };
    ledger.plot(
        Plot::xy("Steady friction, a = 0.02, b = 0.005", "V [m/s]", "friction [-]")
            .axes(Axis::Log, Axis::Linear)
            .series(Series::line("bare logarithm", &curve(&bare)))
            .series(Series::line("regularised", &curve(&found)))
            .caption("The bare logarithm passes through zero; the regularised strength does not."),
    );
    Ok(())
}

/// Claims that the slip rate is recovered from its steady traction, with radiation damping.
fn inverse(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (a, b) = (0.01, 0.015);
    let rates = rates();
    let damping = 5e6;
    let (worst, cost) = Cost::measure(|| -> Result<f64, CaseError> {
        let mut worst: f64 = 0.0;
        for &v in &rates {
            let form = Regularised(Parameters::new(MU0, a, V_REF)?);
            let law = RateLaw::new(form, Slip::new(b, LENGTH, V_REF)?, v, None)?;
            let mut states = [0.0];
            law.initial(&mut states);
            let traction = [formula((a, b), v) + damping * v];
            let drives = Drives { traction: &traction, normal: &[NORMAL], damping, near: None };
            let (mut rate, mut change) = ([0.0], [0.0]);
            law.slip_rates(drives, &states, &mut rate, &mut change)?;
            worst = worst.max((rate[0] / v).ln().abs());
        }
        Ok(worst)
    });
    ledger
        .claim("ln V from steady tractions with radiation damping, 1e-20 to 1e4 m/s, largest error")
        .value(worst?)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "tau_ss = f_n (mu0 + (a - b) ln(V/Vref)) + eta V")
        .because("rounding of tau over f_n a: 1e-16 times 60 to 80, a few times")
        .why_not_tighter("the largest traction decides")
        .covers(&[Capability::PointSolver])
        .cost(&cost)
        .record();
    Ok(())
}
