//! The structured grid: nodes, cells, sides, and the edges of the fault.

use super::map::Map;
use super::quality::{Quality, quality};
use super::spine::Spine;
use super::{FaultMesh, FaultMeshError, MOST_CELLS, SpacingError};
use crate::mesh::{Cells, Mesh, Side};

/// Corners of the cells, row by row from the bottom, each from left to right.
#[derive(Debug)]
pub(super) struct Grid<'a> {
    spine: &'a Spine,
    corners: Vec<[f64; 2]>,
    /// Corners in a row.
    width: usize,
    /// Rows of corners.
    height: usize,
    /// Column that holds the fault.
    column: usize,
    /// Row of the lower tip of the fault.
    first: usize,
}

impl<'a> Grid<'a> {
    pub(super) fn new(
        input: &FaultMesh,
        map: &Map,
        spine: &'a Spine,
        rows: &[f64],
        columns: &[f64],
        places: &[[f64; 2]],
    ) -> Result<Self, FaultMeshError> {
        let (width, height) = (columns.len(), rows.len());
        if (width - 1) * (height - 1) > MOST_CELLS {
            return Err(SpacingError::TooMany { most: MOST_CELLS }.into());
        }
        let first = rows.iter().position(|&y| y == places[0][1]).unwrap_or(0);
        let column = columns.iter().position(|&xi| xi == 0.0).unwrap_or(0);
        let mut corners = Vec::with_capacity(width * height);
        for (j, (&eta, (direction, length))) in rows.iter().zip(map.turning(rows)).enumerate() {
            for (i, &xi) in columns.iter().enumerate() {
                let mut x = map.at(eta, direction, length, xi);
                // Exactly on the fault and on the sides, regardless of rounding in the map.
                if i == column
                    && let Some(&place) = j.checked_sub(first).and_then(|k| places.get(k))
                {
                    x = place;
                } else if i == 0 {
                    x[0] = input.min[0];
                } else if i == width - 1 {
                    x[0] = input.max[0];
                }
                corners.push(x);
            }
        }
        Ok(Self { spine, corners, width, height, column, first })
    }

    /// The mesh before splitting.
    pub(super) fn mesh(&self, input: &FaultMesh) -> Mesh<2> {
        let (nx, ny) = (self.width - 1, self.height - 1);
        let nodes = input.kind.nodes();
        let second = nodes > 4;
        let mut mesh = Mesh { nodes: self.corners.clone(), ..Mesh::default() };
        let n = self.corners.len();
        // After the corners: middles of horizontal edges, of vertical edges, of cells.
        let (horizontal, vertical) = (n, n + nx * self.height);
        let centre = vertical + self.width * ny;
        if second {
            let at = |j: usize, i: usize| self.corners[j * self.width + i];
            let mean = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            for j in 0..self.height {
                mesh.nodes.extend((0..nx).map(|i| mean(at(j, i), at(j, i + 1))));
            }
            for j in 0..ny {
                mesh.nodes.extend((0..self.width).map(|i| mean(at(j, i), at(j + 1, i))));
            }
            for j in 0..if nodes == 9 { ny } else { 0 } {
                let centre = |i| mean(mean(at(j, i), at(j, i + 1)), mean(at(j + 1, i), at(j + 1, i + 1)));
                mesh.nodes.extend((0..nx).map(centre));
            }
        }
        let mut connectivity = Vec::with_capacity(nx * ny * nodes);
        for j in 0..ny {
            for i in 0..nx {
                let a = j * self.width + i;
                connectivity.extend([a, a + 1, a + self.width + 1, a + self.width]);
                if second {
                    let (h, v) = (horizontal + j * nx + i, vertical + a);
                    connectivity.extend([h, v + 1, h + nx, v]);
                }
                if nodes == 9 {
                    connectivity.push(centre + j * nx + i);
                }
            }
        }
        mesh.blocks.push(Cells { kind: input.kind, connectivity });
        let side = |cell: usize, face: usize| Side { block: 0, cell, face };
        let mut name = |set: &str, sides: Vec<Side>| mesh.side_sets.insert(set.to_string(), sides);
        name("bottom", (0..nx).map(|i| side(i, 0)).collect());
        name("right", (0..ny).map(|j| side(j * nx + nx - 1, 1)).collect());
        name("top", (0..nx).map(|i| side((ny - 1) * nx + i, 2)).collect());
        name("left", (0..ny).map(|j| side(j * nx, 3)).collect());
        mesh
    }

    /// Edges of the fault from its lower to its upper tip, as nodes.
    pub(super) fn fault_edges(&self, places: &[[f64; 2]]) -> Vec<Vec<usize>> {
        let node = |k: usize| (self.first + k) * self.width + self.column;
        (0..places.len() - 1).map(|k| vec![node(k), node(k + 1)]).collect()
    }

    /// Quality of the cells, all of which must be convex.
    pub(super) fn check(&self, input: &FaultMesh, mesh: &Mesh<2>) -> Result<Quality, FaultMeshError> {
        let quality = quality(mesh);
        let cell = &mesh.blocks[0].cell(quality.worst.1)[..4];
        let x: Vec<[f64; 2]> = cell.iter().map(|&n| mesh.nodes[n]).collect();
        if quality.min > 0.0 {
            return Ok(quality);
        }
        let at: [f64; 2] = std::array::from_fn(|c| 0.25 * x.iter().map(|x| x[c]).sum::<f64>());
        let distance = |v: &[f64; 2]| (v[0] - at[0]).hypot(v[1] - at[1]);
        let closest = (0..input.trace.len())
            .min_by(|&a, &b| distance(&input.trace[a]).total_cmp(&distance(&input.trace[b])));
        let vertex = closest.unwrap_or(0);
        let k = self.spine.vertices.iter().position(|v| *v == input.trace[vertex]).unwrap_or(0);
        let inner = k > 0 && k < self.spine.slopes.len();
        let bend = if inner { (self.spine.dip(k) - self.spine.dip(k - 1)).abs().to_degrees() } else { 0.0 };
        Err(FaultMeshError::Inverted { at, quality: quality.min, vertex, bend })
    }
}
