//! Laws with an elastic domain and a memory: static and kinetic friction, and linear slip weakening.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use asperity_friction::Failure;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::law::{
    Increments, Lag, Law, Limit, LimitKind, PresentStates, RateBounds, Rates, Regime, Responses, Trials,
};
use asperity_friction::slip_weakening::SlipWeakening;
use asperity_friction::static_kinetic::StaticKinetic;
use proptest::prelude::*;
use std::slice::from_ref;

const MU_S: f64 = 0.7;
const MU_K: f64 = 0.4;
const D_C: f64 = 2e-3;
const NORMAL: f64 = 1e7;
/// W = f_n (μ_s - μ_k)/d_c \[Pa/m\].
const WEAKENING: f64 = NORMAL * (MU_S - MU_K) / D_C;
const STIFFNESS: f64 = 4.0 * WEAKENING;
const DT: f64 = 0.1;
const BOUNDS: RateBounds = RateBounds { zeta: 0.1, log_rate: 1.0 };

fn weakening() -> SlipWeakening {
    SlipWeakening::new(MU_S, MU_K, D_C, None).unwrap()
}

fn capped(limit: f64) -> SlipWeakening {
    SlipWeakening::new(MU_S, MU_K, D_C, Some(limit)).unwrap()
}

fn dropping() -> StaticKinetic {
    StaticKinetic::new(MU_S, MU_K, None).unwrap()
}

/// Answer for one point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PointAnswer {
    traction: f64,
    slip: f64,
    rate: f64,
    regime: Regime,
    d_trial: f64,
    d_normal: f64,
    state: f64,
}

fn respond_with(
    law: &dyn Law,
    [normal, trial, stiffness]: [f64; 3],
    old: f64,
    lag: Option<(f64, f64)>,
) -> Result<PointAnswer, Failure> {
    let (mut t, mut s, mut v, mut g) = ([f64::NAN], [f64::NAN], [f64::NAN], [Regime::Stick]);
    let (mut by_trial, mut by_normal, mut new) = ([f64::NAN], [f64::NAN], [f64::NAN]);
    let (weight, offset) = ([lag.map_or(1.0, |l| l.0)], [lag.map_or(0.0, |l| l.1)]);
    law.respond(
        Trials {
            points: &[0],
            normal: &[normal],
            trial: &[trial],
            stiffness,
            dt: DT,
            damping: 0.0,
            lag: lag.map(|_| Lag { weight: &weight, offset: &offset }),
            near: None,
        },
        &[old],
        Responses {
            traction: &mut t,
            slip: &mut s,
            rate: &mut v,
            regime: &mut g,
            d_trial: &mut by_trial,
            d_normal: &mut by_normal,
            states: &mut new,
        },
    )?;
    Ok(PointAnswer {
        traction: t[0],
        slip: s[0],
        rate: v[0],
        regime: g[0],
        d_trial: by_trial[0],
        d_normal: by_normal[0],
        state: new[0],
    })
}

fn respond(law: &dyn Law, normal: f64, trial: f64, old: f64) -> PointAnswer {
    respond_with(law, [normal, trial, STIFFNESS], old, None).unwrap()
}

/// Pulls the far end of the penalty spring to `reach` \[m\] in `steps` steps; returns tractions, slips and states after each.
fn pull(law: &dyn Law, normal: f64, reach: f64, steps: u32) -> Vec<PointAnswer> {
    let mut state = [f64::NAN];
    law.initial(&mut state);
    let (mut traction, mut path) = (0.0, Vec::new());
    for _ in 0..steps {
        let one = respond(law, normal, traction + STIFFNESS * (reach / f64::from(steps)), state[0]);
        (traction, state) = (one.traction, [one.state]);
        path.push(one);
    }
    path
}

#[test]
fn a_slip_weakening_point_behind_a_spring_follows_its_closed_form() {
    let (peak, residual) = (MU_S * NORMAL, MU_K * NORMAL);
    // Displacements at the peak and where the residual strength is reached.
    let (first, second) = (peak / STIFFNESS, residual / STIFFNESS + D_C);
    // No step ends at a kink, where the slope has two values.
    let (reach, steps) = (1.5 * second, 1207);
    let path = pull(&weakening(), NORMAL, reach, steps);
    for (n, one) in (1..).zip(&path) {
        let u = reach * f64::from(n) / f64::from(steps);
        let (traction, slope) = if u <= first {
            (STIFFNESS * u, 1.0)
        } else if u <= second {
            // The softening slope: springs E_t and -W in series.
            (peak - STIFFNESS * WEAKENING / (STIFFNESS - WEAKENING) * (u - first), -1.0 / 3.0)
        } else {
            (residual, 0.0)
        };
        assert_relative_eq!(one.traction, traction, max_relative = 1e-11);
        assert_abs_diff_eq!(one.state, (u - traction / STIFFNESS).max(0.0), epsilon = 1e-11 * D_C);
        assert_abs_diff_eq!(one.d_trial, slope, epsilon = 1e-14);
    }
    assert_eq!(path.last().unwrap().traction, residual);
    assert!(path.iter().any(|one| one.traction > 0.995 * peak));
}

