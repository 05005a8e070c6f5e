//! Plane stress for any material: the strain increment through the thickness follows from σ_zz = 0.
//!
//! σ_zz increases monotonically with ε_zz (its slope lies between the bulk modulus and the elastic one for J2), so a Newton
//! iteration inside a bracket always converges. The in-plane tangent is the condensed one, C - C_:z C_z:/C_zz.

use super::constitutive::{ConstitutiveLaw, Moduli, Voigt};
use super::maxwell::MOST_ELEMENTS;

/// Longest history of a material.
pub const MOST_HISTORY: usize = 6 * (MOST_ELEMENTS - 1);

/// Number of halvings that exhaust the digits of a bracket.
const MOST_ITERATIONS: usize = 80;

/// As [`ConstitutiveLaw::update`], with `strain[2]` such that σ_zz = 0; returns the strain used. The state must have σ_zz = 0 and
/// no shear across the plane.
pub fn update<M: ConstitutiveLaw>(
    material: &M,
    dt: f64,
    strain: &Voigt,
    stress: &mut Voigt,
    history: &mut [f64],
    moduli: Option<&mut Moduli>,
) -> Voigt {
    let old = *stress;
    let mut kept = [0.0; MOST_HISTORY];
    kept[..history.len()].copy_from_slice(history);
    let mut strain = *strain;
    let mut c = [[0.0; 6]; 6];
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for _ in 0..MOST_ITERATIONS {
        *stress = old;
        history.copy_from_slice(&kept[..history.len()]);
        material.update(dt, &strain, stress, history, Some(&mut c));
        let scale = c[2][2] * strain.iter().fold(0.0, |m: f64, e| m.max(e.abs()))
            + old.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
        // The caller refuses values that are not finite.
        if stress[2].abs() <= f64::EPSILON * scale || !stress[2].is_finite() {
            break;
        }
        if stress[2] > 0.0 {
            high = strain[2];
        } else {
            low = strain[2];
        }
        let newton = strain[2] - stress[2] / c[2][2];
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if next == strain[2] || !next.is_finite() {
            break;
        }
        strain[2] = next;
    }
    stress[2] = 0.0;
    if let Some(out) = moduli {
        *out = condensed(&c);
    }
    strain
}

/// C - C_:z C_z:/C_zz: the tangent at σ_zz = 0.
#[must_use]
pub fn condensed(c: &Moduli) -> Moduli {
    let mut out = *c;
    for (i, row) in out.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = if i == 2 || j == 2 { 0.0 } else { c[i][j] - c[i][2] * c[2][j] / c[2][2] };
        }
    }
    out
}
