//! The inverse of the node blocks on the diagonal.

use super::cg::Preconditioner;
use super::csr::BlockCsr;
use super::dense::{Block, add_apply, inverse};
use super::vector::CHUNK;
use crate::error::FemError;
use rayon::prelude::*;

/// Inverses of the diagonal blocks of a symmetric positive definite matrix.
#[derive(Clone, Debug)]
pub struct BlockJacobi<const B: usize> {
    /// One block per node.
    pub inverses: Vec<Block<B, B>>,
}

impl<const B: usize> BlockJacobi<B> {
    /// Inverts the diagonal blocks.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] naming the first node whose block is not positive definite.
    pub fn new(matrix: &BlockCsr<B, B>) -> Result<Self, FemError> {
        let inverses = matrix
            .diagonal()
            .iter()
            .enumerate()
            .map(|(node, block)| {
                inverse(block).map_err(|component| {
                    FemError::Factorisation(format!(
                        "the stiffness is not positive definite at node {node}, component {component} \
                         (degree of freedom {})",
                        node * B + component
                    ))
                })
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { inverses })
    }
}

impl<const B: usize> Preconditioner<B> for &BlockJacobi<B> {
    fn apply(&mut self, r: &[[f64; B]], z: &mut [[f64; B]]) {
        z.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, z)| {
            for (k, z) in z.iter_mut().enumerate() {
                let node = chunk * CHUNK + k;
                *z = [0.0; B];
                add_apply(z, &self.inverses[node], &r[node]);
            }
        });
    }
}
