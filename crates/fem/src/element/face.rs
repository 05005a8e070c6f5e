//! Faces of elements: their kinds, and shape functions with first and second derivatives.
//!
//! Natural coordinates: ξ in [-1, 1] on lines and quadrilaterals, ξ_1, ξ_2 ≥ 0 with ξ_1 + ξ_2 ≤ 1 on triangles.

use super::kind::ElementKind;
use std::fmt;

/// Kinds of face of an element. Node orders: corners first, then mid-nodes of the edges 12, 23, ..., then the centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaceKind {
    /// Straight line of 2 nodes.
    Seg2,
    /// Line of 3 nodes (ends, middle).
    Seg3,
    /// Flat triangle.
    Tri3,
    /// Triangle of 6 nodes.
    Tri6,
    /// Bilinear quadrilateral.
    Quad4,
    /// Serendipity quadrilateral of 8 nodes.
    Quad8,
    /// Biquadratic quadrilateral of 9 nodes.
    Quad9,
}

impl FaceKind {
    /// Number of nodes.
    #[must_use]
    pub fn nodes(self) -> usize {
        match self {
            Self::Seg2 => 2,
            Self::Seg3 | Self::Tri3 => 3,
            Self::Quad4 => 4,
            Self::Tri6 => 6,
            Self::Quad8 => 8,
            Self::Quad9 => 9,
        }
    }

    /// Number of corners: the first of the nodes.
    #[must_use]
    pub fn corners(self) -> usize {
        match self {
            Self::Seg2 | Self::Seg3 => 2,
            Self::Tri3 | Self::Tri6 => 3,
            Self::Quad4 | Self::Quad8 | Self::Quad9 => 4,
        }
    }

    /// The plane element of the same nodes; `None` for a line.
    #[must_use]
    pub fn element(self) -> Option<ElementKind> {
        match self {
            Self::Seg2 | Self::Seg3 => None,
            Self::Tri3 => Some(ElementKind::Tri3),
            Self::Tri6 => Some(ElementKind::Tri6),
            Self::Quad4 => Some(ElementKind::Quad4),
            Self::Quad8 => Some(ElementKind::Quad8),
            Self::Quad9 => Some(ElementKind::Quad9),
        }
    }

    /// True if the integrals of all its shape functions are positive, so that areas can be assigned to its nodes. A flat tri6 has zero at
    /// its corners, a quad8 -1/12 of its area.
    #[must_use]
    pub fn shares_area(self) -> bool {
        !matches!(self, Self::Tri6 | Self::Quad8)
    }

    /// Dimension of the space whose boundary the face is part of.
    #[must_use]
    pub fn space(self) -> usize {
        match self {
            Self::Seg2 | Self::Seg3 => 2,
            Self::Tri3 | Self::Tri6 | Self::Quad4 | Self::Quad8 | Self::Quad9 => 3,
        }
    }

    /// True if its edges are straight.
    #[must_use]
    pub fn first_order(self) -> bool {
        matches!(self, Self::Seg2 | Self::Tri3 | Self::Quad4)
    }
}

impl fmt::Display for FaceKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Seg2 => "seg2",
            Self::Seg3 => "seg3",
            Self::Tri3 => "tri3",
            Self::Tri6 => "tri6",
            Self::Quad4 => "quad4",
            Self::Quad8 => "quad8",
            Self::Quad9 => "quad9",
        })
    }
}

/// Largest number of nodes of a face.
pub const MOST_NODES: usize = 9;

/// Corners of `kind`.
#[must_use]
pub fn corners(kind: FaceKind) -> usize {
    kind.corners()
}

/// Values and derivatives at one point; entries beyond the nodes of the face are zero.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// N_γ.
    pub value: [f64; MOST_NODES],
    /// N_γ,m for m = 1, 2 (the second is zero on lines).
    pub first: [[f64; MOST_NODES]; 2],
    /// N_γ,11, N_γ,12, N_γ,22.
    pub second: [[f64; MOST_NODES]; 3],
}

/// Quadratic Lagrange polynomials on -1, 1, 0 (ends, middle) with derivatives.
fn quadratic(x: f64) -> [[f64; 3]; 3] {
    [
        [0.5 * x * (x - 1.0), 0.5 * x * (x + 1.0), (1.0 - x) * (1.0 + x)],
        [x - 0.5, x + 0.5, -2.0 * x],
        [1.0, 1.0, -2.0],
    ]
}

