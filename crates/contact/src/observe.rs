//! Observable state of an interface: committed fields per slave point, balances and counts of operations.

use crate::status::Status;
use crate::vector::{dot, norm};
use serde::{Deserialize, Serialize};

/// Committed fields, one value per slave point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointFields<const D: usize> {
    /// Gap g_n \[m\], negative when penetrating, infinite if the point has no partner. Gaps of bonded points are counted from
    /// where they were tied.
    pub gap: Vec<f64>,
    /// Outward unit normal n of the master.
    pub normal: Vec<[f64; D]>,
    /// First tangent e_1: `(-n_y, n_x)` in two dimensions.
    pub tangent: Vec<[f64; D]>,
    /// Normal traction f_n \[Pa\], negative at bonded points only.
    pub normal_traction: Vec<f64>,
    /// Tangential traction t \[Pa\]; the force on the slave is `A (f_n n - t)`.
    pub shear: Vec<[f64; D]>,
    /// t·e_1 in two dimensions, |t| in three \[Pa\].
    pub shear_measure: Vec<f64>,
    /// Normal traction averaged with the shape function of the point, `∫ψ_A p/∫ψ_A`, with p the field of the tractions \[Pa\].
    /// It is the traction transmitted around the point. For node-to-point it equals the normal traction.
    pub mean_normal: Vec<f64>,
    /// Tangential traction averaged in the same way \[Pa\].
    pub mean_shear: Vec<[f64; D]>,
    /// Slip of the slave relative to the master along the surface since the law became active \[m\].
    pub slip: Vec<[f64; D]>,
    /// Slip along e_1 \[m\].
    pub slip_measure: Vec<f64>,
    /// Relative tangential displacement (elastic part plus slip) since the law became active \[m\].
    pub relative: Vec<[f64; D]>,
    /// Relative tangential displacement along e_1 \[m\].
    pub relative_measure: Vec<f64>,
    /// Slip increment of the last step \[m\].
    pub slip_increment: Vec<[f64; D]>,
    /// Slip rate V \[m/s\]: signed along e_1 in two dimensions, its magnitude in three.
    pub slip_rate: Vec<f64>,
    /// Friction \[-\]: |t| without radiation damping, over f_n; 0 if f_n = 0 or without friction.
    pub friction: Vec<f64>,
    /// Status of the point.
    pub status: Vec<Status>,
    /// State variables, point-major, `states_per_point` for each point.
    pub states: Vec<f64>,
    /// State variables per point.
    pub states_per_point: usize,
    /// Position of the slave node: reference in small sliding, current in finite \[m\].
    pub position: Vec<[f64; D]>,
    /// Tributary area \[m², m in two dimensions\].
    pub area: Vec<f64>,
}

impl<const D: usize> PointFields<D> {
    pub(crate) fn new(n: usize) -> Self {
        let scalars = || vec![0.0; n];
        let vectors = || vec![[0.0; D]; n];
        Self {
            gap: vec![f64::INFINITY; n],
            normal: vectors(),
            tangent: vectors(),
            normal_traction: scalars(),
            shear: vectors(),
            shear_measure: scalars(),
            mean_normal: scalars(),
            mean_shear: vectors(),
            slip: vectors(),
            slip_measure: scalars(),
            relative: vectors(),
            relative_measure: scalars(),
            slip_increment: vectors(),
            slip_rate: scalars(),
            friction: scalars(),
            status: vec![Status::Open; n],
            states: Vec::new(),
            states_per_point: 0,
            position: vectors(),
            area: scalars(),
        }
    }

    /// Area-weighted mean normal traction \[Pa\].
    #[must_use]
    pub fn mean_normal_traction(&self) -> f64 {
        let force: f64 = self.normal_traction.iter().zip(&self.area).map(|(f, a)| f * a).sum();
        force / self.area.iter().sum::<f64>()
    }

    /// Slip increments of the last step with the sign convention of slip rates: signed along e_1 in two dimensions, their
    /// magnitude in three \[m\].
    pub fn signed_increments(&self) -> impl Iterator<Item = f64> + '_ {
        let each = self.slip_increment.iter().zip(&self.tangent);
        each.map(|(s, t)| if D == 2 { dot(s, t) } else { norm(s) })
    }

    /// Largest penetration \[m\], 0 if nothing penetrates.
    #[must_use]
    pub fn largest_penetration(&self) -> f64 {
        self.gap.iter().fold(0.0, |m: f64, g| m.max(-g))
    }

    /// Number of points with this status.
    #[must_use]
    pub fn count(&self, status: Status) -> usize {
        self.status.iter().filter(|s| **s == status).count()
    }
}

/// Balance of the contact forces. Moments are about the origin, on reference positions in small sliding and on current
/// positions in finite sliding. In two dimensions only their last component is nonzero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance<const D: usize> {
    /// Total force on the slave side \[N, N/m in two dimensions\].
    pub slave_force: [f64; D],
    /// Total force on the master side \[N, N/m in two dimensions\].
    pub master_force: [f64; D],
    /// Sum of both, zero up to rounding.
    pub residual: [f64; D],
    /// Moment of all contact forces \[N m\].
    pub moment: [f64; 3],
    /// Couple Σ A g_n n × f of the pairs of forces, which act at x_s and x_c \[N m\].
    pub couple: [f64; 3],
    /// `moment - couple`, zero up to rounding.
    pub moment_residual: [f64; 3],
}

/// Counts of operations since construction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Searches (evaluations of the pairing).
    pub searches: u64,
    /// Searches skipped because no node had moved beyond the distance that the last search proved harmless.
    pub searches_skipped: u64,
    /// Closest-point projections on single segments during searches.
    pub projections: u64,
    /// Calls of the friction law (each on a slice of points).
    pub law_calls: u64,
    /// Augmentations of the multipliers.
    pub augmentations: u64,
    /// Evaluations of the residual.
    pub residuals: u64,
    /// Evaluations of the tangent.
    pub tangents: u64,
}
