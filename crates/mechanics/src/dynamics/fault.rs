//! Faults at split nodes: tractions from the momentum of both sides.
//!
//! At each point the traction that closes the gap and the one that stops slip follow from the forces and masses of the two nodes.
//! The normal traction is the closing one where it presses, otherwise none. Friction bounds the shear traction
//! ([`asperity_friction::inertial`]). Tractions act in addition to the initial state, which is in balance: bodies feel the difference.

use super::nodes::{SpecialNode, dot};
use super::split::SplitPoint;
use super::surroundings::{FaultSurroundings, Mobility};
use super::ties::{self, Tie};
use super::{Onset, Pulse};
use asperity_friction::Failure;
use asperity_friction::inertial::{InertialFault, PointBalance, Push, Sliding};
use asperity_friction::points::{Components, PerPoint};
use serde::{Deserialize, Serialize};

/// Relaxation of the normal traction that friction feels, `dσ̂/dt = -(|V| + V*)/L (σ̂ - σ)`. Between unlike rocks slip at a friction that
/// follows the normal traction at once is ill-posed (Cochard & Rice 2000; Prakash & Clifton 1993 observed the delay).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regularisation {
    /// L \[m\].
    pub length: f64,
    /// V* \[m/s\].
    pub rate: f64,
}

/// All points of all faults.
#[derive(Debug)]
pub struct Fault {
    /// Points.
    pub points: Vec<SplitPoint>,
    /// Laws of the points.
    pub law: Box<dyn InertialFault>,
    /// Normal traction at the start \[Pa\].
    pub normal: Vec<f64>,
    /// Shear traction at the start \[Pa\].
    pub shear: Components<Vec<f64>>,
    /// Slip rate at the start \[m/s\]; it sets the states of laws that have them.
    pub rate: Components<Vec<f64>>,
    /// True if sides may part; otherwise a run stops where they would.
    pub opens: bool,
    /// Relaxation of the normal traction, if it is declared.
    pub regularisation: Option<Regularisation>,
    /// Imposed tractions.
    pub pulses: Vec<Pulse>,
    /// Imposed weakening of friction; empty without, otherwise one for each point.
    pub forced: Vec<ForcedWeakening>,
    /// Friction and states at the start of faults that slip already; otherwise friction is the traction at the start.
    pub onset: Option<Onset>,
    /// Pairs of nodes that stay together.
    pub ties: Vec<Tie>,
}

/// Weakening of friction that is imposed on a point, whatever its slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForcedWeakening {
    /// Time at which it begins \[s\]; infinite where it does not.
    pub at: f64,
    /// Time over which friction falls from its first value to its last \[s\].
    pub duration: f64,
}

impl ForcedWeakening {
    /// Share that is done at a time.
    #[must_use]
    pub fn share(&self, time: f64) -> f64 {
        ((time - self.at) / self.duration).clamp(0.0, 1.0)
    }
}

/// Imposed tractions at a time.
struct Loads {
    time: f64,
    /// Growth of each pulse \[-\].
    growth: Vec<f64>,
}

/// State of the faults at a step tⁿ.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaultState {
    /// Slip \[m\].
    pub slip: Components<Vec<f64>>,
    /// Slip rate \[m/s\]: the mean of the half steps before and after.
    pub rate: Components<Vec<f64>>,
    /// Shear traction \[Pa\].
    pub shear: Components<Vec<f64>>,
    /// Normal traction \[Pa\].
    pub normal: Vec<f64>,
    /// Gap \[m\]; 0 where the sides touch.
    pub gap: Vec<f64>,
    /// State variables half a step later.
    pub states: PerPoint<Vec<f64>>,
    /// Normal traction that friction feels \[Pa\], if it is delayed.
    pub felt: Vec<f64>,
}

/// A point where the sides would part and may not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tension {
    pub point: usize,
    pub traction: f64,
}

/// Reason why a fault could not be balanced.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum BalanceFailure {
    Friction(Failure),
    Tension(Tension),
}

impl Fault {
    /// State at the start, with laws in their states half a step later; with an onset, at the start.
    ///
    /// # Errors
    /// [`Failure`] where no state gives the initial traction.
    pub(super) fn start(&self, dt: f64) -> Result<FaultState, Failure> {
        let (n, states) = (self.points.len(), self.law.states());
        let friction = self.onset.as_ref().map_or(&self.shear, |onset| &onset.friction);
        let mut start = FaultState {
            slip: Components::new(vec![0.0; self.shear.all().len()], n),
            rate: self.rate.clone(),
            shear: friction.clone(),
            normal: self.normal.clone(),
            gap: self.points.iter().map(|p| p.gap).collect(),
            states: PerPoint::new(vec![0.0; n * states], states),
            felt: if self.regularisation.is_some() { self.normal.clone() } else { Vec::new() },
        };
        if let Some(onset) = &self.onset {
            start.states.clone_from(&onset.states);
            return Ok(start);
        }
        for point in 0..n {
            let (rate, normal) = (self.rate.size(point), self.normal[point]);
            let friction = self.shear.size(point) / normal;
            let sliding = (rate > 0.0 && normal > 0.0).then_some(Sliding { rate, friction });
            self.law.start(point, sliding, start.states.at_mut(point))?;
        }
        if !self.law.has_elastic_domain() {
            self.first_half(dt, &mut start)?;
        }
        Ok(start)
    }