/// Linear Lagrange polynomials on -1, 1 with derivatives.
fn linear(x: f64) -> [[f64; 3]; 3] {
    [[0.5 * (1.0 - x), 0.5 * (1.0 + x), 0.0], [-0.5, 0.5, 0.0], [0.0; 3]]
}

/// Positions of quadrilateral nodes as indices into the one-dimensional polynomials (end, end, middle).
const QUAD: [[usize; 2]; 9] = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0], [1, 2], [2, 1], [0, 2], [2, 2]];

/// Shape functions of `kind` at `xi`.
#[must_use]
pub fn shape(kind: FaceKind, xi: [f64; 2]) -> Shape {
    let mut s = Shape { value: [0.0; 9], first: [[0.0; 9]; 2], second: [[0.0; 9]; 3] };
    match kind {
        FaceKind::Seg2 => line(&mut s, &linear(xi[0]), 2),
        FaceKind::Seg3 => line(&mut s, &quadratic(xi[0]), 3),
        FaceKind::Quad4 => product(&mut s, &linear(xi[0]), &linear(xi[1]), 4),
        FaceKind::Quad9 => product(&mut s, &quadratic(xi[0]), &quadratic(xi[1]), 9),
        FaceKind::Tri3 => {
            s.value[..3].copy_from_slice(&[1.0 - xi[0] - xi[1], xi[0], xi[1]]);
            s.first[0][..3].copy_from_slice(&[-1.0, 1.0, 0.0]);
            s.first[1][..3].copy_from_slice(&[-1.0, 0.0, 1.0]);
        }
        FaceKind::Tri6 => triangle(&mut s, xi),
        FaceKind::Quad8 => serendipity(&mut s, xi),
    }
    s
}

/// Eight-node quadrilateral: the biquadratic functions without the centre, completed by `N_k + c_k N_9` with c = -1/4 at
/// corners and 1/2 at mid-nodes.
fn serendipity(s: &mut Shape, xi: [f64; 2]) {
    product(s, &quadratic(xi[0]), &quadratic(xi[1]), 9);
    let spread = |v: &mut [f64; MOST_NODES]| {
        let centre = std::mem::take(&mut v[8]);
        for (k, v) in v[..8].iter_mut().enumerate() {
            *v += if k < 4 { -0.25 * centre } else { 0.5 * centre };
        }
    };
    spread(&mut s.value);
    s.first.iter_mut().for_each(spread);
    s.second.iter_mut().for_each(spread);
}

fn line(s: &mut Shape, p: &[[f64; 3]; 3], n: usize) {
    s.value[..n].copy_from_slice(&p[0][..n]);
    s.first[0][..n].copy_from_slice(&p[1][..n]);
    s.second[0][..n].copy_from_slice(&p[2][..n]);
}

fn product(s: &mut Shape, p: &[[f64; 3]; 3], q: &[[f64; 3]; 3], n: usize) {
    for (k, [i, j]) in QUAD.iter().copied().enumerate().take(n) {
        s.value[k] = p[0][i] * q[0][j];
        s.first[0][k] = p[1][i] * q[0][j];
        s.first[1][k] = p[0][i] * q[1][j];
        s.second[0][k] = p[2][i] * q[0][j];
        s.second[1][k] = p[1][i] * q[1][j];
        s.second[2][k] = p[0][i] * q[2][j];
    }
}

/// Six-node triangle from its barycentric coordinates L: corners L(2L - 1), middles 4 L_a L_b.
fn triangle(s: &mut Shape, xi: [f64; 2]) {
    let l = [1.0 - xi[0] - xi[1], xi[0], xi[1]];
    let d = [[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]];
    let pairs = [(0, 0), (0, 1), (1, 1)];
    for a in 0..3 {
        let b = (a + 1) % 3;
        s.value[a] = l[a] * (2.0 * l[a] - 1.0);
        s.value[3 + a] = 4.0 * l[a] * l[b];
        for (first, dm) in s.first.iter_mut().zip(&d) {
            first[a] = (4.0 * l[a] - 1.0) * dm[a];
            first[3 + a] = 4.0 * (dm[a] * l[b] + l[a] * dm[b]);
        }
        for (k, &(m, n)) in pairs.iter().enumerate() {
            s.second[k][a] = 4.0 * d[m][a] * d[n][a];
            s.second[k][3 + a] = 4.0 * (d[m][a] * d[n][b] + d[n][a] * d[m][b]);
        }
    }
}
