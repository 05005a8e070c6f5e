//! The equations of spring-sliders: balance of tractions, Jacobian, jumps, reversal.

use super::usual::usual;
use asperity_friction::component::Component;
use asperity_friction::each_evolution;
use asperity_friction::evolution::{
    Common, Definition, TableEvolution, ageing::Ageing, definition, nagata::Nagata, slip::Slip,
};
use asperity_friction::law::RateDependent;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider, SliderLaw, Spring, System};
use asperity_friction::strength::{Form, Parameters, bare::Bare, cut_off::CutOff, regularised::Regularised};
use std::sync::Arc;

const V_REF: f64 = 1e-6;
const L: f64 = 1e-5;
const A: f64 = 0.01;
const B: f64 = 0.015;

fn parameters() -> Parameters {
    Parameters::new(0.6, A, V_REF).unwrap()
}

fn regularised() -> Regularised {
    Regularised(parameters())
}

fn named(name: &str) -> Arc<dyn SliderLaw> {
    laws().into_iter().find(|law| law.0 == name).unwrap().1
}

/// Every kind of law, by name.
fn laws() -> Vec<(&'static str, Arc<dyn SliderLaw>)> {
    let ageing = || Ageing::new(B, L, V_REF).unwrap();
    let slip = |b, l| Slip::new(b, l, V_REF).unwrap();
    let memory = vec![Component::new(ageing(), 0.3).unwrap()];
    let two = vec![
        Component::new(slip(0.012, L), 0.1).unwrap(),
        Component::new(slip(0.003, 10.0 * L), 0.0).unwrap(),
    ];
    let cut = CutOff::new(parameters(), 1e-4).unwrap();
    let mut laws: Vec<(&'static str, Arc<dyn SliderLaw>)> = vec![
        ("bare", Arc::new(RateLaw::new(Bare(parameters()), ageing(), 1e-6, None).unwrap())),
        ("memory", Arc::new(RateLaw::with_parts(regularised(), memory, 1e-6, 5e6, None).unwrap())),
        ("two", Arc::new(RateLaw::with_parts(regularised(), two, 1e-6, 5e6, None).unwrap())),
        ("cut-off", Arc::new(RateLaw::new(cut, ageing().with_cut_off(1e-2).unwrap(), 1e-6, None).unwrap())),
    ];
    let common = Common { mu0: 0.6, a: A, v_ref: V_REF, b: B, length: L };
    each_evolution!(Law => {
        let law = RateLaw::new(regularised(), usual::<Law>(common), 1e-6, None).unwrap();
        laws.push((<Law as TableEvolution>::DEFINITION.name, Arc::new(law)));
    });
    laws
}

fn slider(law: &Arc<dyn SliderLaw>, damping: f64, mass: Option<f64>) -> Slider {
    let normal = History::sine(5e6, 5e5, 3.0, 0.1).unwrap();
    Slider { law: law.clone(), stiffness: 1.25e9, damping, mass, normal }
}

/// Unknowns away from equilibrium of the states.
fn unknowns(system: &System, rates: &[f64]) -> Vec<f64> {
    let states: Vec<Vec<f64>> = system
        .sliders()
        .iter()
        .zip(rates)
        .map(|(s, &v)| {
            let mut states = vec![0.0; s.law.states()];
            s.law.steady((3.0 * v.abs()).ln(), &mut states);
            states
        })
        .collect();
    let mut y = system.start(rates, &states).unwrap();
    for i in 0..rates.len() {
        if system.sliders()[i].mass.is_some() {
            *system.slider_unknowns_mut(i, &mut y).last_mut().unwrap() = 0.02;
        }
    }
    y
}

