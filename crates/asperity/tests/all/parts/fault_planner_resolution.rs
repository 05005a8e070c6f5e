use asperity_fem::element::FaceKind;
use asperity_plan::reading::scene::law::{Evolution, Form, LawChoice, State, Strength};
use asperity_plan::shared::resolution::*;
use std::f64::consts::PI;

fn law((name, own): (&'static str, &[Option<f64>]), a: f64, states: &[(f64, f64)]) -> LawChoice {
    let evolution = Evolution { name, own: own.to_vec() };
    LawChoice::RateAndState {
        strength: Strength { form: Form::Regularised, mu0: 0.6, a, v_ref: 1e-6, heat: None },
        evolution,
        states: states.iter().map(|&(b, l)| State { b, l, alpha: 0.0 }).collect(),
        v_initial: 1e-9,
        normal_initial: None,
        f_limit: None,
    }
}

const AGEING: (&str, &[Option<f64>]) = ("ageing", &[None]);
const G: f64 = 32.038_120_32e9;

fn lengths(law: &LawChoice, normal: f64, in_space: bool) -> [f64; 2] {
    Ground { law, normal, modulus: G, in_space }.lengths().unwrap()
}

#[test]
fn lengths_are_those_published_with_the_benchmarks() {
    // BP1 "process zone 340 m, nucleation 2 km", BP2 170 m and 1 km, BP5 5.98 km and 12.5 km, BP4 1.97 km and 12.4 km, BP7 64 m and 280 m, to the
    // digits given.
    for (a, b, l, normal, in_space, zone, nucleation, share) in [
        (0.010, 0.015, 0.008, 50e6, false, 340.0, 2e3, 0.03),
        (0.010, 0.015, 0.004, 50e6, false, 170.0, 1e3, 0.03),
        (0.004, 0.030, 0.140, 25e6, true, 5.98e3, 12.5e3, 2e-3),
        (0.0065, 0.013, 0.040, 50e6, true, 1.97e3, 12.4e3, 2e-3),
        (0.004, 0.010, 0.0005, 25e6, true, 64.0, 280.0, 2e-3),
    ] {
        let found = lengths(&law(AGEING, a, &[(b, l)]), normal, in_space);
        assert!((found[0] / zone - 1.0).abs() < share, "{found:?} {zone}");
        assert!((found[1] / nucleation - 1.0).abs() < share, "{found:?} {nucleation}");
    }
}

#[test]
fn the_zone_of_slip_weakening_is_that_of_the_dynamic_rupture_benchmark() {
    // Day et al. (2005), version 3: 620 m in mode III and 827 m in mode II.
    let law =
        LawChoice::Yielding { kind: "slip-weakening", own: vec![0.677, 0.525, 0.4, 0.0], f_limit: None };
    for (modulus, zone) in [(32.04e9, 620.0), (32.04e9 / 0.75, 827.0)] {
        let found = Ground { law: &law, normal: 120e6, modulus, in_space: false }.lengths().unwrap();
        assert!((found[0] / zone - 1.0).abs() < 2e-3, "{found:?}");
    }
    let steady = LawChoice::Yielding { kind: "slip-weakening", own: vec![0.6, 0.6, 0.4, 0.0], f_limit: None };
    assert!(Ground { law: &steady, normal: 120e6, modulus: 32e9, in_space: false }.lengths().is_none());
}

#[test]
fn two_equal_states_are_one_of_their_sum() {
    let (one, two) = (law(AGEING, 0.01, &[(0.015, 0.01)]), law(AGEING, 0.01, &[(0.0075, 0.01); 2]));
    for (a, b) in lengths(&one, 5e7, false).iter().zip(lengths(&two, 5e7, false)) {
        assert!((a / b - 1.0).abs() < 1e-14);
    }
}

#[test]
fn friction_that_strengthens_has_no_lengths() {
    let law = law(AGEING, 0.02, &[(0.015, 0.01)]);
    assert!(Ground { law: &law, normal: 5e7, modulus: G, in_space: false }.lengths().is_none());
}

#[test]
fn the_slip_law_has_a_shorter_zone_and_half_the_critical_wavelength() {
    let (ageing, slip) = (law(AGEING, 0.01, &[(0.015, 0.008)]), law(("slip", &[]), 0.01, &[(0.015, 0.008)]));
    let [zone, nucleation] = lengths(&slip, 5e7, false);
    // Half of L_b, found from the cells that BP1 needs with this law.
    assert!((lengths(&ageing, 5e7, false)[0] / zone - 2.0).abs() < 1e-14);
    assert!((2.0 * nucleation / (PI * G * 0.008 / (5e7 * 0.005)) - 1.0).abs() < 1e-14);
}

#[test]
fn flash_weakening_adds_its_drop_to_what_is_lost_over_l() {
    let flash = [Some(0.13), Some(0.1)];
    let [zone, nucleation] = lengths(&law(("flash", &flash), 0.01, &[(0.014, 0.02)]), 5e7, false);
    let lost = 0.014 + 0.6 - 0.13;
    assert!((zone / (0.5 * G * 0.02 / (5e7 * lost)) - 1.0).abs() < 1e-14);
    assert!((2.0 * nucleation / (PI * G * 0.02 / (5e7 * (lost - 0.01))) - 1.0).abs() < 1e-14);
}

#[test]
fn faces_link_each_node_with_its_neighbours() {
    assert_eq!(links(FaceKind::Seg2), [(0, 1)]);
    assert_eq!(links(FaceKind::Seg3), [(0, 2), (2, 1)]);
    assert_eq!(links(FaceKind::Tri3), [(0, 1), (1, 2), (2, 0)]);
    assert_eq!(links(FaceKind::Quad4).len(), 4);
    assert_eq!(links(FaceKind::Tri6).len(), 6);
    assert_eq!(links(FaceKind::Quad8).len(), 8);
    assert_eq!(links(FaceKind::Quad9).len(), 12);
}
