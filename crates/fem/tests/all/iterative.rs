//! Conjugate gradients with smoothed aggregation and block-Jacobi compared with the direct solver, and their guarantees.

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::{Constraints, Equations};
use asperity_fem::element::ElementKind;
use asperity_fem::iterative::smoothed_aggregation::Settings;
use asperity_fem::iterative::{Antiplane, Method, Plane, Solver, Spatial, near_null};
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::outcome::Outcome;
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::{Linearized, Pattern};
use faer::MatMut;

const AMG: Method = Method::SmoothedAggregation(Settings { threshold: 0.08, degree: 2, range: 12.0 });

struct Body<const D: usize> {
    mesh: Mesh<D>,
    pattern: Pattern,
    values: Vec<f64>,
    equations: Equations,
}

/// A block of elements whose left face is clamped and whose bottom is held in its normal direction only.
fn body<const D: usize>(kind: ElementKind, divisions: [usize; D], grading: Grading, poisson: f64) -> Body<D> {
    let mesh = Block { min: [0.0; D], max: [1.0; D], divisions, grading: [grading; D], kind }.mesh().unwrap();
    let material = Elastic::new(2.5e9, poisson).unwrap();
    let space = Idealisation::from_dimension(D);
    let block = LinearBlock::new(&mesh, 0, &material, space, Formulation::Standard).unwrap();
    let side = |name: &str| nodes_of_sides(&mesh, &mesh.side_sets[name]);
    let mut fixed: Vec<usize> = side("left").into_iter().flat_map(|n| n * D..(n + 1) * D).collect();
    fixed.extend(side("bottom").into_iter().map(|n| n * D + 1));
    fixed.sort_unstable();
    fixed.dedup();
    let equations = Constraints { fixed, channels: Vec::new() }.equations(mesh.nodes.len() * D);
    Body { pattern: block.pattern().clone(), values: block.stiffness().to_vec(), mesh, equations }
}

fn spatial(body: &Body<3>, method: Method) -> Spatial {
    let modes = near_null::spatial(&body.mesh.nodes);
    Solver::new(&[&body.pattern], &[&body.values], &body.equations, modes, method).unwrap()
}

fn plane(body: &Body<2>, method: Method) -> Plane {
    let modes = near_null::plane(&body.mesh.nodes);
    Solver::new(&[&body.pattern], &[&body.values], &body.equations, modes, method).unwrap()
}

fn hexes(n: usize) -> Body<3> {
    body(ElementKind::Hex8, [n, n + 1, n - 1], Grading::Geometric { ratio: 3.0 }, 0.3)
}

fn quads() -> Body<2> {
    body(ElementKind::Quad4, [40, 30], Grading::Geometric { ratio: 3.0 }, 0.3)
}

/// Pseudo-random numbers.
fn load(n: usize, seed: usize) -> Vec<f64> {
    (0..n).map(|k| ((k * 7919 + seed * 104_729) % 1009) as f64 / 504.0 - 1.0).collect()
}

