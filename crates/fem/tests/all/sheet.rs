//! Surfaces given by depths, divided into triangles.

use approx::assert_relative_eq;
use asperity_fem::mesh::sheet::{Depths, Sheet, SheetError, rows, triangles};

/// Radius of a cylinder whose axis is horizontal, above the ground, and points north \[m\].
const RADIUS: f64 = 300e3;
const CREST: f64 = 5e3;

/// Depth of the cylinder, from its crest eastwards \[m\].
fn cylinder(east: f64) -> f64 {
    CREST + RADIUS - (RADIUS * RADIUS - east * east).sqrt()
}

/// Samples of a surface on a crooked grid of 300 km by 200 km.
fn samples(spacing: f64, depth: impl Fn(f64, f64) -> f64) -> Vec<[f64; 3]> {
    let [columns, rows] = [300e3, 200e3].map(|length| (length / spacing) as usize);
    let mut all = Vec::new();
    for i in 0..=columns {
        for j in 0..=rows {
            let inside = |k: usize, n: usize| if k == 0 || k == n { 0.0 } else { 0.02 * spacing };
            let east = i as f64 * spacing + inside(i, columns) * ((7 * i + 3 * j) % 5) as f64;
            let north = j as f64 * spacing + inside(j, rows) * ((3 * i + 11 * j) % 7) as f64;
            all.push([east, north, depth(east, north)]);
        }
    }
    all
}

fn area(sheet: &Sheet) -> f64 {
    let one = |corners: &[usize; 3]| {
        let [a, b, c] = corners.map(|n| nalgebra::Vector3::from(sheet.nodes[n]));
        let vector = (b - a).cross(&(c - a));
        assert!(vector.z > 0.0, "a triangle that faces down");
        0.5 * vector.norm()
    };
    sheet.corners.iter().map(one).sum()
}

#[test]
fn triangles_of_a_cylinder_have_its_area_and_lie_on_it() {
    let (top, bottom, mut errors) = (20e3, 50e3, Vec::new());
    // The arc between two depths, times the length of the cylinder.
    let angle = |depth: f64| (1.0 - (depth - CREST) / RADIUS).acos();
    let exact = RADIUS * (angle(bottom) - angle(top)) * 200e3;
    for size in [20e3, 10e3, 5e3] {
        let depths = Depths::new(&samples(size, |east, _| cylinder(east))).unwrap();
        let sheet = triangles(&depths, [top, bottom], size).unwrap();
        let away = sheet.nodes.iter().map(|x| (cylinder(x[0]) + x[2]).abs()).fold(0.0_f64, f64::max);
        errors.push([(area(&sheet) / exact - 1.0).abs(), away]);
        assert!(sheet.least_angle() > 35_f64.to_radians(), "{size}: {}", sheet.least_angle().to_degrees());
    }
    // Chords of length h are h³/(24 R²) shorter than their arcs.
    for (k, [area, away]) in errors.iter().enumerate() {
        let size = 20e3 / 2.0_f64.powi(k as i32);
        let chords = (size / RADIUS).powi(2) / 24.0;
        assert!(*area < 10.0 * chords, "{size}: area off by {area:e}");
        // Linear interpolation errs by h² z''/8, with samples up to 1.24 sizes apart and z'' = 1/(R cos³ dip).
        let steepest = 1.0 - (bottom - CREST) / RADIUS;
        let linear = (1.24 * size).powi(2) / (8.0 * RADIUS * steepest.powi(3));
        assert!(
            *away < linear,
            "{size}: {away} m off the cylinder, {linear} m if depths were interpolated linearly"
        );
    }
}

