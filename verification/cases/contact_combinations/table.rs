//! The outcomes of all combinations, and what is claimed of them.

use super::cell::{Bodies, Cell, End, Kinematics, LAWS, Law, Pairing, Start};
use crate::{Capability, CaseError, Evidence, Ledger};

/// Bound on forces of forward against implicit steps, over their size: twice what a forward step may leave unbalanced.
const APART: f64 = 2e-4;
/// Bound on tractions against the strength, over the largest.
const MISSED: f64 = 2e-4;

/// Outcomes.
#[derive(Default)]
pub struct Table {
    rows: Vec<Vec<String>>,
    reasons: Vec<String>,
    /// Differences of forces between the steppers, of combinations that ran with both.
    apart: Vec<f64>,
    /// Distances of tractions from their strength.
    missed: Vec<f64>,
    residual: f64,
    stopped: u64,
    refused: u64,
    ran: u64,
}

impl Table {
    /// Runs combinations with both steppers.
    pub fn compare(
        &mut self,
        (kinematics, bodies, pairing): (Kinematics, Bodies, Pairing),
        laws: &[Law],
        enforcements: &[&'static str],
        start: Start,
    ) -> Result<(), CaseError> {
        for &enforcement in enforcements {
            let mut row = [vec![], vec![]];
            for law in LAWS {
                if !laws.contains(&law) {
                    row.iter_mut().for_each(|r| r.push("-".to_owned()));
                    continue;
                }
                let cell = Cell { kinematics, bodies, pairing, enforcement, law, start, forward: false };
                let ends = [cell.end()?, Cell { forward: true, ..cell }.end()?];
                for (words, end) in row.iter_mut().zip(&ends) {
                    words.push(self.note(end));
                }
                if let [End::Ran { forces: one, .. }, End::Ran { forces: other, .. }] = &ends {
                    let apart = one.iter().zip(other).map(|(a, b)| distance(a, b)).fold(0.0, f64::max);
                    self.apart.push(apart);
                    row[1].last_mut().into_iter().for_each(|words| *words += &format!(", {apart:.0e}"));
                }
            }
            for (words, stepper) in row.into_iter().zip(["implicit", "static-explicit"]) {
                let mut cells = vec![in_words(kinematics, bodies, pairing, start)];
                cells.extend([enforcement.to_owned(), stepper.to_owned()]);
                cells.extend(words);
                self.rows.push(cells);
            }
        }
        Ok(())
    }

    /// Takes note of an outcome; what the table says of it.
    fn note(&mut self, end: &End) -> String {
        match end {
            End::Ran { missed, residual, .. } => {
                self.ran += 1;
                self.missed.push(*missed);
                self.residual = self.residual.max(*residual);
                format!("{missed:.0e}")
            }
            End::Refused(reason) => {
                self.refused += 1;
                format!("refused ({})", self.reason(reason))
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

/// Distance of two forces over the size of the first.
fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    size(std::array::from_fn(|i| a[i] - b[i])) / size(*a)
}

fn in_words(kinematics: Kinematics, bodies: Bodies, pairing: Pairing, start: Start) -> String {
    let space = match kinematics {
        Kinematics::PlaneStrain => "plane strain",
        Kinematics::PlaneStress => "plane stress",
        Kinematics::Space => "3d",
    };
    format!(
        "{space}, {}, {} strain, {}, {} sliding{}",
        if bodies.plastic { "J2" } else { "elastic" },
        if bodies.finite { "finite" } else { "small" },
        if pairing.mortar { "mortar" } else { "node-to-point" },
        if pairing.follows { "finite" } else { "small" },
        if start == Start::Smooth { ", pressed without friction" } else { "" }
    )
}

/// Records claims and table.
pub fn claims(ledger: &mut Ledger, table: Table) {
    ledger
        .claim("combinations that stopped before their end")
        .count(table.stopped, 0)
        .evidence(Evidence::Exact, "every combination has a solution: the slab bears the die, and no law weakens faster than the bodies unload it")
        .because("what runs is right and what cannot run is refused beforehand")
        .record();
    ledger
        .claim(format!(
            "largest distance of a shear traction from the strength of its law after sliding, over the largest strength, {} runs",
            table.ran
        ))
        .value(table.missed.iter().copied().fold(0.0, f64::max))
        .at_most(MISSED)
        .evidence(Evidence::Exact, "mu f_n, F_limit, or the steady strength at the point's own slip rate")
        .because(
            "tractions are answers of the law at every accepted state; states have slid twenty lengths and are steady to e^-20, \
             and the rate changes by what bodies move beside the die",
        )
        .why_not_tighter("a slip rate that still changes by a percent a length is off its steady strength by (a - b) times as much")
        .record();
    ledger
        .claim(format!(
            "largest difference of the force on the die between static-explicit and implicit steps, at the ends of both stages, over its size, {} pairs",
            table.apart.len()
        ))
        .value(table.apart.iter().copied().fold(0.0, f64::max))
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
    ledger.note(format!("{} combinations ran, {} were refused.", table.ran, table.refused));
}
