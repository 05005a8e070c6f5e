//! Relative displacements of pairs of points, through which fixed contact acts.

use crate::dof::Equations;

/// Relative displacements `w_p = Σ_k s_k u_k` of pairs p, each of nodes k with constant weights s_k.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RelativeDisplacements {
    /// Components of a displacement.
    pub components: usize,
    /// Start of the nodes of each pair; one more entry than there are pairs.
    pub starts: Vec<usize>,
    /// First degrees of freedom of the nodes of all pairs.
    pub dofs: Vec<usize>,
    /// Their weights s_k \[-\].
    pub weights: Vec<f64>,
}

impl RelativeDisplacements {
    /// Takes the matrix M of each pair from blocks `s_k s_j M` over its nodes, one pair after another, into `out`.
    pub(crate) fn reduce(&self, values: &[f64], out: &mut Vec<f64>) {
        let components = self.components;
        let mut offset = 0;
        for pair in self.starts.windows(2) {
            let weights = &self.weights[pair[0]..pair[1]];
            let order = weights.len() * components;
            let block = &values[offset..offset + order * order];
            offset += order * order;
            let by_size = |a: &usize, b: &usize| weights[*a].abs().total_cmp(&weights[*b].abs());
            let Some(heaviest) = (0..weights.len()).max_by(by_size) else { continue };
            let (first, square) = (heaviest * components, weights[heaviest].powi(2));
            for row in first..first + components {
                out.extend(block[row * order + first..][..components].iter().map(|v| v / square));
            }
        }
    }

    /// Equations and weights of each component of each pair, one after another.
    pub(crate) fn rows(&self, equations: &Equations) -> impl Iterator<Item = Vec<(usize, f64)>> {
        self.starts.windows(2).flat_map(move |pair| {
            (0..self.components).map(move |component| {
                let nodes = self.dofs[pair[0]..pair[1]].iter().zip(&self.weights[pair[0]..pair[1]]);
                let row = nodes.map(|(dof, weight)| (equations.number[dof + component], *weight));
                row.filter(|(equation, _)| *equation != Equations::FIXED).collect()
            })
        })
    }
}
