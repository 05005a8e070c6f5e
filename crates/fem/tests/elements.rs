//! Every element: shape functions, rigid motions, patch test, order on a manufactured solution.
#![allow(clippy::unwrap_used)]

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::{Instant, Linearized, Term};
use nalgebra::DMatrix;

const AT: Instant = Instant { time: 0.0, dt: 1.0 };

fn material() -> Elastic {
    Elastic::new(2.5, 0.3).unwrap()
}

fn unit<const D: usize>(kind: ElementKind, n: usize) -> Mesh<D> {
    Block { min: [0.0; D], max: [1.0; D], divisions: [n; D], grading: [Grading::Uniform; D], kind }
        .mesh()
        .unwrap()
}

/// Moves interior nodes by a smooth map: straight edges stay straight to first order, corner elements are distorted.
/// Nodes of second-order elements follow the same map only through their corners, so that their edges stay straight.
fn distorted<const D: usize>(kind: ElementKind, n: usize) -> Mesh<D> {
    let mut mesh = unit::<D>(kind, n);
    let nodes = mesh.nodes.clone();
    let moved = |x: [f64; D]| -> [f64; D] {
        let bubble: f64 = x.iter().map(|c| 4.0 * c * (1.0 - c)).product();
        std::array::from_fn(|c| x[c] + 0.06 * bubble * (1.0 + c as f64) * (1.0 + 3.0 * x[(c + 1) % D]).sin())
    };
    let corners = match kind {
        ElementKind::Tri3 | ElementKind::Tri6 => 3,
        ElementKind::Hex8 => 8,
        _ => 4,
    };
    let linear = match kind {
        ElementKind::Tri6 => ElementKind::Tri3,
        ElementKind::Quad9 => ElementKind::Quad4,
        other => other,
    };
    for cell in 0..mesh.blocks[0].len() {
        let ids = mesh.blocks[0].cell(cell).to_vec();
        for (a, &id) in ids.iter().enumerate() {
            let s = linear.shape(kind.node_coordinates()[a]);
            mesh.nodes[id] =
                std::array::from_fn(|c| (0..corners).map(|b| s.n[b] * moved(nodes[ids[b]])[c]).sum());
        }
    }
    mesh
}

