//! One slider: the differential equations of its friction and states, loaded by a spring.
//!
//! With μ = a m, the unknowns are m, the state variables s_i, and with inertia the net traction d. T is the traction of the
//! springs, with `dT/dt = p - K V`. Radiation damping η and mass M (per area) enter as `M dV/dt = T - f_n a m - η V = f_n a d`.
//! V follows from m and φ = Σ φ_i(s_i) without iteration: `dV/dt = P dm/dt + Q` with `P = ∂V/∂m - ∂V/∂φ C a` and `Q = ∂V/∂φ A`.
//! A is the change of φ at constant V and f_n plus that by the memory of f_n. C μ is the change by the memory of shear traction
//! (`dφ = A dt - C dμ`). Hence
//!
//! * without inertia `dm/dt = (p - K V - f_n' a m - η Q)/(f_n a + η P)`;
//! * with inertia `dm/dt = (f_n a d/M - Q)/P` and `f_n a dd/dt = p - K V - f_n a dm/dt - f_n' a (m + d) - η (P dm/dt + Q)`.
//!
//! If V is imposed, m follows from V and φ and is not an unknown: its slot is left unchanged. The memory of shear traction uses
//! `dm/dt = (dV/dt - Q)/P`.
//!
//! ln V = m - (μ0 + φ)/a + ... is computed from numbers of order one to a hundred. Sixteen decades of V therefore cost no
//! precision, and V can pass through zero. d is an unknown because T - f_n μ - η V would have no digits left while the slider
//! creeps.

use super::line::Line;
use super::number::{Dual, Number};
use crate::Failure;
use crate::component::Component;
use crate::evolution::{Evolution, Speed};
use crate::law::{Drives, RateDependent};
use crate::rate::RateLaw;
use crate::strength::{Form, Sine, SlipRate};

/// Forcing of a slider at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forcing {
    /// f_n > 0 \[Pa\].
    pub normal: f64,
    /// df_n/dt \[Pa/s\].
    pub normal_rate: f64,
    /// p = k V_load + Σ k_j V_j \[Pa/s\]: the loading rate of the springs if the slider stood still.
    pub pull: f64,
    /// K = k + Σ k_j \[Pa/m\].
    pub stiffness: f64,
    /// η ≥ 0 \[Pa s/m\].
    pub damping: f64,
    /// M > 0 \[kg/m²\]; `None` without inertia.
    pub mass: Option<f64>,
    /// V and dV/dt \[m/s, m/s²\], where they are imposed: springs, damping and mass then have no effect.
    pub imposed: Option<(f64, f64)>,
}

/// Direction of a derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// An unknown of the slider.
    Unknown(usize),
    /// The pull of its springs.
    Pull,
}

/// Friction near steady sliding, to first order in the changes x of ln V and φ_i of the states: `μ = a x + q Σ φ_i` and
/// `dφ_i/dt = -r_i (φ_i + b_i x) - C_i dμ/dt`.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// a = ∂μ/∂ln V \[-\].
    pub direct: f64,
    /// q = ∂μ/∂φ \[-\]: 1 unless μ is only a few a.
    pub weight: f64,
    /// The states.
    pub states: Vec<Relaxation>,
}

/// A state near steady sliding; see [`Response`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relaxation {
    /// b_i \[-\].
    pub weakening: f64,
    /// r_i \[1/s\].
    pub rate: f64,
    /// C_i \[-\]: memory of shear traction.
    pub memory: f64,
}

/// Interface of a law to a slider. One call treats one slider.
pub trait SliderLaw: RateDependent {
    /// Rates of change of the unknowns of a slider.
    fn equations(&self, forcing: &Forcing, unknowns: &[f64], rates: &mut [f64]);

    /// Derivative of those rates in a direction.
    fn gradient(&self, forcing: &Forcing, unknowns: &[f64], along: Direction, slopes: &mut [f64]);

    /// Signed slip rate \[m/s\] and ln |V|, and the friction coefficient, from m and the state variables.
    fn slip(&self, unknowns: &[f64]) -> (Speed, f64);

    /// Slip rate with its derivatives by m and by each state variable.
    fn slip_slopes(&self, unknowns: &[f64], slopes: &mut [f64]) -> f64;

    /// The unknown m at a slip rate \[m/s\] of either sign, for the given state variables.
    ///
    /// # Errors
    /// [`Failure::BareLogAtRest`] where the form has no value at this rate, [`Failure::Negative`] where it would be negative.
    fn at_rate(&self, rate: f64, states: &[f64]) -> Result<f64, Failure>;

