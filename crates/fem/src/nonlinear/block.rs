//! The block as a term: residual, consistent tangent, history.

use super::body::Body;
use super::cell::{CellError, Scratch};
use super::model::{Model, ModelError, with_material};
use crate::element::ElementKind;
use crate::material::constitutive::{ConstitutiveLaw, Voigt, contract};
use crate::mesh::Mesh;
use crate::term::{Instant, Linearized, Pattern, Refusal, Restorable, Term};

/// A quantity at the last accepted state and at the trial state.
#[derive(Clone, Debug, Default)]
pub(super) struct StatePair {
    pub committed: Vec<f64>,
    pub trial: Vec<f64>,
}

impl StatePair {
    pub fn zeros(n: usize) -> Self {
        Self { committed: vec![0.0; n], trial: vec![0.0; n] }
    }

    fn accept(&mut self) {
        self.committed.copy_from_slice(&self.trial);
    }

    fn reject(&mut self) {
        self.trial.copy_from_slice(&self.committed);
    }
}

/// Cells of one kind, one material, one kinematics. See the module.
#[derive(Clone, Debug)]
pub struct Block<const D: usize> {
    pub(super) name: String,
    pub(super) body: Body<D>,
    /// Displacements in local numbering \[m\].
    pub(super) u: StatePair,
    /// History of all points.
    pub(super) state: StatePair,
    /// Forces of each cell, before summation.
    pub(super) forces: Vec<f64>,
    /// Zeros: the start of every step of a material without memory.
    pub(super) none: Vec<f64>,
    pub(super) dt: f64,
}

impl<const D: usize> Block<D> {
    /// Block `block` of `mesh`, without stress; degree of freedom = node * components + component.
    ///
    /// # Errors
    /// [`ModelError`] for an inverted cell and for combinations that do not exist.
    pub fn new(mesh: &Mesh<D>, block: usize, model: Model) -> Result<Self, ModelError> {
        let body = Body::new(mesh, block, model)?;
        let (cells, width) = (body.cells.len(), body.frame.width());
        let dofs = body.nodes.len() * body.frame.components;
        Ok(Self {
            name: format!("cells {block}"),
            u: StatePair::zeros(dofs),
            state: StatePair::zeros(cells * body.state_size()),
            forces: vec![0.0; cells * width],
            none: vec![0.0; if body.frame.layout.stride == 0 { dofs } else { 0 }],
            dt: 0.0,
            body,
        })
    }

    /// The same block, with the name used in its refusals.
    #[must_use]
    pub fn named(mut self, name: String) -> Self {
        self.name = name;
        self
    }

    /// Sets the Kirchhoff stress at the start \[Pa\] as a function of cell and quadrature point.
    ///
    /// # Errors
    /// [`ModelError::Combination`] for a block that keeps no stress (small strain, elastic), for stress through the thickness
    /// in plane stress, and for viscoelastic materials of several elements, among which the division of the stress is unknown.
    pub fn prestress(&mut self, stress: impl Fn(usize, usize) -> Voigt) -> Result<(), ModelError> {
        let refuse = |reason| Err(ModelError::Combination { combination: "initial stress", reason });
        let (layout, points) = (self.body.frame.layout, self.body.frame.points());
        if layout.stride == 0 {
            return refuse("a small-strain elastic block keeps no stress: add its forces to the loads");
        }
        if layout.tensors > 0 {
            return refuse("the shares of several viscoelastic elements in it are unknown");
        }
        for (k, state) in self.state.committed.chunks_exact_mut(layout.stride).enumerate() {
            let s = stress(k / points, k % points);
            if self.body.frame.plane_stress && s[2] != 0.0 {
                return refuse("in plane stress the component zz is zero");
            }
            state[..6].copy_from_slice(&s);
        }
        self.state.reject();
        Ok(())
    }

    /// As [`Block::prestress`], for the stress at each position.
    ///
    /// # Errors
    /// As [`Block::prestress`].
    pub fn prestress_field(&mut self, stress: impl Fn(&[f64; D]) -> Voigt) -> Result<(), ModelError> {
        let body = &self.body;
        let at = |cell: usize, point: usize| {
            let mut x = body.origin;
            let shapes = body.frame.n.chunks_exact(body.frame.nodes).nth(point).unwrap_or_default();
            for (&node, n) in body.cells.cell(cell).iter().zip(shapes) {
                x.iter_mut().zip(&body.reference[node]).for_each(|(x, p)| *x += n * p);
            }
            x
        };
        let points = body.frame.points();
        let places: Vec<[f64; D]> = (0..body.cells.len())
            .flat_map(|c| (0..points).map(move |q| (c, q)))
            .map(|(c, q)| at(c, q))
            .collect();
        self.prestress(|cell, point| stress(&places[cell * points + point]))
    }

