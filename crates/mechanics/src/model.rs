//! The discrete model: one mesh of all bodies, and what each block of its cells is.

use super::cell_size::cell_size;
use asperity_fem::FemError;
use asperity_fem::block::LinearBlock;
use asperity_fem::condense::Stiffness;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::{Mesh, Side};
use asperity_fem::nonlinear;
use asperity_fem::surface;
use asperity_fem::term::{Blocks, Limited, Linearized, Pattern, Saved as _};
use std::collections::BTreeMap;
use std::ops::Range;

/// Cells of one kind and material as a term.
#[derive(Clone, Debug)]
pub enum CellBlock<const D: usize> {
    /// Elastic, small strain.
    Linear(Box<LinearBlock<D>>),
    /// Anything else.
    Nonlinear(Box<nonlinear::Block<D>>),
}

impl<const D: usize> CellBlock<D> {
    /// The linear block, where it is one.
    #[must_use]
    pub fn linear(&self) -> Option<&LinearBlock<D>> {
        match self {
            Self::Linear(block) => Some(block),
            Self::Nonlinear(_) => None,
        }
    }

    /// The block of large strain or with a history, where it is one.
    pub fn nonlinear_mut(&mut self) -> Option<&mut nonlinear::Block<D>> {
        match self {
            Self::Linear(_) => None,
            Self::Nonlinear(block) => Some(block),
        }
    }

    /// Its history; none where there is nothing to remember.
    #[must_use]
    pub fn history(&self) -> Option<Vec<f64>> {
        match self {
            Self::Linear(_) => None,
            Self::Nonlinear(block) => Some(block.save()),
        }
    }

    /// As a term of an implicit step.
    pub fn linearized(&mut self) -> &mut dyn Linearized {
        match self {
            Self::Linear(block) => block.as_mut(),
            Self::Nonlinear(block) => block.as_mut(),
        }
    }

    /// As a term of a forward step.
    pub fn limited(&mut self) -> &mut dyn Limited {
        match self {
            Self::Linear(block) => block.as_mut(),
            Self::Nonlinear(block) => block.as_mut(),
        }
    }

    /// Forces of a cell on its nodes, in the order of its degrees of freedom \[N, or N/m of thickness\], for displacements `u`
    /// of the common mesh; a block that is not linear knows its state itself.
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

    /// Bytes of cells with a history.
    #[must_use]
    pub fn history_bytes(&self) -> usize {
        match self {
            Self::Linear(_) => 0,
            Self::Nonlinear(block) => block.bytes(),
        }
    }

    /// Its degrees of freedom, cell by cell.
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
    /// Its nodes in the common mesh.
    pub nodes: Range<usize>,
    /// Its blocks of cells in the common mesh.
    pub blocks: Range<usize>,
    /// Elastic constants of each of its blocks.
    pub elastic: Vec<Elastic>,
    /// Element size h of a generated block of equal or steadily growing cells: the largest edge of the bounding box of its first cell \[m\].
    pub size: Option<f64>,
    /// Nodes of each connected part, ascending; a body that is split right through has several.
    pub parts: Vec<Vec<usize>>,
    /// Reason why it is not linear; `None` when it is.
    pub nonlinear: Option<&'static str>,
    /// Its degrees of freedom in the common mesh.
    pub dofs: Range<usize>,
}

/// Mesh and bodies of a scene.
#[derive(Debug)]
pub struct Model<const D: usize> {
    /// All bodies in one mesh; sets are named `body.set`.
    pub mesh: Mesh<D>,
    /// Cells of the blocks of the mesh, in its order.
    pub blocks: Vec<CellBlock<D>>,
    /// The bodies, in the order of their names.
    pub bodies: Vec<Body<D>>,
    /// Idealisation of space: degree of freedom = node * [`Idealisation::components`] + component.
    pub idealisation: Idealisation,
    /// Diagonal of the bounding box \[m\].
    pub scale: f64,
}

impl<const D: usize> Model<D> {
    /// Degrees of freedom in all.
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

    /// Displacement of a node in space \[m\], given that of all degrees of freedom.
    #[must_use]
    pub fn displacement(&self, node: usize, u: &[f64]) -> [f64; 3] {
        let components = self.idealisation.components();
        let mut displacement = [0.0; 3];
        for (c, value) in u[node * components..(node + 1) * components].iter().enumerate() {
            displacement[self.idealisation.axis(c)] = *value;
        }
        displacement
    }

    /// Returns whether all bodies are linear.
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

    /// The stiffness of a linear body in its own numbering, for condensation; blocks that are not linear have none.
    #[must_use]
    pub fn stiffness(&self, body: &Body<D>) -> Stiffness {
        let blocks = self.blocks[body.blocks.clone()].iter().filter_map(CellBlock::linear);
        let values = blocks.flat_map(|b| b.stiffness().iter().copied()).collect();
        Stiffness { pattern: self.pattern(body), values, dofs: body.dofs.len() }
    }

    /// The stiffness of all bodies, which are linear, in the numbering of the model. The blocks of cells are gone then: where nothing else is
    /// asked of them, their memory serves what follows.
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

    /// Index of the body a set belongs to, by the part of its name before the point.
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
        let edge = |a: usize, b: usize| -> Vec<f64> {
            (0..D).map(|c| self.mesh.nodes[face[b]][c] - self.mesh.nodes[face[a]][c]).collect()
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

    /// Young's modulus over element size behind the faces of a body \[Pa/m\]: of the first cell there, and for the size of a
    /// generated block of the first cell of the block, of other meshes the mean of the cells at the faces.
    #[must_use]
    pub fn young_per_size(&self, body: &Body<D>, sides: &[Side]) -> f64 {
        let first = sides.first().map_or(body.blocks.start, |s| s.block);
        let young = body.elastic[first - body.blocks.start].young();
        young / self.element_size(body, sides)
    }

    /// The declared element size of a body, or the mean size of the cells behind `sides` \[m\].
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
