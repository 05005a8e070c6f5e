//! Millions of points over the whole admissible range: balanced to rounding or refused for a reason, never a wrong root, in few
//! iterations.
#![allow(clippy::unwrap_used)]

use asperity_friction::{Failure, each_evolution};
#[path = "usual/mod.rs"]
mod usual;

use asperity_friction::component::Component;
use asperity_friction::evolution::flash::{Flash, Weakening};
use asperity_friction::evolution::{
    Common, Evolution, TableEvolution, ageing::Ageing, slip::Slip, stateless::Stateless,
};
use asperity_friction::law::{Drives, RateDependent};
use asperity_friction::point::{Point, Solution, Solver};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{
    Form, Parameters, arrhenius::Arrhenius, bare::Bare, cut_off::CutOff, regularised::Regularised,
};
use usual::usual;

const V_REF: f64 = 1e-6;
const DRAWS: usize = 250_000;

/// A deterministic sequence of numbers in [0, 1).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / 4_294_967_296.0
    }

    /// Draws a number between powers of ten.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(low + (high - low) * self.next())
    }
}

/// Mean and largest number of iterations of many points, from a cold start and from a rate within half an e-fold.
#[derive(Debug, Default)]
struct Tally {
    points: usize,
    refused: usize,
    cold: usize,
    warm: usize,
    most: usize,
}

impl Tally {
    fn check(&self, name: &str) {
        let mean = |sum: usize| sum as f64 / self.points as f64;
        assert!(self.points > DRAWS / 4, "{name}: {}", self.points);
        assert!(mean(self.cold) <= 4.0, "{name}: mean of cold starts {}", mean(self.cold));
        assert!(mean(self.warm) <= 2.0, "{name}: mean of warm starts {}", mean(self.warm));
        assert!(self.most <= 12, "{name}: most {}", self.most);
    }
}

/// Residual of the balance relative to the drive, over the effect of rounding of ln V and of its parts.
fn left_over<F: Form, E: Evolution>(form: &F, parts: &[E], p: &Point, old: &[f64], s: &Solution) -> f64 {
    let phi: f64 = parts.iter().zip(old).map(|(e, &o)| e.phi(e.step(o, s.log_rate, p.dt).state)).sum();
    let strength = form.at(s.log_rate, phi);
    let spring = p.spring * s.log_rate.exp();
    let rest = (p.normal * strength.mu + spring - p.drive).abs() / p.drive;
    // The logarithms in ln x = ln V + (μ0 + φ)/a - ... are rounded, each with its size, and act through the slope; ln V acts
    // through the spring too.
    let size = s.log_rate.abs() + 1.0;
    let inner = (1.0 + phi.abs() + strength.mu.abs()) * p.normal + form.scale() * p.normal * size;
    let outer = (spring + p.normal * s.slope.abs()) * size + p.drive;
    rest / (8.0 * f64::EPSILON * (inner * strength.d_phi + outer) / p.drive)
}

/// Runs the implicit step over draws for evolutions made by `make`.
fn implicit<F: Form, E: Evolution>(
    name: &str,
    form: impl Fn(f64) -> F,
    make: impl Fn(&mut Sequence, f64) -> Vec<E>,
) {
    let mut random = Sequence(11);
    let mut tally = Tally::default();
    for _ in 0..DRAWS {
        let a = random.decades(-4.0, -1.0);
        let (form, evolutions) = (form(a), make(&mut random, a));
        let parts: Vec<_> = evolutions.iter().map(|e| Component::new(e.clone(), 0.0).unwrap()).collect();
        let parts = if E::STATES == 0 { vec![] } else { parts };
        let normal = random.decades(0.0, 9.0);
        let dt = random.decades(-9.0, 9.0);
        let initial = random.decades(-30.0, 4.0).ln();
        let mut p = Point {
            normal,
            drive: normal * 1.5 * (random.next() + 1e-6),
            spring: random.decades(6.0, 15.0) * dt,
            dt,
            guess: None,
        };
        let old: Vec<f64> = evolutions.iter().map(|e| e.steady(initial)).collect();
        let old = if parts.is_empty() { vec![] } else { old };
        let mut solver = Solver::new(&form, &parts, 1.0);
        match solver.solve(&p, &old) {
            Ok(s) => {
                assert!(s.log_rate.is_finite() && s.mu >= 0.0, "{s:?}");
                assert!(p.spring * s.log_rate.exp() + p.normal * s.slope > 0.0, "{s:?}");
                if parts.iter().all(|_| evolutions[0].shear_memory() == 0.0) {
                    let rest = left_over(&form, &evolutions, &p, &old, &s);
                    assert!(rest <= 1.0, "{name}: {rest} {p:?} {s:?}");
                }
                p.guess = Some(s.log_rate + random.next() - 0.5);
                let again = solver.solve(&p, &old).unwrap();
                let condition = 1.0 + p.drive / (p.spring * s.log_rate.exp() + p.normal * s.slope);
                let rounding = 8.0 * f64::EPSILON * (1.0 + s.log_rate.abs() + 1.0 / a) * condition;
                assert!((again.log_rate - s.log_rate).abs() <= rounding, "{name}: {p:?}: {s:?} {again:?}");
                tally.points += 1;
                tally.cold += s.iterations;
                tally.warm += again.iterations;
                tally.most = tally.most.max(s.iterations).max(again.iterations);
            }
            Err(Failure::Unstable { stiffness, weakening, .. }) => {
                assert!(weakening >= stiffness);
                tally.refused += 1;
            }
            Err(Failure::BareLogAtRest { .. }) if !form.regular_at_rest() => tally.refused += 1,
            Err(other) => panic!("{name}: {other}: {p:?} {form:?} {evolutions:?} {old:?}"),
        }
    }
    tally.check(name);
}

