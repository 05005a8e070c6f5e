//! Sliding over segments, past the end of the master, and back.

use super::{MEASURES, with_friction};
use crate::cases::texts::{BodyRun, simulate, work};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("ends.toml");
/// Travel \[m\].
const TRAVEL: f64 = 2.2;
/// Other surface descriptions of the lower body: name and changes to the scene.
const SURFACES: [(&str, &[Change<'_>], Capability); 3] = [
    (
        "node-to-point on smoothed facets",
        &[Add("interfaces.contact.smoothing", "cubic")],
        Capability::PenaltyContact2d,
    ),
    (
        "mortar on cells of second order",
        &[
            With("interfaces.contact.measure", "mortar"),
            With("bodies.lower.mesh.block.element", "quad8"),
            With("bodies.upper.mesh.block.element", "tri6"),
        ],
        Capability::Mortar,
    ),
    (
        "node-to-point on cells of second order",
        &[With("bodies.lower.mesh.block.element", "quad9"), With("bodies.upper.mesh.block.element", "quad9")],
        Capability::PenaltyContact2d,
    ),
];

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    for (name, capability) in MEASURES {
        let run =
            |scene: SceneText| simulate(&scene.with_or_same("interfaces.contact.measure", name).text()?);
        let smooth = run(with_friction(SCENE, "contact", 0.0))?;
        let rough = run(SceneText::new(SCENE))?;
        returns(ledger, name, &smooth, &rough, capability)?;
        let free = Cycle::second(&smooth)?;
        let rubbed = Cycle::second(&rough)?;
        if name == "mortar" {
            ledger
                .claim("work over a cycle past the end and back without friction, over the sum of its parts, mortar")
                .value(free.work.abs() / free.moved)
                .at_most(1e-10)
                .evidence(Evidence::Exact, "without friction the way back is the way out")
                .because("gaps are averaged over the overlap, which vanishes and comes back continuously: forces depend on the place only, and \
                          the rule of the sum takes the same places twice")
                .why_not_tighter("Newton stops at 1e-11 of the largest force")
                .covers(&[capability, Capability::FiniteSliding])
                .cost(&smooth.cost)
                .record();
        }
        ledger
            .claim(format!("work put into a cycle with friction less the work dissipated, over the latter, {name}"))
            .value(((rubbed.work - rubbed.dissipated) / rubbed.dissipated).abs())
            .at_most(5e-3)
            .evidence(Evidence::Exact, "after a cycle everything is where it was")
            .because(
                "the trapezoidal rule over steps of a tenth of a segment in which tractions of single nodes come and go: 1/8 of the \
                 force of a node, over 8 nodes, 5 times a cycle, in one of 50 steps",
            )
            .why_not_tighter("the sum of errors of either sign")
            .covers(&[capability, Capability::FiniteSliding, Capability::Coulomb])
            .cost(&rough.cost)
            .record();
        rows.push([
            name.to_owned(),
            format!("{:.1e}", free.work / free.moved),
            format!("{:.3}", rubbed.work),
            format!("{:.3}", rubbed.dissipated),
            smooth.report.counts.operations.iterations.to_string(),
            smooth.report.counts.rejected.to_string(),
        ]);
    }
    for (name, changes, capability) in SURFACES {
        let smooth = simulate(&with_friction(SCENE, "contact", 0.0).changed(changes).text()?)?;
        let rough = simulate(&SceneText::new(SCENE).changed(changes).text()?)?;
        returns(ledger, name, &smooth, &rough, capability)?;
    }
    ledger.table(
        "a cycle past the end and back; node-to-point loses and finds single nodes at the end with the energy of their springs",
        &["measure", "work without friction over its parts", "work with friction [J/m]", "dissipated [J/m]", "iterations", "rejected"],
        rows,
    );
    Ok(())
}

/// Energy balance of the second cycle.
struct Cycle {
    /// External work \[J/m\].
    work: f64,
    /// Sum of the absolute values of its parts \[J/m\].
    moved: f64,
    dissipated: f64,
}

impl Cycle {
    fn second(done: &BodyRun) -> Result<Cycle, CaseError> {
        let from = done.steps_until("back")? - 1;
        let force: Vec<f64> = done.force("top")?[from..].iter().map(|f| f[0]).collect();
        let place = |t: &f64| TRAVEL * (1.0 - (t - 4.0).abs());
        let way: Vec<f64> = done.record.times()[from..].iter().map(place).collect();
        let parts = work(&force, &way);
        Ok(Cycle {
            work: parts.iter().sum(),
            moved: parts.iter().map(|p| p.abs()).sum(),
            dissipated: done.dissipated()[from + 1..].iter().sum(),
        })
    }
}

/// Claims that forces and tractions of the block recur when it is back at its start.
fn returns(
    ledger: &mut Ledger,
    name: &str,
    smooth: &BodyRun,
    rough: &BodyRun,
    capability: Capability,
) -> Result<(), CaseError> {
    for (done, friction, first) in [(smooth, "without friction", "press"), (rough, "with friction", "back")] {
        let forces = done.force("top")?;
        let at = |stage: &str| -> Result<[f64; 3], CaseError> { Ok(forces[done.steps_until(stage)? - 1]) };
        let (then, now) = (at(first)?, at("back again")?);
        let tractions = |stage: &str| -> Result<Vec<f64>, CaseError> {
            let f = done.contact(stage)?;
            Ok(f.normal_traction.iter().chain(&f.shear_traction).copied().collect())
        };
        let (before, after) = (tractions(first)?, tractions("back again")?);
        let largest = before.iter().fold(0.0, |m: f64, t| m.max(t.abs()));
        let mut error = now.iter().zip(&then).map(|(a, b)| (a - b).abs() / then[1].abs()).fold(0.0, f64::max);
        for (a, b) in before.iter().zip(&after) {
            error = error.max((a - b).abs() / largest);
        }
        ledger
            .claim(format!("force on the block and tractions of all nodes against those of the round before, {friction}, {name}"))
            .value(error)
            .at_most(1e-9)
            .evidence(Evidence::Exact, "the same place, reached from the same side")
            .because("nodes that left and came back have the pairing and, sliding, the friction of those that stayed; what Newton leaves")
            .why_not_tighter("Newton stops at 1e-11 of the largest force, and the penalty multiplies what that is in displacement")
            .covers(&[capability, Capability::FiniteSliding])
            .cost(&done.cost)
            .record();
    }
    Ok(())
}
