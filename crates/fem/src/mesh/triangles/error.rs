//! Errors of a surface of triangles.

use crate::mesh::MeshError;

/// Reasons why elements of a file form no surface of triangles. Elements are named by their numbers in the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TriangleError {
    /// The data of the file are inconsistent.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A requested group without surface elements.
    #[error("there are no surface elements in a group `{name}`")]
    MissingGroup {
        /// Requested group.
        name: String,
        /// Groups of surface elements.
        present: Vec<String>,
    },
    /// A file with elements that fill space, without a choice of surfaces.
    #[error(
        "the file has elements that fill space, such as element {element}, and no group of surface elements is named"
    )]
    Solid {
        /// The first of them.
        element: u64,
    },
    /// No surface elements.
    #[error("there are no triangles")]
    Empty,
    /// An element of another shape.
    #[error("element {element} is a {shape}, and a fault consists of straight triangles, tri3")]
    Shape {
        /// Element.
        element: u64,
        /// Its shape.
        shape: &'static str,
    },
    /// A triangle without area.
    #[error("element {element} has no area: its corners {} lie on a line", listed(.corners))]
    Flat {
        /// Element.
        element: u64,
        /// Its corners \[m\].
        corners: [[f64; 3]; 3],
    },
    /// Two elements with the same corners.
    #[error("elements {first} and {second} have the same corners")]
    Twice {
        /// The first one.
        first: u64,
        /// The second one.
        second: u64,
    },
    /// A side of more than two elements.
    #[error("the surface branches: elements {}, {} and {} have a side in common", .elements[0], .elements[1], .elements[2])]
    Branch {
        /// Three of them.
        elements: [u64; 3],
    },
    /// A surface with one side only.
    #[error(
        "the surface around element {element} has one side only, as a Moebius strip: its triangles have no common orientation"
    )]
    OneSided {
        /// An element at which the orientations contradict each other.
        element: u64,
    },
}

fn listed(corners: &[[f64; 3]; 3]) -> String {
    let one = |[x, y, z]: &[f64; 3]| format!("({x}, {y}, {z}) m");
    format!("{}, {} and {}", one(&corners[0]), one(&corners[1]), one(&corners[2]))
}
