//! Gaps of blocks that start with stress: pulled apart and closed again.
//!
//! Both blocks and the penalty are springs in series, of the compliance 4 m/M + 1/E_n with the modulus M of uniaxial strain. Under
//! the initial pressure p the top carries p - s/C where it has moved up by s, and the blocks part at s = p C.

use super::super::texts::simulate_in;
use super::{FOLDER, MORTAR, PRESSED};
use crate::{CaseError, Evidence, Ledger};
use asperity_vary::Change::{self, With};
use asperity_vary::SceneText;

/// Pressure at the start \[Pa\].
const PRESSURE: f64 = 5e6;
/// Compliance of both blocks in uniaxial strain \[m/Pa\], and of the penalty of E/h, so soft that steps end
/// while the points that an initial stress presses come back to their start.
const BLOCKS: f64 = 4.0 / (10e9 * 0.75 / (1.25 * 0.5));
const PENALTY: f64 = 1.0 / 10e9;
/// Motion of the top \[m\].
const LIFT: f64 = 4e-3;
/// Gap between blocks that do not touch at the start \[m\].
const GAP: f64 = 3e-3;

const TOP: &str = "{ set = \"upper.top\", y = { to = \"4 mm\" } }";

/// Blocks under an initial stress, with stages in which the top moves.
fn scene(stages: &str) -> SceneText {
    let stress = format!("[{0:e}, {1:e}, {0:e}, 0, 0, 0]", -PRESSURE / 3.0, -PRESSURE);
    SceneText::new(PRESSED)
        .add("bodies.lower.initial_stress", &stress)
        .add("bodies.upper.initial_stress", &stress)
        .with("interfaces.fault.enforcement.normal", "1 E/h")
        .with("stages", stages)
}

fn held(top: &str) -> String {
    format!(
        "conditions = [{{ set = \"lower.bottom\", x = 0, y = 0 }}, {{ set = \"lower.left\", x = 0 }}, {{ set = \"lower.right\", x = 0 }}, \
         {{ set = \"upper.left\", x = 0 }}, {{ set = \"upper.right\", x = 0 }}, {top}]"
    )
}

const VARIANTS: [(&str, &[Change<'static>], f64); 3] = [
    ("node-to-point", &[], 1e-9),
    ("mortar", &[MORTAR], 1e-9),
    ("node-to-point, static-explicit", &[With("time.stepper", "static-explicit")], 1e-9),
];

pub fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, changes, bound) in VARIANTS {
        parted(ledger, (name, changes, bound))?;
        apart(ledger, (name, changes, bound))?;
    }
    Ok(())
}

/// Largest error of the normal tractions through time over the pressure at the start.
fn error(done: &super::BodyRun, exact: impl Fn(f64) -> f64) -> f64 {
    let mut most = 0.0_f64;
    for (k, time) in done.record.times().iter().enumerate() {
        for point in &done.record.histories()[0].points {
            most = most.max((point.normal_traction[k] - exact(*time)).abs() / PRESSURE);
        }
    }
    most
}

