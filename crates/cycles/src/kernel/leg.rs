//! Two functions of a corner that the free surface contributes, for any dip.
//!
//! They are I3 and I4 of Y. Okada, Bull. Seism. Soc. Am. 82 (1992) 1018, table 6, with c = cos δ, s = sin δ,
//!
//! ```text
//! I3 = y~/(c (R + d~)) - (ln(R + η) - s ln(R + d~))/c²
//! I4 = s ξ/(c (R + d~)) + 2/c² atan[(η (X + q c) + X (R + X) s)/(ξ (R + X) c)],   X² = ξ² + q².
//! ```
//!
//! These forms lose all digits where c is small. With k = (η c/(1 + s) + q)/(R + η), one has R + d~ = (R + η)(1 - c k),
//! and
//!
//! ```text
//! I3 = (d~/(R + d~) - ln(R + d~))/(1 + s) + k² Q(c k),   Q(e) = 1/(e (1 - e)) + ln(1 - e)/e² = Σ (n + 1)/(n + 2) e^n.
//! ```
//!
//! Up to terms without η, which cancel between the ends of a side, the inverse tangent in I4 is -atan(c M). Here M is
//! ξ/N, and N = (R + η)(1 + s) - q c. The terms of order 1/c cancel analytically, which leaves
//!
//! ```text
//! I4 = M (q (2 - s) - c (R (2 + s) + η s)/(1 + s))/(R + d~) + 2 c M³ T(c M),   T(m) = (m - atan m)/m³.
//! ```
//!
//! Both are free of cancellation for all 0 ≤ s ≤ 1, vertical sides included.

use super::jet::Jet;

/// Position of a point relative to one end of a side that rises with cosine c and sine s, in Okada's coordinates.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub xi: Jet,
    pub eta: Jet,
    pub q: Jet,
    /// Distance R.
    pub r: Jet,
    /// d~ = η s - q c.
    pub d: Jet,
    pub cos: f64,
    pub sin: f64,
}

impl Corner {
    /// R + η, without cancellation where η is negative.
    pub fn r_eta(&self) -> Jet {
        beyond(self.r, self.eta, self.xi, self.q)
    }

    /// R + d~ \[m\].
    pub fn r_d(&self) -> Jet {
        self.r + self.d
    }

    /// I3 \[-\] and I4 \[-\].
    pub fn i3_i4(&self) -> [Jet; 2] {
        let (c, s) = (self.cos, self.sin);
        let (r_eta, r_d) = (self.r_eta(), self.r_d());
        let k = (self.eta * (c / (1.0 + s)) + self.q) / r_eta;
        let depth = (self.d / r_d - r_d.ln()) * (1.0 / (1.0 + s));
        let i3 = depth + k.squared() * q_of(k * c);
        let m = self.xi / (r_eta * (1.0 + s) - self.q * c);
        let sum = self.q * (2.0 - s) - (self.r * (2.0 + s) + self.eta * s) * (c / (1.0 + s));
        let i4 = m * sum / r_d + m * m.squared() * t_of(m * c) * (2.0 * c);
        [i3, i4]
    }
}

/// R + η, where R² = η² + ξ² + q²; for negative η it is computed as (ξ² + q²)/(R - η).
pub(super) fn beyond(r: Jet, eta: Jet, xi: Jet, q: Jet) -> Jet {
    if eta.value < 0.0 { (xi.squared() + q.squared()) / (r - eta) } else { r + eta }
}

/// Argument below which Q and T are summed as series: closed forms lose few digits above it.
const SERIES: f64 = 0.25;
/// Terms after which both series have full precision below that argument.
const TERMS: u32 = 30;

/// Q(e) = 1/(e (1 - e)) + ln(1 - e)/e².
fn q_of(e: Jet) -> Jet {
    let x = e.value;
    if x.abs() < SERIES {
        let of = |n: u32| f64::from(n + 1) / f64::from(n + 2);
        let (value, slope) = sum(x, TERMS, of);
        return e.map(value, slope);
    }
    let rest = 1.0 / (1.0 - x);
    let value = (rest + (-x).ln_1p() / x) / x;
    e.map(value, (rest * rest - 2.0 * value) / x)
}

/// T(m) = (m - atan m)/m³.
fn t_of(m: Jet) -> Jet {
    let x = m.value;
    if x.abs() < SERIES {
        let of = |n: u32| f64::from(1 - 2 * (n as i32 % 2)) / f64::from(2 * n + 3);
        let (value, slope) = sum(x * x, TERMS / 2, of);
        return m.map(value, 2.0 * x * slope);
    }
    let value = (1.0 - x.atan() / x) / (x * x);
    m.map(value, (1.0 / (1.0 + x * x) - 3.0 * value) / x)
}

/// Sum of a power series and its derivative.
fn sum(x: f64, terms: u32, coefficient: impl Fn(u32) -> f64) -> (f64, f64) {
    (0..terms).rev().fold((0.0, 0.0), |(value, slope), n| (value * x + coefficient(n), slope * x + value))
}

#[cfg(test)]
mod tests {
    use super::{Corner, Jet, SERIES, q_of, t_of};
    use nalgebra::Vector3;

    fn corner(eta: f64, dip: f64) -> Corner {
        let (xi, q, (sin, cos)) = (0.7f64, -1.3f64, dip.sin_cos());
        let [xi, eta, q] = [xi, eta, q].map(Jet::constant);
        let r = (xi.squared() + eta.squared() + q.squared()).sqrt();
        Corner { xi, eta, q, r, d: eta * sin - q * cos, cos, sin }
    }

    /// I3 and I4 as Okada prints them.
    fn printed(corner: &Corner) -> [f64; 2] {
        let (c, s) = (corner.cos, corner.sin);
        let [xi, eta, q, r, d] = [corner.xi, corner.eta, corner.q, corner.r, corner.d].map(|jet| jet.value);
        let (x, y) = (xi.hypot(q), eta * c + q * s);
        let i3 = y / (c * (r + d)) - ((r + eta).ln() - s * (r + d).ln()) / (c * c);
        let angle = ((eta * (x + q * c) + x * (r + x) * s) / (xi * (r + x) * c)).atan();
        [i3, s * xi / (c * (r + d)) + 2.0 * angle / (c * c)]
    }

    #[test]
    fn differences_between_ends_are_those_of_the_printed_functions() {
        for dip in [0.1, 0.7, 1.2] {
            let ends = [1.1, 2.6].map(|eta| corner(eta, dip));
            let [far, near] = ends.map(|end| end.i3_i4().map(|jet| jet.value));
            let [a, b] = ends.map(|end| printed(&end));
            for k in 0..2 {
                let (found, wanted) = (near[k] - far[k], b[k] - a[k]);
                assert!((found - wanted).abs() < 1e-12 * wanted.abs(), "{dip} {k}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn series_continue_the_closed_forms_with_their_slopes() {
        let at = |x: f64| Jet::new(x, Vector3::x());
        for of in [q_of, t_of] {
            for edge in [SERIES, -SERIES] {
                let [inside, outside] = [edge * (1.0 - 1e-12), edge].map(|x| of(at(x)));
                assert!((inside.value - outside.value).abs() < 1e-11);
                assert!((inside.gradient.x - outside.gradient.x).abs() < 1e-10);
            }
            for x in [-3.0, -0.2, 0.0, 0.1, 0.6] {
                let slope = (of(at(x + 1e-5)).value - of(at(x - 1e-5)).value) / 2e-5;
                assert!((of(at(x)).gradient.x - slope).abs() < 1e-8, "{x}");
            }
        }
    }
}
