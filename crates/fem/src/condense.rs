//! Static condensation of a linear body onto the degrees of freedom it shares with others.
//!
//! With interior b, retained i and prescribed d, `K_bb u_b + K_bi u_i + K_bd u_d = f_b` gives
//! `r_i = S u_i + h`, `S = K_ii - K_ib K_bb⁻¹ K_bi`, `h = K_ib K_bb⁻¹ (f_b - K_bd u_d) + K_id u_d - f_i`.
//! Loads are linear in the channel amplitudes, so `h = Σ_c α_c(t) h_c` with one solve per channel. A stepper cannot tell a
//! [`Condensed`] body from any other term; interior displacements are recovered only when asked for.

use crate::dof::{Channel, Constraints, Equations};
use crate::error::FemError;
use crate::sparse::{Factor, Part, ScatterMap};
use crate::table::Table;
use crate::term::{Fraction, Instant, Limited, Linearized, Pattern, Refusal, Term};
use faer::Mat;
use rayon::prelude::*;

/// Columns of right-hand sides solved together: measured optimum of faer's supernodal solve is 64 to 128.
const COLUMNS: usize = 64;

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

/// Entries (row, column, value) coupling two groups of degrees of freedom, each in its group's numbering.
type Coupling = Vec<(usize, usize, f64)>;

/// A factored body: everything that depends on which degrees of freedom are retained and fixed, but not on loads.
#[derive(Debug)]
pub struct Reduction {
    interior: Equations,
    retained: Vec<usize>,
    fixed: Vec<usize>,
    /// Interior rows of the retained and of the fixed columns, and retained rows of fixed columns.
    interior_retained: Coupling,
    interior_fixed: Coupling,
    retained_fixed: Coupling,
    factor: Factor,
    schur: Vec<f64>,
    /// Right-hand sides solved so far.
    solves: usize,
}

impl Reduction {
    /// Condenses `body` onto `retained` (sorted). `fixed` (sorted) are its prescribed degrees of freedom; those that are
    /// retained as well stay in the reduced system, where the stepper prescribes them.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] when the interior is not held by the retained and fixed degrees of freedom.
    pub fn new(body: &Stiffness, retained: &[usize], fixed: &[usize]) -> Result<Self, FemError> {
        let fixed: Vec<usize> =
            fixed.iter().copied().filter(|d| retained.binary_search(d).is_err()).collect();
        let mut removed: Vec<usize> = retained.iter().chain(&fixed).copied().collect();
        removed.sort_unstable();
        let interior = Constraints { fixed: removed, channels: Vec::new() }.equations(body.dofs);
        let mut matrix = ScatterMap::new(&[&body.pattern], &interior, Part::Lower);
        matrix.add(0, &body.values);
        let factor = matrix.cholesky(&matrix.analyse_cholesky()?)?;
        let mut reduction = Self {
            interior_retained: coupling(body, &interior.number, &number_in(retained, body.dofs)),
            interior_fixed: coupling(body, &interior.number, &number_in(&fixed, body.dofs)),
            retained_fixed: coupling(body, &number_in(retained, body.dofs), &number_in(&fixed, body.dofs)),
            interior,
            retained: retained.to_vec(),
            fixed,
            factor,
            schur: Vec::new(),
            solves: 0,
        };
        reduction.schur = reduction.schur_complement(body);
        Ok(reduction)
    }

    /// The retained degrees of freedom, in body numbering.
    #[must_use]
    pub fn retained(&self) -> &[usize] {
        &self.retained
    }

    /// Right-hand sides solved so far.
    #[must_use]
    pub fn solves(&self) -> usize {
        self.solves
    }