#[test]
fn the_jacobian_is_the_derivative_of_the_rates() {
    for (name, law) in laws() {
        for (damping, mass) in [(0.0, None), (5e6, None), (0.0, Some(3e3)), (5e6, Some(3e3))] {
            for v in [1e-9, 1e-6, 1e-2] {
                let pair = vec![slider(&law, damping, mass), slider(&law, 2.0 * damping, None)];
                let spring = Spring { between: [0, 1], stiffness: 3e8 };
                let system = System::new(pair, vec![spring], History::Constant(1e-6)).unwrap();
                let (segment, y) = (system.segment(0.0), unknowns(&system, &[v, 2.0 * v]));
                let n = y.len();
                let mut jacobian = vec![0.0; n * n];
                segment.jacobian(0.7, &y, &mut jacobian);
                let at = |y: &[f64]| {
                    let mut dy = vec![0.0; n];
                    segment.rates(0.7, y, &mut dy);
                    dy
                };
                let base = at(&y);
                for column in 0..n {
                    let remainder = |h: f64| {
                        let mut moved = y.clone();
                        moved[column] += h;
                        let dy = at(&moved);
                        let line = |i: usize| base[i] + h * jacobian[column * n + i];
                        (0..n).map(|i| (dy[i] - line(i)).abs() / (1e-300 + base[i].abs())).collect::<Vec<_>>()
                    };
                    let h = 2e-4 * system.scales()[column];
                    let (coarse, fine) = (remainder(h), remainder(0.5 * h));
                    for i in 0..n {
                        // Of second order, or at rounding.
                        let order = (coarse[i] / fine[i]).log2();
                        let change = (h * jacobian[column * n + i] / base[i]).abs();
                        let rounding = 1e-12 * (1.0 + change);
                        assert!(
                            (order - 2.0).abs() < 0.1 || coarse[i] < rounding,
                            "{name} η {damping} M {mass:?} V {v}: {i} by {column}: {:e} {:e}",
                            coarse[i],
                            fine[i]
                        );
                    }
                }
            }
        }
    }
}

/// Over a short time, the traction gained by the springs equals that of friction, damping and inertia.
#[test]
fn tractions_stay_in_balance() {
    for (name, law) in laws() {
        for mass in [None, Some(3e3)] {
            let system = System::new(vec![slider(&law, 5e6, mass)], vec![], History::Constant(2e-6)).unwrap();
            let (segment, y) = (system.segment(0.0), unknowns(&system, &[1e-4]));
            let mut dy = vec![0.0; y.len()];
            segment.rates(0.3, &y, &mut dy);
            let h = 1e-5 / dy.iter().fold(0.0f64, |m, d| m.max(d.abs()));
            let moved = |s: f64| y.iter().zip(&dy).map(|(y, d)| y + s * h * d).collect::<Vec<_>>();
            let traction = |s: f64| segment.condition(0, 0.3 + s * h, &moved(s)).traction;
            let rate = |s: f64| segment.condition(0, 0.3 + s * h, &moved(s)).rate;
            let gained = (traction(1.0) - traction(-1.0)) / (2.0 * h);
            let expected = 1.25e9 * (2e-6 - rate(0.0));
            assert!(
                (gained - expected).abs() < 1e-5 * expected.abs(),
                "{name} {mass:?}: {gained} {expected}"
            );
            if let Some(mass) = mass {
                let accelerated = mass * (rate(1.0) - rate(-1.0)) / (2.0 * h);
                let net = 0.02 * segment.condition(0, 0.3, &y).normal * A;
                assert!((accelerated - net).abs() < 1e-5 * net, "{name}: {accelerated} {net}");
            }
        }
    }
}

/// Continuous quantities over a step of f_n: traction without inertia, the slip rate with it; dφ = -α ln(ratio) at constant V.
#[test]
fn a_step_of_normal_traction_keeps_what_cannot_jump() {
    for (name, law) in laws() {
        for mass in [None, Some(3e3)] {
            let normal = History::table(vec![[0.0, 5e6], [1.0, 5e6], [1.0, 5.5e6], [2.0, 5.5e6]]).unwrap();
            let block = Slider { normal, ..slider(&law, 5e6, mass) };
            let system = System::new(vec![block], vec![], History::Constant(1e-6)).unwrap();
            let (before, after) = (system.segment(0.5), system.segment(1.5));
            let mut y = unknowns(&system, &[1e-5]);
            let was = before.condition(0, 1.0, &y);
            system.jump(1.0, &before, &after, &mut y).unwrap();
            let is = after.condition(0, 1.0, &y);
            assert_eq!(is.normal, 5.5e6);
            approx::assert_relative_eq!(is.traction, was.traction, max_relative = 1e-13);
            if mass.is_some() {
                approx::assert_relative_eq!(is.rate, was.rate, max_relative = 1e-12);
            } else {
                assert!(is.rate < was.rate, "{name}");
            }
        }
    }
    // Without damping and memory μ falls as 1/f_n, and ln V by its change over a, at constant state.
    let law = named("bare");
    let mut y = [80.0, 0.4];
    law.jump(&mut y, 5e6, 5.5e6, 0.0, false).unwrap();
    approx::assert_relative_eq!(y[0], 80.0 / 1.1, max_relative = 1e-14);
    assert_eq!(y[1], 0.4);
    // With memory α the state contribution falls by α ln 1.1.
    let law = named("memory");
    let mut y = [80.0, 0.4];
    law.jump(&mut y, 5e6, 5.5e6, 0.0, false).unwrap();
    approx::assert_relative_eq!(B * (0.4 - y[1]), 0.3 * 1.1f64.ln(), max_relative = 1e-12);
}

