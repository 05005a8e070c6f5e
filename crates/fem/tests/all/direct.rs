//! The direct solver: accuracy, reproducible bits, refusals, and diagnoses of singular matrices.

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::{Constraints, Equations};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::Mesh;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::multifrontal::{Cholesky, DirectError, SymbolicCholesky, free_mode};
use asperity_fem::ordering::Ordering;
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::{Linearized, Pattern};
use faer::Mat;
use faer::sparse::SymbolicSparseColMat;
use nalgebra::DMatrix;
use proptest::prelude::*;
use std::sync::Arc;

const ORDERINGS: [Ordering; 4] =
    [Ordering::Automatic, Ordering::MinimumDegree, Ordering::NestedDissection, Ordering::Natural];

/// A lower triangle: (column starts, rows, values).
type LowerTriangle = (Vec<usize>, Vec<usize>, Vec<f64>);

/// A diagonally dominant symmetric matrix with the given couplings.
fn dominant(n: usize, edges: &[(usize, usize, f64)]) -> DMatrix<f64> {
    let mut a = DMatrix::identity(n, n);
    for &(i, j, v) in edges.iter().filter(|(i, j, _)| i != j) {
        a[(i, j)] += v;
        a[(j, i)] += v;
        a[(i, i)] += 2.0 * v.abs();
        a[(j, j)] += 2.0 * v.abs();
    }
    a
}

fn lower(a: &DMatrix<f64>) -> LowerTriangle {
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for j in 0..a.ncols() {
        for i in (j..a.nrows()).filter(|&i| a[(i, j)] != 0.0) {
            rows.push(i);
            values.push(a[(i, j)]);
        }
        starts.push(rows.len());
    }
    (starts, rows, values)
}

fn analyse(a: &LowerTriangle, ordering: Ordering, retained: &[usize]) -> Arc<SymbolicCholesky> {
    let n = a.0.len() - 1;
    let pattern = SymbolicSparseColMat::new_checked(n, n, a.0.clone(), None, a.1.clone());
    Arc::new(SymbolicCholesky::retaining(pattern.as_ref(), ordering, retained).unwrap())
}

fn right_hand_sides(n: usize, columns: usize) -> Mat<f64> {
    Mat::from_fn(n, columns, |i, j| ((3 * i + 7 * j) as f64 * 0.7).sin())
}

/// Largest |A x - b| relative to the largest (|A||x| + |b|).
fn residual(a: &DMatrix<f64>, x: &Mat<f64>, b: &Mat<f64>) -> f64 {
    let mut worst = 0.0_f64;
    for c in 0..x.ncols() {
        for i in 0..a.nrows() {
            let (mut r, mut scale) = (-b[(i, c)], b[(i, c)].abs());
            for j in 0..a.ncols() {
                r += a[(i, j)] * x[(j, c)];
                scale += (a[(i, j)] * x[(j, c)]).abs();
            }
            worst = worst.max(r.abs() / scale.max(1e-300));
        }
    }
    worst
}

/// Number of equations, couplings, presence of a dense row, and marks of the retained equations.
type Problem = (usize, Vec<(usize, usize, f64)>, bool, Vec<bool>);

fn graph() -> impl Strategy<Value = Problem> {
    (1_usize..60).prop_flat_map(|n| {
        let edges = proptest::collection::vec((0..n, 0..n, -1.0_f64..1.0), 0..3 * n);
        (Just(n), edges, any::<bool>(), proptest::collection::vec(any::<bool>(), n))
    })
}

proptest! {
    /// Includes disconnected graphs, single equations and dense rows.
    #[test]
    fn any_positive_definite_matrix_is_solved_to_rounding((n, mut edges, dense_row, _) in graph(), columns in 1_usize..70) {
        if dense_row {
            edges.extend((0..n).map(|i| (i, n / 2, 0.3)));
        }
        let a = dominant(n, &edges);
        let stored = lower(&a);
        for ordering in ORDERINGS {
            let factor = Cholesky::new(analyse(&stored, ordering, &[]), &stored.2).unwrap();
            let b = right_hand_sides(n, columns);
            let mut x = b.clone();
            factor.solve(x.as_mut());
            prop_assert!(residual(&a, &x, &b) < 1e-14, "{ordering:?}");
        }
    }

    #[test]
    fn retained_equations_come_last_and_keep_their_schur_complement((n, edges, _, class) in graph()) {
        let a = dominant(n, &edges);
        let stored = lower(&a);
        let retained: Vec<usize> = (0..n).filter(|&e| class[e]).collect();
        let inner: Vec<usize> = (0..n).filter(|&e| !class[e]).collect();
        for ordering in ORDERINGS {
            let symbolic = analyse(&stored, ordering, &retained);
            let order: Vec<usize> = symbolic.order().collect();
            prop_assert_eq!(&order[inner.len()..], &retained[..]);
            let mut factor = Cholesky::new(symbolic, &stored.2).unwrap();
            let pick = |r: &[usize], c: &[usize]| DMatrix::from_fn(r.len(), c.len(), |i, j| a[(r[i], c[j])]);
            let mut expected = pick(&retained, &retained);
            if !inner.is_empty() {
                let solved = pick(&inner, &inner).cholesky().unwrap().solve(&pick(&inner, &retained));
                expected -= pick(&retained, &inner) * solved;
            }
            let schur = DMatrix::from_column_slice(retained.len(), retained.len(), &factor.take_schur());
            if !retained.is_empty() {
                prop_assert!((schur - &expected).amax() < 1e-13 * expected.amax().max(1.0));
            }
        }
    }
}

