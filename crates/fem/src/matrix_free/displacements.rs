//! Displacements as forces see them.

/// Displacements u + t v at which forces are computed: damping adds the rate of the strain times a relaxation time.
#[derive(Clone, Copy, Debug)]
pub struct Displacements<'a> {
    /// u \[m\].
    pub u: &'a [f64],
    /// v \[m/s\]; empty where nothing damps.
    pub velocity: &'a [f64],
    /// t \[s\].
    pub ahead: f64,
}

impl<'a> Displacements<'a> {
    /// Displacements without damping \[m\].
    #[must_use]
    pub fn plain(u: &'a [f64]) -> Self {
        Self { u, velocity: &[], ahead: 0.0 }
    }

    /// Those of a node of C components.
    #[inline(always)]
    pub(super) fn node<const C: usize>(&self, node: usize) -> [f64; C] {
        let u = self.u.as_chunks::<C>().0[node];
        match self.velocity.as_chunks::<C>().0.get(node) {
            Some(v) => std::array::from_fn(|c| u[c] + self.ahead * v[c]),
            None => u,
        }
    }
}