#[test]
fn the_work_above_the_residual_strength_is_the_fracture_energy() {
    let law = weakening();
    let mut last = (MU_S * NORMAL, 0.0);
    let mut energy = 0.0;
    for one in pull(&law, NORMAL, 3.0 * D_C, 5000).iter().filter(|one| one.regime == Regime::Slip) {
        // Traction is linear in slip between two steps, except for the step with the kink.
        energy += (0.5 * (one.traction + last.0) - MU_K * NORMAL) * (one.state - last.1);
        last = (one.traction, one.state);
    }
    assert_relative_eq!(energy, 0.5 * (MU_S - MU_K) * NORMAL * D_C, max_relative = 1e-6);
}

#[test]
fn the_number_of_steps_does_not_matter_while_weakening_or_after() {
    for reach in [1.2, 1.6, 4.0] {
        let reach = reach * MU_S * NORMAL / STIFFNESS;
        let once = *pull(&weakening(), NORMAL, reach, 1).last().unwrap();
        assert_eq!(once.regime, Regime::Slip);
        for steps in [2, 7, 100, 999] {
            let many = *pull(&weakening(), NORMAL, reach, steps).last().unwrap();
            assert_relative_eq!(many.traction, once.traction, max_relative = 1e-12);
            assert_relative_eq!(many.state, once.state, max_relative = 1e-11);
        }
    }
}

#[test]
fn accumulated_slip_does_not_heal() {
    let law = weakening();
    let slid = respond(&law, NORMAL, 8e6, 0.0);
    assert_eq!(slid.regime, Regime::Slip);
    let rest = respond(&law, NORMAL, 0.0, slid.state);
    assert_eq!((rest.regime, rest.state, rest.rate), (Regime::Stick, slid.state, 0.0));
    // It yields again where it stopped.
    assert_eq!(respond(&law, NORMAL, slid.traction, slid.state).regime, Regime::Stick);
    let again = respond(&law, NORMAL, slid.traction * (1.0 + 1e-6), slid.state);
    assert_eq!(again.regime, Regime::Slip);
    let mut mu = [f64::NAN; 3];
    law.coefficient(&[NORMAL; 3], &[0.0; 3], &[0.0, 0.5 * D_C, 3.0 * D_C], &mut mu).unwrap();
    assert_eq!((mu[0], mu[2]), (MU_S, MU_K));
    assert_relative_eq!(mu[1], 0.5 * (MU_S + MU_K), max_relative = 1e-15);
}

#[test]
fn an_ideal_slip_weakening_law_without_drop_is_coulomb() {
    let law = SlipWeakening::new(0.5, 0.5, D_C, None).unwrap();
    for old in [0.0, 0.3 * D_C, 5.0 * D_C] {
        let one = respond(&law, NORMAL, 8e6, old);
        assert_eq!((one.traction, one.d_trial, one.d_normal), (5e6, 0.0, 0.5));
        assert_relative_eq!(one.slip, 3e6 / STIFFNESS, max_relative = 1e-15);
    }
}

/// The remainder f(h) - f(0) - h f' vanishes to rounding, or at second order.
fn is_derivative(f: impl Fn(f64) -> f64, derivative: f64, h: f64, what: &str) {
    let remainder = |h: f64| (f(h) - f(0.0) - h * derivative).abs();
    if remainder(h) > 1e-12 * f(0.0).abs() {
        let order = (remainder(h) / remainder(0.5 * h)).log2();
        assert!((order - 2.0).abs() < 0.1, "{what}: order {order}");
    }
}

