//! Claims and their assessment.
//!
//! A claim states a quantity, the evidence behind its reference value, a bound, and the reason for the bound. The harness
//! computes the error and compares it with the bound. As a negative control, the same claim with its value shifted by three
//! bounds must fail; if it does not, the bound is meaningless and the claim disagrees.

use crate::capability::Capability;
use crate::cost::Cost;
use crate::order::OrderTest;
use schemars::JsonSchema;
use serde::Serialize;

/// Below this ratio of error to bound a claim is slack: it must say why its bound is not tighter.
pub const SLACK_BELOW: f64 = 0.1;

/// Above this ratio of error to bound a claim is thin.
pub const THIN_ABOVE: f64 = 0.8;

/// Number of bounds by which the negative control shifts a value.
pub const CONTROL_BOUNDS: f64 = 3.0;

/// Kind of evidence behind a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Evidence {
    /// A closed-form solution or an identity.
    Exact,
    /// A manufactured solution.
    Manufactured,
    /// A series, quadrature or ordinary differential equation evaluated to known accuracy.
    SemiAnalytic,
    /// Extrapolation or a finer run of this code.
    ConvergedSelf,
    /// An independent implementation.
    OtherCode,
    /// A measurement.
    Experiment,
}

impl Evidence {
    /// All kinds of evidence, in the order of the coverage matrix.
    pub const ALL: [Evidence; 6] = [
        Evidence::Exact,
        Evidence::Manufactured,
        Evidence::SemiAnalytic,
        Evidence::ConvergedSelf,
        Evidence::OtherCode,
        Evidence::Experiment,
    ];

    /// Name in the report.
    pub fn name(self) -> &'static str {
        match self {
            Evidence::Exact => "exact",
            Evidence::Manufactured => "manufactured",
            Evidence::SemiAnalytic => "semi-analytic",
            Evidence::ConvergedSelf => "converged-self",
            Evidence::OtherCode => "other-code",
            Evidence::Experiment => "experiment",
        }
    }
}

/// Norm that combines the differences of several values into one error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Norm {
    /// Largest absolute difference; for one value, its absolute difference.
    #[default]
    Largest,
    /// Root mean square of the differences.
    RootMeanSquare,
}

impl Norm {
    fn evaluate(self, values: impl Iterator<Item = f64>) -> f64 {
        match self {
            // Keep a NaN: `f64::max` would drop it.
            Norm::Largest => values.fold(0.0, |m, v| if v.is_nan() || v.abs() > m { v.abs() } else { m }),
            Norm::RootMeanSquare => {
                let (sum, n) = values.fold((0.0, 0.0), |(s, n), v| (s + v * v, n + 1.0));
                (sum / n).sqrt()
            }
        }
    }
}

/// Test of the claim.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Test {
    /// ‖values − references‖ ≤ bound, in the unit of the values.
    Absolute {
        /// Value of the code.
        values: Vec<f64>,
        /// Reference value.
        references: Vec<f64>,
        /// Norm of differences.
        norm: Norm,
        /// Largest allowed error.
        bound: f64,
    },
    /// ‖values − references‖ ≤ bound ‖references‖.
    Relative {
        /// Value of the code.
        values: Vec<f64>,
        /// Reference value.
        references: Vec<f64>,
        /// Norm of differences.
        norm: Norm,
        /// Largest allowed relative error \[-\].
        bound: f64,
    },
    /// value ≤ bound, with a positive bound.
    AtMost {
        /// Value of the code.
        value: f64,
        /// Upper limit.
        bound: f64,
    },
    /// value ≥ bound, with a positive bound.
    AtLeast {
        /// Value of the code.
        value: f64,
        /// Lower limit.
        bound: f64,
    },
    /// A convergence order.
    Order(OrderTest),
    /// An exact count.
    Count {
        /// Value of the code.
        value: u64,
        /// Reference value.
        expected: u64,
    },
    /// A case that could not be run, with the error.
    NotRun {
        /// The error or the message of the panic.
        error: String,
    },
    /// A quantity that is not covered and that no issue names, with the reason.
    NotCovered {
        /// The reason.
        reason: String,
    },
}

/// The size of an error against its bound.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Measurement {
    /// The error.
    pub error: f64,
    /// The bound.
    pub bound: f64,
    /// Ratio error/bound; the claim holds if it is at most 1.
    pub ratio: f64,
}

impl Measurement {
    fn new(error: f64, bound: f64) -> Measurement {
        Measurement { error, bound, ratio: error / bound }
    }
}

