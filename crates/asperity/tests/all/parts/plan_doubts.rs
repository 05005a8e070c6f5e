//! Doubts about planned values, and the bound of slip rates.

use asperity_plan::doubts::{Fluid, damping, fluid, nucleation};
use asperity_plan::shared::rate_bound::{ANY_ROCK, bound};

#[test]
fn fluid_past_both_ends_is_doubtful() {
    let of = |duration| Fluid { at: 1e3, ends: [0.0, 2e3], diffusivity: 0.1, duration };
    assert!(fluid("main", 0..1, of(3e9)).is_some());
    assert!(fluid("main", 0..1, of(9e6)).is_none());
}

#[test]
fn damping_without_its_unit_is_doubtful_and_a_factor_of_a_few_is_not() {
    let doubt = |given: f64| damping("fault `main`", 0..1, given, [Some(4.6e6), None]).is_some();
    assert!(doubt(5.0) && doubt(5e12));
    assert!(!doubt(2e6) && !doubt(1e7) && !doubt(0.0));
    assert!(damping("x", 0..1, 5.0, [None]).is_none());
}

#[test]
fn a_length_of_nucleation_beyond_the_surface_is_doubtful() {
    assert!(nucleation("fault `main`", 0..1, [300.0, 1.0], false).is_some());
    assert!(nucleation("fault `main`", 0..1, [30.0, 1.0], false).is_none());
    // Rock drives a fault softly: where events are asked for, twice its size is too long.
    assert!(nucleation("fault `main`", 0..1, [3.0, 1.0], true).is_some());
    assert!(nucleation("fault `main`", 0..1, [1.5, 1.0], true).is_none());
}

#[test]
fn the_slowest_material_bounds_slip_and_any_rock_what_is_unknown() {
    assert_eq!(bound([Some(3464.0), Some(2000.0)]), 2000.0);
    assert_eq!(bound([Some(6000.0), None]), ANY_ROCK);
    assert_eq!(bound([]), ANY_ROCK);
}
