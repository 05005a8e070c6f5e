//! Problems shared by the benches.

pub mod direct;
pub mod explicit;
pub mod growth;

use asperity_contact::{
    Enforcement, Interface, InterfaceSpec, MeasureKind, Segment, SegmentKind, SlavePoint, Sliding, Smoothing,
    SurfaceNode,
};
use asperity_friction::law::{Law, RateBounds};
use std::sync::Arc;

/// A flat interface in two dimensions: `n` slave nodes over `n` master segments of length 1 m, offset by half a segment.
///
/// # Panics
/// Never: the specification is admissible.
#[must_use]
pub fn flat_2d(
    n: usize,
    sliding: Sliding,
    smoothing: Option<Smoothing>,
    law: Option<Arc<dyn Law>>,
) -> Interface<2> {
    Interface::new(line(n, sliding, smoothing, law)).expect("an admissible interface")
}

fn line(
    n: usize,
    sliding: Sliding,
    smoothing: Option<Smoothing>,
    law: Option<Arc<dyn Law>>,
) -> InterfaceSpec<2> {
    let mut nodes = Vec::new();
    for k in 0..n {
        nodes.push(SurfaceNode { position: [k as f64 + 0.5, 0.0], dof: 2 * k, label: k });
    }
    for k in 0..=n {
        // The master surface lies below: its outward normal is (0, 1), so its edges run towards -x.
        nodes.push(SurfaceNode { position: [k as f64, 0.0], dof: 2 * (n + k), label: n + k });
    }
    let master = (0..n).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![n + k + 1, n + k] }).collect();
    let slave = (0..n).map(|k| SlavePoint { node: k, area: 1.0 }).collect();
    spec(nodes, slave, master, (sliding, smoothing), law)
}

/// As [`flat_2d`] with mortar: facets between the slave nodes.
///
/// # Panics
/// Never: the specification is admissible.
#[must_use]
pub fn mortar_2d(n: usize, sliding: Sliding, law: Option<Arc<dyn Law>>) -> Interface<2> {
    let mut spec = line(n, sliding, None, law);
    let faces = (1..n).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k - 1, k] }).collect();
    spec.measure = MeasureKind::Mortar { faces, axisymmetric: false, mirrors: Vec::new() };
    Interface::new(spec).expect("an admissible interface")
}

/// A flat interface in three dimensions: `m * m` slave nodes over `m * m` square master facets of 1 m.
///
/// # Panics
/// Never: the specification is admissible.
#[must_use]
pub fn flat_3d(
    m: usize,
    sliding: Sliding,
    smoothing: Option<Smoothing>,
    law: Option<Arc<dyn Law>>,
) -> Interface<3> {
    Interface::new(square(m, sliding, smoothing, law)).expect("an admissible interface")
}

/// As [`flat_3d`] with mortar: facets between the slave nodes, each over four master facets.
///
/// # Panics
/// Never: the specification is admissible.
#[must_use]
pub fn mortar_3d(m: usize, sliding: Sliding, law: Option<Arc<dyn Law>>) -> Interface<3> {
    let mut spec = square(m, sliding, None, law);
    let facet = |k: usize| {
        let at = k / (m - 1) * m + k % (m - 1);
        Segment { kind: SegmentKind::Quad4, nodes: vec![at, at + m, at + m + 1, at + 1] }
    };
    let faces = (0..(m - 1) * (m - 1)).map(facet).collect();
    spec.measure = MeasureKind::Mortar { faces, axisymmetric: false, mirrors: Vec::new() };
    Interface::new(spec).expect("an admissible interface")
}

fn square(
    m: usize,
    sliding: Sliding,
    smoothing: Option<Smoothing>,
    law: Option<Arc<dyn Law>>,
) -> InterfaceSpec<3> {
    let mut nodes = Vec::new();
    let mut add = |position: [f64; 3]| {
        let k = nodes.len();
        nodes.push(SurfaceNode { position, dof: 3 * k, label: k });
    };
    for j in 0..m {
        for i in 0..m {
            add([i as f64 + 0.4, j as f64 + 0.3, 0.0]);
        }
    }
    for j in 0..=m {
        for i in 0..=m {
            add([i as f64, j as f64, 0.0]);
        }
    }
    let at = |i: usize, j: usize| m * m + j * (m + 1) + i;
    let facet = |k: usize| {
        let (i, j) = (k % m, k / m);
        Segment {
            kind: SegmentKind::Quad4,
            nodes: vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)],
        }
    };
    let slave = (0..m * m).map(|k| SlavePoint { node: k, area: 1.0 }).collect();
    let master = (0..m * m).map(facet).collect();
    spec(nodes, slave, master, (sliding, smoothing), law)
}

fn spec<const D: usize>(
    nodes: Vec<SurfaceNode<D>>,
    slave: Vec<SlavePoint>,
    master: Vec<Segment>,
    (sliding, smoothing): (Sliding, Option<Smoothing>),
    law: Option<Arc<dyn Law>>,
) -> InterfaceSpec<D> {
    InterfaceSpec {
        name: "flat".into(),
        nodes,
        slave,
        master,
        measure: MeasureKind::NodeToPoint,
        sliding,
        smoothing,
        fixed_normal: None,
        enforcement: Enforcement::Penalty,
        normal_penalty: 1e12,
        tangential_penalty: 1e12,
        young_per_size: 1e10,
        law,
        scale: 1e3,
        rate_floor: f64::MIN_POSITIVE,
        rate_bounds: RateBounds { zeta: 0.1, log_rate: 0.5 },
        label_rate: None,
    }
}

/// Displacement along the interface \[m\], enough to slip with the friction coefficient of the benches, 0.3.
const ALONG: f64 = 8e-6;
/// Penetration \[m\].
const INTO: f64 = 1e-5;

/// Displacements that press the slave side in and move it along x far enough for every point to slip.
#[must_use]
pub fn pressed<const D: usize>(slaves: usize, nodes: usize) -> Vec<f64> {
    let mut u = vec![0.0; nodes * D];
    for k in 0..slaves {
        u[k * D] = ALONG;
        u[k * D + D - 1] = -INTO;
    }
    u
}

/// Reproducible pseudo-random numbers (splitmix64), so that branches are as hard to predict as on a fault.
#[derive(Clone, Copy, Debug)]
pub struct Draws(u64);

impl Draws {
    /// Sequence of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniformly distributed number between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let share = ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * share
    }
}
