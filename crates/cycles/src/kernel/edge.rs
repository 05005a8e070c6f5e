//! Plane strain: a strip of constant slip between two edge dislocations.
//!
//! N. I. Muskhelishvili, "Some Basic Problems of the Mathematical Theory of Elasticity" (1953), chapters on the plane and the half-plane. With
//! ζ = x + i z and κ = 3 - 4 ν, two functions φ and ψ give
//!
//! ```text
//! 2 G (u_x + i u_z) = κ φ - ζ conj φ' - conj ψ
//! σ_xx + σ_zz = 4 Re φ',   σ_zz - σ_xx + 2 i σ_xz = 2 (conj(ζ) φ'' + ψ')
//! ```
//!
//! Slip s = s_x + i s_z of a strip from a to b has, with L = ln((ζ - a)/(ζ - b)) and A = -i G s/(π (κ + 1)),
//!
//! ```text
//! φ0 = A L,   ψ0 = conj(A) L - A (conj(a)/(ζ - a) - conj(b)/(ζ - b)).
//! ```
//!
//! These are singular in the lower half-plane only. With the notation F*(ζ) = conj F(conj ζ), the surface z = 0 is therefore
//! free of traction under φ0 + φ1, ψ0 + ψ1 with
//!
//! ```text
//! φ1 = -ζ φ0*' - ψ0*,   ψ1 = -φ0* - ζ φ1'.
//! ```
//!
//! This is the field of A. K. Head, Proc. Phys. Soc. B 66 (1953) 793, and of L. B. Freund and D. M. Barnett, Bull. Seism. Soc.
//! Am. 66 (1976) 667. Units are metres and pascals.

use super::segment::Segment;
use super::space::Space;
use asperity_fem::material::elastic::Elastic;
use nalgebra::Complex;
use std::f64::consts::PI;

type C = Complex<f64>;

/// Displacement and stress of plane strain at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inplane {
    /// Displacement u_x, u_z \[m\].
    pub displacement: [f64; 2],
    /// Stress σ_xx, σ_zz, σ_xz \[Pa\]; out of the plane it is ν (σ_xx + σ_zz).
    pub stress: [f64; 3],
}

/// Terms from which displacement and stress follow.
#[derive(Clone, Copy)]
struct Terms {
    /// 2 G (u_x + i u_z).
    motion: C,
    /// φ'.
    pressure: C,
    /// conj(ζ) φ'' + ψ'.
    deviator: C,
}

impl Segment {
    /// Displacement and stress at the position (x, z) \[m\], caused by slip \[m\] along the tangent and opening \[m\] along the
    /// normal.
    #[must_use]
    pub fn edge(&self, at: [f64; 2], [slip, opening]: [f64; 2], rock: &Elastic) -> Inplane {
        let zeta = C::new(at[0], at[1]);
        if self.misses(zeta) {
            return Inplane { displacement: [f64::NAN; 2], stress: [f64::NAN; 3] };
        }
        let ([t, n], kappa) = ([self.tangent(), self.normal()], 3.0 - 4.0 * rock.poisson());
        let jump = C::new(slip * t[0] + opening * n[0], slip * t[1] + opening * n[1]);
        let a = -C::i() * jump * (rock.shear() / (PI * (kappa + 1.0)));
        let mut all = self.direct(zeta, a, kappa);
        if self.space == Space::Half {
            let other = self.reflected(zeta, a, kappa);
            all.motion += other.motion;
            all.pressure += other.pressure;
            all.deviator += other.deviator;
        }
        all.evaluate(rock.shear())
    }

    /// Terms of φ0 and ψ0.
    fn direct(&self, zeta: C, a: C, kappa: f64) -> Terms {
        let [p, q] = self.ends.map(|end| zeta - end);
        let log = self.log_ratio(zeta);
        let slope = self.slope(p, q);
        let turned = p / p.conj() - q / q.conj();
        Terms {
            motion: a * (log * kappa - log.conj()) - a.conj() * turned,
            pressure: a * slope,
            deviator: a.conj() * slope - a * (p.conj() / (p * p) - q.conj() / (q * q)),
        }
    }

    /// Terms of φ1 and ψ1.
    fn reflected(&self, zeta: C, a: C, kappa: f64) -> Terms {
        let image = self.image();
        let [p, q] = image.ends.map(|end| zeta - end);
        let [above, beyond] = self.ends.map(|end| end.im);
        let twice = C::new(0.0, 2.0) * a.conj();
        let (log, slope) = (image.log_ratio(zeta), image.slope(p, q));
        let (p2, q2) = (p * p, q * q);
        let phi = -a * log + twice * (above / p - beyond / q);
        let first = -a * slope - twice * (above / p2 - beyond / q2);
        let second = a * (1.0 / p2 - 1.0 / q2) + twice * 2.0 * (above / (p2 * p) - beyond / (q2 * q));
        let lift = C::new(0.0, -2.0 * zeta.im);
        Terms {
            motion: phi * kappa + a * log.conj() + lift * first.conj(),
            pressure: first,
            deviator: -a.conj() * slope - first + lift * second,
        }
    }

    /// L' of distances p and q from the ends.
    fn slope(&self, p: C, q: C) -> C {
        (self.ends[0] - self.ends[1]) / (p * q)
    }
}

impl Terms {
    fn evaluate(self, shear: f64) -> Inplane {
        let (u, mean, half) = (self.motion / (2.0 * shear), 2.0 * self.pressure.re, self.deviator);
        Inplane { displacement: [u.re, u.im], stress: [mean - half.re, mean + half.re, half.im] }
    }
}
