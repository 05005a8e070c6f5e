//! Pairing fixed in the reference configuration: every slave point always acts on the same nodes with the same weights and the
//! same normal.
//!
//! Let s_k be the weights of the nodes, positive on the slave side and negative on the master side, and `w = Σ_k s_k u_k` the
//! relative displacement. The gap is `g_n = g_0 + n·w`, and the tangential increment is the tangential part of
//! `w - w_committed`. Normal, frame and weights are constant. The residual of node k is thus `-A s_k (f_n n - t)`, and the
//! tangent block is `A s_k s_j M` with one matrix M per point:
//!
//! `M = E_n n⊗n + T [ratio E_t (I - η⊗η) + d_trial E_t η⊗η] Tᵀ - E_n d_normal (Tη)⊗n`,
//!
//! with the two tangents as columns of T. The last term makes M unsymmetric in slip.

use crate::measure::measure_state::MeasureState;
use crate::measure::{Attachment, Exit, Geometry, Measure, NormalPoint, ShearPoint, Slides, Tractions};
use crate::spec::SurfaceNode;
use crate::vector::{axpy, dot, scaled, sub, unit};
use asperity_fem::relative::RelativeDisplacements;
use asperity_fem::term::Pattern;
use asperity_fem::vector::tangent;

/// Constants of a paired point.
#[derive(Clone, Debug)]
struct Pair<const D: usize> {
    /// Slave point.
    point: usize,
    /// Start of its nodes in the flat arrays.
    from: usize,
    /// Start of the master nodes among them.
    split: usize,
    /// End of its nodes in the flat arrays.
    to: usize,
    normal: [f64; D],
    frame: [[f64; D]; 2],
    gap: f64,
    /// Change n·w of the gap at the configuration last measured \[m\].
    parted: f64,
    area: f64,
    /// Tangential components of the committed relative displacement \[m\].
    committed: [f64; 2],
    /// Tangential components of the relative displacement at the configuration last measured \[m\].
    present: [f64; 2],
}

/// Measure with fixed pairing.
#[derive(Clone, Debug)]
pub struct FixedMeasure<const D: usize> {
    pairs: Vec<Pair<D>>,
    /// Interface nodes of all pairs. Each pair lists its slave nodes first.
    nodes: Vec<usize>,
    /// The nodes' first degrees of freedom and weights s_k.
    relative: RelativeDisplacements,
    areas: Vec<f64>,
    /// Shares of the tractions of points in the mean around each point.
    averages: Vec<Vec<(usize, f64)>>,
    pattern: Pattern,
    collocated: bool,
}

impl<const D: usize> FixedMeasure<D> {
    /// A measure without pairs yet, for slave points with these areas; `collocated` as in [`Measure::collocated`].
    pub(super) fn new(areas: Vec<f64>, collocated: bool) -> Self {
        Self {
            pairs: Vec::new(),
            nodes: Vec::new(),
            relative: RelativeDisplacements {
                components: D,
                starts: vec![0],
                ..RelativeDisplacements::default()
            },
            averages: vec![Vec::new(); areas.len()],
            areas,
            pattern: Pattern::default(),
            collocated,
        }
    }

    /// Sets the shares of the tractions of points in the mean around a point, as in [`Measure::averages`].
    pub(super) fn average(&mut self, point: usize, shares: Vec<(usize, f64)>) {
        self.averages[point] = shares;
    }

    /// Pairs slave point `point` (ascending from call to call) through these nodes, those of the slave before those of the master.
    /// `apart` is `Σ_k s_k X_k`.
    pub(super) fn pair(
        &mut self,
        point: usize,
        through: &[Attachment],
        (normal, frame): ([f64; D], [[f64; D]; 2]),
        apart: &[f64; D],
    ) {
        let from = self.nodes.len();
        let split = from + through.iter().filter(|a| a.slave).count();
        self.nodes.extend(through.iter().map(|a| a.node));
        self.relative.weights.extend(through.iter().map(|a| a.weight));
        self.relative.starts.push(self.nodes.len());
        self.pairs.push(Pair {
            point,
            from,
            split,
            to: self.nodes.len(),
            normal,
            frame,
            gap: dot(&normal, apart),
            parted: 0.0,
            area: self.areas[point],
            committed: [0.0; 2],
            present: [0.0; 2],
        });
    }

