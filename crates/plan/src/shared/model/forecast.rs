//! Memory estimates from counts alone, available before anything is built.
//!
//! Counts of generated blocks follow from the scene; for other meshes they are known once the mesh is read, before its cells have matrices. The
//! estimates refuse early what is far out of reach. Small systems, and meshes that are not blocks, are analysed exactly afterwards (`solver`). For
//! large blocks the plan relies on the estimates, and neither assembles nor analyses.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{
    Body, EnforcementKind, Fault, Interface, MeshSource, Method, Scene, Spanned, Stepper,
};
use crate::shared::amounts::{self, size};
use crate::shared::idealisation;
use crate::shared::model::meshes;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::generate::SIDES;
use std::collections::BTreeMap;
use std::ops::{Add, Range};

/// Fraction of an estimate that is certainly needed: estimates are within a factor of 1.5 of the analysis on cubes, slabs and squares.
pub const SURE: f64 = 0.5;
/// Memory of a factorisation over that of the values of its factor. The rest are fronts, which hold both triangles, and contributions until their
/// parents have absorbed them. It is 3.0 on cubes of 37 cells, 3.6 of 14, and 4.2 on a slab of 40 x 12 x 4: within a sixth of the middle.
pub const FRONTS_IN_SPACE: f64 = 3.5;
/// The same in 2D, where contributions are small: 1.9 to 2.0 on squares of 100 to 150 cells, 1.6 on a strip.
pub const FRONTS_IN_PLANE: f64 = 2.0;
/// Size of a value or an index \[bytes\].
pub const WORD: f64 = 8.0;
/// Number of equations below which a part of a grid is one dense front, because the analysis merges smaller ones.
const LEAF: f64 = 96.0;

/// Cells and nodes of a body.
#[derive(Clone, Debug)]
pub struct Counts {
    /// Element.
    pub kind: ElementKind,
    /// Cells.
    pub cells: f64,
    /// Nodes.
    pub nodes: f64,
}

impl Counts {
    /// Bytes of the mesh, including the copy held by its blocks of cells.
    pub(crate) fn mesh_bytes(&self) -> f64 {
        2.0 * WORD * (self.nodes * self.kind.dimension() as f64 + self.cells * self.kind.nodes() as f64)
    }

    /// Bytes of the cell matrices and their degrees of freedom.
    pub(crate) fn stiffness_bytes(&self, components: usize) -> f64 {
        let dofs = (self.kind.nodes() * components) as f64;
        WORD * self.cells * (dofs * dofs + dofs)
    }

    /// Bytes of the shape function gradients, positions and volumes at the quadrature points of the cells.
    pub(crate) fn geometry_bytes(&self, idealisation: Idealisation) -> f64 {
        let points = idealisation.quadrature(self.kind).len() as f64;
        let dimension = self.kind.dimension() as f64;
        WORD * self.cells * points * (self.kind.nodes() as f64 * dimension + dimension + 1.0)
    }

    /// Bytes of the mesh, the cell matrices and the cell geometry.
    fn cells_bytes(&self, idealisation: Idealisation) -> f64 {
        self.mesh_bytes()
            + self.stiffness_bytes(idealisation.components())
            + self.geometry_bytes(idealisation)
    }

    /// Bytes of the lower triangle of the assembled matrix: values and indices.
    fn matrix_bytes(&self, components: usize) -> f64 {
        let dofs = self.nodes * components as f64;
        0.5 * dofs * neighbours(self.kind) * components as f64 * 2.0 * WORD
    }
}

/// Number of nodes that share a cell with a node inside a regular mesh, including the node itself, averaged over the
/// nodes of a cell.
fn neighbours(kind: ElementKind) -> f64 {
    match kind {
        ElementKind::Tri3 => 7.0,
        ElementKind::Tri6 => 11.5,
        ElementKind::Quad4 => 9.0,
        ElementKind::Quad8 => 15.7,
        ElementKind::Quad9 => 16.0,
        ElementKind::Tet4 => 15.0,
        ElementKind::Tet10 => 28.0,
        ElementKind::Hex8 => 27.0,
        ElementKind::Hex20 => 58.5,
        ElementKind::Hex27 => 64.0,
        ElementKind::Wedge6 => 21.0,
        ElementKind::Wedge15 => 45.0,
    }
}

