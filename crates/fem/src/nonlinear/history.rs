//! State kept at a quadrature point: stress, then the material's tensors and numbers, then in plane stress the logarithmic
//! strain through the thickness.

use super::tensor::{Tensor, rotated};
use crate::material::constitutive::Voigt;
use crate::material::plane_stress::MOST_HISTORY;

/// Longest state of a point: stress, history, one number of a material without tensors, thickness.
const MOST_STATE: usize = 6 + MOST_HISTORY + 2;

/// State of one point on the stack; zeros if nothing is kept.
pub type State = [f64; MOST_STATE];

/// Lengths of the parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Tensors in the history.
    pub tensors: usize,
    /// Numbers in the history.
    pub scalars: usize,
    /// True if the strain through the thickness is kept.
    pub thickness: bool,
    /// Numbers kept; 0 if the stress follows from the displacements alone.
    pub stride: usize,
}

impl Layout {
    /// Layout of a state that is kept.
    #[must_use]
    pub fn new(tensors: usize, scalars: usize, thickness: bool) -> Self {
        let stride = 6 + 6 * tensors + scalars + usize::from(thickness);
        Self { tensors, scalars, thickness, stride }
    }

    /// The same layout with nothing kept.
    #[must_use]
    pub fn forgetful(self) -> Self {
        Self { stride: 0, ..self }
    }

    /// The state of a point.
    #[must_use]
    pub fn read(&self, kept: &[f64]) -> State {
        let mut state = [0.0; MOST_STATE];
        state[..kept.len()].copy_from_slice(kept);
        state
    }

    /// Stress and history.
    pub fn split<'a>(&self, state: &'a mut State) -> (&'a mut Voigt, &'a mut [f64]) {
        let (stress, rest) = state.split_first_chunk_mut::<6>().expect("a state begins with a stress");
        (stress, &mut rest[..6 * self.tensors + self.scalars])
    }

    /// Rotates stress and tensors.
    pub fn rotate(&self, state: &mut State, q: &Tensor) {
        for tensor in state.as_chunks_mut::<6>().0.iter_mut().take(1 + self.tensors) {
            *tensor = rotated(q, tensor);
        }
    }

    /// Adds to the strain through the thickness.
    pub fn thicken(&self, state: &mut State, strain: f64) {
        if self.thickness {
            state[6 + 6 * self.tensors + self.scalars] += strain;
        }
    }
}