    /// Memory of the block with its history \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        let body = &self.body;
        let lists = body.cells.connectivity.len() + body.nodes.len() + body.pattern.dofs().len();
        let two = |of: &StatePair| of.committed.len() + of.trial.len();
        let values = [two(&self.u), two(&self.state), self.forces.len(), self.none.len()];
        (lists + values.iter().sum::<usize>() + body.volumes.len()) * std::mem::size_of::<f64>()
            + size_of_val(body.reference.as_slice())
    }

    /// Kind of the cells.
    #[must_use]
    pub fn kind(&self) -> ElementKind {
        self.body.cells.kind
    }

    /// Material and options.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.body.model
    }

    /// Numbers kept at each quadrature point, including stress; 0 if the state follows from the displacements alone.
    #[must_use]
    pub fn kept_per_point(&self) -> usize {
        self.body.frame.layout.stride
    }

    /// Copies this block's displacements from those of the system.
    pub(super) fn take(&mut self, u: &[f64]) {
        let c = self.body.frame.components;
        for (own, &node) in self.u.trial.chunks_exact_mut(c).zip(&self.body.nodes) {
            own.copy_from_slice(&u[node * c..(node + 1) * c]);
        }
    }

    /// Displacements at the start of the step.
    pub(super) fn start(&self) -> &[f64] {
        if self.none.is_empty() { &self.u.committed } else { &self.none }
    }

    /// Computes trial stress, history and forces from the trial displacements.
    pub(super) fn evaluate(&mut self) -> Result<(), Refusal> {
        let mut forces = std::mem::take(&mut self.forces);
        let mut state = std::mem::take(&mut self.state.trial);
        let result =
            with_material!(&self.body.model.material, m => self.evaluate_with(m, &mut forces, &mut state));
        self.forces = forces;
        self.state.trial = state;
        result.map_err(|error| self.refusal(&error))
    }

    pub(super) fn refusal(&self, error: &CellError) -> Refusal {
        Refusal { term: self.name.clone(), reason: error.to_string() }
    }

    fn evaluate_with<M: ConstitutiveLaw>(
        &self,
        material: &M,
        forces: &mut [f64],
        state: &mut [f64],
    ) -> Result<(), CellError> {
        let body = &self.body;
        let sizes = (body.frame.width(), body.state_size());
        body.chunks(forces, sizes.0, state, sizes.1, |scratch, mut task| {
            for (cell, f, new) in task.cells() {
                self.step(cell, scratch)?;
                let (volumes, old) = (body.cell_volumes(cell), body.cell_state(cell, &self.state.committed));
                scratch.stresses(&body.frame, material, self.dt, old, new, false);
                scratch.forces(&body.frame, volumes, f);
                if f.iter().any(|f| !f.is_finite()) {
                    return Err(CellError::Forces { cell });
                }
            }
            Ok(())
        })
        .into_iter()
        .collect()
    }

    /// Computes the motion of a cell over the step; refused if the cell is inverted.
    pub(super) fn step(&self, cell: usize, scratch: &mut Scratch<D>) -> Result<(), CellError> {
        let body = &self.body;
        body.gather(cell, self.start(), &self.u.trial, scratch);
        scratch.motion(&body.frame, body.cell_volumes(cell)).map_err(|inverted| {
            let middle: Vec<String> = body.middle(cell).iter().map(|x| format!("{x:.4e}")).collect();
            CellError::Inverted { cell, middle: middle.join(", "), inverted }
        })?;
        if !body.frame.finite {
            return Ok(());
        }
        let most = body.model.limits.refused;
        for (point, increment) in scratch.increments.iter().enumerate() {
            let size = size_of(&increment.strain);
            if size > most || !size.is_finite() {
                return Err(CellError::Increment { cell, point, size, most });
            }
        }
        Ok(())
    }

    /// Adds the forces of all cells in order.
    pub(super) fn scatter(&self, forces: &[f64], r: &mut [f64]) {
        for (&dof, f) in self.body.pattern.dofs().iter().zip(forces) {
            r[dof] += f;
        }
    }
}

/// √(ε:ε) of an engineering strain.
pub(super) fn size_of(strain: &Voigt) -> f64 {
    let e: Voigt = std::array::from_fn(|i| if i < 3 { strain[i] } else { 0.5 * strain[i] });
    contract(&e, &e).sqrt()
}

impl<const D: usize> Term for Block<D> {
    fn name(&self) -> &str {
        &self.name
    }

    fn residual(&mut self, u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        self.take(u);
        self.dt = at.dt;
        self.evaluate()?;
        self.scatter(&self.forces, r);
        Ok(())
    }

    fn accept(&mut self) {
        self.u.accept();
        self.state.accept();
    }

    fn reject(&mut self) {
        self.u.reject();
        self.state.reject();
    }
}

impl<const D: usize> Linearized for Block<D> {
    fn pattern(&self) -> &Pattern {
        &self.body.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        with_material!(&self.body.model.material, m => self.tangent_with(m, values));
    }
}

impl<const D: usize> Block<D> {
    fn tangent_with<M: ConstitutiveLaw>(&self, material: &M, values: &mut [f64]) {
        let body = &self.body;
        let width = body.frame.width();
        body.chunks(values, width * width, &mut [], 0, |scratch, mut task| {
            for (cell, k, _) in task.cells() {
                // The residual at this state has been evaluated: the motion is admissible.
                if self.step(cell, scratch).is_err() {
                    k.fill(f64::NAN);
                    continue;
                }
                let (volumes, old) = (body.cell_volumes(cell), body.cell_state(cell, &self.state.committed));
                scratch.linearised(&body.frame, material, self.dt, old);
                scratch.tangent(&body.frame, volumes, k);
            }
        });
    }
}

impl<const D: usize> Restorable for Block<D> {
    /// Displacements, followed by the numbers kept at the quadrature points.
    type State = Vec<f64>;

    fn save(&self) -> Vec<f64> {
        [&self.u, &self.state].iter().flat_map(|two| two.committed.iter().copied()).collect()
    }

    fn restore(&mut self, saved: &Vec<f64>) -> bool {
        let parts = [&mut self.u, &mut self.state];
        if saved.len() != parts.iter().map(|p| p.committed.len()).sum::<usize>() {
            return false;
        }
        let mut rest = saved.as_slice();
        for part in parts {
            let (own, others) = rest.split_at(part.committed.len());
            part.committed.copy_from_slice(own);
            part.reject();
            rest = others;
        }
        true
    }
}
