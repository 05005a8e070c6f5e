//! Assembly of cell matrices into compressed rows of node blocks.
//!
//! A degree of freedom is `node * B + component`. Fixed degrees of freedom keep their positions, so that blocks stay whole.
//! Their rows and columns are empty except for the diagonal, which is as large as the others of the node. With zero on the
//! right-hand side, they stay zero.

use super::csr::BlockCsr;
use crate::dof::Equations;
use crate::error::FemError;
use crate::term::{Pattern, PatternId};
use rayon::prelude::*;

/// Stored blocks summed by one task.
const CHUNK: usize = 1024;

/// Position of a node block among the values of the patterns.
#[derive(Clone, Copy, Debug)]
struct Source {
    /// Index of its first entry among the values of its pattern.
    offset: u32,
    /// Index of the pattern.
    pattern: u16,
    /// Number of entries from one row to the next.
    stride: u16,
}

/// The sum of dense cell blocks as a matrix of node blocks. For every stored block the list of its contributions is kept, in
/// the order of the cells. Blocks are summed independently of each other and always in the same order.
#[derive(Clone, Debug)]
pub struct Assembly<const B: usize> {
    starts: Vec<usize>,
    columns: Vec<u32>,
    first: Vec<u32>,
    sources: Vec<Source>,
    free: Vec<[bool; B]>,
    ids: Vec<PatternId>,
}

impl<const B: usize> Assembly<B> {
    /// Builds the pattern and the lists of contributions.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] if a block of a pattern does not list all components of its nodes consecutively, or if there
    /// are more values than the indices can address (2³² for each pattern).
    pub fn new(patterns: &[&Pattern], equations: &Equations) -> Result<Self, FemError> {
        let nodes = equations.number.len() / B;
        let free: Vec<[bool; B]> = (0..nodes)
            .map(|n| std::array::from_fn(|i| equations.number[n * B + i] != Equations::FIXED))
            .collect();
        check::<B>(patterns, equations.number.len())?;
        let held: Vec<bool> = free.iter().map(|f| f.iter().all(|f| !f)).collect();
        let stored = |row: usize, column: usize| row == column || !(held[row] || held[column]);
        let (starts, columns) = rows::<B>(patterns, nodes, &stored);
        let mut result =
            Self { starts, columns, first: Vec::new(), sources: Vec::new(), free, ids: ids(patterns) };
        result.find_sources(patterns, &stored);
        Ok(result)
    }

    /// True if it was made for these patterns.
    #[must_use]
    pub fn fits(&self, patterns: &[&Pattern]) -> bool {
        self.ids == ids(patterns)
    }

    /// Free components of each node.
    #[must_use]
    pub fn free(&self) -> &[[bool; B]] {
        &self.free
    }

    fn place(&self, row: usize, column: usize) -> Option<usize> {
        let range = self.starts[row]..self.starts[row + 1];
        self.columns[range].binary_search(&(column as u32)).ok().map(|k| self.starts[row] + k)
    }

    fn find_sources(&mut self, patterns: &[&Pattern], stored: &dyn Fn(usize, usize) -> bool) {
        let mut places: Vec<(u32, Source)> = Vec::new();
        let mut count = vec![0_u32; self.columns.len() + 1];
        for (number, pattern) in patterns.iter().enumerate() {
            let mut offset = 0;
            for block in pattern.blocks() {
                for (i, row) in block.chunks_exact(B).enumerate() {
                    for (j, column) in block.chunks_exact(B).enumerate() {
                        let (row, column) = (row[0] / B, column[0] / B);
                        if !stored(row, column) {
                            continue;
                        }
                        if let Some(place) = self.place(row, column) {
                            count[place + 1] += 1;
                            let first = offset + i * B * block.len() + j * B;
                            let source = Source {
                                offset: first as u32,
                                pattern: number as u16,
                                stride: block.len() as u16,
                            };
                            places.push((place as u32, source));
                        }
                    }
                }
                offset += block.len() * block.len();
            }
        }
        for k in 0..self.columns.len() {
            count[k + 1] += count[k];
        }
        let mut next = count.clone();
        self.sources = vec![Source { offset: 0, pattern: 0, stride: 0 }; places.len()];
        for (place, source) in places {
            let at = &mut next[place as usize];
            self.sources[*at as usize] = source;
            *at += 1;
        }
        self.first = count;
    }

    /// The matrix of the given values, one slice for each pattern.
    #[must_use]
    pub fn assemble(&self, values: &[&[f64]]) -> BlockCsr<B, B> {
        let mut matrix = BlockCsr {
            width: self.free.len(),
            starts: self.starts.clone(),
            columns: self.columns.clone(),
            values: vec![[[0.0; B]; B]; self.columns.len()],
        };
        self.assemble_into(values, &mut matrix);
        matrix
    }

