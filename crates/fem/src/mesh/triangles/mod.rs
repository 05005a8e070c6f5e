//! Surfaces of triangles in space, from the data of a mesh file.

mod error;
mod orient;

pub use error::TriangleError;

use super::MeshError;
use super::error::Holder;
use super::raw::{Options, RawBlock, RawMesh, Shape};
use crate::element::ElementKind;
use crate::vector::length;
use std::collections::BTreeMap;

/// Least height of a triangle over its longest side; a flatter one has no area beyond the rounding of coordinates that are
/// written with six digits.
const FLAT: f64 = 1e-6;

/// A surface of triangles. Within each connected piece, the triangles have the same orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangles {
    /// Positions \[m\]; some may belong to no triangle.
    pub nodes: Vec<[f64; 3]>,
    /// Corners, as indices into `nodes`, anticlockwise as seen from the plus side.
    pub corners: Vec<[usize; 3]>,
    /// Numbers of the elements in the file.
    pub elements: Vec<u64>,
    /// Triangles of each connected piece.
    pub pieces: Vec<Vec<usize>>,
    /// Number of triangles that the file orients against most of their piece.
    pub turned: usize,
}

impl Triangles {
    /// Triangles of a file: those in the groups of these names, or all.
    ///
    /// # Errors
    /// [`TriangleError`] if the elements are no triangles, or if these form no surface with two sides.
    pub fn new(raw: &RawMesh, options: &Options, groups: Option<&[&str]>) -> Result<Self, TriangleError> {
        options.check()?;
        let blocks = chosen(raw, options, groups)?;
        let index: BTreeMap<u64, usize> = raw.nodes.iter().enumerate().map(|(k, n)| (n.tag, k)).collect();
        let unit = options.length_unit;
        for node in &raw.nodes {
            if let Some(axis) = node.x.iter().position(|c| !(c * unit).is_finite()) {
                let (node, value) = (node.tag, node.x[axis]);
                return Err(MeshError::Coordinate { node, axis, value }.into());
            }
        }
        let mut all = Self {
            nodes: raw.nodes.iter().map(|n| n.x.map(|c| c * unit)).collect(),
            corners: Vec::new(),
            elements: Vec::new(),
            pieces: Vec::new(),
            turned: 0,
        };
        let mut seen: BTreeMap<[usize; 3], u64> = BTreeMap::new();
        for block in blocks {
            for (k, &element) in block.tags.iter().enumerate() {
                let corners = corners(block, k, &index)?;
                let mut sorted = corners;
                sorted.sort_unstable();
                match seen.insert(sorted, element) {
                    // Formats that repeat an element for each of its groups.
                    Some(_) if raw.repeats => continue,
                    Some(first) if first == element => continue,
                    Some(first) => return Err(TriangleError::Twice { first, second: element }),
                    None => {}
                }
                all.corners.push(corners);
                all.elements.push(element);
                all.check_last()?;
            }
        }
        if all.corners.is_empty() {
            return Err(TriangleError::Empty);
        }
        let found = orient::orient(&mut all.corners, &all.elements)?;
        (all.pieces, all.turned) = (found.pieces, found.turned);
        Ok(all)
    }

    /// Positions of the corners of a triangle \[m\].
    #[must_use]
    pub fn positions(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.corners[triangle].map(|n| self.nodes[n])
    }

    /// Sum of the areas of a piece times their normals, and the sum of the areas \[m²\].
    #[must_use]
    pub fn area(&self, piece: usize) -> ([f64; 3], f64) {
        let mut sum = ([0.0; 3], 0.0);
        for &k in &self.pieces[piece] {
            let vector = vector(&self.positions(k));
            (0..3).for_each(|c| sum.0[c] += vector[c]);
            sum.1 += length(&vector);
        }
        sum
    }

    /// Turns all triangles of a piece.
    pub fn turn(&mut self, piece: usize) {
        for &k in &self.pieces[piece] {
            self.corners[k].swap(1, 2);
        }
    }

    fn check_last(&self) -> Result<(), TriangleError> {
        let last = self.corners.len() - 1;
        let corners = self.positions(last);
        let side = |k: usize| {
            let (a, b) = (&corners[k], &corners[(k + 1) % 3]);
            length::<3>(&std::array::from_fn(|c| b[c] - a[c]))
        };
        let longest = side(0).max(side(1)).max(side(2));
        if 2.0 * length(&vector(&corners)) > FLAT * longest * longest {
            return Ok(());
        }
        Err(TriangleError::Flat { element: self.elements[last], corners })
    }
}

/// Area of a triangle times its normal \[m²\].
fn vector([a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let (p, q): ([f64; 3], [f64; 3]) =
        (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        0.5 * (p[i] * q[j] - p[j] * q[i])
    })
}

/// Blocks of surface elements in the groups of these names, or all.
fn chosen<'a>(
    raw: &'a RawMesh,
    options: &Options,
    groups: Option<&[&str]>,
) -> Result<Vec<&'a RawBlock>, TriangleError> {
    let names = raw.group_names(options)?;
    let filled = || raw.blocks.iter().filter(|b| !b.tags.is_empty());
    let surfaces: Vec<&RawBlock> = filled().filter(|b| b.shape.dimension() == 2).collect();
    let Some(groups) = groups else {
        return match filled().find(|b| b.shape.dimension() == 3) {
            Some(solid) => Err(TriangleError::Solid { element: solid.tags[0] }),
            None => Ok(surfaces),
        };
    };
    let is_in =
        |block: &RawBlock, name: &str| block.groups.iter().any(|&g| names[g].iter().any(|n| n == name));
    for name in groups {
        if !surfaces.iter().any(|block| is_in(block, name)) {
            let mut present: Vec<String> =
                surfaces.iter().flat_map(|b| &b.groups).flat_map(|&g| names[g].clone()).collect();
            present.sort();
            present.dedup();
            return Err(TriangleError::MissingGroup { name: (*name).to_string(), present });
        }
    }
    Ok(surfaces.into_iter().filter(|block| groups.iter().any(|name| is_in(block, name))).collect())
}

