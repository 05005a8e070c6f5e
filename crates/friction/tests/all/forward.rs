//! The rate form: its linearisation, and the limits r6 and r8.

use super::usual::usual;
use asperity_friction::component::Component;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::each_evolution;
use asperity_friction::evolution::flash::{Flash, Weakening};
use asperity_friction::evolution::{
    Common, Evolution, TableEvolution, ageing::Ageing, nagata::Nagata, slip::Slip,
};
use asperity_friction::law::{
    Increments, Law, Limit, LimitKind, PresentStates, RateBounds, Rates, Regime, Responses, Trials,
};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::arrhenius::Arrhenius;
use asperity_friction::strength::cut_off::CutOff;
use asperity_friction::strength::{Form, Parameters, bare::Bare, regularised::Regularised};

const NORMAL: f64 = 9e6;
const STIFFNESS: f64 = 3.5e12;
const V_REF: f64 = 1e-6;
const LENGTH: f64 = 1e-5;
const FLOOR: f64 = 1e-18;
const BOUNDS: RateBounds = RateBounds { zeta: 0.1, log_rate: 1.0 };

fn parameters() -> Parameters {
    Parameters::new(0.6, 0.01, V_REF).unwrap()
}

/// One point at the start of a step.
#[derive(Clone, Copy, Debug)]
struct Start {
    normal: f64,
    traction: f64,
    rate: f64,
    dt: f64,
}

fn present<'a>(s: &'a Start, regime: &'a [Regime; 1], states: &'a [f64]) -> PresentStates<'a> {
    use std::slice::from_ref;
    PresentStates {
        points: &[0],
        normal: from_ref(&s.normal),
        traction: from_ref(&s.traction),
        rate: from_ref(&s.rate),
        regime,
        states,
        stiffness: STIFFNESS,
        dt: s.dt,
        rate_floor: FLOOR,
    }
}

/// along, coupling, constant.
fn rates(law: &dyn Law, s: &Start, regime: Regime, states: &[f64]) -> [f64; 3] {
    let (mut along, mut coupling, mut constant) = ([f64::NAN], [f64::NAN], [f64::NAN]);
    law.rates(
        present(s, &[regime], states),
        Rates { along: &mut along, coupling: &mut coupling, constant: &mut constant },
    )
    .unwrap();
    [along[0], coupling[0], constant[0]]
}

fn limit(law: &dyn Law, s: &Start, regime: Regime, states: &[f64], step: [f64; 3]) -> Option<Limit> {
    let [normal, traction, slip] = step.map(|x| [x]);
    law.limit(
        present(s, &[regime], states),
        Increments { normal: &normal, traction: &traction, slip: &slip },
        BOUNDS,
    )
}

/// Increment of the traction by the implicit return.
fn implicit(law: &dyn Law, s: &Start, states: &[f64], slide: f64, df: f64) -> f64 {
    let mut new = states.to_vec();
    let (mut t, mut l, mut v, mut g, mut dt, mut dn) = ([0.0], [0.0], [0.0], [Regime::Stick], [0.0], [0.0]);
    law.respond(
        Trials {
            points: &[0],
            normal: &[s.normal + df],
            trial: &[s.traction + STIFFNESS * slide],
            stiffness: STIFFNESS,
            dt: s.dt,
            damping: 0.0,
            lag: None,
            near: None,
        },
        states,
        Responses {
            traction: &mut t,
            slip: &mut l,
            rate: &mut v,
            regime: &mut g,
            d_trial: &mut dt,
            d_normal: &mut dn,
            states: &mut new,
        },
    )
    .unwrap();
    t[0] - s.traction
}

