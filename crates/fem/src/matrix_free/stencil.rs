//! Products of equal rows of K with the displacements of their neighbours, many nodes of a run at once.
//!
//! Displacements are copied so that a vector holds one component of neighbouring nodes of a run. Each node is then computed once, and
//! nothing is gathered or added up between cells. Nodes in no run belong to the pieces.

use super::displacements::Displacements;
use super::runs::{Neighbour, Runs};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// Columns of one task: fixed, so that runs are divided alike on any number of threads.
const COLUMNS: usize = 4096;

/// Vectors of nodes treated at once. With three components nine sums are under way, enough for the delay of a product, and they fit
/// into sixteen registers with the displacements and a coefficient. With four vectors they do not, and AVX2 takes 1.6 times as long.
const VECTORS: usize = 3;

/// Most nodes treated at once, in vectors of eight numbers. The copy of displacements is so much longer than there are nodes.
const MOST: usize = 8 * VECTORS;

/// Rounding error where cells cancel, over the largest stiffness: an ulp for each of up to 32 cells that meet at a node.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Share of products that differ from zero up to which loops for sets of components pay: two thirds in rectangular hexahedra.
const WORTH_SETS: f64 = 0.75;

/// Columns copied at once, so that all components of a node are read while they are in the first cache.
const COPIED: usize = 256;

/// Part of a run within a task.
#[derive(Clone, Copy, Debug)]
struct Part {
    /// Row of the table.
    row: usize,
    /// Residue of the nodes.
    residue: usize,
    /// Column of the first node among all.
    column: usize,
    /// Number of nodes.
    length: usize,
}

/// Forces on a node per displacement of one component of a neighbour.
#[derive(Clone, Copy, Debug)]
struct Term {
    /// Position of the displacement less that of component 0 of the node.
    shift: isize,
    /// Force on each component \[N/m\].
    stiffness: [f64; 3],
}

/// Terms of a row, by the components that they act on: bit c of the number of a set represents component c. In cells with right angles
/// most displacements act on one or two components. A loop for each set costs more than it saves in the plane, where one set serves.
#[derive(Clone, Debug)]
struct Row {
    terms: Vec<Term>,
    /// First term of each set of components; one more than there are sets.
    starts: [usize; 9],
}

impl Row {
    fn new(mut terms: Vec<Term>, components: usize) -> Self {
        let all = terms.iter().flat_map(|term| term.stiffness);
        let rounding = ROUNDING * all.fold(0.0, |most: f64, k| most.max(k.abs()));
        let acts = |term: &Term| -> Vec<usize> {
            (0..components).filter(|&c| term.stiffness[c].abs() > rounding).collect()
        };
        let products: usize = terms.iter().map(|term| acts(term).len()).sum();
        let sets = components == 3 && products as f64 <= WORTH_SETS * (components * terms.len()) as f64;
        let set = |term: &Term| -> usize {
            if sets { acts(term).iter().map(|c| 1 << c).sum() } else { (1 << components) - 1 }
        };
        terms.retain(|term| set(term) > 0);
        terms.sort_by_key(set);
        let starts = std::array::from_fn(|k| terms.partition_point(|term| set(term) < k));
        Self { terms, starts }
    }
}

/// Forces on the nodes in runs.
///
/// Node n lies in column n / p of residue n mod p, with p the period of the runs. Values of each component and residue follow each other
/// by columns.
#[derive(Clone, Debug, Default)]
pub(super) struct Stencils {
    period: usize,
    /// Columns of each component and residue.
    columns: usize,
    rows: Vec<Row>,
    /// Parts of each task.
    tasks: Vec<Vec<Part>>,
    /// Copied displacements, component by component.
    u: Vec<f64>,
    /// Forces, component by component; 0 at nodes in no run.
    forces: Vec<f64>,
}

impl Stencils {
    /// Prepares the products for nodes of so many components.
    pub fn new(nodes: usize, components: usize, runs: &Runs) -> Self {
        if runs.runs.is_empty() {
            return Self::default();
        }
        let (period, columns) = (runs.period, nodes.div_ceil(runs.period));
        let mut tasks = vec![Vec::new(); columns.div_ceil(COLUMNS)];
        for run in &runs.runs {
            let (row, residue) = (run.row, run.first % period);
            let end = run.first / period + run.length;
            let mut column = run.first / period;
            while column < end {
                let length = (end - column).min(COLUMNS - column % COLUMNS);
                tasks[column / COLUMNS].push(Part { row, residue, column, length });
                column += length;
            }
        }
        // Every run has a residue of its own; the row does not know it, and neighbours lie in other columns for each.
        let mut result = Self { period, columns, rows: Vec::new(), tasks, ..Self::default() };
        let table = result.terms(components, &runs.rows);
        result.rows = table;
        for part in result.tasks.iter_mut().flatten() {
            part.row = part.row * period + part.residue;
        }
        let length = columns * period * components;
        result.u = vec![0.0; length + MOST];
        result.forces = vec![0.0; length];
        result
    }

