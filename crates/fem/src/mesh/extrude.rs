//! Extrusion of plane meshes along z, layer by layer.

use super::split::{Fault, Pair};
use super::{Cells, Mesh, Side};
use crate::element::ElementKind;

/// Reasons why a mesh cannot be extruded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ExtrudeError {
    /// Fewer than two layer coordinates, or not in ascending order.
    #[error(
        "layer coordinates must be at least two ascending numbers; of the {count} given, number {index} (from 0) is not \
         above the one before or is missing"
    )]
    Layers {
        /// Coordinates given.
        count: usize,
        /// Index of the first wrong one.
        index: usize,
    },
    /// A set that exists already.
    #[error("the mesh has a side set `{0}`, which extrusion would overwrite; name it otherwise")]
    Exists(&'static str),
    /// An element without an extrusion.
    #[error("element {0} cannot be extruded; tri3, tri6, quad4, quad8 and quad9 can")]
    Element(&'static str),
    /// Neighbours that would not conform.
    #[error(
        "blocks {with} and {without} meet at node {node}, where the extrusion of the first has a node half-way up each layer and \
         that of the second none; quad9 goes with itself, quad8 with tri6, quad4 with tri3"
    )]
    Mixed {
        /// Node of the plane mesh.
        node: usize,
        /// Block with a node half-way up.
        with: usize,
        /// Block without such a node.
        without: usize,
    },
}

/// Names of the new side sets: the lower and the upper end.
const ENDS: [&str; 2] = ["back", "front"];

/// An extruded mesh, with the map from plane nodes to its nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtrudedMesh {
    /// The mesh. Side, cell and node sets keep their names; `back` and `front` are the ends at the smallest and largest z.
    pub mesh: Mesh<3>,
    /// New nodes of each plane node, by ascending z: one per layer coordinate and, for nodes with one half-way up a layer,
    /// those in between.
    pub columns: Vec<Vec<usize>>,
}

impl ExtrudedMesh {
    /// The extruded pairs of a fault of the plane mesh: for each pair of the plane mesh, in its order, all pairs above it by
    /// ascending z. Tips become tip lines.
    #[must_use]
    pub fn fault(&self, plane: &Fault) -> Fault {
        let above = |p: &Pair| -> Vec<Pair> {
            let [minus, plus] = [p.minus, p.plus].map(|n| self.columns[n].iter().copied());
            minus.zip(plus).map(|(minus, plus)| Pair { minus, plus }).collect()
        };
        Fault { name: plane.name.clone(), pairs: plane.pairs.iter().flat_map(above).collect() }
    }
}

/// Extrudes a plane mesh along z, with one layer of cells between successive coordinates `z` \[m\]: tri3 to wedge6, tri6 to
/// wedge15, quad4 to hex8, quad8 to hex20, quad9 to hex27. Blocks keep their numbers. Nodes are numbered plane by plane, cells
/// layer by layer; the sides of a set follow its plane faces within each layer.
///
/// # Errors
/// See [`ExtrudeError`].
pub fn extrude(mesh: &Mesh<2>, z: &[f64]) -> Result<ExtrudedMesh, ExtrudeError> {
    check_layers(z)?;
    if let Some(end) = ENDS.into_iter().find(|e| mesh.side_sets.contains_key(*e)) {
        return Err(ExtrudeError::Exists(end));
    }
    let templates: Vec<Template> =
        mesh.blocks.iter().map(|b| Template::from_plane(b.kind)).collect::<Result<_, _>>()?;
    let halfway = halfway(mesh, &templates)?;
    let columns = columns(&halfway, z.len());
    let mut out = Mesh::<3> { nodes: place(mesh, &columns, &halfway, z), ..Mesh::default() };
    let layers = z.len() - 1;
    for (block, template) in mesh.blocks.iter().zip(&templates) {
        let mut connectivity = Vec::with_capacity(layers * block.len() * template.nodes.len());
        for layer in 0..layers {
            for cell in 0..block.len() {
                let plane = block.cell(cell);
                connectivity.extend(template.nodes.iter().map(|&(local, level)| {
                    let node = plane[local];
                    columns[node][if halfway[node] { 2 * layer + level } else { layer + level / 2 }]
                }));
            }
        }
        out.blocks.push(Cells { kind: template.kind, connectivity });
    }
    for (name, sides) in &mesh.side_sets {
        let drawn = (0..layers).flat_map(|layer| sides.iter().map(move |s| (layer, s)));
        let side = |(layer, s): (usize, &Side)| Side {
            block: s.block,
            cell: layer * mesh.blocks[s.block].len() + s.cell,
            face: templates[s.block].sides[s.face],
        };
        out.side_sets.insert(name.clone(), drawn.map(side).collect());
    }
    for (end, name) in ENDS.into_iter().enumerate() {
        let blocks = mesh.blocks.iter().zip(&templates).enumerate();
        let sides = blocks.flat_map(|(block, (cells, template))| {
            let first = if end == 0 { 0 } else { (layers - 1) * cells.len() };
            let face = template.ends[end];
            (0..cells.len()).map(move |cell| Side { block, cell: first + cell, face })
        });
        out.side_sets.insert(name.to_string(), sides.collect());
    }
    out.cell_sets.clone_from(&mesh.cell_sets);
    for (name, set) in &mesh.node_sets {
        let mut nodes: Vec<usize> = set.iter().flat_map(|&n| columns[n].iter().copied()).collect();
        nodes.sort_unstable();
        out.node_sets.insert(name.clone(), nodes);
    }
    Ok(ExtrudedMesh { mesh: out, columns })
}