    /// Builds the pattern once all points are paired.
    pub(super) fn finish(&mut self, nodes: &[SurfaceNode<D>]) {
        self.relative.dofs = self.nodes.iter().map(|&n| nodes[n].dof).collect();
        let blocks: Vec<Vec<usize>> = self
            .pairs
            .iter()
            .map(|p| self.relative.dofs[p.from..p.to].iter().flat_map(|&d| d..d + D).collect())
            .collect();
        self.pattern = Pattern::from_blocks(blocks.iter().map(Vec::as_slice));
    }

    /// Number of paired points.
    #[must_use]
    pub fn paired(&self) -> usize {
        self.pairs.len()
    }
}

/// Frame of a fixed normal. In two dimensions it is `(-n_y, n_x)`. In three, e_1 is the x axis (the y axis if n is within about
/// 25 degrees of x) projected onto the plane, and e_2 is `n × e_1`, so that neighbouring points have the same signs.
pub(super) fn fixed_frame<const D: usize>(n: &[f64; D]) -> [[f64; D]; 2] {
    if D == 2 {
        return [tangent(n), [0.0; D]];
    }
    let mut e1 = [0.0; D];
    let axis = usize::from(n[0].abs() > 0.9);
    e1[axis] = 1.0;
    axpy(&mut e1, -n[axis], n);
    let e1 = unit(&e1);
    [e1, crate::vector::cross(n, &e1)]
}

/// Matrix M of a closed point.
#[inline]
fn point_matrix<const D: usize>(
    normal: &[f64; D],
    frame: &[[f64; D]; 2],
    contact: &NormalPoint,
    shear: Option<&ShearPoint>,
    stiffness: f64,
) -> [[f64; D]; D] {
    let mut m = [[0.0; D]; D];
    let scaled_normal = scaled(normal, contact.stiffness);
    for i in 0..D {
        axpy(&mut m[i], normal[i], &scaled_normal);
    }
    let Some(shear) = shear else { return m };
    let eta = &shear.direction;
    let (across, along) = (stiffness * shear.ratio, stiffness * (shear.d_trial - shear.ratio));
    let direction: [f64; D] = std::array::from_fn(|i| eta[0] * frame[0][i] + eta[1] * frame[1][i]);
    for i in 0..D {
        axpy(&mut m[i], across * frame[0][i], &frame[0]);
        axpy(&mut m[i], across * frame[1][i], &frame[1]);
        axpy(&mut m[i], along * direction[i], &direction);
        axpy(&mut m[i], -shear.d_normal * direction[i], &scaled_normal);
    }
    m
}

impl<const D: usize> Measure<D> for FixedMeasure<D> {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn relative(&self) -> Option<&RelativeDisplacements> {
        Some(&self.relative)
    }

    fn block_points(&self, out: &mut Vec<usize>) {
        out.extend(self.pairs.iter().map(|pair| pair.point));
    }

    fn search(&mut self, _u: &[[f64; D]], _projections: &mut u64) -> bool {
        false
    }

    fn measure(&mut self, u: &[[f64; D]], out: &mut Geometry<D>) {
        for pair in &mut self.pairs {
            let mut w = [0.0; D];
            for k in pair.from..pair.to {
                axpy(&mut w, self.relative.weights[k], &u[self.nodes[k]]);
            }
            pair.present = [dot(&pair.frame[0], &w), dot(&pair.frame[1], &w)];
            let p = pair.point;
            out.paired[p] = true;
            pair.parted = dot(&pair.normal, &w);
            out.gap[p] = pair.gap + pair.parted;
            out.normal[p] = pair.normal;
            out.frame[p] = pair.frame;
            out.increment[p] = sub(&pair.present, &pair.committed);
        }
    }