    /// Terms of each row at each residue.
    fn terms(&self, components: usize, rows: &[Vec<Neighbour>]) -> Vec<Row> {
        let (period, columns) = (self.period as i64, self.columns as i64);
        let of = |row: &Vec<Neighbour>, residue: i64| {
            let of_neighbour = |n: &Neighbour| {
                let place = residue + n.offset;
                let at = place.rem_euclid(period) * columns + place.div_euclid(period) - residue * columns;
                let stiffness = n.stiffness;
                let term = move |j: usize| Term {
                    shift: (at + j as i64 * period * columns) as isize,
                    stiffness: std::array::from_fn(|i| stiffness[i][j]),
                };
                (0..components).map(term)
            };
            Row::new(row.iter().flat_map(of_neighbour).collect(), components)
        };
        rows.iter().flat_map(|row| (0..period).map(move |residue| of(row, residue))).collect()
    }

    /// True if no node is in a run.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Computes the forces at displacements `u`, C components a node.
    pub fn evaluate<const C: usize>(&mut self, u: &Displacements<'_>) {
        if self.is_empty() {
            return;
        }
        self.copy::<C>(u);
        let Self { columns, rows, tasks, u, forces, period } = self;
        let mut parts: Vec<Vec<&mut [f64]>> = tasks.iter().map(|_| Vec::with_capacity(C * *period)).collect();
        for lines in forces.chunks_mut(*columns) {
            lines.chunks_mut(COLUMNS).zip(&mut parts).for_each(|(line, parts)| parts.push(line));
        }
        let (period, columns) = (*period, *columns);
        tasks.par_iter().zip(parts).for_each(|(parts, lines)| {
            Arch::new().dispatch(Evaluation::<C> { parts, rows, u, lines, period, columns });
        });
    }

    /// Copies displacements, component by component.
    fn copy<const C: usize>(&mut self, all: &Displacements<'_>) {
        let (u, velocity) = (all.u.as_chunks::<C>().0, all.velocity.as_chunks::<C>().0);
        let period = self.period;
        let length = self.forces.len();
        let mut parts: Vec<Vec<&mut [f64]>> = self.tasks.iter().map(|_| Vec::new()).collect();
        for lines in self.u[..length].chunks_mut(self.columns) {
            lines.chunks_mut(COLUMNS).zip(&mut parts).for_each(|(line, parts)| parts.push(line));
        }
        let nodes = u.par_chunks(COLUMNS * period).enumerate();
        parts.into_par_iter().zip(nodes).for_each(|(lines, (task, u))| {
            let v = velocity.chunks(COLUMNS * period).nth(task).unwrap_or_default();
            match period {
                1 => Arch::new().dispatch(Copy::<C, 1> { u, v, ahead: all.ahead, lines }),
                _ => Arch::new().dispatch(Copy::<C, 2> { u, v, ahead: all.ahead, lines }),
            }
        });
    }

    /// Force on a node; 0 in no run.
    #[inline]
    pub fn force_of<const C: usize>(&self, node: usize) -> [f64; C] {
        if self.is_empty() {
            return [0.0; C];
        }
        // The period is 1 or 2, and a division would take longer than all else.
        let at = (node & (self.period - 1)) * self.columns + (node >> (self.period - 1));
        std::array::from_fn(|c| self.forces[at + c * self.period * self.columns])
    }

    /// Reads the forces on as many nodes from `first` on.
    #[inline(always)]
    pub fn read<const C: usize>(&self, first: usize, forces: &mut [[f64; C]]) {
        match self.period {
            0 => forces.fill([0.0; C]),
            1 => self.read_lines::<C, 1>(first, forces),
            _ => self.read_lines::<C, 2>(first, forces),
        }
    }

    #[inline(always)]
    fn read_lines<const C: usize, const P: usize>(&self, first: usize, forces: &mut [[f64; C]]) {
        for residue in 0..P.min(forces.len()) {
            let node = first + residue;
            let start = node % P * self.columns + node / P;
            let length = (forces.len() - residue).div_ceil(P);
            for c in 0..C {
                let line = &self.forces[start + c * P * self.columns..][..length];
                for (nodes, value) in forces[residue..].chunks_mut(P).zip(line) {
                    nodes[0][c] = *value;
                }
            }
        }
    }

    /// Number of forces.
    pub fn forces(&self) -> usize {
        self.forces.len()
    }

    /// Memory \[bytes\].
    pub fn bytes(&self) -> usize {
        let numbers = self.u.len() + self.forces.len();
        let parts: usize = self.tasks.iter().map(Vec::len).sum();
        let terms: usize = self.rows.iter().map(|row| row.terms.len()).sum();
        numbers * size_of::<f64>() + parts * size_of::<Part>() + terms * size_of::<Term>()
    }
}

