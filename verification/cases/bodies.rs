//! Elastic bodies of the cases: a mapped structured block of any element, boundary conditions from a known field, its solution,
//! errors, and the claims of a convergence study.

use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_fem::assembly::{Storage, Symmetry, System};
use asperity_fem::block::{FieldValue, LinearBlock};
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Dilatation, Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, Side, nodes_of_sides};
use asperity_fem::surface::{self, FacePoint};
use asperity_fem::term::{Instant, Term};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// A known displacement field and the body force that balances it.
pub trait Field<const D: usize> {
    /// Displacement and its gradient.
    fn at(&self, x: &[f64; D]) -> FieldValue;

    /// Body force \[N/m³\].
    fn force(&self, _x: &[f64; D]) -> [f64; 3] {
        [0.0; 3]
    }
}

/// Stress xx, yy, zz, xy, yz, zx of a field in an idealisation of space.
pub fn stress<const D: usize>(
    material: &Elastic,
    space: Idealisation,
    x: &[f64; D],
    (value, gradient): FieldValue,
) -> [f64; 6] {
    let mut h = [[0.0; 3]; 3];
    for c in 0..space.components() {
        h[space.axis(c)][..D].copy_from_slice(&gradient[c][..D]);
    }
    match space {
        Idealisation::Axisymmetric => h[2][2] = value[0] / x[0],
        Idealisation::PlaneStress => {
            h[2][2] = -material.poisson() / (1.0 - material.poisson()) * (h[0][0] + h[1][1]);
        }
        _ => {}
    }
    material.stress(&h)
}

/// A block of `divisions` elements between 0 and 1 along each axis.
pub fn unit_block<const D: usize>(kind: ElementKind, divisions: [usize; D]) -> Result<Mesh<D>, CaseError> {
    let grading = [Grading::Uniform; D];
    Ok(Block { min: [0.0; D], max: [1.0; D], divisions, grading, kind }.mesh()?)
}

/// Maps every node: second-order elements get curved edges.
pub fn mapped<const D: usize>(mut mesh: Mesh<D>, map: impl Fn(&[f64; D]) -> [f64; D]) -> Mesh<D> {
    mesh.nodes.iter_mut().for_each(|x| *x = map(x));
    mesh
}

/// Maps the corner nodes; midside nodes stay midway, so that edges remain straight.
pub fn straight<const D: usize>(mut mesh: Mesh<D>, map: impl Fn(&[f64; D]) -> [f64; D]) -> Mesh<D> {
    let before = mesh.nodes.clone();
    for cells in &mesh.blocks {
        let linear = cells.kind.linear();
        for cell in 0..cells.len() {
            let ids = cells.cell(cell);
            let corners: Vec<[f64; D]> =
                ids[..cells.kind.corners()].iter().map(|&n| map(&before[n])).collect();
            for (&id, &xi) in ids.iter().zip(cells.kind.node_coordinates()) {
                let shape = linear.shape(xi);
                mesh.nodes[id] =
                    std::array::from_fn(|c| corners.iter().zip(&shape.n).map(|(x, n)| n * x[c]).sum());
            }
        }
    }
    mesh
}

/// Shape of the cells of a unit block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Interior corners move by a fixed fraction of the element size in alternating directions: shapes do not improve with
    /// refinement.
    Crooked,
    /// Interior corners move by a smooth map.
    Mapped,
    /// Uniform shear: elements are affine images of the reference element.
    Sheared,
}

/// Displacements of corners as fractions of the element size or of the block.
const MOVE: [f64; 3] = [0.13, -0.09, 0.11];