fn direct<const D: usize>(body: &Body<D>, b: &[f64]) -> Vec<f64> {
    let mut matrix = ScatterMap::new(&[&body.pattern], &body.equations, Part::Lower);
    matrix.add(0, &body.values);
    let mut x = b.to_vec();
    let n = x.len();
    matrix
        .cholesky(&matrix.analyse_cholesky().unwrap())
        .unwrap()
        .solve(MatMut::from_column_major_slice_mut(&mut x, n, 1));
    x
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn distance(x: &[f64], y: &[f64]) -> f64 {
    let difference: Vec<f64> = x.iter().zip(y).map(|(x, y)| x - y).collect();
    (dot(&difference, &difference) / dot(y, y)).sqrt()
}

#[test]
fn both_methods_give_the_answer_of_the_direct_solver() {
    let (solid, sheet) = (hexes(9), quads());
    let (b3, b2) = (load(solid.equations.free.len(), 1), load(sheet.equations.free.len(), 2));
    let (exact3, exact2) = (direct(&solid, &b3), direct(&sheet, &b2));
    for method in [AMG, Method::BlockJacobi] {
        let (mut x3, mut x2) = (vec![0.0; b3.len()], vec![0.0; b2.len()]);
        let outcome = spatial(&solid, method).solve(&mut x3, &b3, 1e-12);
        assert!(outcome.converged(), "{outcome}");
        assert!(distance(&x3, &exact3) < 1e-10, "{}", distance(&x3, &exact3));
        let outcome = plane(&sheet, method).solve(&mut x2, &b2, 1e-12);
        assert!(outcome.converged(), "{outcome}");
        assert!(distance(&x2, &exact2) < 1e-10, "{}", distance(&x2, &exact2));
    }
}

#[test]
fn second_order_elements_and_tetrahedra_converge_to_the_direct_answer() {
    for kind in [ElementKind::Quad9, ElementKind::Tri6] {
        let body = body::<2>(kind, [16, 16], Grading::Uniform, 0.3);
        let b = load(body.equations.free.len(), 3);
        let mut x = vec![0.0; b.len()];
        let outcome = plane(&body, AMG).solve(&mut x, &b, 1e-12);
        assert!(
            outcome.converged() && distance(&x, &direct(&body, &b)) < 1e-10,
            "{}: {outcome}",
            kind.name()
        );
    }
    let body = body::<3>(ElementKind::Tet4, [8; 3], Grading::Uniform, 0.3);
    let b = load(body.equations.free.len(), 3);
    let mut x = vec![0.0; b.len()];
    let outcome = spatial(&body, AMG).solve(&mut x, &b, 1e-12);
    assert!(outcome.converged() && distance(&x, &direct(&body, &b)) < 1e-10, "{outcome}");
}

#[test]
fn one_unknown_at_a_node_is_solved_too() {
    let (n, h) = (50, 1.0 / 50.0);
    let cells: Vec<[usize; 2]> = (0..n).map(|k| [k, k + 1]).collect();
    let pattern = Pattern::from_blocks(cells.iter().map(|c| c.as_slice()));
    let values: Vec<f64> = cells.iter().flat_map(|_| [1.0 / h, -1.0 / h, -1.0 / h, 1.0 / h]).collect();
    let equations = Constraints { fixed: vec![0], channels: Vec::new() }.equations(n + 1);
    let solver =
        Antiplane::new(&[&pattern], &[&values], &equations, near_null::constant(n + 1), AMG).unwrap();
    let mut b = vec![0.0; n];
    b[n - 1] = 3.0;
    let mut x = vec![0.0; n];
    assert!(solver.solve(&mut x, &b, 1e-13).converged());
    for (k, x) in x.iter().enumerate() {
        assert!((x - 3.0 * (k + 1) as f64 * h).abs() < 1e-11);
    }
}

#[test]
fn preconditioner_is_symmetric_and_positive_definite() {
    let body = hexes(8);
    let n = body.equations.free.len();
    for method in [AMG, Method::BlockJacobi] {
        let solver = spatial(&body, method);
        for seed in 0..4 {
            let (x, y) = (load(n, seed), load(n, seed + 10));
            let (mx, my) = (solver.precondition(&x), solver.precondition(&y));
            let size = (dot(&x, &mx) * dot(&y, &my)).sqrt();
            assert!(dot(&x, &mx) > 0.0);
            assert!((dot(&x, &my) - dot(&y, &mx)).abs() < 1e-13 * size);
        }
    }
}

#[test]
fn assembled_matrix_acts_as_the_sum_of_its_cells() {
    let body = hexes(5);
    let solver = spatial(&body, Method::BlockJacobi);
    let n = body.equations.number.len();
    let mut x = load(n, 5);
    (0..n).filter(|&d| body.equations.number[d] == Equations::FIXED).for_each(|d| x[d] = 0.0);
    let mut expected = vec![0.0; n];
    for (cell, k) in body.pattern.blocks().zip(body.values.chunks_exact(576)) {
        for (row, k) in cell.iter().zip(k.chunks_exact(24)) {
            expected[*row] += cell.iter().zip(k).map(|(&c, k)| k * x[c]).sum::<f64>();
        }
    }
    let blocks: Vec<[f64; 3]> = x.chunks_exact(3).map(|b| [b[0], b[1], b[2]]).collect();
    let mut y = vec![[0.0; 3]; blocks.len()];
    solver.matrix().multiply(&blocks, &mut y);
    let largest = expected.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for (dof, (y, e)) in y.as_flattened().iter().zip(&expected).enumerate() {
        let e = if body.equations.number[dof] == Equations::FIXED { 0.0 } else { *e };
        assert!((y - e).abs() < 1e-13 * largest, "{dof}: {y} {e}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let body = hexes(14);
    let b = load(body.equations.free.len(), 7);
    for method in [AMG, Method::BlockJacobi] {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut x = vec![0.0; b.len()];
                let outcome = spatial(&body, method).solve(&mut x, &b, 1e-9);
                (x.iter().map(|v| v.to_bits()).collect::<Vec<_>>(), outcome)
            })
        };
        let one = run(1);
        assert_eq!(one, run(2));
        assert_eq!(one, run(3));
    }
}

#[test]
fn new_values_in_the_same_pattern_are_solved_as_if_set_up_anew() {
    let body = hexes(8);
    let b = load(body.equations.free.len(), 8);
    let softer: Vec<f64> = body.values.iter().map(|v| 0.25 * v).collect();
    for method in [AMG, Method::BlockJacobi] {
        let solver = spatial(&body, method).renewed(&[&softer]).unwrap();
        let mut x = vec![0.0; b.len()];
        assert!(solver.solve(&mut x, &b, 1e-12).converged());
        let exact: Vec<f64> = direct(&body, &b).iter().map(|x| 4.0 * x).collect();
        assert!(distance(&x, &exact) < 1e-10);
        assert!(solver.fits(&[&body.pattern]));
        assert!(!solver.fits(&[&Pattern::from_blocks(body.pattern.blocks())]));
    }
}