#[test]
fn the_derivatives_of_every_branch_are_consistent() {
    let (sw, low, sk) = (weakening(), capped(5e6), dropping());
    let sk_low = StaticKinetic::new(MU_S, MU_K, Some(3e6)).unwrap();
    // Law, trial traction, state, and the expected ∂τ/∂|t^e|.
    let branches: [(&str, &dyn Law, f64, f64, f64); 12] = [
        ("weakening, stick", &sw, 6e6, 0.0, 1.0),
        ("weakening", &sw, 8e6, 0.0, -1.0 / 3.0),
        ("weakening, half way", &sw, 7e6, 0.5 * D_C, -1.0 / 3.0),
        ("weakening, across the kink", &sw, 2e7, 0.5 * D_C, 0.0),
        ("weakened", &sw, 7e6, 1.5 * D_C, 0.0),
        ("capped", &low, 7e6, 0.0, 0.0),
        ("from the cap down", &low, 1.4e7, 0.0, -1.0 / 3.0),
        ("from the cap to the residual", &low, 3e7, 0.0, 0.0),
        ("static, stick", &sk, 6e6, 0.0, 1.0),
        ("static, slip", &sk, 8e6, 0.0, 0.0),
        ("kinetic, slip", &sk, 5e6, 1.0, 0.0),
        ("kinetic, capped", &sk_low, 5e6, 1.0, 0.0),
    ];
    for (what, law, trial, state, d_trial) in branches {
        let one = respond(law, NORMAL, trial, state);
        assert_abs_diff_eq!(one.d_trial, d_trial, epsilon = 1e-15);
        is_derivative(|h| respond(law, NORMAL, trial + h, state).traction, one.d_trial, 1e4, what);
        is_derivative(|h| respond(law, NORMAL + h, trial, state).traction, one.d_normal, 1e4, what);
    }
}

#[test]
fn the_cap_holds_and_removes_the_normal_coupling_until_the_cone_is_below_it() {
    let law = capped(5e6);
    let one = respond(&law, NORMAL, 7e6, 0.0);
    assert_eq!((one.traction, one.d_trial, one.d_normal), (5e6, 0.0, 0.0));
    assert_relative_eq!(one.slip, 2e6 / STIFFNESS, max_relative = 1e-15);
    // Beyond the cap, the answer is that of the law without a cap.
    let far = respond(&law, NORMAL, 1.4e7, 0.0);
    assert_eq!(far, respond(&weakening(), NORMAL, 1.4e7, 0.0));
    assert!(far.traction < 5e6 && far.traction > MU_K * NORMAL);
    // A cap below the residual strength limits the traction for ever, behind any spring.
    let low = capped(3e6);
    for old in [0.0, 0.7 * D_C, 4.0 * D_C] {
        let one = respond_with(&low, [NORMAL, 9e6, 0.1 * WEAKENING], old, None).unwrap();
        assert_eq!((one.traction, one.d_normal), (3e6, 0.0));
    }
    let both = StaticKinetic::new(MU_S, MU_K, Some(5e6)).unwrap();
    assert_eq!(respond(&both, NORMAL, 5e6, 0.0).regime, Regime::Stick);
    assert_eq!(respond(&both, NORMAL, 5.1e6, 0.0).traction, 4e6);
    let low = StaticKinetic::new(MU_S, MU_K, Some(3e6)).unwrap();
    let one = respond(&low, NORMAL, 5e6, 0.0);
    assert_eq!((one.traction, one.d_normal), (3e6, 0.0));
}

#[test]
fn a_spring_softer_than_the_weakening_is_refused_until_the_point_is_weakened() {
    let law = weakening();
    for stiffness in [WEAKENING * (1.0 - 1e-12), 0.3 * WEAKENING] {
        for old in [0.0, 0.99 * D_C] {
            let failure = respond_with(&law, [NORMAL, 8e6, stiffness], old, None).unwrap_err();
            let Failure::Unstable { point: 0, stiffness: found, weakening } = failure else {
                panic!("{failure}");
            };
            assert_eq!(found, stiffness);
            assert_relative_eq!(weakening, WEAKENING, max_relative = 1e-14);
        }
        // In stick, and once weakened, the spring does not matter.
        assert_eq!(respond_with(&law, [NORMAL, 6e6, stiffness], 0.0, None).unwrap().traction, 6e6);
        for old in [D_C * (1.0 - 1e-12), D_C, 2.0 * D_C] {
            let one = respond_with(&law, [NORMAL, 8e6, stiffness], old, None).unwrap();
            assert_eq!((one.traction, one.d_trial, one.d_normal), (4e6, 0.0, MU_K));
        }
    }
    // On the cap the spring does not matter either, except at its end.
    let (law, soft) = (capped(5e6), 0.3 * WEAKENING);
    assert_eq!(respond_with(&law, [NORMAL, 5.2e6, soft], 0.0, None).unwrap().traction, 5e6);
    let failure = respond_with(&law, [NORMAL, 9e6, soft], 0.0, None).unwrap_err();
    assert!(matches!(failure, Failure::Unstable { .. }), "{failure}");
}

