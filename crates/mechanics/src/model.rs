//! The discrete model: one mesh of all bodies, and the cells of each of its blocks.

use super::cell_size::cell_size;
use asperity_fem::block::LinearBlock;
use asperity_fem::condense::Stiffness;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::{Mesh, Side};
use asperity_fem::term::{Blocks, ForwardTerm, Linearized, Pattern, Restorable as _};
use asperity_fem::{FemError, nonlinear, surface};
use std::collections::BTreeMap;
use std::ops::Range;

/// Cells of one element kind and material as a term.
#[derive(Clone, Debug)]
pub enum CellBlock<const D: usize> {
    /// Elastic cells in small strain.
    Linear(Box<LinearBlock<D>>),
    /// All other cells.
    Nonlinear(Box<nonlinear::Block<D>>),
}

impl<const D: usize> CellBlock<D> {
    /// Linear block, if it is one.
    #[must_use]
    pub fn linear(&self) -> Option<&LinearBlock<D>> {
        match self {
            Self::Linear(block) => Some(block),
            Self::Nonlinear(_) => None,
        }
    }

    /// Block of large strain or with a history, if it is one.
    pub fn nonlinear_mut(&mut self) -> Option<&mut nonlinear::Block<D>> {
        match self {
            Self::Linear(_) => None,
            Self::Nonlinear(block) => Some(block),
        }
    }

    /// History of the block; `None` if it has none.
    #[must_use]
    pub fn history(&self) -> Option<Vec<f64>> {
        match self {
            Self::Linear(_) => None,
            Self::Nonlinear(block) => Some(block.save()),
        }
    }

    /// Block as a term of an implicit step.
    pub fn linearized(&mut self) -> &mut dyn Linearized {
        match self {
            Self::Linear(block) => block.as_mut(),
            Self::Nonlinear(block) => block.as_mut(),
        }
    }

    /// Block as a term of a forward step.
    pub fn forward_term(&mut self) -> &mut dyn ForwardTerm {
        match self {
            Self::Linear(block) => block.as_mut(),
            Self::Nonlinear(block) => block.as_mut(),
        }
    }

    /// Forces of a cell on its nodes, in the order of its degrees of freedom \[N, or N/m of thickness\]. `u` are displacements
    /// of the common mesh; nonlinear blocks use the state they store instead.
    #[must_use]
    pub fn forces_of_cell(&self, cell: usize, u: &[f64]) -> Vec<f64> {
        let block = match self {
            Self::Nonlinear(block) => return block.forces_of_cell(cell),
            Self::Linear(block) => block,
        };
        let pattern = block.pattern();
        let dofs = pattern.block(cell);
        let size = dofs.len();
        let rows = block.stiffness()[cell * size * size..(cell + 1) * size * size].chunks_exact(size);
        rows.map(|row| row.iter().zip(dofs).map(|(k, &dof)| k * u[dof]).sum()).collect()
    }

    /// Memory of cells with a history \[bytes\].
    #[must_use]
    pub fn history_bytes(&self) -> usize {
        match self {
            Self::Linear(_) => 0,
            Self::Nonlinear(block) => block.bytes(),
        }
    }

    /// Degrees of freedom of the block, cell by cell.
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        match self {
            Self::Linear(block) => block.pattern(),
            Self::Nonlinear(block) => block.pattern(),
        }
    }
}

/// A body of the model.
#[derive(Debug)]
pub struct Body<const D: usize> {
    /// Name in the scene.
    pub name: String,
    /// Range of its nodes in the common mesh.
    pub nodes: Range<usize>,
    /// Range of its blocks of cells in the common mesh.
    pub blocks: Range<usize>,
    /// Elastic constants of each of its blocks.
    pub elastic: Vec<Elastic>,
    /// Element size h of a generated block of equal or steadily growing cells \[m\]: the largest edge of the bounding box of
    /// its first cell. `None` for other bodies.
    pub size: Option<f64>,
    /// Nodes of each connected part, ascending. A body that is split completely has several parts.
    pub parts: Vec<Vec<usize>>,
    /// Reason why the body is not linear; `None` if it is.
    pub nonlinear: Option<&'static str>,
    /// Range of its degrees of freedom in the common mesh.
    pub dofs: Range<usize>,
}

/// Mesh and bodies of a scene.
#[derive(Debug)]
pub struct Model<const D: usize> {
    /// All bodies in one mesh. Sets are named `body.set`.
    pub mesh: Mesh<D>,
    /// Cells of the blocks of the mesh, in the order of the mesh.
    pub blocks: Vec<CellBlock<D>>,
    /// Bodies in the order of their names.
    pub bodies: Vec<Body<D>>,
    /// Idealisation of space. Degrees of freedom are node * [`Idealisation::components`] + component.
    pub idealisation: Idealisation,
    /// Diagonal of the bounding box \[m\].
    pub scale: f64,
}

impl<const D: usize> Model<D> {
    /// Total number of degrees of freedom.
    #[must_use]
    pub fn dofs(&self) -> usize {
        self.mesh.nodes.len() * self.idealisation.components()
    }

    /// Degree of freedom of a node along an axis of space.
    ///
    /// # Panics
    /// If no displacement points there, which the check of a scene refuses.
    #[must_use]
    pub fn dof(&self, node: usize, axis: usize) -> usize {
        let component =
            self.idealisation.component(axis).expect("the check refuses axes without a displacement");
        node * self.idealisation.components() + component
    }

