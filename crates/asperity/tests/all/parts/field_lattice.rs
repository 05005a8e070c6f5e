use asperity_plan::shared::field::lattice::Lattice;

/// Values 10 i + j at x = 1, 3 and y = 5, 4, 2, none at the last.
fn lattice(nearest: bool) -> Lattice {
    let lists = [vec![1.0, 3.0], vec![5.0, 4.0, 2.0]];
    let values = vec![0.0, 1.0, 2.0, 10.0, 11.0, f64::NAN];
    Lattice::new(&lists, &["x", "y"], values, nearest).unwrap()
}

#[test]
fn values_on_a_grid_end_with_it() {
    let linear = lattice(false);
    assert_eq!(linear.at(&[2.0, 4.5]), Some(5.5));
    assert_eq!(linear.at(&[1.0, 3.0]), Some(1.5), "a missing value without a share does not count");
    assert_eq!([linear.at(&[0.9, 4.0]), linear.at(&[2.0, 5.1])], [None; 2]);
    assert!(linear.at(&[2.0, 3.0]).unwrap().is_nan());
    let nearest = lattice(true);
    assert_eq!([nearest.at(&[1.9, 4.4]), nearest.at(&[4.0, 4.4])], [Some(1.0), Some(11.0)]);
}

#[test]
fn longitudes_may_differ_by_a_turn() {
    let grid = Lattice::new(&[vec![350.0, 352.0]], &["longitude"], vec![1.0, 3.0], false).unwrap();
    assert_eq!(grid.at(&[-9.0]), Some(2.0));
    let grid = Lattice::new(&[vec![350.0, 352.0]], &["x"], vec![1.0, 3.0], false).unwrap();
    assert_eq!(grid.at(&[-9.0]), None);
}

#[test]
fn coordinates_ascend_or_descend() {
    let wrong = Lattice::new(&[vec![1.0, 3.0, 2.0]], &["x"], vec![1.0; 3], false).unwrap_err();
    assert_eq!(wrong.message, "its coordinate `x` has 3 beside 2");
}
