use asperity_verification::order::{Level, OrderTest};
use asperity_verification::report::convergence::slope;

#[test]
fn the_triangle_lies_below_the_errors_it_is_fitted_to() {
    let levels = [(0.8, 0.5), (0.4, 0.16), (0.2, 0.05), (0.1, 0.01)];
    let levels: Vec<Level> = levels.into_iter().map(Level::from).collect();
    let order = OrderTest { levels: levels.clone(), expected: 2.0, tolerance: 0.1, ..OrderTest::default() };
    let slope = slope(&order).unwrap();
    assert!(slope.x.0 > 0.1 && slope.x.1 < 0.4);
    for level in &levels[1..] {
        assert!(slope.y * (level.size / slope.x.0).powi(2) < level.error);
    }
}

#[test]
fn a_study_without_errors_has_no_triangle() {
    assert!(slope(&OrderTest::default()).is_none());
}
