//! Overlap of two straight lines in the plane, in closed form.
//!
//! Both are projected onto the slave's line, whose coordinate u runs from 0 to 1. The ends of the master then lie at `κ_0 > κ_1`, and
//! the overlap is `[α, β]` with `α = max(0, κ_1)`, `β = min(1, κ_0)`. With the functions λ of the slave and μ of the master, and the
//! reference length `ρ = L_0` (times 2 π r about an axis), the integrals `∫ λ_b λ_k ρ du` and `∫ λ_b μ_γ ρ du` depend on κ alone. A
//! moving end changes them by their integrands there, and `∂μ_1/∂κ_j = -μ_j/(κ_1 - κ_0) = -∂μ_0/∂κ_j`.

use super::facet::NODES;
use super::overlap::{Derivatives, Integrals};
use crate::vector::{axpy, dot, norm, scaled, sub};

/// Overlaps shorter than this share of the slave result from rounding of coinciding ends.
const SLIVER: f64 = 1e-15;

/// Two straight lines in the plane of the slave.
pub(super) struct Lines<'a, const D: usize> {
    /// Ends of the slave and of the master.
    x: [[f64; D]; 2],
    y: [[f64; D]; 2],
    /// Reference ends of the slave, and its reference length.
    reference: &'a [[f64; D]],
    reference_length: f64,
    /// Length of the slave, and unit vectors along and normal to it.
    length: f64,
    along: [f64; D],
    normal: [f64; D],
    /// Positions of the master's ends.
    kappa: [f64; 2],
    /// Ends of the overlap.
    from: f64,
    to: f64,
    axisymmetric: bool,
}

impl<'a, const D: usize> Lines<'a, D> {
    /// Projects the master with ends at `y` onto the slave with ends at `x`; `None` if they do not overlap.
    pub(super) fn new(
        x: [[f64; D]; 2],
        y: [[f64; D]; 2],
        reference: &'a [[f64; D]],
        axisymmetric: bool,
    ) -> Option<Self> {
        let side = sub(&x[1], &x[0]);
        let length = norm(&side);
        let along = scaled(&side, length.recip());
        let mut normal = [0.0; D];
        (normal[0], normal[1]) = (-along[1], along[0]);
        let kappa = y.map(|y| dot(&along, &sub(&y, &x[0])) / length);
        let from = if kappa[1] > 0.0 { kappa[1] } else { 0.0 };
        let to = if kappa[0] < 1.0 { kappa[0] } else { 1.0 };
        if to - from <= SLIVER {
            return None;
        }
        let reference_length = norm(&sub(&reference[1], &reference[0]));
        Some(Self { x, y, reference, reference_length, length, along, normal, kappa, from, to, axisymmetric })
    }

    /// Functions of the slave and of the master, and the reference length, at u.
    #[inline]
    fn at(&self, u: f64) -> ([f64; 2], [f64; 2], f64) {
        let [first, last] = self.kappa;
        let s = (u - first) / (last - first);
        let mut density = self.reference_length;
        if self.axisymmetric {
            density *= std::f64::consts::TAU * ((1.0 - u) * self.reference[0][0] + u * self.reference[1][0]);
        }
        ([1.0 - u, u], [1.0 - s, s], density)
    }

    /// Integrals over the overlap by this rule on [0, 1], which is exact with two points, or three about an axis.
    pub(super) fn integrals(&self, rule: &[[f64; 2]]) -> Integrals {
        let mut out = Integrals::zero();
        for [t, w] in rule {
            let (own, other, density) = self.at(self.from + (self.to - self.from) * t);
            let w = w * (self.to - self.from) * density;
            for b in 0..2 {
                for k in 0..2 {
                    out.own[b][k] += w * own[b] * own[k];
                    out.other[b][k] += w * own[b] * other[k];
                }
            }
        }
        out
    }

    /// Computes the derivatives of the integrals.
    pub(super) fn derivatives(&self, rule: &[[f64; 2]], out: &mut Derivatives<NODES>) {
        let values = self.integrals(rule);
        let span = self.kappa[1] - self.kappa[0];
        let slopes = self.slopes();
        // Ends that move, with the direction out of the overlap.
        let (first, last) = (self.at(self.to), self.at(self.from));
        let ends =
            [(self.kappa[0] < 1.0).then_some((first, 1.0)), (self.kappa[1] > 0.0).then_some((last, -1.0))];
        for b in 0..2 {
            for k in 0..2 {
                let turned = if k == 0 { 1.0 } else { -1.0 };
                let mut by = [[0.0; 2]; 2];
                for j in 0..2 {
                    by[1][j] = turned * values.other[b][j] / span;
                    if let Some(((own, other, density), sign)) = ends[j] {
                        by[0][j] += sign * density * own[b] * own[k];
                        by[1][j] += sign * density * own[b] * other[k];
                    }
                }
                for (to, slopes) in out.by.as_flattened_mut().iter_mut().zip(slopes.as_flattened()) {
                    for (l, to) in to.iter_mut().enumerate() {
                        to.own[b][k] = by[0][0] * slopes[0][l] + by[0][1] * slopes[1][l];
                        to.other[b][k] = by[1][0] * slopes[0][l] + by[1][1] * slopes[1][l];
                    }
                }
            }
        }
    }

