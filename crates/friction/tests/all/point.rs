//! The point solver over the whole admissible range, with state, behind stiff and soft springs, and in reversal.

use asperity_friction::Failure;
use asperity_friction::component::Component;
use asperity_friction::evolution::{Evolution, ageing::Ageing, slip::Slip, stateless::Stateless};
use asperity_friction::law::{Lag, Law, Regime, Responses, Trials};
use asperity_friction::point::{Point, Solution, Solver};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};
use proptest::prelude::*;

const V_REF: f64 = 1e-6;

fn form(a: f64) -> Regularised {
    Regularised(Parameters::new(0.6, a, V_REF).unwrap())
}

/// Solves one point with one state variable (or none).
fn solve<F: Form, E: Evolution>(form: &F, e: &E, p: &Point, state: f64) -> Result<Solution, Failure> {
    let parts = if E::STATES == 0 { vec![] } else { vec![Component::new(e.clone(), 0.0).unwrap()] };
    Solver::new(form, &parts, 1.0).solve(p, &vec![state; parts.len()])
}

/// Residual of the balance and of the state equation, relative to their terms.
fn left_over<F: Form, E: Evolution>(form: &F, evolution: &E, p: &Point, state: f64, s: &Solution) -> f64 {
    let (strength, spring) = p.shares(s);
    let state = evolution.step(state, s.log_rate, p.dt).state;
    let mu = form.at(s.log_rate, evolution.phi(state)).mu;
    let balance = (strength + spring - p.drive).abs() / p.drive;
    // The rate is known to rounding of the drive, through a if the strength hardly changes.
    let law = (strength - p.normal * mu).abs() / p.drive;
    let clock = (spring - p.spring * s.log_rate.exp()).abs() / p.drive;
    balance.max(law).max(clock)
}

/// Solution from the state that is steady at a rate, and its residual.
fn solve_from<F: Form, E: Evolution>(
    form: &F,
    evolution: &E,
    p: &Point,
    log_rate: f64,
) -> (Result<Solution, Failure>, f64) {
    let state = evolution.steady(log_rate);
    let answer = solve(form, evolution, p, state);
    let rest = answer.as_ref().map_or(0.0, |s| left_over(form, evolution, p, state, s));
    (answer, rest)
}

fn ten(x: f64) -> f64 {
    10f64.powf(x)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// With a state: balanced to rounding, or refused because the law weakens faster than the spring; never NaN.
    #[test]
    fn points_with_state_balance_over_the_whole_range(
        log_a in -4.0f64..-1.0,
        log_b in -4.0f64..-1.0,
        log_length in -7.0f64..-1.0,
        log_normal in 0.0f64..9.0,
        share in 1e-6f64..3.0,
        log_stiffness in 6.0f64..15.0,
        log_dt in -9.0f64..9.0,
        log_initial in -30.0f64..4.0,
        ageing in any::<bool>(),
    ) {
        let form = form(ten(log_a));
        let (normal, dt) = (ten(log_normal), ten(log_dt));
        let (b, length) = (ten(log_b), ten(log_length));
        let initial = ten(log_initial).ln();
        let p = Point { normal, drive: share * normal, spring: ten(log_stiffness) * dt, dt, guess: None };
        let (answer, rest) = if ageing {
            solve_from(&form, &Ageing::new(b, length, V_REF).unwrap(), &p, initial)
        } else {
            solve_from(&form, &Slip::new(b, length, V_REF).unwrap(), &p, initial)
        };
        match answer {
            Ok(s) => {
                prop_assert!(s.log_rate.is_finite() && s.mu >= 0.0, "{s:?}");
                prop_assert!(s.iterations <= 12, "{s:?}: {p:?}");
                // E_t + H > 0.
                prop_assert!(p.spring * s.log_rate.exp() + p.normal * s.slope > 0.0, "{s:?}");
                // ln V is rounded, and so are the spring traction and the strength that follow from it.
                let condition = 1.0 + p.normal * s.slope.abs() / p.drive;
                let rounding = 4.0 * f64::EPSILON * (10.0 + s.log_rate.abs()) * condition;
                prop_assert!(rest <= rounding, "{rest:e}: {p:?} {s:?}");
            }
            Err(Failure::Unstable { stiffness, weakening, .. }) => prop_assert!(weakening >= stiffness),
            Err(other) => prop_assert!(false, "{other}"),
        }
    }

    /// Larger trials give more slip and, where the rate strengthens, more traction; more normal traction gives less slip.
    #[test]
    fn the_return_is_monotone(
        log_a in -4.0f64..-1.0,
        share in 1e-3f64..2.0,
        log_stiffness in 8.0f64..14.0,
        log_dt in -6.0f64..6.0,
        growth in 1e-6f64..0.5,
    ) {
        let (form, dt) = (form(10f64.powf(log_a)), 10f64.powf(log_dt));
        let p = Point { normal: 9e6, drive: 9e6 * share, spring: 10f64.powf(log_stiffness) * dt, dt, guess: None };
        let base = solve(&form, &Stateless, &p, 0.0).unwrap();
        let pulled = solve(&form, &Stateless, &Point { drive: p.drive * (1.0 + growth), ..p }, 0.0).unwrap();
        let pressed = solve(&form, &Stateless, &Point { normal: p.normal * (1.0 + growth), ..p }, 0.0).unwrap();
        prop_assert!(pulled.log_rate > base.log_rate && pulled.mu >= base.mu);
        prop_assert!(pressed.log_rate < base.log_rate);
    }
}

