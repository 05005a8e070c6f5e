//! Friction of an interface: history, the gather, call and scatter around a law, and the vector form of its response.
//!
//! All vectors are components in the frame carried with the master surface. For the trial traction `t^e = t_old + E_t Δu` and η
//! = t^e/|t^e|, the law maps |t^e| to τ, and `t = τ η`.

use crate::measure::{NormalPoint, ShearPoint};
use crate::vector::{axpy, dot, norm, scaled};
use asperity_friction::Failure;
use asperity_friction::law::{Lag, Law, Regime, Responses, StepOutcome, Trials};
use std::sync::Arc;

/// Frictional history of all points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct History {
    /// Shear traction t \[Pa\].
    pub traction: Vec<[f64; 2]>,
    /// Slip rate V along the traction \[m/s\].
    pub rate: Vec<f64>,
    /// Regime.
    pub regime: Vec<Regime>,
    /// State variables, point-major.
    pub states: Vec<f64>,
}

impl History {
    fn new(points: usize, law: &dyn Law) -> Self {
        let mut states = vec![0.0; points * law.states()];
        law.initial(&mut states);
        Self {
            traction: vec![[0.0; 2]; points],
            rate: vec![0.0; points],
            regime: vec![Regime::Stick; points],
            states,
        }
    }

    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.traction.copy_from_slice(&other.traction);
        self.rate.copy_from_slice(&other.rate);
        self.regime.copy_from_slice(&other.regime);
        self.states.copy_from_slice(&other.states);
    }
}

/// Values of the closed points, one after another, for one call of the law. The vectors keep their capacity between calls.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slices {
    /// Point of each entry.
    pub index: Vec<usize>,
    pub normal: Vec<f64>,
    pub trial: Vec<f64>,
    pub direction: Vec<[f64; 2]>,
    pub weight: Vec<f64>,
    pub offset: Vec<f64>,
    pub old: Vec<f64>,
    pub traction: Vec<f64>,
    pub slip: Vec<f64>,
    pub rate: Vec<f64>,
    pub regime: Vec<Regime>,
    pub d_trial: Vec<f64>,
    pub d_normal: Vec<f64>,
    pub states: Vec<f64>,
    /// Slip rates at the start of the step \[m/s\].
    pub before: Vec<f64>,
    /// Estimated errors of μ at the end of the step \[-\].
    pub error: Vec<f64>,
}

impl Slices {
    fn with_capacity(n: usize, states: usize) -> Self {
        let f = || Vec::with_capacity(n);
        Self {
            index: Vec::with_capacity(n),
            normal: f(),
            trial: f(),
            direction: Vec::with_capacity(n),
            weight: f(),
            offset: f(),
            old: Vec::with_capacity(n * states),
            traction: f(),
            slip: f(),
            rate: f(),
            regime: Vec::with_capacity(n),
            d_trial: f(),
            d_normal: f(),
            states: Vec::with_capacity(n * states),
            before: f(),
            error: f(),
        }
    }

    pub(crate) fn clear(&mut self) {
        self.index.clear();
        self.normal.clear();
        self.trial.clear();
        self.direction.clear();
        self.weight.clear();
        self.offset.clear();
        self.old.clear();
    }

    /// Sizes the response vectors for the gathered entries.
    fn size_answers(&mut self, states: usize) {
        let n = self.index.len();
        for v in [&mut self.traction, &mut self.slip, &mut self.rate, &mut self.d_trial, &mut self.d_normal] {
            v.resize(n, 0.0);
        }
        self.regime.resize(n, Regime::Stick);
        self.states.resize(n * states, 0.0);
    }
}

/// Coefficients of the two-step difference for this step: `V = weight Δλ/Δt - past (±|Δλ_previous|)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TwoStep {
    /// (1 + 2w)/(1 + w) with w = Δt/Δt_previous \[-\].
    pub weight: f64,
    /// w²/((1 + w) Δt) \[1/s\].
    pub past: f64,
}

impl TwoStep {
    /// Coefficients for a step `dt` that follows a step `previous`. For slip s, the derivative of the parabola through three
    /// times is `[(1+2w)/(1+w) (s_2 - s_1) - w²/(1+w) (s_1 - s_0)]/Δt`.
    pub(crate) fn new(dt: f64, previous: f64) -> Self {
        let w = dt / previous;
        Self { weight: (1.0 + 2.0 * w) / (1.0 + w), past: w * w / ((1.0 + w) * dt) }
    }
}

