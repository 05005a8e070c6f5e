use asperity::kinds::bodies::text::*;

#[test]
fn vectors_are_printed_to_seven_digits_of_the_largest_component() {
    assert_eq!(triple(&[-10.685076051273779, 23.949409855767414, -1e-20]), "(-10.68508, 23.94941, 0.00000)");
    assert_eq!(triple(&[1.5405133884581246e-4, 0.0, 0.0]), "(1.540513, 0.000000, 0.000000)e-4");
    assert_eq!(triple(&[0.0; 3]), "(0.000000, 0.000000, 0.000000)");
    assert_eq!(triple(&[-2.0, 3530199.85, 0.0]), "(-2, 3530200, 0)");
    assert!(triple(&[f64::NAN, 0.0, 0.0]).contains("NaN"));
}

#[test]
fn pressures_are_printed_in_the_unit_that_fits() {
    assert_eq!(pressure(0.25), "0.250000 Pa");
    assert_eq!(pressure(-1e-9), "0.000000 Pa");
    assert_eq!(pressure(240e6), "240.000000 MPa");
    assert_eq!(pressure(-1.5e9), "-1.500000 GPa");
}