#[test]
fn the_failing_point_is_named() {
    let law = weakening();
    let [mut t, mut s, mut v, mut a, mut b, mut n] = [[0.0; 3]; 6];
    let failure = law
        .respond(
            Trials {
                points: &[0, 1, 2],
                normal: &[NORMAL; 3],
                trial: &[1e6, 2e6, 9e6],
                stiffness: 0.5 * WEAKENING,
                dt: DT,
                damping: 0.0,
                lag: None,
                near: None,
            },
            &[0.0; 3],
            Responses {
                traction: &mut t,
                slip: &mut s,
                rate: &mut v,
                regime: &mut [Regime::Stick; 3],
                d_trial: &mut a,
                d_normal: &mut b,
                states: &mut n,
            },
        )
        .unwrap_err();
    assert!(matches!(failure, Failure::Unstable { point: 2, .. }), "{failure}");
}

#[test]
fn static_strength_drops_to_kinetic_in_slip_and_heals_in_rest() {
    let law = dropping();
    let at = |trial: f64, state: f64| respond(&law, NORMAL, trial, state);
    assert_eq!((at(6.9e6, 0.0).regime, at(6.9e6, 0.0).traction), (Regime::Stick, 6.9e6));
    let slip = at(7.1e6, 0.0);
    assert_eq!((slip.regime, slip.traction, slip.state), (Regime::Slip, 4e6, 1.0));
    assert_relative_eq!(slip.slip, 3.1e6 / STIFFNESS, max_relative = 1e-15);
    assert_relative_eq!(slip.rate, slip.slip / DT, max_relative = 1e-15);
    // It continues to slip at the kinetic strength.
    let on = at(slip.traction + 1e5, slip.state);
    assert_eq!((on.regime, on.traction, on.state), (Regime::Slip, 4e6, 1.0));
    let rest = at(4e6, on.state);
    assert_eq!((rest.regime, rest.slip, rest.state), (Regime::Stick, 0.0, 0.0));
    assert_eq!(at(6.9e6, rest.state).regime, Regime::Stick);
    let mut mu = [f64::NAN; 2];
    law.coefficient(&[NORMAL; 2], &[0.0; 2], &[0.0, 1.0], &mut mu).unwrap();
    assert_eq!(mu, [MU_S, MU_K]);
}

#[test]
fn a_pulled_static_kinetic_point_makes_sawteeth() {
    // Each drop f_n (μ_s - μ_k) is reloaded by 30 increments of a hundredth of f_n.
    let law = dropping();
    let (mut traction, mut state, mut slips) = (0.0, 0.0, Vec::new());
    for n in 0..200 {
        let one = respond(&law, NORMAL, traction + 0.01 * NORMAL * 1.0001, state);
        (traction, state) = (one.traction, one.state);
        if one.regime == Regime::Slip && slips.last().is_none_or(|last| n > last + 1) {
            slips.push(n);
        }
        // The slip takes the drop and leaves the point there: the far end has to stop for the point to heal.
        if one.regime == Regime::Slip {
            state = respond(&law, NORMAL, traction, state).state;
        }
    }
    assert_eq!(slips, [69, 99, 129, 159, 189]);
}

/// Cohesion c adds to the strength alone: a point answers as one without cohesion under a trial that is smaller by c.
#[test]
fn cohesion_shifts_the_strength_and_nothing_else() {
    let (cohesion, cap) = (1.5e6, Some(8e6));
    let without: [(&dyn Law, f64); 3] = [
        (&Coulomb::new(MU_S, None).unwrap(), 0.0),
        (&weakening(), 0.3 * D_C),
        (&SlipWeakening::new(MU_S, MU_K, D_C, cap.map(|cap| cap - cohesion)).unwrap(), 0.0),
    ];
    let with: [&dyn Law; 3] = [
        &Coulomb::cohesive(MU_S, cohesion, None).unwrap(),
        &SlipWeakening::cohesive(MU_S, MU_K, D_C, cohesion, None).unwrap(),
        &SlipWeakening::cohesive(MU_S, MU_K, D_C, cohesion, cap).unwrap(),
    ];
    for ((plain, old), cohesive) in without.into_iter().zip(with) {
        for trial in [3e6, 6.9e6, 8e6, 20e6] {
            let expected = respond(plain, NORMAL, trial, old);
            let found = respond(cohesive, NORMAL, trial + cohesion, old);
            assert_relative_eq!(found.traction, expected.traction + cohesion, max_relative = 1e-14);
            assert_relative_eq!(found.slip, expected.slip, max_relative = 1e-12);
            assert_eq!((found.regime, found.d_trial), (expected.regime, expected.d_trial));
            assert_relative_eq!(found.d_normal, expected.d_normal, max_relative = 1e-12);
        }
    }
}