impl Test {
    /// Error and bound, or the reason why the test cannot be assessed.
    ///
    /// # Errors
    /// A sentence saying what is not finite, not positive, or does not fit.
    pub fn measure(&self) -> Result<Measurement, String> {
        match self {
            Test::Absolute { values, references, norm, bound } => {
                let error = difference(values, references, *norm)?;
                judged(error, *bound)
            }
            Test::Relative { values, references, norm, bound } => {
                let error = difference(values, references, *norm)?;
                let scale = norm.evaluate(references.iter().copied());
                if scale == 0.0 {
                    return Err("a relative error needs a reference that is not zero".into());
                }
                judged(error / scale, *bound)
            }
            Test::AtMost { value, bound } => {
                judged(*value, *bound).map(|m| Measurement { ratio: m.ratio.max(0.0), ..m })
            }
            Test::AtLeast { value, bound } => {
                let m = judged(*value, *bound)?;
                // The ratio approaches 1 as the value approaches the limit; for values at or below zero it is infinite.
                let ratio = if *value > 0.0 { bound / value } else { f64::INFINITY };
                Ok(Measurement { ratio, ..m })
            }
            Test::Order(order) => {
                let observed = order.observed()?;
                judged(order.deviation(observed), order.tolerance)
            }
            Test::Count { value, expected } => {
                let error = value.abs_diff(*expected) as f64;
                Ok(Measurement { error, bound: 0.0, ratio: if error == 0.0 { 0.0 } else { f64::INFINITY } })
            }
            Test::NotRun { error } => Err(error.clone()),
            Test::NotCovered { reason } => Err(reason.clone()),
        }
    }

    /// The same test with its value shifted by `bounds` bounds in the direction of its error.
    ///
    /// In one-sided tests a value above a lower bound is shifted from that bound, and a negative value below an upper bound from
    /// zero. `None` if there is no value to shift.
    pub fn perturbed(&self, bounds: f64) -> Option<Test> {
        let mut moved = self.clone();
        match &mut moved {
            Test::Absolute { values, references, bound, .. } => push(values, references, bounds * *bound),
            Test::Relative { values, references, norm, bound } => {
                let scale = norm.evaluate(references.iter().copied());
                push(values, references, bounds * *bound * scale);
            }
            Test::AtMost { value, bound } => *value = value.max(0.0) + bounds * *bound,
            Test::AtLeast { value, bound } => *value = value.min(*bound) - bounds * *bound,
            Test::Order(order) => *order = order.perturbed(bounds),
            Test::Count { value, .. } => *value += bounds as u64,
            Test::NotRun { .. } | Test::NotCovered { .. } => return None,
        }
        Some(moved)
    }

    /// Bound in the unit of the uncertainty, for comparison with the uncertainty: a relative bound is multiplied by the size of
    /// the reference.
    fn absolute_bound(&self) -> Option<f64> {
        match self {
            Test::Absolute { bound, .. } | Test::AtMost { bound, .. } | Test::AtLeast { bound, .. } => {
                Some(*bound)
            }
            Test::Relative { references, norm, bound, .. } => {
                Some(bound * norm.evaluate(references.iter().copied()))
            }
            Test::Order(_) | Test::Count { .. } | Test::NotRun { .. } | Test::NotCovered { .. } => None,
        }
    }
}

/// Shifts every value away from its reference.
fn push(values: &mut [f64], references: &[f64], by: f64) {
    for (value, reference) in values.iter_mut().zip(references) {
        *value += if *value < *reference { -by } else { by };
    }
}

fn difference(values: &[f64], references: &[f64], norm: Norm) -> Result<f64, String> {
    if values.is_empty() {
        return Err("no value was given".into());
    }
    if values.len() != references.len() {
        return Err(format!("{} values are compared with {} references", values.len(), references.len()));
    }
    if references.iter().any(|r| !r.is_finite()) {
        return Err("a reference is not finite".into());
    }
    Ok(norm.evaluate(values.iter().zip(references).map(|(v, r)| v - r)))
}

fn judged(error: f64, bound: f64) -> Result<Measurement, String> {
    if !(bound.is_finite() && bound > 0.0) {
        return Err(format!("the bound {bound} is not a positive number"));
    }
    if !error.is_finite() {
        return Err(format!("the error is {error}"));
    }
    Ok(Measurement::new(error, bound))
}

