//! Coulomb friction with optional cohesion and cap: F̄ = min(c + μ f_n, F_limit), an elastic domain, no rate and no state. Only closed
//! points are asked: cohesion c resists slip, never tension.

use crate::Failure;
use crate::evolution::{Bound, Parameter, Unit};
use crate::kind::{COHESION, Kind, TableLaw, values};
use crate::law::{Increments, Law, Limit, PresentStates, RateBounds, Rates, Regime, Responses, Trials};
use crate::yielding::{Cone, ConeStrength, all_finite, answer, at_strength, cap, first_exit, strength};

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coulomb {
    mu: f64,
    cohesion: f64,
    limit: f64,
}

impl Coulomb {
    /// Law with μ ≥ 0 and an optional largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(mu: f64, limit: Option<f64>) -> Result<Self, Failure> {
        Self::cohesive(mu, 0.0, limit)
    }

    /// Law with a cohesion c ≥ 0 \[Pa\] as well.
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn cohesive(mu: f64, cohesion: f64, limit: Option<f64>) -> Result<Self, Failure> {
        if !(mu >= 0.0 && mu.is_finite()) {
            return Err(Failure::Parameter { name: "mu", value: mu, admissible: "0 <= mu, finite" });
        }
        Ok(Self { mu, cohesion: crate::yielding::cohesion(cohesion)?, limit: cap(limit)? })
    }

    /// Strength F̄ and ∂F̄/∂f_n.
    pub(crate) fn strength(&self, normal: f64) -> ConeStrength {
        strength(Cone { mu: self.mu, cohesion: self.cohesion }, normal, self.limit)
    }
}

/// Smallest r in (0, 1] at which `|t + r Δt| = μ (f + r Δf)` with the point leaving the cone, for a point inside the cone (C ≤
/// 0). It follows from the squared equation `A r² + 2 B r + C = 0`, `A = Δt² - μ²Δf²`, `B = t·Δt - μ² f Δf`, `C = t² - μ² f²`.
/// The root is taken in the form without cancellation.
#[must_use]
pub fn cone_exit(t: [f64; 2], dt: [f64; 2], f: f64, df: f64, mu: f64) -> Option<f64> {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    // Products of sums: neither A nor C loses digits near the cone.
    let norm = |a: [f64; 2]| a[0].hypot(a[1]);
    let a = (norm(dt) - mu * df) * (norm(dt) + mu * df);
    let b = dot(t, dt) - mu * mu * f * df;
    let c = (norm(t) - mu * f) * (norm(t) + mu * f);
    // B² - A C = μ²|f Δt - Δf t|² - (t × Δt)², again as a product.
    let turn = (t[0] * dt[1] - t[1] * dt[0]).abs();
    let along = mu * norm([f * dt[0] - df * t[0], f * dt[1] - df * t[1]]);
    let discriminant = (along - turn) * (along + turn);
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let candidates =
        if b >= 0.0 { [-c / (b + root), -(b + root) / a] } else { [(root - b) / a, c / (root - b)] };
    candidates
        .into_iter()
        .filter(|&r| r > 0.0 && r <= 1.0 && f + r * df > 0.0)
        // d/dr of the squared equation is positive where the point leaves the cone.
        .filter(|&r| a * r + b > 0.0)
        .reduce(f64::min)
}

impl TableLaw for Coulomb {
    const KIND: Kind = Kind {
        name: "coulomb",
        meaning: "a constant coefficient",
        parameters: &[
            Parameter {
                key: "mu",
                unit: Unit::None,
                bound: Bound::NotNegative,
                optional: false,
                example: "0.6",
                meaning: "",
            },
            COHESION,
        ],
        capped: true,
        order: None,
    };

    fn build(own: &[f64], cap: Option<f64>) -> Result<Self, Failure> {
        let [mu, cohesion] = values(own)?;
        Self::cohesive(mu, cohesion, cap)
    }
}