    /// `S`, row by row; rows and columns as [`Reduction::retained`].
    fn schur_complement(&mut self, body: &Stiffness) -> Vec<f64> {
        let m = self.retained.len();
        let numbers = number_in(&self.retained, body.dofs);
        let mut schur = vec![0.0; m * m];
        for (r, c, v) in coupling(body, &numbers, &numbers) {
            schur[r * m + c] += v;
        }
        let columns = by_column(&self.interior_retained, m);
        // Blocks of a fixed width, independent of the thread count: identical bits for any number of threads.
        let parts: Vec<Vec<f64>> = (0..m.div_ceil(COLUMNS))
            .into_par_iter()
            .map(|b| self.schur_columns(&columns, b * COLUMNS))
            .collect();
        for (b, part) in parts.iter().enumerate() {
            let width = part.len() / m;
            for (k, column) in part.chunks_exact(m).enumerate() {
                debug_assert!(k < width);
                for (r, &value) in column.iter().enumerate() {
                    schur[r * m + b * COLUMNS + k] -= value;
                }
            }
        }
        self.solves += m;
        symmetrise(&mut schur, m);
        schur
    }

    /// `K_ib K_bb⁻¹ K_bi` for one block of columns, column by column.
    fn schur_columns(&self, columns: &[Vec<(usize, f64)>], first: usize) -> Vec<f64> {
        let m = self.retained.len();
        let width = COLUMNS.min(m - first);
        let mut x = Mat::<f64>::zeros(self.interior.free.len(), width);
        for k in 0..width {
            for &(row, value) in &columns[first + k] {
                x[(row, k)] += value;
            }
        }
        self.factor.solve(x.as_mut());
        let mut result = vec![0.0; m * width];
        for k in 0..width {
            for (c, column) in columns.iter().enumerate() {
                result[k * m + c] = column.iter().map(|&(row, value)| value * x[(row, k)]).sum();
            }
        }
        result
    }

    /// Interior force `f_b - K_bd u_d` of a channel at unit amplitude, in body numbering of `prescribed` and `forces`.
    fn interior_load(&self, channel: &Channel) -> Mat<f64> {
        let mut load = Mat::<f64>::zeros(self.interior.free.len(), 1);
        for &(dof, force) in &channel.forces {
            let row = self.interior.number[dof];
            if row != Equations::FIXED {
                load[(row, 0)] += force;
            }
        }
        let fixed = self.fixed_values(channel);
        for &(row, col, value) in &self.interior_fixed {
            load[(row, 0)] -= value * fixed[col];
        }
        load
    }

    /// Values at unit amplitude of the fixed degrees of freedom that are not retained.
    fn fixed_values(&self, channel: &Channel) -> Vec<f64> {
        let mut values = vec![0.0; self.fixed.len()];
        for &(dof, value) in &channel.prescribed {
            if let Ok(k) = self.fixed.binary_search(&dof) {
                values[k] += value;
            }
        }
        values
    }

    /// `h_c` of a channel.
    fn reduced_load(&mut self, channel: &Channel) -> Vec<f64> {
        let mut x = self.interior_load(channel);
        self.factor.solve(x.as_mut());
        self.solves += 1;
        let mut h = vec![0.0; self.retained.len()];
        for &(row, col, value) in &self.interior_retained {
            h[col] += value * x[(row, 0)];
        }
        let fixed = self.fixed_values(channel);
        for &(row, col, value) in &self.retained_fixed {
            h[row] += value * fixed[col];
        }
        for &(dof, force) in &channel.forces {
            if let Ok(k) = self.retained.binary_search(&dof) {
                h[k] -= force;
            }
        }
        h
    }
}

/// A condensed body as a term on the interface degrees of freedom.
#[derive(Debug)]
pub struct Condensed {
    name: String,
    reduction: Reduction,
    channels: Vec<Channel>,
    loads: Vec<(Table, Vec<f64>)>,
    /// System number of each retained degree of freedom.
    pattern: Pattern,
    /// Retained displacements of the last residual.
    local: Vec<f64>,
}