/// From a balanced but unsteady state, the strengths of the forward and the implicit step differ at second order in Δt.
fn part_at_second_order<F: Form, E: Evolution>(form: F, parts: &[Component<E>], evolution: &E, rate: f64) {
    for offset in [-0.01, 0.008] {
        // Steady under less than the actual normal traction.
        let law = RateLaw::with_parts(form.clone(), parts.to_vec(), rate, 0.8 * NORMAL, None).unwrap();
        let mut states = vec![0.0; law.states()];
        law.initial(&mut states);
        for state in &mut states {
            *state += offset * evolution.per_phi();
        }
        let mut mu = [0.0];
        law.coefficient(&[NORMAL], &[rate], &states, &mut mu).unwrap();
        let errors = |dt: f64| {
            let s = Start { normal: NORMAL, traction: NORMAL * mu[0], rate, dt };
            let [along, coupling, constant] = rates(&law, &s, Regime::Slip, &states);
            let (slide, df) = (rate * dt, 0.2 * NORMAL * rate * dt / LENGTH);
            let forward = along * STIFFNESS * slide + coupling * df + constant;
            let back = implicit(&law, &s, &states, slide, df);
            // An error of the strength reaches the traction with the factor κ, itself of the order of Δt.
            (forward - back).abs() / (1.0 - along)
        };
        // Small relative to both L/V and a f_n/(E_t V), the time scales of state and spring; a memory of shear traction
        // shortens the second.
        let dt = 2e-3 * 2e-7 / rate / (1.0 + evolution.shear_memory());
        let (coarse, fine) = (errors(dt), errors(0.5 * dt));
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.1, "{}, offset {offset}: order {order}", E::NAME);
    }
}

/// The same with one state, with and without memory of normal traction, and with two states.
fn agrees_to_second_order<E: Evolution>(evolution: &E, other: Option<&E>) {
    let part = |e: &E, alpha: f64| Component::new(e.clone(), alpha).unwrap();
    let mut laws = vec![vec![part(evolution, 0.0)], vec![part(evolution, 0.3)]];
    if let Some(other) = other {
        laws.push(vec![part(evolution, 0.0), part(other, 0.0)]);
        laws.push(vec![part(evolution, 0.2), part(other, 0.1)]);
    }
    for parts in laws {
        part_at_second_order(Regularised(parameters()), &parts, evolution, 2e-7);
        part_at_second_order(Bare(parameters()), &parts, evolution, 2e-7);
        let warm = Arrhenius::new(Regularised(parameters()), 9e4, 293.0, 320.0).unwrap();
        part_at_second_order(warm, &parts, evolution, 2e-7);
        part_at_second_order(CutOff::new(parameters(), 3e-7).unwrap(), &parts, evolution, 2e-7);
    }
}

#[test]
fn forward_and_implicit_steps_part_at_second_order_with_every_evolution() {
    let common = |b, length| Common { mu0: 0.6, a: 0.01, v_ref: V_REF, b, length };
    each_evolution!(Law => {
        let other = usual::<Law>(common(0.004, 8.0 * LENGTH));
        let several = <Law as TableEvolution>::DEFINITION.one_state.is_none();
        agrees_to_second_order(&usual::<Law>(common(0.015, LENGTH)), several.then_some(&other));
    });
}

#[test]
fn forward_and_implicit_steps_part_at_second_order_with_a_cut_off_of_the_ageing_law() {
    let ageing = |b, l| Ageing::new(b, l, V_REF).unwrap();
    let cut = |b, l| ageing(b, l).with_cut_off(4e-7).unwrap();
    agrees_to_second_order(&cut(0.015, LENGTH), Some(&cut(0.004, 8.0 * LENGTH)));
}

#[test]
fn forward_and_implicit_steps_part_at_second_order_with_the_nagata_law() {
    for c in [0.3, 2.0, 10.0] {
        agrees_to_second_order(&Nagata::new(0.015, LENGTH, V_REF, c).unwrap(), None);
    }
}

