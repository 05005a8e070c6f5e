//! Static condensation of a linear body onto the degrees of freedom that it shares with others.
//!
//! With interior b, retained i and prescribed d, `K_bb u_b + K_bi u_i + K_bd u_d = f_b` gives `r_i = S u_i + h`, `S = K_ii -
//! K_ib K_bb⁻¹ K_bi`, `h = K_ib K_bb⁻¹ (f_b - K_bd u_d) + K_id u_d - f_i`. The retained equations come last in the elimination,
//! which stops before them: the remaining matrix is S, obtained without solving for any of its columns. Loads are linear in the
//! channel amplitudes, so `h = Σ_c α_c(t) h_c` with half a solve per channel. A stepper cannot distinguish a [`CondensedBody`] body
//! from any other term; interior displacements are recovered only on request.

mod loaded_body;
mod works;

use crate::dof::{Channel, Constraints, Equations};
use crate::error::FemError;
use crate::multifrontal::{Cholesky, DirectError, SymbolicCholesky};
use crate::ordering::Ordering;
use crate::product::multiply_symmetric;
use crate::sparse::{Part, ScatterMap, lower_pattern};
use crate::table::Table;
use crate::term::{ForwardTerm, Instant, Linearized, Pattern, Refusal, Term};
use faer::{MatMut, MatRef};
pub use loaded_body::{LoadedBody, Remainder};
use std::sync::Arc;
pub use works::ChannelWorks;

/// A linear body before condensation: its stiffness as dense cell blocks.
#[derive(Clone, Debug)]
pub struct Stiffness {
    /// Cell blocks, in body numbering.
    pub pattern: Pattern,
    /// Their values.
    pub values: Vec<f64>,
    /// Degrees of freedom of the body.
    pub dofs: usize,
}

impl Stiffness {
    /// Internal forces `K u` of displacements u.
    #[must_use]
    pub fn forces(&self, u: &[f64]) -> Vec<f64> {
        let mut forces = vec![0.0; self.dofs];
        let mut offset = 0;
        for block in self.pattern.blocks() {
            let rows = self.values[offset..][..block.len() * block.len()].chunks_exact(block.len());
            for (&dof, row) in block.iter().zip(rows) {
                forces[dof] += row.iter().zip(block).map(|(k, &d)| k * u[d]).sum::<f64>();
            }
            offset += block.len() * block.len();
        }
        forces
    }
}

/// A condensation whose costs are known before any number is computed. It holds the assembled stiffness.
#[derive(Debug)]
pub struct Condensation<'a> {
    body: &'a Stiffness,
    analysis: Analysis,
    matrix: ScatterMap,
}

/// The analysis of a condensation: its equations and the order of their elimination. It needs no values.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Numbering of the degrees of freedom that are not fixed: interior and retained.
    active: Equations,
    /// Retained degrees of freedom.
    retained: Vec<usize>,
    /// Prescribed degrees of freedom that are not retained.
    fixed: Vec<usize>,
    symbolic: Arc<SymbolicCholesky>,
}

impl Analysis {
    /// Orders and analyses a body of `dofs` degrees of freedom for condensation onto `retained` (sorted). `fixed` (sorted) are
    /// its prescribed degrees of freedom; those that are also retained stay in the reduced system, where the stepper prescribes
    /// them.
    ///
    /// # Errors
    /// [`FemError::Direct`] if the pattern cannot be ordered.
    pub fn new(
        patterns: &[&Pattern],
        dofs: usize,
        retained: &[usize],
        fixed: &[usize],
    ) -> Result<Self, FemError> {
        let fixed = not_retained(fixed, retained);
        let active = Constraints { fixed: fixed.clone(), channels: Vec::new() }.equations(dofs);
        let last: Vec<usize> = retained.iter().map(|&d| active.number[d]).collect();
        let lower = lower_pattern(patterns, &active);
        let symbolic = Arc::new(SymbolicCholesky::retaining(lower.as_ref(), Ordering::Automatic, &last)?);
        Ok(Self { active, retained: retained.to_vec(), fixed, symbolic })
    }

    /// Peak memory of the condensation \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.symbolic.bytes() + self.retained.len().pow(2) * size_of::<f64>()
    }

    /// Memory of what it leaves, the factor and the condensed stiffness \[bytes\].
    #[must_use]
    pub fn kept(&self) -> usize {
        (self.symbolic.stored() + self.retained.len().pow(2)) * size_of::<f64>()
    }

    /// Peak memory of condensing bodies one after another \[bytes\].
    #[must_use]
    pub fn bytes_of_all(analyses: &[Self]) -> usize {
        let (mut peak, mut kept) = (0, 0);
        for analysis in analyses {
            peak = peak.max(kept + analysis.bytes());
            kept += analysis.kept();
        }
        peak
    }
}

