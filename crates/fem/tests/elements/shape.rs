//! Shape functions, faces, quadrature.

use asperity_fem::element::{ElementKind, face};
use asperity_fem::quadrature;
use asperity_fem::quadrature::Point;

/// Points inside every reference element.
const INSIDE: [[f64; 3]; 2] = [[0.21, 0.34, 0.17], [0.5, 0.11, 0.29]];

#[test]
fn a_shape_function_is_one_at_its_node_and_zero_at_the_others() {
    for kind in ElementKind::ALL {
        assert_eq!(kind.node_coordinates().len(), kind.nodes());
        for (a, &xi) in kind.node_coordinates().iter().enumerate() {
            let s = kind.shape(xi);
            for (b, n) in s.n[..kind.nodes()].iter().enumerate() {
                assert!((n - if a == b { 1.0 } else { 0.0 }).abs() < 1e-15, "{} {a} {b}", kind.name());
            }
        }
    }
}

#[test]
fn shape_functions_reproduce_linear_fields_and_are_a_partition_of_unity() {
    for kind in ElementKind::ALL {
        for xi in INSIDE {
            let s = kind.shape(xi);
            assert!((s.n.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{}", kind.name());
            for m in 0..kind.dimension() {
                assert!(s.dn.iter().map(|d| d[m]).sum::<f64>().abs() < 1e-15);
                for c in 0..kind.dimension() {
                    let nodes = || kind.node_coordinates().iter().map(|x| x[c]);
                    let place: f64 = nodes().zip(&s.n).map(|(x, n)| x * n).sum();
                    assert!((place - xi[c]).abs() < 1e-15);
                    let slope: f64 = nodes().zip(&s.dn).map(|(x, d)| x * d[m]).sum();
                    assert!((slope - if c == m { 1.0 } else { 0.0 }).abs() < 2e-15, "{}", kind.name());
                }
            }
        }
    }
}

#[test]
fn second_order_elements_reproduce_quadratic_fields_of_the_natural_coordinates() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.order() == 2) {
        for xi in INSIDE {
            let s = kind.shape(xi);
            for i in 0..kind.dimension() {
                for j in 0..=i {
                    let value: f64 =
                        kind.node_coordinates().iter().zip(&s.n).map(|(x, n)| x[i] * x[j] * n).sum();
                    assert!((value - xi[i] * xi[j]).abs() < 1e-15, "{} {i} {j}", kind.name());
                }
            }
        }
    }
}

/// |f(x + h v) - f(x) - h f'(x)·v| falls with h².
#[test]
fn derivatives_have_a_taylor_remainder_of_second_order() {
    let direction = [0.6, -0.5, 0.7];
    for kind in ElementKind::ALL {
        let dimension = kind.dimension();
        for xi in INSIDE {
            let s = kind.shape(xi);
            let remainder = |h: f64| {
                let moved =
                    std::array::from_fn(|c| xi[c] + if c < dimension { h * direction[c] } else { 0.0 });
                let t = kind.shape(moved);
                (0..kind.nodes())
                    .map(|a| {
                        let slope: f64 = s.dn[a].iter().zip(direction).map(|(d, v)| d * v).sum();
                        (t.n[a] - s.n[a] - h * slope).abs()
                    })
                    .fold(0.0, f64::max)
            };
            let (coarse, fine) = (remainder(1e-2), remainder(1e-3));
            // Linear simplices have no remainder.
            if coarse < 1e-14 {
                assert!(matches!(kind, ElementKind::Tri3 | ElementKind::Tet4), "{}", kind.name());
            } else {
                assert!(((coarse / fine).log10() - 2.0).abs() < 0.05, "{} {coarse} {fine}", kind.name());
            }
        }
    }
}

#[test]
fn second_order_nodes_lie_between_the_corners_vtk_names() {
    let edges: [(ElementKind, &[[usize; 2]]); 7] = [
        (ElementKind::Tri6, &[[0, 1], [1, 2], [2, 0]]),
        (ElementKind::Quad8, &[[0, 1], [1, 2], [2, 3], [3, 0]]),
        (ElementKind::Quad9, &[[0, 1], [1, 2], [2, 3], [3, 0]]),
        (ElementKind::Tet10, &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]]),
        (ElementKind::Wedge15, &[[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]]),
        (ElementKind::Hex20, &HEX_EDGES),
        (ElementKind::Hex27, &HEX_EDGES),
    ];
    for (kind, edges) in edges {
        let x = kind.node_coordinates();
        for (k, &[a, b]) in edges.iter().enumerate() {
            let middle: [f64; 3] = std::array::from_fn(|c| 0.5 * (x[a][c] + x[b][c]));
            assert_eq!(x[kind.corners() + k], middle, "{} edge {k}", kind.name());
        }
        assert_eq!(x[..kind.corners()], *kind.linear().node_coordinates());
    }
}

const HEX_EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

#[test]
fn faces_have_corners_first_and_middles_in_their_order() {
    for kind in ElementKind::ALL {
        let x = kind.node_coordinates();
        for (face, linear) in kind.faces().iter().zip(kind.linear().faces()) {
            let (n, face, linear) = (face.kind.corners(), face.nodes, linear.nodes);
            assert_eq!(face[..n], *linear, "{}", kind.name());
            if kind.order() == 1 {
                assert_eq!(face.len(), n);
                continue;
            }
            for k in 0..if n == 2 { 1 } else { n } {
                let (a, b) = (x[face[k]], x[face[(k + 1) % n]]);
                for c in 0..3 {
                    assert_eq!(x[face[n + k]][c], 0.5 * (a[c] + b[c]), "{} {face:?}", kind.name());
                }
            }
            if face.len() == 9 {
                let centre = std::array::from_fn(|c| face[..4].iter().map(|&a| 0.25 * x[a][c]).sum::<f64>());
                assert_eq!(x[face[8]], centre, "{} {face:?}", kind.name());
            }
        }
    }
}

