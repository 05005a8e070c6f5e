use asperity_plan::shared::field::samples::Samples;

#[test]
fn values_on_a_line_end_with_it() {
    let positions = [vec![2.0], vec![0.0], vec![1.0]];
    let line = Samples::new(&positions, &[6.0, 2.0, 3.0], false).unwrap();
    let at = |x: f64| line.at(&[x]);
    assert_eq!([at(0.5), at(1.5), at(2.0), at(2.1), at(-0.1)], [Some(2.5), Some(4.5), Some(6.0), None, None]);
    let line = Samples::new(&positions, &[6.0, 2.0, 3.0], true).unwrap();
    let at = |x: f64| line.at(&[x]);
    assert_eq!([at(0.4), at(1.6), at(2.9), at(3.1), at(-2.0)], [Some(2.0), Some(6.0), Some(6.0), None, None]);
}
