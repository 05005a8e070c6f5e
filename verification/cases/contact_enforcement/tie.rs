//! Blocks that are tied across a gap, far wider than they move: springs in series, whatever the gap.

use super::{MEASURES, UNIT, YOUNG};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene as reader;
use asperity_run::report::Outcome;
use asperity_vary::SceneText;

/// Displacement of the top, up or down \[m\].
const MOVED: f64 = 1e-8;
/// Penalty over E/h.
const PENALTY: f64 = 100.0;
/// Steps: displacements of each are 1e-9 of the gap.
const STEPS: u32 = 100;

fn scene(measure: &str, lower: usize, moved: f64) -> SceneText {
    SceneText::new(include_str!("scene.toml"))
        .with_or_same("bodies.lower.mesh.block.divisions", format!("[{lower}, {lower}]"))
        .with("bodies.upper.mesh.block.min", r#"["0 m", "1.1 m"]"#)
        .with("bodies.upper.mesh.block.max", r#"["1 m", "2.1 m"]"#)
        .with_or_same("interfaces.contact.measure", measure)
        .with("interfaces.contact.law", r#"{ kind = "tied" }"#)
        .with(
            "interfaces.contact.enforcement",
            format!(r#"{{ kind = "penalty", normal = "{PENALTY} E/h", tangential = "{PENALTY} E/h" }}"#),
        )
        .with("stages[0].steps", STEPS)
        .with("stages[0].conditions[1].y.to", moved)
        .without("stages[1]")
}

/// Largest error of the normal tractions, over what springs in series transmit.
fn error(scene: SceneText, moved: f64) -> Result<(f64, Cost), CaseError> {
    let scene = reader::read(&scene.text()?).map_err(|e| e.to_string())?;
    let plan = bodies::plan(&scene).map_err(|e| e.to_string())?;
    let mut record = Recorder::new();
    let (report, cost) = Cost::measure(|| kinds::bodies::run(&plan, &mut record));
    let report = report?;
    if let Outcome::Stopped { reason, .. } = &report.outcome {
        return Err(format!("stopped: {reason}").into());
    }
    let exact = -moved / (2.0 / YOUNG + (PENALTY * UNIT).recip());
    let end = record.stage_end("press").ok_or("the stage was not reached")?;
    let off = end.interfaces[0].normal_traction.iter().map(|f| (f / exact - 1.0).abs());
    Ok((off.fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a }), cost.counts(&report.counts)))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let names = ["node-to-point", "mortar"];
    for ((_, name, lower), measure) in MEASURES.into_iter().zip(names) {
        for (way, moved) in [("pressed", -MOVED), ("pulled", MOVED)] {
            let (error, cost) = error(scene(measure, lower, moved), moved)
                .map_err(|e| CaseError::from(format!("tied across a gap, {name}, {way}: {e}")))?;
            ledger
                .claim(format!("{name}, tied across a gap and {way}: normal traction of springs in series"))
                .norm("largest relative error")
                .value(error)
                .at_most(1e-9)
                .evidence(Evidence::Exact, "d/(2/E + 1/eps), with the stiffness of the penalty")
                .because(
                    "forces of single steps balance to 1e-11 of the largest, of which there are a hundred",
                )
                .covers(&[Capability::Multipliers])
                .cost(&cost)
                .record();
        }
    }
    Ok(())
}
