//! Forward steps: the rate tangent and its limits.
//!
//! The rate of the forces over the current configuration is `∫ ∂δu_i/∂x_j Σ_ijkl ∂v_k/∂x_l dV` with
//! `Σ_ijkl = C^ep_ijkl + (τ_jl δ_ik - τ_ik δ_jl - τ_il δ_jk - τ_jk δ_il)/2` over the reference volumes: the consistent tangent of
//! a step of length zero, with the continuum moduli.

use super::block::{Block, size_of};
use super::cell::{CellError, Scratch};
use super::model::with_material;
use crate::material::constitutive::ConstitutiveLaw;
use crate::term::{ForwardTerm, Fraction, Instant, Refusal};

/// A limit found at a point.
#[derive(Clone, Copy, Debug)]
struct PointLimit {
    value: f64,
    limit: &'static str,
    event: &'static str,
    cell: usize,
    point: usize,
}

/// The smaller of two limits; the first if equal, so that the order of cells decides.
fn smaller(a: Option<PointLimit>, b: Option<PointLimit>) -> Option<PointLimit> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.value < a.value { b } else { a }),
        (a, b) => a.or(b),
    }
}

impl<const D: usize> Block<D> {
    /// Computes the forward tangent of one cell from the committed state into `k`, and the forces by which its stresses change
    /// over `dt` at rest into `f`.
    fn forward_cell<M: ConstitutiveLaw>(
        &self,
        material: &M,
        dt: f64,
        cell: usize,
        scratch: &mut Scratch<D>,
        k: &mut [f64],
        f: &mut [f64],
    ) -> Result<(), CellError> {
        let body = &self.body;
        let (frame, volumes) = (&body.frame, body.cell_volumes(cell));
        let old = body.cell_state(cell, &self.state.committed);
        body.gather(cell, &self.u.committed, &self.u.committed, scratch);
        scratch.motion(frame, volumes).map_err(|_| CellError::InvertedBefore { cell })?;
        scratch.forward(frame, material, dt, old);
        scratch.tangent(frame, volumes, k);
        if M::RELAXES {
            scratch.relaxation(frame, volumes, material, dt, old, f);
        } else {
            f.fill(0.0);
        }
        Ok(())
    }

    /// Computes the rate tangents, and the force of each cell that does not depend on Δu.
    fn rate_with<M: ConstitutiveLaw>(
        &self,
        material: &M,
        dt: f64,
        values: &mut [f64],
        forces: &mut [f64],
    ) -> Result<(), CellError> {
        let width = self.body.frame.width();
        self.body
            .chunks(values, width * width, forces, width, |scratch, mut task| {
                task.cells().try_for_each(|(cell, k, f)| self.forward_cell(material, dt, cell, scratch, k, f))
            })
            .into_iter()
            .collect()
    }

    fn limit_with<M: ConstitutiveLaw>(&self, material: &M) -> Option<PointLimit> {
        let mut marks = vec![0.0; self.body.cells.len()];
        self.body
            .chunks(&mut marks, 1, &mut [], 0, |scratch, mut task| {
                let mut best = None;
                for (cell, _, _) in task.cells() {
                    best = smaller(best, self.cell_limit(material, cell, scratch));
                }
                best
            })
            .into_iter()
            .fold(None, smaller)
    }

    fn cell_limit<M: ConstitutiveLaw>(
        &self,
        material: &M,
        cell: usize,
        scratch: &mut Scratch<D>,
    ) -> Option<PointLimit> {
        let (body, limits) = (&self.body, &self.body.model.limits);
        let found = |value, limit, event, point| Some(PointLimit { value, limit, event, cell, point });
        body.gather(cell, &self.u.committed, &self.u.trial, scratch);
        if let Err(bad) = scratch.motion(&body.frame, body.cell_volumes(cell)) {
            return found(HALF, "r2", "cell inside out", bad.point);
        }
        let mut best = None;
        let old = body.cell_state(cell, &self.state.committed);
        for point in 0..body.frame.points() {
            if body.frame.finite {
                let increment = &scratch.increments[point];
                let (strain, angle) = (size_of(&increment.strain), increment.angle());
                if strain > limits.strain {
                    best = smaller(best, found(limits.strain / strain, "r2", "strain increment", point));
                }
                if angle > limits.rotation {
                    best = smaller(best, found(limits.rotation / angle, "r3", "rotation increment", point));
                }
            }
            if let Some(value) = self.yields(material, point, old, scratch).filter(|r| *r < 1.0) {
                best = smaller(best, found(value, "r1", "elastic -> plastic", point));
            }
        }
        best
    }

