//! Stiffnesses on which direct solvers are compared: a block of quad4 or hex8, held on its left side.

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::sparse::{Part, ScatterMap};

/// Stiffness of the case `2d:N` or `3d:N`, a square or cube with about N equations.
///
/// # Errors
/// If `case` has another form.
pub fn stiffness(case: &str) -> Result<ScatterMap, String> {
    let wrong = || format!("`{case}` is no case: 2d:N or 3d:N");
    let (dimension, size) = case.split_once(':').ok_or_else(wrong)?;
    let size: f64 = size.parse().map_err(|_| wrong())?;
    match dimension {
        "2d" => Ok(block_stiffness::<2>(ElementKind::Quad4, (size / 2.0).sqrt())),
        "3d" => Ok(block_stiffness::<3>(ElementKind::Hex8, (size / 3.0).cbrt())),
        _ => Err(wrong()),
    }
}

/// Stiffness of a block with `divisions` elements (rounded) along each axis, so that as many node layers are free along
/// the first.
fn block_stiffness<const D: usize>(kind: ElementKind, divisions: f64) -> ScatterMap {
    let divisions = divisions.round() as usize;
    let block = Block {
        min: [0.0; D],
        max: [1.0; D],
        divisions: [divisions; D],
        grading: [Grading::Uniform; D],
        kind,
    };
    let mesh = block.mesh().expect("the block is well formed");
    let material = Elastic::new(50e9, 0.25).expect("an admissible material");
    let cells = LinearBlock::new(&mesh, 0, &material, Idealisation::from_dimension(D), Formulation::Standard)
        .expect("its cells are cubes");
    let left = mesh.nodes.iter().enumerate().filter(|(_, x)| x[0] == 0.0);
    let fixed = left.flat_map(|(n, _)| (0..D).map(move |i| n * D + i)).collect();
    let equations = Constraints { fixed, channels: Vec::new() }.equations(mesh.nodes.len() * D);
    let mut matrix =
        ScatterMap::new(&[asperity_fem::term::Linearized::pattern(&cells)], &equations, Part::Lower);
    matrix.add(0, cells.stiffness());
    matrix
}
