//! Judgement of a result: each value against its reference.

use super::reference::{Place, Quantity, Reference};
use super::submission::Submission;

/// Outcome for a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Within the uncertainty of the reference.
    Within,
    /// Within the tolerance.
    Agrees,
    /// Beyond the tolerance.
    Differs,
    /// Required, and not or not completely given.
    Missing,
    /// Optional, and not given.
    NotGiven,
}

impl Verdict {
    /// The verdict as text.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Within => "agrees, within the uncertainty",
            Self::Agrees => "agrees",
            Self::Differs => "DIFFERS",
            Self::Missing => "MISSING",
            Self::NotGiven => "not given",
        }
    }
}

/// A quantity of a result with its verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityVerdict<'a> {
    /// Quantity.
    pub quantity: &'a Quantity,
    /// Number of values given.
    pub given: usize,
    /// Value farthest from its reference in terms of the tolerance, with that reference.
    pub worst: Option<(f64, Place)>,
    /// Verdict.
    pub verdict: Verdict,
}

impl QuantityVerdict<'_> {
    /// Largest difference over tolerance.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        self.worst.map(|(value, place)| ratio(value, &place))
    }

    /// Suspicion that a value is in another unit, as a sentence.
    #[must_use]
    pub fn suspicion(&self) -> Option<String> {
        let (value, place) = self.worst.filter(|_| self.verdict == Verdict::Differs)?;
        let unit = &self.quantity.unit;
        let scale = value / place.value;
        let power = scale.abs().log10().round();
        let near = (scale.abs() / 10f64.powf(power)).log10().abs() < POWER;
        match scale {
            s if !s.is_finite() || s == 0.0 || !near => None,
            s if s < 0.0 && power == 0.0 => Some("the sign is the opposite of that of the reference".into()),
            _ if power.abs() >= 3.0 => {
                Some(format!("the value is 1e{power} times the reference: is it in {unit}?"))
            }
            _ => None,
        }
    }
}

/// Decades around a power of ten in which another unit is suspected: 12 %, more than a result differs by that is computed well.
const POWER: f64 = 0.05;

fn ratio(value: f64, place: &Place) -> f64 {
    (value - place.value).abs() / place.tolerance
}

/// A result with its verdicts.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement<'a> {
    /// Benchmark.
    pub reference: &'a Reference,
    /// Quantities in the order of the reference.
    pub rows: Vec<QuantityVerdict<'a>>,
}

impl<'a> Judgement<'a> {
    /// Judges a result.
    #[must_use]
    pub fn new(reference: &'a Reference, result: &Submission) -> Self {
        Self { reference, rows: reference.quantities.iter().map(|q| judged(q, result)).collect() }
    }

    /// True if every required value is given and no value differs.
    #[must_use]
    pub fn agrees(&self) -> bool {
        !self.rows.iter().any(|row| matches!(row.verdict, Verdict::Differs | Verdict::Missing))
    }

    /// Number of required quantities that agree, and of all required quantities.
    #[must_use]
    pub fn required(&self) -> (usize, usize) {
        let required = || self.rows.iter().filter(|row| row.quantity.required);
        let agree = required().filter(|row| matches!(row.verdict, Verdict::Within | Verdict::Agrees));
        (agree.count(), required().count())
    }

    /// Largest difference over tolerance of all values.
    #[must_use]
    pub fn largest(&self) -> Option<f64> {
        self.rows.iter().filter_map(QuantityVerdict::ratio).max_by(f64::total_cmp)
    }
}

fn judged<'a>(quantity: &'a Quantity, result: &Submission) -> QuantityVerdict<'a> {
    let values = || quantity.places.iter().filter_map(|p| Some((result.value(quantity, p.at)?, *p)));
    let given = values().count();
    let worst = values().max_by(|a, b| ratio(a.0, &a.1).total_cmp(&ratio(b.0, &b.1)));
    let within = values().all(|(value, place)| (value - place.value).abs() <= place.uncertainty);
    let verdict = match worst {
        Some((value, place)) if ratio(value, &place) > 1.0 => Verdict::Differs,
        _ if quantity.required && given < quantity.places.len() => Verdict::Missing,
        None => Verdict::NotGiven,
        Some(_) if within => Verdict::Within,
        Some(_) => Verdict::Agrees,
    };
    QuantityVerdict { quantity, given, worst, verdict }
}