impl<'a> Condensation<'a> {
    /// [`Analysis::new`] of `body`, with its matrix.
    ///
    /// # Errors
    /// As [`Analysis::new`].
    pub fn analyse(body: &'a Stiffness, retained: &[usize], fixed: &[usize]) -> Result<Self, FemError> {
        Ok(Self::prepared(body, Analysis::new(&[&body.pattern], body.dofs, retained, fixed)?))
    }

    /// The condensation of `body` with an analysis of its pattern.
    #[must_use]
    pub fn prepared(body: &'a Stiffness, analysis: Analysis) -> Self {
        let mut matrix = ScatterMap::new(&[&body.pattern], &analysis.active, Part::Lower);
        matrix.add(0, &body.values);
        Self { body, analysis, matrix }
    }

    /// Peak memory of the condensation \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.analysis.bytes()
    }

    /// Multiplications and additions of the factorisation.
    #[must_use]
    pub fn operations(&self) -> f64 {
        self.analysis.symbolic.operations()
    }

    /// Factors the interior.
    ///
    /// # Errors
    /// [`FemError::Direct`] if more than `allowed` bytes are needed. Also with the degree of freedom (in body numbering) where
    /// the interior is not held by the retained and fixed ones.
    pub fn factor(self, allowed: usize) -> Result<Reduction, FemError> {
        let needed = self.bytes();
        if needed > allowed {
            let equations = self.analysis.symbolic.equations();
            return Err(DirectError::Memory { needed, allowed, equations }.into());
        }
        let Analysis { active, retained, fixed, symbolic } = self.analysis;
        let mut factor = Cholesky::new(symbolic, self.matrix.values())
            .map_err(|e| e.renumbered(|equation| active.free[equation]))?;
        let schur = factor.take_schur();
        let fixed_columns = coupling(self.body, &active.number, &number_in(&fixed, self.body.dofs));
        Ok(Reduction { active, retained, fixed, fixed_columns, factor, schur, solves: 0 })
    }
}

/// Entries (row, column, value) that couple two groups of degrees of freedom, each in its group's numbering.
type Coupling = Vec<(usize, usize, f64)>;

/// A factored body: everything that depends on the choice of retained and fixed degrees of freedom, but not on loads.
#[derive(Debug)]
pub struct Reduction {
    active: Equations,
    retained: Vec<usize>,
    fixed: Vec<usize>,
    /// Active rows of the fixed columns.
    fixed_columns: Coupling,
    factor: Cholesky,
    schur: Vec<f64>,
    /// Right-hand sides solved so far.
    solves: usize,
}

impl Reduction {
    /// Condenses `body` onto `retained` (sorted) with `fixed` (sorted), without a memory limit: see [`Condensation::analyse`].
    ///
    /// # Errors
    /// [`FemError::Direct`] if the interior is not held by the retained and fixed degrees of freedom.
    pub fn new(body: &Stiffness, retained: &[usize], fixed: &[usize]) -> Result<Self, FemError> {
        Condensation::analyse(body, retained, fixed)?.factor(usize::MAX)
    }

    /// The retained degrees of freedom, in body numbering.
    #[must_use]
    pub fn retained(&self) -> &[usize] {
        &self.retained
    }

    /// `S`, row by row; rows and columns are those of [`Reduction::retained`].
    #[must_use]
    pub fn schur(&self) -> &[f64] {
        &self.schur
    }

    /// Right-hand sides solved so far.
    #[must_use]
    pub fn solves(&self) -> usize {
        self.solves
    }

    /// A channel at unit amplitude in the active equations, `f - K_·d u_d`. Its interior part is forward-substituted through
    /// the factor (`L⁻¹ (f_b - K_bd u_d)`), and its retained part is `-h_c`.
    fn reduced(&mut self, channel: &Channel) -> Vec<f64> {
        let mut load = load(channel, &self.active, &self.fixed, &self.fixed_columns);
        let n = load.len();
        self.factor.reduce(MatMut::from_column_major_slice_mut(&mut load, n, 1));
        self.solves += 1;
        load
    }
}

/// A channel, condensed.
#[derive(Debug)]
struct Load {
    amplitude: Table,
    /// Values of the fixed degrees of freedom at unit amplitude.
    fixed: Vec<f64>,
    /// See [`Reduction::reduced`].
    reduced: Vec<f64>,
    /// `h_c` on the retained degrees of freedom.
    retained: Vec<f64>,
}

