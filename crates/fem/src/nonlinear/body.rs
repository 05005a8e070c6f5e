//! Constant data of a run: cells in local numbering, reference geometry, model; and the loop over chunks of cells.

use super::cell::{Frame, InvertedPoint, Scratch};
use super::history::Layout;
use super::model::{Kinematics, Material, Model, ModelError};
use crate::error::FemError;
use crate::kinematics::Idealisation;
use crate::mesh::{Cells, Mesh};
use crate::origin;
use crate::term::Pattern;
use rayon::prelude::*;

/// Cells per task: fixed, so that results do not depend on the number of threads.
const CHUNK: usize = 64;

/// See the module.
#[derive(Clone, Debug)]
pub struct Body<const D: usize> {
    /// Block of the mesh.
    pub block: usize,
    /// Its cells, nodes in local numbering.
    pub cells: Cells,
    /// Node of the mesh of each local node, ascending.
    pub nodes: Vec<usize>,
    /// Reference positions of the local nodes, relative to `origin` \[m\].
    pub reference: Vec<[f64; D]>,
    /// Point near the nodes \[m\]; its first coordinate is zero if that is a radius.
    pub origin: [f64; D],
    /// Reference volume of each point \[m^D; m³ over the full circle if axisymmetric\].
    pub volumes: Vec<f64>,
    /// Data common to all cells.
    pub frame: Frame,
    /// Material and options.
    pub model: Model,
    /// Degrees of freedom of each cell in the numbering of the system.
    pub pattern: Pattern,
}

/// Parts of the cells' arrays processed by one task.
pub struct Task<'a, const D: usize> {
    /// First cell.
    pub first: usize,
    /// Numbers per cell in `out`.
    size: usize,
    /// First output, with `size` numbers per cell.
    pub out: &'a mut [f64],
    /// Second output, cell by cell.
    pub state: &'a mut [f64],
    state_size: usize,
}

impl<const D: usize> Task<'_, D> {
    /// Cells of the task with their parts of `out` and `state`.
    pub fn cells(&mut self) -> impl Iterator<Item = (usize, &mut [f64], &mut [f64])> {
        let (first, state_size) = (self.first, self.state_size);
        let mut rest = std::mem::take(&mut self.state);
        self.out.chunks_exact_mut(self.size).enumerate().map(move |(k, out)| {
            let (state, others) = std::mem::take(&mut rest).split_at_mut(state_size);
            rest = others;
            (first + k, out, state)
        })
    }
}

impl<const D: usize> Body<D> {
    /// Block `block` of `mesh`; degree of freedom = node * components + component.
    pub fn new(mesh: &Mesh<D>, block: usize, model: Model) -> Result<Self, ModelError> {
        model.check(D)?;
        let global = &mesh.blocks[block];
        if global.kind.dimension() != D {
            return Err(FemError::Dimension { element: global.kind.name(), dimension: D }.into());
        }
        let mut nodes = global.connectivity.clone();
        nodes.sort_unstable();
        nodes.dedup();
        let mut local = vec![0; mesh.nodes.len()];
        nodes.iter().enumerate().for_each(|(k, &n)| local[n] = k);
        let frame = frame::<D>(global, &model)?;
        if frame.axisymmetric
            && let Some(&node) = nodes.iter().find(|&&n| mesh.nodes[n][0] < 0.0)
        {
            return Err(FemError::Radius { node, radius: mesh.nodes[node][0] }.into());
        }
        let components = frame.components;
        let dofs: Vec<Vec<usize>> = (0..global.len())
            .map(|c| {
                global
                    .cell(c)
                    .iter()
                    .flat_map(|&n| (0..components).map(move |i| n * components + i))
                    .collect()
            })
            .collect();
        let mut origin = origin::near(nodes.iter().map(|&n| &mesh.nodes[n]));
        if frame.axisymmetric {
            origin[0] = 0.0;
        }
        let relative = |&n: &usize| std::array::from_fn(|c| mesh.nodes[n][c] - origin[c]);
        let mut body = Self {
            block,
            cells: Cells {
                kind: global.kind,
                connectivity: global.connectivity.iter().map(|&n| local[n]).collect(),
            },
            reference: nodes.iter().map(relative).collect(),
            origin,
            volumes: Vec::new(),
            pattern: Pattern::from_blocks(dofs.iter().map(Vec::as_slice)),
            nodes,
            frame,
            model,
        };
        body.volumes = body.reference_volumes()?;
        Ok(body)
    }