/// Values of the previous step that two-step differences need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreviousStep<'a> {
    pub two_step: TwoStep,
    /// Slip increments of the last step \[m\].
    pub slip: &'a [[f64; 2]],
    /// Points at the end of that step.
    pub contact: &'a [NormalPoint],
}

impl PreviousStep<'_> {
    /// Weight and offset of a point whose trial traction points along `direction`. A point that was open has no past and starts
    /// with backward Euler.
    fn weight_and_offset(&self, p: usize, direction: &[f64; 2]) -> (f64, f64) {
        if !self.contact[p].closed {
            return (1.0, 0.0);
        }
        // The previous slip enters as path length; its sign shows whether slip continues or reverses.
        let along = dot(&self.slip[p], direction);
        let length = norm(&self.slip[p]);
        (self.two_step.weight, if along == 0.0 { 0.0 } else { self.two_step.past * length.copysign(along) })
    }
}

/// Tractions from which trials start, and the spring along which they grow.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrialSpring<'a> {
    /// Start of each point \[Pa\]; the committed tractions if `None`.
    pub from: Option<&'a [[f64; 2]]>,
    /// Stiffness \[Pa/m\].
    pub stiffness: f64,
}

/// Friction on an interface.
#[derive(Clone, Debug)]
pub(crate) struct Shear {
    pub law: Arc<dyn Law>,
    /// Tangential penalty E_t \[Pa/m\].
    pub stiffness: f64,
    /// Radiation damping η \[Pa s/m\]; 0 without.
    pub damping: f64,
    /// Normal traction and trial traction up to which both count as rounding of positions \[Pa\]. A point that barely touches
    /// has no strength and would slip in whichever direction rounding points. It sticks instead, so its tangent holds it.
    pub touch: [f64; 2],
    pub committed: History,
    pub trial: History,
    /// Terms of the tangent for each point.
    pub points: Vec<ShearPoint>,
    /// Number of regime switches of each point before the present forward step.
    pub switches: Vec<u8>,
    pub slices: Slices,
}

impl Shear {
    pub(crate) fn new(law: Arc<dyn Law>, stiffness: f64, touch: [f64; 2], points: usize) -> Self {
        let committed = History::new(points, law.as_ref());
        Self {
            stiffness,
            damping: 0.0,
            touch,
            trial: committed.clone(),
            committed,
            points: vec![ShearPoint::default(); points],
            switches: vec![0; points],
            slices: Slices::with_capacity(points, law.states()),
            law,
        }
    }

    /// Number of state variables per point.
    pub(crate) fn states(&self) -> usize {
        self.law.states()
    }

    /// Computes the implicit response of the law to the tangential increments behind a spring. Writes the trial history, the points
    /// of the tangent and the slip increments `step`.
    pub(crate) fn respond(
        &mut self,
        spring: TrialSpring<'_>,
        normal: &[NormalPoint],
        increment: &[[f64; 2]],
        dt: f64,
        previous: Option<PreviousStep<'_>>,
        step: &mut [[f64; 2]],
    ) -> Result<(), Failure> {
        self.gather(spring, normal, increment, previous);
        let s = &mut self.slices;
        s.size_answers(self.law.states());
        if !s.index.is_empty() {
            let lag = previous.map(|_| Lag { weight: &s.weight, offset: &s.offset });
            // The solver's own initial guess is better than the rate of the previous step as soon as the rate changes by more
            // than a few percent.
            let trials = Trials {
                points: &s.index,
                normal: &s.normal,
                trial: &s.trial,
                stiffness: spring.stiffness,
                dt,
                damping: self.damping,
                lag,
                near: None,
            };
            let out = Responses {
                traction: &mut s.traction,
                slip: &mut s.slip,
                rate: &mut s.rate,
                regime: &mut s.regime,
                d_trial: &mut s.d_trial,
                d_normal: &mut s.d_normal,
                states: &mut s.states,
            };
            self.law.respond(trials, &s.old, out)?;
        }
        self.scatter(step);
        Ok(())
    }