    /// Derivatives of κ with respect to each node of both lines.
    fn slopes(&self) -> [[[[f64; 3]; 2]; NODES]; 2] {
        let share = self.length.recip();
        let mut out = [[[[0.0; 3]; 2]; NODES]; 2];
        let [own, other] = &mut out;
        for (j, (kappa, y)) in self.kappa.iter().zip(&self.y).enumerate() {
            let height = dot(&self.normal, &sub(y, &self.x[0]));
            let mut last = scaled(&self.normal, height * share * share);
            axpy(&mut last, -kappa * share, &self.along);
            for l in 0..D {
                let moved = share * self.along[l];
                own[1][j][l] = last[l];
                own[0][j][l] = -moved - last[l];
                other[j][j][l] = moved;
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SegmentKind;
    use crate::measure::mortar::cell::{ReferenceFacet, Sums, integrate};
    use crate::measure::mortar::facet::facets;
    use crate::measure::mortar::rule::Rules;
    use crate::measure::mortar::scalar::Dual;
    use crate::spec::Segment;
    use proptest::prelude::*;

    type Number = Dual<8>;

    /// The integrals of `cell` by numbers that carry derivatives.
    fn forward(
        ends: &[[f64; 2]; 4],
        reference: &[[f64; 2]; 2],
        axisymmetric: bool,
    ) -> Option<Sums<Number, NODES>> {
        let number = |k: usize, i: usize| {
            let mut d = [0.0; 8];
            d[2 * k + i] = 1.0;
            Dual { v: ends[k][i], d }
        };
        let x: Vec<[Number; 2]> = (0..4).map(|k| [number(k, 0), number(k, 1)]).collect();
        let facet =
            facets(&Segment { kind: SegmentKind::Seg2, nodes: vec![0, 1] }, None, reference).remove(0);
        let frozen = ReferenceFacet { facet: &facet, reference, axisymmetric };
        let mut sums = Sums::zero();
        integrate(frozen, &x[..2], &facet, &x[2..], Rules::new().rule(3), &mut sums).then_some(sums)
    }

    proptest! {
        #[test]
        fn integrals_and_derivatives_are_those_of_numbers_that_carry_derivatives(
            noise in prop::collection::vec(-0.4..0.4, 12),
            shift in -1.2..1.2,
            axisymmetric in any::<bool>(),
        ) {
            let moved = |k: usize, [a, b]: [f64; 2]| [a + noise[2 * k], b + noise[2 * k + 1]];
            let ends = [[2.0, 0.0], [3.0, 0.0], [3.1 + shift, -0.3], [1.9 + shift, -0.3]];
            let ends: [[f64; 2]; 4] = std::array::from_fn(|k| moved(k, ends[k]));
            let reference = [moved(4, [2.0, 0.0]), moved(5, [3.0, 0.0])];
            let expected = forward(&ends, &reference, axisymmetric);
            let lines = Lines::new([ends[0], ends[1]], [ends[2], ends[3]], &reference, axisymmetric);
            prop_assert_eq!(lines.is_some(), expected.is_some());
            let (Some(lines), Some(expected)) = (lines, expected) else { return Ok(()) };
            let rules = Rules::new();
            let (values, mut slopes) = (lines.integrals(&rules.rule(3).line), Derivatives::zero());
            lines.derivatives(&rules.rule(3).line, &mut slopes);
            for b in 0..2 {
                for k in 0..2 {
                    let pairs = [(values.own[b][k], expected.own[b][k]), (values.other[b][k], expected.other[b][k])];
                    for (value, number) in pairs {
                        prop_assert!((value - number.v).abs() < 1e-12 * (1.0 + number.v.abs()), "{} {}", b, k);
                    }
                    for node in 0..4 {
                        for l in 0..2 {
                            let by = &slopes.by[node / 2][node % 2][l];
                            let pairs = [(by.own[b][k], &expected.own[b][k]), (by.other[b][k], &expected.other[b][k])];
                            for (slope, number) in pairs {
                                let e = number.d[2 * node + l];
                                prop_assert!((slope - e).abs() < 1e-10 * (1.0 + e.abs()), "{} {} {}: {} {}", b, k, node, slope, e);
                            }
                        }
                    }
                }
            }
        }
    }
}
