//! Fill-reducing orderings of symmetric patterns.
//!
//! Equations with the same neighbours (the degrees of freedom of a node) are first collapsed into one vertex. The ordering has
//! the same quality in a fraction of the time, and the symbolic analysis works on vertices too.
//!
//! Minimum degree is local and fast. Nested dissection cuts the graph by small separators and pays off if separators are large,
//! that is in three dimensions. [`Ordering::Automatic`] evaluates the cost of minimum degree, see [`DISSECTION_PAYS`].

use crate::error::DirectError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use feral_metis::{CscPattern, MetisOptions, metis_order_full};

/// Ordering of equations before elimination.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ordering {
    /// The cheaper of the others, judged by the operations of the factorisation.
    #[default]
    Automatic,
    /// Approximate minimum degree (Amestoy, Davis, Duff 1996).
    MinimumDegree,
    /// Multilevel nested dissection (Karypis, Kumar 1998).
    NestedDissection,
    /// As numbered.
    Natural,
}

/// Floating-point operations of the factorisation per edge of the vertex graph above which nested dissection is tried.
/// Dissection takes about 0.5 us per edge, in which the factorisation performs 2e4 operations, and saves at best three quarters
/// of them. These are estimates; the only check is that meshes of quad4 stay below and those of hex8 lie above.
pub const DISSECTION_PAYS: f64 = 2.5e4;

/// Relative difference in size allowed between the parts left by a separator. Cubes of hex8, four seeds each, mean operations
/// of the factorisation in 1e9 (57k and 160k equations): 0.2 (METIS) 71 and 624, 0.1 64 and 581, 0.05 65 and 591, 0.02 64 and
/// 551; the spread of seeds is 7 %, with 0.2 it is 14 %.
const IMBALANCE: f64 = 0.02;

/// Marks the absence of a vertex.
pub(crate) const NONE: usize = usize::MAX;

/// Calls its argument with every edge.
type Visit<'a> = dyn Fn(&mut dyn FnMut(usize, usize)) + 'a;

/// Undirected graph: neighbours of each vertex, sorted, without itself.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    /// Start of each vertex's neighbours; one more entry than vertices.
    pub starts: Vec<usize>,
    /// Neighbours of all vertices.
    pub neighbours: Vec<u32>,
}

impl Graph {
    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Neighbours of a vertex.
    pub fn neighbours(&self, vertex: usize) -> &[u32] {
        &self.neighbours[self.starts[vertex]..self.starts[vertex + 1]]
    }

    /// Builds the graph from edges (larger, smaller), visited twice in the same order.
    fn from_edges(n: usize, visit: &Visit<'_>) -> Self {
        let mut starts = vec![0_usize; n + 1];
        visit(&mut |a, b| {
            starts[a + 1] += 1;
            starts[b + 1] += 1;
        });
        for v in 0..n {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut neighbours = vec![0_u32; starts[n]];
        visit(&mut |a, b| {
            for (from, to) in [(a, b), (b, a)] {
                neighbours[next[from]] = to as u32;
                next[from] += 1;
            }
        });
        Self { starts, neighbours }
    }

    /// The subgraph of the `n` vertices numbered by `number` (`NONE` elsewhere), in the same order.
    fn induced(&self, number: &[usize], n: usize) -> Self {
        let mut graph = Self { starts: Vec::with_capacity(n + 1), neighbours: Vec::new() };
        graph.starts.push(0);
        for v in (0..self.len()).filter(|&v| number[v] != NONE) {
            let kept = self.neighbours(v).iter().map(|&u| number[u as usize]).filter(|&u| u != NONE);
            graph.neighbours.extend(kept.map(|u| u as u32));
            graph.starts.push(graph.neighbours.len());
        }
        graph
    }
}

/// A pattern with indistinguishable consecutive equations collapsed.
#[derive(Clone, Debug)]
pub(crate) struct CompressedPattern {
    /// First equation of each vertex; one more entry than vertices.
    pub first: Vec<usize>,
    /// Couplings of vertices.
    pub graph: Graph,
}

impl CompressedPattern {
    /// Number of equations of a vertex.
    pub fn weight(&self, vertex: usize) -> usize {
        self.first[vertex + 1] - self.first[vertex]
    }
}

/// Off-diagonal rows of a column of a lower triangle with sorted rows.
fn below<'a>(pattern: SymbolicSparseColMatRef<'a, usize>, col: usize) -> &'a [usize] {
    let rows = pattern.row_idx_of_col_raw(col);
    &rows[rows.partition_point(|&r| r <= col)..]
}

