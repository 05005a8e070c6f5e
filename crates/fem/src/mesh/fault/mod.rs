//! Graded quadrilateral meshes around a fault in the plane, generated without an external program.
//!
//! The grid is structured. One of its columns of edges holds the fault and its continuation to the bottom and the top of the
//! box; rows extend from the left to the right side. Cells at the fault are rectangles, except close to the free surface, where
//! rows turn horizontal and cells become parallelograms with the angle of the dip ([`map`] has the formulas).
//!
//! Along a flat fault such cells would be needles. A row of edges holds it instead ([`layers`]).

mod check;
mod curve;
mod divided_line;
mod error;
mod grid;
mod layers;
mod map;
mod quality;
mod spec;
mod spine;
mod stack;

pub use super::spacing::{MOST_CELLS, Spacing, SpacingError};
pub use curve::Departure;
pub use divided_line::{DividedLine, divided};
pub use error::{Dip, FaultMeshError};
pub use quality::{Quality, quality, scaled_jacobian};
pub use spec::{FaultMesh, Interpolation};

use super::split::{Fault, Surface, split};
use super::{Mesh, spacing};
use check::Course;
use curve::Curve;
use map::Map;
use spine::Spine;

/// Positions along a fault \[m\].
type Line = Vec<[f64; 2]>;

/// A mesh before it is split, the shape of its cells, and the edges of its fault as nodes.
type UnsplitMesh = (Mesh<2>, Quality, Vec<Vec<usize>>);

/// A mesh that is split along its fault.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitMesh {
    /// The mesh, with the side sets left, right, bottom, top, fault.minus (the side of smaller x) and fault.plus.
    pub mesh: Mesh<2>,
    /// Pairs of nodes in the direction of the trace.
    pub fault: Fault,
    /// Distance of each pair from the first vertex, along the fault \[m\].
    pub along: Vec<f64>,
    /// Shape of the cells.
    pub quality: Quality,
}

impl FaultMesh {
    /// Generates the mesh.
    ///
    /// # Errors
    /// See [`FaultMeshError`].
    pub fn mesh(&self) -> Result<SplitMesh, FaultMeshError> {
        let trace = check::trace(self)?;
        // The grid runs from the highest vertex down; distances along the fault keep the given direction.
        let downwards = trace[0][1] > trace[trace.len() - 1][1];
        let (mut along, mut places, mut vertices) = self.line(&trace)?;
        if !downwards {
            vertices.reverse();
        } else {
            places.reverse();
        }
        let course = check::course(&trace, &places)?;
        let (mut mesh, quality, mut faces) = match course {
            Course::Steep => self.grid(vertices, &along, &places)?,
            Course::Flat => self.layers(&vertices, &along, &places)?,
        };
        // From minus to plus, also where the fault is nearly horizontal: to the right is upwards if it falls to the right.
        let up = if places[0][0] > places[places.len() - 1][0] { 1.0 } else { -1.0 };
        let towards_plus = Some(match course {
            Course::Steep => [1.0, 0.0],
            Course::Flat => [0.0, up],
        });
        if downwards {
            faces.reverse();
        }
        let surface = Surface { name: "fault".to_string(), faces, towards_plus };
        let fault = split(&mut mesh, &[surface])?.remove(0);
        if fault.pairs.len() > along.len() {
            along = with_middles(&along);
        }
        Ok(SplitMesh { mesh, fault, along, quality })
    }

    /// The mesh before splitting, the shape of its cells, and the edges of the fault from its lower tip: the fault in a column.
    fn grid(
        &self,
        vertices: Line,
        along: &[f64],
        places: &[[f64; 2]],
    ) -> Result<UnsplitMesh, FaultMeshError> {
        let spine = Spine::new(vertices, [self.min[0], self.max[0]]);
        let map = Map::new(&spine, [self.min[0], self.max[0]]);
        let rows = self.rows(places)?;
        let columns = self.columns(&map, along, &spine)?;
        let grid = grid::Grid::new(self, &map, &spine, &rows, &columns, places)?;
        let mesh = grid.mesh(self);
        let quality = grid.check(self, &mesh)?;
        Ok((mesh, quality, grid.fault_edges(places)))
    }

