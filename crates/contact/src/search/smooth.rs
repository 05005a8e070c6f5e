//! Smoothed master surfaces: one cubic Bézier patch per segment, with control points that are linear in nodal positions.
//!
//! Each node has a tangent line (in two dimensions) or a tangent plane estimated from the surrounding nodes. Every edge leaves
//! the node along it: `b = x_i + t/3` with t the tangent vector of the edge. Patches that meet in a node therefore share its
//! tangent plane, whatever the deformation, and in two dimensions the surface has a continuous normal. Across the edges of
//! faces the normals agree at both ends and differ in between by the square of the angle between the facets.
//!
//! The vectors t are estimated with fixed weights g from the reference configuration, `t = Σ_j g_j (x_j - x_i)`, exact for
//! affine maps. The position x(ξ) = Σ_γ N_γ(ξ) x_γ stays linear in the positions of the nodes around the segment. Reactions
//! N_γ f thus balance in force and moment, and every derivative has the form it has on an ordinary segment. Nagata's quadratic
//! edges, in contrast, are not linear in the positions. They do not exist for an edge between parallel normals that is not
//! perpendicular to them, as at every inflection point.
//!
//! Interior control points: on triangles `b_111 = E + (E - V)/2`, with E the mean of the six edge points and V that of the
//! corners, which reproduces parabolas (Vlachos et al. 2001). On quadrilaterals they form the bilinearly blended Coons patch of
//! the edges.

use super::patch::Form;
use crate::error::ContactError;
use crate::shape::corners;
use crate::spec::{Segment, Smoothing};
use crate::vector::{add, axpy, cross, dot, norm, perpendicular, scaled, sub, unit};
use nalgebra::DMatrix;
use std::collections::BTreeMap;

/// Most nodes on which a smoothed segment may depend: 16 in a regular mesh of quadrilaterals, 12 of triangles, more at nodes at
/// which many segments meet.
pub(crate) const MOST_SUPPORT: usize = 40;

/// Smallest ratio of singular values at which a second-order fit is used. Below it the surrounding nodes do not determine the
/// fit (those of a rim node lie on one line too few), and a first-order fit is used.
const DETERMINED: f64 = 1e-2;

/// Weights below this value are rounding of the fit and are left out of the pattern.
const NEGLIGIBLE: f64 = 1e-12;

/// Control points of all segments, as weights of nodes.
#[derive(Clone, Debug)]
pub(crate) struct SmoothSurface {
    forms: Vec<Form>,
    /// Nodes on which each segment depends, its own first.
    support: Vec<usize>,
    /// Start of each segment in `support`.
    starts: Vec<usize>,
    /// Weights: for each segment, one row over its support for each control point.
    weights: Vec<f64>,
    /// Start of each segment in `weights`.
    rows: Vec<usize>,
    /// Start of each segment among the control points.
    points: Vec<usize>,
}

/// Tangent plane of a node. For each surrounding node it has the weight of `x_j - x_i` in the two tangent vectors.
#[derive(Clone, Debug)]
struct Plane<const D: usize> {
    basis: [[f64; D]; 2],
    weights: Vec<(usize, [f64; 2])>,
}

/// A vector as a weighted sum of nodal positions.
type Sum = Vec<(usize, f64)>;

/// Vectors b - x_i at each corner of a segment, towards the next corner and, on faces, the previous one.
type Handles = Vec<Vec<Sum>>;

impl SmoothSurface {
    /// Control points of `segments`, all first-order, on nodes at the reference positions.
    pub(crate) fn new<const D: usize>(
        name: &str,
        segments: &[Segment],
        positions: &[[f64; D]],
        smoothing: Smoothing,
    ) -> Result<Self, ContactError> {
        let mut smooth = Self {
            forms: segments.iter().map(|s| Form::Cubic(s.kind)).collect(),
            support: Vec::new(),
            starts: vec![0],
            weights: Vec::new(),
            rows: vec![0],
            points: vec![0],
        };
        let handles = if D == 2 {
            line_handles(segments, positions, smoothing)
        } else {
            face_handles(segments, positions, smoothing)
        };
        for (k, (segment, handles)) in segments.iter().zip(&handles).enumerate() {
            smooth.push(name, k, segment, handles)?;
        }
        Ok(smooth)
    }

