//! The jump across a fault as a degree of freedom.
//!
//! Along a split surface each place has a node on the minus and one on the plus side. With `u⁺ = u⁻ + Σ_k s_k e_k`, e_k an
//! orthonormal frame of the point, the displacement of the plus node is replaced by its jump s: `u = T v`, and the stiffness of
//! the body becomes `Tᵀ K T`, cell by cell, with the numbers of the plus node's degrees of freedom standing for the jump.
//! No penalty is needed, and a jump that is fixed at zero joins the two sides again: where nothing opens, the opening is such
//! a jump. The forces that belong to jumps are those that hold them, `f = ∂E/∂s`; the traction that drives slip is `-f` over the
//! tributary area. For the opening, whose axis points from minus to plus, `f` over the area is the compressive normal traction: what
//! must hold the sides apart.

use crate::condense::Stiffness;
use crate::dof::Channel;
use crate::term::Blocks;
use std::collections::BTreeMap;

/// Two nodes at one place, on both sides of a fault, with `C` components of displacement each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump<const C: usize> {
    /// First of the `C` degrees of freedom of the node on the minus side.
    pub minus: usize,
    /// First of those of the node on the plus side, which become the components of the jump.
    pub plus: usize,
    /// Axes e_k of the jump, orthonormal: component c of axis k stands at `[k][c]`.
    pub frame: [[f64; C]; C],
}

/// A prescribed displacement that jumps cannot express: components of the plus node are held, but no axes of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "degree of freedom {plus} on the plus side of a fault is prescribed, and what is prescribed there on both sides are neither all \
     components nor axes of the fault"
)]
pub struct ObliqueConstraint {
    /// The degree of freedom.
    pub plus: usize,
}

/// The jumps of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Jumps<const C: usize> {
    list: Vec<Jump<C>>,
    /// Index of the jump by the first degree of freedom of its plus node.
    by_plus: BTreeMap<usize, usize>,
}

impl<const C: usize> Jumps<C> {
    /// The jumps at these places; a plus node belongs to one of them only. Tips, where both sides are one node, have none and are
    /// left out.
    #[must_use]
    pub fn new(mut list: Vec<Jump<C>>) -> Self {
        list.retain(|jump| jump.minus != jump.plus);
        let by_plus: BTreeMap<usize, usize> = list.iter().enumerate().map(|(k, j)| (j.plus, k)).collect();
        debug_assert!(by_plus.len() == list.len(), "a plus node appears twice");
        Self { list, by_plus }
    }

    /// The jumps in the order given, without tips.
    #[must_use]
    pub fn list(&self) -> &[Jump<C>] {
        &self.list
    }

    /// Jump and component of a degree of freedom of a plus node.
    fn find(&self, dof: usize) -> Option<(&Jump<C>, usize)> {
        let component = dof % C;
        self.by_plus.get(&(dof - component)).map(|&k| (&self.list[k], component))
    }

    /// `Tᵀ K T` of a body whose degrees of freedom are node * `C` + component: cells at plus nodes also couple the minus nodes.
    #[must_use]
    pub fn stiffness(&self, body: &Stiffness) -> Stiffness {
        let (mut cells, mut all) =
            (Blocks::with_capacity(body.pattern.dofs().len()), Vec::with_capacity(body.values.len()));
        let mut offset = 0;
        for cell in body.pattern.blocks() {
            let values = &body.values[offset..offset + cell.len() * cell.len()];
            offset += values.len();
            if cell.iter().any(|&d| self.find(d).is_some()) {
                let (dofs, values) = self.cell(cell, values);
                cells.push(dofs);
                all.extend(values);
            } else {
                cells.push(cell.iter().copied());
                all.extend_from_slice(values);
            }
        }
        Stiffness { pattern: cells.into(), values: all, dofs: body.dofs }
    }

    /// One cell at the plus side: its degrees of freedom, those of the minus nodes that are not yet there, and `Tᵀ K T`.
    fn cell(&self, cell: &[usize], values: &[f64]) -> (Vec<usize>, Vec<f64>) {
        let mut dofs = cell.to_vec();
        for &dof in cell {
            if let Some((jump, component)) = self.find(dof)
                && !dofs.contains(&(jump.minus + component))
            {
                dofs.push(jump.minus + component);
            }
        }
        let place = |dof: usize| dofs.iter().position(|&d| d == dof);
        // Row i of T, as (column, value).
        let rows: Vec<Vec<(usize, f64)>> = cell
            .iter()
            .map(|&dof| {
                let row = self.row(dof);
                row.into_iter().filter_map(|(d, v)| place(d).map(|p| (p, v))).collect()
            })
            .collect();
        let (n, m) = (cell.len(), dofs.len());
        let mut k = vec![0.0; m * m];
        for i in 0..n {
            for j in 0..n {
                for &(p, a) in &rows[i] {
                    for &(q, b) in &rows[j] {
                        k[p * m + q] += a * b * values[i * n + j];
                    }
                }
            }
        }
        (dofs, k)
    }