#[test]
fn forward_and_implicit_steps_part_at_second_order_with_flash_heating() {
    // Below and above the rate at which weakening begins.
    for v_w in [1e-6, 1.5e-7] {
        let w = Weakening { mu0: 0.6, a: 0.01, b: 0.015, v_ref: V_REF, mu_w: 0.2, v_w };
        let small = Weakening { mu_w: 0.55, b: 0.012, ..w };
        let other = Flash::new(small, 8.0 * LENGTH).unwrap();
        agrees_to_second_order(&Flash::new(w, LENGTH).unwrap(), Some(&other));
    }
}

/// H = f_n [a/(V_0 Δt) - Ω/L], κ = E_t/(E_t + H), constant -κ a f_n: the closed form of the slip law.
#[test]
fn the_rate_form_of_the_slip_law_is_its_closed_form() {
    let evolution = Slip::new(0.015, LENGTH, V_REF).unwrap();
    let law = RateLaw::new(Bare(parameters()), evolution, V_REF, None).unwrap();
    let (rate, dt, omega) = (3e-7, 0.01, 0.012);
    let phi = evolution.steady(f64::ln(rate)) + omega;
    let mu = 0.6 + phi + 0.01 * (rate / V_REF).ln();
    let s = Start { normal: NORMAL, traction: mu * NORMAL, rate, dt };
    let [along, coupling, constant] = rates(&law, &s, Regime::Slip, &[phi]);
    let hardening = NORMAL * (0.01 / (rate * dt) - omega / LENGTH);
    let kappa = STIFFNESS / (STIFFNESS + hardening);
    approx::assert_relative_eq!(along, hardening / (STIFFNESS + hardening), max_relative = 1e-14);
    approx::assert_relative_eq!(coupling, kappa * mu, max_relative = 1e-14);
    approx::assert_relative_eq!(constant, -kappa * 0.01 * NORMAL, max_relative = 1e-12);
    // A difference between traction and strength is removed.
    let off = rates(&law, &Start { traction: 5e6, ..s }, Regime::Slip, &[phi]);
    approx::assert_relative_eq!(off[2] - constant, kappa * (mu * NORMAL - 5e6), max_relative = 1e-13);
}

/// The ageing law's constant is -κ f_n (a - b Δt/θ_0), its hardening f_n [a/(V_0 Δt) - b/L].
#[test]
fn the_rate_form_of_the_ageing_law_is_its_closed_form() {
    let (b, theta, rate, dt) = (0.015, 7.0, 3e-7, 0.01);
    let law = RateLaw::new(Bare(parameters()), Ageing::new(b, LENGTH, V_REF).unwrap(), V_REF, None).unwrap();
    let psi = f64::ln(V_REF * theta / LENGTH);
    let mu = 0.6 + b * psi + 0.01 * (rate / V_REF).ln();
    let s = Start { normal: NORMAL, traction: mu * NORMAL, rate, dt };
    let [along, _, constant] = rates(&law, &s, Regime::Slip, &[psi]);
    let hardening = NORMAL * (0.01 / (rate * dt) - b / LENGTH);
    let kappa = STIFFNESS / (STIFFNESS + hardening);
    approx::assert_relative_eq!(along, hardening / (STIFFNESS + hardening), max_relative = 1e-13);
    approx::assert_relative_eq!(constant, -kappa * NORMAL * (0.01 - b * dt / theta), max_relative = 1e-12);
}

#[test]
fn a_point_weaker_than_its_spring_is_refused_in_the_rate_form() {
    let evolution = Ageing::new(10.0, 1e-9, V_REF).unwrap();
    let law = RateLaw::new(Regularised(parameters()), evolution, V_REF, None).unwrap();
    let s = Start { normal: NORMAL, traction: 5e6, rate: 1e-6, dt: 10.0 };
    let (mut a, mut b, mut c) = ([0.0], [0.0], [0.0]);
    let failure = law
        .rates(
            present(&s, &[Regime::Slip], &[0.0]),
            Rates { along: &mut a, coupling: &mut b, constant: &mut c },
        )
        .unwrap_err();
    assert!(matches!(failure, asperity_friction::Failure::Unstable { point: 0, .. }), "{failure}");
}

