//! Kinds of element.

/// Kinds of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ElementKind {
    /// Linear triangle.
    Tri3,
    /// Quadratic triangle.
    Tri6,
    /// Bilinear quadrilateral.
    Quad4,
    /// Serendipity quadrilateral.
    Quad8,
    /// Biquadratic quadrilateral.
    Quad9,
    /// Linear tetrahedron.
    Tet4,
    /// Quadratic tetrahedron.
    Tet10,
    /// Trilinear hexahedron.
    Hex8,
    /// Serendipity hexahedron.
    Hex20,
    /// Triquadratic hexahedron.
    Hex27,
    /// Linear wedge (prism).
    Wedge6,
    /// Serendipity wedge (prism).
    Wedge15,
}

impl ElementKind {
    /// All kinds.
    pub const ALL: [Self; 12] = [
        Self::Tri3,
        Self::Tri6,
        Self::Quad4,
        Self::Quad8,
        Self::Quad9,
        Self::Tet4,
        Self::Tet10,
        Self::Hex8,
        Self::Hex20,
        Self::Hex27,
        Self::Wedge6,
        Self::Wedge15,
    ];
}
