use super::{MatrixFree, highest_frequency};
use crate::block::{LinearBlock, lumped};
use crate::element::ElementKind;
use crate::kinematics::{Formulation, Idealisation};
use crate::material::elastic::Elastic;
use crate::mesh::generate::Grid;
use crate::mesh::{Cells, Mesh};
use crate::term::{Instant, Term as _};

const WITH_MASS: [(ElementKind, Idealisation); 9] = [
    (ElementKind::Tri3, Idealisation::PlaneStrain),
    (ElementKind::Tri3, Idealisation::Antiplane),
    (ElementKind::Tri3, Idealisation::Axisymmetric),
    (ElementKind::Quad4, Idealisation::PlaneStress),
    (ElementKind::Quad4, Idealisation::Antiplane),
    (ElementKind::Quad9, Idealisation::PlaneStrain),
    (ElementKind::Tet4, Idealisation::ThreeD),
    (ElementKind::Hex8, Idealisation::ThreeD),
    (ElementKind::Hex27, Idealisation::ThreeD),
];

fn rock() -> Elastic {
    Elastic::new(75e9, 0.25).unwrap()
}

/// Grid of some thousand cells, of equal shapes or, shaken, each of its own.
fn mesh<const D: usize>(kind: ElementKind, divisions: usize, shaken: bool) -> Mesh<D> {
    let line = |axis: usize| (0..=divisions + axis).map(|k| 1.0 + k as f64 * 0.5).collect();
    let mut mesh = Grid::<D> { lines: [line(0), line(1), line(2)][..D].to_vec().try_into().unwrap(), kind }
        .mesh()
        .unwrap();
    if shaken {
        for (n, x) in mesh.nodes.iter_mut().enumerate() {
            x.iter_mut().enumerate().for_each(|(c, x)| *x += 0.05 * ((7 * n + 3 * c) as f64).sin());
        }
    }
    mesh
}

fn difference<const D: usize>(kind: ElementKind, space: Idealisation, divisions: usize, shaken: bool) -> f64 {
    let mesh = mesh::<D>(kind, divisions, shaken);
    let mut block = LinearBlock::new(&mesh, 0, &rock(), space, Formulation::Standard).unwrap();
    let components = space.components();
    let n = mesh.nodes.len() * components;
    let u: Vec<f64> = (0..n).map(|k| (k as f64 * 0.7).sin()).collect();
    let (mut free, mut assembled) = (vec![0.0; n], vec![0.0; n]);
    let mut product = MatrixFree::new(&mesh, components, &[Some(&block)]);
    product.apply(&u, &mut free);
    block.residual(&u, Instant { time: 0.0, dt: 1.0 }, &mut assembled).unwrap();
    let largest = assembled.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    free.iter().zip(&assembled).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
}

#[test]
fn products_without_a_matrix_are_those_of_the_cell_matrices() {
    for (kind, space) in WITH_MASS {
        for shaken in [false, true] {
            let off = if space.dimension() == 2 {
                difference::<2>(kind, space, 40, shaken)
            } else {
                difference::<3>(kind, space, 9, shaken)
            };
            // Rounding of sums of some tens of products, and of shapes that agree to 1e-9.
            let bound = if shaken { 1e-14 } else { 1e-13 };
            assert!(off < bound, "{} {} {shaken}: {off:e}", kind.name(), space.name());
        }
    }
}

#[test]
fn two_rocks_in_one_grid_give_the_products_of_their_cell_matrices() {
    for kind in [ElementKind::Tri3, ElementKind::Quad4, ElementKind::Quad9] {
        let mut mesh = mesh::<2>(kind, 40, false);
        let cells = mesh.blocks.remove(0);
        let half = cells.connectivity.len() / kind.nodes() / 2 * kind.nodes();
        let (below, above) = cells.connectivity.split_at(half);
        mesh.blocks = [below, above].map(|part| Cells { kind, connectivity: part.to_vec() }).to_vec();
        let soft = Elastic::new(10e9, 0.3).unwrap();
        let space = Idealisation::PlaneStrain;
        let block =
            |k, rock: &Elastic| LinearBlock::new(&mesh, k, rock, space, Formulation::Standard).unwrap();
        let mut blocks = [block(0, &rock()), block(1, &soft)];
        let n = 2 * mesh.nodes.len();
        let u: Vec<f64> = (0..n).map(|k| (k as f64 * 0.7).sin()).collect();
        let (mut free, mut assembled) = (vec![0.0; n], vec![0.0; n]);
        MatrixFree::new(&mesh, 2, &blocks.each_ref().map(Some)).apply(&u, &mut free);
        for block in &mut blocks {
            block.residual(&u, Instant { time: 0.0, dt: 1.0 }, &mut assembled).unwrap();
        }
        let largest = assembled.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        let off = free.iter().zip(&assembled).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
        assert!(off < 1e-13, "{}: {off:e}", kind.name());
    }
}

