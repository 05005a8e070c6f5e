//! Elastic energy of a condensed body, and works on what is eliminated, from its retained displacements alone.
//!
//! With w_c the displacements of channel c at unit amplitude, and Φ those of the retained ones, `u = Φ u_i + Σ_c α_c w_c`. Since Φ
//! is in balance inside, `Φᵀ K Φ = S`, and `Φᵀ K w_c` is h_c for motions and vanishes for loads. With
//!
//! ```text
//! F_cd = f_c·w_d,    Q_cd = w_c·K w_d
//! ```
//!
//! the elastic energy is `½ u_i·S u_i + Σ α_c h_c·u_i (motions) + ½ Σ α_c α_d Q_cd`. The load c does the work `-h_c·du_i + Σ_d F_cd
//! dα_d` at unit amplitude, and the motion c at its reactions `h_c·u_i + Σ_d (Q_cd - F_dc) α_d` per amplitude. These are exact, and
//! cost a scalar product per channel, where recovering the displacements costs a solve.

use super::CondensedBody;
use crate::dof::Channel;
use crate::product::multiply_symmetric;
use faer::MatRef;

/// Products of the channels of a condensed body, each of which has loads or motions.
#[derive(Clone, Debug, Default)]
pub struct ChannelWorks {
    /// True for channels of loads.
    loads: Vec<bool>,
    /// F_cd, row by row \[J\].
    forces: Vec<f64>,
    /// Q_cd, row by row \[J\].
    energies: Vec<f64>,
}

impl ChannelWorks {
    /// Products of the channels that `body` has; `internal` gives the internal forces of displacements of the whole body. It takes
    /// a solve and a product with the stiffness for each channel.
    #[must_use]
    pub fn new(body: &CondensedBody, channels: &[Channel], internal: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let retained = vec![0.0; body.system_size()];
        let unit = |c: usize| (0..channels.len()).map(move |d| if d == c { 1.0 } else { 0.0 });
        let moved: Vec<Vec<f64>> = (0..channels.len()).map(|c| body.recovered(&retained, unit(c))).collect();
        let load = |c: &Channel, w: &[f64]| c.forces.iter().map(|&(dof, f)| f * w[dof]).sum::<f64>();
        Self {
            loads: channels.iter().map(|c| !c.forces.is_empty()).collect(),
            forces: channels.iter().flat_map(|c| moved.iter().map(move |w| load(c, w))).collect(),
            energies: moved
                .iter()
                .map(|w| internal(w))
                .flat_map(|force| moved.iter().map(move |w| dot(w, &force)).collect::<Vec<_>>())
                .collect(),
        }
    }

    /// Elastic energy \[J\] in a state, given by the displacements of the system \[m\] and the time \[s\].
    #[must_use]
    pub fn elastic(&self, body: &CondensedBody, at: (&[f64], f64)) -> f64 {
        let n = self.loads.len();
        let local: Vec<f64> = body.pattern.dofs().iter().map(|&dof| at.0[dof]).collect();
        let amplitudes = amplitudes(body, at.1);
        let mut energy = 0.5 * body.retained_work(&local);
        for (c, alpha) in amplitudes.iter().enumerate() {
            if !self.loads[c] {
                energy += alpha * dot(&body.loads[c].retained, &local);
            }
            let row = &self.energies[c * n..(c + 1) * n];
            energy += 0.5 * alpha * dot(row, &amplitudes);
        }
        energy
    }

    /// Works of the loads, and of the motions of the interior, from one state to another by the trapezoidal rule \[J\].
    #[must_use]
    pub fn works(&self, body: &CondensedBody, from: (&[f64], f64), to: (&[f64], f64)) -> [f64; 2] {
        let n = self.loads.len();
        let combined = |a: f64, b: f64| -> Vec<f64> {
            body.pattern.dofs().iter().map(|&dof| a * from.0[dof] + b * to.0[dof]).collect()
        };
        let (moved, mean) = (combined(-1.0, 1.0), combined(0.5, 0.5));
        let (before, after) = (amplitudes(body, from.1), amplitudes(body, to.1));
        let (mut loads, mut motions) = (0.0, 0.0);
        for c in 0..n {
            let h = &body.loads[c].retained;
            if self.loads[c] {
                let shifts = (0..n).map(|d| self.forces[c * n + d] * (after[d] - before[d]));
                loads += 0.5 * (before[c] + after[c]) * (shifts.sum::<f64>() - dot(h, &moved));
            } else {
                let stiffness = |d: usize| self.energies[c * n + d] - self.forces[d * n + c];
                let own = (0..n).map(|d| 0.5 * stiffness(d) * (before[d] + after[d]));
                motions += (after[c] - before[c]) * (own.sum::<f64>() + dot(h, &mean));
            }
        }
        [loads, motions]
    }
}

impl CondensedBody {
    /// Number of degrees of freedom of the system up to the last retained one.
    fn system_size(&self) -> usize {
        self.pattern.dofs().iter().max().map_or(0, |last| last + 1)
    }

    /// `u_i·S u_i`. The product is that of the last residual if it was evaluated there.
    fn retained_work(&self, local: &[f64]) -> f64 {
        if self.local == local {
            return dot(local, &self.forces);
        }
        let mut forces = vec![0.0; local.len()];
        let schur = MatRef::from_column_major_slice(&self.reduction.schur, local.len(), local.len());
        multiply_symmetric(schur, local, &mut forces);
        dot(local, &forces)
    }
}

fn amplitudes(body: &CondensedBody, time: f64) -> Vec<f64> {
    body.loads.iter().map(|load| load.amplitude.value(time)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
