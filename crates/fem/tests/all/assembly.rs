//! The system of a step: parallel assembly, symmetric and general factorisation, reuse, and the content of errors.

use asperity_fem::FemError;
use asperity_fem::assembly::{Iterative, NearNull, Storage, Symmetry, System};
use asperity_fem::block::LinearBlock;
use asperity_fem::dof::{Constraints, Equations};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::relative::RelativeDisplacements;
use asperity_fem::scatter::CellForces;
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::{Instant, Linearized, Pattern, Refusal, Term};

const STORAGES: [Storage; 4] =
    [Storage::Dense, Storage::Flexibility, Storage::Sparse, Storage::Preconditioned];

fn mesh(n: usize) -> Mesh<2> {
    let kind = ElementKind::Quad9;
    Block { min: [0.0; 2], max: [1.0; 2], divisions: [n; 2], grading: [Grading::Uniform; 2], kind }
        .mesh()
        .unwrap()
}

fn block(mesh: &Mesh<2>) -> LinearBlock<2> {
    let material = Elastic::new(3e9, 0.2).unwrap();
    LinearBlock::new(mesh, 0, &material, Idealisation::from_dimension(2), Formulation::Standard).unwrap()
}

fn clamped(mesh: &Mesh<2>) -> Equations {
    let fixed = nodes_of_sides(mesh, &mesh.side_sets["left"]).into_iter().flat_map(|n| [2 * n, 2 * n + 1]);
    Constraints { fixed: fixed.collect(), channels: Vec::new() }.equations(2 * mesh.nodes.len())
}

/// A spring from a degree of freedom to the ground, possibly of zero stiffness.
struct Spring {
    pattern: Pattern,
    stiffness: f64,
}

impl Spring {
    fn new(dof: usize, stiffness: f64) -> Self {
        Self { pattern: Pattern::from_blocks([[dof].as_slice()]), stiffness }
    }
}

impl Term for Spring {
    fn name(&self) -> &str {
        "spring"
    }

    fn residual(&mut self, u: &[f64], _at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        r[self.pattern.dofs()[0]] += self.stiffness * u[self.pattern.dofs()[0]];
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Spring {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values[0] = self.stiffness;
    }

    fn constant_tangent(&self) -> Option<&[f64]> {
        Some(std::slice::from_ref(&self.stiffness))
    }
}

#[test]
fn entries_are_the_sums_of_a_serial_loop_bit_by_bit_for_any_number_of_threads() {
    let mesh = mesh(40);
    let (block, equations) = (block(&mesh), clamped(&mesh));
    let spring = Spring::new(2 * mesh.nodes.len() - 1, 1e9);
    for part in [Part::Whole, Part::Lower] {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut map = ScatterMap::new(&[block.pattern(), &spring.pattern], &equations, part);
                map.clear();
                let offset = map.add(0, block.stiffness());
                map.add(offset, &[spring.stiffness]);
                map
            })
        };
        let map = run(1);
        let mut expected = vec![0.0; map.stored()];
        let symbolic = map.matrix().symbolic();
        let mut offset = 0;
        for cell in block.pattern().blocks() {
            for (i, &r) in cell.iter().enumerate() {
                for (j, &c) in cell.iter().enumerate() {
                    let (row, col) = (equations.number[r], equations.number[c]);
                    let stored = row != Equations::FIXED && col != Equations::FIXED;
                    if stored && (part == Part::Whole || row >= col) {
                        let place = symbolic.row_idx_of_col_raw(col).binary_search(&row).unwrap();
                        expected[symbolic.col_range(col).start + place] +=
                            block.stiffness()[offset + i * cell.len() + j];
                    }
                }
            }
            offset += cell.len() * cell.len();
        }
        // The last equation's diagonal is the last stored entry of both parts.
        *expected.last_mut().unwrap() += spring.stiffness;
        for threads in [1, 2, 3] {
            assert_eq!(run(threads).matrix().val(), expected);
        }
    }
}

