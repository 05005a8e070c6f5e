//! Errors of the crate.

/// Errors of a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FemError {
    /// A material parameter out of its range.
    #[error("{name} = {value:e} is not admissible: {admissible}")]
    Material {
        /// Parameter.
        name: &'static str,
        /// Given value.
        value: f64,
        /// Admissible values.
        admissible: &'static str,
    },
    /// An element that is inverted or without volume.
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
    /// An element whose lumped masses are not all positive.
    #[error(
        "{element} has no positive lumped masses: the integrals of its shape functions at the corners are zero or negative"
    )]
    LumpedMass {
        /// Element.
        element: &'static str,
    },
    /// Threads that the system does not provide.
    #[error("threads for the elimination cannot be had: {0}")]
    Threads(String),
    /// An element that does not exist.
    #[error(
        "there is no element `{0}`; those that exist are tri3, tri6, quad4, quad8, quad9 (plane), tet4, tet10, \
         hex8, hex20, hex27, wedge6, wedge15 (3d)"
    )]
    UnknownElement(String),
    /// An element of a different dimension from the mesh.
    #[error("element {element} is not {dimension}-dimensional")]
    Dimension {
        /// Element.
        element: &'static str,
        /// Dimension of the mesh.
        dimension: usize,
    },
    /// An idealisation that is unsuitable.
    #[error("{idealisation}: {reason}")]
    Idealisation {
        /// Idealisation.
        idealisation: &'static str,
        /// Reason.
        reason: &'static str,
    },
    /// A vector with the wrong number of components.
    #[error("{idealisation} has {expected} components of displacement, not {given}")]
    Components {
        /// Idealisation.
        idealisation: &'static str,
        /// Expected number of components.
        expected: usize,
        /// Given number of components.
        given: usize,
    },
    /// A node on the wrong side of the axis of revolution.
    #[error("node {node} has the radius {radius} m: in an axisymmetric body x is the radius, 0 or more")]
    Radius {
        /// Node.
        node: usize,
        /// Its x \[m\].
        radius: f64,
    },
    /// A formulation that is unsuitable for an element.
    #[error("B-bar for {element}: {reason}")]
    Formulation {
        /// Element.
        element: &'static str,
        /// Reason, and the formulation to use instead.
        reason: &'static str,
    },
    /// Faces whose shape functions have integrals that are zero or negative.
    #[error(
        "faces of {element} have nodal areas that are zero or negative, so that their nodes cannot represent areas: take \
         elements of first order, quad9 or hex27, or integrate over the faces"
    )]
    NodalAreas {
        /// Element.
        element: &'static str,
    },
    /// A generator block that is invalid.
    #[error("the block is empty along axis {axis}: from {min} m to {max} m in {divisions} elements")]
    Block {
        /// Axis.
        axis: usize,
        /// Lower end.
        min: f64,
        /// Upper end.
        max: f64,
        /// Number of elements.
        divisions: usize,
    },
    /// A size that does not divide a length evenly.
    #[error("the size {size} m does not divide the length {length} m; {suggestion} m does")]
    Size {
        /// Given size.
        size: f64,
        /// Length.
        length: f64,
        /// Nearest size that divides evenly.
        suggestion: f64,
    },
    /// A ratio of sizes that is not positive.
    #[error("the grading ratio {0} is not a positive number")]
    Grading(f64),
    /// A line of a grid that does not ascend.
    #[error(
        "grid line {index} along axis {axis} is not above the one before it, or there are fewer than two"
    )]
    GridLine {
        /// Axis.
        axis: usize,
        /// Number of the line, from 0.
        index: usize,
    },
    /// A side that cannot be curved in the requested way.
    #[error("curved side `{side}`: {reason}")]
    Curve {
        /// Side.
        side: &'static str,
        /// Reason.
        reason: String,
    },
    /// A matrix that could not be factored.
    #[error("{0}")]
    Factorisation(String),
    /// A tangent that is singular, or not positive definite where it must be. The pivot's `equation` is a degree of freedom.
    #[error(
        "the tangent is {}: degree of freedom {} is not held (pivot {:e}, diagonal {:e})",
        if *.singular { "singular" } else { "not positive definite" },
        .pivot.equation, .pivot.pivot, .pivot.diagonal
    )]
    Unheld {
        /// Singular, or not positive definite.
        singular: bool,
        /// Pivot at which this was found.
        pivot: Pivot,
    },
    /// The iterative solver gave up.
    #[error("iterative solution: {0}")]
    NotConverged(crate::outcome::Outcome),
    /// A symmetric matrix that the direct solver could not factor.
    #[error(transparent)]
    Direct(#[from] DirectError),
}

impl FemError {
    /// The pivot of a matrix that could not be factored. Its `equation` is a degree of freedom in [`FemError::Unheld`] and in
    /// errors of a condensation (there, of the body).
    #[must_use]
    pub fn pivot(&self) -> Option<Pivot> {
        match self {
            Self::Unheld { pivot, .. } => Some(*pivot),
            Self::Direct(error) => error.pivot(),
            _ => None,
        }
    }

    /// True if the error reports a singular matrix, that is a free motion, rather than negative energy.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        match self {
            Self::Unheld { singular, .. } => *singular,
            Self::Direct(error) => matches!(error, DirectError::Singular(_)),
            _ => false,
        }
    }
}

/// A pivot that cannot be used as a divisor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pivot {
    /// Equation, in the numbering of the matrix.
    pub equation: usize,
    /// Diagonal entry after the elimination.
    pub pivot: f64,
    /// Diagonal entry of the matrix.
    pub diagonal: f64,
}

/// Reasons why a matrix was not factored.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DirectError {
    /// A negative pivot, or one that is not a number.
    #[error(
        "the matrix is not positive definite: equation {} has the pivot {:e} (diagonal {:e})",
        .0.equation, .0.pivot, .0.diagonal
    )]
    NotPositive(Pivot),
    /// A pivot of the size of rounding: a motion that nothing resists.
    #[error(
        "the matrix is singular: equation {} is not held, its pivot {:e} is rounding of its diagonal {:e}",
        .0.equation, .0.pivot, .0.diagonal
    )]
    Singular(Pivot),
    /// More memory than allowed.
    #[error(
        "the direct solver needs {:.2} GiB for {equations} equations, {:.2} GiB are allowed",
        gibibytes(*.needed), gibibytes(*.allowed)
    )]
    Memory {
        /// Memory needed \[bytes\].
        needed: usize,
        /// Memory allowed \[bytes\].
        allowed: usize,
        /// Number of equations.
        equations: usize,
    },
    /// The operating system refused memory.
    #[error("the system has no memory left for the direct solver")]
    OutOfMemory,
    /// No order of elimination.
    #[error("{0}")]
    Ordering(String),
}

impl DirectError {
    /// The same error with the equation in another numbering.
    #[must_use]
    pub fn renumbered(self, number: impl Fn(usize) -> usize) -> Self {
        let other = |p: Pivot| Pivot { equation: number(p.equation), ..p };
        match self {
            Self::NotPositive(p) => Self::NotPositive(other(p)),
            Self::Singular(p) => Self::Singular(other(p)),
            same => same,
        }
    }

    /// The pivot in question.
    #[must_use]
    pub fn pivot(&self) -> Option<Pivot> {
        match self {
            Self::NotPositive(p) | Self::Singular(p) => Some(*p),
            _ => None,
        }
    }
}

fn gibibytes(bytes: usize) -> f64 {
    bytes as f64 / f64::from(1 << 30)
}