    /// State variables that are steady at ln V.
    fn steady(&self, log_rate: f64, states: &mut [f64]);

    /// Changes the only state variable so that the friction coefficient at this slip rate \[m/s\] is `mu`.
    ///
    /// # Errors
    /// [`Failure::Parameter`] without a state or with several; [`Failure::NotConverged`] if no state gives this coefficient.
    fn states_for(&self, rate: f64, mu: f64, states: &mut [f64]) -> Result<(), Failure>;

    /// Carries the unknowns over a jump of f_n from `old` to `new`. Without inertia the traction of the springs is continuous
    /// and V jumps; with inertia V is continuous.
    ///
    /// # Errors
    /// [`Failure`] of the point solver.
    fn jump(
        &self,
        unknowns: &mut [f64],
        old: f64,
        new: f64,
        damping: f64,
        inertia: bool,
    ) -> Result<(), Failure>;

    /// Carries the unknowns over a jump of f_n and of an imposed slip rate, each given before and after.
    ///
    /// # Errors
    /// [`Failure`] where the form has no value at the slip rate.
    fn step_rate(&self, unknowns: &mut [f64], normal: [f64; 2], rate: [f64; 2]) -> Result<(), Failure>;

    /// Friction near steady sliding at ln V.
    fn response(&self, log_rate: f64) -> Response;

    /// a \[-\], the scale of m.
    fn scale(&self) -> f64;

    /// Change of each state variable that is equivalent to a change of ln V by one, for error norms: 1 for logarithms, a for
    /// friction.
    fn state_scale(&self) -> f64;

    /// True if the form has a value at rest and in reversal; otherwise the rates do not exist at m ≤ 0.
    fn reverses(&self) -> bool;

    /// Shortest characteristic slip L \[m\], if there is one.
    fn length(&self) -> Option<f64>;

    /// Makes the contacts of the evolution weaken at a temperature \[K\], with parameters that are those at `ambient`
    /// \[K\]. `false` if it has none.
    fn heat(&mut self, weakening: f64, ambient: f64) -> bool;

    /// True if friction depends on temperature.
    fn warms(&self) -> bool;

    /// Sets the temperature \[K\].
    fn warm(&mut self, temperature: f64);

    /// ∂ln V/∂T \[1/K\] at constant m and states.
    fn log_rate_by_temperature(&self) -> f64;

    /// Parameters for evaluating many such sliders at once, if the form is an exponential and the law the ageing law without
    /// memories.
    fn line(&self) -> Option<Line>;
}

/// Slip of a slider, with the derivatives of V.
struct Slide<N> {
    m: N,
    v: SlipRate,
    /// V.
    rate: N,
    /// ∂V/∂m.
    by_m: N,
    /// ∂V/∂φ.
    by_phi: N,
}

impl<N: Number> Slide<N> {
    /// A memory of |μ| as one of μ.
    #[inline]
    fn signed(&self, memory: f64) -> f64 {
        memory.copysign(self.m.value())
    }

    /// Rate of a state at constant f_n, but for what it remembers of dm/dt, and ∂φ/∂s.
    #[inline]
    fn state_rate<E: Evolution>(&self, part: &Component<E>, s: N, a: f64) -> (N, N) {
        let e = &part.evolution;
        let r = e.rate(s.value(), Speed { rate: self.v.rate.abs(), log: self.v.log });
        // ∂/∂V from ∂/∂ln V, which vanishes with V.
        let by_rate = || if self.v.rate == 0.0 { 0.0 } else { r.d_log_rate / self.v.rate };
        let change = self.rate.lift2(s, r.rate, || (by_rate(), r.d_state));
        let (slope, bend) = e.phi_slopes(s.value());
        let slope = s.lift(slope, || bend);
        if part.shear_memory == 0.0 {
            return (change, slope);
        }
        // |μ| is remembered. ∂μ/∂φ = -a (∂V/∂φ)/(∂V/∂m): the kept quantity changes by 1 + c ∂|μ|/∂φ times the change at constant V.
        let softening = (self.by_phi / self.by_m).times(-a * self.signed(part.shear_memory)) * slope;
        (change * (N::constant(1.0) + softening), slope)
    }
}

impl<F: Form, E: Evolution> RateLaw<F, E> {
    /// φ and V at the unknowns.
    #[inline]
    fn kinematics<N: Number>(&self, y: &[N]) -> (N, SlipRate) {
        let phi = self.sum(y);
        (phi, self.form().slip_rate(y[0].value(), phi.value()))
    }