/// With both memories and inertia V is unchanged, and `dφ = -α d ln f_n - c dμ` with dμ = dφ far from rest.
#[test]
fn a_step_of_normal_traction_is_remembered_beside_that_of_shear_traction() {
    let form = Regularised(Parameters::new(0.6, A, 1e-6).unwrap());
    let part = Component::new(Nagata::new(B, 1e-5, 1e-6, 2.0).unwrap(), 0.3).unwrap();
    let law = RateLaw::with_parts(form, vec![part], 1e-6, 5e6, None).unwrap();
    let mut y = [60.0, 0.4, 0.02];
    let (was, _) = law.slip(&y);
    law.jump(&mut y, 5e6, 5.5e6, 0.0, true).unwrap();
    let (is, _) = law.slip(&y);
    approx::assert_relative_eq!(is.log, was.log, max_relative = 1e-13);
    approx::assert_relative_eq!(B * (0.4 - y[1]), 0.3 * 1.1f64.ln() / 3.0, max_relative = 1e-11);
}

/// With asinh the equations are odd: mirrored tractions give mirrored rates, and V = 0 is not special.
#[test]
fn reversal_is_a_mirror_image() {
    for (name, law) in laws().into_iter().filter(|l| l.1.at_rate(0.0, &[0.0; 4][..l.1.states()]).is_ok()) {
        let system = System::new(vec![slider(&law, 5e6, None)], vec![], History::Constant(0.0)).unwrap();
        let segment = system.segment(0.0);
        let y = unknowns(&system, &[1e-7]);
        let mut mirrored = y.clone();
        mirrored[0] = -y[0];
        // f_n' = 0 at the crest.
        let crest = 0.1 + 0.75;
        let (mut there, mut here) = (vec![0.0; y.len()], vec![0.0; y.len()]);
        segment.rates(crest, &y, &mut there);
        segment.rates(crest, &mirrored, &mut here);
        approx::assert_relative_eq!(there[0], -here[0], max_relative = 1e-9);
        for (a, b) in there[1..].iter().zip(&here[1..]) {
            approx::assert_relative_eq!(a, b, max_relative = 1e-9);
        }
        mirrored[0] = 0.0;
        segment.rates(crest, &mirrored, &mut here);
        assert!(here.iter().all(|r| r.is_finite()), "{name}: {here:?}");
    }
}

/// The rates are those of the rated law: V and the state rates from the traction.
#[test]
fn equations_agree_with_the_rated_law() {
    for (name, law) in laws().into_iter().filter(|l| definition(l.0).is_some_and(Definition::is_plain)) {
        let block = Slider { normal: History::Constant(5e6), ..slider(&law, 5e6, None) };
        let system = System::new(vec![block], vec![], History::Constant(1e-6)).unwrap();
        let (segment, y) = (system.segment(0.0), unknowns(&system, &[3e-3]));
        let mut dy = vec![0.0; y.len()];
        segment.rates(0.0, &y, &mut dy);
        let traction = [segment.condition(0, 0.0, &y).traction];
        let drives =
            asperity_friction::law::Drives { traction: &traction, normal: &[5e6], damping: 5e6, near: None };
        let (mut rate, mut change) = ([0.0], [0.0]);
        RateDependent::slip_rates(&*law, drives, &y[1..], &mut rate, &mut change).unwrap();
        approx::assert_relative_eq!(rate[0], 3e-3, max_relative = 1e-11);
        approx::assert_relative_eq!(change[0], dy[1], max_relative = 1e-10);
        assert!(!name.is_empty());
    }
}

