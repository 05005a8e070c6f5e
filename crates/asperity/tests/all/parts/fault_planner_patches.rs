use asperity_plan::faults::planner::patches::smooth_step;

#[test]
fn the_smooth_step_falls_from_one_to_zero_and_is_one_half_between() {
    let at = |x: f64| smooth_step(x, 3e3);
    assert_eq!([at(1.0), at(2999.0)], [1.0, 0.0]);
    assert!((at(1500.0) - 0.5).abs() < 1e-15);
    // (1 + tanh(w/(x - w) + w/x))/2 at x = w/3: (1 + tanh(-3/2 + 3))/2.
    assert!((at(1e3) - 0.5 * (1.0 + 1.5_f64.tanh())).abs() < 1e-15);
}
