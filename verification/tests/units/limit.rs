use asperity_verification::benchmarks::limit::*;

#[test]
fn a_sequence_of_one_order_is_extrapolated_to_its_limit() {
    let values: Vec<f64> = (0..4).map(|k| 3.0 + 0.1 * 0.25f64.powi(k)).collect();
    let limit = Limit::from_values(&values);
    assert!((limit.value - 3.0).abs() < 1e-12, "{limit:?}");
    assert!((limit.uncertainty - 0.1 * 0.25f64.powi(3)).abs() < 1e-12, "{limit:?}");
}

#[test]
fn a_sequence_that_turns_or_hardly_shrinks_is_not() {
    for (values, uncertainty) in
        [([1.0, 2.0, 1.25], 1.0), ([1.0, 2.0, 2.875], 1.0), ([1.0, 2.0, 1.875], 0.25)]
    {
        let limit = Limit::from_values(&values);
        assert_eq!(limit.value, values[2]);
        assert_eq!(limit.uncertainty, uncertainty);
    }
}

#[test]
fn a_reference_value_has_the_digits_that_its_uncertainty_leaves() {
    let place = Limit { value: 9.325_612_34, uncertainty: 0.001_231 }.place(None, 0.03);
    assert_eq!((place.value, place.uncertainty, place.tolerance), (9.325_61, 0.0013, 0.03));
}

#[test]
fn tolerance_and_uncertainty_keep_their_distance() {
    let coarse = Limit { value: 1.0, uncertainty: 0.02 }.place(None, 0.03);
    assert_eq!((coarse.uncertainty, coarse.tolerance), (0.02, 0.06));
    let fine = Limit { value: -1e-12, uncertainty: 1e-15 }.place(None, 0.02);
    assert_eq!((fine.value, fine.uncertainty), (0.0, 2e-6));
}

#[test]
fn no_place_of_a_curve_is_far_better_known_than_another() {
    let limit = |uncertainty| Limit { value: 1.0, uncertainty };
    let found = places(&[(0.0, limit(0.02)), (1.0, limit(1e-7))], 1.0);
    assert_eq!((found[0].uncertainty, found[1].uncertainty), (0.02, 0.002));
}
