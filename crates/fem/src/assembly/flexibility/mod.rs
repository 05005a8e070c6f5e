//! A condensed system in which pairs of points touch, solved for the tractions between them.
//!
//! Bodies and springs are constant, `S`; contact with fixed pairs acts through relative displacements `w = B x` alone, with a
//! small matrix of each pair on the diagonal of `D`. For `(S + Bᵀ D B) x = r` the forces `λ = D w` are those of
//! `(1 + D F) λ = D B S⁻¹ r` with the compliance `F = B S⁻¹ Bᵀ`, and `S x = r - Bᵀ λ`. Pairs are fewer than the equations of both
//! sides, open pairs have no force, and bodies are factored once.
//!
//! Systems of many pairs are solved by GMRES, preconditioned by the LU factor of `1 + D F` of an earlier iteration or step, in
//! single precision, of which half as many bytes are read. It is made again when iterations have cost as much.

mod compliance;
mod pair_stiffness;

use super::dense_factor::Lu;
use crate::dof::Equations;
use crate::error::FemError;
use crate::iterative::gmres::{self, Bounds, PreconditionedSystem};
use crate::outcome::Outcome;
use crate::product::{dot, multiply_symmetric};
use crate::relative::RelativeDisplacements;
use crate::term::{Pattern, PatternId};
use compliance::{Compliance, Groups};
use faer::{Mat, MatRef};
use pair_stiffness::PairStiffness;
use serde::{Deserialize, Serialize};

/// Components of closed pairs up to which each matrix is factored, in some milliseconds.
pub const FACTORED: usize = 500;
/// Bounds of the residual over the load of nodes. Below the first, iterations cost more than they save Newton's method; above the
/// second its directions lead nowhere.
const FORCING: [f64; 2] = [1e-5, 1e-2];
/// Largest residual over the forces between pairs that are to be balanced.
const MOST_LEFT: f64 = 1e-2;
/// Ratio of a residual to the square of the last reduction of the load: the value of Eisenstat and Walker.
const GAIN: f64 = 0.9;
/// Rate of operations in a factorisation over that in a product, which waits for memory.
const FACTORISATION_RATE: f64 = 12.0;
/// Iterations allowed beside those that a factorisation is worth.
const FEWEST: usize = 20;

/// Part of a term in the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Constant.
    Constant(PatternId),
    /// Acts through relative displacements alone.
    Pairs(PatternId),
    /// Neither: what was factored is not used again.
    Changing,
}

#[derive(Debug, Default)]
pub(super) struct FlexibilityStore {
    /// The terms of which the compliance is made, by place.
    made_of: Vec<Part>,
    /// Terms under assembly, until they are factored.
    groups: Option<Groups>,
    rows: Vec<Vec<(usize, f64)>>,
    compliance: Option<Compliance>,
    /// D.
    stiffness: PairStiffness,
    factor: Option<TractionFactor>,
    /// Factor of a run that is resumed, until there is a compliance.
    remembered: Option<FactorMemory>,
    /// Norm of the last load of the present step \[N\].
    last_load: Option<f64>,
    /// True if nothing corrects what a solution of the next matrix leaves.
    exact: bool,
}

/// LU of `1 + D F` over the components of pairs that were closed.
#[derive(Debug)]
struct TractionFactor {
    made_of: PairStiffness,
    closed: Vec<usize>,
    lu: Factors,
    /// Iterations per decade of the residual in the first solution with another matrix.
    fresh: Option<f64>,
    /// Iterations that later ones took beyond that.
    excess: f64,
}

#[derive(Debug)]
enum Factors {
    Exact(Lu<f64>),
    Rounded(Lu<f32>),
}

/// All from which a factor follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct FactorMemory {
    stiffness: Vec<f64>,
    exact: bool,
    fresh: Option<f64>,
    excess: f64,
}

impl FlexibilityStore {
    /// The next solution is the first of a step.
    pub fn begin_step(&mut self) {
        self.last_load = None;
    }

    /// Residual over the load that a solution may leave. The next load differs from its linear prediction by about the square of the
    /// last reduction, and a more exact solution would be wasted (Eisenstat and Walker 1996, choice 2).
    fn forcing(&mut self, load: f64) -> f64 {
        let [least, most] = FORCING;
        let gain = self.last_load.replace(load).map_or(1.0, |last| load / last);
        (GAIN * gain.powi(2)).clamp(least, most)
    }

