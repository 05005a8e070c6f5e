//! Parts shared by the cases of spring-sliders: parameter sets, laws, runs, and references of the second implementation.

use crate::{Axis, CaseError, Plot};
use asperity_cycles::Thresholds;
use asperity_cycles::slider::{self, Problem, SliderRun, SliderState};
use asperity_friction::evolution::{ageing::Ageing, slip::Slip};
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider, SliderLaw, System};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use asperity_ode::{Counts, Method, Outcome};
use std::sync::Arc;

/// Reference friction of all sets.
pub const MU0: f64 = 0.6;
/// Reference slip rate of all sets \[m/s\].
pub const V_REF: f64 = 1e-6;
/// Tolerance of runs compared with references: the error of a few hundred steps a cycle is below their uncertainty.
pub const TIGHT: f64 = 1e-13;
/// The same with inertia: in equations with rates of 1e10 per second Newton's method has rounding errors of 1e-13.
pub const TIGHT_INERTIAL: f64 = 1e-12;
/// Source of the references.
pub const SOURCE: &str =
    "verification/independent/spring_slider.py: Taylor series of order 20 (heyoka) and scipy's DOP853 agree";

/// Evolution laws of the sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Ageing law.
    Ageing,
    /// Slip law.
    Slip,
}

/// A parameter set.
#[derive(Clone, Copy, Debug)]
pub struct Set {
    /// f_n \[Pa\].
    pub normal: f64,
    /// a \[-\].
    pub a: f64,
    /// b \[-\].
    pub b: f64,
    /// L \[m\].
    pub length: f64,
    /// Rate of the load point \[m/s\].
    pub load: f64,
    /// η \[Pa s/m\].
    pub damping: f64,
    /// k \[Pa/m\].
    pub stiffness: f64,
    /// M \[kg/m²\].
    pub mass: Option<f64>,
}

/// The set of QDYN's cross-check, with k = k_c/2.
pub const MILD: Set = Set {
    normal: 5e6,
    a: 0.01,
    b: 0.015,
    length: 1e-5,
    load: 1e-6,
    damping: 5e6,
    stiffness: 1.25e9,
    mass: None,
};

/// a/b = 0.3 and k/k_c = 0.05: V from 3e-31 to 3 m/s.
pub const HARD: Set = Set {
    normal: 50e6,
    a: 0.0045,
    b: 0.015,
    length: 1e-4,
    load: 1e-9,
    damping: 4.62444e6,
    stiffness: 0.05 * 50e6 * 0.0105 / 1e-4,
    mass: None,
};

/// A plate-boundary cycle of ten years: V from 1.7e-16 to 1.8 m/s.
pub const REFERENCE: Set = Set {
    normal: 50e6,
    a: 0.01,
    b: 0.015,
    length: 1e-4,
    load: 1e-9,
    damping: 4.62444e6,
    stiffness: 0.01 * 50e6 * 0.005 / 1e-4,
    mass: None,
};

/// The mild set with inertia instead of damping: an oscillator with a period of 0.01 s.
pub const INERTIAL: Set = Set { damping: 0.0, mass: Some(OSCILLATOR * OSCILLATOR * 1.25e9), ..MILD };

/// 0.01 s over 2π.
const OSCILLATOR: f64 = 0.01 / std::f64::consts::TAU;

impl Set {
    /// Critical stiffness f_n (b - a)/L \[Pa/m\].
    pub fn critical(&self) -> f64 {
        self.normal * (self.b - self.a) / self.length
    }

    /// The set at `ratio` times the critical stiffness.
    pub fn at(self, ratio: f64) -> Self {
        Self { stiffness: ratio * self.critical(), ..self }
    }

    /// Friction law of the set.
    ///
    /// # Errors
    /// Parameters out of range.
    pub fn law(&self, kind: Kind) -> Result<Arc<dyn SliderLaw>, CaseError> {
        let form = Regularised(Parameters::new(MU0, self.a, V_REF)?);
        Ok(match kind {
            Kind::Ageing => {
                Arc::new(RateLaw::new(form, Ageing::new(self.b, self.length, V_REF)?, self.load, None)?)
            }
            Kind::Slip => {
                Arc::new(RateLaw::new(form, Slip::new(self.b, self.length, V_REF)?, self.load, None)?)
            }
        })
    }

    /// One slider with this law.
    pub fn slider(&self, law: Arc<dyn SliderLaw>) -> Slider {
        Slider {
            law,
            stiffness: self.stiffness,
            damping: self.damping,
            mass: self.mass,
            normal: History::Constant(self.normal),
        }
    }

    /// A plan that starts at `factor` times the rate of the load point, with states steady at the rate of the load point.
    ///
    /// # Errors
    /// Parameters out of range.
    pub fn plan(&self, kind: Kind, factor: f64, end: f64) -> Result<Problem, CaseError> {
        plan(self.slider(self.law(kind)?), History::Constant(self.load), self.load, factor, end)
    }
}

/// A plan for one slider that starts at `factor` times `steady`, with states steady at `steady` \[m/s\].
///
/// # Errors
/// Parameters out of range.
pub fn plan(slider: Slider, load: History, steady: f64, factor: f64, end: f64) -> Result<Problem, CaseError> {
    let mut states = vec![0.0; slider.law.states()];
    slider.law.steady(steady.ln(), &mut states);
    let inertial = slider.mass.is_some();
    let system = System::new(vec![slider], vec![], load)?;
    let start = system.start(&[factor * steady], &[states])?;
    let mut plan = Problem::new(system, start, end);
    plan.tolerance = if inertial { TIGHT_INERTIAL } else { TIGHT };
    Ok(plan)
}

/// Slip rate above which an event begins \[m/s\].
pub const EVENT: f64 = 1e-3;

