//! Surroundings of a fault in a step: its nodes and their motion.

use super::nodes::{SpecialNode, dot};
use super::split::SplitPoint;
use rayon::prelude::*;

/// Nodes of faults of one task: few, so that both threads of a small fault have some, and enough to pay for one.
pub(super) const NODES: usize = 256;

/// Mobility over that of free nodes below which a point is held: the square of the rounding of unit vectors is far below, absorbing sides far above.
const HELD: f64 = 1e-12;

/// Surroundings of the points of a fault: the special nodes of each, and the step.
pub(super) struct FaultSurroundings<'a> {
    pub nodes: &'a [SpecialNode],
    /// Accelerations without the change of tractions; the tractions add theirs \[m/s²\].
    pub acceleration: &'a mut [[f64; 3]],
    /// Velocities at the half step before \[m/s\].
    pub velocity: &'a [[f64; 3]],
    /// Displacements \[m\].
    pub displacement: &'a [[f64; 3]],
    /// Special nodes of each point: minus, plus.
    pub pairs: &'a [[usize; 2]],
    /// Mobilities of each point.
    pub mobilities: &'a [Mobility],
    /// Points at each node.
    pub at_nodes: &'a PointsAtNodes,
    /// Special nodes of each tie.
    pub tied: &'a [[usize; 2]],
    /// Number of components of displacements.
    pub components: usize,
    pub time: f64,
    pub dt: f64,
    /// Time over which velocities change: Δt, but half of it in the first step.
    pub kick: f64,
    /// True in the first step, where rate laws keep their initial traction.
    pub first: bool,
}

impl FaultSurroundings<'_> {
    /// Difference plus - minus of values at the nodes of a point, along a unit vector.
    pub fn jump(&self, values: &[[f64; 3]], point: usize, e: &[f64; 3]) -> f64 {
        let [minus, plus] = self.pairs[point];
        dot(&values[plus], e) - dot(&values[minus], e)
    }

    /// Adds the accelerations by the forces at all points, point by point at each node.
    pub fn push_all(&mut self, forces: &[PointForces]) {
        let (nodes, at_nodes) = (self.nodes, self.at_nodes);
        let tasks = self.acceleration.par_chunks_mut(NODES).enumerate();
        tasks.for_each(|(task, accelerations)| {
            for (own, acceleration) in accelerations.iter_mut().enumerate() {
                let node = task * NODES + own;
                for &(point, sign) in at_nodes.at(node) {
                    for force in [&forces[point].normal, &forces[point].shear] {
                        let caused = nodes[node].accelerated(&force.map(|f| sign * f));
                        acceleration.iter_mut().zip(caused).for_each(|(a, c)| *a += c);
                    }
                }
            }
        });
    }

    /// Adds the accelerations by a force on the plus node of a pair, and its reaction \[N\].
    pub fn push(&mut self, pair: [usize; 2], force: &[f64; 3]) {
        for (&node, sign) in pair.iter().zip([-1.0, 1.0]) {
            let caused = self.nodes[node].accelerated(&force.map(|f| sign * f));
            self.acceleration[node].iter_mut().zip(caused).for_each(|(a, c)| *a += c);
        }
    }
}

/// Forces of the changes of tractions at a point, on its plus side \[N\].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PointForces {
    pub normal: [f64; 3],
    pub shear: [f64; 3],
}

/// Points of faults at each node of faults, with the sign of their forces there.
#[derive(Debug, Default)]
pub(super) struct PointsAtNodes {
    /// Start of the points of each node; one more than there are nodes.
    starts: Vec<usize>,
    points: Vec<(usize, f64)>,
}

impl PointsAtNodes {
    /// Points between these pairs of so many nodes.
    pub fn new(nodes: usize, pairs: &[[usize; 2]]) -> Self {
        let sides = pairs
            .iter()
            .enumerate()
            .flat_map(|(point, [minus, plus])| [(*minus, (point, -1.0)), (*plus, (point, 1.0))]);
        let mut sides: Vec<(usize, (usize, f64))> = sides.collect();
        sides.sort_by_key(|(node, _)| *node);
        let starts = (0..=nodes).map(|node| sides.partition_point(|(n, _)| *n < node)).collect();
        Self { starts, points: sides.into_iter().map(|(_, side)| side).collect() }
    }

    /// Points at a node, ascending.
    fn at(&self, node: usize) -> &[(usize, f64)] {
        &self.points[self.starts[node]..self.starts[node + 1]]
    }
}

/// Inverse mass of a point of a fault for motion apart, times its area \[m²/kg\].
#[derive(Clone, Debug)]
pub(super) struct Mobility {
    /// Along the normal; 0 in antiplane motion.
    pub normal: f64,
    /// Along each direction of slip; `None` if conditions hold both nodes along it, as on a plane of symmetry.
    pub along: [Option<f64>; 2],
}

impl Mobility {
    /// Mobility of a point between its special nodes.
    pub fn new(point: &SplitPoint, pair: [&SpecialNode; 2]) -> Self {
        let of = |e: &[f64; 3]| point.area * (pair[0].along(e) + pair[1].along(e));
        let free: f64 = pair.iter().map(|s| point.area / s.mass).sum();
        let slides = |e: &[f64; 3]| Some(of(e)).filter(|mobility| *mobility > HELD * free);
        let along = std::array::from_fn(|c| point.along.get(c).and_then(slides));
        Self { normal: of(&point.normal), along }
    }
}