    /// As [`Assembly::assemble`], into a matrix made by that function.
    pub fn assemble_into(&self, values: &[&[f64]], matrix: &mut BlockCsr<B, B>) {
        matrix.values.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, blocks)| {
            for (k, block) in blocks.iter_mut().enumerate() {
                let place = chunk * CHUNK + k;
                *block = [[0.0; B]; B];
                for source in &self.sources[self.first[place] as usize..self.first[place + 1] as usize] {
                    let from = &values[source.pattern as usize][source.offset as usize..];
                    for (i, row) in block.iter_mut().enumerate() {
                        for (entry, value) in row.iter_mut().zip(&from[i * source.stride as usize..]) {
                            *entry += value;
                        }
                    }
                }
            }
        });
        self.hold(matrix);
    }

    /// Empties the rows and columns of fixed degrees of freedom and sets their diagonal.
    fn hold(&self, matrix: &mut BlockCsr<B, B>) {
        let (starts, columns) = (&matrix.starts, &matrix.columns);
        for row in 0..self.free.len() {
            let range = starts[row]..starts[row + 1];
            for (block, &column) in matrix.values[range.clone()].iter_mut().zip(&columns[range]) {
                let (rows, across) = (self.free[row], self.free[column as usize]);
                if rows.iter().chain(&across).all(|&f| f) {
                    continue;
                }
                for (entries, free) in block.iter_mut().zip(rows) {
                    for (entry, across) in entries.iter_mut().zip(across) {
                        if !(free && across) {
                            *entry = 0.0;
                        }
                    }
                }
                if column as usize == row {
                    let largest = (0..B).map(|i| block[i][i]).fold(0.0, f64::max);
                    for i in (0..B).filter(|&i| !rows[i]) {
                        block[i][i] = if largest > 0.0 { largest } else { 1.0 };
                    }
                }
            }
        }
    }

    /// Bytes of the pattern and the contributions.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.sources.as_slice())
            + size_of_val(self.first.as_slice())
            + size_of_val(self.columns.as_slice())
            + size_of_val(self.starts.as_slice())
    }
}

fn ids(patterns: &[&Pattern]) -> Vec<PatternId> {
    patterns.iter().map(|p| p.id()).collect()
}

/// Checks that blocks list whole nodes and all indices fit.
fn check<const B: usize>(patterns: &[&Pattern], dofs: usize) -> Result<(), FemError> {
    let fits = |n: usize| u32::try_from(n).is_ok();
    let mut contributions = 0;
    for (number, pattern) in patterns.iter().enumerate() {
        if !(fits(pattern.values()) && fits(dofs) && u16::try_from(number).is_ok()) {
            return Err(FemError::Factorisation(format!(
                "term {number} has {} values: more than the iterative solver counts (2^32)",
                pattern.values()
            )));
        }
        for block in pattern.blocks() {
            contributions += (block.len() / B).pow(2);
            let whole = |node: &[usize]| {
                node.len() == B
                    && node[0].is_multiple_of(B)
                    && node.iter().enumerate().all(|(i, &dof)| dof == node[0] + i && dof < dofs)
            };
            if u16::try_from(block.len()).is_err() || !block.chunks(B).all(whole) {
                return Err(FemError::Factorisation(format!(
                    "term {number} couples single degrees of freedom: the iterative solver works on whole nodes"
                )));
            }
        }
    }
    if fits(contributions) {
        return Ok(());
    }
    Err(FemError::Factorisation(format!(
        "{contributions} node blocks are more than the iterative solver counts"
    )))
}

/// Columns of each row, ascending: (row starts, columns).
fn rows<const B: usize>(
    patterns: &[&Pattern],
    nodes: usize,
    stored: &(dyn Fn(usize, usize) -> bool + Sync),
) -> (Vec<usize>, Vec<u32>) {
    // Cells of each node, then for each node the nodes of its cells.
    let cells: Vec<&[usize]> = patterns.iter().flat_map(|p| p.blocks()).collect();
    let mut first = vec![0_usize; nodes + 1];
    for dof in cells.iter().flat_map(|c| c.iter().step_by(B)) {
        first[dof / B + 1] += 1;
    }
    for node in 0..nodes {
        first[node + 1] += first[node];
    }
    let mut next = first.clone();
    let mut of_node = vec![0_u32; first[nodes]];
    for (number, cell) in cells.iter().enumerate() {
        for dof in cell.iter().step_by(B) {
            of_node[next[dof / B]] = number as u32;
            next[dof / B] += 1;
        }
    }
    let lists: Vec<Vec<u32>> = (0..nodes)
        .into_par_iter()
        .with_min_len(CHUNK)
        .map(|row| {
            let around = of_node[first[row]..first[row + 1]].iter().flat_map(|&c| cells[c as usize]);
            let mut list: Vec<u32> = around
                .step_by(B)
                .map(|dof| (dof / B) as u32)
                .filter(|&column| stored(row, column as usize))
                .chain([row as u32])
                .collect();
            list.sort_unstable();
            list.dedup();
            list
        })
        .collect();
    let mut starts = Vec::with_capacity(nodes + 1);
    starts.push(0);
    let mut columns = Vec::with_capacity(lists.iter().map(Vec::len).sum());
    for list in lists {
        columns.extend_from_slice(&list);
        starts.push(columns.len());
    }
    (starts, columns)
}
