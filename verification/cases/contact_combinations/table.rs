//! Outcomes of all combinations and the claims on them.

use super::cell::{Cell, ENFORCEMENTS, End, Face, Kinematics, LAWS, Law, Start};
use crate::{Capability, CaseError, Evidence, Ledger};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Bound on the relative difference of forces between forward and implicit steps: twice the residual that a forward step may leave.
const APART: f64 = 2e-4;
/// Bound on the difference between traction and strength at the recorded rate and state, over the largest strength: rounding of
/// the rate, amplified by the exponential of the law.
const MISSED: f64 = 1e-12;
/// The same where tractions are unknowns and the friction law is an equation, which Newton's method solves to 1e-11 of the
/// largest force. The point at a corner of the die bears a normal force 2.5 times its shear force, on half the area of the
/// others.
const SOLVED: f64 = 5e-11;
/// Bound on the difference between traction and steady-state strength, over the largest strength.
const UNSTEADY: f64 = 2e-4;

/// Number of combinations between two progress lines.
const PROGRESS: usize = 200;

/// The enforcement whose multipliers are unknowns.
const UNKNOWNS: &str = ENFORCEMENTS[2];

/// Outcomes.
#[derive(Default)]
pub struct Table {
    rows: Vec<Vec<String>>,
    reasons: Vec<String>,
    /// Differences of forces between the steppers, for combinations that ran with both.
    apart: Vec<f64>,
    /// Differences between traction and strength.
    missed: Vec<f64>,
    /// The same where tractions are unknowns.
    solved: Vec<f64>,
    /// The same with the strength in steady state.
    unsteady: Vec<f64>,
    residual: f64,
    stopped: u64,
    /// Number of runs that end where a drop of friction releases many points at once.
    events: u64,
    refused: u64,
    ran: u64,
}

impl Table {
    /// Runs combinations with both steppers. Combinations that differ only in the law share a row.
    ///
    /// # Errors
    /// If a run cannot be set up after its plan was accepted.
    pub fn from_cells(cells: &[Cell]) -> Result<Self, CaseError> {
        let done = AtomicUsize::new(0);
        let both = |cell: &Cell| {
            let ends =
                [false, true].map(|forward| Cell { forward, ..*cell }.end().map_err(|e| e.to_string()));
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            #[expect(clippy::print_stderr, reason = "a table of half an hour shows that it lives")]
            if done.is_multiple_of(PROGRESS) {
                eprintln!(
                    "  {done} of {} combinations, the last: {}, {}",
                    cells.len(),
                    in_words(cell),
                    cell.law.name()
                );
            }
            ends
        };
        let ends: Vec<_> = cells.par_iter().map(both).collect();
        let mut table = Self::default();
        let mut written = None;
        for (cell, ends) in cells.iter().zip(ends) {
            let name = in_words(cell);
            let key = (name.clone(), cell.enforcement);
            if written.as_ref() != Some(&key) {
                table.begin(&name, cell.enforcement);
                written = Some(key);
            }
            let [implicit, forward] = ends;
            table.add(cell, &[implicit?, forward?]);
        }
        Ok(table)
    }

    /// Adds two rows, one for each stepper.
    fn begin(&mut self, name: &str, enforcement: &str) {
        for stepper in ["implicit", "static-explicit"] {
            let mut row: Vec<String> = [name, enforcement, stepper].map(str::to_owned).into();
            row.extend(LAWS.iter().map(|_| "-".to_owned()));
            self.rows.push(row);
        }
    }

    /// Enters the outcomes of a law with both steppers into the last two rows.
    fn add(&mut self, cell: &Cell, ends: &[End; 2]) {
        let mut words = [self.note(cell, &ends[0]), self.note(cell, &ends[1])];
        if let [End::Ran { forces: one, .. }, End::Ran { forces: other, .. }] = ends {
            let apart = one.iter().zip(other).map(|(a, b)| distance(a, b)).fold(0.0, f64::max);
            self.apart.push(apart);
            words[1] += &format!(", {apart:.0e}");
        }
        let column = 3 + LAWS.iter().take_while(|l| **l != cell.law).count();
        for (row, words) in self.rows.iter_mut().rev().zip(words.into_iter().rev()) {
            row[column] = words;
        }
    }

    /// Counts an outcome and returns its text in the table.
    fn note(&mut self, cell: &Cell, end: &End) -> String {
        match end {
            End::Ran { missed, unsteady, residual, .. } => {
                self.ran += 1;
                if cell.enforcement == UNKNOWNS { &mut self.solved } else { &mut self.missed }.push(*missed);
                self.unsteady.extend(unsteady);
                self.residual = self.residual.max(*residual);
                format!("{missed:.0e}")
            }
            End::Refused(reason) => {
                self.refused += 1;
                format!("refused ({})", self.reason(reason))
            }
            End::Stopped(reason) if cell.law == Law::Kinetic && reason.starts_with("instability") => {
                self.events += 1;
                format!("event ({})", self.reason(reason))
            }
            End::Stopped(reason) => {
                self.stopped += 1;
                format!("stopped ({})", self.reason(reason))
            }
        }
    }

