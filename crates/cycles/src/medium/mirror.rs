//! Bodies that mirror each other across a plane fault, of which one is condensed for both.
//!
//! Let P u be the mirror image of displacements u. If the stiffness is the same in the mirror and loads change sign there, slip
//! along the plane causes displacements with `P u = -u`. Then both sides of the fault move along it by half of the slip, in
//! opposite directions, and together across it. The latter motion is free, as normal tractions vanish. Both bodies have the same
//! energy E, so that with the slip s' = s/2 of one side the force on slip is `d(2 E)/ds = dE/ds'`: it follows from one body.

use super::loads::Loads;
use super::point::Point;
use asperity_fem::condense::Stiffness;
use asperity_fem::dof::{Channel, Constraints};
use asperity_fem::term::Blocks;

/// Components of displacement.
const COMPONENTS: usize = 3;
/// Relative difference of forces, loads and motions that are equal in the mirror: above the rounding of cells, and far below any
/// difference of rocks or meshes.
const EQUAL: f64 = 1e-9;

/// A mirror that maps the nodes of bodies in space onto each other.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// The axis normal to it.
    pub axis: usize,
    /// Image of each node. No node is its own.
    pub images: Vec<usize>,
    /// True for the nodes on the minus side of the fault.
    pub minus: Vec<bool>,
}

impl Mirror {
    /// Degree of freedom at the image, and the sign of a displacement there where the image of displacements is their opposite.
    fn odd(&self, dof: usize) -> (usize, f64) {
        let (node, component) = (dof / COMPONENTS, dof % COMPONENTS);
        let sign = if component == self.axis { 1.0 } else { -1.0 };
        (self.images[node] * COMPONENTS + component, sign)
    }

    /// True if values of all degrees of freedom change sign in the mirror.
    fn is_odd(&self, values: &[f64]) -> bool {
        let largest = values.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        values.iter().enumerate().all(|(dof, value)| {
            let (image, sign) = self.odd(dof);
            (values[image] - sign * value).abs() <= EQUAL * largest
        })
    }

    /// True if the sum of a part of all channels changes sign in the mirror until `end` \[s\].
    fn are_odd(
        &self,
        channels: &[Channel],
        part: impl Fn(&Channel) -> &[(usize, f64)],
        (dofs, end): (usize, f64),
    ) -> bool {
        let mut times: Vec<f64> =
            channels.iter().flat_map(|c| c.amplitude.times().iter().copied()).filter(|t| *t < end).collect();
        times.push(end);
        times.sort_unstable_by(f64::total_cmp);
        times.dedup();
        // Amplitudes of rotations are curved between their times.
        let middles: Vec<f64> = times.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
        times.extend(middles);
        let mut values = vec![0.0; dofs];
        times.into_iter().all(|time| {
            values.fill(0.0);
            for channel in channels {
                let amplitude = channel.amplitude.value(time);
                part(channel).iter().for_each(|&(dof, value)| values[dof] += amplitude * value);
            }
            self.is_odd(&values)
        })
    }

    /// True if one of these bodies can be condensed for both.
    pub(super) fn holds<const D: usize>(
        &self,
        bodies: &Stiffness,
        loads: &Loads,
        points: &[Point<D>],
    ) -> bool {
        let Constraints { fixed, channels } = &loads.constraints;
        let pairs = |p: &Point<D>| self.minus[p.place.minus] && self.images[p.place.minus] == p.place.plus;
        let along = |p: &Point<D>| p.place.rake[self.axis] == 0.0 && !p.opens;
        let one_side = |cell: &[usize]| {
            cell.iter().all(|d| self.minus[d / COMPONENTS] == self.minus[cell[0] / COMPONENTS])
        };
        loads.springs.is_empty()
            && loads.weight.is_empty()
            && points.iter().all(|p| pairs(p) && along(p))
            && bodies.pattern.blocks().all(one_side)
            && fixed.iter().all(|&d| fixed.binary_search(&self.odd(d).0).is_ok())
            && self.are_odd(channels, |c| &c.prescribed, (bodies.dofs, loads.end))
            && self.are_odd(channels, |c| &c.forces, (bodies.dofs, loads.end))
            && self.is_odd(&bodies.forces(&self.sample(bodies.dofs)))
    }

    /// Displacements that change sign in the mirror and otherwise differ from node to node. The forces they cause change sign
    /// as well where the stiffness is the same in the mirror.
    fn sample(&self, dofs: usize) -> Vec<f64> {
        // The golden section fills the interval without a pattern.
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        let mut u: Vec<f64> = (0..dofs).map(|d| (d as f64 * golden).fract() - 0.5).collect();
        for dof in (0..dofs).filter(|d| self.minus[d / COMPONENTS]) {
            let (image, sign) = self.odd(dof);
            u[image] = sign * u[dof];
        }
        u
    }

    /// The minus side alone: its stiffness, its loads, and its points, whose plus side is one node at rest. Slip of a point is half of
    /// that between both sides.
    pub(super) fn half<const D: usize>(
        &self,
        bodies: Stiffness,
        loads: &Loads,
        points: &[Point<D>],
    ) -> (Stiffness, Loads, Vec<Point<D>>) {
        let on_minus = |dof: usize| self.minus[dof / COMPONENTS];
        let (mut cells, mut values, mut offset) = (Blocks::default(), Vec::new(), 0);
        for cell in bodies.pattern.blocks() {
            let end = offset + cell.len() * cell.len();
            if on_minus(cell[0]) {
                cells.push(cell.iter().copied());
                values.extend_from_slice(&bodies.values[offset..end]);
            }
            offset = end;
        }
        let (rest, dofs) = (bodies.dofs / COMPONENTS, bodies.dofs + COMPONENTS);
        let body = Stiffness { pattern: cells.into(), values, dofs };
        let held = |&dof: &usize| {
            dof >= bodies.dofs || !on_minus(dof) || loads.constraints.fixed.binary_search(&dof).is_ok()
        };
        let here = |all: &[(usize, f64)]| all.iter().copied().filter(|(d, _)| on_minus(*d)).collect();
        let channel = |c: &Channel| Channel {
            prescribed: here(&c.prescribed),
            forces: here(&c.forces),
            amplitude: c.amplitude.clone(),
        };
        let constraints = Constraints {
            fixed: (0..dofs).filter(held).collect(),
            channels: loads.constraints.channels.iter().map(channel).collect(),
        };
        let point = |p: &Point<D>| {
            let mut half = p.clone();
            (half.place.minus, half.place.plus) = (rest, p.place.minus);
            half.creep = p.creep.map(|rates| rates.map(|rate| 0.5 * rate));
            half
        };
        let loads = Loads { constraints, springs: Vec::new(), weight: Vec::new(), end: loads.end };
        (body, loads, points.iter().map(point).collect())
    }
}
