//! Parameters out of range.

use super::common::*;
use asperity_friction::Failure;
use asperity_friction::component::Component;
use asperity_friction::evolution::flash::{Flash, Weakening};
use asperity_friction::evolution::{ageing::Ageing, nagata::Nagata, slip::Slip};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::arrhenius::Arrhenius;
use asperity_friction::strength::cut_off::CutOff;
use asperity_friction::strength::{Parameters, bare::Bare, regularised::Regularised};

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let refused = |result: Result<(), Failure>, expected: &str| match result {
        Err(Failure::Parameter { name, .. }) => assert_eq!(name, expected),
        other => panic!("{expected}: {other:?}"),
    };
    for bad in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        refused(Parameters::new(0.6, bad, 1e-6).map(drop), "a");
        refused(Parameters::new(0.6, 0.01, bad).map(drop), "v_ref");
        refused(Ageing::new(0.01, bad, 1e-6).map(drop), "l");
        refused(Slip::new(0.01, bad, 1e-6).map(drop), "l");
        refused(Slip::new(0.01, 1e-5, bad).map(drop), "v_ref");
        let form = Regularised(Parameters::new(0.6, 0.01, 1e-6).unwrap());
        refused(
            RateLaw::new(form.clone(), Slip::new(0.01, 1e-5, 1e-6).unwrap(), bad, None).map(drop),
            "v_initial",
        );
        let capped = RateLaw::velocity(Parameters::new(0.6, 0.01, 1e-6).unwrap(), Some(bad));
        refused(capped.map(drop), "f_limit");
    }
    refused(Parameters::new(f64::NAN, 0.01, 1e-6).map(drop), "mu0");
    refused(Ageing::new(f64::NAN, 1e-5, 1e-6).map(drop), "b");
    assert!(
        !RateLaw::velocity(Parameters::new(0.6, 0.01, 1e-6).unwrap(), None)
            .unwrap()
            .rate_weakening_without_state()
    );
}

#[test]
fn parameters_of_the_other_laws_are_refused_by_name() {
    fn refused<T: std::fmt::Debug>(result: Result<T, Failure>, expected: &str) {
        match result {
            Err(Failure::Parameter { name, .. }) => assert_eq!(name, expected),
            other => panic!("{expected}: {other:?}"),
        }
    }
    let p = Parameters::new(0.6, 0.01, 1e-6).unwrap();
    let w = weakening(0.01);
    for bad in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        refused(Nagata::new(bad, LENGTH, V_REF, 2.0), "b");
        refused(Nagata::new(B, bad, V_REF, 2.0), "l");
        refused(Nagata::new(B, LENGTH, bad, 2.0), "v_ref");
        refused(Flash::new(w, bad), "l");
        refused(Flash::new(Weakening { v_ref: bad, ..w }, LENGTH), "v_ref");
        refused(Flash::new(Weakening { v_w: bad, ..w }, LENGTH), "v_w");
        refused(Ageing::new(B, LENGTH, V_REF).unwrap().with_cut_off(bad), "v_cut_state");
        refused(CutOff::new(p, bad), "v_cut");
        refused(Arrhenius::new(Bare(p), 9e4, bad, 300.0), "t_ref");
        refused(Arrhenius::new(Bare(p), 9e4, 300.0, bad), "temperature");
        let part = Component::new(Ageing::new(B, LENGTH, V_REF).unwrap(), 0.2).unwrap();
        refused(RateLaw::with_parts(Bare(p), vec![part], 1e-6, bad, None), "normal_initial");
    }
    for bad in [-0.01, f64::NAN, f64::INFINITY] {
        refused(Nagata::new(B, LENGTH, V_REF, bad), "c");
        refused(Arrhenius::new(Bare(p), bad, 293.0, 300.0), "activation");
        refused(Component::new(Slip::new(B, LENGTH, V_REF).unwrap(), bad), "alpha");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        refused(Flash::new(Weakening { mu0: bad, ..w }, LENGTH), "mu0");
        refused(Flash::new(Weakening { a: bad, ..w }, LENGTH), "a");
        refused(Flash::new(Weakening { b: bad, ..w }, LENGTH), "b");
    }
    for bad in [-0.1, 0.6, 0.7, f64::NAN] {
        refused(Flash::new(Weakening { mu_w: bad, ..w }, LENGTH), "mu_w");
    }
    // A memory of μ has nothing to act on if b = 0.
    refused(Component::new(Ageing::new(0.0, LENGTH, V_REF).unwrap(), 0.2), "alpha");
    assert!(Component::new(Ageing::new(0.0, LENGTH, V_REF).unwrap(), 0.0).is_ok());
    let nagata = Component::new(Nagata::new(B, LENGTH, V_REF, 2.0).unwrap(), 0.0).unwrap();
    refused(RateLaw::with_parts(Bare(p), vec![nagata.clone(), nagata], 1e-6, 1e6, None), "states");
}
