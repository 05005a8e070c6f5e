//! Slip in two directions: friction of a plane on which the slip vector may turn.
//!
//! Friction acts along slip; its magnitude is that of the law with V = |V|. With the unit direction d, `V = V d`, the unknown of a
//! point is the vector `m d`, m = |μ|/a, and the driving traction is `t = f_n a m d + η V d`. Its rate, along d and along e normal to
//! d,
//!
//! ```text
//! t'·d = f_n a m' + f_n' a m + η V',        t'·e = (f_n a m + η V) ω,        d' = ω e,
//! ```
//!
//! gives the equation of a slider whose direction is fixed, and the rate ω at which slip turns. Vectors are stored component by
//! component: the first components of all points, then the second. Where m vanishes there is no direction. Each component then obeys
//! the equation of the slider by itself, since V(m) is odd and smooth there.

use crate::Failure;
use crate::fault::{Drive, FaultLaw, UnknownRates, Unknowns};
use crate::points::Components;
use crate::slider::Forcing;
use std::sync::{Mutex, PoisonError};

/// Components of slip.
const COMPONENTS: usize = 2;

/// A law of points whose slip may turn; see the module.
#[derive(Debug)]
pub struct VariableRake {
    law: Box<dyn FaultLaw>,
    scratch: Mutex<Scratch>,
}

/// Working memory of an evaluation.
#[derive(Debug)]
struct Scratch {
    /// m = |μ|/a.
    size: Vec<f64>,
    /// |V| \[m/s\].
    speed: Vec<f64>,
    /// Rate of the driving traction along slip \[Pa/s\].
    along: Vec<f64>,
    /// Unknowns of one point, and their rates.
    point: [Vec<f64>; 2],
}

impl VariableRake {
    /// Slip that turns, with the friction of a law of slip along a line.
    #[must_use]
    pub fn new(law: Box<dyn FaultLaw>) -> Self {
        let zeros = |n: usize| vec![0.0; n];
        let (n, states) = (law.points(), law.states());
        let point = [zeros(1 + states), zeros(1 + states)];
        let scratch = Scratch { size: zeros(n), speed: zeros(n), along: zeros(n), point };
        Self { law, scratch: Mutex::new(scratch) }
    }
}

