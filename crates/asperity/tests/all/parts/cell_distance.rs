//! Distances of cells of faults.

use asperity_plan::faults::planner::spacing::distance::{Position, nearest};

fn at(x: f64, y: f64, z: f64) -> Position {
    Position::new(x, y, z)
}

fn distance(a: &[Position], b: &[Position]) -> f64 {
    let [p, q] = nearest(a, b);
    (p - q).norm()
}

#[test]
fn distances_are_those_of_crossing_parallel_and_skew_segments() {
    let one = [at(0.0, 0.0, 0.0), at(2.0, 0.0, 0.0)];
    assert_eq!(distance(&one, &[at(1.0, -1.0, 0.0), at(1.0, 1.0, 0.0)]), 0.0);
    assert_eq!(distance(&one, &[at(5.0, 1.0, 0.0), at(1.0, 1.0, 0.0)]), 1.0);
    assert_eq!(distance(&one, &[at(1.0, -1.0, 3.0), at(1.0, 1.0, 3.0)]), 3.0);
    assert_eq!(distance(&one, &[at(5.0, 4.0, 0.0), at(9.0, 4.0, 0.0)]), 5.0);
    // One inside the other.
    assert_eq!(distance(&one, &[at(0.5, 0.0, 0.0), at(1.5, 0.0, 0.0)]), 0.0);
}

#[test]
fn distances_are_those_of_triangles_and_rectangles() {
    let triangle = [at(0.0, 0.0, 0.0), at(3.0, 0.0, 0.0), at(0.0, 3.0, 0.0)];
    let above = [at(0.5, 0.5, 2.0), at(5.0, 0.5, 4.0), at(0.5, 5.0, 4.0)];
    assert!((distance(&triangle, &above) - 2.0).abs() < 1e-12);
    let through = [at(1.0, 1.0, -1.0), at(1.0, 1.0, 5.0), at(0.9, 1.0, 5.0)];
    assert!(distance(&triangle, &through) < 1e-12);
    let square = [at(4.0, 0.0, 0.0), at(5.0, 0.0, 0.0), at(5.0, 1.0, 0.0), at(4.0, 1.0, 0.0)];
    assert!((distance(&triangle, &square) - 1.0).abs() < 1e-12);
    // The plane of one passes beside the other.
    let beside = [at(4.0, 4.0, -1.0), at(4.0, 4.0, 1.0), at(4.0, 9.0, 0.0)];
    assert!((distance(&triangle, &beside) - (5.0 / 2.0_f64.sqrt())).abs() < 1e-12);
}