/// rate, traction, slip, `d_trial`, `d_normal`.
fn respond(
    law: &dyn Law,
    normal: f64,
    trial: f64,
    dt: f64,
    lag: Option<(f64, f64)>,
) -> Result<[f64; 5], Failure> {
    let mut old = vec![0.0; law.states()];
    law.initial(&mut old);
    let mut new = old.clone();
    let (weight, offset) = ([lag.map_or(1.0, |l| l.0)], [lag.map_or(0.0, |l| l.1)]);
    let (mut t, mut s, mut v, mut g, mut by_t, mut by_n) =
        ([0.0], [0.0], [0.0], [Regime::Stick], [0.0], [0.0]);
    law.respond(
        Trials {
            points: &[0],
            normal: &[normal],
            trial: &[trial],
            stiffness: 1e12,
            dt,
            damping: 0.0,
            lag: lag.map(|_| Lag { weight: &weight, offset: &offset }),
            near: None,
        },
        &old,
        Responses {
            traction: &mut t,
            slip: &mut s,
            rate: &mut v,
            regime: &mut g,
            d_trial: &mut by_t,
            d_normal: &mut by_n,
            states: &mut new,
        },
    )?;
    Ok([v[0], t[0], s[0], by_t[0], by_n[0]])
}

fn ageing_law(l: f64) -> RateLaw<Regularised, Ageing> {
    RateLaw::new(form(0.01), Ageing::new(0.02, l, V_REF).unwrap(), 1e-6, None).unwrap()
}

#[test]
fn behind_a_soft_spring_the_answer_is_reached_from_rest_or_refused() {
    // f b/L = 9e6 0.02/1e-8 = 1.8e13 Pa/m, far above E_t = 1e12 Pa/m.
    let law = ageing_law(1e-8);
    let mut last = 0.0;
    let mut refused = false;
    for n in 1..200 {
        let trial = 4e6 + 2e4 * f64::from(n);
        match respond(&law, 9e6, trial, 1e-3, None) {
            Ok([rate, traction, _, d_trial, _]) => {
                assert!(!refused, "a larger trial cannot return to the branch from rest");
                assert!(rate > last && traction > 0.0 && d_trial < 1.0);
                last = rate;
            }
            Err(Failure::Unstable { stiffness, weakening, .. }) => {
                assert!(weakening > stiffness);
                refused = true;
            }
            Err(other) => panic!("{other}"),
        }
    }
    assert!(refused, "a soft spring must lose its balance");
    // The same trials behind an effectively stiffer spring (longer L) all have an answer.
    let stiff = ageing_law(1e-5);
    for n in 1..200 {
        respond(&stiff, 9e6, 4e6 + 2e4 * f64::from(n), 1e-3, None).unwrap();
    }
}