#[test]
fn symmetric_and_general_systems_give_the_same_solution() {
    let mesh = mesh(12);
    let mut block = block(&mesh);
    let n = clamped(&mesh).free.len();
    let load: Vec<f64> = (0..n).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
    let mut solutions = Vec::new();
    for storage in STORAGES {
        for symmetry in [Symmetry::General, Symmetry::Positive] {
            let mut system = System::new(clamped(&mesh), storage).with_symmetry(symmetry);
            system.factor_tangent(&mut [&mut block]).unwrap();
            let mut x = load.clone();
            system.solve(&mut x).unwrap();
            solutions.push(x);
        }
    }
    let size = solutions[0].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for other in &solutions[1..] {
        assert!(solutions[0].iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-10 * size));
    }
}

#[test]
fn a_factor_is_reused_while_patterns_keep_their_versions_and_made_anew_when_one_changes() {
    let mesh = mesh(4);
    let mut block = block(&mesh);
    let dof = 2 * mesh.nodes.len() - 1;
    let mut system = System::new(clamped(&mesh), Storage::Sparse).with_symmetry(Symmetry::Positive);
    let mut spring = Spring::new(dof, 1e9);
    assert!(!system.is_factored([block.pattern(), spring.pattern()]));
    assert!(system.factor_tangent(&mut [&mut block, &mut spring]).unwrap());
    assert!(!system.factor_tangent(&mut [&mut block, &mut spring]).unwrap());
    assert_eq!(system.factorisations, 1);
    let mut moved = Spring::new(dof - 1, 1e9);
    assert!(system.factor_tangent(&mut [&mut block, &mut moved]).unwrap());
    assert_eq!(system.factorisations, 2);
    // The new factor belongs to the new pattern: a unit force acts on the body and the moved spring.
    let (mut with, mut without) = (vec![0.0; system.equations().free.len()], Vec::new());
    let last = with.len() - 2;
    with[last] = 1.0;
    without.extend_from_slice(&with);
    system.solve(&mut with).unwrap();
    system.factor_tangent(&mut [&mut block]).unwrap();
    system.solve(&mut without).unwrap();
    // Sherman and Morrison: u = u0 / (1 + k u0).
    let expected = without[last] / (1.0 + 1e9 * without[last]);
    assert!((with[last] - expected).abs() < 1e-12 * expected);
}

/// Pairs of degrees of freedom; the closed ones are coupled without symmetry, as by friction.
struct Pairs {
    pattern: Pattern,
    closed: Vec<bool>,
}

impl Pairs {
    fn new(pairs: &[[usize; 2]]) -> Self {
        let pattern = Pattern::from_blocks(pairs.iter().map(<[usize; 2]>::as_slice));
        Self { pattern, closed: vec![false; pairs.len()] }
    }
}

impl Term for Pairs {
    fn name(&self) -> &str {
        "pairs"
    }

