//! The two surfaces of a mortar interface: facets with their weightings, averaged normals, and the search for facets that may
//! overlap.

use super::cell::ReferenceFacet;
use super::centre::Centres;
use super::facet::{Facet, facets, middle, node_at};
use super::mirror::Mirror;
use super::rule::{self, Rows, Rule, Rules};
use super::weighting::Weighting;
use crate::SegmentKind;
use crate::search::tree::{Aabb, Tree};
use crate::shape::{MOST_NODES, Shape, shape};
use crate::spec::{Segment, SlavePoint};
use crate::vector::{axpy, dot, norm, perpendicular, scaled, sub, unit};

/// Bound on the product of facet normals, which excludes facets whose normals enclose less than about 96 degrees. Along the
/// slave's normal the projection of such a master facet degenerates.
const FACING: f64 = 0.1;

/// Share of a facet by which the boxes of the search are enlarged, so that candidates change only when the motion reaches it.
const MARGIN: f64 = 0.25;

/// A slave facet.
#[derive(Clone, Debug)]
pub(super) struct SlaveFacet {
    pub facet: Facet,
    pub weighting: Weighting,
    /// Number of its face.
    pub face: usize,
}

/// A slave face, with the reference positions of its nodes.
#[derive(Clone, Debug)]
pub(super) struct SlaveFace<const D: usize> {
    pub kind: SegmentKind,
    pub nodes: Vec<usize>,
    /// Slave points of its nodes.
    pub points: Vec<Option<usize>>,
    reference: Vec<[f64; D]>,
}

impl<const D: usize> SlaveFace<D> {
    /// Outward unit normals at its nodes.
    pub(super) fn normals(&self, x: &[[f64; D]]) -> Vec<[f64; D]> {
        let at = |k: usize| unit(&perpendicular(&bases(self.kind, &self.nodes, x, node_at(self.kind, k))));
        (0..self.nodes.len()).map(at).collect()
    }
}

/// A facet on which the function of a slave point does not vanish, and the row of the point in its weighting.
#[derive(Clone, Copy, Debug)]
pub(super) struct AdjacentFacet {
    pub facet: usize,
    pub row: usize,
}

/// A face adjacent to a slave point.
#[derive(Clone, Copy, Debug)]
pub(super) struct AdjacentFace {
    pub face: usize,
    /// Local number of the point's node.
    pub local: usize,
    /// Shares of the normals at the nodes of the face in that of the point.
    of_normals: [f64; MOST_NODES],
}

impl AdjacentFace {
    /// Nodes whose normals have a share, with it.
    #[inline]
    pub(super) fn shares(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.of_normals.iter().copied().enumerate().filter(|(_, share)| *share != 0.0)
    }
}

/// Both surfaces of an interface as they are given.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a> {
    /// Slave points.
    pub slave: &'a [SlavePoint],
    /// Slave faces.
    pub faces: &'a [Segment],
    /// Master faces.
    pub master: &'a [Segment],
    /// True if the first coordinate is a radius.
    pub axisymmetric: bool,
    /// Planes of symmetry through each slave point; empty: none through any.
    pub mirrors: &'a [Mirror],
}

/// Both surfaces of an interface.
#[derive(Clone, Debug)]
pub(super) struct Sides<const D: usize> {
    pub facets: Vec<SlaveFacet>,
    pub master: Vec<Facet>,
    /// Faces that are divided into the slave facets.
    pub faces: Vec<SlaveFace<D>>,
    /// Facets adjacent to each slave point.
    pub beside: Vec<Vec<AdjacentFacet>>,
    /// Faces adjacent to each slave point.
    pub around: Vec<Vec<AdjacentFace>>,
    pub axisymmetric: bool,
    /// Planes of symmetry through each slave point.
    pub mirrors: Vec<Mirror>,
    pub centres: Centres,
    rules: Rules,
    boxes: Vec<Aabb<D>>,
    tree: Tree<D>,
}

impl<const D: usize> Sides<D> {
    /// Collects the facets at reference `positions` of the interface's nodes, to which the middles of faces of eight nodes are added.
    /// Facets without a slave point are left out.
    pub(super) fn new(
        Surfaces { slave, faces: slave_faces, master, axisymmetric, mirrors }: Surfaces<'_>,
        positions: &mut Vec<[f64; D]>,
    ) -> Self {
        let mut point_of = vec![None; positions.len()];
        for (p, s) in slave.iter().enumerate() {
            point_of[s.node] = Some(p);
        }
        let mut centres = Centres::new(positions.len());
        let mut divided = |face: &Segment, positions: &mut Vec<[f64; D]>| {
            let middle = centres.add(face, positions);
            facets(face, middle, positions)
        };
        let master: Vec<Facet> = master.iter().flat_map(|m| divided(m, positions)).collect();
        let boxes: Vec<_> = master.iter().map(|m| box_of(&m.nodes, positions)).collect();
        let tree = Tree::build(&boxes);
        let mut sides = Self {
            facets: Vec::new(),
            master,
            faces: Vec::new(),
            beside: vec![Vec::new(); slave.len()],
            around: vec![Vec::new(); slave.len()],
            axisymmetric,
            mirrors: (0..slave.len()).map(|p| mirrors.get(p).copied().unwrap_or_default()).collect(),
            centres,
            rules: Rules::new(),
            boxes,
            tree,
        };
        for face in slave_faces {
            if face.nodes.iter().any(|&n| point_of[n].is_some()) {
                sides.add_face(face, positions, &point_of);
            }
        }
        sides
    }