    /// Adds a segment with its handles.
    fn push(
        &mut self,
        name: &str,
        k: usize,
        segment: &Segment,
        handles: &Handles,
    ) -> Result<(), ContactError> {
        let mut support = segment.nodes.clone();
        for (node, _) in handles.iter().flatten().flatten() {
            if !support.contains(node) {
                support.push(*node);
            }
        }
        let n = support.len();
        if n > MOST_SUPPORT {
            let name = name.to_owned();
            return Err(ContactError::SmoothingTooWide { name, segment: k, nodes: n, most: MOST_SUPPORT });
        }
        let form = self.forms[k];
        let mut rows = vec![vec![0.0; n]; form.points()];
        let c = corners(segment.kind);
        let (at, of) = places(c);
        for i in 0..c {
            rows[at[i]][i] = 1.0;
            for (handle, &at) in handles[i].iter().zip(&of[i]) {
                let row = &mut rows[at];
                row[i] = 1.0;
                for (node, w) in handle {
                    let place = support.iter().position(|s| s == node).unwrap_or(i);
                    row[place] += w;
                }
            }
        }
        match c {
            3 => interior_of_triangle(&mut rows),
            4 => interior_of_quadrilateral(&mut rows),
            _ => {}
        }
        self.support.extend(support);
        self.starts.push(self.support.len());
        self.weights.extend(rows.into_iter().flatten());
        self.rows.push(self.weights.len());
        self.points.push(self.points[k] + form.points());
        Ok(())
    }

    /// Number of control points of all segments.
    pub(crate) fn count(&self) -> usize {
        *self.points.last().unwrap_or(&0)
    }

    pub(crate) fn form(&self, segment: usize) -> Form {
        self.forms[segment]
    }

    /// Nodes on which a segment depends, its own first.
    #[inline]
    pub(crate) fn support(&self, segment: usize) -> &[usize] {
        &self.support[self.starts[segment]..self.starts[segment + 1]]
    }

    /// Weights of a segment's control points, by row.
    #[inline]
    pub(crate) fn weights(&self, segment: usize) -> &[f64] {
        &self.weights[self.rows[segment]..self.rows[segment + 1]]
    }

    /// Range of a segment's control points among all.
    #[inline]
    pub(crate) fn range(&self, segment: usize) -> std::ops::Range<usize> {
        self.points[segment]..self.points[segment + 1]
    }

    /// Control points of one segment at nodal positions.
    pub(crate) fn place<const D: usize>(&self, segment: usize, positions: &[[f64; D]], out: &mut [[f64; D]]) {
        let support = self.support(segment);
        for (o, row) in out.iter_mut().zip(self.weights(segment).chunks_exact(support.len())) {
            let mut x = [0.0; D];
            for (&node, &w) in support.iter().zip(row) {
                axpy(&mut x, w, &positions[node]);
            }
            *o = x;
        }
    }
}

/// Indices of the control points at the corners of a segment with `c` corners, and of the handles towards the next and previous
/// corner.
fn places(c: usize) -> (&'static [usize], &'static [[usize; 2]]) {
    match c {
        2 => (&[0, 3], &[[1, 1], [2, 2]]),
        3 => (&[0, 3, 9], &[[1, 4], [6, 2], [7, 8]]),
        _ => (&[0, 3, 15, 12], &[[1, 4], [7, 2], [14, 11], [8, 13]]),
    }
}

fn combine(rows: &mut [Vec<f64>], to: usize, terms: &[(usize, f64)]) {
    for k in 0..rows[to].len() {
        rows[to][k] = terms.iter().map(|&(r, w)| w * rows[r][k]).sum();
    }
}

fn interior_of_triangle(rows: &mut [Vec<f64>]) {
    let edge = 1.5 / 6.0;
    let corner = -0.5 / 3.0;
    let mut terms = [(0, corner); 9];
    for (t, r) in terms.iter_mut().zip([0, 3, 9, 1, 2, 4, 6, 7, 8]) {
        *t = (r, if matches!(r, 0 | 3 | 9) { corner } else { edge });
    }
    combine(rows, 5, &terms);
}