/// A distorted unit block of n elements along each axis with its lower corner at `lower`.
pub fn distorted<const D: usize>(
    kind: ElementKind,
    n: usize,
    shape: Shape,
    lower: [f64; D],
) -> Result<Mesh<D>, CaseError> {
    let mesh = unit_block(kind, [n; D])?;
    let inside = |x: &[f64; D]| {
        let index: [usize; D] = x.map(|x| (x * n as f64).round() as usize);
        index.iter().all(|&i| i > 0 && i < n).then_some(index)
    };
    let moved = straight(mesh, |x| match (shape, inside(x)) {
        // In axisymmetry the boundary x = 0 must not move.
        (Shape::Sheared, _) => {
            std::array::from_fn(|c| x[c] + if c == 0 { 0.0 } else { 0.3 * x[0] + 0.15 * x[(c + 1) % D] })
        }
        (_, None) => *x,
        (Shape::Mapped, _) => {
            let wave: f64 = x.iter().map(|x| (PI * x).sin()).product();
            std::array::from_fn(|c| x[c] + MOVE[c] * wave)
        }
        (Shape::Crooked, Some(index)) => std::array::from_fn(|c| {
            let even = (index.iter().sum::<usize>() + c * index[0]).is_multiple_of(2);
            x[c] + MOVE[c] / n as f64 * if even { 1.0 } else { -1.0 }
        }),
    });
    Ok(mapped(moved, |x| std::array::from_fn(|c| x[c] + lower[c])))
}

/// A mesh with its stiffness, prescribed displacements and loads.
#[derive(Clone)]
pub struct Body<const D: usize> {
    /// Mesh.
    pub mesh: Mesh<D>,
    /// Stiffness and stress.
    pub block: LinearBlock<D>,
    material: Elastic,
    prescribed: BTreeMap<usize, f64>,
    forces: Vec<(usize, f64)>,
}

/// A solved body.
pub struct Solution {
    /// Displacement \[m\].
    pub u: Vec<f64>,
    /// Cost of the solution: unknowns, factorisations, solves.
    pub work: Cost,
    /// Unknowns.
    pub unknowns: usize,
}

impl<const D: usize> Body<D> {
    /// A body without boundary conditions.
    pub fn new(
        mesh: Mesh<D>,
        material: &Elastic,
        space: Idealisation,
        formulation: Formulation,
    ) -> Result<Self, CaseError> {
        let block = LinearBlock::new(&mesh, 0, material, space, formulation)?;
        Ok(Self { mesh, block, material: *material, prescribed: BTreeMap::new(), forces: Vec::new() })
    }

    /// Number of displacement components of a node.
    fn components(&self) -> usize {
        self.block.idealisation().components()
    }

    /// Faces of the side sets.
    fn sides(&self, sets: &[&str]) -> Vec<Side> {
        sets.iter().filter_map(|name| self.mesh.side_sets.get(*name)).flatten().copied().collect()
    }

    /// Prescribes one component on a set.
    pub fn fix(mut self, set: &str, component: usize, value: f64) -> Self {
        for node in nodes_of_sides(&self.mesh, &self.sides(&[set])) {
            self.prescribed.insert(node * self.components() + component, value);
        }
        self
    }

    /// Prescribes a field on sets.
    pub fn hold(mut self, sets: &[&str], field: &dyn Field<D>) -> Self {
        let components = self.components();
        for node in nodes_of_sides(&self.mesh, &self.sides(sets)) {
            let value = field.at(&self.mesh.nodes[node]).0;
            (0..components).for_each(|c| {
                self.prescribed.insert(node * components + c, value[c]);
            });
        }
        self
    }

    /// Prescribes a field on the whole boundary.
    pub fn hold_all(self, field: &dyn Field<D>) -> Self {
        self.hold(&["left", "right", "bottom", "top", "back", "front"], field)
    }

    /// Applies the tractions of a field on sets.
    pub fn pull(self, sets: &[&str], field: &dyn Field<D>) -> Self {
        let (material, space) = (self.material, self.block.idealisation());
        self.load(sets, |point, t| {
            let s = stress(&material, space, &point.position, field.at(&point.position));
            let rows = [[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]];
            for (c, t) in t.iter_mut().enumerate() {
                *t = rows[space.axis(c)].iter().zip(&point.normal).map(|(s, n)| s * n).sum();
            }
        })
    }

    /// Applies a traction on sets. The traction must include the area factor, the length of the normal passed to it.
    pub fn load(mut self, sets: &[&str], traction: impl Fn(&FacePoint<D>, &mut [f64])) -> Self {
        let sides = self.sides(sets);
        self.forces.extend(surface::integrate(&self.mesh, &sides, self.block.idealisation(), traction));
        self
    }