    fn residual(&mut self, _u: &[f64], _at: Instant, _r: &mut [f64]) -> Result<(), Refusal> {
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Pairs {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        for (block, closed) in values.chunks_exact_mut(4).zip(&self.closed) {
            let coupling = if *closed { [3e11, -3e11, -2.1e11, 3e11] } else { [0.0; 4] };
            block.copy_from_slice(&coupling);
        }
    }
}

#[test]
fn all_systems_solve_alike_whichever_pairs_close_and_open() {
    let mesh = mesh(6);
    let mut block = block(&mesh);
    let last = 2 * mesh.nodes.len();
    // Pairs along the right and upper sides, closed in turn: none, three, nine, two, all, three others, none, forty.
    let pairs: Vec<[usize; 2]> = (0..60).map(|k| [last - 1 - k, last - 2 - k]).collect();
    let mut contact = Pairs::new(&pairs);
    let n = clamped(&mesh).free.len();
    let load: Vec<f64> = (0..n).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
    let mut dense = System::new(clamped(&mesh), Storage::Dense);
    let mut iterated = System::new(clamped(&mesh), Storage::Preconditioned);
    let mut again = 0;
    for closed in [0..0, 0..3, 0..9, 0..2, 0..60, 30..33, 0..0, 20..60] {
        for (k, is) in contact.closed.iter_mut().enumerate() {
            *is = closed.contains(&k);
        }
        let mut solve = |system: &mut System| {
            let mut x = load.clone();
            again += system.solve_tangent(&mut [&mut block, &mut contact], &mut x).unwrap() - 1;
            x
        };
        let expected = solve(&mut System::new(clamped(&mesh), Storage::Sparse));
        let size = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        // Factors: rounding times the condition number of the block, 1e4, and the ratio of the stiffness of the pairs to that of the
        // block, 100. Iterations leave a residual of 1e-5 of the load, of which the preconditioner lets through stiff and soft
        // motions alike, so that the displacements err by a few times as much.
        for (system, bound) in [(&mut dense, 1e-9), (&mut iterated, 1e-4)] {
            let found = solve(system);
            let error = found.iter().zip(&expected).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(error < bound * size, "{closed:?}: {:e}", error / size);
        }
    }
    // So small a factor is worth few iterations: six of the systems were too far from that of the one before and were assembled again.
    assert_eq!((iterated.factorisations, iterated.solves, again), (7, 8, 6));
    iterated.begin_step();
    let before = iterated.iterations;
    assert!(iterated.factor_tangent(&mut [&mut block, &mut contact]).unwrap());
    iterated.solve(&mut load.clone()).unwrap();
    // The unsymmetric part of forty closed pairs is left to the iterations.
    assert!(
        iterated.factorisations == 8 && iterated.iterations - before < 8,
        "{}",
        iterated.iterations - before
    );
}

/// Pairs of a node of one block and three of another, with friction on the closed ones.
struct Touching {
    pattern: Pattern,
    relative: RelativeDisplacements,
    closed: Vec<bool>,
    /// Stiffness along and across \[N/m\].
    stiffness: [f64; 2],
}

impl Touching {
    /// Pairs of node `k` of the first nodes with nodes `k`, `k + 1` and `k + 2` of the second.
    fn new(first: &[usize], second: &[usize], stiffness: [f64; 2]) -> Self {
        let nodes = |k: usize| [first[k], second[k], second[k + 1], second[k + 2]];
        let pairs = second.len() - 2;
        let blocks: Vec<Vec<usize>> =
            (0..pairs).map(|k| nodes(k).iter().flat_map(|n| [2 * n, 2 * n + 1]).collect()).collect();
        let relative = RelativeDisplacements {
            components: 2,
            starts: (0..=pairs).map(|k| 4 * k).collect(),
            dofs: (0..pairs).flat_map(nodes).map(|n| 2 * n).collect(),
            weights: [1.0, -0.5, -0.25, -0.25].repeat(pairs),
        };
        let pattern = Pattern::from_blocks(blocks.iter().map(Vec::as_slice));
        Self { pattern, relative, closed: vec![false; pairs], stiffness }
    }
}

impl Term for Touching {
    fn name(&self) -> &str {
        "touching"
    }