/// Corners of an element.
fn corners(block: &RawBlock, k: usize, index: &BTreeMap<u64, usize>) -> Result<[usize; 3], TriangleError> {
    let element = block.tags[k];
    if block.shape != Shape::Cell(ElementKind::Tri3) {
        return Err(TriangleError::Shape { element, shape: block.shape.name() });
    }
    let mut corners = [0; 3];
    for (corner, &node) in corners.iter_mut().zip(block.element(k)) {
        let holder = Holder::Element(element);
        *corner = *index.get(&node).ok_or(MeshError::DanglingNode { holder, node })?;
    }
    Ok(corners)
}

#[cfg(test)]
mod tests {
    use super::{Options, TriangleError, Triangles};
    use crate::mesh::{RawMesh, stl};

    /// Triangles as a text of STL.
    fn raw(triangles: &[[[f64; 3]; 3]]) -> RawMesh {
        let mut text = "solid s\n".to_string();
        for triangle in triangles {
            text += "facet\n";
            for [x, y, z] in triangle {
                text += &format!("vertex {x} {y} {z}\n");
            }
            text += "endfacet\n";
        }
        stl::parse((text + "endsolid\n").as_bytes()).unwrap()
    }

    fn surface(triangles: &[[[f64; 3]; 3]]) -> Result<Triangles, TriangleError> {
        Triangles::new(&raw(triangles), &Options::default(), None)
    }

    const A: [f64; 3] = [0.0, 0.0, 0.0];
    const B: [f64; 3] = [1.0, 0.0, 0.0];
    const C: [f64; 3] = [1.0, 1.0, 0.0];
    const D: [f64; 3] = [0.0, 1.0, 0.0];
    const E: [f64; 3] = [2.0, 1.0, 0.0];

    #[test]
    fn a_triangle_against_the_others_of_its_piece_is_turned() {
        let found = surface(&[[A, B, C], [A, D, C], [B, E, C]]).unwrap();
        assert_eq!((found.turned, found.pieces.len()), (1, 1));
        assert_eq!(found.area(0), ([0.0, 0.0, 1.5], 1.5));
        // The first one, if it is the exception.
        let found = surface(&[[A, C, B], [A, C, D], [B, E, C]]).unwrap();
        assert_eq!((found.turned, found.area(0).0[2]), (1, 1.5));
    }

    #[test]
    fn parts_without_common_sides_are_pieces_of_their_own() {
        let far = [A, B, C].map(|[x, y, z]| [x + 5.0, y, z]);
        let mut found = surface(&[[A, B, C], far]).unwrap();
        assert_eq!(found.pieces, [vec![0], vec![1]]);
        found.turn(1);
        assert_eq!([found.area(0).0[2], found.area(1).0[2]], [0.5, -0.5]);
    }

    #[test]
    fn elements_that_form_no_surface_are_refused_by_their_numbers() {
        let up = [0.5, 0.5, 1.0];
        assert_eq!(
            surface(&[[A, B, C], [A, C, D], [A, C, up]]),
            Err(TriangleError::Branch { elements: [1, 2, 3] })
        );
        assert_eq!(surface(&[[A, B, C], [C, A, B]]), Err(TriangleError::Twice { first: 1, second: 2 }));
        let middle = [0.5, 0.0, 0.0];
        assert!(matches!(surface(&[[A, middle, B]]), Err(TriangleError::Flat { element: 1, .. })));
        assert!(matches!(surface(&[[A, B, B]]), Err(TriangleError::Flat { element: 1, .. })));
        let unknown = Triangles::new(&raw(&[[A, B, C]]), &Options::default(), Some(&["t"]));
        assert_eq!(unknown, Err(TriangleError::MissingGroup { name: "t".into(), present: vec!["s".into()] }));
        assert_eq!(surface(&[]), Err(TriangleError::Empty));
    }

    #[test]
    fn a_strip_with_one_side_is_refused() {
        // Three quadrilaterals in a ring with a half turn.
        let at = |k: f64, s: f64| {
            let (turn, angle) = (k * std::f64::consts::PI / 5.0, k * std::f64::consts::TAU / 5.0);
            let r = 3.0 + s * turn.cos();
            [r * angle.cos(), r * angle.sin(), s * turn.sin()].map(|c| (c * 1e6).round() / 1e6)
        };
        let mut all = Vec::new();
        for k in 0..5 {
            let (k, sign) = (f64::from(k), if k == 4 { -1.0 } else { 1.0 });
            let next = if k == 4.0 { 0.0 } else { k + 1.0 };
            let (a, b) = (at(k, -1.0), at(k, 1.0));
            let (c, d) = (at(next, sign), at(next, -sign));
            all.extend([[a, b, c], [a, c, d]]);
        }
        assert!(matches!(surface(&all), Err(TriangleError::OneSided { .. })));
    }
}