/// On a face, the functions of its nodes are those of its kind, and all others vanish.
#[test]
fn faces_are_of_the_kind_they_say() {
    for element in ElementKind::ALL {
        let x = element.node_coordinates();
        for face in element.faces() {
            assert_eq!((face.nodes.len(), face.kind.space()), (face.kind.nodes(), element.dimension()));
            for xi in [[0.1, 0.2], [0.3, 0.6], [0.0, 0.5]] {
                let own = face::shape(face.kind, xi).value;
                let at: [f64; 3] = std::array::from_fn(|c| {
                    face.nodes.iter().zip(&own).map(|(&a, n)| n * x[a][c]).sum::<f64>()
                });
                let all = element.shape(at).n;
                for (a, n) in all.iter().enumerate() {
                    let expected = face.nodes.iter().position(|&f| f == a).map_or(0.0, |k| own[k]);
                    assert!((n - expected).abs() < 1e-15, "{} {face:?} {a}", element.name());
                }
            }
        }
    }
}

#[test]
fn every_edge_of_the_surface_is_run_through_once_each_way() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 3) {
        let mut edges = Vec::new();
        for face in kind.faces() {
            let (n, face) = (face.kind.corners(), face.nodes);
            edges.extend((0..n).map(|k| (face[k], face[(k + 1) % n])));
        }
        for &(a, b) in &edges {
            assert_eq!(edges.iter().filter(|&&e| e == (a, b)).count(), 1);
            assert_eq!(edges.iter().filter(|&&e| e == (b, a)).count(), 1);
        }
    }
}

fn factorial(n: i32) -> f64 {
    (1..=n).map(f64::from).product()
}

/// ∫ ξ^i η^j ζ^k over the reference element.
fn moment(kind: ElementKind, [i, j, k]: [i32; 3]) -> f64 {
    let line = |n: i32| if n % 2 == 0 { 2.0 / f64::from(n + 1) } else { 0.0 };
    let triangle = |i: i32, j: i32| factorial(i) * factorial(j) / factorial(i + j + 2);
    match kind.linear() {
        ElementKind::Tri3 => triangle(i, j),
        ElementKind::Quad4 => line(i) * line(j),
        ElementKind::Tet4 => factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3),
        ElementKind::Wedge6 => triangle(i, j) * line(k),
        _ => line(i) * line(j) * line(k),
    }
}

/// True if a monomial lies within a degree: by the sum of exponents on simplices, by each variable on products.
fn within(kind: ElementKind, [i, j, k]: [i32; 3], degree: i32, along: i32) -> bool {
    match kind.linear() {
        ElementKind::Tri3 | ElementKind::Tet4 => i + j + k <= degree,
        ElementKind::Wedge6 => i + j <= degree && k <= along,
        _ => i.max(j).max(k) <= degree,
    }
}

fn exact(kind: ElementKind, rule: &[Point], degree: i32, along: i32) -> bool {
    let most = degree.max(along);
    let last = if kind.dimension() == 3 { most } else { 0 };
    let mut all = true;
    for i in 0..=most {
        for j in 0..=most {
            for k in (0..=last).filter(|&k| within(kind, [i, j, k], degree, along)) {
                let sum: f64 = rule.iter().map(|(x, w)| w * x[0].powi(i) * x[1].powi(j) * x[2].powi(k)).sum();
                all &= (sum - moment(kind, [i, j, k])).abs() < 5e-15;
            }
        }
    }
    all
}

#[test]
fn rules_are_exact_to_their_degree_and_not_beyond() {
    use ElementKind::*;
    // Element, degree of the stiffness rule, of the mass rule (wedges: in the triangle; then along the axis).
    let rules = [
        (Tri3, 1, 2, 0),
        (Tri6, 2, 4, 0),
        (Quad4, 3, 3, 0),
        (Quad8, 5, 5, 0),
        (Quad9, 5, 5, 0),
        (Tet4, 1, 2, 0),
        (Tet10, 2, 5, 0),
        (Hex8, 3, 3, 0),
        (Hex20, 5, 5, 0),
        (Hex27, 5, 5, 0),
        (Wedge6, 2, 2, 3),
        (Wedge15, 4, 4, 5),
    ];
    assert_eq!(rules.map(|r| r.0), ElementKind::ALL);
    for (kind, stiffness, mass, along) in rules {
        for (rule, degree) in [(kind.quadrature(), stiffness), (kind.mass_quadrature(), mass)] {
            assert!(exact(kind, &rule, degree, along), "{} {degree}", kind.name());
            assert!(!exact(kind, &rule, degree + 1, along), "{} {degree}", kind.name());
            assert!(rule.iter().all(|(_, w)| *w > 0.0));
        }
        let products = 2 * i32::try_from(kind.order()).unwrap();
        assert!(mass >= products);
    }
    for n in 1..=5 {
        let degree = 2 * i32::try_from(n).unwrap() - 1;
        let rule = quadrature::gauss(n, 2);
        assert!(exact(Quad4, &rule, degree, 0) && !exact(Quad4, &rule, degree + 1, 0), "{n}");
    }
}

#[test]
fn names_are_read_back() {
    for kind in ElementKind::ALL {
        assert_eq!(kind.name().parse::<ElementKind>().unwrap(), kind);
    }
    let error = "quad5".parse::<ElementKind>().unwrap_err().to_string();
    assert!(ElementKind::ALL.iter().all(|k| error.contains(k.name())), "{error}");
}