/// Copies displacements of the nodes of a task to the lines of their components and residues.
struct Copy<'a, const C: usize, const P: usize> {
    u: &'a [[f64; C]],
    /// Velocities; empty where nothing damps.
    v: &'a [[f64; C]],
    ahead: f64,
    lines: Vec<&'a mut [f64]>,
}

impl<const C: usize, const P: usize> WithSimd for Copy<'_, C, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { u, v, ahead, mut lines } = self;
        for (block, u) in u.chunks(COPIED * P).enumerate() {
            for (k, line) in lines.iter_mut().enumerate() {
                let (c, residue) = (k / P, k % P);
                let line = &mut line[block * COPIED..];
                let u = u.iter().skip(residue).step_by(P).map(|u| u[c]);
                if v.is_empty() {
                    line.iter_mut().zip(u).for_each(|(to, u)| *to = u);
                    continue;
                }
                let v = v[block * COPIED * P..].iter().skip(residue).step_by(P).map(|v| v[c]);
                line.iter_mut().zip(u.zip(v)).for_each(|(to, (u, v))| *to = u + ahead * v);
            }
        }
    }
}

/// Forces on the nodes of a task, C components each.
struct Evaluation<'a, const C: usize> {
    parts: &'a [Part],
    rows: &'a [Row],
    u: &'a [f64],
    /// Forces of each component and residue on the columns of the task.
    lines: Vec<&'a mut [f64]>,
    period: usize,
    columns: usize,
}

impl<const C: usize> WithSimd for Evaluation<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for &part in self.parts {
            let mut rest = part;
            while rest.length > 0 {
                let done = match rest.length.div_ceil(S::F64_LANES) {
                    1 => self.forces::<S, 1>(simd, rest),
                    2 => self.forces::<S, 2>(simd, rest),
                    _ => self.forces::<S, VECTORS>(simd, rest),
                };
                rest = Part { column: rest.column + done, length: rest.length - done, ..rest };
            }
        }
    }
}

impl<const C: usize> Evaluation<'_, C> {
    /// Computes the forces on the first V vectors of nodes of a part; returns the number of nodes.
    #[inline(always)]
    fn forces<S: Simd, const V: usize>(&mut self, simd: S, part: Part) -> usize {
        let at = part.residue * self.columns + part.column;
        let sums = product::<S, C, V>(simd, &self.rows[part.row], self.u, at);
        let length = part.length.min(V * S::F64_LANES);
        let own = part.column % COLUMNS;
        for (c, sum) in sums.iter().enumerate() {
            let line = &mut self.lines[c * self.period + part.residue][own..][..length];
            let (whole, rest) = S::as_mut_simd_f64s(line);
            for (own, sum) in whole.iter_mut().zip(sum) {
                *own = *sum;
            }
            if let Some(sum) = sum.get(whole.len()).filter(|_| !rest.is_empty()) {
                simd.partial_store_f64s(rest, *sum);
            }
        }
        length
    }
}

/// Forces on V vectors of nodes, the first of which has its component 0 at `at`.
#[inline(always)]
fn product<S: Simd, const C: usize, const V: usize>(
    simd: S,
    row: &Row,
    u: &[f64],
    at: usize,
) -> [[S::f64s; V]; C] {
    let mut sums = [[simd.splat_f64s(0.0); V]; C];
    match C {
        1 => add::<S, C, V, 1>(simd, row, (u, at), &mut sums),
        2 => add::<S, C, V, 3>(simd, row, (u, at), &mut sums),
        _ => {
            add::<S, C, V, 1>(simd, row, (u, at), &mut sums);
            add::<S, C, V, 2>(simd, row, (u, at), &mut sums);
            add::<S, C, V, 3>(simd, row, (u, at), &mut sums);
            add::<S, C, V, 4>(simd, row, (u, at), &mut sums);
            add::<S, C, V, 5>(simd, row, (u, at), &mut sums);
            add::<S, C, V, 6>(simd, row, (u, at), &mut sums);
            add::<S, C, V, 7>(simd, row, (u, at), &mut sums);
        }
    }
    sums
}

/// Adds the terms whose components are those that bits of `WHICH` represent.
#[inline(always)]
fn add<S: Simd, const C: usize, const V: usize, const WHICH: usize>(
    simd: S,
    row: &Row,
    (u, at): (&[f64], usize),
    sums: &mut [[S::f64s; V]; C],
) {
    for term in &row.terms[row.starts[WHICH]..row.starts[WHICH + 1]] {
        let (x, _) = S::as_simd_f64s(&u[at.wrapping_add_signed(term.shift)..][..V * S::F64_LANES]);
        for (c, (sum, k)) in sums.iter_mut().zip(&term.stiffness).enumerate() {
            if WHICH >> c & 1 == 1 {
                let k = simd.splat_f64s(*k);
                for (sum, x) in sum.iter_mut().zip(x) {
                    *sum = simd.mul_add_e_f64s(k, *x, *sum);
                }
            }
        }
    }
}
