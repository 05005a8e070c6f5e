//! Errors of splitting a mesh.

/// Reasons why a mesh cannot be split along a surface. Faces are numbered from 0 in the list of their surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SplitError {
    /// No faces.
    #[error("the surface `{surface}` has no faces")]
    Empty {
        /// Surface.
        surface: String,
    },
    /// A side set that does not exist.
    #[error("there is no side set `{name}`; those that exist are {}", .existing.join(", "))]
    UnknownSet {
        /// Requested name.
        name: String,
        /// Existing sets.
        existing: Vec<String>,
    },
    /// A side set that exists already.
    #[error("the mesh already has a side set `{set}`; name the surface otherwise")]
    Exists {
        /// The set that splitting would overwrite.
        set: String,
    },
    /// A face that belongs to no cell.
    #[error("face {face} of the surface `{surface}`, nodes {nodes:?}, is no face of a cell")]
    NotAFace {
        /// Surface.
        surface: String,
        /// Face in the list of the surface.
        face: usize,
        /// Nodes as given.
        nodes: Vec<usize>,
    },
    /// A face with only one cell.
    #[error(
        "face {face} of the surface `{surface}`, nodes {nodes:?}, lies on the boundary of the body: a fault has cells on \
         both sides"
    )]
    Boundary {
        /// Surface.
        surface: String,
        /// Face in the list of the surface.
        face: usize,
        /// Nodes as given.
        nodes: Vec<usize>,
    },
    /// A face with more than two cells.
    #[error(
        "face {face} of the surface `{surface}`, nodes {nodes:?}, belongs to {cells} cells instead of two"
    )]
    Crowded {
        /// Surface.
        surface: String,
        /// Face in the list of the surface.
        face: usize,
        /// Nodes as given.
        nodes: Vec<usize>,
        /// Number of cells that have it.
        cells: usize,
    },
    /// A face given twice.
    #[error("face {face} of the surface `{surface}`, nodes {nodes:?}, was given before in `{before}`")]
    Twice {
        /// Surface.
        surface: String,
        /// Face in the list of the surface.
        face: usize,
        /// Nodes as given.
        nodes: Vec<usize>,
        /// Surface that already has it.
        before: String,
    },
    /// A surface with one side, such as a Moebius strip.
    #[error("the surface `{surface}` has no two sides: its orientation contradicts itself at face {face}")]
    NotOrientable {
        /// Surface.
        surface: String,
        /// Face at which it was detected.
        face: usize,
    },
    /// A direction that does not distinguish the sides.
    #[error(
        "the direction to the plus side of the surface `{surface}` does not cross it (cosine {cosine:.1e} with the mean \
         normal of the piece with face {face}); give one closer to the normal"
    )]
    Hint {
        /// Surface.
        surface: String,
        /// First face of the piece.
        face: usize,
        /// Cosine between the direction and the sum of normals.
        cosine: f64,
    },
    /// Connected pieces whose plus sides the rule without a direction puts on opposite sides.
    #[error(
        "pieces of the surface `{surface}` do not agree on a plus side: mean normals towards larger x are {} and {}",
        shown(&normals[0]), shown(&normals[1])
    )]
    Apart {
        /// Surface.
        surface: String,
        /// Mean normals of two pieces.
        normals: [Vec<f64>; 2],
    },
    /// All nodes are tips.
    #[error(
        "the surface `{surface}` cannot open: all its nodes lie on its tips; it needs at least two faces"
    )]
    Closed {
        /// Surface.
        surface: String,
    },
}

/// Components of a normal, with few digits.
fn shown(normal: &[f64]) -> String {
    let parts: Vec<String> = normal.iter().map(|c| format!("{c:.3}")).collect();
    format!("({})", parts.join(", "))
}
