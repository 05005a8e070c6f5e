//! Stress of edge dislocations below a free surface by complex potentials.
//!
//! In the plane `φ = A ln(z - z0)`, `ψ = Ā ln(z - z0) - A z̄0/(z - z0)` with `A = G b/(πi (κ + 1))` and κ = 3 - 4ν; the potentials that
//! free the surface `y = 0` of the lower half-plane follow by reflection, `φ1 = -z φ̄' - ψ̄` and `ψ1 = -φ̄ - z φ1'` (Muskhelishvili).

use nalgebra::{Complex, ComplexField};

type C = Complex<f64>;

/// Stresses \[Pa\].
#[derive(Clone, Copy, Debug, Default)]
pub struct Stress {
    pub xx: f64,
    pub yy: f64,
    pub xy: f64,
}

/// Adds the stress at `z` of a dislocation at `z0` \[m\] whose displacement grows by `b` \[m\] in an anticlockwise circuit.
pub fn add(stress: &mut Stress, z: C, z0: C, b: C, shear_modulus: f64, poisson: f64) {
    let kappa = 3.0 - 4.0 * poisson;
    let a = b * shear_modulus / (C::i() * std::f64::consts::PI * (kappa + 1.0));
    let (ac, z0c) = (a.conj(), z0.conj());
    let direct = (z - z0).inv();
    let phi = [a * direct, -a * direct * direct];
    let psi = ac * direct + a * z0c * direct * direct;
    // Reflected potentials and their derivatives.
    let mirror = (z - z0c).inv();
    let (m2, m3) = (mirror * mirror, mirror * mirror * mirror);
    let bar_phi = [ac * mirror, -ac * m2, ac * m3 * 2.0];
    let bar_psi = [a * mirror + ac * z0 * m2, -a * m2 - ac * z0 * m3 * 2.0];
    let phi1 = [-bar_phi[0] - z * bar_phi[1] - bar_psi[0], -bar_phi[1] * 2.0 - z * bar_phi[2] - bar_psi[1]];
    let psi1 = -bar_phi[0] - phi1[0] - z * phi1[1];
    let sum = 4.0 * (phi[0] + phi1[0]).re;
    let difference = ((phi[1] + phi1[1]) * z.conj() + psi + psi1) * 2.0;
    stress.xx += 0.5 * (sum - difference.re);
    stress.yy += 0.5 * (sum + difference.re);
    stress.xy += 0.5 * difference.imaginary();
}