impl Law for Coulomb {
    fn name(&self) -> &'static str {
        "coulomb"
    }

    fn states(&self) -> usize {
        0
    }

    fn has_elastic_domain(&self) -> bool {
        true
    }

    fn initial(&self, _states: &mut [f64]) {}

    fn slippery(&self) -> bool {
        self.mu == 0.0 && self.cohesion == 0.0
    }

    fn cohesion(&self, _point: usize) -> f64 {
        self.cohesion
    }

    fn coefficient(
        &self,
        _normal: &[f64],
        _rate: &[f64],
        _states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        mu.fill(self.mu);
        Ok(())
    }

    fn respond(&self, t: Trials<'_>, _old: &[f64], mut out: Responses<'_>) -> Result<(), Failure> {
        for k in 0..t.trial.len() {
            all_finite(k, t.normal[k], t.trial[k], &[])?;
            let strength = self.strength(t.normal[k]);
            answer(&t, k, strength.value, strength, &mut out);
        }
        Ok(())
    }

    fn rates(&self, present: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            let ConeStrength { value: strength, slope } = self.strength(present.normal[k]);
            (out.along[k], out.coupling[k], out.constant[k]) = match present.regime[k] {
                Regime::Stick => (1.0, 0.0, 0.0),
                Regime::Slip => (0.0, slope, strength - present.traction[k]),
            };
        }
        Ok(())
    }

    fn limit(&self, present: PresentStates<'_>, step: Increments<'_>, _bounds: RateBounds) -> Option<Limit> {
        first_exit(&present, &step, |_| Cone { mu: self.mu, cohesion: self.cohesion }, self.limit)
    }

    fn stands(&self, present: PresentStates<'_>, k: usize) -> bool {
        at_strength(&present, k, self.strength(present.normal[k]).value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exit_lies_on_the_cone_and_leads_outwards() {
        let (t, dt, f, df, mu) = ([0.3, -0.1], [1.5, 0.7], 1.0, -0.4, 0.6);
        let r = cone_exit(t, dt, f, df, mu).unwrap();
        let at = |r: f64| (t[0] + r * dt[0]).hypot(t[1] + r * dt[1]) - mu * (f + r * df);
        approx::assert_abs_diff_eq!(at(r), 0.0, epsilon = 1e-15);
        assert!(at(r + 1e-6) > 0.0 && at(r - 1e-6) < 0.0);
    }

    #[test]
    fn no_exit_when_unloading_within_the_cone() {
        assert_eq!(cone_exit([0.3, 0.0], [-0.2, 0.0], 1.0, 0.1, 0.6), None);
    }

    #[test]
    fn the_first_of_two_crossings_is_the_exit() {
        // Straight through the disc of radius 0.6: from rest inside, out at (0.6, 0).
        assert_eq!(cone_exit([0.0, 0.0], [1.2, 0.0], 1.0, 0.0, 0.6), Some(0.5));
        // A point on the cone that cuts through it leaves at the far side only.
        let far = cone_exit([-0.6, 0.0], [2.0, 0.0], 1.0, 0.0, 0.6).unwrap();
        approx::assert_relative_eq!(far, 0.6, max_relative = 1e-14);
        // A cone that shrinks to nothing is an opening.
        assert_eq!(cone_exit([0.0, 0.0], [0.0, 0.0], 1.0, -1.0, 0.6), None);
        // Linear equation: the traction grows exactly as fast as the cone, along another direction.
        let r = cone_exit([0.5, 0.0], [0.6, 0.0], 1.0, 1.0, 0.6);
        assert_eq!(r, None);
    }

    #[test]
    fn a_distance_of_the_last_digits_is_resolved() {
        // The stable form keeps the relative precision of a root where the usual form has none left.
        let gap = 1e-13;
        let r = cone_exit([0.6 - gap, 0.0], [1.0, 0.0], 1.0, 0.0, 0.6).unwrap();
        approx::assert_relative_eq!(r, 0.6 - (0.6 - gap), max_relative = 1e-12);
    }

    fn respond(law: &Coulomb, normal: f64, trial: f64, lag: Option<f64>) -> [f64; 5] {
        let (mut t, mut s, mut v, mut g) = ([0.0], [0.0], [0.0], [Regime::Slip]);
        let (mut by_trial, mut by_normal) = ([0.0], [0.0]);
        let offset = [lag.unwrap_or_default()];
        law.respond(
            Trials {
                points: &[0],
                normal: &[normal],
                trial: &[trial],
                stiffness: 4.0,
                dt: 0.5,
                damping: 0.0,
                lag: lag.map(|_| crate::law::Lag { weight: &[1.5], offset: &offset }),
                near: None,
            },
            &[],
            Responses {
                traction: &mut t,
                slip: &mut s,
                rate: &mut v,
                regime: &mut g,
                d_trial: &mut by_trial,
                d_normal: &mut by_normal,
                states: &mut [],
            },
        )
        .unwrap();
        [t[0], s[0], v[0], by_trial[0], by_normal[0]]
    }

    #[test]
    fn the_point_return_is_that_of_perfect_plasticity() {
        let law = Coulomb::new(0.5, Some(3.0)).unwrap();
        assert_eq!(respond(&law, 2.0, 0.75, None), [0.75, 0.0, 0.0, 1.0, 0.0]);
        assert_eq!(respond(&law, 2.0, 3.0, None), [1.0, 0.5, 1.0, 0.0, 0.5]);
        assert_eq!(respond(&law, 2.0, 3.0, Some(0.25)), [1.0, 0.5, 1.25, 0.0, 0.5]);
        assert_eq!(respond(&law, 8.0, 5.0, None), [3.0, 0.5, 1.0, 0.0, 0.0]);
        // Without normal traction everything slips; without drive nothing does.
        assert_eq!(respond(&law, 0.0, 2.0, None), [0.0, 0.5, 1.0, 0.0, 0.5]);
        assert_eq!(respond(&law, 0.0, 0.0, None), [0.0, 0.0, 0.0, 1.0, 0.0]);
    }

    #[test]
    fn parameters_out_of_range_are_refused() {
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            let refused = Coulomb::cohesive(0.5, bad, None);
            assert!(matches!(refused, Err(Failure::Parameter { name: "cohesion", .. })));
        }
        for (mu, limit) in
            [(-0.1, None), (f64::NAN, None), (f64::INFINITY, None), (0.5, Some(0.0)), (0.5, Some(f64::NAN))]
        {
            assert!(matches!(Coulomb::new(mu, limit), Err(Failure::Parameter { .. })));
        }
    }

    proptest::proptest! {
        /// The point is inside the cone up to the exit and outside just after it; without an exit it does not cross the cone.
        #[test]
        fn exits_are_first_crossings(
            angle in 0.0f64..6.3,
            share in 0.0f64..0.999,
            dt0 in -3.0f64..3.0,
            dt1 in -3.0f64..3.0,
            df in -0.9f64..3.0,
            mu in 0.05f64..2.0,
        ) {
            let t = [share * mu * angle.cos(), share * mu * angle.sin()];
            let outside = |r: f64| (t[0] + r * dt0).hypot(t[1] + r * dt1) - mu * (1.0 + r * df);
            let exit = cone_exit(t, [dt0, dt1], 1.0, df, mu);
            if let Some(r) = exit {
                proptest::prop_assert!(outside(r).abs() < 1e-12, "{r}: {}", outside(r));
            }
            for k in 1..100 {
                let r = f64::from(k) / 100.0 * exit.unwrap_or(1.0);
                proptest::prop_assert!(outside(r) <= 1e-12, "{r} before {exit:?}: {}", outside(r));
            }
        }
    }
}
