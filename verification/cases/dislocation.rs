//! Stress of edge dislocations in the plane and below a free surface by complex potentials.
//!
//! In the plane `φ = A ln(z - z0)`, `ψ = Ā ln(z - z0) - A z̄0/(z - z0)` with `A = G b/(πi (κ + 1))` and κ = 3 - 4ν; the
//! potentials that remove the traction on the surface `y = 0` of the lower half-plane follow by reflection, `φ1 = -z φ̄' - ψ̄`
//! and `ψ1 = -φ̄ - z φ1'` (Muskhelishvili).

use nalgebra::{Complex, ComplexField};

type C = Complex<f64>;

/// Stresses \[Pa\].
#[derive(Clone, Copy, Debug, Default)]
pub struct Stress {
    pub xx: f64,
    pub yy: f64,
    pub xy: f64,
}

/// φ', φ'' and ψ' at `z` of a dislocation at `z0` in the plane.
fn direct(z: C, z0: C, a: C) -> ([C; 2], C) {
    let direct = (z - z0).inv();
    ([a * direct, -a * direct * direct], a.conj() * direct + a * z0.conj() * direct * direct)
}

/// A of a dislocation.
fn strength(b: C, shear_modulus: f64, poisson: f64) -> C {
    let kappa = 3.0 - 4.0 * poisson;
    b * shear_modulus / (C::i() * std::f64::consts::PI * (kappa + 1.0))
}

impl Stress {
    /// Adds the stress of φ', φ'' and ψ' at `z`.
    fn add(&mut self, z: C, phi: [C; 2], psi: C) {
        let sum = 4.0 * phi[0].re;
        let difference = (phi[1] * z.conj() + psi) * 2.0;
        self.xx += 0.5 * (sum - difference.re);
        self.yy += 0.5 * (sum + difference.re);
        self.xy += 0.5 * difference.imaginary();
    }

    /// Shear traction along `t`, and compression, on the plane whose normal is `n`.
    pub fn on(&self, t: [f64; 2], n: [f64; 2]) -> (f64, f64) {
        let on = [self.xx * n[0] + self.xy * n[1], self.xy * n[0] + self.yy * n[1]];
        (t[0] * on[0] + t[1] * on[1], -(n[0] * on[0] + n[1] * on[1]))
    }
}

/// Adds the stress at `z` of a dislocation at `z0` \[m\] in the plane whose displacement grows by `b` \[m\] in an anticlockwise
/// circuit.
pub fn add_in_plane(stress: &mut Stress, z: C, z0: C, b: C, shear_modulus: f64, poisson: f64) {
    let (phi, psi) = direct(z, z0, strength(b, shear_modulus, poisson));
    stress.add(z, phi, psi);
}

/// Adds the stress at `z` of a dislocation at `z0` \[m\] below the free surface `y = 0` whose displacement grows by `b` \[m\] in
/// an anticlockwise circuit.
pub fn add(stress: &mut Stress, z: C, z0: C, b: C, shear_modulus: f64, poisson: f64) {
    let a = strength(b, shear_modulus, poisson);
    let (ac, z0c) = (a.conj(), z0.conj());
    let (phi, psi) = direct(z, z0, a);
    // Reflected potentials and their derivatives.
    let mirror = (z - z0c).inv();
    let (m2, m3) = (mirror * mirror, mirror * mirror * mirror);
    let bar_phi = [ac * mirror, -ac * m2, ac * m3 * 2.0];
    let bar_psi = [a * mirror + ac * z0 * m2, -a * m2 - ac * z0 * m3 * 2.0];
    let phi1 = [-bar_phi[0] - z * bar_phi[1] - bar_psi[0], -bar_phi[1] * 2.0 - z * bar_phi[2] - bar_psi[1]];
    let psi1 = -bar_phi[0] - phi1[0] - z * phi1[1];
    stress.add(z, [phi[0] + phi1[0], phi[1] + phi1[1]], psi + psi1);
}