fn velocity() -> RateLaw<Regularised, asperity_friction::evolution::stateless::Stateless> {
    RateLaw::velocity(parameters(), None).unwrap()
}

fn floor_mu(law: &dyn Law) -> f64 {
    let mut mu = [0.0];
    law.coefficient(&[9e6], &[FLOOR], &[], &mut mu).unwrap();
    mu[0]
}

#[test]
fn a_resting_point_sticks_until_its_strength_at_the_floor() {
    let law = velocity();
    let s = Start { normal: NORMAL, traction: 1e6, rate: 0.0, dt: 0.1 };
    assert_eq!(rates(&law, &s, Regime::Stick, &[]), [1.0, 0.0, 0.0]);
    let (df, dtau) = (1e6, 6e6);
    let found = limit(&law, &s, Regime::Stick, &[], [df, dtau, 0.0]).unwrap();
    assert_eq!(found.kind, LimitKind::StickToSlip);
    let r = found.fraction;
    approx::assert_relative_eq!(1e6 + r * dtau, floor_mu(&law) * (NORMAL + r * df), max_relative = 1e-14);
    // A point within the band does not limit the step.
    let near = Start { traction: floor_mu(&law) * NORMAL * (1.0 - 1e-10), ..s };
    assert_eq!(limit(&law, &near, Regime::Stick, &[], [0.0, 1e6, 0.0]), None);
}

#[test]
fn a_traction_leaves_on_the_other_side_too() {
    let law = velocity();
    let s = Start { normal: NORMAL, traction: 1e6, rate: 0.0, dt: 0.1 };
    let r = limit(&law, &s, Regime::Stick, &[], [0.0, -1e7, 0.0]).unwrap().fraction;
    approx::assert_relative_eq!(1e6 - r * 1e7, -floor_mu(&law) * NORMAL, max_relative = 1e-14);
    // A cone that shrinks to zero around an unloaded point is an opening.
    let unloaded = Start { traction: 0.0, ..s };
    assert_eq!(limit(&law, &unloaded, Regime::Stick, &[], [-2.0 * NORMAL, 0.0, 0.0]), None);
}

#[test]
fn the_cap_is_a_surface_of_its_own() {
    let (coulomb, capped) =
        (Coulomb::new(0.6, Some(3e6)).unwrap(), RateLaw::velocity(parameters(), Some(3e6)).unwrap());
    let laws: [&dyn Law; 2] = [&coulomb, &capped];
    for law in laws {
        // The cone grows past the cap before the traction reaches it.
        let s = Start { normal: NORMAL, traction: 1e6, rate: 0.0, dt: 0.1 };
        let found = limit(law, &s, Regime::Stick, &[], [8e6, 4e6, 0.0]).unwrap();
        assert_eq!(found.fraction, 0.5, "{}", law.name());
        // At the cap, the normal traction has no effect, and the step ends on the cap.
        let s = Start { normal: NORMAL, traction: 2.9e6, rate: 1e-6, dt: 0.1 };
        let [along, coupling, constant] = rates(law, &s, Regime::Slip, &[]);
        assert_eq!((along, coupling), (0.0, 0.0));
        approx::assert_relative_eq!(constant, 1e5, max_relative = 1e-9);
    }
}

#[test]
fn coulomb_points_switch_at_the_cone() {
    let law = Coulomb::new(0.5, None).unwrap();
    let s = Start { normal: 8e6, traction: 3e6, rate: 0.0, dt: 0.1 };
    assert_eq!(rates(&law, &s, Regime::Stick, &[]), [1.0, 0.0, 0.0]);
    let found = limit(&law, &s, Regime::Stick, &[], [-2e6, 1e6, 0.0]).unwrap();
    assert_eq!((found.fraction, found.kind), (0.5, LimitKind::StickToSlip));
    let there = Start { normal: 7e6, traction: 3.5e6, ..s };
    let stands = |s: &Start| law.stands(present(s, &[Regime::Stick], &[]), 0);
    assert_eq!([stands(&s), stands(&there)], [false, true]);
    let s = Start { traction: 3.9e6, ..s };
    assert_eq!(rates(&law, &s, Regime::Slip, &[]), [0.0, 0.5, 1e5]);
}