    /// The same with the fault in a row. No cell folds: its sides are vertical.
    fn layers(
        &self,
        vertices: &[[f64; 2]],
        along: &[f64],
        places: &[[f64; 2]],
    ) -> Result<UnsplitMesh, FaultMeshError> {
        let layers = layers::Layers::new(self, vertices, places, smallest(along))?;
        let mesh = stack::mesh(self, &layers);
        let quality = quality(&mesh);
        Ok((mesh, quality, stack::fault_edges(&layers, places.len())))
    }

    /// Distances along the fault of the corners of cells, their positions, and the vertices of the line that the grid follows.
    fn line(&self, trace: &[[f64; 2]]) -> Result<(Vec<f64>, Line, Line), FaultMeshError> {
        let Some(curve) = self.curve(trace) else {
            let along = spacing::along(&check::distances(trace), &self.spacing)?;
            let places = check::places(trace, &along);
            return Ok((along, places, trace.to_vec()));
        };
        let along = spacing::along(curve.lengths(), &self.spacing)?;
        let places = curve.places(&along);
        check::curved(self, trace, &places)?;
        Ok((along, places.clone(), places))
    }

    /// The curve through the vertices of the trace; `None` if they are joined by straight lines.
    fn curve(&self, trace: &[[f64; 2]]) -> Option<Curve> {
        if self.interpolation == Interpolation::Polyline { None } else { Curve::through(trace) }
    }

    /// Departure of the fault from straight lines between its vertices; `None` if there is none.
    ///
    /// # Errors
    /// See [`FaultMeshError`].
    pub fn departure(&self) -> Result<Option<Departure>, FaultMeshError> {
        Ok(self.curve(&check::trace(self)?).map(|curve| curve.departure()))
    }

    /// Heights at which rows cross the spine, ascending; `places` are the nodes of the fault, ascending.
    fn rows(&self, places: &[[f64; 2]]) -> Result<Vec<f64>, FaultMeshError> {
        let n = places.len();
        let (low, high) = (places[0][1], places[n - 1][1]);
        let mut rows = Vec::new();
        if low > self.min[1] {
            let first = places[1][1] - low;
            let below = spacing::geometric(first, low - self.min[1], self.growth, "below the lower tip")?;
            rows.push(self.min[1]);
            rows.extend(below[1..below.len() - 1].iter().rev().map(|d| low - d));
        }
        rows.extend(places.iter().map(|x| x[1]));
        if high < self.max[1] {
            let first = high - places[n - 2][1];
            let above = spacing::geometric(first, self.max[1] - high, self.growth, "above the upper tip")?;
            rows.extend(above[1..above.len() - 1].iter().map(|d| high + d));
            rows.push(self.max[1]);
        }
        Ok(rows)
    }

    /// ξ of the columns, ascending, including 0.
    fn columns(&self, map: &Map, along: &[f64], spine: &Spine) -> Result<Vec<f64>, FaultMeshError> {
        let thickness = self.thickness.unwrap_or_else(|| smallest(along));
        // A horizontal distance ξ is the thickness ξ sin δ; the steepest segment has exactly the requested thickness.
        let steepest = spine.slopes.iter().map(|p| 1.0 / p.hypot(1.0)).fold(0.0, f64::max);
        let first = thickness / steepest;
        let [left, right] = map.widths();
        let side = |width: f64, place: &'static str| -> Result<Vec<f64>, FaultMeshError> {
            let rest = spacing::geometric(first, (width - first).max(0.0), self.growth, place)?;
            let inner = rest[..rest.len() - 1].iter().map(|d| first + d);
            Ok(inner.chain([width]).collect())
        };
        let left = side(left, "between the cells at the fault and the left side")?;
        let right = side(right, "between the cells at the fault and the right side")?;
        Ok(left.iter().rev().map(|d| -d).chain([0.0]).chain(right).collect())
    }
}

/// Smallest size of cells along the fault \[m\].
fn smallest(along: &[f64]) -> f64 {
    along.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min)
}

/// Values and the means of neighbours between them.
fn with_middles(values: &[f64]) -> Vec<f64> {
    let mut all = vec![values[0]];
    for w in values.windows(2) {
        all.extend([0.5 * (w[0] + w[1]), w[1]]);
    }
    all
}
