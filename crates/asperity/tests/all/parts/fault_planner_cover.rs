use asperity_plan::faults::planner::cover::*;

#[test]
fn a_place_lies_on_a_face_within_its_corners_and_near_its_plane() {
    let line = Face::new(vec![[0.0, 0.0], [2.0, 0.0]]);
    assert!(line.holds(&[1.0, 0.0], 1e-9) && line.holds(&[1.0, 0.1], 1e-9) && line.holds(&[2.0, 0.0], 1e-9));
    assert!(
        !line.holds(&[1.0, 0.3], 1e-9) && !line.holds(&[2.1, 0.0], 1e-9) && !line.holds(&[-0.1, 0.0], 1e-9)
    );
    let triangle = Face::new(vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    assert!(triangle.holds(&[1.0, 1.0, 0.0], 1e-9) && triangle.holds(&[0.5, 0.5, 0.1], 1e-9));
    assert!(!triangle.holds(&[1.1, 1.0, 0.0], 1e-9) && !triangle.holds(&[0.5, 0.5, 0.5], 1e-9));
}
