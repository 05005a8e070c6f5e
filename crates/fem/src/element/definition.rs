//! Definition of an element in one place: each element has a file with its definition.

use super::face::FaceKind;
use super::kind::ElementKind;
use super::shape::Shape;
use crate::quadrature::Point;

/// A face of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Kind.
    pub kind: FaceKind,
    /// Local nodes in the order of the kind. The body lies to the left of an edge; a face runs counter-clockwise seen from outside.
    pub nodes: &'static [usize],
}

/// An element in the meshes of another program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForeignElement<N: 'static> {
    /// Its numbers or names there.
    pub names: N,
    /// Position of each node, in the order of VTK, in the order of the other program; empty if both agree.
    pub order: &'static [usize],
}

/// An element.
#[derive(Clone, Copy, Debug)]
pub struct Definition {
    /// Name in scenes.
    pub name: &'static str,
    /// Dimension.
    pub dimension: usize,
    /// Degree of the complete polynomials contained in the shape functions: 1 or 2.
    pub order: usize,
    /// The element of first order on the same corners.
    pub linear: ElementKind,
    /// Number of corners: the first of the nodes.
    pub corners: usize,
    /// Natural coordinates of the nodes.
    pub nodes: &'static [[f64; 3]],
    /// Faces.
    pub faces: &'static [Face],
    /// Order of nodes that reverses a plane element: the same corners, traversed in the other direction.
    pub reversed: &'static [usize],
    /// Shape functions and their natural derivatives.
    pub shape: fn([f64; 3]) -> Shape,
    /// Quadrature that integrates the stiffness of the undistorted element exactly.
    pub quadrature: fn() -> Vec<Point>,
    /// Quadrature that integrates products N_a N_b over the undistorted element exactly.
    pub mass_quadrature: fn() -> Vec<Point>,
    /// Cell type number of VTK; its order of nodes is used in this crate.
    pub vtk: u8,
    /// Type number of Gmsh.
    pub gmsh: ForeignElement<i64>,
    /// Number after the family in types of Abaqus (CPE, CPS and CAX in the plane, C3D in space), and types of shells, membranes and rigid
    /// faces.
    pub abaqus: ForeignElement<(Option<&'static str>, &'static [&'static str])>,
    /// Corners of the faces S1, S2, ... of Abaqus.
    pub abaqus_faces: &'static [&'static [usize]],
}
