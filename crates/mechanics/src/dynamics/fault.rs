//! Faults at split nodes: tractions from the momentum of both sides.
//!
//! At each point the traction that closes the gap and the one that stops slip follow from the forces and masses of the two nodes.
//! The normal traction is the closing one where it presses, otherwise none. Friction bounds the shear traction
//! ([`asperity_friction::inertial`]). Tractions act in addition to the initial state, which is in balance: bodies feel the difference.

use super::fault_state::FaultState;
use super::nodes::{SpecialNode, dot};
use super::parts::{Part, RecordPart, parts, record_parts};
use super::room::Room;
use super::split::SplitPoint;
use super::surroundings::{FaultSurroundings, Mobility, PointForces};
use super::ties::{self, Tie};
use super::{Onset, Pulse};
use asperity_friction::Failure;
use asperity_friction::inertial::{InertialFault, Push, Sliding};
use asperity_friction::points::{Components, PerPoint};
use rayon::prelude::*;

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
        for point in 0..self.points.len() {
            // A dashpot so strong that it imposes the slip rate.
            let rate = self.rate.size(point);
            let impedance = self.normal[point].max(1.0) * STIFF / rate.max(f64::MIN_POSITIVE);
            let impedance = if rate > 0.0 { impedance } else { 1.0 };
            let trial = if rate > 0.0 { impedance * rate } else { 0.0 };
            let push = Push {
                normal: start.normal[point],
                trial,
                impedance,
                near: rate,
                dt: 0.5 * dt,
                weakened: 0.0,
            };
            self.law.push(point, &push, start.states.at_mut(point))?;
        }
        Ok(())
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

    /// Balances all points at tⁿ: adds the accelerations by the tractions, whose forces are written into `forces`, and writes the
    /// tractions into the state.
    pub(super) fn balance(
        &self,
        surroundings: &mut FaultSurroundings<'_>,
        forces: &mut Vec<PointForces>,
        state: &mut FaultState,
    ) -> Result<(), BalanceFailure> {
        ties::hold(surroundings, surroundings.tied, surroundings.components);
        let (loads, around) = (self.loads(surroundings.time), &*surroundings);
        forces.resize(self.points.len(), PointForces::default());
        let tasks = parts(state, forces).into_par_iter();
        let balanced: Vec<_> = tasks.map(|part| self.balance_part(around, &loads, part)).collect();
        // The failure with the lowest number of a point, on any number of threads.
        balanced.into_iter().collect::<Result<(), _>>()?;
        surroundings.push_all(forces);
        Ok(())
    }

    /// Balances the points of a task.
    fn balance_part(
        &self,
        around: &FaultSurroundings<'_>,
        loads: &Loads,
        mut part: Part<'_>,
    ) -> Result<(), BalanceFailure> {
        for own in 0..part.normal.len() {
            let point = part.first + own;
            let p = &self.points[point];
            (part.gap[own], part.normal[own]) = self.closing(around, point)?;
            let pressed = p.area * (part.normal[own] - self.normal[point]);
            part.forces[own] = PointForces { normal: p.normal.map(|n| pressed * n), shear: [0.0; 3] };
            if around.first && !self.law.has_elastic_domain() && self.onset.is_none() {
                continue;
            }
            self.relax(around.dt, own, &mut part);
            part.forces[own].shear = self.shear_force(around, loads, own, &mut part)?;
        }
        Ok(())
    }

    /// Shear traction that friction admits at a point of a task; returns its force on the plus side \[N\].
    fn shear_force(
        &self,
        around: &FaultSurroundings<'_>,
        loads: &Loads,
        own: usize,
        part: &mut Part<'_>,
    ) -> Result<[f64; 3], BalanceFailure> {
        let point = part.first + own;
        let p = &self.points[point];
        let (push, trial) = self.push(around, loads, own, part);
        let answer = self.law.push(point, &push, part.states_of(own)).map_err(BalanceFailure::Friction)?;
        let share = if push.trial > 0.0 { answer.traction / push.trial } else { 0.0 };
        let mut force = [0.0; 3];
        for (c, e) in p.along.iter().enumerate() {
            let loading = self.loading(point, c, loads);
            let shear = &mut part.shear[c][own];
            if around.mobilities[point].along[c].is_none() {
                // Conditions carry the traction: friction neither bounds it nor does it cause motion.
                *shear = loading;
                continue;
            }
            *shear = share * trial[c];
            let change = p.area * (*shear - loading);
            force.iter_mut().zip(e).for_each(|(f, e)| *f -= change * e);
        }
        Ok(force)
    }

    /// Gap of a point \[m\], and the normal traction that closes it by the end of the step, if it presses \[Pa\].
    fn closing(&self, around: &FaultSurroundings<'_>, point: usize) -> Result<(f64, f64), BalanceFailure> {
        let p = &self.points[point];
        let mobility = around.mobilities[point].normal;
        let gap = p.gap + around.jump(around.displacement, point, &p.normal);
        if mobility == 0.0 {
            // In antiplane motion nothing moves along the normal.
            return Ok((gap, self.normal[point]));
        }
        let velocity = around.jump(around.velocity, point, &p.normal);
        let acceleration = around.jump(around.acceleration, point, &p.normal);
        let (dt, kick) = (around.dt, around.kick);
        let traction = self.normal[point] - (velocity + gap / dt + kick * acceleration) / (kick * mobility);
        if traction >= 0.0 {
            return Ok((gap, traction));
        }
        if self.opens { Ok((gap, 0.0)) } else { Err(BalanceFailure::Tension(Tension { point, traction })) }
    }

    /// Relaxes the normal traction that friction feels at a point of a task over a step at the last slip rate.
    fn relax(&self, dt: f64, own: usize, part: &mut Part<'_>) {
        let Some(Regularisation { length, rate }) = self.regularisation else { return };
        let passed = (part.rate.size(part.first + own) + rate) * dt / length;
        let normal = part.normal[own];
        part.felt[own] = normal + (part.felt[own] - normal) * (-passed).exp();
    }

    /// Drive of a point of a task, and its trial tractions \[Pa\].
    fn push(
        &self,
        around: &FaultSurroundings<'_>,
        loads: &Loads,
        own: usize,
        part: &Part<'_>,
    ) -> (Push, [f64; 2]) {
        let point = part.first + own;
        // The first step of a rate law reaches the first half step alone: velocities and states pass half a step.
        let first = around.first && !self.law.has_elastic_domain();
        let reach = if self.law.has_elastic_domain() || first { around.kick } else { 0.5 * around.dt };
        let along = &self.points[point].along;
        // A point that conditions hold in all directions of slip is not pushed, whatever its impedance.
        let (mut impedance, mut trial) = (1.0, [0.0; 2]);
        for (c, e) in along.iter().enumerate() {
            let Some(mobility) = around.mobilities[point].along[c] else { continue };
            impedance = 1.0 / (reach * mobility);
            let rate =
                around.jump(around.velocity, point, e) + reach * around.jump(around.acceleration, point, e);
            trial[c] = self.loading(point, c, loads) + impedance * rate;
        }
        let normal = part.normal[own];
        let felt = if self.regularisation.is_some() { part.felt[own] } else { normal };
        let push = Push {
            // Where the sides have parted there is no friction, whatever it remembers.
            normal: if normal > 0.0 { felt } else { 0.0 },
            trial: Components::new(&trial[..along.len()], 1).size(0),
            impedance,
            near: part.rate.size(point),
            dt: if first { around.kick } else { around.dt },
            weakened: self.forced.get(point).map_or(0.0, |forced| forced.share(loads.time)),
        };
        (push, trial)
    }

    /// Writes slip and slip rates at tⁿ of points between these pairs of nodes. Returns the works of the tractions over both half
    /// steps: dissipated, and released from the initial and imposed tractions.
    pub(super) fn record(
        &self,
        [time, dt]: [f64; 2],
        room: &Room,
        pairs: &[[usize; 2]],
        state: &mut FaultState,
    ) -> [[f64; 2]; 2] {
        let loads = self.loads(time);
        let tasks = record_parts(state).into_par_iter();
        let works: Vec<_> = tasks.map(|part| self.record_part(dt, &loads, (room, pairs), part)).collect();
        let add = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        works.into_iter().fold([[0.0; 2]; 2], |sum, w| [add(sum[0], w[0]), add(sum[1], w[1])])
    }

    /// Records the points of a task.
    fn record_part(
        &self,
        dt: f64,
        loads: &Loads,
        (room, pairs): (&Room, &[[usize; 2]]),
        part: RecordPart<'_>,
    ) -> [[f64; 2]; 2] {
        let (mut dissipated, mut freed) = ([0.0; 2], [0.0; 2]);
        for own in 0..part.slip[0].len() {
            let point = part.first + own;
            let (p, jumps) = (&self.points[point], room.velocity_jumps(pairs[point]));
            for (side, jump) in jumps.iter().enumerate() {
                let opening = dot(jump, &p.normal);
                dissipated[side] -= 0.5 * dt * p.area * part.normal[point] * opening;
                freed[side] -= 0.5 * dt * p.area * self.normal[point] * opening;
            }
            let apart = room.jump(pairs[point]);
            for (c, e) in p.along.iter().enumerate() {
                let rates = jumps.map(|jump| dot(&jump, e));
                part.slip[c][own] = dot(&apart, e);
                part.rate[c][own] = 0.5 * (rates[0] + rates[1]);
                let (shear, loading) = (part.shear.component(c)[point], self.loading(point, c, loads));
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
