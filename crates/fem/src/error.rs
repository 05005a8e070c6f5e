//! Errors of the crate.

/// What can go wrong with a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FemError {
    /// A material parameter out of its range.
    #[error("{name} = {value:e} is not admissible: {admissible}")]
    Material {
        /// Parameter.
        name: &'static str,
        /// Given value.
        value: f64,
        /// What would be right.
        admissible: &'static str,
    },
    /// An element turned inside out or without volume.
    #[error(
        "cell {cell} of block {block} has the Jacobian determinant {determinant:e} (it must be positive)"
    )]
    Jacobian {
        /// Block of cells.
        block: usize,
        /// Cell in the block.
        cell: usize,
        /// Determinant \[m^D\].
        determinant: f64,
    },
    /// An element that does not exist.
    #[error(
        "there is no element `{0}`; those that exist are tri3, tri6, quad4, quad9 (plane), hex8, tet4 (3d)"
    )]
    UnknownElement(String),
    /// An element of the other dimension.
    #[error("element {element} is not {dimension}-dimensional")]
    Dimension {
        /// Element.
        element: &'static str,
        /// Dimension of the mesh.
        dimension: usize,
    },
    /// A generator's block that is no block.
    #[error("the block is empty along axis {axis}: from {min} m to {max} m in {divisions} elements")]
    Block {
        /// Axis.
        axis: usize,
        /// Lower end.
        min: f64,
        /// Upper end.
        max: f64,
        /// Elements.
        divisions: usize,
    },
    /// A size that does not divide a length.
    #[error("the size {size} m does not divide the length {length} m; {suggestion} m does")]
    Size {
        /// Given size.
        size: f64,
        /// Length.
        length: f64,
        /// Nearest size that divides.
        suggestion: f64,
    },
    /// A ratio of sizes that is not positive.
    #[error("the grading ratio {0} is not a positive number")]
    Grading(f64),
    /// A matrix that could not be factored.
    #[error("{0}")]
    Factorisation(String),
}
