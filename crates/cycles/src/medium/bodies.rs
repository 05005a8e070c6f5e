//! Displacements of the bodies around faults under slip and loads: of all nodes by one solve with the factor of the
//! condensation, and of single positions by their weights.

use asperity_fem::condense::Interior;
use asperity_fem::jump::Jumps;
use asperity_fem::table::Table;

/// Conversion of unknowns, some of which are jumps, to displacements.
trait Jumping: Send + Sync + std::fmt::Debug {
    /// Converts in place.
    fn displace(&self, unknowns: &mut [f64]);

    /// Weights of the unknowns in a weighted sum of displacements.
    fn gather(&self, weights: &[(usize, f64)]) -> Vec<(usize, f64)>;
}

impl<const C: usize> Jumping for Jumps<C> {
    fn displace(&self, unknowns: &mut [f64]) {
        self.displacement(unknowns);
    }

    fn gather(&self, weights: &[(usize, f64)]) -> Vec<(usize, f64)> {
        Jumps::gather(self, weights)
    }
}

/// A weighted sum of displacements, as it follows slip and loads.
#[derive(Clone, Debug, PartialEq)]
pub struct DisplacementSum {
    /// Change per slip of each point, component by component \[-\].
    pub per_slip: Vec<f64>,
    /// Amplitude of each load, and the sum at its unit amplitude \[m\]. A slip that creep prescribes is one of them.
    pub loads: Vec<(Table, f64)>,
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

    /// Weighted sums of displacements as they follow slip of `tangents` components and loads, for weights of degrees of freedom,
    /// node * components + component. It takes half a solve for each sum, and one for each load.
    #[must_use]
    pub fn followed(&self, sums: &[Vec<(usize, f64)>], tangents: usize) -> Vec<DisplacementSum> {
        let slip = |weights: &Vec<(usize, f64)>| {
            // Ties are converted before the jumps, and their weights after them.
            let all = self.jumps.iter().rev().fold(weights.clone(), |weights, jumps| jumps.gather(&weights));
            let influence = self.interior.influence(&all);
            (0..tangents).flat_map(|c| self.rows.iter().map(move |r| r + c)).map(|r| influence[r]).collect()
        };
        let followed = |weights| DisplacementSum { per_slip: slip(weights), loads: Vec::new() };
        let mut all: Vec<DisplacementSum> = sums.iter().map(followed).collect();
        for (amplitude, mut moved) in self.interior.loaded().filter(|(amplitude, _)| !amplitude.is_zero()) {
            self.jumps.iter().for_each(|jumps| jumps.displace(&mut moved));
            for (sum, weights) in all.iter_mut().zip(sums) {
                let value = weights.iter().map(|&(dof, weight)| weight * moved[dof]).sum();
                sum.loads.push((amplitude.clone(), value));
            }
        }
        all
    }

    /// Displacements of all nodes as vectors in space, as [`Self::displacement`].
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