/// A point that sticks leaves rest where its traction meets c + μ f_n, and not at all where it has opened by then.
#[test]
fn sticking_points_slip_at_cohesion_and_friction_unless_they_open_first() {
    let law = Coulomb::cohesive(0.5, 2e6, None).unwrap();
    let exit = |change: [f64; 2]| {
        let start = Start { normal: 4e6, traction: 1e6, state: 0.0, ..STICKING };
        let [normal, traction] = change;
        let step = Increments { normal: &[normal], traction: &[traction], slip: &[0.0] };
        let present = PresentStates { states: &[], ..present(&start, STIFFNESS) };
        law.limit(present, step, BOUNDS).map(|limit: Limit| limit.fraction)
    };
    // 1 + 6 r = 2 + 0.5 · 4, and 1 + 2 r = 2 + 0.5 (4 - 3 r).
    assert_relative_eq!(exit([0.0, 6e6]).unwrap(), 0.5, max_relative = 1e-14);
    assert_relative_eq!(exit([-3e6, 2e6]).unwrap(), 3.0 / 3.5, max_relative = 1e-14);
    // It opens at r = 1/2 with 1.5 MPa, below its cohesion; the line of the strength would be met at r = 3/5.
    assert_eq!(exit([-8e6, 1e6]), None);
}

#[test]
fn a_lag_shifts_the_rate_alone() {
    let laws: [&dyn Law; 2] = [&dropping(), &weakening()];
    for law in laws {
        let plain = respond(law, NORMAL, 8e6, 0.0);
        let lagged = respond_with(law, [NORMAL, 8e6, STIFFNESS], 0.0, Some((1.5, 0.25))).unwrap();
        assert_relative_eq!(lagged.rate, 1.5 * plain.slip / DT - 0.25, max_relative = 1e-15);
        assert_eq!(PointAnswer { rate: plain.rate, ..lagged }, plain);
        let rest = respond_with(law, [NORMAL, 1e6, STIFFNESS], 0.0, Some((1.5, 0.25))).unwrap();
        assert_eq!(rest.rate, 0.0);
    }
}

/// Name and message of the refusal.
fn refused<T: std::fmt::Debug>(result: Result<T, Failure>) -> (&'static str, String) {
    let failure = result.unwrap_err();
    let Failure::Parameter { name, .. } = failure else { panic!("{failure}") };
    (name, failure.to_string())
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    for bad in [f64::NAN, -0.1, f64::INFINITY] {
        assert_eq!(refused(StaticKinetic::new(bad, 0.1, None)).0, "mu_s");
        assert_eq!(refused(SlipWeakening::new(bad, 0.1, D_C, None)).0, "mu_s");
        assert_eq!(refused(StaticKinetic::new(0.7, bad, None)).0, "mu_k");
        assert_eq!(refused(SlipWeakening::new(0.7, bad, D_C, None)).0, "mu_k");
    }
    for bad in [f64::NAN, -1.0, 0.0, f64::INFINITY] {
        assert_eq!(refused(SlipWeakening::new(0.7, 0.4, bad, None)).0, "d_c");
        assert_eq!(refused(SlipWeakening::new(0.7, 0.4, D_C, Some(bad))).0, "f_limit");
        assert_eq!(refused(StaticKinetic::new(0.7, 0.4, Some(bad))).0, "f_limit");
    }
    assert_eq!(
        refused(StaticKinetic::new(0.4, 0.7, None)).1,
        "mu_k = 7e-1 is not admissible: 0 <= mu_k < mu_s"
    );
    assert_eq!(
        refused(SlipWeakening::new(0.4, 0.7, D_C, None)).1,
        "mu_k = 7e-1 is not admissible: 0 <= mu_k <= mu_s"
    );
    // Without a drop the law is not static and kinetic friction; slip weakening reduces to Coulomb.
    assert_eq!(refused(StaticKinetic::new(0.4, 0.4, None)).0, "mu_k");
    assert!(SlipWeakening::new(0.4, 0.4, D_C, None).is_ok());
}