#[test]
fn depths_of_a_plane_are_exact_and_its_sheet_does_not_depend_on_the_samples() {
    let plane = |east: f64, north: f64| 2e3 + 0.3 * east + 0.02 * north;
    for spacing in [50e3, 12.5e3] {
        let depths = Depths::new(&samples(spacing, plane)).unwrap();
        for [east, north] in [[31e3, 47e3], [150.5e3, 99e3], [280e3, 3e3]] {
            assert_relative_eq!(depths.at([east, north]).unwrap(), plane(east, north), max_relative = 1e-12);
        }
        assert_eq!(depths.at([-1e3, 50e3]), None);
        let sheet = triangles(&depths, [10e3, 60e3], 5e3).unwrap();
        // Between two parallel contours, 200 km apart from south to north.
        let dip = (1.0 + 0.3_f64.powi(2) + 0.02_f64.powi(2)).sqrt();
        assert_relative_eq!(area(&sheet), 50e3 / 0.3 * 200e3 * dip, max_relative = 1e-9);
        assert_eq!(
            sheet.rows.len(),
            sheet.nodes.iter().map(|x| x[2].to_bits()).collect::<std::collections::BTreeSet<_>>().len()
        );
    }
}

#[test]
fn neighbours_share_edges_and_nothing_is_left_between_contours() {
    let bowl = |east: f64, north: f64| 3e3 + 0.2 * east + 2e-7 * east * east + 6e3 * (north / 70e3).sin();
    let depths = Depths::new(&samples(10e3, bowl)).unwrap();
    let sheet = triangles(&depths, [15e3, 55e3], 6e3).unwrap();
    let mut edges = std::collections::BTreeMap::new();
    for corners in &sheet.corners {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            *edges.entry((a.min(b), a.max(b))).or_insert(0) += 1;
        }
    }
    assert!(edges.values().all(|&count| count <= 2));
    // Euler's formula for a disc: nodes - edges + triangles = 1.
    assert_eq!(sheet.nodes.len() + sheet.corners.len(), edges.len() + 1);
}

#[test]
fn surfaces_that_are_not_one_sheet_are_refused() {
    let hill = |east: f64, north: f64| 1e-7 * ((east - 150e3).powi(2) + (north - 100e3).powi(2));
    let of = |depth: &dyn Fn(f64, f64) -> f64| Depths::new(&samples(10e3, depth)).unwrap();
    let refused = |depths: &Depths, range: [f64; 2]| triangles(depths, range, 5e3).unwrap_err();
    assert!(matches!(refused(&of(&hill), [0.5e3, 2e3]), SheetError::Closed { .. }));
    let saddle = |east: f64, _: f64| 30e3 - 1e-6 * (east - 150e3).powi(2);
    assert!(matches!(refused(&of(&saddle), [10e3, 20e3]), SheetError::Parts { .. }));
    let plane = of(&|east, _| 0.1 * east);
    assert!(matches!(refused(&plane, [5e3, 40e3]), SheetError::Outside { depth: 40e3, .. }));
    assert!(matches!(triangles(&plane, [5e3, 25e3], 1.0).unwrap_err(), SheetError::Many { .. }));
    assert!(matches!(Depths::new(&[[0.0, 0.0, 1.0], [1.0, 1.0, 2.0]]).unwrap_err(), SheetError::Few { .. }));
    let twice = [[0.0, 0.0, 1.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0], [0.0, 0.0, 3.0]];
    assert!(matches!(Depths::new(&twice).unwrap_err(), SheetError::Twice { .. }));
}

#[test]
fn a_text_has_comments_segments_and_rows_without_a_surface() {
    let text = "# lon lat depth\n134.5 33.2 12.5\n> -Z20\n134.6,33.3,20\n135\t33.4\tNaN\n\n";
    assert_eq!(rows(text).unwrap(), [[134.5, 33.2, 12.5], [134.6, 33.3, 20.0]]);
    let line = |text: &str| match rows(text).unwrap_err() {
        SheetError::Line { line, .. } => line,
        other => panic!("{other}"),
    };
    assert_eq!(line("1 2 3\n1 2\n"), 2);
    assert_eq!(line("lon lat depth\n"), 1);
    assert_eq!(line("1 2 3 4\n"), 1);
}
