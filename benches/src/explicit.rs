//! Elastic bodies in explicit steps, the memory that a step moves, and the rate at which the machine moves it.

use asperity_fem::FemError;
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_mechanics::dynamics::{Explicit, Problem};
use asperity_mechanics::{Body, CellBlock, Model, Stage};

/// Density of granite \[kg/m³\].
const DENSITY: f64 = 2670.0;

/// Duration of the only stage \[s\], far more than any bench takes.
const LONG: f64 = 1e6;

/// Cells along each axis, so that the vectors of a step do not fit into the caches.
pub const SIZES: [(ElementKind, usize); 5] = [
    (ElementKind::Quad4, 800),
    (ElementKind::Tri3, 700),
    (ElementKind::Quad9, 400),
    (ElementKind::Hex8, 80),
    (ElementKind::Tet4, 60),
];

/// A block of rock that moves freely, `n` cells along each axis, whose nodes move apart at the start.
///
/// # Errors
/// Never: the mesh and the material are admissible.
pub fn rock<const D: usize>(kind: ElementKind, n: usize) -> Result<Problem<D>, FemError> {
    let block =
        Block { min: [0.0; D], max: [1e3; D], divisions: [n; D], grading: [Grading::Uniform; D], kind };
    let mesh = block.mesh()?;
    let (rock, idealisation) = (Elastic::new(80e9, 0.25)?, Idealisation::from_dimension(D));
    let cells = LinearBlock::new(&mesh, 0, &rock, idealisation, Formulation::Standard)?;
    let dofs = mesh.nodes.len() * D;
    let body = Body {
        name: "rock".into(),
        nodes: 0..mesh.nodes.len(),
        blocks: 0..1,
        elastic: vec![rock],
        size: None,
        parts: Vec::new(),
        nonlinear: None,
        dofs: 0..dofs,
    };
    let blocks = vec![CellBlock::Linear(Box::new(cells))];
    Ok(Problem {
        model: Model { bodies: vec![body], mesh, blocks, idealisation, scale: 1.0 },
        density: vec![DENSITY],
        courant: 0.5,
        viscosity: 0.0,
        fault: None,
        absorbing: Vec::new(),
        stages: vec![Stage::free("move", LONG)],
        velocity: (0..dofs).map(|k| (0.37 * k as f64).sin()).collect(),
    })
}

/// Bytes that a step reads and writes if each value moves once in each of its two passes. The forces read displacements and what the
/// cells keep, and write forces. The motion reads these, masses and inverse masses, and reads and writes displacements and velocities.
#[must_use]
pub fn traffic<const D: usize>(run: &Explicit<'_, D>) -> usize {
    let dofs = run.displacement().len();
    let vectors = 1 + 2 + 2;
    run.product().moved() + size_of::<f64>() * (vectors * dofs + 2 * dofs / D)
}

/// Numbers of each array of the triad.
pub const TRIAD: usize = 8 << 20;

/// Bytes of the triad: two arrays read and one written.
pub const TRIAD_BYTES: usize = 3 * TRIAD * size_of::<f64>();

/// Arrays of the triad a = b + s c (McCalpin 1995, STREAM), too large for the caches.
#[derive(Debug)]
pub struct Triad {
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
}

impl Default for Triad {
    fn default() -> Self {
        let of = |start: f64| (0..TRIAD).map(|k| start + k as f64).collect();
        Self { a: of(0.0), b: of(1.0), c: of(2.0) }
    }
}

impl Triad {
    /// Computes the triad on all threads of the pool.
    pub fn compute(&mut self, s: f64) -> f64 {
        use rayon::prelude::*;
        const PART: usize = 1 << 16;
        let arrays = self.a.par_chunks_mut(PART).zip(self.b.par_chunks(PART)).zip(self.c.par_chunks(PART));
        arrays.for_each(|((a, b), c)| {
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                *a = b + s * c;
            }
        });
        self.a[0]
    }
}
