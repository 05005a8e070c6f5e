//! Laws that vary along a surface: each point has the answer of its own law, wherever it stands in the slices.

use asperity_friction::Failure;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::law::{
    Increments, Law, LimitKind, PresentStates, RateBounds, Rates, Regime, Responses, StepOutcome, Trials,
};
use asperity_friction::pointwise::PointwiseLaw;
use asperity_friction::rate::RateLaw;
use asperity_friction::slip_weakening::SlipWeakening;
use asperity_friction::strength::{Parameters, bare::Bare, regularised::Regularised};

const N: usize = 4;
/// Points in the slices, out of their order, and without the first.
const POINTS: [usize; 3] = [3, 1, 2];
const NORMAL: [f64; 3] = [9e6, 7e6, 8e6];
const TRIAL: [f64; 3] = [8e6, 2e6, 6e6];
const RATE: [f64; 3] = [1e-6, 0.0, 3e-6];
const REGIME: [Regime; 3] = [Regime::Slip, Regime::Stick, Regime::Stick];
const STIFFNESS: f64 = 3.5e12;
const DT: f64 = 0.5;
const BOUNDS: RateBounds = RateBounds { zeta: 0.1, log_rate: 1.0 };

fn rated(k: usize) -> RateLaw<Regularised, Ageing> {
    let at = |from: f64, by: f64| from + by * k as f64;
    let (a, v_ref) = (at(0.008, 0.002), 1e-6);
    let evolution = Ageing::new(at(0.014, -0.001), at(1e-5, 2e-6), v_ref).unwrap();
    RateLaw::new(
        Regularised(Parameters::new(at(0.5, 0.05), a, v_ref).unwrap()),
        evolution,
        at(1e-6, 1e-6),
        None,
    )
    .unwrap()
}

fn weakening(k: usize) -> SlipWeakening {
    let part = k as f64 * 0.1;
    SlipWeakening::new(0.5 + part, 0.3 + part, 1e-3 * (1.0 + part), None).unwrap()
}

fn coulomb(k: usize) -> Coulomb {
    Coulomb::new(0.3 + 0.1 * k as f64, Some(5e6)).unwrap()
}

/// Answers of a law at some entries of the slices: traction, slip, rate, ∂τ/∂|t|, ∂τ/∂f_n, states, regimes.
fn respond(law: &dyn Law, entries: &[usize], old: &[f64]) -> (Vec<Vec<f64>>, Vec<Regime>) {
    let pick = |all: &[f64]| entries.iter().map(|&k| all[k]).collect::<Vec<_>>();
    let points: Vec<usize> = entries.iter().map(|&k| POINTS[k]).collect();
    let n = entries.len();
    let mut out = vec![vec![f64::NAN; n]; 5];
    let (mut regime, mut states) = (vec![Regime::Stick; n], vec![f64::NAN; n * law.states()]);
    let (normal, trial, near) = (pick(&NORMAL), pick(&TRIAL), pick(&RATE));
    let trials = Trials {
        points: &points,
        normal: &normal,
        trial: &trial,
        stiffness: STIFFNESS,
        dt: DT,
        damping: 0.0,
        lag: None,
        near: Some(&near),
    };
    let [traction, slip, rate, d_trial, d_normal] = out.as_mut_slice() else { unreachable!() };
    let answers =
        Responses { traction, slip, rate, regime: &mut regime, d_trial, d_normal, states: &mut states };
    law.respond(trials, old, answers).unwrap();
    out.push(states);
    (out, regime)
}

/// Compares a law of all points with the laws of each, entry by entry.
fn compare<L: Law + Clone + 'static>(laws: &[L]) {
    let all = PointwiseLaw::new(laws.to_vec()).unwrap();
    let s = all.states();
    assert_eq!((s, all.has_elastic_domain()), (laws[0].states(), laws[0].has_elastic_domain()));
    let mut states = vec![f64::NAN; N * s];
    all.initial(&mut states);
    let own = |p: usize| states[p * s..(p + 1) * s].to_vec();
    let old: Vec<f64> = POINTS.iter().flat_map(|&p| own(p)).collect();
    let (together, regimes) = respond(&all, &[0, 1, 2], &old);
    let mut mu = [f64::NAN; N];
    all.coefficient(&[5e6; N], &[1e-6; N], &states, &mut mu).unwrap();
    for (p, law) in laws.iter().enumerate() {
        let (mut first, mut one) = (vec![f64::NAN; s], [f64::NAN]);
        law.initial(&mut first);
        assert_eq!(first, own(p));
        law.coefficient(&[5e6], &[1e-6], &first, &mut one).unwrap();
        assert_eq!(one[0], mu[p]);
    }
    for (k, &p) in POINTS.iter().enumerate() {
        let (alone, regime) = respond(&laws[p], &[k], &own(p));
        for (all, one) in together.iter().zip(&alone) {
            assert_eq!(all[k * one.len()..(k + 1) * one.len()], one[..]);
        }
        assert_eq!(regimes[k], regime[0]);
    }
    forward(&all, laws, &old);
    errors(&all, laws, &old, &together);
}