/// One point at the start of a forward step.
#[derive(Clone, Copy, Debug)]
struct Start {
    normal: f64,
    traction: f64,
    rate: f64,
    regime: Regime,
    state: f64,
}

const SLIDING: Start =
    Start { normal: NORMAL, traction: 5.5e6, rate: 1e-3, regime: Regime::Slip, state: 0.5 * D_C };
const STICKING: Start = Start { normal: NORMAL, traction: 6e6, rate: 0.0, regime: Regime::Stick, state: 0.0 };

fn present(s: &Start, stiffness: f64) -> PresentStates<'_> {
    PresentStates {
        points: &[0],
        normal: from_ref(&s.normal),
        traction: from_ref(&s.traction),
        rate: from_ref(&s.rate),
        regime: from_ref(&s.regime),
        states: from_ref(&s.state),
        stiffness,
        dt: DT,
        rate_floor: 1e-18,
    }
}

/// along, coupling, constant.
fn rates(law: &dyn Law, s: &Start, stiffness: f64) -> Result<[f64; 3], Failure> {
    let (mut along, mut coupling, mut constant) = ([f64::NAN], [f64::NAN], [f64::NAN]);
    law.rates(
        present(s, stiffness),
        Rates { along: &mut along, coupling: &mut coupling, constant: &mut constant },
    )?;
    Ok([along[0], coupling[0], constant[0]])
}

fn limit(law: &dyn Law, s: &Start, step: [f64; 3]) -> Option<Limit> {
    let [normal, traction, slip] = step.map(|x| [x]);
    law.limit(present(s, STIFFNESS), Increments { normal: &normal, traction: &traction, slip: &slip }, BOUNDS)
}

#[test]
fn the_rate_form_of_slip_weakening_is_its_closed_form() {
    let law = weakening();
    assert_eq!(rates(&law, &STICKING, STIFFNESS).unwrap(), [1.0, 0.0, 0.0]);
    let off = Start { traction: 5.4e6, ..SLIDING };
    let [along, coupling, constant] = rates(&law, &off, STIFFNESS).unwrap();
    let kappa = 4.0 / 3.0;
    assert_relative_eq!(along, -1.0 / 3.0, max_relative = 1e-14);
    assert_relative_eq!(coupling, kappa * 0.55, max_relative = 1e-14);
    assert_relative_eq!(constant, kappa * 1e5, max_relative = 1e-12);
    let weakened = Start { state: D_C, ..off };
    assert_eq!(rates(&law, &weakened, STIFFNESS).unwrap(), [0.0, MU_K, 4e6 - 5.4e6]);
    assert_eq!(rates(&capped(5e6), &off, STIFFNESS).unwrap(), [0.0, 0.0, 5e6 - 5.4e6]);
    // A spring that cannot follow.
    let failure = rates(&law, &off, 0.9 * WEAKENING).unwrap_err();
    assert!(matches!(failure, Failure::Unstable { point: 0, .. }), "{failure}");
    assert!(rates(&law, &weakened, 0.9 * WEAKENING).is_ok());
    assert!(rates(&capped(5e6), &off, 0.9 * WEAKENING).is_ok());
}

#[test]
fn forward_and_implicit_steps_agree_exactly_at_constant_and_to_second_order_at_changing_normal_traction() {
    let law = weakening();
    let error = |slide: f64, df: f64| {
        let [along, coupling, constant] = rates(&law, &SLIDING, STIFFNESS).unwrap();
        let forward = along * STIFFNESS * slide + coupling * df + constant;
        let one = respond(&law, NORMAL + df, SLIDING.traction + STIFFNESS * slide, SLIDING.state);
        assert_eq!(one.regime, Regime::Slip);
        (forward - (one.traction - SLIDING.traction)).abs()
    };
    assert!(error(1e-4, 0.0) < 1e-12 * SLIDING.traction);
    let order = (error(1e-4, 3e5) / error(0.5e-4, 1.5e5)).log2();
    assert!((order - 2.0).abs() < 0.1, "order {order}");
}