/// A block of hex8 or quad4 held on its left side, its free equations and stiffness.
fn block_of<const D: usize>(divisions: [usize; D], kind: ElementKind) -> (Mesh<D>, LinearBlock<D>) {
    let grading = [Grading::Uniform; D];
    let max = std::array::from_fn(|i| divisions[i] as f64);
    let mesh = Block { min: [0.0; D], max, divisions, grading, kind }.mesh().unwrap();
    let cells = LinearBlock::new(
        &mesh,
        0,
        &Elastic::new(2.0, 0.25).unwrap(),
        Idealisation::from_dimension(D),
        Formulation::Standard,
    )
    .unwrap();
    (mesh, cells)
}

fn assembled<const D: usize>(
    mesh: &Mesh<D>,
    cells: &LinearBlock<D>,
    fixed: Vec<usize>,
) -> (ScatterMap, Equations) {
    let equations = Constraints { fixed, channels: Vec::new() }.equations(mesh.nodes.len() * D);
    let mut matrix = ScatterMap::new(&[cells.pattern()], &equations, Part::Lower);
    matrix.add(0, cells.stiffness());
    (matrix, equations)
}

fn left<const D: usize>(mesh: &Mesh<D>) -> Vec<usize> {
    (0..mesh.nodes.len())
        .filter(|&n| mesh.nodes[n][0] == 0.0)
        .flat_map(|n| (0..D).map(move |i| n * D + i))
        .collect()
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    // Large enough for many tasks and for fronts that are cut into tiles and pieces.
    let (mesh, cells) = block_of::<3>([20, 19, 18], ElementKind::Hex8);
    let (matrix, _) = assembled(&mesh, &cells, left(&mesh));
    let solved = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let factor = matrix.cholesky(&matrix.analyse_cholesky().unwrap()).unwrap();
            [1, 3, 70].map(|columns| {
                let mut x = right_hand_sides(matrix.order(), columns);
                factor.solve(x.as_mut());
                x
            })
        })
    };
    let one = solved(1);
    for threads in [2, 3] {
        for (a, b) in one.iter().zip(&solved(threads)) {
            assert!(a == b, "{threads} threads");
        }
    }
}

#[test]
fn refactoring_in_place_gives_the_bits_of_a_new_factor() {
    let (mesh, cells) = block_of::<2>([40, 30], ElementKind::Quad4);
    let (matrix, _) = assembled(&mesh, &cells, left(&mesh));
    let symbolic = matrix.analyse_cholesky().unwrap();
    let twice: Vec<f64> = matrix.values().iter().map(|v| 3.0 * v).collect();
    let again = Cholesky::new(symbolic.clone(), &twice).unwrap().refactor(matrix.values()).unwrap();
    let b = right_hand_sides(matrix.order(), 2);
    let (mut x, mut y) = (b.clone(), b);
    again.solve(x.as_mut());
    Cholesky::new(symbolic, matrix.values()).unwrap().solve(y.as_mut());
    assert!(x == y);
}

#[test]
fn nested_dissection_is_taken_in_space_and_minimum_degree_in_the_plane() {
    let (mesh, cells) = block_of::<3>([14, 14, 14], ElementKind::Hex8);
    let (matrix, _) = assembled(&mesh, &cells, left(&mesh));
    let stored = |o| SymbolicCholesky::new(matrix.symbolic(), o).unwrap().stored();
    assert_eq!(stored(Ordering::Automatic), stored(Ordering::NestedDissection));
    assert!(stored(Ordering::NestedDissection) < stored(Ordering::MinimumDegree));
    let (mesh, cells) = block_of::<2>([60, 60], ElementKind::Quad4);
    let (matrix, _) = assembled(&mesh, &cells, left(&mesh));
    let stored = |o| SymbolicCholesky::new(matrix.symbolic(), o).unwrap().stored();
    assert_eq!(stored(Ordering::Automatic), stored(Ordering::MinimumDegree));
    assert!(stored(Ordering::MinimumDegree) < stored(Ordering::Natural));
}

#[test]
fn memory_is_known_before_and_refused_above_the_budget() {
    let (mesh, cells) = block_of::<2>([20, 20], ElementKind::Quad4);
    let (matrix, _) = assembled(&mesh, &cells, left(&mesh));
    let symbolic = matrix.analyse_cholesky().unwrap();
    assert!(symbolic.bytes() >= 8 * symbolic.stored());
    assert!(symbolic.admit(symbolic.bytes()).is_ok());
    let error = symbolic.admit(1000).unwrap_err();
    assert_eq!(
        error,
        DirectError::Memory { needed: symbolic.bytes(), allowed: 1000, equations: matrix.order() }
    );
}

