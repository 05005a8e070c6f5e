//! Outputs of bodies other than fields: displacement and stress at points, forces on sets.

use super::{CellBlock, Model, Stage, StressField};
use asperity_fem::block::von_mises;
use asperity_fem::element::ElementKind;
use asperity_fem::mesh::Location;
use asperity_fem::table::Table;
use nalgebra::{DMatrix, DVector};

/// A point of a body.
#[derive(Clone, Debug)]
pub struct Point {
    /// Name in the scene.
    pub name: String,
    /// Name of its body.
    pub body: String,
    /// Reference position \[m\].
    pub position: Vec<f64>,
    block: usize,
    cell: usize,
    /// Nodes of its cell, with the values of their shape functions at the point.
    shares: Vec<(usize, f64)>,
    /// Weight of each quadrature point of its cell in the stress at the point.
    weights: Vec<f64>,
}

/// A set whose force is requested.
#[derive(Clone, Debug)]
pub struct ForceSet {
    /// Name in the scene.
    pub name: String,
    /// Name of the set, `body.set`.
    pub set: String,
    /// Its nodes, ascending.
    nodes: Vec<usize>,
    /// Cells that contain one of these nodes: block and cell.
    cells: Vec<(usize, usize)>,
}

/// Points and sets of bodies whose values are requested.
#[derive(Clone, Debug, Default)]
pub struct SampleRequest {
    /// Points, by name.
    pub points: Vec<Point>,
    /// Sets, by name.
    pub forces: Vec<ForceSet>,
}

/// Values at a point of a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointValues {
    /// Displacement \[m\].
    pub displacement: [f64; 3],
    /// Cauchy stress xx, yy, zz, xy, yz, zx \[Pa\]: the linear polynomial through the quadrature points of the cell.
    pub stress: [f64; 6],
    /// Mises stress \[Pa\].
    pub mises: f64,
}

/// Values at the points and sets [`SampleRequest`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Values at each point.
    pub points: Vec<PointValues>,
    /// Force that acts on the body through the nodes of each set \[N, or N/m of thickness in the plane\]. It is the sum of
    /// constraint forces, contact forces and the loads on the set.
    pub forces: Vec<[f64; 3]>,
}

/// Loads of a stage that act on nodes of a set but do not belong to it: resultant at unit amplitude \[N, or N/m of thickness\],
/// and amplitude.
pub type ForeignLoads = Vec<([f64; 3], Table)>;

impl SampleRequest {
    /// True if nothing is requested.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.points.is_empty() && self.forces.is_empty()
    }

    /// Loads of a stage on the nodes of each set that do not belong to the set.
    #[must_use]
    pub fn beside<const D: usize>(&self, model: &Model<D>, stage: &Stage) -> Vec<ForeignLoads> {
        let components = model.idealisation.components();
        let one = |wanted: &ForceSet| {
            let channels = stage.loads_beside(&wanted.set).map(|channel| {
                let mut sum = [0.0; 3];
                for &(dof, force) in &channel.forces {
                    if wanted.nodes.binary_search(&(dof / components)).is_ok() {
                        sum[model.idealisation.axis(dof % components)] += force;
                    }
                }
                (sum, channel.amplitude.clone())
            });
            channels.filter(|(sum, _)| *sum != [0.0; 3]).collect()
        };
        self.forces.iter().map(one).collect()
    }

    /// Present values for displacements `u` of the common mesh. `blocks` are the blocks of the mesh in their present state,
    /// `beside` the loads of the present stage.
    #[must_use]
    pub fn values<const D: usize>(
        &self,
        model: &Model<D>,
        blocks: &[CellBlock<D>],
        initial: &[Option<StressField>],
        u: &[f64],
        time: f64,
        beside: &[ForeignLoads],
    ) -> Samples {
        let point = |p: &Point| {
            let stress = p.stress(model, (blocks, initial), u);
            PointValues { displacement: p.displacement(model, u), mises: von_mises(&stress), stress }
        };
        let force = |(set, beside): (&ForceSet, &ForeignLoads)| {
            let mut force = set.internal(model, blocks, u);
            for (sum, amplitude) in beside {
                let amplitude = amplitude.value(time);
                force.iter_mut().zip(sum).for_each(|(f, s)| *f -= amplitude * s);
            }
            force
        };
        Samples {
            points: self.points.iter().map(point).collect(),
            forces: self.forces.iter().zip(beside).map(force).collect(),
        }
    }
}

impl Point {
    /// Makes a point of a body from the cell in which it was found.
    #[must_use]
    pub fn new<const D: usize>(
        model: &Model<D>,
        name: &str,
        body: &str,
        position: Vec<f64>,
        found: &Location,
    ) -> Self {
        let cells = &model.mesh.blocks[found.block];
        let shape = cells.kind.shape(found.xi);
        let rule: Vec<[f64; 3]> =
            model.idealisation.quadrature(cells.kind).into_iter().map(|(xi, _)| xi).collect();
        Self {
            name: name.to_string(),
            body: body.to_string(),
            position,
            block: found.block,
            cell: found.cell,
            shares: cells.cell(found.cell).iter().copied().zip(shape.n).collect(),
            weights: weights(cells.kind, &rule, &found.xi),
        }
    }