/// The rate form, its limits and the points that stand at their strength.
fn forward<L: Law>(all: &PointwiseLaw<L>, laws: &[L], old: &[f64]) {
    let s = all.states();
    let of = |k: std::ops::Range<usize>| PresentStates {
        points: &POINTS[k.clone()],
        normal: &NORMAL[k.clone()],
        traction: &TRIAL[k.clone()],
        rate: &RATE[k.clone()],
        regime: &REGIME[k.clone()],
        states: &old[k.start * s..k.end * s],
        stiffness: STIFFNESS,
        dt: DT,
        rate_floor: 1e-18,
    };
    let step = |k: std::ops::Range<usize>| Increments {
        normal: &[1e5, 2e5, -1e5][k.clone()],
        traction: &[1e5, 6e6, 7e6][k.clone()],
        slip: &[2e-6, 0.0, 0.0][k],
    };
    let rates = |law: &dyn Law, k: std::ops::Range<usize>| {
        let (mut along, mut coupling, mut constant) = ([f64::NAN; 3], [f64::NAN; 3], [f64::NAN; 3]);
        let n = k.len();
        let out =
            Rates { along: &mut along[..n], coupling: &mut coupling[..n], constant: &mut constant[..n] };
        law.rates(of(k), out).unwrap();
        [along, coupling, constant]
    };
    let together = rates(all, 0..3);
    let mut smallest: Option<(f64, LimitKind, usize)> = None;
    for (k, &p) in POINTS.iter().enumerate() {
        let alone = rates(&laws[p], k..k + 1);
        assert_eq!(together.map(|v| v[k]), alone.map(|v| v[0]));
        assert_eq!(all.stands(of(0..3), k), laws[p].stands(of(k..k + 1), 0));
        if let Some(found) = laws[p].limit(of(k..k + 1), step(k..k + 1), BOUNDS)
            && smallest.is_none_or(|s| found.fraction < s.0)
        {
            smallest = Some((found.fraction, found.kind, k));
        }
    }
    let found = all.limit(of(0..3), step(0..3), BOUNDS).map(|l| (l.fraction, l.kind, l.point));
    assert!(found.is_some());
    assert_eq!(found, smallest);
}

/// Estimates of errors.
fn errors<L: Law>(all: &PointwiseLaw<L>, laws: &[L], old: &[f64], answers: &[Vec<f64>]) {
    let s = all.states();
    let of = |k: std::ops::Range<usize>| StepOutcome {
        points: &POINTS[k.clone()],
        normal: &NORMAL[k.clone()],
        before: &RATE[k.clone()],
        rate: &answers[2][k.clone()],
        slip: &answers[1][k.clone()],
        dt: DT,
        old: &old[k.start * s..k.end * s],
        new: &answers[5][k.start * s..k.end * s],
    };
    let mut together = [f64::NAN; 3];
    all.error(of(0..3), &mut together);
    for (k, &p) in POINTS.iter().enumerate() {
        let mut alone = [f64::NAN];
        laws[p].error(of(k..k + 1), &mut alone);
        assert_eq!(together[k], alone[0]);
    }
}

#[test]
fn each_point_has_the_answer_of_its_own_law() {
    compare(&(0..N).map(coulomb).collect::<Vec<_>>());
    compare(&(0..N).map(weakening).collect::<Vec<_>>());
    compare(&(0..N).map(rated).collect::<Vec<_>>());
}

#[test]
fn a_failure_names_the_entry_of_the_slices() {
    let bare = |k: usize| {
        let form = Bare(Parameters::new(0.6, 0.01 + 0.001 * k as f64, 1e-6).unwrap());
        RateLaw::new(form, Ageing::new(0.01, 1e-5, 1e-6).unwrap(), 1e-6, None).unwrap()
    };
    let law = PointwiseLaw::new((0..N).map(bare).collect()).unwrap();
    let mut states = [f64::NAN; N];
    law.initial(&mut states);
    let mut mu = [f64::NAN; N];
    let failed = law.coefficient(&[5e6; N], &[1e-6, 1e-6, 0.0, 1e-6], &states, &mut mu);
    assert_eq!(failed, Err(Failure::BareLogAtRest { point: 2, rate: 0.0 }));
}

#[test]
fn laws_need_points_and_one_number_of_states() {
    assert!(PointwiseLaw::<Coulomb>::new(Vec::new()).is_err());
}