    /// Adds a slave face with its facets.
    fn add_face(&mut self, face: &Segment, positions: &mut Vec<[f64; D]>, point_of: &[Option<usize>]) {
        let number = self.faces.len();
        for (local, &n) in face.nodes.iter().enumerate() {
            if let Some(p) = point_of[n] {
                let mut of_normals = [0.0; MOST_NODES];
                of_normals[local] = f64::from(u8::from(face.kind.first_order()));
                self.around[p].push(AdjacentFace { face: number, local, of_normals });
            }
        }
        let middle = self.centres.add(face, positions);
        for facet in facets(face, middle, positions) {
            let weighting = Weighting::new(face, facet.corners, |n| point_of[n]);
            if !weighting.points.is_empty() {
                for (row, &p) in weighting.points.iter().enumerate() {
                    self.beside[p].push(AdjacentFacet { facet: self.facets.len(), row });
                }
                self.facets.push(SlaveFacet { facet, weighting, face: number });
            }
        }
        let reference = face.nodes.iter().map(|&n| positions[n]).collect();
        let points = face.nodes.iter().map(|&n| point_of[n]).collect();
        self.faces.push(SlaveFace { kind: face.kind, nodes: face.nodes.clone(), points, reference });
        if !face.kind.first_order() {
            self.add_normals(number);
        }
    }

    /// Adds the shares of the normals at the nodes of the last face, with this number.
    fn add_normals(&mut self, number: usize) {
        let reference = &self.faces[number].reference;
        let radius = |of_face: &[f64; MOST_NODES]| {
            let r = || reference.iter().zip(of_face).map(|(x, f)| x[0] * f).sum();
            if self.axisymmetric { r() } else { 1.0 }
        };
        let of_face = self.facets.partition_point(|slave| slave.face < number);
        for slave in &self.facets[of_face..] {
            let rule = self.rules.rule(rule::points(&slave.facet, Rows::Corners, &slave.facet));
            let rows = slave.weighting.products(&slave.facet, rule, radius);
            for (&p, row) in slave.weighting.points.iter().zip(rows) {
                let beside = self.around[p].iter_mut().filter(|b| b.face == number);
                beside.for_each(|b| axpy(&mut b.of_normals, 1.0, &row));
            }
        }
    }