/// Bytes of the lower triangles of the matrices of blocks: values and indices.
#[must_use]
pub fn matrix_bytes(counts: &[Counts], components: usize) -> usize {
    counts.iter().map(|c| c.matrix_bytes(components)).sum::<f64>() as usize
}

/// Peak memory of this process so far \[bytes\]; `None` if the system does not report it.
#[must_use]
pub fn most_so_far() -> Option<usize> {
    asperity_output::memory::most()
}

/// A Cholesky factor: its size and its work.
#[derive(Clone, Copy, Debug, Default)]
pub struct FactorCost {
    /// Values.
    pub values: f64,
    /// Multiplications and additions of the factorisation.
    pub operations: f64,
}

impl FactorCost {
    /// Cost of a front with so many pivots and rows below them.
    fn from_front(pivots: f64, below: f64) -> Self {
        let rows = pivots + below;
        let values = pivots * rows - 0.5 * pivots * pivots;
        // Sum of (rows - i)^2 for i < pivots.
        let operations = pivots * rows * rows - rows * pivots * pivots + pivots.powi(3) / 3.0;
        Self { values, operations }
    }
}

impl Add for FactorCost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { values: self.values + other.values, operations: self.operations + other.operations }
    }
}

/// A symmetric factorisation of all bodies.
#[derive(Clone, Copy, Debug)]
pub struct Factorisation {
    /// Memory \[bytes\].
    pub bytes: usize,
    /// Multiplications and additions.
    pub operations: f64,
}

/// A generated block.
struct Grid {
    body: String,
    counts: Counts,
    /// Number of nodes along each axis.
    nodes: [usize; 3],
    /// Position in the scene of the entry that sets the resolution.
    place: Range<usize>,
}

/// Grid of a body; `None` if its mesh is not a block, is extruded or has joined cells, or if its entry will be refused.
fn grid(name: &str, body: &Body) -> Option<Grid> {
    let MeshSource::Block(spec) = &body.mesh else { return None };
    if body.extrude.is_some() || spec.coarser.is_some() {
        return None;
    }
    let kind: ElementKind = spec.element.get_ref().parse().ok()?;
    let divisions = meshes::cells_along(name, spec).ok()?;
    let mut nodes = [1; 3];
    for (n, cells) in nodes.iter_mut().zip(&divisions) {
        *n = kind.order() * cells + 1;
    }
    let place = [
        spec.size.as_ref().map(Spanned::span),
        spec.divisions.as_ref().map(Spanned::span),
        spec.spacing.as_ref().map(Spanned::span),
    ];
    let positions: f64 = divisions.iter().map(|&n| n as f64).product();
    let per_position = match kind.linear() {
        ElementKind::Tri3 | ElementKind::Wedge6 => 2.0,
        ElementKind::Tet4 => 6.0,
        _ => 1.0,
    };
    let counts =
        Counts { kind, cells: per_position * positions, nodes: nodes.iter().map(|&n| n as f64).product() };
    let body = name.to_string();
    Some(Grid { body, counts, nodes, place: place.into_iter().flatten().next().unwrap_or(0..0) })
}

