//! The tangent is the derivative of the residual in every combination.

use crate::common::*;
use asperity_contact::{Interface, SegmentKind, Sliding, Status, TimeRule};
use asperity_fem::term::{Linearized, Term};
use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::{ageing::Ageing, slip::Slip, stateless::Stateless};
use asperity_friction::law::Law;
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Parameters, regularised::Regularised};
use std::sync::Arc;

type LawOption = Option<Arc<dyn Law>>;

fn laws() -> [LawOption; 3] {
    [None, coulomb(), viscous()]
}

/// Motions of the slaves of the line: a committed first contact, then stick, slip, slip the other way, open.
const LINE: ([[f64; 2]; 4], [[f64; 2]; 4]) = (
    [[0.01, -0.10], [0.0, -0.08], [0.0, -0.07], [0.0, -0.05]],
    [[0.02, -0.11], [0.25, -0.10], [-0.35, -0.09], [0.0, 0.05]],
);

const PLATE: ([[f64; 3]; 5], [[f64; 3]; 5]) = (
    [[0.01, 0.0, -0.10], [0.0, 0.0, -0.08], [0.0, 0.0, -0.07], [0.0, 0.0, -0.05], [0.0, 0.0, -0.05]],
    [[0.02, 0.01, -0.11], [0.2, 0.1, -0.10], [-0.15, 0.2, -0.09], [0.0, 0.1, 0.1], [0.4, 0.45, -0.07]],
);

fn line_case(sliding: Sliding, law: LawOption, rule: TimeRule, angle: f64) -> (Interface<2>, Vec<f64>) {
    let spec = line_spec(angle, sliding, law);
    let first = moved(&spec, angle, &LINE.0, 1e-3, 1);
    let second = moved(&spec, angle, &LINE.1, 1e-3, 2);
    let mut interface = Interface::new(spec).unwrap();
    interface.set_time_rule(rule);
    second_step(interface, &first, second)
}

fn plate_case(
    kind: SegmentKind,
    sliding: Sliding,
    law: LawOption,
    rule: TimeRule,
    angle: f64,
) -> (Interface<3>, Vec<f64>) {
    let spec = plate_spec(angle, kind, sliding, law);
    let first = moved(&spec, angle, &PLATE.0, 1e-3, 1);
    let second = moved(&spec, angle, &PLATE.1, 1e-3, 2);
    let mut interface = Interface::new(spec).unwrap();
    interface.set_time_rule(rule);
    second_step(interface, &first, second)
}

#[test]
fn tangent_is_the_derivative_of_the_residual_in_two_dimensions() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for law in laws() {
            for rule in [TimeRule::BackwardEuler, TimeRule::Bdf2] {
                for angle in [0.0, 0.7, 2.5] {
                    let (mut interface, u) = line_case(sliding, law.clone(), rule, angle);
                    assert_taylor(&mut interface, &u, 11);
                }
            }
        }
    }
}

#[test]
fn tangent_is_the_derivative_of_the_residual_in_three_dimensions() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for kind in [SegmentKind::Tri3, SegmentKind::Quad4] {
            for law in laws() {
                for rule in [TimeRule::BackwardEuler, TimeRule::Bdf2] {
                    let (mut interface, u) = plate_case(kind, sliding, law.clone(), rule, 0.9);
                    assert_taylor(&mut interface, &u, 12);
                }
            }
        }
    }
}

#[test]
fn the_cases_contain_open_stick_slip_and_a_crossing_of_segments() {
    let (mut interface, u) = line_case(Sliding::Finite, coulomb(), TimeRule::BackwardEuler, 0.7);
    // Slave, held segment, and the far node of the anchor's segment.
    assert!(interface.pattern().blocks().any(|b| b.len() == 4 * 2));
    residual(&mut interface, &u);
    interface.accept();
    for status in [Status::Open, Status::Stick, Status::Slip] {
        assert!(interface.points().count(status) > 0, "no point has status {status:?}");
    }
    let (mut interface, u) =
        plate_case(SegmentKind::Quad4, Sliding::Finite, coulomb(), TimeRule::BackwardEuler, 0.9);
    residual(&mut interface, &u);
    interface.accept();
    for status in [Status::Open, Status::Stick, Status::Slip] {
        assert!(interface.points().count(status) > 0, "no point has status {status:?}");
    }
}

#[test]
fn tangent_remains_exact_after_a_commit_without_search() {
    let (mut interface, u) = line_case(Sliding::Finite, coulomb(), TimeRule::BackwardEuler, 0.3);
    residual(&mut interface, &u);
    interface.accept();
    let moved: Vec<f64> = u.iter().zip(Noise::new(5).vector(u.len())).map(|(a, b)| a + 1e-2 * b).collect();
    assert_taylor(&mut interface, &moved, 13);
}

/// Laws of the friction crate itself: a capped cone, a rate law and two rate-and-state laws.
fn product_laws() -> Vec<LawOption> {
    let form = || Regularised(Parameters::new(0.4, 0.05, 0.1).unwrap());
    vec![
        Some(Arc::new(Coulomb::new(0.5, Some(45.0)).unwrap())),
        Some(Arc::new(RateLaw::new(form(), Stateless, 0.1, None).unwrap())),
        Some(Arc::new(RateLaw::new(form(), Ageing::new(0.02, 0.5, 0.1).unwrap(), 0.1, None).unwrap())),
        Some(Arc::new(RateLaw::new(form(), Slip::new(0.02, 0.5, 0.1).unwrap(), 0.1, Some(60.0)).unwrap())),
    ]
}

#[test]
fn tangent_is_exact_under_the_laws_of_the_friction_crate() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for law in product_laws() {
            let (mut interface, u) = line_case(sliding, law.clone(), TimeRule::BackwardEuler, 0.7);
            assert_taylor(&mut interface, &u, 21);
            let (mut interface, u) =
                plate_case(SegmentKind::Quad4, sliding, law.clone(), TimeRule::BackwardEuler, 0.9);
            assert_taylor(&mut interface, &u, 22);
        }
    }
}

#[test]
fn without_friction_both_tangents_are_symmetric_and_friction_makes_them_unsymmetric() {
    let rule = TimeRule::BackwardEuler;
    for sliding in [Sliding::Small, Sliding::Finite] {
        let line = |law| asymmetries(line_case(sliding, law, rule, 0.3));
        assert!(line(None).iter().all(|a| *a < 1e-13), "{sliding:?} line: {:?}", line(None));
        assert!(line(coulomb())[0] > 1e-3, "{:?}", line(coulomb()));
        for kind in [SegmentKind::Tri3, SegmentKind::Quad4] {
            let plate = asymmetries(plate_case(kind, sliding, None, rule, 0.3));
            assert!(plate.iter().all(|a| *a < 1e-13), "{sliding:?} {kind:?}: {plate:?}");
        }
    }
}
