//! A deterministic tree of axis-aligned boxes: median split along the longest axis, ties by index.

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<const D: usize> {
    /// Lower corner \[m\].
    pub min: [f64; D],
    /// Upper corner \[m\].
    pub max: [f64; D],
}

impl<const D: usize> Aabb<D> {
    /// Empty box, which contains no point.
    #[must_use]
    pub fn empty() -> Self {
        Self { min: [f64::INFINITY; D], max: [f64::NEG_INFINITY; D] }
    }

    /// Enlarges the box to contain `p`.
    pub fn include(&mut self, p: &[f64; D]) {
        for ((lo, hi), x) in self.min.iter_mut().zip(&mut self.max).zip(p) {
            *lo = lo.min(*x);
            *hi = hi.max(*x);
        }
    }

    /// Enlarges the box to contain another box.
    pub fn merge(&mut self, other: &Self) {
        self.include(&other.min);
        self.include(&other.max);
    }

    /// Enlarges the box by `margin` on every side.
    #[must_use]
    pub fn inflated(mut self, margin: f64) -> Self {
        for i in 0..D {
            self.min[i] -= margin;
            self.max[i] += margin;
        }
        self
    }

    /// Squared distance of `p` from the box, 0 inside.
    #[must_use]
    pub fn distance_squared(&self, p: &[f64; D]) -> f64 {
        let mut s = 0.0;
        for ((lo, hi), x) in self.min.iter().zip(&self.max).zip(p) {
            let d = (lo - x).max(x - hi).max(0.0);
            s += d * d;
        }
        s
    }

    /// True if the two boxes have a point in common.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        (0..D).all(|i| self.min[i] <= other.max[i] && other.min[i] <= self.max[i])
    }

    fn centre(&self, axis: usize) -> f64 {
        0.5 * (self.min[axis] + self.max[axis])
    }

    fn longest_axis(&self) -> usize {
        let mut best = 0;
        for i in 1..D {
            if self.max[i] - self.min[i] > self.max[best] - self.min[best] {
                best = i;
            }
        }
        best
    }
}

/// Most boxes in a leaf. Testing these few costs less than a further level.
const LEAF: usize = 4;

/// Size of the stack of a query. A median split halves the boxes, so 64 levels exceed any address space.
const DEPTH: usize = 64;

#[derive(Clone, Debug)]
struct Node<const D: usize> {
    aabb: Aabb<D>,
    /// Range of `order` below this node.
    range: (usize, usize),
    /// Children; `None` on a leaf.
    children: Option<(usize, usize)>,
}

/// A tree over numbered boxes.
#[derive(Clone, Debug)]
pub struct Tree<const D: usize> {
    nodes: Vec<Node<D>>,
    order: Vec<usize>,
}

impl<const D: usize> Tree<D> {
    /// Builds the tree over `boxes`, of which there must be at least one.
    #[must_use]
    pub fn build(boxes: &[Aabb<D>]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..boxes.len()).collect() };
        tree.split(boxes, 0, boxes.len());
        tree
    }

    fn split(&mut self, boxes: &[Aabb<D>], from: usize, to: usize) -> usize {
        let mut aabb = Aabb::empty();
        for &k in &self.order[from..to] {
            aabb.merge(&boxes[k]);
        }
        let id = self.nodes.len();
        self.nodes.push(Node { aabb, range: (from, to), children: None });
        if to - from > LEAF {
            let axis = aabb.longest_axis();
            self.order[from..to].sort_unstable_by(|&a, &b| {
                boxes[a].centre(axis).total_cmp(&boxes[b].centre(axis)).then(a.cmp(&b))
            });
            let middle = from + (to - from) / 2;
            let left = self.split(boxes, from, middle);
            let right = self.split(boxes, middle, to);
            self.nodes[id].children = Some((left, right));
        }
        id
    }

    /// Recomputes the boxes of all nodes after the numbered boxes moved, keeping the shape of the tree.
    pub fn refit(&mut self, boxes: &[Aabb<D>]) {
        for id in (0..self.nodes.len()).rev() {
            let mut aabb = Aabb::empty();
            match self.nodes[id].children {
                Some((a, b)) => {
                    aabb.merge(&self.nodes[a].aabb);
                    aabb.merge(&self.nodes[b].aabb);
                }
                None => {
                    let (from, to) = self.nodes[id].range;
                    for &k in &self.order[from..to] {
                        aabb.merge(&boxes[k]);
                    }
                }
            }
            self.nodes[id].aabb = aabb;
        }
    }

    /// Item with the smallest squared distance to `p`, and that distance, by branch and bound. `measure` gives the squared
    /// distance of an item, or `None` to exclude it. Ties go to the lower number.
    pub fn nearest(
        &self,
        p: &[f64; D],
        mut measure: impl FnMut(usize) -> Option<f64>,
    ) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        let mut stack = [(0usize, 0.0f64); DEPTH];
        let mut top = 0;
        if !self.nodes.is_empty() {
            stack[0] = (0, self.nodes[0].aabb.distance_squared(p));
            top = 1;
        }
        while top > 0 {
            top -= 1;
            let (id, bound) = stack[top];
            if best.is_some_and(|(_, d)| bound > d) {
                continue;
            }
            let node = &self.nodes[id];
            if let Some((a, b)) = node.children {
                let near = (a, self.nodes[a].aabb.distance_squared(p));
                let far = (b, self.nodes[b].aabb.distance_squared(p));
                let (first, second) = if near.1 <= far.1 { (near, far) } else { (far, near) };
                stack[top] = second;
                stack[top + 1] = first;
                top += 2;
                continue;
            }
            for &k in &self.order[node.range.0..node.range.1] {
                if let Some(d) = measure(k)
                    && best.is_none_or(|(i, e)| d < e || (d == e && k < i))
                {
                    best = Some((k, d));
                }
            }
        }
        best
    }

    /// Calls `found` for every item whose box meets `query`, in the order of the tree. `boxes` are those last passed to `build`
    /// or `refit`.
    pub fn overlapping(&self, query: &Aabb<D>, boxes: &[Aabb<D>], mut found: impl FnMut(usize)) {
        let mut stack = [0usize; DEPTH];
        let mut top = usize::from(!self.nodes.is_empty());
        while top > 0 {
            top -= 1;
            let node = &self.nodes[stack[top]];
            if !node.aabb.meets(query) {
                continue;
            }
            if let Some((a, b)) = node.children {
                stack[top] = b;
                stack[top + 1] = a;
                top += 2;
                continue;
            }
            for &k in self.order[node.range.0..node.range.1].iter().filter(|&&k| boxes[k].meets(query)) {
                found(k);
            }
        }
    }
}