    /// Applies the body force of a field.
    pub fn weigh(mut self, field: &dyn Field<D>) -> Self {
        let components = self.components();
        self.forces.extend(
            self.block.body_force_field(&self.mesh, |x, f| f.copy_from_slice(&field.force(x)[..components])),
        );
        self
    }

    /// Solves.
    pub fn solve(&self) -> Result<Solution, CaseError> {
        let n = self.mesh.nodes.len() * self.components();
        let mut u = vec![0.0; n];
        self.prescribed.iter().for_each(|(&dof, &value)| u[dof] = value);
        let fixed = self.prescribed.keys().copied().collect();
        let equations = Constraints { fixed, channels: Vec::new() }.equations(n);
        let mut block = self.block.clone();
        let mut r = vec![0.0; n];
        let start = Instant { time: 0.0, dt: 1.0 };
        block.residual(&u, start, &mut r).map_err(|refusal| format!("{refusal:?}"))?;
        self.forces.iter().for_each(|&(dof, f)| r[dof] -= f);
        let mut x: Vec<f64> = equations.free.iter().map(|&dof| -r[dof]).collect();
        let free = equations.free.clone();
        let mut system = System::new(equations, Storage::Sparse).with_symmetry(Symmetry::Positive);
        system.factor_tangent(&mut [&mut block])?;
        system.solve(&mut x)?;
        free.iter().zip(&x).for_each(|(&dof, x)| u[dof] = *x);
        let work = Cost::default()
            .count("unknowns", x.len() as f64)
            .count("factorisations", system.factorisations as f64)
            .count("solves", system.solves as f64);
        Ok(Solution { u, work, unknowns: x.len() })
    }

    /// Nodal values of a field.
    pub fn nodal(&self, field: &dyn Field<D>) -> Vec<f64> {
        let components = self.components();
        self.mesh.nodes.iter().flat_map(|x| field.at(x).0[..components].to_vec()).collect()
    }

    /// Errors in L2 and in the H1 seminorm, relative to the same norms of the field.
    pub fn errors(&self, u: &[f64], field: &dyn Field<D>) -> [f64; 2] {
        let error = self.block.error_norms(&self.mesh, u, |x| field.at(x));
        let norm = self.block.error_norms(&self.mesh, &vec![0.0; u.len()], |x| field.at(x));
        [error[0] / norm[0], error[1] / norm[1]]
    }

    /// Error of the stress at the quadrature points in L2, relative to that of the field.
    pub fn stress_error(&self, u: &[f64], field: &dyn Field<D>) -> f64 {
        let exact = |x: &[f64; D]| stress(&self.material, self.block.idealisation(), x, field.at(x));
        self.block.stress_error(u, exact) / self.block.stress_error(&vec![0.0; u.len()], exact)
    }

    /// Displacement of the node nearest to a point.
    pub fn at(&self, u: &[f64], place: [f64; D]) -> [f64; 3] {
        let distance = |x: &[f64; D]| x.iter().zip(place).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let nodes = self.mesh.nodes.iter().enumerate();
        let nearest = nodes.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map_or(0, |(n, _)| n);
        let components = self.components();
        std::array::from_fn(|c| if c < components { u[nearest * components + c] } else { 0.0 })
    }
}

/// One mesh of a study.
#[derive(Clone)]
pub struct Level {
    /// Element size over the size of the body.
    pub h: f64,
    /// Relative errors of displacement (L2) and its gradient (H1).
    pub errors: [f64; 2],
    /// The same errors of the nodal interpolant of the field on the same mesh, for comparison.
    pub nodal: [f64; 2],
    /// Relative error of the stress (L2 at quadrature points).
    pub stress: f64,
    /// Unknowns.
    pub unknowns: usize,
    /// Cost of assembly and solution.
    pub cost: Cost,
}

