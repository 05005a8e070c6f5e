//! Energy budgets of runs.

use crate::Warning;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Imbalance above which a run warns: forces and speeds then err by some per cent.
const DOUBTFUL: f64 = 0.05;

/// Share of the largest part below which a line of text leaves a part out: sums over thousands of points and steps, each rounded
/// to 1e-16, leave this much of parts that are zero.
const ROUNDING: f64 = 1e-12;

/// Energy budget as reports have it, of every kind of run: what was given is kept, lost or missing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct EnergyTable {
    /// J; J/m of thickness in plane strain and antiplane motion; J/m² for spring-sliders.
    pub unit: &'static str,
    /// Energies that are stored, by their names.
    pub kept: BTreeMap<&'static str, f64>,
    /// Energies that are dissipated or carried away.
    pub lost: BTreeMap<&'static str, f64>,
    /// Works, and energy at the start.
    pub given: BTreeMap<&'static str, f64>,
    /// Energy given minus energy kept and lost, at the end.
    pub missing: f64,
    /// Missing energy over the largest part \[-\]: the largest of all steps of bodies and their interfaces, otherwise that at the end.
    pub imbalance: f64,
    /// Sum over steps of the size of the work on openings, which closing returns; it counts as a part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exchanged: Option<f64>,
}

/// Name and value of an energy.
pub type Part = (&'static str, f64);

/// Energies of a run by their names, each with a positive sign: what was given is kept, lost or missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Energies {
    /// Works, and energy at the start.
    pub given: Vec<Part>,
    /// Energies that are stored.
    pub kept: Vec<Part>,
    /// Energies that are dissipated or carried away.
    pub lost: Vec<Part>,
    /// Sum over steps of the size of work that a later step returns; it counts as a part. 0 without any.
    pub exchanged: f64,
}

impl Energies {
    /// Energy given minus energy kept and lost.
    #[must_use]
    pub fn missing(&self) -> f64 {
        let [given, kept, lost] = [&self.given, &self.kept, &self.lost].map(|parts| sum(parts));
        given - kept - lost
    }

    /// Magnitude of the largest part.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let parts = self.given.iter().chain(&self.kept).chain(&self.lost);
        parts.fold(self.exchanged, |largest, part| largest.max(part.1.abs()))
    }

    /// Missing energy over the largest part \[-\].
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let largest = self.largest();
        if largest > 0.0 { self.missing().abs() / largest } else { 0.0 }
    }

    /// An energy by its name; 0 without one.
    #[must_use]
    pub fn part(&self, name: &str) -> f64 {
        let mut parts = self.given.iter().chain(&self.kept).chain(&self.lost);
        parts.find(|part| part.0 == name).map_or(0.0, |part| part.1)
    }
}

fn sum(parts: &[Part]) -> f64 {
    parts.iter().map(|part| part.1).sum()
}

impl EnergyTable {
    /// The budget of these energies at the end of a run.
    #[must_use]
    pub fn new(unit: &'static str, energies: &Energies) -> Self {
        let table = |parts: &[Part]| parts.iter().copied().collect();
        Self {
            unit,
            kept: table(&energies.kept),
            lost: table(&energies.lost),
            given: table(&energies.given),
            missing: energies.missing(),
            imbalance: energies.imbalance(),
            exchanged: (energies.exchanged != 0.0).then_some(energies.exchanged),
        }
    }

    /// An energy by its name; 0 without one.
    #[must_use]
    pub fn part(&self, name: &str) -> f64 {
        [&self.kept, &self.lost, &self.given]
            .into_iter()
            .find_map(|parts| parts.get(name))
            .copied()
            .unwrap_or(0.0)
    }

    /// The budget in a line, without parts that are zero or rounding of the others.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!("energy [{}]:", self.unit);
        let all = [&self.given, &self.kept, &self.lost];
        let largest =
            all.iter().flat_map(|parts| parts.values()).fold(0.0_f64, |l, value| l.max(value.abs()));
        if largest == 0.0 {
            return text + " none was given, kept or lost";
        }
        for (name, parts) in [("given", &self.given), ("kept", &self.kept), ("lost", &self.lost)] {
            let parts: Vec<String> = parts
                .iter()
                .filter(|part| part.1.abs() > ROUNDING * largest)
                .map(|(name, value)| format!("{name} {value:.6e}"))
                .collect();
            if !parts.is_empty() {
                let _ = write!(text, " {name} {};", parts.join(", "));
            }
        }
        let _ = write!(text, " closes to {:.1e} of the largest", self.imbalance);
        text
    }

    /// Warning about a budget that does not close, with the usual `cause` and the help against it.
    #[must_use]
    pub fn doubt(&self, cause: &str, help: &str) -> Option<Warning> {
        (self.imbalance > DOUBTFUL).then(|| {
            let message =
                format!("the energy budget misses {:.2} of its largest part: {cause}", self.imbalance);
            Warning::at(0..0, message, help)
        })
    }
}

/// Closure of an energy budget during a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Closure {
    /// Largest missing energy so far \[J\].
    missing: f64,
    /// Largest part so far \[J\].
    largest: f64,
    /// Largest energy that the time integration has added so far \[J\].
    added: f64,
}

impl Closure {
    /// Notes the budget of a step.
    pub fn note(&mut self, energies: &Energies) {
        self.missing = self.missing.max(energies.missing().abs());
        self.largest = self.largest.max(energies.largest());
        self.added = self.added.max(-energies.part("numerical"));
    }

    /// Warning about steps that are too long for what moves: the time integration may dissipate energy, and adds hardly any.
    #[must_use]
    pub fn added(&self) -> Option<Warning> {
        (self.added > DOUBTFUL * self.largest).then(|| {
            let share = self.added / self.largest;
            let message =
                format!("the time integration has added {share:.2} of the largest energy: the steps are too long for what moves");
            Warning::at(0..0, message, "take shorter steps, by `steps`, `max_step` or a smaller `tolerance`")
        })
    }

    /// Budget at the end of a run, with the largest imbalance of all steps.
    #[must_use]
    pub fn table(&self, unit: &'static str, end: &Energies) -> EnergyTable {
        let imbalance = if self.missing == 0.0 { 0.0 } else { self.missing / self.largest };
        EnergyTable { imbalance, ..EnergyTable::new(unit, end) }
    }
}
