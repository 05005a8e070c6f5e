//! Displacements of the bodies around faults: what slip and loads do there, by one solution with the factor of the condensation.

use super::equations::Layout;
use super::opening::Crack;
use super::plan::Plan;
use super::run::Run;
use crate::model::Model;
use asperity_fem::condense::Condensed;
use asperity_fem::jump::Jumps;
use asperity_output::vtu::{Array, Grid, PvdEntry, pvd};
use asperity_output::{OutputError, atomic};
use std::path::Path;

/// Displacements from unknowns of which some are jumps.
trait Jumping: Send + Sync + std::fmt::Debug {
    /// In place.
    fn displace(&self, unknowns: &mut [f64]);
}

impl<const C: usize> Jumping for Jumps<C> {
    fn displace(&self, unknowns: &mut [f64]) {
        self.displacement(unknowns);
    }
}

/// The condensed bodies, kept.
#[derive(Debug)]
pub struct Bodies {
    condensed: Condensed,
    /// Ties of sides that machines draw, then the faults: in the order in which they are undone.
    jumps: [Box<dyn Jumping>; 2],
    /// Retained unknown of the first component of slip of each point.
    rows: Vec<usize>,
    /// Components of displacement.
    components: usize,
}

impl Bodies {
    /// Of bodies with the jumps of their faults and the ties of sides that machines draw; `rows` are the retained unknowns of the first
    /// component of slip of each point.
    pub(super) fn new<const C: usize>(
        condensed: Condensed,
        jumps: Jumps<C>,
        ties: Jumps<1>,
        rows: Vec<usize>,
    ) -> Self {
        Self { condensed, jumps: [Box::new(ties), Box::new(jumps)], rows, components: C }
    }

    /// Displacements of all nodes \[m\], node by node, for slip of all points \[m\], component by component, openings after it where points may open, and the loads at
    /// `time` \[s\].
    #[must_use]
    pub fn displacement(&self, slip: &[f64], time: f64) -> Vec<f64> {
        let mut retained = vec![0.0; self.condensed.reduction().retained().len()];
        let n = self.rows.len();
        for (i, s) in slip.iter().enumerate() {
            retained[self.rows[i % n] + i / n] = *s;
        }
        let mut all = self.condensed.recover(&retained, time);
        self.jumps.iter().for_each(|jumps| jumps.displace(&mut all));
        all
    }

    /// The same in space.
    #[must_use]
    pub fn vectors(&self, slip: &[f64], time: f64) -> Vec<[f64; 3]> {
        let all = self.displacement(slip, time);
        let vector = |u: &[f64]| match u {
            // Antiplane motion.
            [z] => [0.0, 0.0, *z],
            _ => std::array::from_fn(|c| u.get(c).copied().unwrap_or(0.0)),
        };
        all.chunks_exact(self.components).map(vector).collect()
    }
}

/// Bodies as outputs see them.
#[derive(Debug)]
pub struct BodiesView {
    /// What gives their displacements.
    pub bodies: Bodies,
    /// Places of all nodes \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Nodes on the minus and on the plus side of each point that slides freely.
    pub sides: Vec<[usize; 2]>,
    /// VTK's type and nodes of all cells.
    cells: Vec<(u8, Vec<usize>)>,
}

impl BodiesView {
    pub(super) fn new<const D: usize>(bodies: Bodies, model: &Model<D>, sides: Vec<[usize; 2]>) -> Self {
        let blocks = model.bodies.iter().flat_map(|body| &model.mesh.blocks[body.blocks.clone()]);
        let cells = blocks.flat_map(|block| {
            let cells = block.connectivity.chunks_exact(block.kind.nodes());
            cells.map(|cell| (block.kind.vtk_type(), cell.to_vec()))
        });
        let place = |x: &[f64; D]| std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0));
        Self { bodies, nodes: model.mesh.nodes.iter().map(place).collect(), sides, cells: cells.collect() }
    }
}

/// Writes the displacements of the bodies over each event, which its slip causes, and at the end of the run, since its start, as VTU,
/// where the scene asks for them.
///
/// # Errors
/// When a file cannot be written.
pub fn write(out: &Path, plan: &Plan, run: &Run) -> Result<(), OutputError> {
    let Some(view) = &plan.bodies else { return Ok(()) };
    let folder = out.join("fields");
    atomic::create_dir(&folder)?;
    let grid = Grid::new(&view.nodes, &view.cells);
    let mut entries = Vec::new();
    let mut put = |file: String, time: f64, displacement: &[[f64; 3]]| {
        let arrays = [Array::vector("displacement", displacement)];
        entries.push(PvdEntry { time, part: 0, name: "bodies".into(), file: format!("fields/{file}") });
        atomic::write(&folder.join(&file), &grid.file(time, &arrays, &[]))
    };
    for (k, event) in run.catalogue.events().iter().enumerate() {
        // Loads are nothing at the start.
        let displacement = view.bodies.vectors(&[event.slip.as_slice(), &event.opening].concat(), 0.0);
        put(format!("bodies_event_{k:03}.vtu"), event.onset.seconds(), &displacement)?;
    }
    let slip = &run.unknowns[Layout::of(&plan.fault).slip()];
    let opening = plan.fault.pressed(run.at, &run.unknowns, &mut Crack::default()).opening;
    let end = run.at.seconds();
    put("bodies_end.vtu".into(), end, &view.bodies.vectors(&[slip, &opening].concat(), end))?;
    atomic::write(&out.join("bodies.pvd"), &pvd(&entries))
}