/// Pulls at constant normal traction by the rate form with its limits; returns the state at the end, and the largest error of the
/// prediction by the rate form.
fn pull_forward(law: &dyn Law, reach: f64, step: f64) -> (Start, f64) {
    let mut s = Start { traction: 0.0, ..STICKING };
    let mut foreseen = 0.0_f64;
    let mut left = reach;
    while left > 1e-12 * reach {
        let slide = step.min(left);
        let [along, _, constant] = rates(law, &s, STIFFNESS).unwrap();
        let change = |r: f64| along * STIFFNESS * r * slide + r * constant;
        let slip = |r: f64| if s.regime == Regime::Slip { r * slide - change(r) / STIFFNESS } else { 0.0 };
        let r = limit(law, &s, [0.0, change(1.0), slip(1.0)]).map_or(1.0, |l| l.fraction);
        // As in a stepper: the law answers the predicted step, and a point at its strength slips in the next.
        let end = respond(law, NORMAL, s.traction + STIFFNESS * r * slide, s.state);
        foreseen = foreseen.max((s.traction + change(r) - end.traction).abs());
        s = Start { traction: end.traction, rate: end.rate, regime: end.regime, state: end.state, ..s };
        if law.stands(present(&s, STIFFNESS), 0) {
            s.regime = Regime::Slip;
        }
        left -= r * slide;
    }
    (s, foreseen)
}

#[test]
fn forward_steps_with_their_limits_end_where_implicit_steps_do() {
    for reach in [0.5, 1.2, 1.6, 4.0] {
        let reach = reach * MU_S * NORMAL / STIFFNESS;
        let implicit = *pull(&weakening(), NORMAL, reach, 10).last().unwrap();
        for step in [0.02 * reach, 0.5 * reach, reach] {
            let (forward, foreseen) = pull_forward(&weakening(), reach, step);
            // Within its limits the law is linear.
            assert!(foreseen < 1e-8 * NORMAL, "{foreseen}");
            assert_relative_eq!(forward.traction, implicit.traction, max_relative = 1e-8);
            assert_abs_diff_eq!(forward.state, implicit.state, epsilon = 1e-8 * D_C);
        }
    }
}

#[test]
fn a_sticking_point_reaches_its_present_strength() {
    let half = Start { traction: 5e6, state: 0.5 * D_C, ..STICKING };
    let found = limit(&weakening(), &half, [1e6, 2e6, 0.0]).unwrap();
    assert_eq!(found.kind, LimitKind::StickToSlip);
    assert_relative_eq!(
        5e6 + found.fraction * 2e6,
        0.55 * (NORMAL + found.fraction * 1e6),
        max_relative = 1e-14
    );
    let stands = |law: &dyn Law, s: Start| law.stands(present(&s, STIFFNESS), 0);
    assert!(stands(&weakening(), Start { traction: 5.5e6, ..half }));
    assert!(!stands(&weakening(), half));
    let found = limit(&dropping(), &STICKING, [0.0, 2e6, 0.0]).unwrap();
    assert_eq!((found.kind, found.point), (LimitKind::StickToSlip, 0));
    assert_relative_eq!(found.fraction, 0.5, max_relative = 1e-14);
    assert!(stands(&dropping(), Start { traction: 7e6, ..STICKING }) && !stands(&dropping(), STICKING));
    // The cap is a separate surface.
    let found = limit(&capped(6.5e6), &STICKING, [0.0, 2e6, 0.0]).unwrap();
    assert_eq!(found.fraction, 0.25);
}

#[test]
fn the_slip_of_a_step_is_bounded_and_ends_at_the_kink() {
    let law = weakening();
    let found = limit(&law, &SLIDING, [0.0, 0.0, D_C]).unwrap();
    assert_eq!(found.kind, LimitKind::SlipLength);
    assert_relative_eq!(found.fraction, BOUNDS.zeta, max_relative = 1e-14);
    let near = Start { state: 0.97 * D_C, ..SLIDING };
    let found = limit(&law, &near, [0.0, 0.0, 0.05 * D_C]).unwrap();
    assert_eq!(found.kind, LimitKind::SlipLength);
    assert_relative_eq!(found.fraction, 0.6, max_relative = 1e-12);
    // At this point, within the band, and beyond it, slip is free.
    for state in [D_C, D_C * (1.0 - 1e-10), 2.0 * D_C] {
        assert_eq!(limit(&law, &Start { state, ..SLIDING }, [0.0, 0.0, D_C]), None);
    }
    assert_eq!(limit(&law, &near, [0.0, 0.0, -D_C]), None);
}