fn boundary<const D: usize>(mesh: &Mesh<D>) -> Vec<usize> {
    let mut nodes: Vec<usize> = mesh.side_sets.values().flat_map(|s| nodes_of_sides(mesh, s)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Solves with displacements prescribed on the whole boundary and nodal forces `f`.
fn solve<const D: usize>(
    mesh: &Mesh<D>,
    block: &LinearBlock<D>,
    exact: &dyn Fn([f64; D]) -> [f64; D],
    f: &[f64],
) -> Vec<f64> {
    faer::set_global_parallelism(faer::Par::Seq);
    let n = mesh.nodes.len() * D;
    let mut u = vec![0.0; n];
    let mut fixed = Vec::new();
    for node in boundary(mesh) {
        for (c, value) in exact(mesh.nodes[node]).into_iter().enumerate() {
            u[node * D + c] = value;
            fixed.push(node * D + c);
        }
    }
    let equations = Constraints { fixed, channels: Vec::new() }.equations(n);
    let mut r = vec![0.0; n];
    block.clone().residual(&u, AT, &mut r).unwrap();
    let mut matrix = ScatterMap::new(&[block.pattern()], &equations, Part::Lower);
    matrix.add(0, block.stiffness());
    let factor = matrix.cholesky(&matrix.analyse_cholesky().unwrap()).unwrap();
    let mut x = faer::Mat::<f64>::from_fn(equations.free.len(), 1, |k, _| {
        f[equations.free[k]] - r[equations.free[k]]
    });
    factor.solve(x.as_mut());
    for (k, &dof) in equations.free.iter().enumerate() {
        u[dof] = x[(k, 0)];
    }
    u
}

fn patch<const D: usize>(kind: ElementKind) {
    let mesh = distorted::<D>(kind, 3);
    let block = LinearBlock::new(&mesh, 0, &material()).unwrap();
    let gradient = [[0.02, 0.011, -0.007], [-0.004, 0.015, 0.006], [0.003, -0.009, 0.012]];
    let linear = |x: [f64; D]| -> [f64; D] {
        std::array::from_fn(|i| 0.1 + (0..D).map(|j| gradient[i][j] * x[j]).sum::<f64>())
    };
    let u = solve(&mesh, &block, &linear, &vec![0.0; mesh.nodes.len() * D]);
    for (n, x) in mesh.nodes.iter().enumerate() {
        for (c, value) in linear(*x).into_iter().enumerate() {
            assert!((u[n * D + c] - value).abs() < 1e-12 * 0.1, "{} node {n}", kind.name());
        }
    }
    let mut h = [[0.0; 3]; 3];
    for i in 0..D {
        h[i][..D].copy_from_slice(&gradient[i][..D]);
    }
    let exact = material().stress(&h);
    for stress in block.stress_at_points(&u) {
        for (s, e) in stress.iter().zip(exact) {
            assert!((s - e).abs() < 1e-12 * 0.1, "{}: {s} {e}", kind.name());
        }
    }
}

#[test]
fn every_element_passes_the_patch_test() {
    for kind in [ElementKind::Tri3, ElementKind::Tri6, ElementKind::Quad4, ElementKind::Quad9] {
        patch::<2>(kind);
    }
    for kind in [ElementKind::Tet4, ElementKind::Hex8] {
        patch::<3>(kind);
    }
}

fn spectrum<const D: usize>(kind: ElementKind) {
    let mut mesh = distorted::<D>(kind, 2);
    let nodes = kind.nodes();
    mesh.blocks[0].connectivity.truncate(nodes);
    let block = LinearBlock::new(&mesh, 0, &material()).unwrap();
    let k = DMatrix::from_row_slice(nodes * D, nodes * D, block.stiffness());
    assert!((&k - k.transpose()).amax() < 1e-14 * k.amax(), "{} is not symmetric", kind.name());
    let eigen = k.symmetric_eigenvalues();
    let largest = eigen.max();
    let zero = eigen.iter().filter(|e| e.abs() < 1e-10 * largest).count();
    assert_eq!(zero, D * (D + 1) / 2, "{}: {eigen}", kind.name());
    assert!(eigen.min() > -1e-12 * largest);
}

#[test]
fn only_rigid_motions_have_no_energy() {
    for kind in ElementKind::ALL {
        if kind.dimension() == 2 { spectrum::<2>(kind) } else { spectrum::<3>(kind) }
    }
}

#[test]
fn shape_functions_are_a_partition_of_unity_and_interpolate() {
    for kind in ElementKind::ALL {
        for (a, &xi) in kind.node_coordinates().iter().enumerate() {
            let s = kind.shape(xi);
            for (b, n) in s.n[..kind.nodes()].iter().enumerate() {
                assert!((n - if a == b { 1.0 } else { 0.0 }).abs() < 1e-15);
            }
        }
        let s = kind.shape([0.21, 0.34, 0.17]);
        assert!((s.n.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        for m in 0..kind.dimension() {
            assert!(s.dn.iter().map(|d| d[m]).sum::<f64>().abs() < 1e-15);
        }
    }
}

#[test]
fn derivatives_of_shape_functions_are_consistent() {
    let xi = [0.21, 0.34, 0.17];
    for kind in ElementKind::ALL {
        let s = kind.shape(xi);
        for m in 0..kind.dimension() {
            for a in 0..kind.nodes() {
                // Central differences are exact to second order for functions of third degree at most in one variable.
                let at = |h: f64| {
                    let mut x = xi;
                    x[m] += h;
                    kind.shape(x).n[a]
                };
                let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
                assert!((difference - s.dn[a][m]).abs() < 1e-10, "{} {a} {m}", kind.name());
            }
        }
    }
}

/// u = (sin(x + 2y), cos(2x - y)) and its three-dimensional like, with the body force that holds it.
fn manufactured<const D: usize>(x: [f64; D]) -> ([f64; D], [f64; D]) {
    let waves: [([f64; 3], f64); 3] =
        [([1.0, 2.0, 0.5], 0.0), ([2.0, -1.0, 1.0], 1.3), ([0.5, 1.0, -2.0], 0.4)];
    let (g, lambda) = (material().shear(), material().lame());
    let phase = |i: usize| (0..D).map(|j| waves[i].0[j] * x[j]).sum::<f64>() + waves[i].1;
    let u = std::array::from_fn(|i| phase(i).sin());
    // div sigma = (lambda + G) grad div u + G lap u; second derivatives of sin(k.x) are -k_i k_j sin(k.x).
    let f = std::array::from_fn(|i| {
        let mut divergence = 0.0;
        for (j, (wave, _)) in waves.iter().enumerate().take(D) {
            divergence -= wave[i] * wave[j] * phase(j).sin();
        }
        let laplacian: f64 = -(0..D).map(|j| waves[i].0[j].powi(2)).sum::<f64>() * phase(i).sin();
        -((lambda + g) * divergence + g * laplacian)
    });
    (u, f)
}

/// Receives the nodes of a cell, shape functions, position and volume at a quadrature point.
type Visitor<'a, const D: usize> = dyn FnMut(&[usize], &asperity_fem::element::Shape, [f64; D], f64) + 'a;

/// Nodal displacement error in the root mean square of a fine quadrature.
fn l2_error<const D: usize>(kind: ElementKind, n: usize) -> f64 {
    let mesh = distorted::<D>(kind, n);
    let block = LinearBlock::new(&mesh, 0, &material()).unwrap();
    let rule = if kind.dimension() == 2 && matches!(kind, ElementKind::Tri3 | ElementKind::Tri6) {
        // Degree-5 rule by collapsing the square: enough for the load of second-order triangles.
        asperity_fem::quadrature::gauss(3, 2)
            .into_iter()
            .map(|(p, w)| {
                let (s, t) = (0.5 * (1.0 + p[0]), 0.5 * (1.0 + p[1]));
                ([s, t * (1.0 - s), 0.0], 0.25 * w * (1.0 - s))
            })
            .collect()
    } else if kind == ElementKind::Tet4 {
        let (a, b) = (0.585_410_196_624_968_5, 0.138_196_601_125_010_5);
        [[b, b, b], [a, b, b], [b, a, b], [b, b, a]].map(|p| (p, 1.0 / 24.0)).to_vec()
    } else {
        asperity_fem::quadrature::gauss(3, D)
    };
    let visit = |g: &mut Visitor<'_, D>| {
        for cell in 0..mesh.blocks[0].len() {
            let ids = mesh.blocks[0].cell(cell);
            for (xi, w) in &rule {
                let s = kind.shape(*xi);
                let x: [f64; D] =
                    std::array::from_fn(|c| ids.iter().zip(&s.n).map(|(&i, n)| n * mesh.nodes[i][c]).sum());
                let j = DMatrix::from_fn(D, D, |i, m| {
                    ids.iter().zip(&s.dn).map(|(&id, d)| d[m] * mesh.nodes[id][i]).sum::<f64>()
                });
                g(ids, &s, x, w * j.determinant());
            }
        }
    };
    let mut f = vec![0.0; mesh.nodes.len() * D];
    visit(&mut |ids, s, x, volume| {
        let force = manufactured(x).1;
        for (&id, n) in ids.iter().zip(&s.n) {
            for c in 0..D {
                f[id * D + c] += volume * n * force[c];
            }
        }
    });
    let u = solve(&mesh, &block, &|x| manufactured(x).0, &f);
    let mut sum = 0.0;
    visit(&mut |ids, s, x, volume| {
        for (c, exact) in manufactured(x).0.into_iter().enumerate() {
            let found: f64 = ids.iter().zip(&s.n).map(|(&id, n)| n * u[id * D + c]).sum();
            sum += volume * (found - exact).powi(2);
        }
    });
    sum.sqrt()
}

fn order<const D: usize>(kind: ElementKind, levels: [usize; 2], expected: f64) {
    let errors = levels.map(|n| l2_error::<D>(kind, n));
    let order = (errors[0] / errors[1]).ln() / (levels[1] as f64 / levels[0] as f64).ln();
    assert!((order - expected).abs() < 0.1, "{}: order {order}, errors {errors:?}", kind.name());
    assert!(errors[1] < 0.02, "{}: {errors:?}", kind.name());
}

#[test]
fn displacements_converge_with_the_order_of_the_element_on_distorted_meshes() {
    order::<2>(ElementKind::Tri3, [16, 32], 2.0);
    order::<2>(ElementKind::Quad4, [16, 32], 2.0);
    order::<2>(ElementKind::Tri6, [8, 16], 3.0);
    order::<2>(ElementKind::Quad9, [8, 16], 3.0);
    order::<3>(ElementKind::Tet4, [8, 16], 2.0);
    order::<3>(ElementKind::Hex8, [6, 12], 2.0);
}

#[test]
fn stiffness_does_not_depend_on_the_number_of_threads() {
    let mesh = distorted::<2>(ElementKind::Quad4, 40);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| LinearBlock::new(&mesh, 0, &material()).unwrap().stiffness().to_vec())
    };
    let (one, two) = (with(1), with(2));
    assert!(one.iter().zip(&two).all(|(a, b)| a.to_bits() == b.to_bits()));
}

#[test]
fn an_inverted_cell_is_named() {
    let mut mesh = unit::<2>(ElementKind::Quad4, 2);
    mesh.blocks[0].connectivity[4..8].reverse();
    let error = LinearBlock::new(&mesh, 0, &material()).unwrap_err();
    assert!(error.to_string().contains("cell 1 of block 0"), "{error}");
}

#[test]
fn loads_sum_to_their_resultants() {
    let mesh = unit::<3>(ElementKind::Hex8, 3);
    let block = LinearBlock::new(&mesh, 0, &material()).unwrap();
    let sum =
        |f: &[(usize, f64)], c: usize| f.iter().filter(|(d, _)| d % 3 == c).map(|(_, f)| f).sum::<f64>();
    let sides = &mesh.side_sets["top"];
    let pressure = block.pressure(&mesh, sides, 2.0).unwrap();
    assert!((sum(&pressure, 1) + 2.0).abs() < 1e-14 && sum(&pressure, 0).abs() < 1e-14);
    let traction = block.traction(&mesh, sides, [0.5, 0.0, -1.0]).unwrap();
    assert!((sum(&traction, 0) - 0.5).abs() < 1e-14 && (sum(&traction, 2) + 1.0).abs() < 1e-14);
    assert!((sum(&block.body_force([0.0, -3.0, 0.0]), 1) + 3.0).abs() < 1e-13);
    let areas = block.tributary_areas(&mesh, sides).unwrap();
    assert!((areas.values().sum::<f64>() - 1.0).abs() < 1e-14 && areas.values().all(|a| *a > 0.0));
    let quad9 = unit::<2>(ElementKind::Quad9, 1);
    let block = LinearBlock::new(&quad9, 0, &material()).unwrap();
    let mut areas: Vec<f64> =
        block.tributary_areas(&quad9, &quad9.side_sets["left"]).unwrap().into_values().collect();
    areas.sort_by(f64::total_cmp);
    for (area, exact) in areas.iter().zip([1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0]) {
        assert!((area - exact).abs() < 1e-15);
    }
}

#[test]
fn grading_reaches_its_ratio_and_its_ends() {
    let mesh = Block {
        min: [0.0, 0.0],
        max: [1.0, 3.0],
        divisions: [1, 6],
        grading: [Grading::Uniform, Grading::Geometric { ratio: 4.0 }],
        kind: ElementKind::Quad4,
    }
    .mesh()
    .unwrap();
    let y: Vec<f64> = mesh.nodes.iter().filter(|x| x[0] == 0.0).map(|x| x[1]).collect();
    assert_eq!((y[0], y[6]), (0.0, 3.0));
    assert!(((y[6] - y[5]) / (y[1] - y[0]) - 4.0).abs() < 1e-12);
}