    /// Displacement `dof` in terms of the transformed unknowns.
    fn row(&self, dof: usize) -> Vec<(usize, f64)> {
        match self.find(dof) {
            None => vec![(dof, 1.0)],
            Some((jump, c)) => std::iter::once((jump.minus + c, 1.0))
                .chain((0..C).map(|k| (jump.plus + k, jump.frame[k][c])))
                .collect(),
        }
    }

    /// A channel in the transformed unknowns: `Tᵀ f`, and prescribed displacements of plus nodes as prescribed jumps.
    ///
    /// # Errors
    /// [`ObliqueConstraint`] where a plus node is held in some components only and its frame is oblique to them, or where its
    /// minus node is not held alike.
    pub fn channel(&self, channel: &Channel, fixed: &[usize]) -> Result<Channel, ObliqueConstraint> {
        let mut prescribed: BTreeMap<usize, f64> = BTreeMap::new();
        for &(dof, value) in &channel.prescribed {
            match self.find(dof) {
                None => *prescribed.entry(dof).or_default() += value,
                Some((jump, c)) => {
                    for k in self.held(jump, c, fixed)? {
                        *prescribed.entry(jump.plus + k).or_default() += jump.frame[k][c] * value;
                    }
                }
            }
            // The jump is the difference to the minus node.
            for jump in self.list.iter().filter(|j| (j.minus..j.minus + C).contains(&dof)) {
                let c = dof - jump.minus;
                if fixed.binary_search(&(jump.plus + c)).is_ok() {
                    for k in self.held(jump, c, fixed)? {
                        *prescribed.entry(jump.plus + k).or_default() -= jump.frame[k][c] * value;
                    }
                }
            }
        }
        Ok(Channel {
            prescribed: prescribed.into_iter().collect(),
            forces: self.gather(&channel.forces),
            amplitude: channel.amplitude.clone(),
        })
    }

    /// `Tᵀ f` of forces on degrees of freedom, or of the weights of displacements in a sum.
    #[must_use]
    pub fn gather(&self, forces: &[(usize, f64)]) -> Vec<(usize, f64)> {
        let mut all: BTreeMap<usize, f64> = BTreeMap::new();
        for &(dof, force) in forces {
            for (d, v) in self.row(dof) {
                *all.entry(d).or_default() += v * force;
            }
        }
        all.into_iter().filter(|(_, f)| *f != 0.0).collect()
    }

    /// Prescribed degrees of freedom in the transformed unknowns, sorted.
    ///
    /// # Errors
    /// [`ObliqueConstraint`].
    pub fn fixed(&self, fixed: &[usize]) -> Result<Vec<usize>, ObliqueConstraint> {
        let mut result = Vec::with_capacity(fixed.len());
        for &dof in fixed {
            match self.find(dof) {
                None => result.push(dof),
                Some((jump, c)) => {
                    result.extend(self.held(jump, c, fixed)?.into_iter().map(|k| jump.plus + k))
                }
            }
        }
        result.sort_unstable();
        result.dedup();
        Ok(result)
    }

    /// Components of a jump that are held where component `c` of its plus node is.
    fn held(&self, jump: &Jump<C>, c: usize, fixed: &[usize]) -> Result<Vec<usize>, ObliqueConstraint> {
        let held: [bool; C] = std::array::from_fn(|c| {
            fixed.binary_search(&(jump.plus + c)).is_ok() && fixed.binary_search(&(jump.minus + c)).is_ok()
        });
        // Axes that lie in what is held; rounding in the other components is not seen in their length.
        let outside = |k: usize| (0..C).filter(|&c| !held[c]).map(|c| jump.frame[k][c].powi(2)).sum::<f64>();
        let axes: Vec<usize> = (0..C).filter(|&k| outside(k) <= f64::EPSILON).collect();
        if held[c] && axes.len() == held.iter().filter(|h| **h).count() {
            Ok(axes.into_iter().filter(|&k| jump.frame[k][c] != 0.0).collect())
        } else {
            Err(ObliqueConstraint { plus: jump.plus + c })
        }
    }

    /// Displacements of the body from the transformed unknowns, in place.
    pub fn displacement(&self, unknowns: &mut [f64]) {
        for jump in &self.list {
            let s: [f64; C] = std::array::from_fn(|k| unknowns[jump.plus + k]);
            for c in 0..C {
                let slip: f64 = s.iter().zip(&jump.frame).map(|(s, e)| s * e[c]).sum();
                unknowns[jump.plus + c] = unknowns[jump.minus + c] + slip;
            }
        }
    }
}
