//! Quadrature rules on the reference elements. Weights sum to the measure of the element: 2^d, 1/2, 1/6, and 1 for the wedge.

/// A quadrature point: natural coordinates and weight.
pub type Point = ([f64; 3], f64);

/// Product Gauss rule with `n` (1 to 5) points per axis on [-1, 1]^dimension: degree 2n - 1 in each variable.
///
/// # Panics
/// For other `n`.
#[must_use]
pub fn gauss(n: usize, dimension: usize) -> Vec<Point> {
    let line = gauss_line(n);
    let flat = vec![(0.0, 1.0)];
    let ys = if dimension > 1 { &line } else { &flat };
    let zs = if dimension > 2 { &line } else { &flat };
    let mut points = Vec::new();
    for &(z, wz) in zs {
        for &(y, wy) in ys {
            for &(x, wx) in &line {
                points.push(([x, y, z], wx * wy * wz));
            }
        }
    }
    points
}

/// Gauss points on [-1, 1], ascending: exact for degree 2n - 1.
fn gauss_line(n: usize) -> Vec<(f64, f64)> {
    match n {
        1 => vec![(0.0, 2.0)],
        2 => {
            let x = (1.0_f64 / 3.0).sqrt();
            vec![(-x, 1.0), (x, 1.0)]
        }
        3 => {
            let x = 0.6_f64.sqrt();
            vec![(-x, 5.0 / 9.0), (0.0, 8.0 / 9.0), (x, 5.0 / 9.0)]
        }
        4 => {
            let root = 2.0 / 7.0 * 1.2_f64.sqrt();
            let (x, y) = ((3.0 / 7.0 - root).sqrt(), (3.0 / 7.0 + root).sqrt());
            let (wx, wy) = ((18.0 + 30.0_f64.sqrt()) / 36.0, (18.0 - 30.0_f64.sqrt()) / 36.0);
            vec![(-y, wy), (-x, wx), (x, wx), (y, wy)]
        }
        5 => {
            let root = 2.0 * (10.0_f64 / 7.0).sqrt();
            let (x, y) = ((5.0 - root).sqrt() / 3.0, (5.0 + root).sqrt() / 3.0);
            let w = 13.0 * 70.0_f64.sqrt();
            let (wx, wy) = ((322.0 + w) / 900.0, (322.0 - w) / 900.0);
            vec![(-y, wy), (-x, wx), (0.0, 128.0 / 225.0), (x, wx), (y, wy)]
        }
        _ => panic!("Gauss rules have 1 to 5 points an axis, not {n}"),
    }
}

/// Centroid rule: degree 1.
#[must_use]
pub fn triangle_1() -> Vec<Point> {
    vec![([1.0 / 3.0, 1.0 / 3.0, 0.0], 0.5)]
}

/// The three points of a triangle with area coordinates (1 - 2a, a, a).
fn triangle_orbit(a: f64, weight: f64) -> [Point; 3] {
    let b = 1.0 - 2.0 * a;
    [([a, a, 0.0], weight), ([b, a, 0.0], weight), ([a, b, 0.0], weight)]
}

/// Three interior points: degree 2.
#[must_use]
pub fn triangle_3() -> Vec<Point> {
    triangle_orbit(1.0 / 6.0, 1.0 / 6.0).to_vec()
}

/// Six interior points, positive weights: degree 4 (Strang and Fix 1973, in closed form).
#[must_use]
pub fn triangle_6() -> Vec<Point> {
    let root = 10.0_f64.sqrt();
    let spread = (38.0 - 44.0 * 0.4_f64.sqrt()).sqrt();
    let weight = (213_125.0 - 53_320.0 * root).sqrt();
    let outer = triangle_orbit((8.0 - root + spread) / 18.0, (620.0 + weight) / 7440.0);
    let inner = triangle_orbit((8.0 - root - spread) / 18.0, (620.0 - weight) / 7440.0);
    [outer, inner].concat()
}

/// Centroid rule: degree 1.
#[must_use]
pub fn tetrahedron_1() -> Vec<Point> {
    vec![([0.25, 0.25, 0.25], 1.0 / 6.0)]
}

/// The four points of a tetrahedron with volume coordinates (1 - 3a, a, a, a).
fn tetrahedron_orbit(a: f64, weight: f64) -> [Point; 4] {
    let b = 1.0 - 3.0 * a;
    [([a, a, a], weight), ([b, a, a], weight), ([a, b, a], weight), ([a, a, b], weight)]
}

/// Four interior points: degree 2.
#[must_use]
pub fn tetrahedron_4() -> Vec<Point> {
    tetrahedron_orbit((5.0 - 5.0_f64.sqrt()) / 20.0, 1.0 / 24.0).to_vec()
}

/// Fourteen interior points, positive weights: degree 5 (Walkington 2000). The constants are the root of the moment equations.
#[must_use]
pub fn tetrahedron_14() -> Vec<Point> {
    let mut points = tetrahedron_orbit(0.310_885_919_263_300_6, 0.018_781_320_953_002_64).to_vec();
    points.extend(tetrahedron_orbit(0.092_735_250_310_891_23, 0.012_248_840_519_393_66));
    let (a, w) = (0.045_503_704_125_649_65, 0.007_091_003_462_846_911);
    let b = 0.5 - a;
    for p in [[a, a, b], [a, b, a], [b, a, a], [a, b, b], [b, a, b], [b, b, a]] {
        points.push((p, w));
    }
    points
}

/// Maps [-1, 1] to [0, 1].
fn half(x: f64) -> f64 {
    0.5 * (1.0 + x)
}

/// The square's product rule collapsed onto the triangle, (s, t) to (s, t (1 - s)): degree 2n - 2 in x and y together.
#[must_use]
pub fn collapsed_triangle(n: usize) -> Vec<Point> {
    gauss(n, 2)
        .into_iter()
        .map(|(p, w)| {
            let (s, t) = (half(p[0]), half(p[1]));
            ([s, t * (1.0 - s), 0.0], 0.25 * w * (1.0 - s))
        })
        .collect()
}

/// The cube's product rule collapsed onto the tetrahedron: degree 2n - 3 in x, y and z together.
#[must_use]
pub fn collapsed_tetrahedron(n: usize) -> Vec<Point> {
    gauss(n, 3)
        .into_iter()
        .map(|(p, w)| {
            let (r, s, t) = (half(p[0]), half(p[1]), half(p[2]));
            let (y, left) = (s * (1.0 - r), (1.0 - r) * (1.0 - s));
            ([r, y, t * left], 0.125 * w * (1.0 - r) * left)
        })
        .collect()
}

/// A rule of the triangle times `n` Gauss points along the wedge.
#[must_use]
pub fn wedge(triangle: Vec<Point>, n: usize) -> Vec<Point> {
    let line = gauss_line(n);
    line.iter().flat_map(|&(z, wz)| triangle.iter().map(move |&([x, y, _], w)| ([x, y, z], w * wz))).collect()
}
