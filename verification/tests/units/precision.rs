use asperity_output::figures::Series;
use asperity_verification::report::precision::{CostToReach, cost_to_reach};

#[test]
fn costs_are_interpolated_on_logarithms() {
    let series = Series::marked("m", &[(1e-1, 10.0), (1e-3, 1000.0), (1e-5, 1e5)]);
    let CostToReach::At(cost) = cost_to_reach(&series, 1e-2) else { panic!("it is reached") };
    assert!((cost - 100.0).abs() < 1e-9);
    assert_eq!(cost_to_reach(&series, 0.5), CostToReach::Below(10.0));
    assert_eq!(cost_to_reach(&series, 1e-6), CostToReach::Never);
    assert_eq!(cost_to_reach(&Series::marked("m", &[]), 1e-2), CostToReach::Never);
}
