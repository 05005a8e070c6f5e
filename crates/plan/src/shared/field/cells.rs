//! Values on lines and triangles, at the nearest position of the nearest of them.

use nalgebra::Vector3;

/// Distance beyond the border of a line or triangle within which a position counts as on it, over its size: rounding.
const ON_BORDER: f64 = 1e-9;
/// Part beyond the border per distance from a line or triangle. Beside an edge at which a surface turns by less than 53 degrees, a
/// position that belongs to it is not farther beyond: tan(53/2 degrees).
const BESIDE: f64 = 0.5;

/// A line of two nodes or a triangle of three, and the cell of the file to which it belongs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Simplex {
    /// Nodes.
    pub nodes: Vec<usize>,
    /// Number of the cell.
    pub cell: usize,
}

/// Rule for values in a line or triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Linear between values of nodes.
    Linear,
    /// Value of the nearest corner.
    Corner,
    /// Value of the cell.
    Whole,
}

/// Lines or triangles with values.
#[derive(Debug)]
pub struct Cells {
    nodes: Vec<Vector3<f64>>,
    simplices: Vec<Simplex>,
    values: Vec<f64>,
    rule: Rule,
    /// Axis along which the middles of the lines or triangles are sorted.
    axis: usize,
    /// Middles along this axis, ascending, with the number of the line or triangle.
    middles: Vec<(f64, usize)>,
    /// Largest distance of a node from the middle along this axis.
    half: f64,
}

/// Position on a line or triangle that is nearest to another.
struct Foot {
    distance: f64,
    /// Shares of the nodes.
    shares: Vec<f64>,
    /// True if the position belongs to the line or triangle.
    inside: bool,
}

impl Cells {
    /// Lines or triangles with nodes in one to three coordinates; there is one or more.
    #[must_use]
    pub fn new(positions: &[Vec<f64>], simplices: Vec<Simplex>, values: Vec<f64>, rule: Rule) -> Self {
        let padded = |x: &Vec<f64>| Vector3::from_fn(|c, _| x.get(c).copied().unwrap_or(0.0));
        let nodes: Vec<Vector3<f64>> = positions.iter().map(padded).collect();
        let extent = |c: usize| {
            let used = simplices.iter().flat_map(|s| &s.nodes).map(|n| nodes[*n][c]);
            let (low, high) =
                used.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
            high - low
        };
        let axis = (0..3).max_by(|i, j| extent(*i).total_cmp(&extent(*j))).unwrap_or_default();
        let (mut middles, mut half) = (Vec::new(), 0.0_f64);
        for (k, simplex) in simplices.iter().enumerate() {
            let along = |n: &usize| nodes[*n][axis];
            let middle = simplex.nodes.iter().map(along).sum::<f64>() / simplex.nodes.len() as f64;
            half = simplex.nodes.iter().map(|n| (along(n) - middle).abs()).fold(half, f64::max);
            middles.push((middle, k));
        }
        middles.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { nodes, simplices, values, rule, axis, middles, half }
    }