#[test]
fn a_negative_pivot_names_its_equation() {
    let mut a = dominant(30, &(0..29).map(|i| (i, i + 1, -1.0)).collect::<Vec<_>>());
    a[(17, 17)] = -0.5;
    let stored = lower(&a);
    for ordering in ORDERINGS {
        let error = Cholesky::new(analyse(&stored, ordering, &[]), &stored.2).unwrap_err();
        let DirectError::NotPositive(pivot) = error else { panic!("{ordering:?}: {error}") };
        assert_eq!((pivot.equation, pivot.diagonal), (17, -0.5));
        assert!(pivot.pivot <= -0.5);
    }
    let mut stored = lower(&dominant(5, &[]));
    stored.2[3] = f64::NAN;
    let error = Cholesky::new(analyse(&stored, Ordering::Natural, &[]), &stored.2).unwrap_err();
    assert_eq!(error.pivot().unwrap().equation, 3);
}

#[test]
fn an_equation_without_stiffness_is_singular() {
    let mut a = dominant(6, &[(0, 1, 0.5)]);
    a[(4, 4)] = 0.0;
    let stored = lower(&a);
    let error = Cholesky::new(analyse(&stored, Ordering::Automatic, &[]), &stored.2).unwrap_err();
    assert!(matches!(error, DirectError::Singular(p) if p.equation == 4), "{error}");
}

fn failure<const D: usize>(mesh: &Mesh<D>, matrix: &ScatterMap, equations: &Equations) -> (usize, String) {
    let error = Cholesky::new(matrix.analyse_cholesky().unwrap(), matrix.values()).unwrap_err();
    let DirectError::Singular(pivot) = error else { panic!("{error}") };
    let mode = free_mode(matrix.matrix(), pivot.equation, equations, &mesh.nodes).unwrap();
    assert!(mode.deformation < 1e-9 && mode.stiffness < 1e-12, "{mode:?}");
    (equations.free[pivot.equation] / D, mode.to_string())
}

#[test]
fn a_hinged_body_is_told_to_rotate() {
    for divisions in [[4, 3], [70, 60]] {
        let (mesh, cells) = block_of::<2>(divisions, ElementKind::Quad4);
        let (matrix, equations) = assembled(&mesh, &cells, vec![0, 1]);
        let (_, text) = failure(&mesh, &matrix, &equations);
        assert!(text.contains("can rotate about z"), "{text}");
    }
}

#[test]
fn a_body_on_a_frictionless_floor_is_told_to_slide() {
    let (mesh, cells) = block_of::<3>([5, 4, 3], ElementKind::Hex8);
    let floor = (0..mesh.nodes.len()).filter(|&n| mesh.nodes[n][2] == 0.0).map(|n| 3 * n + 2);
    let mut fixed: Vec<usize> = floor.chain([1, 3 * 5 + 1]).collect();
    fixed.sort_unstable();
    let (matrix, equations) = assembled(&mesh, &cells, fixed);
    let (_, text) = failure(&mesh, &matrix, &equations);
    assert!(text.ends_with("can translate along x"), "{text}");
}

#[test]
fn the_free_one_of_two_bodies_is_named() {
    let (mut mesh, cells) = block_of::<2>([6, 5], ElementKind::Quad4);
    let count = mesh.nodes.len();
    let copy: Vec<[f64; 2]> = mesh.nodes.iter().map(|x| [x[0] + 100.0, x[1]]).collect();
    mesh.nodes.extend(copy);
    let second: Vec<Vec<usize>> =
        cells.pattern().blocks().map(|b| b.iter().map(|d| d + 2 * count).collect()).collect();
    let pattern = Pattern::from_blocks(cells.pattern().blocks().chain(second.iter().map(Vec::as_slice)));
    let fixed = (0..count).filter(|&n| mesh.nodes[n][0] == 0.0).flat_map(|n| [2 * n, 2 * n + 1]).collect();
    let equations = Constraints { fixed, channels: Vec::new() }.equations(mesh.nodes.len() * 2);
    let mut matrix = ScatterMap::new(&[&pattern], &equations, Part::Lower);
    matrix.add(0, &[cells.stiffness(), cells.stiffness()].concat());
    let (node, text) = failure(&mesh, &matrix, &equations);
    assert!(node >= count, "{node}");
    assert!(text.contains(&format!("{count} nodes around node {count} ")), "{text}");
}

#[test]
fn a_slender_held_body_is_not_taken_for_a_free_one() {
    // Bending makes the last pivots of a cantilever of 1 by 400 elements 1e-7 of their diagonal.
    let (mesh, cells) = block_of::<2>([400, 1], ElementKind::Quad4);
    let (matrix, _) = assembled(&mesh, &cells, left(&mesh));
    for ordering in ORDERINGS {
        let symbolic = Arc::new(SymbolicCholesky::new(matrix.symbolic(), ordering).unwrap());
        assert!(Cholesky::new(symbolic, matrix.values()).is_ok(), "{ordering:?}");
    }
}