#[test]
fn histories_have_their_values_slopes_and_integrals() {
    let ramp = History::table(vec![[1.0, 2.0], [3.0, 6.0], [3.0, 1.0]]).unwrap();
    assert_eq!(ramp.breaks(), [1.0, 3.0]);
    assert_eq!(ramp.piece(0.0).at(0.5), (2.0, 0.0));
    assert_eq!(ramp.piece(2.0).at(2.5), (5.0, 2.0));
    assert_eq!(ramp.piece(9.0).at(9.0), (1.0, 0.0));
    assert_eq!(ramp.piece(2.0).integral(1.0, 2.0), 8.0);
    assert_eq!(ramp.least(), 1.0);
    let sine = History::sine(3.0, 2.0, 4.0, 1.0).unwrap();
    let piece = sine.piece(0.0);
    approx::assert_relative_eq!(piece.at(2.0).0, 5.0, max_relative = 1e-15);
    // ∫ over a quarter period from the crossing: 3 + 2 (2/π).
    approx::assert_relative_eq!(
        piece.integral(1.0, 1.0),
        3.0 + 4.0 / std::f64::consts::PI,
        max_relative = 1e-14
    );
    assert!(History::table(vec![[1.0, 0.0], [0.0, 1.0]]).is_err());
    assert!(History::table(vec![]).is_err());
    assert!(History::sine(0.0, 1.0, 0.0, 0.0).is_err());
}

#[test]
fn sliders_out_of_range_are_refused() {
    let law = named("ageing");
    let good = || Slider { normal: History::Constant(5e6), ..slider(&law, 0.0, None) };
    let refused = |s: Slider| System::new(vec![s], vec![], History::Constant(0.0)).is_err();
    assert!(!refused(good()));
    assert!(refused(Slider { normal: History::Constant(0.0), ..good() }));
    assert!(refused(Slider { normal: History::sine(5e6, 6e6, 1.0, 0.0).unwrap(), ..good() }));
    assert!(refused(Slider { mass: Some(0.0), ..good() }));
    assert!(refused(Slider { damping: f64::NAN, ..good() }));
    assert!(refused(Slider { stiffness: -1.0, ..good() }));
    let spring = Spring { between: [0, 3], stiffness: 1.0 };
    assert!(System::new(vec![good()], vec![spring], History::Constant(0.0)).is_err());
    // The bare logarithm has no value at rest.
    let bare = named("bare");
    assert!(bare.at_rate(0.0, &[0.0]).is_err() && bare.at_rate(-1.0, &[0.0]).is_err());
    assert_eq!(Bare(parameters()).rest_slope(0.0), None);
}

#[test]
fn forms_without_a_value_at_rest_refuse_a_negative_strength() {
    let steady = |law: &dyn SliderLaw, rate: f64| {
        let mut states = vec![0.0; law.states()];
        law.steady(rate.ln(), &mut states);
        states
    };
    let ageing = || Ageing::new(B, L, V_REF).unwrap();
    let slippery = || Parameters::new(0.02, A, V_REF).unwrap();
    let laws: Vec<Arc<dyn SliderLaw>> = vec![
        Arc::new(RateLaw::new(Bare(slippery()), ageing(), V_REF, None).unwrap()),
        Arc::new(RateLaw::new(CutOff::new(slippery(), 1e-6).unwrap(), ageing(), V_REF, None).unwrap()),
    ];
    for law in laws {
        // In steady state at 1 m/s either form is below zero: 0.02 - 0.005 ln 1e6, and 0.02 + 0.015 ln 1e-6 minus a negligible
        // amount.
        let failure = law.at_rate(1.0, &steady(&*law, 1.0)).unwrap_err();
        assert!(matches!(failure, asperity_friction::Failure::Negative { mu, .. } if mu < 0.0), "{failure}");
        assert!(!law.reverses());
        assert!(law.slip(&[-1.0, 0.0]).0.rate.is_nan());
    }
    let regular: Arc<dyn SliderLaw> =
        Arc::new(RateLaw::new(Regularised(slippery()), ageing(), V_REF, None).unwrap());
    assert!(regular.reverses());
    assert!(regular.at_rate(1.0, &steady(&*regular, 1.0)).unwrap() > 0.0);
}