#[test]
fn the_slip_of_a_step_is_bounded_by_the_characteristic_length() {
    let law = RateLaw::new(Regularised(parameters()), Slip::new(0.015, LENGTH, V_REF).unwrap(), V_REF, None)
        .unwrap();
    let s = Start { normal: NORMAL, traction: 5e6, rate: 1e-6, dt: 4.0 };
    let found = limit(&law, &s, Regime::Slip, &[0.0], [0.0, 0.0, 4e-6]).unwrap();
    assert_eq!(found.kind, LimitKind::SlipLength);
    approx::assert_relative_eq!(found.fraction, BOUNDS.zeta * LENGTH / 4e-6, max_relative = 1e-15);
    // Without a state there is no characteristic slip.
    assert_eq!(limit(&velocity(), &s, Regime::Slip, &[], [0.0, 0.0, 4e-6]), None);
}

#[test]
fn the_change_of_the_rate_is_bounded_in_both_directions_and_ends_at_the_floor() {
    let law = velocity();
    let s = Start { normal: NORMAL, traction: 5e6, rate: 1e-9, dt: 0.1 };
    let fraction = |slip: f64| limit(&law, &s, Regime::Slip, &[], [0.0, 0.0, slip]);
    let up = fraction(1e-8 * s.dt).unwrap();
    assert_eq!(up.kind, LimitKind::RateChange);
    // V_0 + r (V - V_0) = e V_0.
    approx::assert_relative_eq!(up.fraction, (1f64.exp() - 1.0) / 9.0, max_relative = 1e-14);
    let down = fraction(-1e-9 * s.dt).unwrap();
    approx::assert_relative_eq!(down.fraction, (1.0 - (-1f64).exp()) / 2.0, max_relative = 1e-14);
    assert_eq!(fraction(1.5e-9 * s.dt), None);
    // Near the floor max(V, V_floor) cannot fall by more than the bound.
    let near = Start { rate: 2.0 * FLOOR, ..s };
    assert_eq!(limit(&law, &near, Regime::Slip, &[], [0.0, 0.0, -FLOOR * s.dt]), None);
}

/// With the a-term in the tangent, the disturbance that grows below Δt = 2 a σ/(k V) with a lagged coefficient decays at any
/// step. The point is on its penalty spring, pulled at V, with a rate that starts off by a tenth.
#[test]
fn forward_steps_are_stable_for_small_steps() {
    let law = velocity();
    let v = 1e-6;
    for factor in [0.05, 0.5, 1.98, 20.0] {
        let dt = factor * 0.01 * NORMAL / (STIFFNESS * v);
        let mut mu = [0.0];
        law.coefficient(&[9e6], &[1.1 * v], &[], &mut mu).unwrap();
        let mut s = Start { normal: NORMAL, traction: NORMAL * mu[0], rate: 1.1 * v, dt };
        let mut last = 0.1;
        for _ in 0..400 {
            let [along, _, constant] = rates(&law, &s, Regime::Slip, &[]);
            let change = along * STIFFNESS * v * dt + constant;
            let slip = v * dt - change / STIFFNESS;
            let rate = slip / dt;
            s = Start { traction: s.traction + change, rate, ..s };
            let deviation = (rate / v - 1.0).abs();
            assert!(
                deviation <= last * (1.0 + 1e-12) || deviation < 1e-9,
                "{factor}: {deviation} after {last}"
            );
            last = deviation;
        }
        assert!(last < 1e-7, "{factor}: {last}");
    }
}

