//! Views of faults: which direction points to the right of a page, and which up.

use asperity::kinds::faults::compass::{View, along_strike, from_above, unit};
use nalgebra::Vector3;

fn axes(view: &View<'_>) -> ([[f64; 3]; 2], [String; 2]) {
    match view {
        View::Along(axes, labels) => (axes.map(|a| [a.x, a.y, a.z]), labels.clone()),
        View::Map(_) => panic!("a map"),
    }
}

fn close(found: [[f64; 3]; 2], expected: [[f64; 3]; 2]) {
    let pairs = found.iter().flatten().zip(expected.iter().flatten());
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} is not {expected:?}");
}

#[test]
fn a_dipping_surface_is_seen_from_its_hanging_wall_with_its_dip_to_the_right_of_strike() {
    // East, north and up are x, y and z. The plane dips 70 degrees to the east: its strike is north.
    let (sine, cosine) = 70_f64.to_radians().sin_cos();
    for sign in [1.0, -1.0] {
        let view = along_strike(&(sign * Vector3::new(sine, 0.0, cosine)), &Vector3::z(), None);
        close(axes(&view).0, [[0.0, 1.0, 0.0], [-cosine, 0.0, sine]]);
    }
    for sign in [1.0, -1.0] {
        let view = along_strike(&(sign * Vector3::new(0.8, 0.6, 0.0)), &Vector3::z(), None);
        close(axes(&view).0, [[-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]]);
    }
}

#[test]
fn maps_are_right_handed_seen_from_above() {
    for axis in 0..3 {
        let View::Along([right, page], _) = from_above(&unit(axis)) else { panic!("a map") };
        assert_eq!(right.cross(&page), unit(axis));
    }
    let up = Vector3::new(0.6, 0.8, 0.0);
    let View::Along([right, page], _) = from_above(&up) else { panic!("a map") };
    assert!((right.cross(&page) - up).norm() < 1e-12);
}
