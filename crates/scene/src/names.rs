//! Names used in scenes for elements and sides, which have their own types in the finite-element crates.

/// Names of elements, with their dimensions.
pub const ELEMENTS: [(&str, usize); 12] = [
    ("tri3", 2),
    ("tri6", 2),
    ("quad4", 2),
    ("quad8", 2),
    ("quad9", 2),
    ("tet4", 3),
    ("tet10", 3),
    ("hex8", 3),
    ("hex20", 3),
    ("hex27", 3),
    ("wedge6", 3),
    ("wedge15", 3),
];

/// Sides of rectangular blocks: lower and upper end of each axis.
pub const SIDES: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["back", "front"]];