    /// Prepares an assembly of terms with these patterns. The matrix is to be factored itself if nothing corrects its solutions.
    pub fn begin(&mut self, patterns: &[&Pattern], parts: Vec<Part>, equations: &Equations, exact: bool) {
        self.exact = exact;
        self.stiffness.clear();
        if parts == self.made_of && self.compliance.is_some() && !parts.contains(&Part::Changing) {
            return;
        }
        let pairs = parts.iter().map(|part| matches!(part, Part::Pairs(_)));
        let summed: Vec<&Pattern> =
            patterns.iter().zip(pairs).filter(|(_, pairs)| !pairs).map(|(pattern, _)| *pattern).collect();
        (self.compliance, self.factor) = (None, None);
        self.rows.clear();
        self.groups = Some(Groups::new(&summed, equations));
        self.made_of = parts;
    }

    /// Adds the blocks of a term, which acts through `relative` alone if that is given.
    pub fn add(
        &mut self,
        equations: &Equations,
        pattern: &Pattern,
        values: &[f64],
        relative: Option<&RelativeDisplacements>,
    ) {
        match (relative, &mut self.groups) {
            (Some(relative), groups) => {
                self.stiffness.add(relative, values);
                if groups.is_some() {
                    self.rows.extend(relative.rows(equations));
                }
            }
            (None, Some(groups)) => groups.add(equations, pattern, values),
            (None, None) => {}
        }
    }

    /// Factors the bodies if that was not done, and the matrix of tractions if that is due. Returns the number of the latter.
    pub fn factor(&mut self) -> Result<usize, FemError> {
        if let Some(groups) = self.groups.take() {
            let compliance = Compliance::new(groups, std::mem::take(&mut self.rows))?;
            self.stiffness.set_springs(&compliance.springs);
            if let Some(FactorMemory { stiffness, exact, fresh, excess }) = self.remembered.take() {
                let remembered = self.stiffness.with_values(stiffness);
                self.factor = remembered.map(|d| TractionFactor {
                    fresh,
                    excess,
                    ..TractionFactor::new(d, &compliance, exact)
                });
            }
            self.compliance = Some(compliance);
        }
        let Some(compliance) = &self.compliance else { return Ok(0) };
        self.stiffness.set_springs(&compliance.springs);
        let closed = self.stiffness.closed().len();
        let exact = self.exact || closed <= FACTORED;
        let serves = |factor: &TractionFactor| match exact {
            true => factor.is_of(&self.stiffness),
            false => factor.made_of == self.stiffness || !factor.is_worn(),
        };
        if self.factor.as_ref().is_some_and(serves) {
            return Ok(0);
        }
        self.factor = Some(TractionFactor::new(self.stiffness.clone(), compliance, exact));
        Ok(usize::from(closed > 0))
    }

    /// The matrix.
    pub fn matrix(&self) -> Option<Mat<f64>> {
        let compliance = self.compliance.as_ref()?;
        Some(compliance.system(|w, forces| self.stiffness.multiply(w, forces)))
    }

    /// From what the factor follows.
    pub fn memory(&self) -> Option<FactorMemory> {
        let of_factor = |factor: &TractionFactor| {
            let TractionFactor { made_of, fresh, excess, lu, .. } = factor;
            let exact = matches!(lu, Factors::Exact(_));
            FactorMemory { stiffness: made_of.values().to_vec(), exact, fresh: *fresh, excess: *excess }
        };
        self.remembered.clone().or_else(|| self.factor.as_ref().map(of_factor))
    }

    /// Makes that factor as soon as there is a compliance.
    pub fn remember(&mut self, memory: FactorMemory) {
        self.remembered = Some(memory);
    }