    fn gather(
        &mut self,
        spring: TrialSpring<'_>,
        normal: &[NormalPoint],
        increment: &[[f64; 2]],
        previous: Option<PreviousStep<'_>>,
    ) {
        let k = self.law.states();
        let from = spring.from.unwrap_or(&self.committed.traction);
        let s = &mut self.slices;
        s.clear();
        for (p, contact) in normal.iter().enumerate() {
            if !contact.closed {
                continue;
            }
            let mut trial = from[p];
            axpy(&mut trial, spring.stiffness, &increment[p]);
            let touches = contact.traction <= self.touch[0] && norm(&trial) <= self.touch[1];
            let size = if touches { 0.0 } else { norm(&trial) };
            let direction = if size > 0.0 { scaled(&trial, size.recip()) } else { [0.0; 2] };
            s.index.push(p);
            s.normal.push(contact.traction);
            s.trial.push(size);
            s.direction.push(direction);
            s.old.extend_from_slice(&self.committed.states[p * k..(p + 1) * k]);
            if let Some(previous) = previous {
                let (weight, offset) = previous.weight_and_offset(p, &direction);
                s.weight.push(weight);
                s.offset.push(offset);
            }
        }
    }

    /// Largest error in μ over the trial step, estimated from the points at its start, as it shows in the traction \[-\]. A
    /// point whose spring takes up most of the step moves little. A point that carried less than the mean normal traction at
    /// the start is weighted by what it carried; one that has just closed has no weight.
    pub(crate) fn error(&mut self, start: &[NormalPoint], dt: f64) -> f64 {
        let s = &mut self.slices;
        s.before.clear();
        for (&p, direction) in s.index.iter().zip(&s.direction) {
            // V is along the traction; rate and slip of the law are along the trial direction.
            let along = dot(&self.committed.traction[p], direction);
            s.before.push(if along < 0.0 { -self.committed.rate[p] } else { self.committed.rate[p] });
        }
        s.error.resize(s.index.len(), 0.0);
        let outcome = StepOutcome {
            points: &s.index,
            normal: &s.normal,
            before: &s.before,
            rate: &s.rate,
            slip: &s.slip,
            dt,
            old: &s.old,
            new: &s.states,
        };
        self.law.error(outcome, &mut s.error);
        let mean = s.normal.iter().sum::<f64>() / s.normal.len() as f64;
        // Without normal traction friction carries no load.
        if mean.is_nan() || mean <= 0.0 {
            return 0.0;
        }
        let shares = s.index.iter().zip(&s.normal).map(|(&p, f)| (f.min(start[p].traction) / mean).min(1.0));
        let each = s.error.iter().zip(&s.d_trial).zip(shares);
        each.map(|((e, d_trial), share)| e * (1.0 - d_trial) * share).fold(0.0, f64::max)
    }

    /// Writes each point once, with open points at rest, so that a sweep over a large interface costs no more than the memory
    /// traffic.
    fn scatter(&mut self, step: &mut [[f64; 2]]) {
        let k = self.law.states();
        let s = &self.slices;
        let trial = &mut self.trial;
        trial.states.copy_from_slice(&self.committed.states);
        let mut closed = s.index.iter().enumerate().peekable();
        for (p, (point, step)) in self.points.iter_mut().zip(step).enumerate() {
            let Some((i, _)) = closed.next_if(|(_, q)| **q == p) else {
                trial.traction[p] = [0.0; 2];
                trial.rate[p] = 0.0;
                trial.regime[p] = Regime::Stick;
                *point = ShearPoint::default();
                *step = [0.0; 2];
                continue;
            };
            let direction = s.direction[i];
            let traction = scaled(&direction, s.traction[i]);
            trial.traction[p] = traction;
            // Two-step differences may turn traction and rate against η. The history keeps V along t.
            trial.rate[p] = if s.traction[i] < 0.0 { -s.rate[i] } else { s.rate[i] };
            trial.regime[p] = s.regime[i];
            trial.states[p * k..(p + 1) * k].copy_from_slice(&s.states[i * k..(i + 1) * k]);
            *step = scaled(&direction, s.slip[i]);
            *point = ShearPoint {
                traction,
                direction,
                // The limit of τ/|t^e| at |t^e| = 0 is the derivative.
                ratio: if s.trial[i] > 0.0 { s.traction[i] / s.trial[i] } else { s.d_trial[i] },
                d_trial: s.d_trial[i],
                d_normal: s.d_normal[i],
            };
        }
    }
}