/// Refuses a scene whose generated bodies alone exceed the memory of the machine or `memory` in `[solver]`.
///
/// # Errors
/// [`Diagnostic`] at the block with the most nodes, with the counts, the need and the limit.
pub fn admit(scene: &Scene) -> Result<(), Diagnostic> {
    let idealisation = idealisation::from_kinematics(*scene.kinematics.get_ref());
    let components = idealisation.components();
    let grids: Vec<Grid> = grids(scene).collect();
    let Some(largest) = grids.iter().max_by(|a, b| a.counts.nodes.total_cmp(&b.counts.nodes)) else {
        return Ok(());
    };
    let counts: Vec<Counts> = grids.iter().map(|g| g.counts.clone()).collect();
    let within = |error: Diagnostic| Diagnostic { span: largest.place.clone(), ..error };
    machine(scene, &counts).map_err(within)?;
    let direct =
        BuiltParts::from_scene(scene) == BuiltParts::Systems && scene.solver.method() != Method::Iterative;
    if direct && !may_iterate(scene) {
        let factor: f64 = SURE * grids.iter().map(|g| g.factor_bytes([false; 6], components)).sum::<f64>();
        let allowed = amounts::memory(scene);
        if factor > allowed as f64 {
            let memory = scene.solver.memory.as_ref().map(Spanned::span);
            return Err(Diagnostic::at(
                memory.unwrap_or(largest.place.clone()),
                format!(
                    "the factors of {} need {} or more, and {} are allowed",
                    in_words(&counts, components),
                    size(factor as usize),
                    size(allowed)
                ),
                "take larger cells, or raise `memory` in `[solver]` where the machine has it",
            ));
        }
    }
    Ok(())
}

/// True if the plan may choose an iterative linear solver by itself.
pub fn may_iterate(scene: &Scene) -> bool {
    let unknowns = |i: &Interface| *i.enforcement.kind.get_ref() == EnforcementKind::AugmentedLagrangian;
    let forward = *scene.time.stepper.get_ref() == Stepper::StaticExplicit;
    let corrects = scene.inertia().is_none() && !forward && !scene.interfaces.values().any(unknowns);
    scene.solver.method() == Method::Auto
        && scene.kinematics.get_ref().dimension() == 3
        && (scene.interfaces.is_empty() || corrects)
}

/// Generated blocks of a scene.
fn grids(scene: &Scene) -> impl Iterator<Item = Grid> {
    scene.bodies.iter().filter_map(|(name, body)| grid(name, body))
}

impl Grid {
    /// Bytes of the Cholesky factor of the block; `kept` marks the sides that are eliminated last.
    fn factor_bytes(&self, kept: [bool; 6], components: usize) -> f64 {
        WORD * factor_cost(self.nodes, kept, components).values
    }

    /// Bytes of a factorisation of the block.
    fn bytes(&self, kept: [bool; 6], components: usize) -> f64 {
        let fronts = if self.counts.kind.dimension() == 3 { FRONTS_IN_SPACE } else { FRONTS_IN_PLANE };
        fronts * self.factor_bytes(kept, components)
    }
}

/// Memory and work of a symmetric factorisation of all bodies; `None` if some are not blocks.
#[must_use]
pub fn factorisation(scene: &Scene) -> Option<Factorisation> {
    let components = idealisation::from_kinematics(*scene.kinematics.get_ref()).components();
    let grids: Vec<Grid> = grids(scene).collect();
    let sum = |of: &dyn Fn(&Grid) -> f64| grids.iter().map(of).sum::<f64>();
    let bytes = sum(&|g| g.bytes([false; 6], components)) as usize;
    let operations = sum(&|g| factor_cost(g.nodes, [false; 6], components).operations);
    (grids.len() == scene.bodies.len()).then_some(Factorisation { bytes, operations })
}

/// Bytes of the factorisations that condense bodies onto their interfaces; `None` if some bodies are not blocks, or if some interfaces are not sides
/// of blocks.
#[must_use]
pub fn condensation(scene: &Scene) -> Option<usize> {
    let components = idealisation::from_kinematics(*scene.kinematics.get_ref()).components();
    let sets = || scene.interfaces.values().flat_map(Interface::sides).map(Spanned::get_ref);
    let mut known = 0;
    let mut bytes = 0.0;
    for grid in grids(scene) {
        let mut kept = [false; 6];
        for (at, side) in SIDES.iter().flatten().enumerate() {
            let named =
                |set: &&String| set.strip_prefix(&grid.body).and_then(|s| s.strip_prefix('.')) == Some(side);
            let count = sets().filter(named).count();
            kept[at] = count > 0;
            known += count;
        }
        bytes += grid.bytes(kept, components);
    }
    (grids(scene).count() == scene.bodies.len() && known == sets().count()).then_some(bytes as usize)
}