fn parameters(a: f64) -> Parameters {
    Parameters::new(0.6, a, V_REF).unwrap()
}

fn effects(random: &mut Sequence) -> (f64, f64) {
    (random.decades(-4.0, -1.0), random.decades(-7.0, -1.0))
}

fn ageing(random: &mut Sequence) -> Ageing {
    let (b, length) = effects(random);
    Ageing::new(b, length, V_REF).unwrap()
}

fn slip(random: &mut Sequence) -> Slip {
    let (b, length) = effects(random);
    Slip::new(b, length, V_REF).unwrap()
}

#[test]
fn a_law_without_state_balances_in_few_iterations() {
    implicit("none", |a| Regularised(parameters(a)), |_, _| vec![Stateless]);
    implicit("none, bare", |a| Bare(parameters(a)), |_, _| vec![Stateless]);
    implicit("none, cut-off", |a| CutOff::new(parameters(a), 1e-3).unwrap(), |_, _| vec![Stateless]);
}

#[test]
fn the_ageing_law_balances_in_few_iterations() {
    implicit("ageing", |a| Regularised(parameters(a)), |r, _| vec![ageing(r)]);
    implicit("ageing, bare", |a| Bare(parameters(a)), |r, _| vec![ageing(r)]);
    let hot = |a| Arrhenius::new(Regularised(parameters(a)), 60e3, 293.0, 573.0).unwrap();
    implicit("ageing, hot", hot, |r, _| vec![ageing(r)]);
    let cut = |a| CutOff::new(parameters(a), 1e-3).unwrap();
    implicit("ageing, cut-off", cut, |r, _| vec![ageing(r).with_cut_off(1e-2).unwrap()]);
}

#[test]
fn the_slip_law_balances_in_few_iterations() {
    implicit("slip", |a| Regularised(parameters(a)), |r, _| vec![slip(r)]);
    implicit("two states", |a| Regularised(parameters(a)), |r, _| vec![slip(r), slip(r)]);
    implicit("three states", |a| Regularised(parameters(a)), |r, _| vec![ageing(r), ageing(r), ageing(r)]);
}

#[test]
fn every_evolution_balances_in_few_iterations() {
    each_evolution!(Law => implicit(
        <Law as TableEvolution>::DEFINITION.name,
        |a| Regularised(parameters(a)),
        |r, a| {
            let (b, length) = effects(r);
            vec![usual::<Law>(Common { mu0: 0.6, a, v_ref: V_REF, b, length })]
        },
    ));
    implicit(
        "flash heating",
        |a| Regularised(parameters(a)),
        |r, a| {
            let (b, length) = effects(r);
            let w = Weakening { mu0: 0.6, a, b, v_ref: V_REF, mu_w: 0.1, v_w: r.decades(-2.0, 0.0) };
            vec![Flash::new(w, length).unwrap()]
        },
    );
}

/// V from τ, for V from 1e-30 to 1e4 m/s: the rate from which the traction was computed is recovered.
#[test]
fn slip_rates_come_back_from_tractions() {
    let mut random = Sequence(5);
    let mut near = [0.0];
    for _ in 0..4 * DRAWS {
        let (a, b) = (random.decades(-4.0, -1.0), random.decades(-4.0, -1.0));
        let form = Regularised(parameters(a));
        let law = RateLaw::new(form.clone(), Ageing::new(b, 1e-3, V_REF).unwrap(), 1.0, None).unwrap();
        let (normal, damping) = (random.decades(0.0, 9.0), random.decades(3.0, 8.0));
        let v = random.decades(-30.0, 4.0);
        let state = Ageing::new(b, 1e-3, V_REF).unwrap().steady(random.decades(-30.0, 4.0).ln());
        let s = form.at(v.ln(), b * state);
        if s.mu * f64::EPSILON < f64::MIN_POSITIVE {
            // A strength at the end of the range of numbers says little about the rate.
            continue;
        }
        let sign = if random.next() < 0.5 { -1.0 } else { 1.0 };
        let damping = if random.next() < 0.1 { 0.0 } else { damping };
        let (traction, mut rate, mut change) = ([sign * (normal * s.mu + damping * v)], [0.0], [0.0]);
        let drives = Drives { traction: &traction, normal: &[normal], damping, near: Some(&near) };
        law.slip_rates(drives, &[state], &mut rate, &mut change).unwrap();
        assert!(rate[0] * sign > 0.0 && change[0].is_finite(), "{v} {rate:?} {change:?}");
        // ln V is known to rounding of τ divided by its slope, and of the terms of ln x, both in computing τ and in inverting
        // it.
        let slope = normal * s.d_log_rate + damping * v;
        let terms = normal * s.d_phi * (0.6 + b * state.abs() + s.mu + a * (v.ln().abs() + V_REF.ln().abs()));
        let rounding = 8.0 * f64::EPSILON * ((traction[0].abs() + terms) / slope + v.ln().abs());
        let error = (rate[0].abs() / v).ln().abs();
        assert!(error <= rounding, "{v} {rate:?}: {error:e} {rounding:e} a {a} b {b} {normal} {damping}");
        // Half of the points start warm.
        near = [if random.next() < 0.5 { 0.0 } else { rate[0] }];
    }
}