#[test]
fn reversal_is_odd() {
    let law = RateLaw::velocity(Parameters::new(0.6, 0.01, V_REF).unwrap(), None).unwrap();
    let (dt, weight, offset) = (0.1, 1.5, 1e-4);
    // V = w Δλ/Δt - offset; the spring traction is then T = t^e - E_t Δt/w offset, here of both signs and the same magnitude.
    let shift = 1e12 * dt / weight * offset;
    let forward = respond(&law, 9e6, shift + 4e6, dt, Some((weight, offset))).unwrap();
    let backward = respond(&law, 9e6, shift - 4e6, dt, Some((weight, offset))).unwrap();
    approx::assert_relative_eq!(forward[0], -backward[0], max_relative = 1e-9);
    approx::assert_relative_eq!(forward[1], -backward[1], max_relative = 1e-12);
    approx::assert_relative_eq!(forward[3], backward[3], max_relative = 1e-9);
    approx::assert_relative_eq!(forward[4], -backward[4], max_relative = 1e-9);
    for answer in [forward, backward] {
        approx::assert_relative_eq!(answer[0], weight * answer[2] / dt - offset, epsilon = 1e-19);
    }
    // The bare logarithm refuses reversed slip.
    let bare = RateLaw::new(Bare(Parameters::new(0.6, 0.01, V_REF).unwrap()), Stateless, 1e-6, None).unwrap();
    let failure = respond(&bare, 9e6, shift - 4e6, dt, Some((weight, offset))).unwrap_err();
    assert!(matches!(failure, Failure::BareLogAtRest { point: 0, rate } if rate < 0.0), "{failure}");
}

#[test]
fn the_bare_logarithm_refuses_negative_strength() {
    // a = 0.1 makes μ0 + a ln(V/Vref) negative below 2.5e-9 m/s; a trial of 1 Pa behind the spring gives 1e-11 m/s.
    let law = RateLaw::new(Bare(Parameters::new(0.6, 0.1, V_REF).unwrap()), Stateless, 1e-6, None).unwrap();
    assert!(matches!(respond(&law, 9e6, 1.0, 0.1, None), Err(Failure::BareLogAtRest { .. })));
    assert!(respond(&law, 9e6, 5e6, 0.1, None).unwrap()[1] > 0.0);
}

#[test]
fn the_slope_at_rest_is_the_limit_of_the_slope_near_rest() {
    let law = RateLaw::velocity(Parameters::new(0.4, 0.05, 0.1).unwrap(), None).unwrap();
    for dt in [1e-6, 1e-3, 10.0] {
        let rest = respond(&law, 9e6, 0.0, dt, None).unwrap();
        let near = respond(&law, 9e6, 1e-3, dt, None).unwrap();
        assert_eq!((rest[0], rest[1], rest[2]), (0.0, 0.0, 0.0));
        approx::assert_relative_eq!(rest[3], near[3], max_relative = 1e-12);
    }
}

/// Order at which f(h) - f(0) - h f' vanishes, unless it is already at rounding.
fn order(f: impl Fn(f64) -> f64, derivative: f64, h: f64, scale: f64) -> Option<f64> {
    let remainder = |h: f64| (f(h) - f(0.0) - h * derivative).abs();
    let fine = remainder(0.5 * h);
    (fine > 1e-12 * scale).then(|| (remainder(h) / fine).log2())
}

#[test]
fn derivatives_hold_from_creep_to_free_slip() {
    let ageing = RateLaw::new(form(0.01), Ageing::new(0.015, 1e-5, V_REF).unwrap(), 1e-7, None).unwrap();
    let slip = RateLaw::new(form(0.01), Slip::new(0.015, 1e-5, V_REF).unwrap(), 1e-7, None).unwrap();
    let capped = RateLaw::velocity(Parameters::new(0.6, 0.02, V_REF).unwrap(), Some(5e6)).unwrap();
    let laws: [&dyn Law; 3] = [&ageing, &slip, &capped];
    let mut tested = 0;
    for law in laws {
        for dt in [1e-4, 1e-1, 1e2] {
            for (normal, trial) in [(9e6, 1e6), (9e6, 5.5e6), (9e6, 8e6), (1e5, 9e6), (9e6, 4e7)] {
                for lag in [None, Some((1.5, 1e-8))] {
                    let base = respond(law, normal, trial, dt, lag).unwrap();
                    let by_trial = |h: f64| respond(law, normal, trial + h, dt, lag).unwrap()[1];
                    let by_normal = |h: f64| respond(law, normal + h, trial, dt, lag).unwrap()[1];
                    for found in [
                        order(by_trial, base[3], 2e-3 * trial, trial),
                        order(by_normal, base[4], 2e-3 * normal, trial),
                    ]
                    .into_iter()
                    .flatten()
                    {
                        tested += 1;
                        assert!(found > 1.8, "{} {normal} {trial} {dt} {lag:?}: order {found}", law.name());
                    }
                }
            }
        }
    }
    assert!(tested > 60, "{tested}");
}