#[test]
fn iterations_hardly_grow_when_the_mesh_is_refined() {
    let count = |n: usize, method: Method| {
        let body = body(ElementKind::Hex8, [n; 3], Grading::Uniform, 0.25);
        let b = load(body.equations.free.len(), 9);
        let mut x = vec![0.0; b.len()];
        let outcome = spatial(&body, method).solve(&mut x, &b, 1e-8);
        assert!(outcome.converged(), "{outcome}");
        outcome.report().iterations as f64
    };
    assert!(count(20, AMG) < 1.5 * count(10, AMG));
    assert!(count(20, Method::BlockJacobi) > 1.5 * count(10, Method::BlockJacobi));
}

#[test]
fn a_good_start_saves_iterations_and_no_load_gives_no_displacement() {
    let body = hexes(8);
    let solver = spatial(&body, AMG);
    let b = load(body.equations.free.len(), 11);
    let mut x = direct(&body, &b);
    assert_eq!(solver.solve(&mut x, &b, 1e-9).report().iterations, 0);
    let outcome = solver.solve(&mut x, &vec![0.0; b.len()], 1e-9);
    assert!(outcome.converged() && x.iter().all(|&x| x == 0.0));
}

#[test]
fn a_tolerance_below_rounding_is_a_stalled_outcome() {
    let body = hexes(8);
    let b = load(body.equations.free.len(), 12);
    let mut x = vec![0.0; b.len()];
    let outcome = spatial(&body, AMG).solve(&mut x, &b, 1e-25);
    assert!(matches!(outcome, Outcome::Stalled(_)), "{outcome}");
    assert!(outcome.report().residual < 1e-13 && outcome.report().residual > 1e-20);
    assert!(distance(&x, &direct(&body, &b)) < 1e-10);
}

#[test]
fn too_few_iterations_are_an_outcome_with_the_residual_reached() {
    let body = hexes(8);
    let b = load(body.equations.free.len(), 13);
    let mut x = vec![0.0; b.len()];
    let outcome = spatial(&body, Method::BlockJacobi).solve_within(&mut x, &b, 1e-12, 5);
    let Outcome::Exhausted(report) = outcome else { panic!("{outcome}") };
    assert_eq!(report.iterations, 5);
    assert!(report.residual > 1e-12 && report.residual < 1.0);
    assert!(outcome.to_string().contains("5 iterations"));
}

#[test]
fn an_indefinite_matrix_is_an_outcome_or_names_its_degree_of_freedom() {
    let mut body = hexes(6);
    let b = load(body.equations.free.len(), 14);
    // The diagonal blocks are unchanged and the couplings between nodes grow: the matrix is positive definite node by node
    // only.
    for k in body.values.chunks_exact_mut(576) {
        for (place, v) in k.iter_mut().enumerate() {
            let (row, column) = (place / 24, place % 24);
            *v *= if row / 3 == column / 3 { 1.0 } else { 3.0 };
        }
    }
    let mut x = vec![0.0; b.len()];
    let outcome = spatial(&body, Method::BlockJacobi).solve(&mut x, &b, 1e-9);
    assert!(matches!(outcome, Outcome::Indefinite { energy, .. } if energy < 0.0), "{outcome}");

    body.values.iter_mut().for_each(|v| *v = -*v);
    let modes = near_null::spatial(&body.mesh.nodes);
    let error = Spatial::new(&[&body.pattern], &[&body.values], &body.equations, modes, Method::BlockJacobi)
        .unwrap_err();
    assert!(error.to_string().contains("degree of freedom"), "{error}");
}

#[test]
fn a_body_that_floats_is_refused() {
    let mut body = body(ElementKind::Hex8, [8; 3], Grading::Uniform, 0.3);
    body.equations =
        Constraints { fixed: vec![0, 1, 2], channels: Vec::new() }.equations(body.equations.number.len());
    let modes = near_null::spatial(&body.mesh.nodes);
    let error = Spatial::new(&[&body.pattern], &[&body.values], &body.equations, modes, AMG).unwrap_err();
    assert!(error.to_string().contains("free to move rigidly"), "{error}");
}

#[test]
fn single_degrees_of_freedom_are_refused() {
    let pattern = Pattern::from_blocks([[0, 1, 2, 4].as_slice()]);
    let equations = Constraints::default().equations(6);
    let modes = near_null::spatial(&[[0.0; 3], [1.0, 0.0, 0.0]]);
    let error = Spatial::new(&[&pattern], &[&[1.0; 16]], &equations, modes, AMG).unwrap_err();
    assert!(error.to_string().contains("whole nodes"), "{error}");
}