    /// φ at the unknowns.
    #[inline]
    fn sum<N: Number>(&self, y: &[N]) -> N {
        let mut phi = N::constant(0.0);
        for (part, &s) in self.parts().iter().zip(&y[1..]) {
            let e = &part.evolution;
            phi = phi + s.lift(e.phi(s.value()), || e.phi_slopes(s.value()).0);
        }
        phi
    }

    /// m and V where V is imposed \[m/s\].
    fn held<N: Number>(&self, rate: f64, phi: N) -> (N, SlipRate) {
        let mu = if rate == 0.0 { 0.0 } else { self.form().at(rate.abs().ln(), phi.value()).mu };
        let m = (mu / self.form().scale()).copysign(rate);
        let v = self.form().slip_rate(m, phi.value());
        (phi.lift(m, || -v.d_phi / v.d_m), v)
    }

    /// Slip at the unknowns, or where V is imposed.
    #[inline]
    fn slide<N: Number>(&self, f: &Forcing, y: &[N]) -> Slide<N> {
        let phi = self.sum(y);
        let (m, v) = match f.imposed {
            Some((rate, _)) => self.held(rate, phi),
            None => (y[0], self.form().slip_rate(y[0].value(), phi.value())),
        };
        Slide {
            m,
            v,
            rate: m.lift2(phi, v.rate, || (v.d_m, v.d_phi)),
            by_m: m.lift2(phi, v.d_m, || (v.d_mm, v.d_m_phi)),
            by_phi: m.lift2(phi, v.d_phi, || (v.d_m_phi, v.d_phi_phi)),
        }
    }

    fn generic<N: Number>(&self, f: &Forcing, pull: N, y: &[N], dy: &mut [N]) {
        let (a, n) = (self.form().scale(), self.parts().len());
        let slide = self.slide(f, y);
        let relative = if f.normal_rate == 0.0 { 0.0 } else { f.normal_rate / f.normal };
        // A and C of the module's equations.
        let (mut ageing, mut memory) = (N::constant(0.0), N::constant(0.0));
        for ((part, &s), ds) in self.parts().iter().zip(&y[1..]).zip(&mut dy[1..]) {
            let (change, slope) = slide.state_rate(part, s, a);
            if part.shear_memory != 0.0 {
                memory = memory + slope.times(slide.signed(part.shear_memory));
            }
            let change = change - N::constant(part.normal_memory * relative);
            ageing = ageing + slope * change;
            *ds = change;
        }
        let (along, drift) = (slide.by_m - (slide.by_phi * memory).times(a), slide.by_phi * ageing);
        let gained = pull - slide.rate.times(f.stiffness) - slide.m.times(f.normal_rate * a);
        let strength = f.normal * a;
        match (f.imposed, f.mass) {
            (Some((_, acceleration)), _) => dy[0] = (N::constant(acceleration) - drift) / along,
            (None, None) => {
                dy[0] = (gained - drift.times(f.damping)) / (along.times(f.damping) + N::constant(strength));
            }
            (None, Some(mass)) => {
                let d = y[n + 1];
                dy[0] = (d.times(strength / mass) - drift) / along;
                let accelerated = along * dy[0] + drift;
                dy[n + 1] = (gained - dy[0].times(strength) - accelerated.times(f.damping))
                    .times(1.0 / strength)
                    - d.times(relative);
            }
        }
        for (part, ds) in self.parts().iter().zip(1..) {
            if part.shear_memory != 0.0 {
                dy[ds] = dy[ds] - dy[0].times(a * slide.signed(part.shear_memory));
            }
        }
        if f.imposed.is_some() {
            dy[0] = N::constant(0.0);
        }
    }
}

/// Largest number of unknowns of a slider: several times the number needed by any law in use.
pub(super) const MOST_UNKNOWNS: usize = 16;

/// Largest number of corrections of a state in the search for a coefficient: one is exact where both are logarithms.
const MOST_CORRECTIONS: usize = 60;
/// Fraction of ln V that rounding may leave there.
const SMALLEST_OFF: f64 = 1e-13;

impl<F: Form, E: Evolution> SliderLaw for RateLaw<F, E> {
    fn equations(&self, forcing: &Forcing, unknowns: &[f64], rates: &mut [f64]) {
        self.generic(forcing, forcing.pull, unknowns, rates);
    }

    fn gradient(&self, forcing: &Forcing, unknowns: &[f64], along: Direction, slopes: &mut [f64]) {
        let n = unknowns.len();
        let mut y = [Dual::constant(0.0); MOST_UNKNOWNS];
        let mut dy = y;
        for (y, &u) in y.iter_mut().zip(unknowns) {
            y.value = u;
        }
        let mut pull = Dual::constant(forcing.pull);
        match along {
            Direction::Unknown(i) => y[i].slope = 1.0,
            Direction::Pull => pull.slope = 1.0,
        }
        self.generic(forcing, pull, &y[..n], &mut dy[..n]);
        for (slope, d) in slopes.iter_mut().zip(&dy[..n]) {
            *slope = d.slope;
        }
    }