/// A condensed body as a term on the interface degrees of freedom.
#[derive(Debug)]
pub struct CondensedBody {
    name: String,
    reduction: Reduction,
    loads: Vec<Load>,
    /// System number of each retained degree of freedom.
    pattern: Pattern,
    /// Retained displacements of the last residual.
    local: Vec<f64>,
    /// Forces that they cause \[N\], reused.
    forces: Vec<f64>,
}

impl CondensedBody {
    /// Joins a reduction to the system: `system[k]` is the system number of its k-th retained degree of freedom.
    #[must_use]
    pub fn new(name: String, reduction: Reduction, system: &[usize]) -> Self {
        let pattern = Pattern::from_blocks([system]);
        let (local, forces) = (vec![0.0; system.len()], vec![0.0; system.len()]);
        Self { name, reduction, loads: Vec::new(), pattern, local, forces }
    }

    /// Sets the loads, given in body numbering; each takes half a solve.
    pub fn set_channels(&mut self, channels: Vec<Channel>) {
        let mut load = |channel: Channel| {
            let reduced = self.reduction.reduced(&channel);
            let r = &self.reduction;
            let retained = r.retained.iter().map(|&d| -reduced[r.active.number[d]]).collect();
            Load { fixed: fixed_values(&channel, &r.fixed), amplitude: channel.amplitude, reduced, retained }
        };
        self.loads = channels.into_iter().map(&mut load).collect();
    }

    /// The reduction on which the term is based.
    #[must_use]
    pub fn reduction(&self) -> &Reduction {
        &self.reduction
    }

    /// Separates S, row by row, from what recovers displacements.
    #[must_use]
    pub fn into_parts(mut self) -> (Vec<f64>, Interior) {
        (std::mem::take(&mut self.reduction.schur), Interior(self))
    }

    /// Amplitude and retained part h_c of each channel: the forces on the retained degrees of freedom, in addition to `S u`,
    /// are `Σ_c α_c(t) h_c`.
    pub fn channels(&self) -> impl Iterator<Item = (&Table, &[f64])> {
        self.loads.iter().map(|load| (&load.amplitude, load.retained.as_slice()))
    }

    /// Displacements of the whole body at `time` for the system displacement `u`.
    #[must_use]
    pub fn recover(&self, u: &[f64], time: f64) -> Vec<f64> {
        self.recovered(u, self.loads.iter().map(|load| load.amplitude.value(time)))
    }

    /// The same with given amplitudes of the channels.
    fn recovered(&self, u: &[f64], amplitudes: impl Iterator<Item = f64>) -> Vec<f64> {
        let r = &self.reduction;
        let mut x = vec![0.0; r.active.free.len()];
        let mut body = vec![0.0; r.active.number.len()];
        for (load, amplitude) in self.loads.iter().zip(amplitudes) {
            x.iter_mut().zip(&load.reduced).for_each(|(x, part)| *x += amplitude * part);
            for (&dof, value) in r.fixed.iter().zip(&load.fixed) {
                body[dof] += amplitude * value;
            }
        }
        for (&dof, &system) in r.retained.iter().zip(self.pattern.dofs()) {
            x[r.active.number[dof]] = u[system];
        }
        let n = x.len();
        r.factor.recover(MatMut::from_column_major_slice_mut(&mut x, n, 1));
        for (value, &dof) in x.iter().zip(&r.active.free) {
            body[dof] = *value;
        }
        body
    }
}

/// The interior of a condensed body whose stiffness has been moved out: it recovers displacements, and is no term.
#[derive(Debug)]
pub struct Interior(CondensedBody);

impl Interior {
    /// Number of retained degrees of freedom.
    #[must_use]
    pub fn retained(&self) -> usize {
        self.0.reduction.retained.len()
    }

    /// Displacements of the whole body at `time` for the system displacement `u`.
    #[must_use]
    pub fn recover(&self, u: &[f64], time: f64) -> Vec<f64> {
        self.0.recover(u, time)
    }