    /// Fraction at which an elastic point starts to yield.
    fn yields<M: ConstitutiveLaw>(
        &self,
        material: &M,
        point: usize,
        old: &[f64],
        scratch: &Scratch<D>,
    ) -> Option<f64> {
        let layout = &self.body.frame.layout;
        let mut state = layout.read(&old[point * layout.stride..(point + 1) * layout.stride]);
        let (stress, history) = layout.split(&mut state);
        let mut strain = scratch.increments[point].strain;
        if self.body.frame.plane_stress {
            // Through the thickness, the elastic strain that keeps σ_zz = 0.
            let c = material.forward(self.dt, stress, history);
            strain[2] = -(c[2][0] * strain[0] + c[2][1] * strain[1] + c[2][3] * strain[3]) / c[2][2];
        }
        material.yields(&strain, &scratch.turned(point, stress), history)
    }

    /// Refines the fraction under finite deformation, where the strain of a fraction of the step is not that fraction of its
    /// strain. It repeats the closed form at the fraction found; each repetition contracts the error by the size of the strain
    /// increment.
    fn refined<M: ConstitutiveLaw>(&self, material: &M, found: PointLimit) -> PointLimit {
        let body = &self.body;
        let mut scratch = Scratch::new(&body.frame);
        let old = body.cell_state(found.cell, &self.state.committed);
        let mut value = found.value;
        for _ in 0..MOST_REFINEMENTS {
            let start = self.u.committed.iter();
            let end: Vec<f64> = start.zip(&self.u.trial).map(|(c, t)| c + value * (t - c)).collect();
            body.gather(found.cell, &self.u.committed, &end, &mut scratch);
            if scratch.motion(&body.frame, body.cell_volumes(found.cell)).is_err() {
                return found;
            }
            let Some(ratio) = self.yields(material, found.point, old, &scratch) else { return found };
            value *= ratio;
            if (ratio - 1.0).abs() <= f64::EPSILON {
                break;
            }
        }
        if value < 1.0 { PointLimit { value, ..found } } else { found }
    }

    /// Sets the trial displacements: the committed ones plus an increment of the system.
    fn take_increment(&mut self, du: &[f64]) {
        self.take(du);
        self.u.trial.iter_mut().zip(&self.u.committed).for_each(|(t, c)| *t += c);
    }
}

/// Fraction tried next of an increment that inverts a cell.
const HALF: f64 = 0.5;
/// Repetitions of the closed form of r1: strain increments of forward steps are below 0.01, so that each repetition gives two
/// digits.
const MOST_REFINEMENTS: usize = 8;

impl<const D: usize> ForwardTerm for Block<D> {
    fn rate(&mut self, at: Instant, values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal> {
        let mut forces = std::mem::take(&mut self.forces);
        let result =
            with_material!(&self.body.model.material, m => self.rate_with(m, at.dt, values, &mut forces));
        self.forces = forces;
        result.map_err(|error| self.refusal(&error))?;
        self.scatter(&self.forces, constant);
        Ok(())
    }

    fn limit(&mut self, du: &[f64], at: Instant) -> Option<Fraction> {
        self.take_increment(du);
        self.dt = at.dt;
        let found = with_material!(&self.body.model.material, m => {
            let found = self.limit_with(m)?;
            if found.limit == "r1" && self.body.frame.finite { self.refined(m, found) } else { found }
        });
        let PointLimit { value, limit, event, cell, point } = found;
        Some(Fraction {
            value,
            cause: format!("{limit} {event}, {}, cell {cell}, point {point}", self.name),
            limit,
        })
    }
}
