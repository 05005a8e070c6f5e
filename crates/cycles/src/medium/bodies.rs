//! Displacements of the bodies around faults under slip and loads, by one solve with the factor of the condensation.

use asperity_fem::condense::Interior;
use asperity_fem::jump::Jumps;

/// Conversion of unknowns, some of which are jumps, to displacements.
trait Jumping: Send + Sync + std::fmt::Debug {
    /// Converts in place.
    fn displace(&self, unknowns: &mut [f64]);
}

impl<const C: usize> Jumping for Jumps<C> {
    fn displace(&self, unknowns: &mut [f64]) {
        self.displacement(unknowns);
    }
}

/// Condensed bodies with their factor.
#[derive(Debug)]
pub struct Bodies {
    interior: Interior,
    /// Ties of spring-loaded boundaries, then the faults, in the order in which they are converted.
    jumps: [Box<dyn Jumping>; 2],
    /// Retained unknown of the first component of slip of each point.
    rows: Vec<usize>,
    /// Components of displacement.
    components: usize,
}

impl Bodies {
    /// Bodies with the jumps of their faults and the ties of spring-loaded boundaries; `rows` are the retained unknowns
    /// of the first component of slip of each point.
    pub(super) fn new<const C: usize>(
        interior: Interior,
        jumps: Jumps<C>,
        ties: Jumps<1>,
        rows: Vec<usize>,
    ) -> Self {
        Self { interior, jumps: [Box::new(ties), Box::new(jumps)], rows, components: C }
    }

    /// Displacements of all nodes \[m\], node by node, under the loads at `time` \[s\]. The argument holds the slip of
    /// all points \[m\], component by component, followed by their openings where points may open.
    #[must_use]
    pub fn displacement(&self, slip: &[f64], time: f64) -> Vec<f64> {
        let mut retained = vec![0.0; self.interior.retained()];
        let n = self.rows.len();
        for (i, s) in slip.iter().enumerate() {
            retained[self.rows[i % n] + i / n] = *s;
        }
        let mut all = self.interior.recover(&retained, time);
        self.jumps.iter().for_each(|jumps| jumps.displace(&mut all));
        all
    }

    /// The same as vectors in space.
    #[must_use]
    pub fn vectors(&self, slip: &[f64], time: f64) -> Vec<[f64; 3]> {
        let all = self.displacement(slip, time);
        let vector = |u: &[f64]| match u {
            // Antiplane motion.
            [z] => [0.0, 0.0, *z],
            _ => std::array::from_fn(|c| u.get(c).copied().unwrap_or(0.0)),
        };
        all.chunks_exact(self.components).map(vector).collect()
    }
}