    /// Passes the first half step at the slip rates of the start.
    fn first_half(&self, dt: f64, start: &mut FaultState) -> Result<(), Failure> {
        // A dashpot so strong that it imposes the slip rate.
        let pushes: Vec<Push> = (0..self.points.len())
            .map(|point| {
                let rate = self.rate.size(point);
                let impedance = self.normal[point].max(1.0) * STIFF / rate.max(f64::MIN_POSITIVE);
                let impedance = if rate > 0.0 { impedance } else { 1.0 };
                let trial = if rate > 0.0 { impedance * rate } else { 0.0 };
                Push {
                    normal: start.normal[point],
                    trial,
                    impedance,
                    near: rate,
                    dt: 0.5 * dt,
                    weakened: 0.0,
                }
            })
            .collect();
        let mut answers = vec![PointBalance { traction: 0.0, rate: 0.0 }; pushes.len()];
        self.law.push(&pushes, start.states.view_mut(), &mut answers)
    }

    /// Mobilities of the points between special nodes, of which `pairs` holds those of each point.
    pub(super) fn mobilities(&self, nodes: &[SpecialNode], pairs: &[[usize; 2]]) -> Vec<Mobility> {
        let of = |(point, pair): (&SplitPoint, &[usize; 2])| Mobility::new(point, pair.map(|k| &nodes[k]));
        self.points.iter().zip(pairs).map(of).collect()
    }

    /// Loads of the points at a time \[s\].
    fn loads(&self, time: f64) -> Loads {
        Loads { time, growth: self.pulses.iter().map(|p| p.growth(time)).collect() }
    }

    /// Shear traction that loads a component of a point: initial and imposed \[Pa\].
    fn loading(&self, point: usize, component: usize, loads: &Loads) -> f64 {
        let entry = component * self.points.len() + point;
        let imposed = self.pulses.iter().zip(&loads.growth).map(|(p, g)| g * p.amplitude[entry]);
        let rate = self.onset.as_ref().map_or(0.0, |onset| onset.loading_rate.component(component)[point]);
        self.shear.component(component)[point] + imposed.sum::<f64>() + rate * loads.time
    }

    /// Balances all points at tⁿ: adds the accelerations by the tractions and writes these into the state.
    pub(super) fn balance(
        &self,
        surroundings: &mut FaultSurroundings<'_>,
        state: &mut FaultState,
    ) -> Result<(), BalanceFailure> {
        let loads = self.loads(surroundings.time);
        ties::hold(surroundings, surroundings.tied, surroundings.components);
        for point in 0..self.points.len() {
            state.normal[point] = self.closing(surroundings, point, state)?;
        }
        if surroundings.first && !self.law.has_elastic_domain() && self.onset.is_none() {
            for point in 0..self.points.len() {
                self.press(surroundings, point, state);
            }
            return Ok(());
        }
        self.relax(surroundings.dt, state);
        let (pushes, trials) = self.pushes(surroundings, state, &loads);
        let mut answers = vec![PointBalance { traction: 0.0, rate: 0.0 }; pushes.len()];
        self.law.push(&pushes, state.states.view_mut(), &mut answers).map_err(BalanceFailure::Friction)?;
        for (point, (push, answer)) in pushes.iter().zip(&answers).enumerate() {
            let p = &self.points[point];
            let share = if push.trial > 0.0 { answer.traction / push.trial } else { 0.0 };
            self.press(surroundings, point, state);
            let mut force = [0.0; 3];
            for (c, e) in p.along.iter().enumerate() {
                let loading = self.loading(point, c, &loads);
                let shear = &mut state.shear.component_mut(c)[point];
                if surroundings.mobilities[point].along[c].is_none() {
                    // Conditions carry the traction: friction neither bounds it nor does it cause motion.
                    *shear = loading;
                    continue;
                }
                *shear = share * trials.component(c)[point];
                let change = p.area * (*shear - loading);
                force.iter_mut().zip(e).for_each(|(f, e)| *f -= change * e);
            }
            surroundings.push(surroundings.pairs[point], &force);
        }
        Ok(())
    }

    /// Adds the accelerations by the change of the normal traction of a point.
    fn press(&self, surroundings: &mut FaultSurroundings<'_>, point: usize, state: &FaultState) {
        let pressed = self.points[point].area * (state.normal[point] - self.normal[point]);
        surroundings.push(surroundings.pairs[point], &self.points[point].normal.map(|n| pressed * n));
    }