/// Solves one level. `build` makes the body with its boundary conditions for an element. With a mean pressure a second-order
/// element keeps the order of the first-order element on its corners, whose interpolant then serves for comparison.
pub fn level<const D: usize>(
    h: f64,
    kind: ElementKind,
    (space, formulation): (Idealisation, Formulation),
    field: &dyn Field<D>,
    build: impl Fn(ElementKind, Formulation) -> Result<Body<D>, CaseError>,
) -> Result<Level, CaseError> {
    let (solved, cost) = Cost::measure(|| {
        let body = build(kind, formulation)?;
        let solved = body.solve()?;
        Ok::<_, CaseError>((body, solved))
    });
    let (body, solved) = solved?;
    let errors = body.errors(&solved.u, field);
    let nodal = if formulation.dilatation(kind, space)? == Some(Dilatation::ConstantPressure) {
        let linear = build(kind.linear(), Formulation::Standard)?;
        linear.errors(&linear.nodal(field), field)
    } else {
        body.errors(&body.nodal(field), field)
    };
    let stress = body.stress_error(&solved.u, field);
    let cost = Cost { work: solved.work.work, ..cost };
    Ok(Level { h, errors, nodal, stress, unknowns: solved.unknowns, cost })
}

/// Expectations of a convergence study.
pub struct Orders {
    /// Theoretical orders of displacement and gradient.
    pub expected: [f64; 2],
    /// Deviation allowed for observed orders.
    pub within: [f64; 2],
    /// True if higher orders are accepted.
    pub or_better: bool,
    /// True if loads drive the body: see [`COMPLIANCE`].
    pub loaded: bool,
    /// Reason for these orders.
    pub because: String,
    /// Capabilities covered.
    pub covers: Vec<Capability>,
    /// Kind of evidence and its source.
    pub evidence: (Evidence, &'static str),
}

/// Bounds of the error over that of the interpolant, for displacements prescribed on the whole boundary or symmetry that excludes
/// rigid motion. In the energy norm no function of the space with these boundary values is closer than the solution (Céa), and G
/// |∇v|² <= a(v, v) <= (λ + 2G) |∇v|² for v = 0 on the boundary: √((λ+2G)/G) = 1.87 for ν = 0.3. In L2 the lemma of Aubin and
/// Nitsche gives the order but no sharp constant; 2 is chosen.
const CEA: [f64; 2] = [2.0, 1.9];

/// Reason why [`CEA`].
const CEA_REASON: &str = "interpolation of the exact field on the same mesh, computed before the solution, times 1.9 \
     in H1 (Cea: sqrt((lambda+2G)/G) = 1.87 for nu = 0.3) and 2 in L2 (duality gives the order; the factor is chosen)";

/// Addition of loads to the bound in L2: the work of the load falls short by the square of the relative energy error (Galerkin),
/// and with it the displacement in the whole body.
const COMPLIANCE: &str =
    "; and, as a load drives the body, the square of the bound in H1: by that share its work is too small";

/// Claims orders and finest errors, in L2 and H1.
pub fn claim(ledger: &mut Ledger, name: &str, levels: &[Level], orders: &Orders) {
    let Some(finest) = levels.last() else { return };
    let h1 = CEA[1] * finest.nodal[1];
    let l2 = CEA[0] * finest.nodal[0];
    let bounds = if orders.loaded { [l2 + h1 * h1, h1] } else { [l2, h1] };
    let reason = format!("{CEA_REASON}{}", if orders.loaded { COMPLIANCE } else { "" });
    for (k, norm) in ["displacement, L2", "displacement gradient, H1"].into_iter().enumerate() {
        let points: Vec<(f64, f64)> = levels.iter().map(|l| (l.h, l.errors[k])).collect();
        let mut draft = ledger
            .order(format!("{name}: {norm}"))
            .norm("relative to the norm of the field")
            .levels(&points)
            .expected(orders.expected[k])
            .within(orders.within[k]);
        if orders.or_better {
            draft = draft.or_better();
        }
        draft
            .evidence(orders.evidence.0, orders.evidence.1)
            .because(orders.because.clone())
            .finest(bounds[k], reason.clone())
            .why_not_tighter("a superconvergent or symmetric mesh does better than the theory's constant")
            .covers(&orders.covers)
            .cost(&finest.cost)
            .record();
    }
}
