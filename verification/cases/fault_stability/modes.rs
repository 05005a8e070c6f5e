//! Modes of slip: eigenvectors of the operator of the bodies under the interface mass.

use crate::CaseError;
use asperity_plan::faults::Plan;
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// A mode.
pub struct Mode {
    /// Traction over slip \[Pa/m\].
    pub stiffness: f64,
    /// Slip of the points, with a root mean square of √(1/2), or 1 if it is uniform.
    pub shape: Vec<f64>,
    /// Tributary areas, scaled so that the amplitude of the shape is 1.
    weights: Vec<f64>,
}

impl Mode {
    /// Amplitude of the mode in `values`.
    pub fn amplitude(&self, values: &[f64]) -> f64 {
        values.iter().zip(&self.weights).zip(&self.shape).map(|((v, w), c)| v * w * c).sum()
    }

    /// Magnitude of the projection of cos(n π y/W) on the mode.
    pub fn cosine(&self, plan: &Plan, n: usize) -> f64 {
        let cosine: Vec<f64> =
            plan.points.iter().map(|p| (PI * n as f64 * p.at[1] / super::WIDTH).cos()).collect();
        self.amplitude(&cosine).abs()
    }
}

/// The `count` softest modes, softest first.
pub fn softest(plan: &Plan, count: usize) -> Result<Vec<Mode>, CaseError> {
    let n = plan.points.len();
    let mut unit = vec![0.0; n];
    let root: Vec<f64> = plan.points.iter().map(|p| p.area.sqrt()).collect();
    let mut matrix = DMatrix::zeros(n, n);
    for j in 0..n {
        unit[j] = 1.0;
        let column = plan.problem.fault.operator.shear_of(&unit);
        unit[j] = 0.0;
        for (i, (traction, r)) in column.iter().zip(&root).enumerate() {
            matrix[(i, j)] = -r * traction / root[j];
        }
    }
    let symmetric = 0.5 * (&matrix + matrix.transpose());
    let eigen = symmetric.symmetric_eigen();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    if order.len() < count {
        return Err("fewer points than modes".into());
    }
    let length: f64 = plan.points.iter().map(|p| p.area).sum();
    let mode = |(number, &k): (usize, &usize)| {
        let square = if number == 0 { length } else { 0.5 * length };
        let shape: Vec<f64> = (0..n).map(|p| eigen.eigenvectors[(p, k)] * square.sqrt() / root[p]).collect();
        let weights = plan.points.iter().map(|p| p.area / square).collect();
        Mode { stiffness: eigen.eigenvalues[k], shape, weights }
    };
    Ok(order.iter().take(count).enumerate().map(mode).collect())
}