/// Refuses a plan whose need exceeds the memory of this machine by more than the error of the estimate.
///
/// # Errors
/// [`Diagnostic`] at the entry that sets the size.
pub fn fits(scene: &Scene, needed: usize) -> Result<(), Diagnostic> {
    match available() {
        Some((there, what)) if SURE * needed as f64 > there as f64 => Err(Diagnostic::at(
            place_of_size(scene),
            format!("the run needs about {}, and {what} {}", size(needed), size(there)),
            "take larger cells, or a machine with more memory; is the unit of the size right?",
        )),
        _ => Ok(()),
    }
}

/// Position of the entry that sets the size of a scene: `memory` in `[solver]` if it is given, because it may be the cause; the
/// resolution of the block with the most nodes; a mesh; a fault.
pub fn place_of_size(scene: &Scene) -> Range<usize> {
    let memory = scene.solver.memory.as_ref().map(Spanned::span);
    let largest = || grids(scene).max_by(|a, b| a.counts.nodes.total_cmp(&b.counts.nodes)).map(|g| g.place);
    let mesh = || {
        scene.bodies.values().next().map(|body| match &body.mesh {
            MeshSource::Fault(mesh) => mesh.spacing.span(),
            MeshSource::Gmsh(mesh) => mesh.file.span(),
            MeshSource::Abaqus(mesh) => mesh.file.span(),
            MeshSource::Quadrilateral(mesh) => mesh.divisions.span(),
            MeshSource::Block(mesh) => mesh.element.span(),
        })
    };
    let fault = || scene.faults.values().next().map(Fault::span);
    memory.or_else(largest).or_else(mesh).or_else(fault).unwrap_or(0..0)
}

/// Vectors of all degrees of freedom in explicit steps: displacements, velocities, damping, masses and forces of the cells; two copies of the
/// first two in a checkpoint, as values and encoded; velocities and displacements of a field, as vectors and encoded.
const VECTORS: usize = 14;

/// Bytes of a mesh and of vectors of its degrees of freedom in explicit steps. The mesh is held three times: for the steps, for
/// figures and for files.
#[must_use]
pub fn in_steps(mesh: usize, dofs: usize) -> usize {
    3 * mesh + size_of::<f64>() * VECTORS * dofs
}

/// Parts of the bodies that a run builds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltParts {
    /// Vectors, for explicit steps.
    Vectors,
    /// Matrices of the cells, condensed onto faults.
    Cells,
    /// Systems of equations.
    Systems,
}

impl BuiltParts {
    /// Parts that the run of a scene builds.
    #[must_use]
    pub fn from_scene(scene: &Scene) -> Self {
        if *scene.time.stepper.get_ref() == Stepper::Explicit {
            Self::Vectors
        } else if scene.faults.is_empty() {
            Self::Systems
        } else {
            Self::Cells
        }
    }

    /// Bytes of bodies of so many cells that a run needs whatever else it does.
    #[must_use]
    pub fn bytes(self, counts: &[Counts], idealisation: Idealisation) -> usize {
        let components = idealisation.components();
        let sum = |of: &dyn Fn(&Counts) -> f64| counts.iter().map(of).sum::<f64>();
        let mesh = sum(&Counts::mesh_bytes);
        (match self {
            Self::Vectors => {
                let dofs = sum(&|c| c.nodes * components as f64);
                return in_steps(mesh as usize, dofs as usize);
            }
            Self::Cells => mesh + 2.0 * sum(&|c| c.stiffness_bytes(components)),
            Self::Systems => sum(&|c| c.cells_bytes(idealisation) + c.matrix_bytes(components)),
        }) as usize
    }

