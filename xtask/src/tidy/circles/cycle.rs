//! Cycles of a graph.

use std::collections::BTreeSet;

/// A cycle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Circle {
    /// Folder of the sources of the crate.
    pub folder: String,
    /// Files or folders of the cycle, sorted.
    pub members: Vec<String>,
    /// One path around it.
    pub round: Vec<String>,
}

/// Cycles of the graph with these edges, whose nodes have these names.
pub fn all(folder: &str, edges: &[BTreeSet<usize>], name: impl Fn(usize) -> String) -> Vec<Circle> {
    let circle = |members: Vec<usize>| Circle {
        folder: folder.to_owned(),
        round: round(edges, members[0]).into_iter().map(&name).collect(),
        members: members.into_iter().map(&name).collect(),
    };
    strongly_connected(edges).into_iter().map(circle).collect()
}

/// Sets of more than one node that reach each other, each sorted.
fn strongly_connected(edges: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let reached: Vec<BTreeSet<usize>> = (0..edges.len()).map(|from| reached(edges, from)).collect();
    let mutual = |from: usize| -> Vec<usize> {
        let back = |to: &usize| reached[*to].contains(&from);
        reached[from].iter().copied().filter(back).collect()
    };
    (0..edges.len())
        .map(|from| (from, mutual(from)))
        .filter(|(from, set)| set.first() == Some(from))
        .map(|(_, set)| set)
        .collect()
}

/// Modules reachable from a module; it includes itself only if it lies on a cycle.
fn reached(edges: &[BTreeSet<usize>], from: usize) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut left: Vec<usize> = edges[from].iter().copied().collect();
    while let Some(next) = left.pop() {
        if found.insert(next) {
            left.extend(&edges[next]);
        }
    }
    found
}

/// Shortest path from a module back to itself.
fn round(edges: &[BTreeSet<usize>], from: usize) -> Vec<usize> {
    let mut ways = vec![vec![from]];
    let mut seen = BTreeSet::new();
    loop {
        let mut longer = Vec::new();
        for way in &ways {
            for &next in way.last().map_or(&BTreeSet::new(), |&last| &edges[last]) {
                let way = || way.iter().copied().chain([next]).collect();
                if next == from {
                    return way();
                }
                if seen.insert(next) {
                    longer.push(way());
                }
            }
        }
        if longer.is_empty() {
            return Vec::new();
        }
        ways = longer;
    }
}