    /// Number of a reason in the list of reasons.
    fn reason(&mut self, reason: &str) -> usize {
        let known = self.reasons.iter().position(|r| r == reason);
        known.unwrap_or_else(|| {
            self.reasons.push(reason.to_owned());
            self.reasons.len() - 1
        }) + 1
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// Difference of two forces over the magnitude of the first.
pub fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    size(std::array::from_fn(|i| a[i] - b[i])) / size(*a)
}

fn in_words(cell: &Cell) -> String {
    let Cell { kinematics, face, bodies, pairing, start, .. } = *cell;
    let space = match kinematics {
        Kinematics::PlaneStrain => "plane strain",
        Kinematics::PlaneStress => "plane stress",
        Kinematics::Axisymmetric => "axisymmetric",
        Kinematics::Space => "3d",
    };
    format!(
        "{space}{}, {}, {} strain, {}, {} sliding{}",
        if face == Face::Round { ", round" } else { "" },
        if bodies.plastic { "J2" } else { "elastic" },
        if bodies.finite { "finite" } else { "small" },
        if pairing.mortar { "mortar" } else { "node-to-point" },
        if pairing.follows { "finite" } else { "small" },
        if start == Start::Smooth { ", pressed without friction" } else { "" }
    )
}

/// Records the claims and the table.
pub fn claims(ledger: &mut Ledger, table: Table) {
    ledger
        .claim("combinations that stopped before their end")
        .count(table.stopped, 0)
        .evidence(Evidence::Exact, "every combination has a solution: the slab bears the die, and no law but the drop of static-kinetic friction weakens faster than the bodies unload it")
        .because("what runs is right and what cannot run is refused beforehand")
        .record();
    strengths(ledger, &table);
    ledger
        .claim(format!(
            "largest difference of the force on the die between static-explicit and implicit steps, at the ends of both stages, over its size, {} pairs",
            table.apart.len()
        ))
        .value(largest(&table.apart))
        .at_most(APART)
        .evidence(Evidence::SemiAnalytic, "implicit steps, whose balance holds to 1e-11")
        .because("a forward step may leave 1e-4 of the largest force out of balance, and what steps leave is taken up by the next")
        .why_not_tighter("the residual is measured at a node, the force is that of the whole die")
        .covers(&[Capability::StaticExplicit])
        .record();
    ledger
        .claim("largest residual left by a step over the largest force, all runs")
        .value(table.residual)
        .at_most(1e-4)
        .evidence(Evidence::Exact, "balance of forces")
        .because("what exceeds `drift`, 1e-4 by default, is corrected at once")
        .why_not_tighter("smaller residuals are carried into the next step")
        .covers(&[Capability::StaticExplicit])
        .record();
    let mut head = vec!["bodies and contact", "enforcement", "stepper"];
    head.extend(LAWS.iter().map(|law| law.name()));
    ledger.table(
        "distance of shear tractions from the strength; of static-explicit steps also of their forces from implicit ones",
        &head,
        table.rows,
    );
    for (k, reason) in table.reasons.iter().enumerate() {
        ledger.note(format!("({}) {reason}", k + 1));
    }
    ledger.note(format!(
        "{} combinations ran, {} were refused, {} ended at an event.",
        table.ran, table.refused, table.events
    ));
}

/// Claims on the tractions of points that slide.
fn strengths(ledger: &mut Ledger, table: &Table) {
    let own = "mu f_n, F_limit, or the law's closed form at the rate and state that the outputs show; at rest under static-kinetic friction at most mu_s f_n";
    for (tractions, runs, bound, because) in [
        (
            "a shear traction",
            &table.missed,
            MISSED,
            "tractions are answers of the law at every accepted state",
        ),
        (
            "a shear traction that is an unknown",
            &table.solved,
            SOLVED,
            "the law is an equation, solved to 1e-11 of the largest force",
        ),
    ] {
        ledger
            .claim(format!(
                "largest distance of {tractions} from the strength of its law after sliding, at the point's own rate and state, over the \
                 largest strength, {} runs",
                runs.len()
            ))
            .value(largest(runs))
            .at_most(bound)
            .evidence(Evidence::Exact, own)
            .because(because)
            .why_not_tighter("the whole table has 3840 runs, of which unknown tractions reach 4.3e-11")
            .record();
    }
    ledger
        .claim(format!(
            "largest distance of a shear traction from the steady strength after twenty lengths of slip under a flat face, over the largest strength, {} runs",
            table.unsteady.len()
        ))
        .value(largest(&table.unsteady))
        .at_most(UNSTEADY)
        .evidence(Evidence::Exact, "the steady strength at the point's own slip rate")
        .because("states are steady to e^-20, and the rate changes by what bodies move beside the die")
        .why_not_tighter("a slip rate that still changes by a percent a length is off its steady strength by (a - b) times as much")
        .record();
}