    /// Solves in place. `None` without a matrix; the second value is the number of factorisations made.
    pub fn solve(&mut self, rhs: &mut [f64]) -> Option<(Option<Outcome>, usize)> {
        let load = rhs.to_vec();
        let forcing = self.forcing(norm(&load));
        let (compliance, factor) = (self.compliance.as_ref()?, self.factor.as_mut()?);
        compliance.solve(rhs);
        let stiffness = &self.stiffness;
        if stiffness.closed().is_empty() {
            return Some((None, 0));
        }
        let mut forces = vec![0.0; compliance.order()];
        stiffness.multiply(&compliance.relative(rhs), &mut forces);
        let (mut outcome, mut made) = (None, 0);
        if factor.is_of(stiffness) {
            factor.solve(&mut forces);
        } else {
            let undisturbed = forces.clone();
            let flexibility = compliance.matrix.as_ref();
            let mut system = System { stiffness, flexibility, factor };
            // With a factor of its own matrix an iteration gains several decades.
            let own = factor.made_of == *stiffness;
            let left = if own { FORCING[0] } else { forcing } * norm(&load);
            let tolerance = (left / norm(&undisturbed)).min(MOST_LEFT);
            let found = gmres::solve(&mut system, &mut forces, factor.bounds(tolerance));
            if !own {
                factor.count(found.report().iterations, -tolerance.log10());
            }
            outcome = Some(found);
            if !found.converged() {
                forces = undisturbed;
                *factor = TractionFactor::new(stiffness.clone(), compliance, true);
                factor.solve(&mut forces);
                made = 1;
            }
        }
        rhs.copy_from_slice(&load);
        compliance.unload(&forces, rhs);
        compliance.solve(rhs);
        Some((outcome, made))
    }
}

impl TractionFactor {
    /// A factor that solves the system, or one in single precision that preconditions it.
    fn new(made_of: PairStiffness, compliance: &Compliance, exact: bool) -> Self {
        let (closed, flexibility) = (made_of.closed(), &compliance.matrix);
        let lu = match exact {
            true => Factors::Exact(Lu::new(made_of.system(flexibility, &closed, |v| v))),
            false => Factors::Rounded(Lu::new(made_of.system(flexibility, &closed, |v| v as f32))),
        };
        Self { made_of, closed, lu, fresh: None, excess: 0.0 }
    }

    /// True if it solves systems of this stiffness.
    fn is_of(&self, stiffness: &PairStiffness) -> bool {
        matches!(self.lu, Factors::Exact(_)) && self.made_of == *stiffness
    }

    /// Iterations that a factorisation is worth.
    fn worth(&self) -> usize {
        (self.closed.len() as f64 / (6.0 * FACTORISATION_RATE)) as usize
    }

    fn bounds(&self, tolerance: f64) -> Bounds {
        let most_iterations = FEWEST + self.worth();
        Bounds { tolerance, restart: most_iterations, most_iterations, paced: false }
    }

    /// Notes the iterations that a solution for another matrix took.
    fn count(&mut self, iterations: usize, decades: f64) {
        let fresh = *self.fresh.get_or_insert(iterations as f64 / decades);
        self.excess += (iterations as f64 - fresh * decades).max(0.0);
    }

    /// True if another one would have paid.
    fn is_worn(&self) -> bool {
        self.excess > self.worth() as f64
    }

    /// Solves in place; forces of pairs that were open stay.
    fn solve(&self, forces: &mut [f64]) {
        match &self.lu {
            Factors::Exact(lu) => {
                let mut own: Vec<f64> = self.closed.iter().map(|&k| forces[k]).collect();
                lu.solve(&mut own);
                self.closed.iter().zip(own).for_each(|(&k, force)| forces[k] = force);
            }
            Factors::Rounded(lu) => {
                // Of the size of one, whatever the unit of force.
                let size = norm(forces);
                if size == 0.0 {
                    return;
                }
                let mut own: Vec<f32> = self.closed.iter().map(|&k| (forces[k] / size) as f32).collect();
                lu.solve(&mut own);
                self.closed.iter().zip(own).for_each(|(&k, force)| forces[k] = size * f64::from(force));
            }
        }
    }
}

/// The matrix of tractions with its preconditioner.
struct System<'a> {
    stiffness: &'a PairStiffness,
    flexibility: MatRef<'a, f64>,
    factor: &'a TractionFactor,
}

impl PreconditionedSystem for System<'_> {
    fn multiply(&mut self, x: &[f64], y: &mut [f64]) {
        let mut relative = vec![0.0; x.len()];
        multiply_symmetric(self.flexibility, x, &mut relative);
        self.stiffness.multiply(&relative, y);
        y.iter_mut().zip(x).for_each(|(y, x)| *y += x);
    }

    fn precondition(&mut self, r: &mut [f64]) {
        self.factor.solve(r);
    }
}

fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}