/// Stops the plan after `number` events above 1 mm/s, and records their peaks.
pub fn events(plan: &mut Problem, number: usize) {
    plan.events = Some(Thresholds { on: EVENT, off: 1e-4 });
    plan.most_events = Some(number);
    plan.peaks = true;
}

/// Work in units of a right-hand side. A Jacobian column, in dual numbers, counts as one; a factorisation as a half and
/// a solve as a quarter, the mean of a real and a complex one. These weigh multiplications for two or three unknowns
/// against an exponential, a logarithm and the rest of a right-hand side.
pub fn work(counts: &Counts, unknowns: usize) -> f64 {
    let linear = 0.5 * counts.factorisations as f64 + 0.25 * counts.solves as f64;
    counts.rates as f64 + unknowns as f64 * counts.jacobians as f64 + linear
}

/// Runs a plan to its end.
///
/// # Errors
/// If it fails.
pub fn finish(plan: &Problem) -> Result<SliderRun, CaseError> {
    let run = slider::run(plan, &mut ())?;
    match &run.outcome {
        Outcome::Failed { reason } => Err(format!(
            "failed at {:e} s: {}",
            run.at.seconds(),
            run.progress.hint.clone().unwrap_or(reason.to_string())
        )
        .into()),
        Outcome::Completed | Outcome::Stopped => Ok(run),
    }
}

/// Times \[s\] and slip rates \[m/s\] of the first slider at the steps of a run.
///
/// # Errors
/// If it fails.
pub fn rates(plan: &Problem) -> Result<Vec<(f64, f64)>, CaseError> {
    let mut seen = Vec::new();
    let mut look = |now: &SliderState<'_>| seen.push((now.at.seconds(), now.conditions[0].rate));
    match slider::run(plan, &mut look)?.outcome {
        Outcome::Failed { reason } => Err(reason.to_string().into()),
        Outcome::Completed | Outcome::Stopped => Ok(seen),
    }
}

/// A diagram of slip rates against time, without curves.
pub fn through_time(title: &str) -> Plot {
    Plot::xy(title, "time [s]", "slip rate [m/s]").axes(Axis::Linear, Axis::Log)
}

/// Slip rate and friction of the first slider at the given times, each from a separate run that ends there.
///
/// # Errors
/// If a run fails.
pub fn at_times(plan: &Problem, times: &[f64]) -> Result<Vec<(f64, f64)>, CaseError> {
    times
        .iter()
        .map(|&time| {
            let until = Problem { end: time, events: None, peaks: false, most_events: None, ..plan.clone() };
            let run = finish(&until)?;
            let (speed, mu) =
                plan.system.sliders()[0].law.slip(plan.system.slider_unknowns(0, &run.unknowns));
            Ok((speed.rate, mu))
        })
        .collect()
}

/// Largest friction coefficient of the first slider after a time: bracketed by outputs, then found by golden-section
/// search, each value from a run that ends there.
///
/// # Errors
/// If a run fails.
pub fn largest_friction(plan: &Problem, after: f64) -> Result<f64, CaseError> {
    let mut seen: Vec<(f64, f64)> = Vec::new();
    let mut look = |now: &SliderState<'_>| {
        if now.at.seconds() > after {
            seen.push((now.at.seconds(), now.conditions[0].friction));
        }
    };
    let run = slider::run(plan, &mut look)?;
    if let Outcome::Failed { reason } = run.outcome {
        return Err(reason.to_string().into());
    }
    let highest = seen.iter().enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1)).ok_or("no output")?.0;
    let time = |i: usize| seen.get(i).map_or(plan.end, |s| s.0);
    let (mut low, mut high) = (if highest == 0 { after } else { time(highest - 1) }, time(highest + 1));
    let friction = |t: f64| -> Result<f64, CaseError> { Ok(at_times(plan, &[t])?[0].1) };
    let mut largest = seen[highest].1;
    // A millionth of the bracket suffices: friction is flat there, so that its error is the square of that.
    while high - low > 1e-6 * (time(highest + 1) - time(highest)) {
        let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        let (fa, fb) = (friction(a)?, friction(b)?);
        largest = largest.max(fa).max(fb);
        if fa > fb { high = b } else { low = a }
    }
    Ok(largest)
}

/// Golden ratio minus one.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// Results of the second implementation.
pub struct Independent(serde_json::Value);

impl Independent {
    /// Reads the results.
    ///
    /// # Errors
    /// If they are not JSON.
    pub fn read() -> Result<Self, CaseError> {
        Ok(Self(serde_json::from_str(include_str!("../independent/spring_slider.json"))?))
    }

    /// Reads the results for laws that `spring_slider.py` does not have.
    ///
    /// # Errors
    /// If they are not JSON.
    pub fn read_laws() -> Result<Self, CaseError> {
        Ok(Self(serde_json::from_str(include_str!("../independent/slider_laws.json"))?))
    }

    /// A list of numbers.
    ///
    /// # Errors
    /// If there is no such list.
    pub fn numbers(&self, case: &str, key: &str) -> Result<Vec<f64>, CaseError> {
        let value = self.0[case]["quantities"][key].clone();
        serde_json::from_value(value).map_err(|_| format!("no list `{key}` of `{case}`").into())
    }

    /// A number.
    ///
    /// # Errors
    /// If there is no such number.
    pub fn number(&self, case: &str, key: &str) -> Result<f64, CaseError> {
        self.0[case]["quantities"][key]
            .as_f64()
            .ok_or_else(|| format!("no number `{key}` of `{case}`").into())
    }
}

/// The method that suits a set best, with its tight tolerance.
pub fn method(set: &Set) -> (Method, f64) {
    if set.mass.is_some() { (Method::Radau5, TIGHT_INERTIAL) } else { (Method::Dop853, TIGHT) }
}