    fn reference_volumes(&self) -> Result<Vec<f64>, FemError> {
        let mut flat = self.frame.clone();
        (flat.finite, flat.modes) = (false, 0);
        let mut scratch = Scratch::<D>::new(&flat);
        let none = vec![0.0; self.nodes.len() * flat.components];
        let mut volumes = Vec::with_capacity(self.cells.len() * flat.points());
        for cell in 0..self.cells.len() {
            self.gather(cell, &none, &none, &mut scratch);
            scratch.motion(&flat, &[]).map_err(|InvertedPoint { determinant, .. }| FemError::Jacobian {
                block: self.block,
                cell,
                determinant,
            })?;
            volumes.extend_from_slice(&scratch.volume);
        }
        Ok(volumes)
    }

    /// Copies the positions of a cell into the working memory, displaced by `base` and by `end` (local numbering).
    pub fn gather(&self, cell: usize, base: &[f64], end: &[f64], scratch: &mut Scratch<D>) {
        let components = self.frame.components;
        for (a, &node) in self.cells.cell(cell).iter().enumerate() {
            scratch.reference[a] = self.reference[node];
            for i in 0..components {
                scratch.base[a][i + self.frame.row] = base[node * components + i];
                scratch.end[a][i + self.frame.row] = end[node * components + i];
            }
        }
    }

    /// Mean position of the nodes of a cell in the reference configuration \[m\].
    pub fn middle(&self, cell: usize) -> [f64; D] {
        let nodes = self.cells.cell(cell);
        let mean = |c: usize| nodes.iter().map(|&n| self.reference[n][c]).sum::<f64>() / nodes.len() as f64;
        std::array::from_fn(|c| self.origin[c] + mean(c))
    }

    /// Reference volumes of the points of a cell.
    pub fn cell_volumes(&self, cell: usize) -> &[f64] {
        let n = self.frame.points();
        &self.volumes[cell * n..(cell + 1) * n]
    }

    /// Kept numbers of a cell in `state`.
    pub fn cell_state<'a>(&self, cell: usize, state: &'a [f64]) -> &'a [f64] {
        let n = self.state_size();
        &state[cell * n..(cell + 1) * n]
    }

    /// Kept numbers per cell.
    pub fn state_size(&self) -> usize {
        self.frame.points() * self.frame.layout.stride
    }

    /// Runs `work` on chunks of cells in parallel, each with its part of `out` (`size` > 0 numbers per cell) and of `state`,
    /// and returns the results in the order of the chunks.
    pub fn chunks<R: Send>(
        &self,
        out: &mut [f64],
        size: usize,
        mut state: &mut [f64],
        state_size: usize,
        work: impl Fn(&mut Scratch<D>, Task<'_, D>) -> R + Sync,
    ) -> Vec<R> {
        let mut tasks = Vec::with_capacity(self.cells.len().div_ceil(CHUNK));
        for (k, out) in out.chunks_mut(size * CHUNK).enumerate() {
            let (part, rest) = std::mem::take(&mut state).split_at_mut(out.len() / size * state_size);
            state = rest;
            tasks.push(Task { first: k * CHUNK, size, out, state: part, state_size });
        }
        tasks
            .into_par_iter()
            .map_init(|| Scratch::new(&self.frame), |scratch, task| work(scratch, task))
            .collect()
    }
}

fn frame<const D: usize>(cells: &Cells, model: &Model) -> Result<Frame, ModelError> {
    let rule = model.idealisation.quadrature(cells.kind);
    let nodes = cells.kind.nodes();
    let shapes: Vec<_> = rule.iter().map(|(xi, _)| cells.kind.shape(*xi)).collect();
    let finite = model.kinematics == Kinematics::UpdatedLagrangian;
    let (tensors, scalars) = model.material.history();
    let plane_stress = model.idealisation == Idealisation::PlaneStress;
    let layout = Layout::new(tensors, scalars, plane_stress);
    let remembers = finite || !matches!(model.material, Material::Elastic(_));
    Ok(Frame {
        nodes,
        dn: shapes.iter().flat_map(|s| s.dn[..nodes].to_vec()).collect(),
        n: shapes.iter().flat_map(|s| s.n[..nodes].to_vec()).collect(),
        weight: rule.iter().map(|(_, w)| *w).collect(),
        modes: model.modes(cells.kind)?,
        components: model.idealisation.components(),
        row: model.idealisation.axis(0),
        axisymmetric: model.idealisation == Idealisation::Axisymmetric,
        plane_stress,
        finite,
        layout: if remembers { layout } else { layout.forgetful() },
    })
}