    fn words(self) -> &'static str {
        match self {
            Self::Vectors => "their meshes and vectors",
            Self::Cells | Self::Systems => "their matrices",
        }
    }
}

/// Refuses bodies whose meshes, and what a run builds of them, exceed the memory of the machine.
///
/// # Errors
/// [`Diagnostic`] at the entry that sets the size.
pub fn machine(scene: &Scene, counts: &[Counts]) -> Result<(), Diagnostic> {
    let (built, idealisation) =
        (BuiltParts::from_scene(scene), idealisation::from_kinematics(*scene.kinematics.get_ref()));
    let needed = built.bytes(counts, idealisation);
    match available() {
        Some((there, what)) if needed > there => Err(Diagnostic::at(
            place_of_size(scene),
            format!(
                "{} need {} for {} alone, and {what} {}",
                in_words(counts, idealisation.components()),
                size(needed),
                built.words(),
                size(there)
            ),
            "take larger cells, or a machine with more memory; is the unit of the size right?",
        )),
        _ => Ok(()),
    }
}

fn in_words(counts: &[Counts], components: usize) -> String {
    let (cells, nodes) = counts.iter().fold((0.0, 0.0), |(c, n), of| (c + of.cells, n + of.nodes));
    format!("{cells} cells with {} degrees of freedom", nodes * components as f64)
}

/// Cost of the Cholesky factor, by nested dissection, of a grid with this many nodes along its axes. `kept` marks sides whose nodes are eliminated
/// later.
#[must_use]
pub fn factor_cost(nodes: [usize; 3], kept: [bool; 6], components: usize) -> FactorCost {
    cost(nodes, kept, components as f64, &mut BTreeMap::new())
}

/// Cost of the factor of a box of nodes; `open` marks sides that lie at separators, which are eliminated later.
fn cost(
    nodes: [usize; 3],
    open: [bool; 6],
    components: f64,
    known: &mut BTreeMap<([usize; 3], [bool; 6]), FactorCost>,
) -> FactorCost {
    if let Some(&cost) = known.get(&(nodes, open)) {
        return cost;
    }
    let n = nodes.map(|n| n as f64);
    let all: f64 = n.iter().product();
    let border: f64 = open.iter().enumerate().filter(|(_, open)| **open).map(|(f, _)| all / n[f / 2]).sum();
    let front = |pivots: f64| FactorCost::from_front(components * pivots, components * border);
    let axis = (0..3).max_by_key(|&a| nodes[a]).unwrap_or(0);
    let result = if components * all <= LEAF || nodes[axis] < 3 {
        front(all)
    } else {
        let below = (nodes[axis] - 1) / 2;
        let mut part = |side: usize, count: usize| {
            let (mut nodes, mut open) = (nodes, open);
            nodes[axis] = count;
            open[2 * axis + side] = true;
            cost(nodes, open, components, known)
        };
        front(all / n[axis]) + part(1, below) + part(0, nodes[axis] - 1 - below)
    };
    known.insert((nodes, open), result);
    result
}

/// Memory of the machine, or what is left of a smaller limit of address space \[bytes\], with words that say which.
fn available() -> Option<(usize, &'static str)> {
    let machine = memory_of_machine().map(|there| (there, "this machine has"));
    let limit = asperity_output::memory::addresses_left();
    let limit = limit.map(|left| (left, "the limit of address space of this shell (`ulimit -v`) leaves"));
    machine.into_iter().chain(limit).min_by_key(|(there, _)| *there)
}

/// Memory of the machine, or of the control group of this process if smaller \[bytes\]; `None` if the system does not report it.
fn memory_of_machine() -> Option<usize> {
    let there = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = there.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let total = line.split_whitespace().next()?.parse::<usize>().ok()? * 1024;
    let group = std::fs::read_to_string("/sys/fs/cgroup/memory.max").ok();
    let group = group.and_then(|text| text.trim().parse::<usize>().ok());
    Some(group.map_or(total, |group| group.min(total)))
}