    fn slip(&self, unknowns: &[f64]) -> (Speed, f64) {
        let (_, v) = self.kinematics(unknowns);
        (Speed { rate: v.rate, log: v.log }, self.form().scale() * unknowns[0])
    }

    fn slip_slopes(&self, unknowns: &[f64], slopes: &mut [f64]) -> f64 {
        let (_, v) = self.kinematics(unknowns);
        slopes.fill(0.0);
        slopes[0] = v.d_m;
        for ((part, &s), slope) in self.parts().iter().zip(&unknowns[1..]).zip(&mut slopes[1..]) {
            *slope = v.d_phi * part.evolution.phi_slopes(s).0;
        }
        v.rate
    }

    fn at_rate(&self, rate: f64, states: &[f64]) -> Result<f64, Failure> {
        if rate == 0.0 || (rate < 0.0 && !self.form().regular_at_rest()) {
            return if rate == 0.0 && self.form().regular_at_rest() {
                Ok(0.0)
            } else {
                Err(Failure::BareLogAtRest { point: 0, rate })
            };
        }
        let phi: f64 = self.parts().iter().zip(states).map(|(p, &s)| p.evolution.phi(s)).sum();
        let mu = self.form().at(rate.abs().ln(), phi).mu;
        // A form that is not odd in V has no branch on which friction drives the slider.
        if mu <= 0.0 {
            return Err(Failure::Negative { point: 0, rate, mu });
        }
        Ok((mu / self.form().scale()).copysign(rate))
    }

    fn steady(&self, log_rate: f64, states: &mut [f64]) {
        for (part, state) in self.parts().iter().zip(states) {
            *state = part.evolution.steady(log_rate);
        }
    }

    fn states_for(&self, rate: f64, mu: f64, states: &mut [f64]) -> Result<(), Failure> {
        let ([part], [state]) = (self.parts(), &mut *states) else {
            let value = self.parts().len() as f64;
            let admissible = "one: an initial shear traction determines no more";
            return Err(Failure::Parameter { name: "states", value, admissible });
        };
        let log_rate = crate::positive("rate", rate)?.ln();
        crate::positive("mu", mu)?;
        // ln V at μ falls by 1/a per unit of φ, exactly so where the strength is a logarithm or its asinh.
        let mut off = f64::INFINITY;
        for _ in 0..MOST_CORRECTIONS {
            let e = &part.evolution;
            off = self.form().log_rate(mu, e.phi(*state)) - log_rate;
            let step = off * self.form().scale() / e.phi_slopes(*state).0;
            *state += step;
            if step.abs() <= f64::EPSILON * state.abs() || off == 0.0 {
                return Ok(());
            }
        }
        if off.abs() <= SMALLEST_OFF * log_rate.abs() {
            return Ok(());
        }
        Err(Failure::NotConverged { point: 0, normal: 1.0, trial: mu, residual: off })
    }

    fn jump(
        &self,
        unknowns: &mut [f64],
        old: f64,
        new: f64,
        damping: f64,
        inertia: bool,
    ) -> Result<(), Failure> {
        let (a, n) = (self.form().scale(), self.parts().len());
        let (before, mu) = self.slip(unknowns);
        let net = if inertia { unknowns[n + 1] * a * old } else { 0.0 };
        let traction = old * mu + damping * before.rate + net;
        let under = |normal: f64| (normal / self.reference()).ln();
        let mut kept = [0.0; MOST_UNKNOWNS];
        for ((part, s), kept) in self.parts().iter().zip(&unknowns[1..]).zip(&mut kept) {
            *kept = s + part.normal_memory * under(old) + part.shear_memory * mu.abs();
        }
        if inertia {
            if before.rate == 0.0 {
                // μ is zero before and after.
                for (part, s) in self.parts().iter().zip(&mut unknowns[1..]) {
                    *s -= part.normal_memory * (new / old).ln();
                }
            } else {
                let mut solver = self.solver();
                solver.after(&kept[..n], new, 0.0, before.log);
                unknowns[1..=n].copy_from_slice(solver.states());
            }
            unknowns[0] = self.at_rate(before.rate, &unknowns[1..=n])?;
            // T - f_n a m - η V with T unchanged: only f_n m changes.
            unknowns[n + 1] = (net + old * mu - new * a * unknowns[0]) / (new * a);
            return Ok(());
        }
        let (mut rate, mut change) = ([0.0], [0.0; MOST_UNKNOWNS]);
        let drives = Drives { traction: &[traction], normal: &[new], damping, near: None };
        self.slip_rates(drives, &kept[..n], &mut rate, &mut change[..n])?;
        let mu = (traction - damping * rate[0]) / new;
        unknowns[0] = mu / a;
        for ((part, s), kept) in self.parts().iter().zip(&mut unknowns[1..]).zip(&kept) {
            *s = kept - part.normal_memory * under(new) - part.shear_memory * mu.abs();
        }
        Ok(())
    }