/// Collapses runs of equations with equal closed neighbourhoods and equal `class`. `pattern` is a lower triangle.
///
/// Equations v and v+1 are equivalent if v couples to v+1, the rows below are the same, and every column before v holds both or
/// neither: counted in one pass over the pattern.
pub(crate) fn compress(pattern: SymbolicSparseColMatRef<'_, usize>, class: &[bool]) -> CompressedPattern {
    let n = pattern.ncols();
    let mut above = vec![0_u32; n];
    let mut both = vec![0_u32; n];
    for col in 0..n {
        let rows = below(pattern, col);
        for (k, &row) in rows.iter().enumerate() {
            above[row] += 1;
            both[row] += u32::from(rows.get(k + 1) == Some(&(row + 1)));
        }
    }
    let alike = |v: usize| {
        let (rows, next) = (below(pattern, v), below(pattern, v + 1));
        class[v] == class[v + 1]
            && both[v] == above[v]
            && above[v + 1] == above[v] + 1
            && rows.first() == Some(&(v + 1))
            && &rows[1..] == next
    };
    let mut first: Vec<usize> = (0..n).filter(|&v| v == 0 || !alike(v - 1)).collect();
    let mut vertex = vec![0_usize; n];
    first.push(n);
    for (k, range) in first.windows(2).enumerate() {
        vertex[range[0]..range[1]].fill(k);
    }
    let visit = |f: &mut dyn FnMut(usize, usize)| {
        for (k, range) in first.windows(2).enumerate() {
            // Rows are also grouped by vertices: the first equation of each represents all.
            for &row in below(pattern, range[0]).iter().filter(|&&r| first[vertex[r]] == r) {
                if vertex[row] != k {
                    f(vertex[row], k);
                }
            }
        }
    };
    let graph = Graph::from_edges(first.len() - 1, &visit);
    CompressedPattern { first, graph }
}

/// Orders the vertices: position -> vertex. Those marked in `last` come last, in their order; the others are ordered by
/// `method` without regard to them. `operations` gives the cost of an order.
///
/// # Errors
/// [`DirectError::Ordering`] if the graph exceeds the ordering's integers.
pub(crate) fn order(
    graph: &Graph,
    last: &[bool],
    method: Ordering,
    operations: &dyn Fn(&[usize]) -> f64,
) -> Result<Vec<usize>, DirectError> {
    let inner: Vec<usize> = (0..graph.len()).filter(|&v| !last[v]).collect();
    let mut number = vec![NONE; graph.len()];
    for (k, &v) in inner.iter().enumerate() {
        number[v] = k;
    }
    let whole;
    let part = if inner.len() == graph.len() {
        graph
    } else {
        whole = graph.induced(&number, inner.len());
        &whole
    };
    let complete = |order: Vec<usize>| -> Vec<usize> {
        let kept = (0..graph.len()).filter(|&v| last[v]);
        order.into_iter().map(|k| inner[k]).chain(kept).collect()
    };
    match method {
        Ordering::Natural => Ok(complete((0..inner.len()).collect())),
        Ordering::MinimumDegree => Ok(complete(minimum_degree(part)?)),
        Ordering::NestedDissection => Ok(complete(nested_dissection(part)?)),
        Ordering::Automatic => {
            let local = complete(minimum_degree(part)?);
            let cost = operations(&local);
            if cost <= DISSECTION_PAYS * part.neighbours.len() as f64 * 0.5 {
                return Ok(local);
            }
            let dissected = complete(nested_dissection(part)?);
            Ok(if operations(&dissected) < cost { dissected } else { local })
        }
    }
}

/// faer's approximate minimum degree.
fn minimum_degree(graph: &Graph) -> Result<Vec<usize>, DirectError> {
    let n = graph.len();
    let mut starts = vec![0_usize; n + 1];
    let mut rows = Vec::with_capacity(graph.neighbours.len() / 2);
    for v in 0..n {
        rows.extend(graph.neighbours(v).iter().map(|&u| u as usize).filter(|&u| u < v));
        starts[v + 1] = rows.len();
    }
    let upper = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &rows);
    let request = amd::order_maybe_unsorted_scratch::<usize>(n, rows.len());
    let mut memory = MemBuffer::try_new(request).map_err(|_| DirectError::OutOfMemory)?;
    let (mut forward, mut inverse) = (vec![0_usize; n], vec![0_usize; n]);
    let control = amd::Control::default();
    amd::order_maybe_unsorted(&mut forward, &mut inverse, upper, control, MemStack::new(&mut memory))
        .map_err(|e| DirectError::Ordering(format!("minimum degree: {e:?}")))?;
    Ok(forward)
}

/// Nested dissection by `feral-metis`, whose integers have 32 bits.
fn nested_dissection(graph: &Graph) -> Result<Vec<usize>, DirectError> {
    let too_large = |_| DirectError::Ordering("nested dissection: more than 2^31 couplings".into());
    let starts: Vec<i32> =
        graph.starts.iter().map(|&s| i32::try_from(s)).collect::<Result<_, _>>().map_err(too_large)?;
    let rows: Vec<i32> = graph.neighbours.iter().map(|&r| r as i32).collect();
    let pattern = CscPattern::new(graph.len(), &starts, &rows)
        .ok_or_else(|| DirectError::Ordering("nested dissection: malformed graph".into()))?;
    let options = MetisOptions { max_imbalance: IMBALANCE, ..MetisOptions::default() };
    let (order, ..) = metis_order_full(&pattern, &options)
        .map_err(|e| DirectError::Ordering(format!("nested dissection: {e:?}")))?;
    Ok(order.into_iter().map(|v| v as usize).collect())
}