    /// Number of values.
    #[must_use]
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// Interpolation as text.
    #[must_use]
    pub fn words(&self) -> &'static str {
        let lines = self.simplices.iter().all(|s| s.nodes.len() == 2);
        match (self.rule, lines) {
            (Rule::Linear, true) => "linear on the lines of the file",
            (Rule::Linear, false) => "linear on the triangles of the file",
            (Rule::Corner, _) => "the nearest corner of the cell",
            (Rule::Whole, _) => "that of the cell",
        }
    }

    /// Value at a position; `None` beyond all lines or triangles, NaN where the values that it needs are missing.
    #[must_use]
    pub fn at(&self, x: &[f64]) -> Option<f64> {
        let x = Vector3::from_fn(|c, _| x.get(c).copied().unwrap_or(0.0));
        let (k, foot) = self.nearest(&x)?;
        if !foot.inside {
            return None;
        }
        let simplex = &self.simplices[k];
        let each = foot.shares.iter().zip(&simplex.nodes);
        Some(match self.rule {
            Rule::Whole => self.values[simplex.cell],
            Rule::Corner => self.values[*each.max_by(|a, b| a.0.total_cmp(b.0))?.1],
            Rule::Linear => {
                each.filter(|(share, _)| **share > 0.0).map(|(share, n)| share * self.values[*n]).sum()
            }
        })
    }

    /// The nearest line or triangle, searched from the middle nearest along the sorted axis outwards.
    fn nearest(&self, x: &Vector3<f64>) -> Option<(usize, Foot)> {
        let from = self.middles.partition_point(|m| m.0 < x[self.axis]);
        let mut best: Option<(usize, Foot)> = None;
        let (mut below, mut above) = (from, from);
        loop {
            let reach = best.as_ref().map_or(f64::INFINITY, |(_, foot)| foot.distance) + self.half;
            let near = |k: usize| (self.middles[k].0 - x[self.axis]).abs() <= reach;
            let down = below > 0 && near(below - 1);
            let up = above < self.middles.len() && near(above);
            if !down && !up {
                return best;
            }
            let mut tried = Vec::new();
            if down {
                below -= 1;
                tried.push(self.middles[below].1);
            }
            if up {
                tried.push(self.middles[above].1);
                above += 1;
            }
            for k in tried {
                let foot = self.foot(k, x);
                if best.as_ref().is_none_or(|(_, old)| foot.distance < old.distance) {
                    best = Some((k, foot));
                }
            }
        }
    }

    fn foot(&self, k: usize, x: &Vector3<f64>) -> Foot {
        let corners: Vec<Vector3<f64>> = self.simplices[k].nodes.iter().map(|n| self.nodes[*n]).collect();
        let size = (1..corners.len()).map(|i| (corners[i] - corners[0]).norm()).fold(0.0, f64::max);
        let free = shares(&corners, x);
        let shares = if free.iter().all(|s| *s >= 0.0) { free.clone() } else { border(&corners, x) };
        let at = |shares: &[f64]| shares.iter().zip(&corners).map(|(s, c)| *s * c).sum::<Vector3<f64>>();
        let (on, in_plane) = (at(&shares), at(&free));
        let (distance, off) = ((x - on).norm(), (x - in_plane).norm());
        let beyond = (in_plane - on).norm();
        Foot { distance, shares, inside: off <= size && beyond <= ON_BORDER * size + BESIDE * off }
    }
}

/// Shares of the corners in the foot of a position on the line or the plane through them.
fn shares(corners: &[Vector3<f64>], x: &Vector3<f64>) -> Vec<f64> {
    let (a, rest) = (corners[0], &corners[1..]);
    let d = x - a;
    if let [b, c] = rest {
        let (u, v) = (b - a, c - a);
        let (uu, uv, vv) = (u.dot(&u), u.dot(&v), v.dot(&v));
        let area = uu * vv - uv * uv;
        let (du, dv) = (d.dot(&u), d.dot(&v));
        let (s, t) = ((vv * du - uv * dv) / area, (uu * dv - uv * du) / area);
        return vec![1.0 - s - t, s, t];
    }
    let u = rest.first().map_or_else(Vector3::zeros, |b| b - a);
    let s = d.dot(&u) / u.dot(&u);
    vec![1.0 - s, s]
}

/// Shares of the corners in the position on the border that is nearest to another.
fn border(corners: &[Vector3<f64>], x: &Vector3<f64>) -> Vec<f64> {
    let n = corners.len();
    let mut best: Option<(f64, Vec<f64>)> = None;
    for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
        let s = shares(&[corners[i], corners[j]], x)[1].clamp(0.0, 1.0);
        let distance = (x - ((1.0 - s) * corners[i] + s * corners[j])).norm();
        if best.as_ref().is_none_or(|(old, _)| distance < *old) {
            let mut shares = vec![0.0; n];
            (shares[i], shares[j]) = (1.0 - s, s);
            best = Some((distance, shares));
        }
    }
    best.map(|b| b.1).unwrap_or_default()
}
