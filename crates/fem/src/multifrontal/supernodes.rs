//! Fronts: vertices eliminated together, and their amalgamation.

use super::tree::{Forest, postorder};
use crate::ordering::{CompressedPattern, NONE};

/// Allowed fraction of explicit zeros in a front, by its number of pivots: few large fronts are faster than many small ones.
/// The form is CHOLMOD's (Chen, Davis, Hager, Rajamanickam 2008, table of `nrelax` and `zrelax`).
const RELAXATION: [(usize, f64); 4] = [(8, 1.0), (24, 0.6), (64, 0.15), (usize::MAX, 0.05)];

/// Fronts in postorder.
#[derive(Clone, Debug)]
pub(super) struct Supernodes {
    /// Vertices in order of elimination.
    pub order: Vec<usize>,
    /// First position of each front in `order`; one more entry than fronts.
    pub first: Vec<usize>,
    /// Parent of each front, or `NONE`.
    pub parent: Vec<usize>,
}

/// A front during merging.
struct Merging {
    /// Pivots \[equations\].
    width: usize,
    /// Rows, including pivots.
    height: usize,
    /// Entries that are not explicit zeros.
    entries: f64,
    /// Positions of its vertices in the forest.
    members: Vec<usize>,
    children: Vec<usize>,
}

/// Entries of a trapezoid with `width` columns, the first of length `height`.
fn trapezoid(width: usize, height: usize) -> f64 {
    let (w, h) = (width as f64, height as f64);
    w * h - 0.5 * w * (w - 1.0)
}

impl Supernodes {
    /// Finds fundamental fronts and merges children into parents as [`RELAXATION`] allows. The last `retained` vertices form
    /// one front, into which nothing is merged.
    pub fn new(matrix: &CompressedPattern, forest: &Forest, retained: usize) -> Self {
        let (mut fronts, parent) = fundamental(matrix, forest, retained);
        let protected = if retained > 0 { fronts.len() - 1 } else { NONE };
        let mut merged = vec![false; fronts.len()];
        for s in 0..fronts.len() {
            if s != protected {
                merge_children(&mut fronts, s, &mut merged);
            }
        }
        // The parent of a merged front is the parent of the front that absorbed it.
        let mut owner: Vec<usize> = (0..fronts.len()).collect();
        for s in (0..fronts.len()).rev() {
            if merged[s] {
                owner[s] = owner[parent[s]];
            }
        }
        let kept: Vec<usize> = (0..fronts.len()).filter(|&s| !merged[s]).collect();
        let mut number = vec![NONE; fronts.len()];
        for (k, &s) in kept.iter().enumerate() {
            number[s] = k;
        }
        let parents: Vec<usize> =
            kept.iter().map(|&s| if parent[s] == NONE { NONE } else { number[owner[parent[s]]] }).collect();
        let post = postorder(&parents);
        let mut place = vec![0_usize; post.len()];
        for (new, &old) in post.iter().enumerate() {
            place[old] = new;
        }
        let mut result =
            Self { order: Vec::with_capacity(forest.order.len()), first: vec![0], parent: Vec::new() };
        for &k in &post {
            result.order.extend(fronts[kept[k]].members.iter().map(|&p| forest.order[p]));
            result.first.push(result.order.len());
            result.parent.push(if parents[k] == NONE { NONE } else { place[parents[k]] });
        }
        result
    }
}

/// Chains of vertices whose columns differ only by the vertex itself, and the parent of each chain.
fn fundamental(matrix: &CompressedPattern, forest: &Forest, retained: usize) -> (Vec<Merging>, Vec<usize>) {
    let n = forest.order.len();
    let inner = n - retained;
    let mut children = vec![0_u32; n];
    for &p in forest.parent.iter().filter(|&&p| p != NONE) {
        children[p] += 1;
    }
    let weight = |k: usize| matrix.weight(forest.order[k]);
    let continues = |k: usize| {
        let joined = forest.parent[k - 1] == k
            && children[k] == 1
            && forest.count[k - 1] == forest.count[k] + weight(k - 1);
        (k != inner && joined) || k > inner
    };
    let mut fronts: Vec<Merging> = Vec::new();
    let mut front_of = vec![0_usize; n];
    for (k, front_of) in front_of.iter_mut().enumerate() {
        if k == 0 || !continues(k) {
            let height = forest.count[k];
            fronts.push(Merging {
                width: 0,
                height,
                entries: 0.0,
                members: Vec::new(),
                children: Vec::new(),
            });
        }
        *front_of = fronts.len() - 1;
        if let Some(front) = fronts.last_mut() {
            front.width += weight(k);
            front.members.push(k);
        }
    }
    let mut parent = vec![NONE; fronts.len()];
    for s in 0..fronts.len() {
        fronts[s].entries = trapezoid(fronts[s].width, fronts[s].height);
        let up = fronts[s].members.last().map_or(NONE, |&last| forest.parent[last]);
        if up != NONE {
            parent[s] = front_of[up];
            fronts[front_of[up]].children.push(s);
        }
    }
    (fronts, parent)
}

/// Merges children of `s` into it, beginning with those that add fewest zeros.
fn merge_children(fronts: &mut [Merging], s: usize, merged: &mut [bool]) {
    let mut candidates = std::mem::take(&mut fronts[s].children);
    let zeros = |fronts: &[Merging], c: usize| {
        let (child, front) = (&fronts[c], &fronts[s]);
        let (width, height) = (child.width + front.width, child.width + front.height);
        let total = trapezoid(width, height);
        (width, total - child.entries - front.entries, total)
    };
    // Stable sort: equal candidates stay ordered by number.
    candidates.sort_by(|&a, &b| zeros(fronts, a).1.total_cmp(&zeros(fronts, b).1));
    let mut kept = Vec::new();
    let mut members = Vec::new();
    for c in candidates {
        let (width, added, total) = zeros(fronts, c);
        let admitted =
            RELAXATION.iter().find(|(most, _)| width <= *most).is_some_and(|(_, z)| added <= z * total);
        if !admitted {
            kept.push(c);
            continue;
        }
        merged[c] = true;
        let child_children = std::mem::take(&mut fronts[c].children);
        kept.extend(child_children);
        members.append(&mut fronts[c].members);
        fronts[s].height += fronts[c].width;
        fronts[s].width = width;
        fronts[s].entries += fronts[c].entries;
    }
    members.append(&mut fronts[s].members);
    fronts[s].members = members;
    fronts[s].children = kept;
}
