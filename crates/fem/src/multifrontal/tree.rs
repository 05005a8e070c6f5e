//! Elimination tree and column counts of a graph under an order.

use crate::ordering::{CompressedPattern, NONE};

/// The elimination forest in postorder: vertices are renumbered by position.
#[derive(Clone, Debug)]
pub(super) struct Forest {
    /// Vertex at each position.
    pub order: Vec<usize>,
    /// Position of each vertex.
    pub position: Vec<usize>,
    /// Parent position of each position, or `NONE`.
    pub parent: Vec<usize>,
    /// Equations in each column of the factor, including the diagonal block.
    pub count: Vec<usize>,
}

impl Forest {
    /// The forest of `matrix` eliminated in `order`. Its last `retained` vertices are kept together at the end. They form a
    /// chain, as if they were all coupled, because the remaining matrix there is dense.
    pub fn new(matrix: &CompressedPattern, order: &[usize], retained: usize) -> Self {
        let graph = &matrix.graph;
        let n = order.len();
        let inner = n - retained;
        let mut place = vec![0_usize; n];
        for (k, &v) in order.iter().enumerate() {
            place[v] = k;
        }
        let mut parent = vec![NONE; n];
        let mut ancestor = vec![NONE; n];
        for (k, &v) in order.iter().enumerate() {
            for &u in graph.neighbours(v) {
                let mut i = place[u as usize];
                // Climbs from i to the root of its present tree, shortening the path.
                while i < k {
                    let next = ancestor[i];
                    ancestor[i] = k;
                    if next == NONE {
                        parent[i] = k;
                        break;
                    }
                    i = next;
                }
            }
        }
        for p in &mut parent[..inner] {
            if *p != NONE {
                *p = (*p).min(inner);
            }
        }
        for (k, p) in parent.iter_mut().enumerate().skip(inner) {
            *p = if k + 1 < n { k + 1 } else { NONE };
        }
        let post = postorder(&parent);
        let mut renumber = vec![0_usize; n];
        for (new, &old) in post.iter().enumerate() {
            renumber[old] = new;
        }
        let mut forest = Self {
            order: post.iter().map(|&k| order[k]).collect(),
            position: place.iter().map(|&k| renumber[k]).collect(),
            parent: post
                .iter()
                .map(|&k| if parent[k] == NONE { NONE } else { renumber[parent[k]] })
                .collect(),
            count: Vec::new(),
        };
        forest.count = forest.column_counts(matrix);
        for k in (inner..n).rev() {
            let next = if k + 1 < n { forest.count[k + 1] } else { 0 };
            forest.count[k] = next + matrix.weight(forest.order[k]);
        }
        forest
    }

    /// Equations of each column of the factor (Gilbert, Ng, Peyton 1994). The row subtree of i is the union of paths from its
    /// leaves to i; a leaf adds the row, and the least common ancestor of consecutive leaves removes one copy.
    fn column_counts(&self, matrix: &CompressedPattern) -> Vec<usize> {
        let n = self.order.len();
        let weight = |j: usize| matrix.weight(self.order[j]) as isize;
        let mut first = vec![NONE; n];
        let mut delta = vec![0_isize; n];
        for k in 0..n {
            if first[k] == NONE {
                delta[k] = weight(k);
            }
            let mut j = k;
            while j != NONE && first[j] == NONE {
                first[j] = k;
                j = self.parent[j];
            }
        }
        let mut ancestor: Vec<usize> = (0..n).collect();
        // Largest `first` seen in each row subtree, plus one, and the last leaf.
        let mut largest = vec![0_usize; n];
        let mut last_leaf = vec![NONE; n];
        for j in 0..n {
            if self.parent[j] != NONE {
                delta[self.parent[j]] -= weight(j);
            }
            for &u in matrix.graph.neighbours(self.order[j]) {
                let i = self.position[u as usize];
                if i <= j || first[j] < largest[i] {
                    continue;
                }
                largest[i] = first[j] + 1;
                delta[j] += weight(i);
                if last_leaf[i] != NONE {
                    delta[root(&mut ancestor, last_leaf[i])] -= weight(i);
                }
                last_leaf[i] = j;
            }
            if self.parent[j] != NONE {
                ancestor[j] = self.parent[j];
            }
        }
        for j in 0..n {
            if self.parent[j] != NONE {
                delta[self.parent[j]] += delta[j];
            }
        }
        delta.into_iter().map(|d| d.max(0) as usize).collect()
    }

    /// Operations of the factorisation: the sum over equations of the squared length of their column.
    pub fn operations(&self, matrix: &CompressedPattern) -> f64 {
        let squares = |(k, &count): (usize, &usize)| -> f64 {
            let width = matrix.weight(self.order[k]);
            (0..width).map(|i| ((count - i) as f64).powi(2)).sum()
        };
        self.count.iter().enumerate().map(squares).sum()
    }
}

/// Root of the set of `leaf`, with path compression.
fn root(ancestor: &mut [usize], leaf: usize) -> usize {
    let mut top = leaf;
    while ancestor[top] != top {
        top = ancestor[top];
    }
    let mut k = leaf;
    while k != top {
        let next = ancestor[k];
        ancestor[k] = top;
        k = next;
    }
    top
}

/// Children first, roots and siblings in ascending order: position -> node.
pub(super) fn postorder(parent: &[usize]) -> Vec<usize> {
    let n = parent.len();
    let (mut head, mut next) = (vec![NONE; n + 1], vec![NONE; n]);
    for k in (0..n).rev() {
        let p = if parent[k] == NONE { n } else { parent[k] };
        next[k] = head[p];
        head[p] = k;
    }
    let mut order = Vec::with_capacity(n);
    let mut stack = vec![n];
    while let Some(&top) = stack.last() {
        let child = head[top];
        if child == NONE {
            stack.pop();
            if top < n {
                order.push(top);
            }
        } else {
            head[top] = next[child];
            stack.push(child);
        }
    }
    order
}