    /// Constant data of slave facet `f`.
    #[inline]
    pub(super) fn frozen(&self, f: usize) -> ReferenceFacet<'_, D> {
        let SlaveFacet { facet, face, .. } = &self.facets[f];
        ReferenceFacet { facet, reference: &self.faces[*face].reference, axisymmetric: self.axisymmetric }
    }

    /// Quadrature rule for slave facet `f` with master facet `m`, chosen in the reference configuration.
    #[inline]
    pub(super) fn rule(&self, f: usize, m: usize) -> &Rule {
        self.rules.rule(rule::points(&self.facets[f].facet, Rows::Corners, &self.master[m]))
    }

    /// Quadrature rule for the functions of the face of slave facet `f`.
    pub(super) fn rule_of_face(&self, f: usize, m: usize) -> &Rule {
        self.rules.rule(rule::points(&self.facets[f].facet, Rows::Face, &self.master[m]))
    }

    /// Base vectors of face `b.face` at the node of a slave point.
    #[inline]
    pub(super) fn bases(&self, b: &AdjacentFace, x: &[[f64; D]]) -> [[f64; D]; 2] {
        let face = &self.faces[b.face];
        bases(face.kind, &face.nodes, x, node_at(face.kind, b.local))
    }

    /// Approximate area of each point's function over the whole slave surface, in the reference configuration.
    pub(super) fn whole_areas(&self, points: usize) -> Vec<f64> {
        let mut out = vec![0.0; points];
        for f in 0..self.facets.len() {
            let frozen = self.frozen(f);
            let (low, high) =
                frozen.reference.iter().fold(([f64::INFINITY; D], [f64::NEG_INFINITY; D]), |(l, h), x| {
                    (std::array::from_fn(|i| l[i].min(x[i])), std::array::from_fn(|i| h[i].max(x[i])))
                });
            let size = norm(&sub(&high, &low));
            let mut area = if D == 2 { size } else { size * size };
            if self.axisymmetric {
                area *= std::f64::consts::TAU * high[0];
            }
            self.facets[f].weighting.points.iter().for_each(|&p| out[p] += area);
        }
        out
    }

    /// Moves the search boxes to positions `x`.
    pub(super) fn refit(&mut self, x: &[[f64; D]]) {
        for (b, m) in self.boxes.iter_mut().zip(&self.master) {
            *b = box_of(&m.nodes, x);
        }
        self.tree.refit(&self.boxes);
    }

    /// Distance of a position from the nearest node of the master; none if it has no facets.
    fn distance(&self, from: &[f64; D], x: &[[f64; D]]) -> Option<f64> {
        let (_, squared) = self.tree.nearest(from, |m| {
            let squares = self.master[m].nodes.iter().map(|&k| {
                let d = sub(&x[k], from);
                dot(&d, &d)
            });
            Some(squares.fold(f64::INFINITY, f64::min))
        })?;
        Some(squared.sqrt())
    }

    /// Finds the master facets that may overlap slave facet `f` at `x`, ascending. They face it, and their distance along its
    /// normal is at most that of the master node nearest to its middle plus its own size. Of several layers of a master the
    /// nearest thus counts.
    ///
    /// Returns the distance δ that all nodes may move before another facet may overlap. The box of the slave facet, extended by
    /// the reach R along its normal n, and the boxes of the masters grow by δ each. R is a distance between nodes (2 δ) plus a
    /// diagonal (2 √D δ), and `|Δ(R n)| <= ΔR + R |Δn|`. The boxes were tested with a margin. A master begins to face the slave
    /// once the product of the normals has changed by the amount by which it misses the bound; it changes by `|Δn|` of either
    /// facet.
    pub(super) fn candidates(&self, f: usize, x: &[[f64; D]], out: &mut Vec<usize>, count: &mut u64) -> f64 {
        out.clear();
        let facet = &self.facets[f].facet;
        let n = facet_normal(facet.kind, &facet.nodes, x);
        let mut middle = [0.0; D];
        #[expect(clippy::cast_precision_loss, reason = "at most four nodes")]
        let share = 1.0 / facet.nodes.len() as f64;
        facet.nodes.iter().for_each(|&k| axpy(&mut middle, share, &x[k]));
        let mut own = box_of(&facet.nodes, x);
        let size = norm(&sub(&own.max, &own.min));
        let Some(distance) = self.distance(&middle, x) else { return f64::INFINITY };
        let length = distance + size;
        let reach = scaled(&n, length);
        let mut grown = own;
        for &k in &facet.nodes {
            grown.include(&std::array::from_fn(|i| x[k][i] + reach[i]));
            grown.include(&std::array::from_fn(|i| x[k][i] - reach[i]));
        }
        own = grown.inflated(MARGIN * size);
        let turn = turning(facet.kind, &facet.nodes, x);
        #[expect(clippy::cast_precision_loss, reason = "two or three")]
        let diagonal = (D as f64).sqrt();
        let mut free = MARGIN * size / (4.0 + 2.0 * diagonal + length * turn);
        self.tree.overlapping(&own, &self.boxes, |m| {
            *count += 1;
            let s = &self.master[m];
            let product = dot(&facet_normal(s.kind, &s.nodes, x), &n);
            free = free.min((product + FACING).abs() / (turn + turning(s.kind, &s.nodes, x)));
            if product < -FACING {
                out.push(m);
            }
        });
        out.sort_unstable();
        free
    }
}

fn box_of<const D: usize>(nodes: &[usize], x: &[[f64; D]]) -> Aabb<D> {
    let mut b = Aabb::empty();
    nodes.iter().for_each(|&n| b.include(&x[n]));
    b
}

/// Outward unit normal at the middle of a facet.
fn facet_normal<const D: usize>(kind: SegmentKind, nodes: &[usize], x: &[[f64; D]]) -> [f64; D] {
    let n = perpendicular(&bases(kind, nodes, x, middle(kind)));
    scaled(&n, norm(&n).recip())
}

/// Upper bound of `|Δn|/δ` for the normal at the middle of a first-order facet whose nodes move by δ, for δ below the length of
/// its base vectors e. They change by at most 2 δ (differences of two positions or of two means). Their product changes by at
/// most `2 δ (|e_1| + |e_2|) + 4 δ² <= 4 δ (|e_1| + |e_2|)`, and a unit vector by twice the change over the length.
fn turning<const D: usize>(kind: SegmentKind, nodes: &[usize], x: &[[f64; D]]) -> f64 {
    let e = bases(kind, nodes, x, middle(kind));
    if D == 2 {
        return 4.0 / norm(&e[0]);
    }
    8.0 * (norm(&e[0]) + norm(&e[1])) / norm(&perpendicular(&e))
}

/// Base vectors at natural coordinates `xi`.
#[inline]
fn bases<const D: usize>(kind: SegmentKind, nodes: &[usize], x: &[[f64; D]], xi: [f64; 2]) -> [[f64; D]; 2] {
    bases_of(&shape(kind, xi), nodes, x)
}

/// Base vectors of a face whose functions have these slopes.
#[inline]
pub(super) fn bases_of<const D: usize>(s: &Shape, nodes: &[usize], x: &[[f64; D]]) -> [[f64; D]; 2] {
    let mut e = [[0.0; D]; 2];
    for (k, &n) in nodes.iter().enumerate().take(MOST_NODES) {
        axpy(&mut e[0], s.first[0][k], &x[n]);
        axpy(&mut e[1], s.first[1][k], &x[n]);
    }
    e
}