    fn partings(&self, geometry: &Geometry<D>, out: &mut Vec<f64>) {
        out.clear();
        out.resize(geometry.gap.len(), f64::INFINITY);
        self.pairs.iter().for_each(|pair| out[pair.point] = pair.parted);
    }

    fn spread(&self, force: &[[f64; D]], residual: &mut [f64]) {
        for pair in &self.pairs {
            let f = &force[pair.point];
            for k in pair.from..pair.to {
                let c = -pair.area * self.relative.weights[k];
                for (r, fi) in residual[self.relative.dofs[k]..self.relative.dofs[k] + D].iter_mut().zip(f) {
                    *r += c * fi;
                }
            }
        }
    }

    fn tangent(&self, _geometry: &Geometry<D>, tractions: Tractions<'_>, values: &mut [f64]) {
        let mut at = 0;
        for pair in &self.pairs {
            let n = pair.to - pair.from;
            let block = &mut values[at..at + n * n * D * D];
            at += block.len();
            let contact = &tractions.normal[pair.point];
            if !contact.closed {
                block.fill(0.0);
                continue;
            }
            let shear = tractions.shear.map(|s| &s[pair.point]);
            let m = point_matrix(&pair.normal, &pair.frame, contact, shear, tractions.stiffness);
            let signs = &self.relative.weights[pair.from..pair.to];
            let mut rows = block.chunks_exact_mut(n * D);
            for sk in signs {
                for mi in &m {
                    let Some(row) = rows.next() else { return };
                    for (cell, sj) in row.chunks_exact_mut(D).zip(signs) {
                        let c = pair.area * sk * sj;
                        for (v, x) in cell.iter_mut().zip(mi) {
                            *v = c * x;
                        }
                    }
                }
            }
        }
    }

    fn slides(&self, _geometry: &Geometry<D>, du: &[[f64; D]], out: &mut Slides) {
        for pair in &self.pairs {
            let mut w = [0.0; D];
            for k in pair.from..pair.to {
                axpy(&mut w, self.relative.weights[k], &du[self.nodes[k]]);
            }
            out.gap[pair.point] = dot(&pair.normal, &w);
            out.increment[pair.point] = [dot(&pair.frame[0], &w), dot(&pair.frame[1], &w)];
        }
    }

    fn exit(&self, _du: &[[f64; D]]) -> Option<Exit> {
        None
    }

    fn commit(&mut self, _geometry: &Geometry<D>, _reframe: &mut dyn FnMut(usize, &[[f64; D]; 2])) {
        for pair in &mut self.pairs {
            pair.committed = pair.present;
        }
    }

    fn revert(&mut self) {}

    fn averages(&self, p: usize, out: &mut Vec<(usize, f64)>) {
        out.clone_from(&self.averages[p]);
    }

    fn attachments(&self, p: usize, out: &mut Vec<Attachment>) {
        out.clear();
        // Pairs are sorted by point.
        if let Ok(i) = self.pairs.binary_search_by_key(&p, |pair| pair.point) {
            let pair = &self.pairs[i];
            for k in pair.from..pair.to {
                out.push(Attachment {
                    node: self.nodes[k],
                    weight: self.relative.weights[k],
                    slave: k < pair.split,
                });
            }
        }
    }

    fn areas(&self, out: &mut [f64]) {
        out.copy_from_slice(&self.areas);
    }

    fn collocated(&self) -> bool {
        self.collocated
    }

    fn follows(&self) -> bool {
        false
    }

    fn save(&self) -> MeasureState {
        MeasureState::Fixed(self.pairs.iter().map(|pair| pair.committed).collect())
    }

    fn restore(&mut self, saved: &MeasureState) -> bool {
        let MeasureState::Fixed(committed) = saved else { return false };
        if committed.len() != self.pairs.len() {
            return false;
        }
        for (pair, c) in self.pairs.iter_mut().zip(committed) {
            (pair.committed, pair.present) = (*c, *c);
        }
        true
    }
}