#[test]
fn nodes_of_grids_are_computed_row_by_row_and_their_cells_belong_to_no_piece() {
    let entries = |shaken| {
        let mesh = mesh::<2>(ElementKind::Quad4, 40, shaken);
        let block =
            LinearBlock::new(&mesh, 0, &rock(), Idealisation::PlaneStrain, Formulation::Standard).unwrap();
        let product = MatrixFree::new(&mesh, 2, &[Some(&block)]);
        (product.starts[mesh.nodes.len()], mesh.nodes.len() as u32)
    };
    // The four corners have rows that no other node has.
    assert_eq!(entries(false), (4, 41 * 42));
    let (of_pieces, nodes) = entries(true);
    assert!(of_pieces >= nodes);
}

#[test]
fn a_grid_whose_numbers_follow_no_line_keeps_no_rows() {
    let mut mesh = mesh::<2>(ElementKind::Quad4, 40, false);
    let count = mesh.nodes.len();
    // Squares modulo a prime follow no line.
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&n| (n * n % 1721, n));
    let mut new = vec![0; count];
    order.iter().enumerate().for_each(|(k, &n)| new[n] = k);
    let old = mesh.nodes.clone();
    new.iter().zip(old).for_each(|(&k, x)| mesh.nodes[k] = x);
    mesh.blocks[0].connectivity.iter_mut().for_each(|n| *n = new[*n]);
    let block =
        LinearBlock::new(&mesh, 0, &rock(), Idealisation::PlaneStrain, Formulation::Standard).unwrap();
    let product = MatrixFree::new(&mesh, 2, &[Some(&block)]);
    assert!(product.stencils.is_empty());
}

#[test]
fn equal_cells_share_a_matrix_and_others_have_their_own() {
    let count = |shaken| {
        let mesh = mesh::<2>(ElementKind::Quad4, 30, shaken);
        let block =
            LinearBlock::new(&mesh, 0, &rock(), Idealisation::PlaneStrain, Formulation::BBar).unwrap();
        let product = MatrixFree::new(&mesh, 2, &[Some(&block)]);
        (product.cells(), product.matrices())
    };
    assert_eq!(count(false), (930, 1));
    assert_eq!(count(true), (930, 930));
}

#[test]
fn products_do_not_depend_on_the_number_of_threads() {
    let mesh = mesh::<2>(ElementKind::Quad4, 90, false);
    let block =
        LinearBlock::new(&mesh, 0, &rock(), Idealisation::PlaneStrain, Formulation::Standard).unwrap();
    let u: Vec<f64> = (0..2 * mesh.nodes.len()).map(|k| (k as f64 * 0.3).cos()).collect();
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let (mut product, mut f) = (MatrixFree::new(&mesh, 2, &[Some(&block)]), vec![0.0; u.len()]);
        pool.install(|| product.apply(&u, &mut f));
        f
    };
    assert_eq!(of(1), of(2));
}

#[test]
fn lumped_masses_sum_to_the_mass_and_are_positive_where_admitted() {
    let mesh = mesh::<2>(ElementKind::Quad9, 3, true);
    let masses = lumped::nodal_masses(&mesh, Idealisation::PlaneStrain, &[2700.0]).unwrap();
    assert!(masses.iter().all(|m| *m > 0.0));
    let refused = ElementKind::ALL.into_iter().filter(|k| lumped::admit(*k).is_err());
    let refused: Vec<&str> = refused.map(ElementKind::name).collect();
    assert_eq!(refused, ["tri6", "quad8", "tet10", "hex20", "wedge15"]);
}

#[test]
fn highest_frequency_of_square_cells_is_that_of_their_hourglass_or_pressure_mode() {
    // Antiplane square of side h: K has eigenvalues G (1, 1 and 2/3 for the hourglass), masses ρ h²/4: ω² = 4 c²/h².
    let mesh = mesh::<2>(ElementKind::Quad4, 8, false);
    let rock = rock();
    let block = LinearBlock::new(&mesh, 0, &rock, Idealisation::Antiplane, Formulation::Standard).unwrap();
    let highest = highest_frequency(&mesh, &[&block], &[2700.0]).unwrap();
    let speed = (rock.shear() / 2700.0).sqrt();
    assert!((highest.frequency / (2.0 * speed / 0.5) - 1.0).abs() < 1e-12, "{highest:?}");
}

#[test]
fn no_frequency_of_the_mesh_exceeds_that_of_its_cells() {
    let mesh = mesh::<2>(ElementKind::Tri3, 5, true);
    let block =
        LinearBlock::new(&mesh, 0, &rock(), Idealisation::PlaneStrain, Formulation::Standard).unwrap();
    let highest = highest_frequency(&mesh, &[&block], &[2700.0]).unwrap().frequency;
    let masses = lumped::nodal_masses(&mesh, Idealisation::PlaneStrain, &[2700.0]).unwrap();
    let n = 2 * mesh.nodes.len();
    let mut product = MatrixFree::new(&mesh, 2, &[Some(&block)]);
    let k = nalgebra::DMatrix::from_columns(
        &(0..n)
            .map(|j| {
                let (mut u, mut f) = (vec![0.0; n], vec![0.0; n]);
                u[j] = 1.0 / masses[j / 2].sqrt();
                product.apply(&u, &mut f);
                nalgebra::DVector::from_fn(n, |i, _| f[i] / masses[i / 2].sqrt())
            })
            .collect::<Vec<_>>(),
    );
    let assembled = k.symmetric_eigenvalues().max().sqrt();
    assert!(assembled <= highest && highest < 1.5 * assembled, "{assembled} {highest}");
}