impl Condensed {
    /// Joins a reduction to the system: `system[k]` is the system number of its k-th retained degree of freedom.
    #[must_use]
    pub fn new(name: String, reduction: Reduction, system: &[usize]) -> Self {
        let pattern = Pattern::of_blocks(0, [system]);
        let local = vec![0.0; system.len()];
        Self { name, reduction, channels: Vec::new(), loads: Vec::new(), pattern, local }
    }

    /// Sets the loads, given in body numbering; one solve each.
    pub fn set_channels(&mut self, channels: Vec<Channel>) {
        self.loads = channels.iter().map(|c| (c.amplitude.clone(), self.reduction.reduced_load(c))).collect();
        self.channels = channels;
    }

    /// The reduction behind the term.
    #[must_use]
    pub fn reduction(&self) -> &Reduction {
        &self.reduction
    }

    /// Displacements of the whole body at `time` for the system displacement `u`.
    #[must_use]
    pub fn recover(&self, u: &[f64], time: f64) -> Vec<f64> {
        let r = &self.reduction;
        let mut x = Mat::<f64>::zeros(r.interior.free.len(), 1);
        let mut body = vec![0.0; r.interior.number.len()];
        for channel in &self.channels {
            let amplitude = channel.amplitude.value(time);
            x += faer::Scale(amplitude) * r.interior_load(channel);
            for (&dof, value) in r.fixed.iter().zip(r.fixed_values(channel)) {
                body[dof] += amplitude * value;
            }
        }
        for (&dof, &system) in r.retained.iter().zip(&self.pattern.dofs) {
            body[dof] = u[system];
        }
        for &(row, col, value) in &r.interior_retained {
            x[(row, 0)] -= value * body[r.retained[col]];
        }
        r.factor.solve(x.as_mut());
        for (row, &dof) in r.interior.free.iter().enumerate() {
            body[dof] = x[(row, 0)];
        }
        body
    }
}

impl Term for Condensed {
    fn name(&self) -> &str {
        &self.name
    }

    fn residual(&mut self, u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        for (local, &dof) in self.local.iter_mut().zip(&self.pattern.dofs) {
            *local = u[dof];
        }
        let m = self.local.len();
        for (row, &dof) in self.reduction.schur.chunks_exact(m.max(1)).zip(&self.pattern.dofs) {
            r[dof] += row.iter().zip(&self.local).map(|(s, u)| s * u).sum::<f64>();
        }
        for (amplitude, load) in &self.loads {
            let alpha = amplitude.value(at.time);
            for (&dof, h) in self.pattern.dofs.iter().zip(load) {
                r[dof] += alpha * h;
            }
        }
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Condensed {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(&self.reduction.schur);
    }
}

impl Limited for Condensed {
    fn rate(&mut self, at: Instant, values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal> {
        values.copy_from_slice(&self.reduction.schur);
        for (amplitude, load) in &self.loads {
            let change = amplitude.value(at.time) - amplitude.value(at.time - at.dt);
            for (&dof, h) in self.pattern.dofs.iter().zip(load) {
                constant[dof] += change * h;
            }
        }
        Ok(())
    }

    fn limit(&mut self, _du: &[f64], _at: Instant) -> Option<Fraction> {
        None
    }

    fn advance(&mut self, _du: &[f64], _at: Instant) -> Result<(), Refusal> {
        Ok(())
    }
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

/// Groups entries by column.
fn by_column(entries: &Coupling, columns: usize) -> Vec<Vec<(usize, f64)>> {
    let mut result = vec![Vec::new(); columns];
    for &(row, col, value) in entries {
        result[col].push((row, value));
    }
    result
}

/// Replaces a matrix by its symmetric part: S is symmetric, and rounding must not say otherwise.
fn symmetrise(matrix: &mut [f64], m: usize) {
    for r in 0..m {
        for c in 0..r {
            let mean = 0.5 * (matrix[r * m + c] + matrix[c * m + r]);
            matrix[r * m + c] = mean;
            matrix[c * m + r] = mean;
        }
    }
}