fn interior_of_quadrilateral(rows: &mut [Vec<f64>]) {
    for j in 1..3 {
        for i in 1..3 {
            let (u, v) = (i as f64 / 3.0, j as f64 / 3.0);
            combine(
                rows,
                4 * j + i,
                &[
                    (i, 1.0 - v),
                    (12 + i, v),
                    (4 * j, 1.0 - u),
                    (4 * j + 3, u),
                    (0, -(1.0 - u) * (1.0 - v)),
                    (3, -u * (1.0 - v)),
                    (12, -(1.0 - u) * v),
                    (15, -u * v),
                ],
            );
        }
    }
}

fn line_handles<const D: usize>(
    segments: &[Segment],
    positions: &[[f64; D]],
    smoothing: Smoothing,
) -> Vec<Handles> {
    // Segments that end and begin at each node.
    let mut ends: Vec<[Vec<usize>; 2]> = vec![[Vec::new(), Vec::new()]; positions.len()];
    for (k, s) in segments.iter().enumerate() {
        ends[s.nodes[1]][0].push(k);
        ends[s.nodes[0]][1].push(k);
    }
    let along = |k: usize| unit(&sub(&positions[segments[k].nodes[1]], &positions[segments[k].nodes[0]]));
    // Neighbours of a smooth node, before and after it.
    let around = |node: usize| match (&ends[node][0][..], &ends[node][1][..]) {
        ([a], [b]) if a != b && dot(&along(*a), &along(*b)) >= smoothing.crease.cos() => {
            Some([segments[*a].nodes[0], segments[*b].nodes[1]])
        }
        _ => None,
    };
    let length = |a: usize, b: usize| norm(&sub(&positions[a], &positions[b]));
    segments
        .iter()
        .map(|s| {
            let h = length(s.nodes[0], s.nodes[1]);
            (0..2)
                .map(|end| {
                    let (i, j) = (s.nodes[end], s.nodes[1 - end]);
                    // Tangent towards j, times h: that of the parabola through the node and its neighbours over the length of
                    // their chords, or a one-sided one if the surface ends or has a corner.
                    let tangent = match (around(i), around(j)) {
                        (Some([p, q]), _) => {
                            let back = if q == j { p } else { q };
                            let b = length(back, i);
                            vec![(i, (h - b) / b), (j, b / (h + b)), (back, -h * h / (b * (h + b)))]
                        }
                        (None, Some([p, q])) => {
                            let far = if q == i { p } else { q };
                            let b = length(far, j);
                            vec![
                                (i, -(2.0 * h + b) / (h + b)),
                                (j, (h + b) / b),
                                (far, -h * h / (b * (h + b))),
                            ]
                        }
                        (None, None) => vec![(i, -1.0), (j, 1.0)],
                    };
                    vec![tangent.into_iter().map(|(n, w)| (n, w / 3.0)).collect()]
                })
                .collect()
        })
        .collect()
}

fn face_handles<const D: usize>(
    segments: &[Segment],
    positions: &[[f64; D]],
    smoothing: Smoothing,
) -> Vec<Handles> {
    let planes = planes(segments, positions, smoothing);
    let handle = |i: usize, j: usize| -> Sum {
        let Some(plane) = &planes[i] else { return vec![(i, -1.0 / 3.0), (j, 1.0 / 3.0)] };
        let chord = sub(&positions[j], &positions[i]);
        let c = [dot(&chord, &plane.basis[0]) / 3.0, dot(&chord, &plane.basis[1]) / 3.0];
        let mut sum: Sum = Vec::with_capacity(plane.weights.len() + 1);
        let mut own = 0.0;
        for (node, g) in &plane.weights {
            let w = c[0] * g[0] + c[1] * g[1];
            if w.abs() > NEGLIGIBLE {
                sum.push((*node, w));
                own -= w;
            }
        }
        sum.push((i, own));
        sum
    };
    segments
        .iter()
        .map(|s| {
            let c = corners(s.kind);
            (0..c)
                .map(|i| {
                    let (next, previous) = (s.nodes[(i + 1) % c], s.nodes[(i + c - 1) % c]);
                    vec![handle(s.nodes[i], next), handle(s.nodes[i], previous)]
                })
                .collect()
        })
        .collect()
}