    fn displacement<const D: usize>(&self, model: &Model<D>, u: &[f64]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for &(node, share) in &self.shares {
            let at = model.displacement(node, u);
            sum.iter_mut().zip(at).for_each(|(s, a)| *s += share * a);
        }
        sum
    }

    fn stress<const D: usize>(
        &self,
        model: &Model<D>,
        (blocks, initial): (&[CellBlock<D>], &[Option<StressField>]),
        u: &[f64],
    ) -> [f64; 6] {
        let block = &blocks[self.block];
        let stresses: Vec<[f64; 6]> = match block {
            CellBlock::Linear(block) => block.cell_state(self.cell, u).map(|s| s.stress).collect(),
            CellBlock::Nonlinear(block) => block.stress_of_cell(self.cell),
        };
        let mut sum = [0.0; 6];
        for (stress, weight) in stresses.iter().zip(&self.weights) {
            sum.iter_mut().zip(stress).for_each(|(s, t)| *s += weight * t);
        }
        // Nonlinear blocks include their initial stress themselves.
        let body = model.bodies.iter().position(|b| b.blocks.contains(&self.block));
        if let (Some(initial), CellBlock::Linear(_)) = (body.and_then(|b| initial[b].as_ref()), block) {
            sum.iter_mut().zip(initial.at(&self.position)).for_each(|(s, t)| *s += t);
        }
        sum
    }
}

impl ForceSet {
    /// Makes a set of these nodes, which ascend.
    #[must_use]
    pub fn new<const D: usize>(model: &Model<D>, name: &str, set: &str, nodes: Vec<usize>) -> Self {
        let cells = cells_with(model, &nodes);
        Self { name: name.to_string(), set: set.to_string(), nodes, cells }
    }

    /// Sum of nodal forces, given for all degrees of freedom, over the nodes of the set.
    pub(crate) fn sum<const D: usize>(&self, model: &Model<D>, forces: &[f64]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for &node in &self.nodes {
            let force = model.displacement(node, forces);
            sum.iter_mut().zip(force).for_each(|(s, f)| *s += f);
        }
        sum
    }

    /// Sum of the internal forces of the bodies at the nodes of the set.
    fn internal<const D: usize>(&self, model: &Model<D>, blocks: &[CellBlock<D>], u: &[f64]) -> [f64; 3] {
        let components = model.idealisation.components();
        let mut sum = [0.0; 3];
        for &(block, cell) in &self.cells {
            let forces = blocks[block].forces_of_cell(cell, u);
            let nodes = model.mesh.blocks[block].cell(cell);
            for (node, forces) in nodes.iter().zip(forces.chunks_exact(components)) {
                if self.nodes.binary_search(node).is_ok() {
                    for (c, f) in forces.iter().enumerate() {
                        sum[model.idealisation.axis(c)] += f;
                    }
                }
            }
        }
        sum
    }
}

fn cells_with<const D: usize>(model: &Model<D>, nodes: &[usize]) -> Vec<(usize, usize)> {
    let blocks = model.mesh.blocks.iter().enumerate();
    let has = |n: &usize| nodes.binary_search(n).is_ok();
    blocks
        .flat_map(|(b, cells)| {
            (0..cells.len()).filter(move |&c| cells.cell(c).iter().any(has)).map(move |c| (b, c))
        })
        .collect()
}

/// Weights of values at the points of a rule that give, at `xi`, their least-squares fit by a linear polynomial in natural
/// coordinates; equal weights if the points do not determine a fit. Stresses are most accurate at these points (Barlow 1976),
/// and the polynomial carries this accuracy to the boundary of the cell.
fn weights(kind: ElementKind, rule: &[[f64; 3]], xi: &[f64; 3]) -> Vec<f64> {
    let (n, terms) = (rule.len(), kind.dimension() + 1);
    let basis = |x: &[f64; 3], k: usize| if k == 0 { 1.0 } else { x[k - 1] };
    let p = DMatrix::from_fn(n, terms, |q, k| basis(&rule[q], k));
    let here = DVector::from_fn(terms, |k, _| basis(xi, k));
    let normal = p.transpose() * &p;
    match normal.cholesky() {
        Some(factor) if n >= terms => (p * factor.solve(&here)).iter().copied().collect(),
        _ => vec![1.0 / n as f64; n],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_fem::kinematics::Idealisation;

    #[test]
    fn weights_carry_linear_fields_to_any_place_of_any_element() {
        for kind in ElementKind::ALL {
            let space = Idealisation::from_dimension(kind.dimension());
            let rule: Vec<[f64; 3]> = space.quadrature(kind).into_iter().map(|(xi, _)| xi).collect();
            let f =
                |x: &[f64; 3]| 2.0 + x[0] - 3.0 * x[1] + if kind.dimension() == 3 { 0.5 * x[2] } else { 0.0 };
            for xi in kind.node_coordinates() {
                let w = weights(kind, &rule, xi);
                let sum: f64 = w.iter().sum();
                assert!((sum - 1.0).abs() < 1e-13, "{kind:?} {sum}");
                let value: f64 = w.iter().zip(&rule).map(|(w, x)| w * f(x)).sum();
                let exact = if rule.len() > kind.dimension() { f(xi) } else { f(&rule[0]) };
                assert!((value - exact).abs() < 1e-12, "{kind:?} {value} {exact}");
            }
        }
    }
}
