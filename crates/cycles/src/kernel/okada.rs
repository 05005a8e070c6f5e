//! The functions of a corner of a rectangle: Y. Okada, Bull. Seism. Soc. Am. 82 (1992) 1018, table 6.
//!
//! Symbols are those of the paper. Gradients follow by the rules of differentiation, see [`Jet`], rather than from tables 7
//! to 9. Components are along strike, up dip and along the normal, each per slip and without the factor 1/(2π).
//!
//! X11, X32 and ln(R + ξ) are singular on the line η = q = 0, ξ < 0. There the functions -1/(R (R - ξ)),
//! -(2 R - ξ)/(R³ (R - ξ)²) and -ln(R - ξ) replace them, which differ by functions of η and q alone. These cancel between the
//! ends of a side, provided that both ends use the same form. The same holds for Y11, Y32 and ln(R + η).

use super::jet::Jet;
use super::leg::{Corner, beyond};

/// Three components of a displacement.
pub(super) type Triple = [Jet; 3];

/// Elastic constants as the table has them.
#[derive(Clone, Copy)]
pub(super) struct Constants {
    /// α = (λ + G)/(λ + 2 G).
    pub alpha: f64,
}

/// Functions of a corner.
pub(super) struct Functions {
    corner: Corner,
    /// y~.
    y: Jet,
    /// Height z of the point.
    z: Jet,
    x11: Jet,
    y11: Jet,
    ln_xi: Jet,
    ln_eta: Jet,
    theta: Jet,
    turned: [bool; 2],
}

/// Functions 1/(R (R + ξ)) and ln(R + ξ), or those that replace them.
fn along(r: Jet, xi: Jet, others: [Jet; 2], turned: bool) -> [Jet; 2] {
    if turned {
        let sum = r - xi;
        [-(r * sum).recip(), -sum.ln()]
    } else {
        let sum = beyond(r, xi, others[0], others[1]);
        [(r * sum).recip(), sum.ln()]
    }
}

/// X32 of X11, and so Y32 of Y11.
fn cubic(r: Jet, xi: Jet, x11: Jet, turned: bool) -> Jet {
    let sum = if turned { r * -2.0 + xi } else { r * 2.0 + xi };
    x11.squared() * sum / r
}

impl Functions {
    /// Functions of a corner at a point of height `z`. `turned` says for ξ and η whether all corners use the form for negative
    /// values.
    pub fn new(corner: Corner, z: Jet, turned: [bool; 2]) -> Self {
        let Corner { xi, eta, q, r, cos, sin, .. } = corner;
        let [x11, ln_xi] = along(r, xi, [eta, q], turned[0]);
        let [y11, ln_eta] = along(r, eta, [xi, q], turned[1]);
        // On the patch the angle is the mean of both sides.
        let angle = if q.value == 0.0 { 0.0 } else { (xi.value * eta.value / (q.value * r.value)).atan() };
        let fall = xi.gradient * y11.value + eta.gradient * x11.value;
        let rise = q.gradient * (xi.value * y11.value + eta.value * x11.value);
        let theta = Jet::new(angle, rise - fall * q.value);
        Self { corner, y: eta * cos + q * sin, z, x11, y11, ln_xi, ln_eta, theta, turned }
    }

    /// u_A of slip along strike, up dip and opening.
    pub fn a(&self, slip: [f64; 3], constants: Constants) -> Triple {
        let Corner { xi, eta, q, r, .. } = self.corner;
        let (x11, y11, theta) = (self.x11, self.y11, self.theta);
        let (half, rest) = (constants.alpha / 2.0, (1.0 - constants.alpha) / 2.0);
        let (q2, shared) = (q.squared(), q / r * half);
        let last = |ln: Jet, one: Jet| ln * rest - q2 * one * half;
        let whole = |ln: Jet, one: Jet| -(ln * rest + q2 * one * half);
        weighted(slip, |kind| match kind {
            0 => [theta * 0.5 + xi * q * y11 * half, shared, last(self.ln_eta, y11)],
            1 => [shared, theta * 0.5 + eta * q * x11 * half, last(self.ln_xi, x11)],
            _ => {
                let both = q * (eta * x11 + xi * y11);
                [whole(self.ln_eta, y11), whole(self.ln_xi, x11), theta * 0.5 - both * half]
            }
        })
    }

    /// u_B.
    pub fn b(&self, slip: [f64; 3], constants: Constants) -> Triple {
        let Corner { xi, eta, q, r, cos, sin, .. } = self.corner;
        let (x11, y11, theta) = (self.x11, self.y11, self.theta);
        let free = (1.0 - constants.alpha) / constants.alpha * sin;
        let [i3, i4] = self.corner.i3_i4();
        let (r_d, q2) = (self.corner.r_d(), q.squared());
        let flat = xi / r_d;
        weighted(slip, |kind| match kind {
            0 => {
                let (i1, i2) = (-(flat * cos + i4 * sin), r_d.ln() + i3 * sin);
                [-(xi * q * y11 + theta + i1 * free), self.y / r_d * free - q / r, q2 * y11 - i2 * free]
            }
            1 => {
                let free = free * cos;
                [i3 * free - q / r, -(eta * q * x11 + theta + flat * free), q2 * x11 + i4 * free]
            }
            _ => {
                let free = free * sin;
                let last = q * (eta * x11 + xi * y11) - theta - i4 * free;
                [q2 * y11 - i3 * free, q2 * x11 + flat * free, last]
            }
        })
    }

    /// u_C, which the displacement has times z.
    pub fn c(&self, slip: [f64; 3], Constants { alpha }: Constants) -> Triple {
        let Corner { xi, eta, q, r, d, cos, sin } = self.corner;
        let (rest, x11, y11) = (1.0 - alpha, self.x11, self.y11);
        let (x32, y32) = (cubic(r, xi, x11, self.turned[0]), cubic(r, eta, y11, self.turned[1]));
        let (one, depth, q2) = (r.recip(), d + self.z, q.squared());
        let third = one * one.squared();
        let z32 = third * sin - (q * cos - self.z) * y32;
        let near = depth * (x11 - q2 * x32);
        weighted(slip, |kind| match kind {
            0 => [
                xi * (y11 * (rest * cos) - q * z32 * alpha),
                (one * cos + q * y11 * (2.0 * sin)) * rest - depth * q * third * alpha,
                q * y11 * (rest * cos) - (depth * eta * third - self.z * y11 + xi.squared() * z32) * alpha,
            ],
            1 => [
                one * (rest * cos) - q * y11 * sin - depth * q * third * alpha,
                self.y * x11 * rest - depth * eta * q * x32 * alpha,
                -(d * x11 + xi * y11 * sin + near * alpha),
            ],
            _ => [
                -((one * sin + q * y11 * cos) * rest + (self.z * y11 - q2 * z32) * alpha),
                xi * y11 * (2.0 * rest * sin) + d * x11 - near * alpha,
                (self.y * x11 + xi * y11 * cos) * rest + q * (depth * eta * x32 + xi * z32) * alpha,
            ],
        })
    }
}

/// Sum over the kinds of slip that are not zero.
fn weighted(slip: [f64; 3], of: impl Fn(usize) -> Triple) -> Triple {
    let mut sum = [Jet::constant(0.0); 3];
    for (kind, &amount) in slip.iter().enumerate().filter(|(_, amount)| **amount != 0.0) {
        for (sum, term) in sum.iter_mut().zip(of(kind)) {
            *sum = *sum + term * amount;
        }
    }
    sum
}