fn check_layers(z: &[f64]) -> Result<(), ExtrudeError> {
    let count = z.len();
    let wrong = |k: usize| !z[k].is_finite() || (k > 0 && z[k - 1] >= z[k]);
    match (0..count).find(|&k| wrong(k)) {
        Some(index) => Err(ExtrudeError::Layers { count, index }),
        None if count < 2 => Err(ExtrudeError::Layers { count, index: count }),
        None => Ok(()),
    }
}

/// Extrusion of a plane element.
#[derive(Debug)]
struct Template {
    kind: ElementKind,
    /// Node of the plane element and level (0 bottom, 1 half-way, 2 top) of each node.
    nodes: Vec<(usize, usize)>,
    /// Face above each edge of the plane element.
    sides: Vec<usize>,
    /// Faces at the bottom and the top.
    ends: [usize; 2],
}

impl Template {
    /// Matches the elements' natural coordinates: (ξ, η) are those of the plane element, ζ runs upwards.
    fn from_plane(plane: ElementKind) -> Result<Self, ExtrudeError> {
        let kind = match plane {
            ElementKind::Tri3 => ElementKind::Wedge6,
            ElementKind::Tri6 => ElementKind::Wedge15,
            ElementKind::Quad4 => ElementKind::Hex8,
            ElementKind::Quad8 => ElementKind::Hex20,
            ElementKind::Quad9 => ElementKind::Hex27,
            other => return Err(ExtrudeError::Element(other.name())),
        };
        let nodes = (kind.node_coordinates().iter())
            .map(|xi| {
                let same = |p: &[f64; 3]| p[0] == xi[0] && p[1] == xi[1];
                (plane.node_coordinates().iter().position(same), (xi[2] + 1.0) as usize)
            })
            .map(|(local, level)| local.map(|l| (l, level)))
            .collect::<Option<Vec<_>>>();
        let nodes = nodes.ok_or(ExtrudeError::Element(plane.name()))?;
        let face_with = |want: &dyn Fn((usize, usize)) -> bool| {
            let all = |f: &[usize]| f.iter().all(|&a| want(nodes[a]));
            kind.faces().iter().position(|f| all(f.nodes)).ok_or(ExtrudeError::Element(plane.name()))
        };
        let sides = plane.faces().iter().map(|edge| face_with(&|(local, _)| edge.nodes.contains(&local)));
        let sides = sides.collect::<Result<Vec<_>, _>>()?;
        let ends = [face_with(&|(_, level)| level == 0)?, face_with(&|(_, level)| level == 2)?];
        Ok(Self { kind, nodes, sides, ends })
    }
}

/// True for nodes that have one half-way up each layer, as required by elements of second order.
fn halfway(mesh: &Mesh<2>, templates: &[Template]) -> Result<Vec<bool>, ExtrudeError> {
    // The last block that requires a half-way node there, and the last that does not.
    let mut blocks: Vec<[Option<usize>; 2]> = vec![[None; 2]; mesh.nodes.len()];
    for (block, (cells, template)) in mesh.blocks.iter().zip(templates).enumerate() {
        let of_plane = cells.kind.nodes();
        let wants: Vec<bool> = (0..of_plane).map(|local| template.nodes.contains(&(local, 1))).collect();
        for cell in 0..cells.len() {
            for (&node, &wants) in cells.cell(cell).iter().zip(&wants) {
                blocks[node][usize::from(!wants)] = Some(block);
            }
        }
    }
    for (node, blocks) in blocks.iter().enumerate() {
        if let &[Some(with), Some(without)] = blocks {
            return Err(ExtrudeError::Mixed { node, with, without });
        }
    }
    Ok(blocks.into_iter().map(|[with, _]| with.is_some()).collect())
}

/// New numbers: all nodes of the plane, then those half-way up, then all of the next plane, and so on.
fn columns(halfway: &[bool], planes: usize) -> Vec<Vec<usize>> {
    let mut columns = vec![Vec::new(); halfway.len()];
    let mut next = 0..;
    for level in 0..2 * planes - 1 {
        for (column, &half) in columns.iter_mut().zip(halfway) {
            if level % 2 == 0 || half {
                column.extend(next.next());
            }
        }
    }
    columns
}

fn place(mesh: &Mesh<2>, columns: &[Vec<usize>], halfway: &[bool], z: &[f64]) -> Vec<[f64; 3]> {
    let mut nodes = vec![[0.0; 3]; columns.iter().map(Vec::len).sum()];
    for ((column, x), half) in columns.iter().zip(&mesh.nodes).zip(halfway) {
        for (k, &node) in column.iter().enumerate() {
            let height = match (half, k % 2) {
                (false, _) => z[k],
                (true, 0) => z[k / 2],
                (true, _) => 0.5 * (z[k / 2] + z[k / 2 + 1]),
            };
            nodes[node] = [x[0], x[1], height];
        }
    }
    nodes
}