    /// Displacement of a node in space \[m\], from the displacements `u` of all degrees of freedom.
    #[must_use]
    pub fn displacement(&self, node: usize, u: &[f64]) -> [f64; 3] {
        let components = self.idealisation.components();
        let mut displacement = [0.0; 3];
        for (c, value) in u[node * components..(node + 1) * components].iter().enumerate() {
            displacement[self.idealisation.axis(c)] = *value;
        }
        displacement
    }

    /// True if all bodies are linear.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.bodies.iter().all(|b| b.nonlinear.is_none())
    }

    /// Degrees of freedom of the cells of a linear body in its own numbering, cell by cell.
    #[must_use]
    pub fn pattern(&self, body: &Body<D>) -> Pattern {
        let first = body.dofs.start;
        let mut own = Blocks::default();
        for block in self.blocks[body.blocks.clone()].iter().filter_map(CellBlock::linear) {
            block.pattern().blocks().for_each(|cell| own.push(cell.iter().map(|d| d - first)));
        }
        own.into()
    }

    /// Stiffness of a linear body in its own numbering, for condensation. Nonlinear blocks are left out.
    #[must_use]
    pub fn stiffness(&self, body: &Body<D>) -> Stiffness {
        let blocks = self.blocks[body.blocks.clone()].iter().filter_map(CellBlock::linear);
        let values = blocks.flat_map(|b| b.stiffness().iter().copied()).collect();
        Stiffness { pattern: self.pattern(body), values, dofs: body.dofs.len() }
    }

    /// Stiffness of all bodies, which must be linear, in the numbering of the model. The blocks of cells are consumed to free
    /// their memory, so nothing may need them afterwards.
    pub fn take_stiffness(&mut self) -> Stiffness {
        let dofs = self.dofs();
        let blocks: Vec<LinearBlock<D>> = std::mem::take(&mut self.blocks)
            .into_iter()
            .filter_map(|block| match block {
                CellBlock::Linear(block) => Some(*block),
                CellBlock::Nonlinear(_) => None,
            })
            .collect();
        let (mut cells, mut all) = (Blocks::default(), Vec::new());
        for block in blocks {
            let (pattern, values) = block.into_stiffness();
            cells.append(pattern);
            if all.is_empty() {
                all = values;
            } else {
                all.extend(values);
            }
        }
        Stiffness { pattern: cells.into(), values: all, dofs }
    }

    /// Index of the body that a set belongs to, from the part of its name before the dot.
    #[must_use]
    pub fn body_of(&self, set: &str) -> Option<usize> {
        let name = set.split('.').next()?;
        self.bodies.iter().position(|b| b.name == name)
    }

    /// Tributary areas of the nodes of faces \[m^(D-1); m² of the full circle about an axis\].
    ///
    /// # Errors
    /// [`FemError::NodalAreas`] for faces in space of six or eight nodes, whose nodes cannot represent areas.
    pub fn tributary_areas(&self, sides: &[Side]) -> Result<BTreeMap<usize, f64>, FemError> {
        for side in sides {
            let kind = self.mesh.blocks[side.block].kind;
            if !kind.faces()[side.face].kind.shares_area() {
                return Err(FemError::NodalAreas { element: kind.name() });
            }
        }
        Ok(surface::areas(&self.mesh, sides, self.idealisation))
    }

    /// Unit normal of a face, outward of its body.
    #[must_use]
    pub fn face_normal(&self, face: &[usize]) -> Vec<f64> {
        self.moved_face_normal(face, |_| [0.0; D])
    }

    /// Unit normal of a face whose nodes have moved by `displacement` \[m\].
    #[must_use]
    pub fn moved_face_normal(&self, face: &[usize], displacement: impl Fn(usize) -> [f64; D]) -> Vec<f64> {
        let at = |k: usize| {
            let (x, u) = (&self.mesh.nodes[face[k]], displacement(face[k]));
            std::array::from_fn::<f64, D, _>(|c| x[c] + u[c])
        };
        let edge = |a: usize, b: usize| -> Vec<f64> {
            let (from, to) = (at(a), at(b));
            (0..D).map(|c| to[c] - from[c]).collect()
        };
        let e = edge(0, 1);
        let n = if D == 2 {
            vec![e[1], -e[0]]
        } else {
            let f = edge(0, 2);
            vec![e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]]
        };
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        n.iter().map(|c| c / length).collect()
    }

    /// Young's modulus over element size behind the faces of a body \[Pa/m\]. The modulus is that of the first cell there. The
    /// size is that of the first cell in a generated block, and the mean over the cells at the faces in other meshes.
    #[must_use]
    pub fn young_per_size(&self, body: &Body<D>, sides: &[Side]) -> f64 {
        let first = sides.first().map_or(body.blocks.start, |s| s.block);
        let young = body.elastic[first - body.blocks.start].young();
        young / self.element_size(body, sides)
    }

    /// Element size of a generated body, or the mean size of the cells behind `sides` \[m\].
    #[must_use]
    pub fn element_size(&self, body: &Body<D>, sides: &[Side]) -> f64 {
        body.size.unwrap_or_else(|| {
            let sizes = sides.iter().map(|s| cell_size(&self.mesh, s.block, s.cell));
            sizes.sum::<f64>() / sides.len().max(1) as f64
        })
    }
}

/// Corners of the bounding box.
#[must_use]
pub fn bounds<const D: usize>(points: &[[f64; D]]) -> ([f64; D], [f64; D]) {
    let mut min = [f64::INFINITY; D];
    let mut max = [f64::NEG_INFINITY; D];
    for p in points {
        for c in 0..D {
            min[c] = min[c].min(p[c]);
            max[c] = max[c].max(p[c]);
        }
    }
    (min, max)
}