#[test]
fn inputs_that_are_not_finite_are_refused() {
    let laws: [&dyn Law; 2] = [&dropping(), &weakening()];
    let named = |result: Result<(), Failure>| {
        assert!(matches!(result, Err(Failure::NonFinite { point: 0, .. })), "{result:?}");
    };
    for law in laws {
        for bad in [f64::NAN, f64::INFINITY] {
            for [normal, trial, state] in [[bad, 1e6, 0.0], [1e6, bad, 0.0], [1e6, 1e6, bad]] {
                named(respond_with(law, [normal, trial, STIFFNESS], state, None).map(|_| ()));
            }
            named(rates(law, &Start { traction: bad, ..SLIDING }, STIFFNESS).map(|_| ()));
            named(rates(law, &Start { normal: bad, ..SLIDING }, STIFFNESS).map(|_| ()));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Never NaN, balanced to rounding, on or below the strength, and slip never reverses.
    #[test]
    fn the_point_return_of_slip_weakening_is_admissible(
        mu_s in 0.0f64..1.5,
        share in 0.0f64..=1.0,
        log_length in -6.0f64..0.0,
        log_normal in 0.0f64..9.0,
        open in prop::bool::weighted(0.05),
        trial in 0.0f64..4.0,
        margin in -2.0f64..4.0,
        old in 0.0f64..1.5,
        cap in prop::option::of(0.01f64..2.0),
    ) {
        let (mu_k, d_c) = (share * mu_s, 10f64.powf(log_length));
        let normal = if open { 0.0 } else { 10f64.powf(log_normal) };
        let cap = cap.map(|c| c * 10f64.powf(log_normal));
        let law = SlipWeakening::new(mu_s, mu_k, d_c, cap).unwrap();
        let (trial, old) = (trial * 10f64.powf(log_normal), old * d_c);
        let weakening = normal * ((mu_s - mu_k) / d_c);
        let stiffness = 10f64.powf(margin) * weakening.max(1e-3 * 10f64.powf(log_normal) / d_c);
        match respond_with(&law, [normal, trial, stiffness], old, None) {
            Ok(one) => {
                let mut mu = [f64::NAN];
                law.coefficient(&[normal], &[one.rate], &[one.state], &mut mu).unwrap();
                let strength = (mu[0] * normal).min(cap.unwrap_or(f64::INFINITY));
                prop_assert!(one.traction <= strength * (1.0 + 1e-14), "{one:?} above {strength}");
                prop_assert!(one.slip >= 0.0 && one.rate >= 0.0 && one.traction >= 0.0, "{one:?}");
                prop_assert!(one.state >= old, "{one:?}");
                prop_assert!((one.state - old - one.slip).abs() <= 1e-9 * d_c, "{one:?}");
                prop_assert!(one.d_trial.is_finite() && one.d_normal.is_finite(), "{one:?}");
                let balance = trial - stiffness * one.slip - one.traction;
                prop_assert!(balance.abs() <= 1e-12 * trial, "balance {balance} of {trial}: {one:?}");
            }
            Err(failure) => {
                prop_assert!(matches!(failure, Failure::Unstable { .. }), "{failure}");
                prop_assert!(stiffness <= weakening, "{failure}");
            }
        }
    }

    #[test]
    fn the_point_return_of_static_and_kinetic_friction_is_admissible(
        mu_s in 1e-3f64..1.5,
        share in 0.0f64..0.999,
        log_normal in 0.0f64..9.0,
        trial in 0.0f64..4.0,
        log_stiffness in 3.0f64..15.0,
        slipping: bool,
        cap in prop::option::of(0.01f64..2.0),
    ) {
        let normal = 10f64.powf(log_normal);
        let cap = cap.map(|c| c * normal);
        let law = StaticKinetic::new(mu_s, share * mu_s, cap).unwrap();
        let (trial, stiffness) = (trial * normal, 10f64.powf(log_stiffness));
        let old = if slipping { 1.0 } else { 0.0 };
        let one = respond_with(&law, [normal, trial, stiffness], old, None).unwrap();
        let mut mu = [f64::NAN];
        law.coefficient(&[normal], &[0.0], &[old], &mut mu).unwrap();
        let strength = (mu[0] * normal).min(cap.unwrap_or(f64::INFINITY));
        prop_assert!(one.traction <= strength, "{one:?} above {strength}");
        prop_assert!(one.slip >= 0.0 && one.rate >= 0.0 && one.traction >= 0.0, "{one:?}");
        prop_assert_eq!(one.state, if one.regime == Regime::Slip { 1.0 } else { 0.0 });
        let balance = trial - stiffness * one.slip - one.traction;
        prop_assert!(balance.abs() <= 1e-14 * trial, "balance {balance} of {trial}: {one:?}");
    }
}