    fn step_rate(
        &self,
        unknowns: &mut [f64],
        [old, new]: [f64; 2],
        [before, after]: [f64; 2],
    ) -> Result<(), Failure> {
        let n = self.parts().len();
        let mu = self.form().scale() * self.at_rate(before, &unknowns[1..=n])?;
        let under = |normal: f64| (normal / self.reference()).ln();
        let mut kept = [0.0; MOST_UNKNOWNS];
        for ((part, s), kept) in self.parts().iter().zip(&unknowns[1..]).zip(&mut kept) {
            *kept = s + part.normal_memory * under(old) + part.shear_memory * mu.abs();
        }
        if after == 0.0 {
            for ((part, s), kept) in self.parts().iter().zip(&mut unknowns[1..]).zip(&kept) {
                *s = kept - part.normal_memory * under(new);
            }
        } else {
            let mut solver = self.solver();
            solver.after(&kept[..n], new, 0.0, after.abs().ln());
            unknowns[1..=n].copy_from_slice(solver.states());
        }
        unknowns[0] = self.at_rate(after, &unknowns[1..=n])?;
        Ok(())
    }

    fn response(&self, log_rate: f64) -> Response {
        let steady: Vec<f64> = self.parts().iter().map(|p| p.evolution.steady(log_rate)).collect();
        let phi = self.parts().iter().zip(&steady).map(|(p, &s)| p.evolution.phi(s)).sum();
        let strength = self.form().at(log_rate, phi);
        let state = |(part, &s): (&Component<E>, &f64)| {
            let (slope, _) = part.evolution.phi_slopes(s);
            let change = part.evolution.rate(s, Speed::from_log(log_rate));
            // The kept quantity changes by 1 + q C times the change at constant V, as in `generic`.
            let memory = part.shear_memory * slope;
            let rate = -change.d_state * (1.0 + strength.d_phi * memory);
            Relaxation { weakening: slope * change.d_log_rate / change.d_state, rate, memory }
        };
        let states = self.parts().iter().zip(&steady).map(state).collect();
        Response { direct: strength.d_log_rate, weight: strength.d_phi, states }
    }

    fn scale(&self) -> f64 {
        self.form().scale()
    }

    fn state_scale(&self) -> f64 {
        // The change that moves ln V by one at constant m is a/φ'; for a logarithm it is at most one.
        let slope = self.parts().iter().map(|p| p.evolution.phi_slopes(0.0).0.abs()).fold(0.0, f64::max);
        if slope == 0.0 { 1.0 } else { (self.form().scale() / slope).min(1.0) }
    }

    fn reverses(&self) -> bool {
        self.form().regular_at_rest()
    }

    fn length(&self) -> Option<f64> {
        self.parts().iter().filter_map(|p| p.evolution.length()).reduce(f64::min)
    }

    fn heat(&mut self, weakening: f64, ambient: f64) -> bool {
        let parts = self.parts_mut();
        // All parts are heated: none is skipped.
        parts.iter_mut().filter_map(|part| part.evolution.heat(weakening, ambient).then_some(())).count() > 0
    }

    fn warms(&self) -> bool {
        self.form().warms() || self.parts().iter().any(|part| part.evolution.warms())
    }

    fn warm(&mut self, temperature: f64) {
        self.form_mut().warm(temperature);
        self.parts_mut().iter_mut().for_each(|part| part.evolution.warm(temperature));
    }

    fn log_rate_by_temperature(&self) -> f64 {
        self.form().log_rate_by_temperature()
    }

    fn line(&self) -> Option<Line> {
        let [part] = self.parts() else { return None };
        if part.normal_memory != 0.0 || part.shear_memory != 0.0 {
            return None;
        }
        let (Sine { offset, from, least }, (b, healing)) = (self.form().sine()?, part.evolution.ageing()?);
        let length = part.evolution.length()?;
        Some(Line { from, least, offset, a: self.form().scale(), b, healing, length })
    }
}