/// Normal of a flat or bilinear segment at its middle, with the length of its area (twice the area for a triangle).
fn area_normal<const D: usize>(s: &Segment, positions: &[[f64; D]]) -> [f64; D] {
    let x = |k: usize| positions[s.nodes[k]];
    if corners(s.kind) == 3 {
        perpendicular(&[sub(&x(1), &x(0)), sub(&x(2), &x(0))])
    } else {
        perpendicular(&[sub(&x(2), &x(0)), sub(&x(3), &x(1))])
    }
}

/// Tangent planes of all nodes; `None` for nodes on a crease.
fn planes<const D: usize>(
    segments: &[Segment],
    positions: &[[f64; D]],
    smoothing: Smoothing,
) -> Vec<Option<Plane<D>>> {
    let normals: Vec<[f64; D]> = segments.iter().map(|s| unit(&area_normal(s, positions))).collect();
    let mut edges: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); positions.len()];
    for (k, s) in segments.iter().enumerate() {
        let c = corners(s.kind);
        for i in 0..c {
            let (a, b) = (s.nodes[i], s.nodes[(i + 1) % c]);
            edges.entry((a.min(b), a.max(b))).or_default().push(k);
            around[a].push(k);
        }
    }
    let mut sharp = vec![false; positions.len()];
    for (&(a, b), faces) in &edges {
        let crease = match faces[..] {
            [_] => false,
            [f, g] => dot(&normals[f], &normals[g]) < smoothing.crease.cos(),
            _ => true,
        };
        sharp[a] |= crease;
        sharp[b] |= crease;
    }
    (0..positions.len())
        .map(|i| {
            (!sharp[i] && !around[i].is_empty())
                .then(|| plane(i, &around[i], segments, &normals, positions))?
        })
        .collect()
}

/// Row of the fit of a quadratic function without constant at a distance `d`, times its weight 1/|d|, and that weight.
fn quadratic_row<const D: usize>(d: &[f64; D], basis: &[[f64; D]; 2]) -> ([f64; 5], f64) {
    let (a, b, w) = (dot(d, &basis[0]), dot(d, &basis[1]), norm(d).recip());
    ([w * a, w * b, 0.5 * w * a * a, w * a * b, 0.5 * w * b * b], w)
}

/// Tangent plane of node `i` from the nodes of the surrounding segments, by least squares with weights 1/distance.
fn plane<const D: usize>(
    i: usize,
    around: &[usize],
    segments: &[Segment],
    normals: &[[f64; D]],
    positions: &[[f64; D]],
) -> Option<Plane<D>> {
    let mut n = [0.0; D];
    let mut nodes: Vec<usize> = Vec::new();
    for &k in around {
        n = add(&n, &normals[k]);
        nodes.extend(segments[k].nodes.iter().filter(|&&m| m != i));
    }
    nodes.sort_unstable();
    nodes.dedup();
    let n = unit(&n);
    let first = sub(&positions[*nodes.first()?], &positions[i]);
    let mut e = first;
    axpy(&mut e, -dot(&first, &n), &n);
    let basis = [unit(&e), cross(&n, &unit(&e))];
    let size =
        nodes.iter().map(|&j| norm(&sub(&positions[j], &positions[i]))).sum::<f64>() / nodes.len() as f64;
    let row = |j: usize| quadratic_row(&scaled(&sub(&positions[j], &positions[i]), size.recip()), &basis);
    for columns in [5, 2] {
        if nodes.len() < columns {
            continue;
        }
        let matrix = DMatrix::from_fn(nodes.len(), columns, |r, c| row(nodes[r]).0[c]);
        let svd = matrix.svd(true, true);
        let (largest, smallest) = (svd.singular_values.max(), svd.singular_values.min());
        if smallest.is_nan() || smallest <= DETERMINED * largest {
            continue;
        }
        let inverse = svd.pseudo_inverse(0.0).ok()?;
        let weights = nodes
            .iter()
            .enumerate()
            .map(|(r, &j)| {
                let w = row(j).1 / size;
                (j, [inverse[(0, r)] * w, inverse[(1, r)] * w])
            })
            .collect();
        return Some(Plane { basis, weights });
    }
    None
}
