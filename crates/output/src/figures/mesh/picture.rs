//! A mesh to be drawn, as values.

/// Condition on a set, or its part in a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mark {
    /// A displacement is held.
    Held,
    /// It moves, or a spring loads it.
    Moved,
    /// Tractions or a pressure act on it.
    Loaded,
    /// It absorbs waves.
    Absorbing,
    /// It is a side of an interface or a fault.
    Surface,
}

impl Mark {
    /// Style whose marker represents it: square, triangle, diamond, circle.
    pub(super) fn marker(self) -> Option<usize> {
        match self {
            Self::Held => Some(1),
            Self::Moved => Some(2),
            Self::Loaded => Some(3),
            Self::Absorbing => Some(0),
            Self::Surface => None,
        }
    }
}

/// A set of faces.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkedSet {
    /// Name with its uses.
    pub label: String,
    /// Its conditions.
    pub marks: Vec<Mark>,
    /// Corners of its faces \[m\]: lines in the plane.
    pub faces: Vec<Vec<[f64; 3]>>,
}

/// A mesh to be drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshPicture {
    /// Title of the scene.
    pub title: String,
    /// True for a mesh in space.
    pub in_space: bool,
    /// Corners of cells, in space of outer faces \[m\].
    pub faces: Vec<Vec<[f64; 3]>>,
    /// Names of the bodies and their middles \[m\].
    pub bodies: Vec<(String, [f64; 3])>,
    /// Sets that the scene uses.
    pub sets: Vec<MarkedSet>,
    /// Points of faults without bodies \[m\].
    pub points: Vec<[f64; 3]>,
    /// Stations \[m\].
    pub stations: Vec<[f64; 3]>,
}