/// Blocks that are pulled apart and pressed together again.
fn parted(ledger: &mut Ledger, (name, changes, bound): (&str, &[Change<'_>], f64)) -> Result<(), CaseError> {
    let back = "{ set = \"upper.top\", y = { to = 0 } }";
    let stages = format!(
        "[{{ name = \"lift\", duration = 1, {} }}, {{ name = \"return\", duration = 1, conditions = [{back}] }}]",
        held(TOP)
    );
    let pressed = scene(&stages).add("interfaces.fault.initial_stress", true);
    let done = simulate_in(&pressed.changed(changes).text()?, FOLDER)?;
    let up = |t: f64| LIFT * if t < 1.0 { t } else { 2.0 - t };
    let exact = |t: f64| (PRESSURE - up(t) / (BLOCKS + PENALTY)).max(0.0);
    ledger
        .claim(format!("normal tractions of blocks with an initial stress that part and meet again, over the initial pressure, {name}"))
        .norm("largest error at all steps and points")
        .value(error(&done, exact))
        .at_most(bound)
        .evidence(Evidence::Exact, "blocks and penalty in series: p - s/C down to zero")
        .because("rounding of balanced forces; forward steps of linear bodies end where points open or close, and are exact between")
        .why_not_tighter("rounding depends on the order of sums")
        .cost(&done.cost)
        .record();
    ledger
        .claim(format!("gap of those blocks where they are apart, {name}"))
        .unit("m")
        .values(&done.contact("lift")?.gap)
        .equals_each(&[LIFT - PRESSURE * BLOCKS; 5])
        .relative(bound)
        .evidence(Evidence::Exact, "the motion of the top less the expansion of both blocks")
        .because("rounding of balanced forces; forward steps of linear bodies end where points open or close, and are exact between")
        .why_not_tighter("rounding depends on the order of sums")
        .cost(&done.cost)
        .record();
    if name.ends_with("static-explicit") {
        ends(ledger, &done);
    }
    Ok(())
}

/// Steps that end where blocks part and where they meet again.
fn ends(ledger: &mut Ledger, done: &super::BodyRun) {
    let share = PRESSURE * (BLOCKS + PENALTY) / LIFT;
    let exact = [share, 2.0 - share];
    let nearest = |wanted: &f64| {
        let apart = |t: &f64| (t - wanted).abs();
        let times = done.record.times().iter().copied();
        times.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(f64::NAN)
    };
    ledger
        .claim("ends of forward steps nearest to where blocks with an initial stress part and meet again")
        .unit("s")
        .values(&exact.iter().map(nearest).collect::<Vec<_>>())
        .equals_each(&exact)
        .absolute(1e-8)
        .evidence(Evidence::Exact, "the top has moved by p (C + 1/E_n)")
        .because("the limits of a step have a band of 1e-9 or so, in which points open and close together")
        .why_not_tighter("the width of the band is a choice")
        .cost(&done.cost)
        .record();
}

/// Blocks with a gap at the start, which expand into it and are then pressed together.
fn apart(ledger: &mut Ledger, (name, changes, bound): (&str, &[Change<'_>], f64)) -> Result<(), CaseError> {
    let down = "{ set = \"upper.top\", y = { to = \"-4 mm\" } }";
    let stages = format!(
        "[{{ name = \"settle\", duration = 1, {} }}, {{ name = \"press\", duration = 1, conditions = [{down}] }}]",
        held("{ set = \"upper.top\", y = 0 }")
    );
    let lifted = scene(&stages)
        .with("bodies.upper.mesh.block.min[1]", 2.0 + GAP)
        .with("bodies.upper.mesh.block.max[1]", 4.0 + GAP);
    let done = simulate_in(&lifted.changed(changes).text()?, FOLDER)?;
    let rest = GAP - PRESSURE * BLOCKS;
    ledger
        .claim(format!("gap into which blocks with an initial stress have expanded, {name}"))
        .unit("m")
        .values(&done.contact("settle")?.gap)
        .equals_each(&[rest; 5])
        .relative(bound)
        .evidence(Evidence::Exact, "the gap at the start less the expansion of both blocks")
        .because("rounding of balanced forces; forward steps of linear bodies end where points open or close, and are exact between")
        .why_not_tighter("rounding depends on the order of sums")
        .cost(&done.cost)
        .record();
    let exact = |t: f64| ((LIFT * (t - 1.0) - rest) / (BLOCKS + PENALTY)).max(0.0);
    ledger
        .claim(format!(
            "normal tractions of those blocks from their first contact on, over the initial pressure, {name}"
        ))
        .norm("largest error at all steps and points")
        .value(error(&done, exact))
        .at_most(bound)
        .evidence(Evidence::Exact, "blocks and penalty in series, from where the top has closed the gap")
        .because("rounding of balanced forces; forward steps of linear bodies end where points open or close, and are exact between")
        .why_not_tighter("rounding depends on the order of sums")
        .cost(&done.cost)
        .record();
    Ok(())
}