/// μ' of the coupling includes the effect of a change of f_n on the states: μ - α.
#[test]
fn a_memory_of_normal_traction_lowers_the_coupling() {
    let (alpha, rate, dt) = (0.3, 3e-7, 0.01);
    let evolution = Slip::new(0.015, LENGTH, V_REF).unwrap();
    let part = Component::new(evolution, alpha).unwrap();
    let law = RateLaw::with_parts(Bare(parameters()), vec![part], V_REF, 5e6, None).unwrap();
    let omega = 0.012;
    // φ is smaller by α ln(f_n/f_ref) than the kept quantity.
    let phi = evolution.steady(f64::ln(rate)) + omega;
    let kept = phi + alpha * (NORMAL / 5e6).ln();
    let s = Start { normal: NORMAL, traction: 5e6, rate, dt };
    let [along, coupling, _] = rates(&law, &s, Regime::Slip, &[kept]);
    let hardening = NORMAL * (0.01 / (rate * dt) - omega / LENGTH);
    let kappa = STIFFNESS / (STIFFNESS + hardening);
    let mu = 0.6 + phi + 0.01 * (rate / V_REF).ln();
    approx::assert_relative_eq!(along, hardening / (STIFFNESS + hardening), max_relative = 1e-13);
    approx::assert_relative_eq!(coupling, kappa * (mu - alpha), max_relative = 1e-13);
}

/// H = f_n [a/(V_0 Δt) - b/L]/(1 + c) of the Nagata law with the bare logarithm.
#[test]
fn the_rate_form_of_the_nagata_law_is_its_closed_form() {
    let (b, c, theta, rate, dt) = (0.015, 2.0, 7.0, 3e-7, 0.01);
    let law =
        RateLaw::new(Bare(parameters()), Nagata::new(b, LENGTH, V_REF, c).unwrap(), V_REF, None).unwrap();
    let psi = f64::ln(V_REF * theta / LENGTH);
    let mu = 0.6 + b * psi + 0.01 * (rate / V_REF).ln();
    let s = Start { normal: NORMAL, traction: mu * NORMAL, rate, dt };
    let [along, coupling, constant] = rates(&law, &s, Regime::Slip, &[psi + c / b * mu]);
    let hardening = NORMAL * (0.01 / (rate * dt) - b / LENGTH) / (1.0 + c);
    let kappa = STIFFNESS / (STIFFNESS + hardening);
    approx::assert_relative_eq!(along, hardening / (STIFFNESS + hardening), max_relative = 1e-12);
    approx::assert_relative_eq!(coupling, kappa * mu, max_relative = 1e-12);
    let expected = -kappa * NORMAL * (0.01 - b * dt / theta) / (1.0 + c);
    approx::assert_relative_eq!(constant, expected, max_relative = 1e-11);
}

/// A resting point under growing normal traction meets a strength lowered by its memory: to first order in Δf_n.
#[test]
fn the_start_of_slip_takes_in_the_memory_of_normal_traction() {
    let part = Component::new(Ageing::new(0.015, LENGTH, V_REF).unwrap(), 0.3).unwrap();
    let law = RateLaw::with_parts(Regularised(parameters()), vec![part], V_REF, NORMAL, None).unwrap();
    let mut states = [0.0];
    law.initial(&mut states);
    let strength = |normal: f64| {
        let mut mu = [0.0];
        law.coefficient(&[normal], &[FLOOR], &states, &mut mu).unwrap();
        mu[0] * normal
    };
    let error = |change: f64| {
        let traction = strength(NORMAL) - 0.5 * change.abs();
        let s = Start { normal: NORMAL, traction, rate: 0.0, dt: 0.1 };
        let found = limit(&law, &s, Regime::Stick, &states, [change, 2.0 * change.abs(), 0.0]).unwrap();
        let r = found.fraction;
        let step = [r * change, 2.0 * r * change.abs(), 0.0];
        (traction + step[1] - strength(NORMAL + step[0])).abs()
    };
    for sign in [1.0, -1.0] {
        let order = (error(sign * 2e5) / error(sign * 1e5)).log2();
        assert!((order - 2.0).abs() < 0.1, "{order}");
    }
}