    fn residual(&mut self, _u: &[f64], _at: Instant, _r: &mut [f64]) -> Result<(), Refusal> {
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Touching {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.fill(0.0);
        let [along, across] = self.stiffness;
        let m = [[along, 0.4 * across], [0.0, across]];
        for (k, block) in values.chunks_exact_mut(64).enumerate().filter(|(k, _)| self.closed[*k]) {
            for (i, row) in block.chunks_exact_mut(8).enumerate() {
                let weight = |i: usize| self.relative.weights[4 * k + i / 2];
                row.iter_mut().enumerate().for_each(|(j, v)| *v = weight(i) * weight(j) * m[i % 2][j % 2]);
            }
        }
    }

    fn relative(&self) -> Option<&RelativeDisplacements> {
        Some(&self.relative)
    }
}

/// Two blocks side by side, with these divisions each, and the nodes of the sides that face each other.
fn two_blocks(divisions: [usize; 2]) -> (Mesh<2>, [Vec<usize>; 2]) {
    let block = |x: f64| {
        let kind = ElementKind::Quad9;
        let (min, max) = ([x, 0.0], [x + 1.0, 1.0]);
        Block { min, max, divisions, grading: [Grading::Uniform; 2], kind }.mesh().unwrap()
    };
    let mut mesh = block(0.0);
    mesh.append(block(1.0), "second");
    let nodes = |set: &str| nodes_of_sides(&mesh, &mesh.side_sets[set]);
    let facing = [nodes("right"), nodes("second.left")];
    (mesh, facing)
}

fn system_of(mesh: &Mesh<2>, held: &[&str], storage: Storage) -> System {
    let nodes = held.iter().flat_map(|set| nodes_of_sides(mesh, &mesh.side_sets[*set]));
    let mut fixed: Vec<usize> = nodes.flat_map(|n| [2 * n, 2 * n + 1]).collect();
    fixed.sort_unstable();
    System::new(Constraints { fixed, channels: Vec::new() }.equations(2 * mesh.nodes.len()), storage)
}

fn linear(mesh: &Mesh<2>, block: usize) -> LinearBlock<2> {
    let material = Elastic::new(3e9, 0.2).unwrap();
    LinearBlock::new(mesh, block, &material, Idealisation::from_dimension(2), Formulation::Standard).unwrap()
}

/// Largest error of a solution over the largest value of what is expected.
fn error(found: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    found.iter().zip(expected).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / size
}

fn solution(system: &mut System, terms: &mut [&mut dyn Linearized]) -> Vec<f64> {
    let n = system.equations().free.len();
    system.factor_tangent(terms).unwrap();
    let mut x: Vec<f64> = (0..n).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
    system.solve(&mut x).unwrap();
    x
}

#[test]
fn tractions_between_bodies_that_are_held_or_float_are_those_of_lu() {
    let (mesh, [right, left]) = two_blocks([3, 5]);
    let (mut first, mut second) = (linear(&mesh, 0), linear(&mesh, 1));
    let mut contact = Touching::new(&right, &left, [3e11, 1e11]);
    for held in [&["left", "second.right"][..], &["left"]] {
        let mut pairs = system_of(&mesh, held, Storage::Flexibility);
        for closed in [0..9, 2..5, 0..4, 0..9] {
            contact.closed.iter_mut().enumerate().for_each(|(k, is)| *is = closed.contains(&k));
            let mut terms: [&mut dyn Linearized; 3] = [&mut first, &mut second, &mut contact];
            let expected = solution(&mut system_of(&mesh, held, Storage::Sparse), &mut terms);
            let found = solution(&mut pairs, &mut terms);
            // Rounding times the condition number of the blocks, 1e4, and the ratio of the stiffness of the pairs to theirs, 100.
            assert!(error(&found, &expected) < 1e-9, "{held:?} {closed:?}: {:e}", error(&found, &expected));
        }
        assert_eq!((pairs.factorisations, pairs.iterations), (4, 0));
        contact.closed.fill(false);
        let n = pairs.equations().free.len();
        let open = pairs
            .factor_tangent(&mut [&mut first, &mut second, &mut contact])
            .and_then(|_| pairs.solve(&mut vec![1.0; n]));
        let floats = held.len() == 1;
        assert_eq!(open.is_err_and(|error| error.is_singular()), floats);
    }
}

#[test]
fn a_factor_takes_over_in_a_step_in_which_levels_fail_and_levels_are_tried_again_in_the_next() {
    let (mesh, [right, left]) = two_blocks([10, 20]);
    let (mut first, mut second) = (linear(&mesh, 0), linear(&mesh, 1));
    let mut contact = Touching::new(&right, &left, [3e11, 1e11]);
    contact.closed.fill(true);
    let terms: &mut [&mut dyn Linearized] = &mut [&mut first, &mut second, &mut contact];
    let mut lu = system_of(&mesh, &["left", "second.right"], Storage::Sparse);
    let equations = lu.equations().clone();
    let load: Vec<f64> = (0..equations.free.len()).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
    let levels = |most_iterations| {
        let near_null = NearNull::new(&mesh.nodes, 2).unwrap();
        let iterative = Iterative { near_null, tolerance: 1e-10, most_iterations };
        System::aggregated(equations.clone(), iterative)
    };
    let mut expected = load.clone();
    lu.solve_tangent(terms, &mut expected).unwrap();

    // Two iterations do not reach a thousandth of the load, which is the least that serves as a direction.
    let mut alone = levels(2);
    let outcome = alone.solve_tangent(terms, &mut load.clone());
    assert!(matches!(outcome, Err(FemError::NotConverged(_))), "{outcome:?}");

    let mut both = levels(2).with_factors(usize::MAX, None);
    for factorisations in [[2, 2], [4, 4]] {
        both.begin_step();
        for made in factorisations {
            let mut x = load.clone();
            both.solve_tangent(terms, &mut x).unwrap();
            // The factor's own iterations leave 1e-5 of the load, and displacements err by a few times as much.
            assert!(error(&x, &expected) < 1e-4, "{:e}", error(&x, &expected));
            // Levels and a factor at the first solution, the same factor at the second.
            assert_eq!(both.factorisations, made);
        }
    }

    let mut enough = levels(200).with_factors(usize::MAX, None);
    let mut x = load;
    enough.solve_tangent(terms, &mut x).unwrap();
    // A residual of 1e-10 of the load, and a condition number of 1e4.
    assert!(enough.factorisations == 1 && error(&x, &expected) < 1e-6, "{:e}", error(&x, &expected));
}

/// Product of the sum of the tangents with `x`.
fn product(terms: &mut [&mut dyn Linearized], equations: &Equations, x: &[f64]) -> Vec<f64> {
    let mut u = vec![0.0; equations.number.len()];
    equations.spread(x, &mut u);
    let mut forces = vec![0.0; u.len()];
    for term in terms {
        let mut values = vec![0.0; term.pattern().values()];
        term.tangent(&mut values);
        let mut rows = values.as_slice();
        for block in term.pattern().blocks() {
            for &dof in block {
                let (row, rest) = rows.split_at(block.len());
                forces[dof] += row.iter().zip(block).map(|(k, &d)| k * u[d]).sum::<f64>();
                rows = rest;
            }
        }
    }
    equations.gather(&forces)
}

/// Newton's method for a linear system: the solution after so many iterations.
fn iterated(
    system: &mut System,
    terms: &mut [&mut dyn Linearized],
    load: &[f64],
    iterations: usize,
) -> Vec<f64> {
    let mut x = vec![0.0; load.len()];
    system.begin_step();
    for _ in 0..iterations {
        let ax = product(terms, system.equations(), &x);
        let mut rest: Vec<f64> = load.iter().zip(ax).map(|(b, ax)| b - ax).collect();
        system.factor_tangent(terms).unwrap();
        system.solve(&mut rest).unwrap();
        x.iter_mut().zip(rest).for_each(|(x, dx)| *x += dx);
    }
    x
}

#[test]
fn a_factor_of_many_pairs_serves_while_few_change_and_a_resumed_system_goes_on_with_it() {
    let (mesh, [right, left]) = two_blocks([1, 130]);
    let (mut first, mut second) = (linear(&mesh, 0), linear(&mesh, 1));
    let mut contact = Touching::new(&right, &left, [3e11, 1e11]);
    let held = ["left", "second.right"];
    let mut pairs = system_of(&mesh, &held, Storage::Flexibility);
    let load: Vec<f64> = (0..pairs.equations().free.len()).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
    let mut resumed: Option<System> = None;
    for (step, open) in [0..0, 3..5, 100..105, 0..0, 7..8].into_iter().enumerate() {
        contact.closed.iter_mut().enumerate().for_each(|(k, is)| *is = !open.contains(&k));
        let mut terms: [&mut dyn Linearized; 3] = [&mut first, &mut second, &mut contact];
        let expected = solution(&mut system_of(&mesh, &held, Storage::Sparse), &mut terms);
        let found = iterated(&mut pairs, &mut terms, &load, 4);
        // The first iteration leaves 1 % of the load, the others the square of what the one before gained: rounding in the end.
        assert!(error(&found, &expected) < 1e-9, "{open:?}: {:e}", error(&found, &expected));
        if let Some(resumed) = &mut resumed {
            assert_eq!(iterated(resumed, &mut terms, &load, 4), found, "step {step}");
        } else if step == 1 {
            let mut other = system_of(&mesh, &held, Storage::Flexibility);
            assert!(other.restore(&pairs.memory(&terms), &mut terms));
            resumed = Some(other);
        }
    }
    // Twenty solutions.
    let made = pairs.factorisations;
    assert!(made <= 4 && pairs.iterations > 0, "{made} {}", pairs.iterations);
    // All slip at once: what iterations cost beyond the first solution makes another factor, which serves again.
    contact.closed.fill(true);
    contact.stiffness = [3e11, 1e7];
    for _ in 0..6 {
        contact.stiffness[1] *= 1.01;
        iterated(&mut pairs, &mut [&mut first, &mut second, &mut contact], &load, 2);
    }
    assert!((1..=3).contains(&(pairs.factorisations - made)), "{}", pairs.factorisations - made);
}

#[test]
fn an_unsymmetric_system_is_solved_by_lu_where_no_positive_one_is_near() {
    let mesh = mesh(6);
    let mut block = block(&mesh);
    let last = 2 * mesh.nodes.len();
    let mut contact = Pairs::new(&[[last - 1, last - 2]]);
    contact.closed[0] = true;
    // A negative spring that outweighs the body.
    let mut away = Spring::new(last - 1, -4e11);
    let n = clamped(&mesh).free.len();
    let load: Vec<f64> = (0..n).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
    let mut iterated = System::new(clamped(&mesh), Storage::Preconditioned);
    let mut direct = System::new(clamped(&mesh), Storage::Sparse);
    for factorisations in [1, 2] {
        let mut solve = |system: &mut System| {
            system.factor_tangent(&mut [&mut block, &mut contact, &mut away]).unwrap();
            let mut x = load.clone();
            system.solve(&mut x).unwrap();
            x
        };
        let (found, expected) = (solve(&mut iterated), solve(&mut direct));
        assert_eq!(found, expected);
        assert_eq!((iterated.factorisations, iterated.iterations), (factorisations, 0));
    }
    // Without the memory of LU nothing is solved, and nothing wrong is returned.
    let mut bounded = System::new(clamped(&mesh), Storage::Preconditioned).prepared(200_000, None);
    let error = bounded.factor_tangent(&mut [&mut block, &mut contact, &mut away]).unwrap_err();
    assert!(error.to_string().contains("not positive definite"), "{error}");
}

#[test]
fn what_nothing_but_a_closed_pair_holds_is_held_by_it_and_named_when_it_opens() {
    // A chain of springs between six degrees of freedom floats; a pair that couples its end to a held degree of freedom holds
    // it.
    let chain: Vec<[usize; 2]> = (1..6).map(|k| [k, k + 1]).collect();
    let pattern = Pattern::from_blocks(chain.iter().map(<[usize; 2]>::as_slice));
    let mut links = Chain { pattern, values: [1e12, -1e12, -1e12, 1e12].repeat(chain.len()) };
    let mut contact = Pairs::new(&[[0, 1]]);
    let equations = || Constraints { fixed: vec![0], channels: Vec::new() }.equations(7);
    for symmetry in [Symmetry::General, Symmetry::Symmetric] {
        let mut system = System::new(equations(), Storage::Dense).with_symmetry(symmetry);
        for _ in 0..2 {
            contact.closed[0] = true;
            system.factor_tangent(&mut [&mut links, &mut contact]).unwrap();
            let mut x = [0.0, 0.0, 0.0, 0.0, 0.0, 3e11];
            system.solve(&mut x).unwrap();
            // The force passes the whole chain: 1 at the pair, 0.3 more in each link.
            let exact = [1.0, 1.3, 1.6, 1.9, 2.2, 2.5];
            assert!(x.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{x:?}");
            contact.closed[0] = false;
            let error = system
                .factor_tangent(&mut [&mut links, &mut contact])
                .and_then(|_| system.solve(&mut [0.0, 0.0, 0.0, 0.0, 0.0, 3e11]))
                .unwrap_err();
            assert!(error.is_singular(), "{error}");
        }
    }
}

/// Links of 1e12 between pairs of degrees of freedom.
struct Chain {
    pattern: Pattern,
    values: Vec<f64>,
}

impl Term for Chain {
    fn name(&self) -> &str {
        "chain"
    }

    fn residual(&mut self, _u: &[f64], _at: Instant, _r: &mut [f64]) -> Result<(), Refusal> {
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Chain {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(&self.values);
    }

    fn constant_tangent(&self) -> Option<&[f64]> {
        Some(&self.values)
    }
}

#[test]
fn what_nothing_holds_is_named_by_its_degree_of_freedom() {
    let equations = || Constraints { fixed: vec![0], channels: Vec::new() }.equations(3);
    for storage in STORAGES {
        for symmetry in [Symmetry::General, Symmetry::Positive] {
            let mut system = System::new(equations(), storage).with_symmetry(symmetry);
            let (mut held, mut free) = (Spring::new(1, 2.0), Spring::new(2, 0.0));
            let error = system
                .factor_tangent(&mut [&mut held, &mut free])
                .and_then(|_| system.solve(&mut [1.0, 1.0]))
                .unwrap_err();
            assert!(error.to_string().contains("degree of freedom 2"), "{error}");
            assert!(!system.is_factored([held.pattern(), free.pattern()]));
        }
    }
}

#[test]
fn a_negative_spring_is_not_positive_definite() {
    let equations = Constraints::default().equations(1);
    for storage in STORAGES {
        let mut system = System::new(equations.clone(), storage).with_symmetry(Symmetry::Positive);
        let error = system.factor_tangent(&mut [&mut Spring::new(0, -1.0)]).unwrap_err();
        assert!(error.to_string().contains("not positive definite: degree of freedom 0"), "{error}");
    }
}

#[test]
fn a_symmetric_matrix_with_a_negative_mode_is_solved_by_lu_and_counted() {
    let mesh = mesh(3);
    let mut block = block(&mesh);
    let n = clamped(&mesh).free.len();
    let load: Vec<f64> = (0..n).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
    // A spring with negative stiffness at the last degree of freedom, stiffer than the body: one negative eigenvalue.
    let dof = 2 * mesh.nodes.len() - 1;
    let mut away = Spring::new(dof, -3e10);
    for storage in [Storage::Dense, Storage::Sparse, Storage::Preconditioned] {
        let mut solve = |symmetry, stiffness: f64| {
            away.stiffness = stiffness;
            let mut system = System::new(clamped(&mesh), storage).with_symmetry(symmetry);
            let anew = system.factor_tangent(&mut [&mut block, &mut away]).unwrap();
            let mut x = load.clone();
            system.solve(&mut x).unwrap();
            assert!(anew);
            (x, system.indefinite)
        };
        let (exact, _) = solve(Symmetry::General, -3e10);
        let (found, counted) = solve(Symmetry::Symmetric, -3e10);
        let size = exact.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(exact.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-10 * size), "{storage:?}");
        assert_eq!((counted, solve(Symmetry::Symmetric, 3e10).1), (1, 0), "{storage:?}");
    }
}

#[test]
fn parallel_cell_forces_are_the_residual_of_the_block() {
    let mesh = mesh(20);
    let mut block = block(&mesh);
    let n = 2 * mesh.nodes.len();
    let u: Vec<f64> = (0..n).map(|k| ((k * 37) % 101) as f64 * 1e-6).collect();
    let mut expected = vec![0.0; n];
    block.residual(&u, Instant { time: 0.0, dt: 1.0 }, &mut expected).unwrap();
    let mut r = vec![0.0; n];
    let stiffness = block.stiffness();
    CellForces::new(block.pattern(), n).add(
        block.pattern(),
        |cell, dofs, f| {
            let size = dofs.len() * dofs.len();
            let k = &stiffness[cell * size..(cell + 1) * size];
            for (f, row) in f.iter_mut().zip(k.chunks_exact(dofs.len())) {
                *f = row.iter().zip(dofs).map(|(k, &dof)| k * u[dof]).sum();
            }
        },
        &mut r,
    );
    assert_eq!(r, expected);
}