    /// Normal traction that closes the gap by the end of the step, if it presses \[Pa\].
    fn closing(
        &self,
        surroundings: &FaultSurroundings<'_>,
        point: usize,
        state: &mut FaultState,
    ) -> Result<f64, BalanceFailure> {
        let p = &self.points[point];
        let mobility = surroundings.mobilities[point].normal;
        let gap = p.gap + surroundings.jump(surroundings.displacement, point, &p.normal);
        state.gap[point] = gap;
        if mobility == 0.0 {
            // In antiplane motion nothing moves along the normal.
            return Ok(self.normal[point]);
        }
        let velocity = surroundings.jump(surroundings.velocity, point, &p.normal);
        let acceleration = surroundings.jump(surroundings.acceleration, point, &p.normal);
        let (dt, kick) = (surroundings.dt, surroundings.kick);
        let traction = self.normal[point] - (velocity + gap / dt + kick * acceleration) / (kick * mobility);
        if traction >= 0.0 {
            return Ok(traction);
        }
        if self.opens { Ok(0.0) } else { Err(BalanceFailure::Tension(Tension { point, traction })) }
    }

    /// Relaxes the normal traction that friction feels over a step at the last slip rates.
    fn relax(&self, dt: f64, state: &mut FaultState) {
        let Some(Regularisation { length, rate }) = self.regularisation else { return };
        for point in 0..self.points.len() {
            let passed = (state.rate.size(point) + rate) * dt / length;
            let normal = state.normal[point];
            state.felt[point] = normal + (state.felt[point] - normal) * (-passed).exp();
        }
    }

    /// Drives of the points, and their trial tractions \[Pa\].
    fn pushes(
        &self,
        surroundings: &FaultSurroundings<'_>,
        state: &FaultState,
        loads: &Loads,
    ) -> (Vec<Push>, Components<Vec<f64>>) {
        let n = self.points.len();
        // The first step of a rate law reaches the first half step alone: velocities and states pass half a step.
        let first = surroundings.first && !self.law.has_elastic_domain();
        let reach =
            if self.law.has_elastic_domain() || first { surroundings.kick } else { 0.5 * surroundings.dt };
        let mut trials = Components::new(vec![0.0; self.shear.all().len()], n);
        let pushes = (0..n).map(|point| {
            let p = &self.points[point];
            // A point that conditions hold in all directions of slip is not pushed, whatever its impedance.
            let mut impedance = 1.0;
            for (c, e) in p.along.iter().enumerate() {
                let Some(mobility) = surroundings.mobilities[point].along[c] else { continue };
                impedance = 1.0 / (reach * mobility);
                let rate = surroundings.jump(surroundings.velocity, point, e)
                    + reach * surroundings.jump(surroundings.acceleration, point, e);
                trials.component_mut(c)[point] = self.loading(point, c, loads) + impedance * rate;
            }
            let felt = if self.regularisation.is_some() { state.felt[point] } else { state.normal[point] };
            Push {
                // Where the sides have parted there is no friction, whatever it remembers.
                normal: if state.normal[point] > 0.0 { felt } else { 0.0 },
                trial: trials.size(point),
                impedance,
                near: state.rate.size(point),
                dt: if first { surroundings.kick } else { surroundings.dt },
                weakened: self.forced.get(point).map_or(0.0, |forced| forced.share(loads.time)),
            }
        });
        (pushes.collect(), trials)
    }

    /// Writes slip and slip rates at tⁿ. Returns the works of the tractions over both half steps: dissipated, and released from the initial
    /// and imposed tractions. `jumps` holds for each point the velocities of the plus side
    /// relative to the minus side before and after \[m/s\], `displacement` the relative displacement at tⁿ \[m\].
    pub(super) fn record(
        &self,
        time: f64,
        dt: f64,
        jumps: &[[[f64; 3]; 2]],
        displacement: &[[f64; 3]],
        state: &mut FaultState,
    ) -> [[f64; 2]; 2] {
        let loads = self.loads(time);
        let (mut dissipated, mut freed) = ([0.0; 2], [0.0; 2]);
        for (point, p) in self.points.iter().enumerate() {
            for (side, jump) in jumps[point].iter().enumerate() {
                let opening = dot(jump, &p.normal);
                dissipated[side] -= 0.5 * dt * p.area * state.normal[point] * opening;
                freed[side] -= 0.5 * dt * p.area * self.normal[point] * opening;
            }
            for (c, e) in p.along.iter().enumerate() {
                let rates = [dot(&jumps[point][0], e), dot(&jumps[point][1], e)];
                state.slip.component_mut(c)[point] = dot(&displacement[point], e);
                state.rate.component_mut(c)[point] = 0.5 * (rates[0] + rates[1]);
                let (shear, loading) = (state.shear.component(c)[point], self.loading(point, c, &loads));
                for (side, rate) in rates.iter().enumerate() {
                    dissipated[side] += 0.5 * dt * p.area * shear * rate;
                    freed[side] += 0.5 * dt * p.area * loading * rate;
                }
            }
        }
        [dissipated, freed]
    }
}

/// Drag of the first half step over the strength: friction then changes the imposed slip rate by rounding alone.
const STIFF: f64 = 1e16;
