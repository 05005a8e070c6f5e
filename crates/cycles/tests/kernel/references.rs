//! Values of other programs, whose names, versions and commands are in the files of `data`.

use super::common::{difference, listed, rock, rows, vector};
use asperity_cycles::kernel::{Placement, Rectangle, Segment, Space, Triangle};

/// Other programs and these kernels lose two to four digits to cancellation in the configurations of the files.
const BOUND: f64 = 1e-10;

/// Checks displacement and strain separately, each relative to its largest component.
fn check(name: &str, row: usize, found: &[f64], wanted: &[f64], split: usize) {
    let u = difference(&found[..split], &wanted[..split]);
    let strain = difference(&found[split..], &wanted[split..]);
    assert!(u < BOUND && strain < BOUND, "{name}, row {row}: {u:e}, {strain:e}\n{found:?}\n{wanted:?}");
}

fn rectangles(name: &str, space: Space, text: &str) {
    for (i, row) in rows(text).iter().enumerate() {
        let centre = [row[0], row[1], row[2]];
        let place = Placement { centre, strike: row[3], dip: row[4], length: row[5], width: row[6] };
        let patch = Rectangle::new(space, &place).unwrap();
        let field = patch.field(&vector(&row[11..]), &vector(&row[7..]), row[10]);
        check(name, i, &listed(&field), &row[14..], 3);
    }
}

fn triangles(name: &str, space: Space, text: &str) {
    for (i, row) in rows(text).iter().enumerate() {
        let vertices = [0, 3, 6].map(|k| [row[k], row[k + 1], row[k + 2]]);
        let patch = Triangle::new(space, vertices).unwrap();
        let field = patch.field(&vector(&row[13..]), &vector(&row[9..]), row[12]);
        check(name, i, &listed(&field), &row[16..], 3);
    }
}

#[test]
fn rectangles_in_a_half_space_agree_with_dislocs() {
    rectangles("rectangle, half-space", Space::Half, include_str!("../data/rectangle_half.csv"));
}

#[test]
fn rectangles_in_a_whole_space_agree_with_triangles_of_cutde() {
    rectangles("rectangle, whole-space", Space::Whole, include_str!("../data/rectangle_whole.csv"));
}

#[test]
fn triangles_in_a_half_space_agree_with_cutde() {
    triangles("triangle, half-space", Space::Half, include_str!("../data/triangle_half.csv"));
}

#[test]
fn triangles_in_a_whole_space_agree_with_cutde() {
    triangles("triangle, whole-space", Space::Whole, include_str!("../data/triangle_whole.csv"));
}

#[test]
fn segments_agree_with_rectangles_of_great_length_of_dislocs() {
    for (i, row) in rows(include_str!("../data/segment_half.csv")).iter().enumerate() {
        let patch = Segment::new(Space::Half, [[row[0], row[1]], [row[2], row[3]]]).unwrap();
        let (at, [up, screw, opening]) = ([row[8], row[9]], [row[4], row[5], row[6]]);
        // The normal of the segment points down: its plus side is the lower one.
        let edge = patch.edge(at, [-up, opening], &rock(row[7]));
        let found = [&edge.displacement[..], &edge.stress].concat();
        check("edge", i, &found, &row[10..15], 2);
        let out = patch.screw(at, -screw);
        let found = [&[out.displacement][..], &out.stress(1.0)].concat();
        check("screw", i, &found, &row[15..], 1);
    }
}