/// Magnitude of a vector of two components; exact for a vector along an axis.
#[inline]
fn size(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Rates of both components of m, which grows along its direction and turns towards the pull: m ω, with V/m in the resistance, which has a
/// limit where both vanish.
#[inline]
fn turned([c, d]: [f64; 2], pull: [f64; 2], grown: f64, resistance: f64) -> (f64, f64) {
    let across = c * pull[1] - d * pull[0];
    let turned = across / resistance;
    (grown * c - turned * d, grown * d + turned * c)
}

impl FaultLaw for VariableRake {
    fn points(&self) -> usize {
        self.law.points()
    }

    fn components(&self) -> usize {
        COMPONENTS
    }

    fn states(&self) -> usize {
        self.law.states()
    }

    fn slip_rates(&self, now: Unknowns<'_>, mut rate: Components<&mut [f64]>) {
        let mut scratch = self.scratch.lock().unwrap_or_else(PoisonError::into_inner);
        let Scratch { size: sizes, speed, .. } = &mut *scratch;
        let n = self.points();
        let [x, y] = [now.m.component(0), now.m.component(1)];
        sizes.iter_mut().zip(x).zip(y).for_each(|((s, x), y)| *s = size(*x, *y));
        let sizes = Components::new(sizes.as_slice(), n);
        self.law.slip_rates(Unknowns { m: sizes, ..now }, Components::new(speed, n));
        let [along, across] = rate.pair_mut();
        let sizes = sizes.all();
        for k in 0..n {
            let (s, v) = (sizes[k], speed[k]);
            (along[k], across[k]) = if s > 0.0 { (x[k] / s * v, y[k] / s * v) } else { (0.0, 0.0) };
        }
    }

    fn rates(&self, drive: Drive<'_>, now: Unknowns<'_>, mut rates: UnknownRates<'_>) {
        let mut scratch = self.scratch.lock().unwrap_or_else(PoisonError::into_inner);
        let Scratch { size: sizes, speed, along, point } = &mut *scratch;
        let n = self.points();
        let [x, y] = [now.m.component(0), now.m.component(1)];
        let [pull_x, pull_y] = [drive.shear_rate.component(0), drive.shear_rate.component(1)];
        for k in 0..n {
            let s = size(x[k], y[k]);
            sizes[k] = s;
            // The first axis serves as the direction if nothing slides.
            along[k] = if s > 0.0 { (x[k] * pull_x[k] + y[k] * pull_y[k]) / s } else { pull_x[k] };
        }
        let line = Unknowns { m: Components::new(sizes.as_slice(), n), ..now };
        let driven = Drive { shear_rate: Components::new(along.as_slice(), n), ..drive };
        let [dx, dy] = rates.m.pair_mut();
        self.law.rates(driven, line, UnknownRates { m: Components::new(dx, n), states: rates.states });
        self.law.slip_rates(line, Components::new(speed, n));
        for k in 0..n {
            let s = line.m.all()[k];
            if s > 0.0 {
                let resistance = drive.normal[k] * self.law.scale(k) + drive.damping[k] * speed[k] / s;
                (dx[k], dy[k]) = turned([x[k] / s, y[k] / s], [pull_x[k], pull_y[k]], dx[k], resistance);
            } else {
                let [unknowns, rates] = point.each_mut();
                unknowns[1..].copy_from_slice(now.states.at(k));
                self.law.point_rates(k, &drive.forcing(k, 1), unknowns, rates);
                dy[k] = rates[0];
            }
        }
    }

    fn point_rates(&self, point: usize, forcing: &Forcing, unknowns: &[f64], rates: &mut [f64]) {
        self.law.point_rates(point, forcing, unknowns, rates);
    }

    fn scale(&self, point: usize) -> f64 {
        self.law.scale(point)
    }

    fn state_scale(&self, point: usize) -> f64 {
        self.law.state_scale(point)
    }

    fn length(&self, point: usize) -> Option<f64> {
        self.law.length(point)
    }

    fn steady(&self, point: usize, log_rate: f64, states: &mut [f64]) {
        self.law.steady(point, log_rate, states);
    }

    fn states_for(&self, point: usize, rate: f64, mu: f64, states: &mut [f64]) -> Result<(), Failure> {
        self.law.states_for(point, rate, mu, states)
    }

    fn at_rate(&self, point: usize, rate: f64, states: &[f64]) -> Result<f64, Failure> {
        self.law.at_rate(point, rate, states)
    }

    fn heat(&mut self, point: usize, weakening: f64, ambient: f64) -> bool {
        self.law.heat(point, weakening, ambient)
    }

    fn warms(&self) -> bool {
        self.law.warms()
    }

    fn copy(&self) -> Box<dyn FaultLaw> {
        Box::new(Self::new(self.law.copy()))
    }

    fn warm(&mut self, point: usize, temperature: f64) {
        self.law.warm(point, temperature);
    }

    fn log_rate_by_temperature(&self, point: usize) -> f64 {
        self.law.log_rate_by_temperature(point)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::VariableRake;
    use crate::evolution::ageing::Ageing;
    use crate::fault::{Drive, FaultLaw, Points, UnknownRates, Unknowns};
    use crate::points::{Components, PerPoint};
    use crate::rate::RateLaw;
    use crate::strength::Parameters;
    use crate::strength::regularised::Regularised;

    const N: usize = 11;

    fn line() -> Box<dyn FaultLaw> {
        let law = |k: usize| {
            let a = 0.008 + 0.002 * (k % 5) as f64;
            let form = Regularised(Parameters::new(0.6, a, 1e-6).unwrap());
            RateLaw::new(form, Ageing::new(0.015, 0.008, 1e-6).unwrap(), 1e-9, None).unwrap()
        };
        Box::new(Points::new((0..N).map(law).collect()))
    }

    fn unknowns<'a>(m: &'a [f64], states: &'a [f64]) -> Unknowns<'a> {
        Unknowns { m: Components::new(m, N), states: PerPoint::new(states, 1) }
    }

    /// Unknowns, states, f_n, its rate and damping.
    struct Case {
        m: Vec<f64>,
        states: Vec<f64>,
        normal: Vec<f64>,
        change: Vec<f64>,
        damping: Vec<f64>,
        pull: Vec<f64>,
    }

    impl Case {
        fn new() -> Self {
            let of = |f: &dyn Fn(f64) -> f64| (0..N).map(|k| f(k as f64)).collect::<Vec<f64>>();
            let both = |f: &dyn Fn(f64) -> f64| (0..2 * N).map(|k| f(k as f64)).collect::<Vec<f64>>();
            Self {
                m: both(&|k| 31.0 * (0.7 * k + 0.3).sin()),
                states: of(&|k| 7.0 - 0.4 * k),
                normal: of(&|k| 5e7 + 1e6 * k),
                change: of(&|k| 3e-3 * (k - 4.0)),
                damping: of(&|k| 4.6e6 + 1e5 * k),
                pull: both(&|k| 1e-2 * (1.3 * k).cos()),
            }
        }

        fn drive(&self) -> Drive<'_> {
            Drive {
                normal: &self.normal,
                normal_rate: Some(&self.change),
                shear_rate: Components::new(&self.pull, N),
                damping: &self.damping,
            }
        }

        /// Rates of m and of the states, and V.
        fn rates(&self, law: &dyn FaultLaw) -> [Vec<f64>; 3] {
            let (mut dm, mut ds, mut v) = (self.m.clone(), vec![0.0; N], self.m.clone());
            let now = unknowns(&self.m, &self.states);
            let rates = UnknownRates { m: Components::new(&mut dm, N), states: PerPoint::new(&mut ds, 1) };
            law.rates(self.drive(), now, rates);
            law.slip_rates(now, Components::new(&mut v, N));
            [dm, ds, v]
        }
    }

    #[test]
    fn slip_along_an_axis_is_that_of_the_law_of_a_line() {
        let (law, turning) = (line(), VariableRake::new(line()));
        for axis in [0, 1] {
            let mut case = Case::new();
            case.m[(1 - axis) * N..(2 - axis) * N].fill(0.0);
            case.pull[(1 - axis) * N..(2 - axis) * N].fill(0.0);
            let own = axis * N..(axis + 1) * N;
            let flat = Case {
                m: case.m[own.clone()].to_vec(),
                pull: case.pull[own.clone()].to_vec(),
                ..Case::new()
            };
            let ([dm, ds, v], [flat_dm, flat_ds, flat_v]) = (case.rates(&turning), flat.rates(&*law));
            for k in 0..N {
                assert!((v[own.start + k] / flat_v[k] - 1.0).abs() < 1e-15, "{k}");
                assert!((dm[own.start + k] - flat_dm[k]).abs() <= 1e-14 * flat_dm[k].abs(), "{k}");
                assert!((ds[k] - flat_ds[k]).abs() <= 1e-14 * flat_ds[k].abs(), "{k}");
                assert!(dm[(1 - axis) * N + k] == 0.0 && v[(1 - axis) * N + k] == 0.0);
            }
        }
    }

    #[test]
    fn turned_axes_turn_the_rates() {
        let turning = VariableRake::new(line());
        let case = Case::new();
        let (sine, cosine) = 30f64.to_radians().sin_cos();
        let turned = |v: &[f64]| -> Vec<f64> {
            let (x, y) = v.split_at(N);
            let first = x.iter().zip(y).map(|(x, y)| cosine * x - sine * y);
            first.chain(x.iter().zip(y).map(|(x, y)| sine * x + cosine * y)).collect()
        };
        let other = Case { m: turned(&case.m), pull: turned(&case.pull), ..Case::new() };
        let ([dm, ds, v], [other_dm, other_ds, other_v]) = (case.rates(&turning), other.rates(&turning));
        // Rounding of m ~ 30 in ln V, and in rates with it.
        let close = |a: &[f64], b: &[f64]| {
            let largest = a.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
            a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-13 * largest)
        };
        assert!(close(&turned(&dm), &other_dm) && close(&ds, &other_ds) && close(&turned(&v), &other_v));
    }

    /// `f_n a m + η V` grows as the driving traction does: checked by differences along the rates.
    #[test]
    fn friction_and_damping_follow_the_traction_that_drives_in_both_components() {
        let turning = VariableRake::new(line());
        let case = Case::new();
        let [dm, ds, v] = case.rates(&turning);
        let resisting = |time: f64| -> Vec<f64> {
            let m: Vec<f64> = case.m.iter().zip(&dm).map(|(m, d)| m + time * d).collect();
            let states: Vec<f64> = case.states.iter().zip(&ds).map(|(s, d)| s + time * d).collect();
            let mut v = vec![0.0; 2 * N];
            turning.slip_rates(unknowns(&m, &states), Components::new(&mut v, N));
            let each = |i: usize| {
                let p = i % N;
                let normal = case.normal[p] + time * case.change[p];
                normal * turning.scale(p) * m[i] + case.damping[p] * v[i]
            };
            (0..2 * N).map(each).collect()
        };
        for p in 0..N {
            // Step so short that ln V of this point changes by a millionth.
            let fastest = dm[p].abs().max(dm[N + p].abs()).max(2.0 * ds[p].abs());
            let step = 1e-6 / fastest;
            let (before, after) = (resisting(-step), resisting(step));
            for i in [p, N + p] {
                let rate = (after[i] - before[i]) / (2.0 * step);
                // Rounding of tractions of about 1e7 Pa relative to the change in a step.
                let rounding = 1e-16 * 5e7 / step;
                assert!(
                    (rate - case.pull[i]).abs() < 1e-6 * case.pull[i].abs().max(1e-3) + 10.0 * rounding,
                    "{i}: {rate} {} {}",
                    case.pull[i],
                    v[i]
                );
            }
        }
    }

    #[test]
    fn a_point_without_friction_takes_up_any_direction() {
        let turning = VariableRake::new(line());
        let rates = |m: f64| {
            let mut case = Case::new();
            // An exact zero, and almost zero in an oblique direction.
            case.m[3] = 0.6 * m;
            case.m[N + 3] = 0.8 * m;
            let [dm, ds, _] = case.rates(&turning);
            [dm[3], dm[N + 3], ds[3]]
        };
        let (at, near) = (rates(0.0), rates(1e-9));
        for (a, b) in at.iter().zip(near) {
            assert!((a - b).abs() < 1e-7 * a.abs(), "{at:?} {near:?}");
        }
        assert!(at[0] != 0.0 && at[1] != 0.0);
    }
}