    /// Weights w of the retained displacements in a weighted sum of displacements of the body without loads: `Σ w_i u_i`. By
    /// reciprocity they are the condensed forces of a load with the weights of the sum, `f_i - K_ib K_bb⁻¹ f_b`, which takes half
    /// a solve.
    #[must_use]
    pub fn influence(&self, weights: &[(usize, f64)]) -> Vec<f64> {
        let r = &self.0.reduction;
        let n = r.active.free.len();
        let mut load = vec![0.0; n];
        for &(dof, weight) in weights {
            let row = r.active.number[dof];
            if row != Equations::FIXED {
                load[row] += weight;
            }
        }
        r.factor.reduce(MatMut::from_column_major_slice_mut(&mut load, n, 1));
        r.retained.iter().map(|&dof| load[r.active.number[dof]]).collect()
    }

    /// Amplitude of each channel, and the displacements of the whole body at its unit amplitude, with retained displacements at
    /// zero.
    pub fn loaded(&self) -> impl Iterator<Item = (&Table, Vec<f64>)> {
        let zero = vec![0.0; self.0.pattern.dofs().len()];
        let count = self.0.loads.len();
        self.0.loads.iter().enumerate().map(move |(k, load)| {
            let unit = (0..count).map(|other| if other == k { 1.0 } else { 0.0 });
            (&load.amplitude, self.0.recovered(&zero, unit))
        })
    }
}

impl Term for CondensedBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn residual(&mut self, u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        for (local, &dof) in self.local.iter_mut().zip(self.pattern.dofs()) {
            *local = u[dof];
        }
        let m = self.local.len();
        let schur = MatRef::from_column_major_slice(&self.reduction.schur, m, m);
        multiply_symmetric(schur, &self.local, &mut self.forces);
        self.pattern.dofs().iter().zip(&self.forces).for_each(|(&dof, force)| r[dof] += force);
        for load in &self.loads {
            let alpha = load.amplitude.value(at.time);
            for (&dof, h) in self.pattern.dofs().iter().zip(&load.retained) {
                r[dof] += alpha * h;
            }
        }
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for CondensedBody {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(&self.reduction.schur);
    }

    fn constant_tangent(&self) -> Option<&[f64]> {
        Some(&self.reduction.schur)
    }
}

impl ForwardTerm for CondensedBody {
    fn rate(&mut self, at: Instant, values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal> {
        values.copy_from_slice(&self.reduction.schur);
        for load in &self.loads {
            let change = load.amplitude.value(at.time) - load.amplitude.value(at.time - at.dt);
            for (&dof, h) in self.pattern.dofs().iter().zip(&load.retained) {
                constant[dof] += change * h;
            }
        }
        Ok(())
    }
}

/// Prescribed degrees of freedom that are not retained.
fn not_retained(fixed: &[usize], retained: &[usize]) -> Vec<usize> {
    fixed.iter().copied().filter(|d| retained.binary_search(d).is_err()).collect()
}

/// Values of the degrees of freedom `fixed` in a channel at unit amplitude.
fn fixed_values(channel: &Channel, fixed: &[usize]) -> Vec<f64> {
    let mut values = vec![0.0; fixed.len()];
    for &(dof, value) in &channel.prescribed {
        if let Ok(k) = fixed.binary_search(&dof) {
            values[k] += value;
        }
    }
    values
}

/// A channel at unit amplitude in the active equations: `f - K_·d u_d`.
fn load(channel: &Channel, active: &Equations, fixed: &[usize], columns: &Coupling) -> Vec<f64> {
    let mut load = vec![0.0; active.free.len()];
    for &(dof, force) in &channel.forces {
        let row = active.number[dof];
        if row != Equations::FIXED {
            load[row] += force;
        }
    }
    let fixed = fixed_values(channel, fixed);
    for &(row, col, value) in columns {
        load[row] -= value * fixed[col];
    }
    load
}

/// Position of each degree of freedom in a sorted group, or [`Equations::FIXED`].
fn number_in(group: &[usize], dofs: usize) -> Vec<usize> {
    let mut number = vec![Equations::FIXED; dofs];
    for (k, &dof) in group.iter().enumerate() {
        number[dof] = k;
    }
    number
}

/// Entries of the body's stiffness between two groups.
fn coupling(body: &Stiffness, rows: &[usize], cols: &[usize]) -> Coupling {
    let mut entries = Coupling::new();
    let mut offset = 0;
    for block in body.pattern.blocks() {
        let n = block.len();
        if block.iter().any(|&d| cols[d] != Equations::FIXED) {
            for (i, &r) in block.iter().enumerate().filter(|&(_, &r)| rows[r] != Equations::FIXED) {
                for (j, &c) in block.iter().enumerate().filter(|&(_, &c)| cols[c] != Equations::FIXED) {
                    entries.push((rows[r], cols[c], body.values[offset + i * n + j]));
                }
            }
        }
        offset += n * n;
    }
    entries
}