/// The outcome of a claim.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The error is within the bound, and the negative control fails as required.
    Holds,
    /// The claim does not hold, or it could not be assessed.
    Disagrees,
    /// The quantity is not covered, for this reason.
    NotCovered(String),
}

/// A remark on the distance between error and bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Mark {
    /// The bound is more than ten times the error, and the claim gives the reason.
    Slack,
    /// The bound is more than ten times the error, without a reason.
    SlackUnexplained,
    /// The error is more than 0.8 of the bound.
    Thin,
}

/// A claim of a case.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Claim {
    /// The quantity, with its conditions.
    pub quantity: String,
    /// Unit of values, references, errors and bounds.
    pub unit: String,
    /// Norm as text, if it is not the default.
    pub norm: String,
    /// Test of the claim.
    pub test: Test,
    /// Kind of evidence; a claim without one disagrees.
    pub evidence: Option<Evidence>,
    /// Source of the reference.
    pub source: String,
    /// Uncertainty of the reference, in its unit.
    pub uncertainty: f64,
    /// Reason for the bound; a claim without a reason disagrees.
    pub because: String,
    /// Reason why the bound is not tighter although the error is far below it.
    pub why_not_tighter: String,
    /// Capabilities for which this claim is evidence.
    pub covers: Vec<Capability>,
    /// Cost of the run behind it.
    pub cost: Cost,
}

/// A judged claim.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct JudgedClaim {
    /// The claim.
    #[serde(flatten)]
    pub claim: Claim,
    /// Error and bound, if they could be measured.
    pub measured: Option<Measurement>,
    /// The outcome.
    pub verdict: Verdict,
    /// The remark on the bound.
    pub mark: Option<Mark>,
    /// Reason why the claim disagrees, in a sentence.
    pub problem: Option<String>,
}

impl Claim {
    /// Judges the claim and, if it holds, its negative control.
    pub fn judge(self) -> JudgedClaim {
        if let Test::NotCovered { reason } = &self.test {
            let verdict = Verdict::NotCovered(reason.clone());
            return JudgedClaim { claim: self, measured: None, verdict, mark: None, problem: None };
        }
        let measured = self.test.measure();
        let problem = self.problem(&measured);
        let verdict = if problem.is_none() { Verdict::Holds } else { Verdict::Disagrees };
        let measured = measured.ok();
        let mark = measured.and_then(|m| self.mark(&m));
        JudgedClaim { claim: self, measured, verdict, mark, problem }
    }

    fn problem(&self, measured: &Result<Measurement, String>) -> Option<String> {
        let measured = match measured {
            Ok(measured) => measured,
            Err(why) => return Some(why.clone()),
        };
        if measured.ratio.is_nan() || measured.ratio > 1.0 {
            return Some("the error exceeds the bound".into());
        }
        self.incomplete().or_else(|| self.control())
    }

    /// First required part that is missing from the claim.
    fn incomplete(&self) -> Option<String> {
        if self.evidence.is_none() || self.source.trim().is_empty() {
            return Some("the kind of evidence or its source is missing".into());
        }
        if self.because.trim().is_empty() {
            return Some("no reason is given for the bound".into());
        }
        if !self.uncertainty.is_finite() || self.uncertainty < 0.0 {
            return Some(format!("the uncertainty {} of the reference is not a number", self.uncertainty));
        }
        match self.test.absolute_bound() {
            Some(bound) if self.uncertainty > bound => Some(format!(
                "the reference is known to {} only, which is coarser than the bound {bound}",
                self.uncertainty
            )),
            _ => None,
        }
    }

    /// Problem found by the negative control: a claim that still holds with its value three bounds off tests nothing.
    fn control(&self) -> Option<String> {
        let moved = self.test.perturbed(CONTROL_BOUNDS)?;
        match moved.measure() {
            Ok(measured) if measured.ratio <= 1.0 => {
                Some(format!("negative control: moved by {CONTROL_BOUNDS} bounds, the claim still holds"))
            }
            _ => None,
        }
    }

    fn mark(&self, measured: &Measurement) -> Option<Mark> {
        // A count has no room, and an order that lies close to the expected one is no looser claim.
        if matches!(self.test, Test::Count { .. } | Test::Order(_)) || measured.ratio > 1.0 {
            return None;
        }
        if measured.ratio < SLACK_BELOW {
            let explained = !self.why_not_tighter.trim().is_empty();
            return Some(if explained { Mark::Slack } else { Mark::SlackUnexplained });
        }
        (measured.ratio > THIN_ABOVE).then_some(Mark::Thin)
    }
}
