//! Sums of scattered contributions in parallel, with the same bits for any number of threads and without atomics.
//!
//! The map is stored in inverse form: for every entry of the result, the list of its contributions, in the order of the cells.
//! Entries are then independent of each other. Nothing is written twice, and the list takes four bytes per contribution.

use crate::term::Pattern;
use rayon::prelude::*;

/// Entries of the result summed by one task: fixed, so that nothing depends on the number of threads.
const ENTRIES: usize = 8192;

/// Cells evaluated by one task.
const CELLS: usize = 256;

/// See the module.
#[derive(Clone, Debug, Default)]
pub struct Gather {
    /// Entries of the result with contributions: those of each task in the order of their first contributions. Values of dense blocks
    /// are then read in order, while the entries of a task stay in the cache.
    entries: Vec<u32>,
    /// First contribution of each of them; one element more than the number of entries.
    starts: Vec<u32>,
    /// Contributions, ascending for each entry.
    sources: Vec<u32>,
}

/// Index of a value. Values that do not fit would take 34 GB.
fn index(k: usize) -> u32 {
    u32::try_from(k).expect("a term has fewer than 2^32 values")
}

impl Gather {
    /// The inverse of `places`, the destinations of the values in a result of `length` entries. Values placed beyond it are
    /// dropped.
    #[must_use]
    pub fn new(places: &[usize], length: usize) -> Self {
        let placed = || places.iter().enumerate().filter(|(_, p)| **p < length);
        let (mut count, mut first) = (vec![0_u32; length], vec![0_u32; length]);
        for (value, &place) in placed() {
            if count[place] == 0 {
                first[place] = index(value);
            }
            count[place] += 1;
        }
        let mut entries: Vec<u32> = (0..length).filter(|k| count[*k] > 0).map(index).collect();
        for task in entries.chunk_by_mut(|a, b| *a as usize / ENTRIES == *b as usize / ENTRIES) {
            task.sort_unstable_by_key(|e| first[*e as usize]);
        }
        // Entries then hold the place of their next contribution.
        let (mut next, mut starts, mut end) = (first, Vec::with_capacity(entries.len() + 1), 0);
        for &entry in &entries {
            starts.push(end);
            next[entry as usize] = end;
            end += count[entry as usize];
        }
        starts.push(end);
        let mut sources = vec![0; end as usize];
        for (value, &place) in placed() {
            sources[next[place] as usize] = index(value);
            next[place] += 1;
        }
        Self { entries, starts, sources }
    }

    /// Adds to every entry of `result` its contributions among `values`, in ascending order.
    pub fn add(&self, values: &[f64], result: &mut [f64]) {
        result.par_chunks_mut(ENTRIES).enumerate().for_each(|(chunk, part)| {
            let first = chunk * ENTRIES;
            let from = self.entries.partition_point(|&e| (e as usize) < first);
            let to = self.entries.partition_point(|&e| (e as usize) < first + part.len());
            for (entry, range) in self.entries[from..to].iter().zip(self.starts[from..=to].windows(2)) {
                let to = &mut part[*entry as usize - first];
                let mut sum = *to;
                for &source in &self.sources[range[0] as usize..range[1] as usize] {
                    sum += values[source as usize];
                }
                *to = sum;
            }
        });
    }

    /// Bytes of the lists.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * (self.entries.len() + self.starts.len() + self.sources.len())
    }
}

/// Nodal forces of a term: those of its cells, found in parallel and added in a fixed order.
#[derive(Clone, Debug)]
pub struct CellForces {
    gather: Gather,
    /// Forces of all cells, in the order of the pattern.
    forces: Vec<f64>,
}

impl CellForces {
    /// Forces for the cells of `pattern` in a system of `dofs` degrees of freedom.
    #[must_use]
    pub fn new(pattern: &Pattern, dofs: usize) -> Self {
        Self { gather: Gather::new(pattern.dofs(), dofs), forces: vec![0.0; pattern.dofs().len()] }
    }

    /// Adds the forces of all cells to `r`. `force(cell, dofs, f)` writes those of one cell into `f`, which is initially zero.
    pub fn add(
        &mut self,
        pattern: &Pattern,
        force: impl Fn(usize, &[usize], &mut [f64]) + Sync,
        r: &mut [f64],
    ) {
        let cells = pattern.starts().len() - 1;
        let mut tasks: Vec<(usize, &mut [f64])> = Vec::with_capacity(cells.div_ceil(CELLS));
        let mut rest = self.forces.as_mut_slice();
        for first in (0..cells).step_by(CELLS) {
            let last = (first + CELLS).min(cells);
            let (part, after) = rest.split_at_mut(pattern.starts()[last] - pattern.starts()[first]);
            tasks.push((first, part));
            rest = after;
        }
        tasks.into_par_iter().for_each(|(first, part)| {
            part.fill(0.0);
            let mut rest = part;
            for cell in first..(first + CELLS).min(cells) {
                let dofs = pattern.block(cell);
                let (here, after) = rest.split_at_mut(dofs.len());
                force(cell, dofs, here);
                rest = after;
            }
        });
        self.gather.add(&self.forces, r);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_sum_their_values_in_order_and_others_stay() {
        let gather = Gather::new(&[3, 1, usize::MAX, 3, 1, 0], 5);
        let mut result = [1.0, 0.0, 7.0, 0.0, 7.0];
        gather.add(&[1.0, 2.0, 100.0, 4.0, 8.0, 16.0], &mut result);
        assert_eq!(result, [17.0, 10.0, 7.0, 5.0, 7.0]);
    }

    #[test]
    fn nothing_placed_changes_nothing() {
        let mut result = [1.0; 3];
        Gather::new(&[usize::MAX; 4], 3).add(&[1.0; 4], &mut result);
        assert_eq!(result, [1.0; 3]);
    }

    #[test]
    fn forces_of_cells_are_those_of_a_serial_loop_for_any_number_of_threads() {
        let cells: Vec<[usize; 3]> = (0..5000).map(|k| [k, (7 * k + 1) % 5002, k + 2]).collect();
        let pattern = Pattern::from_blocks(cells.iter().map(|c| c.as_slice()));
        let force = |cell: usize, dofs: &[usize], f: &mut [f64]| {
            for (f, &dof) in f.iter_mut().zip(dofs) {
                *f = ((cell * 31 + dof) as f64).sin();
            }
        };
        let mut expected = vec![0.0; 5002];
        for (cell, dofs) in cells.iter().enumerate() {
            let mut f = [0.0; 3];
            force(cell, dofs, &mut f);
            dofs.iter().zip(f).for_each(|(&dof, f)| expected[dof] += f);
        }
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut r = vec![0.0; 5002];
            pool.install(|| CellForces::new(&pattern, 5002).add(&pattern, force, &mut r));
            assert_eq!(r, expected);
        }
    }
}
