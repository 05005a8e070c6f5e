//! Cells of faults as segments or plane polygons, with the parts of their borders that are ends of the fault.

use super::distance::{Position, edges_of};

/// A cell of a fault.
#[derive(Clone)]
pub(crate) struct Cell {
    pub fault: usize,
    /// Ends of a segment, or corners of a plane convex polygon, one after another \[m\].
    pub corners: Vec<Position>,
    /// Numbers of the corners within the fault: neighbours have some in common.
    pub vertices: Vec<usize>,
    /// True for the ends of a segment, or for the edges of a polygon, that no other cell of the fault has.
    pub rim: Vec<bool>,
    /// Distance of equal cells side by side \[m\].
    pub width: f64,
    /// Distances of both ends of a cell in the plane from the upper end of the fault, along it \[m\].
    pub along: Option<[f64; 2]>,
}

/// Distance over the width of a cell within which positions coincide: files have six digits of coordinates, and gaps that are meant are wider.
const TOGETHER: f64 = 1e-3;

impl Cell {
    /// Its image in the free surface y = 0.
    pub fn image(&self) -> Self {
        let corners = self.corners.iter().map(|x| Position::new(x[0], -x[1], x[2])).collect();
        Self { corners, ..self.clone() }
    }

    /// Mean position of the corners.
    pub fn centre(&self) -> Position {
        self.corners.iter().sum::<Position>() / self.corners.len() as f64
    }

    /// Least and largest coordinates.
    pub fn bounds(&self) -> [Position; 2] {
        let low = self.corners.iter().fold(Position::repeat(f64::INFINITY), |low, x| low.inf(x));
        [low, self.corners.iter().fold(Position::repeat(f64::NEG_INFINITY), |high, x| high.sup(x))]
    }

    /// Distance within which positions of two cells coincide \[m\].
    pub fn together(&self, other: &Self) -> f64 {
        TOGETHER * self.width.min(other.width)
    }

    /// True if another cell lies beyond an end or edge of the fault, at a position of this cell: on the outer side of the plane that is there
    /// normal to the cell.
    pub fn ends_before(&self, other: &Self, at: &Position) -> bool {
        let close = self.together(other);
        let outside = |outwards: Position, from: Position| {
            let outwards = outwards.normalize();
            other.corners.iter().all(|x| (x - from).dot(&outwards) >= -close)
        };
        if let [a, b] = self.corners[..] {
            let ends = [(a, a - b), (b, b - a)].into_iter().zip(&self.rim);
            return ends
                .filter(|((end, _), rim)| **rim && (end - at).norm() <= close)
                .any(|((end, way), _)| outside(way, end));
        }
        let centre = self.centre();
        edges_of(&self.corners).zip(&self.rim).filter(|(_, rim)| **rim).any(|(edge, _)| {
            let [a, b] = edge;
            let along = (b - a).normalize();
            let near = a + along * (at - a).dot(&along).clamp(0.0, (b - a).norm());
            let inwards = centre - a;
            let outwards = along * inwards.dot(&along) - inwards;
            (near - at).norm() <= close && outside(outwards, a)
        })
    }

    /// Corners that both cells have, as positions in their lists.
    pub fn common(&self, other: &Self) -> Vec<[usize; 2]> {
        let at = |v: &usize| other.vertices.iter().position(|w| w == v);
        self.vertices.iter().enumerate().filter_map(|(k, v)| Some([k, at(v)?])).collect()
    }

    /// Angle between two cells of one fault that have an end or an edge in common \[rad\]; flat where they continue each other.
    pub fn angle(&self, other: &Self, common: &[[usize; 2]]) -> Option<f64> {
        let away = |cell: &Self, own: &dyn Fn(&[usize; 2]) -> usize| {
            let apex: Vec<Position> = common.iter().map(|pair| cell.corners[own(pair)]).collect();
            let rest = cell.centre() - apex[0];
            match apex[..] {
                [_] => Some(rest),
                [a, b] => {
                    let edge = (b - a).normalize();
                    Some(rest - edge * rest.dot(&edge))
                }
                _ => None,
            }
        };
        let (one, two) =
            (away(self, &|pair: &[usize; 2]| pair[0])?, away(other, &|pair: &[usize; 2]| pair[1])?);
        Some(one.cross(&two).norm().atan2(one.dot(&two)))
    }

    /// Edge of a triangle opposite to one of its corners.
    pub fn opposite(&self, corner: usize) -> Option<[Position; 2]> {
        let [a, b, c] = self.corners[..] else { return None };
        Some([[b, c], [c, a], [a, b]][corner])
    }
}
