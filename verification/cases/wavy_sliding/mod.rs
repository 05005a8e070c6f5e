//! A block slides by three wavelengths along a wavy fault, in implicit and static-explicit steps.

use super::contact_invariance::bodies::{Change, Grid, Side};
use super::texts::{BodyRun, simulate_in};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::Change::{self as Vary, With, Without};
use asperity_vary::SceneText;
use std::path::Path;

/// See the README.
pub const CASE: Case = Case {
    name: "wavy_sliding",
    readme: include_str!("README.md"),
    covers: &[Capability::StaticExplicit, Capability::Implicit],
    quick: true,
    run,
};

/// Amplitude and wavelength of the fault \[m\].
const WAVE: Side = Side::Wavy(0.02, 1.0);
const MU: f64 = 0.3;
/// Bound on the difference of the final force, over its magnitude: the imbalance that a step may leave.
const APART: f64 = 1e-4;
/// Bound on tractions minus Coulomb's strength, over the largest: rounding in the law.
const MISSED: f64 = 1e-14;
/// Bound on the imbalance of steps over the largest force: the default `drift` for Coulomb friction. Rate-and-state
/// friction, whose default is larger, keeps it as well.
const DRIFT: f64 = 1e-4;

/// Bound on the difference of forces if the other body moves: the imbalance that implicit steps may leave.
const FRAMES: f64 = 1e-11;

const MORTAR: Vary<'_> = With("interfaces.fault.measure", "mortar");
const AGEING: Vary<'_> = With(
    "interfaces.fault.law",
    "{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.3, a = 0.015, b = 0.01, l = \"20 mm\", v_ref = \"0.1 m/s\", \
     v_initial = \"0.1 m/s\" }",
);
/// Rate-and-state friction takes ten times the steps.
const ONE_WAVE: [Vary<'_>; 2] =
    [With("stages[1].duration", "10 s"), With("stages[1].conditions[0].x.to", "1 m")];
const STATIC_EXPLICIT: [Vary<'_>; 2] = [With("time.stepper", "static-explicit"), Without("time.tolerance")];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let folder = std::env::temp_dir().join(format!("asperity-wavy-sliding-{}", std::process::id()));
    let written =
        write(&folder).and_then(|()| compare(ledger, &folder)).and_then(|()| frames(ledger, &folder));
    let written = written.and_then(|()| curve(ledger, &folder));
    std::fs::remove_dir_all(&folder)?;
    written
}

fn compare(ledger: &mut Ledger, folder: &Path) -> Result<(), CaseError> {
    let (one, other, third) = (
        ("node-to-point, Coulomb, three wavelengths", vec![]),
        ("mortar, Coulomb, three wavelengths", vec![MORTAR]),
        ("mortar, ageing law, one wavelength", vec![MORTAR, AGEING, ONE_WAVE[0], ONE_WAVE[1]]),
    );
    for (name, changes) in [one, other, third] {
        let run = |stepper: &[Vary<'_>]| -> Result<BodyRun, CaseError> {
            let scene = SceneText::new(include_str!("scene.toml")).changed(&changes).changed(stepper);
            simulate_in(&scene.text()?, &folder.to_string_lossy()).map_err(|e| format!("{name}: {e}").into())
        };
        let (implicit, forward) = (run(&[])?, run(&STATIC_EXPLICIT)?);
        claims(ledger, name, &implicit, &forward)?;
        if changes.is_empty() {
            ledger.picture(
                name,
                body_plots::recorded(&implicit.record, "")?,
                "Mises stress after the first stage.",
            );
        }
        if !changes.contains(&AGEING) {
            law(ledger, name, &forward)?;
        }
    }
    Ok(())
}

fn claims(ledger: &mut Ledger, name: &str, implicit: &BodyRun, forward: &BodyRun) -> Result<(), CaseError> {
    let force = |done: &BodyRun| done.report.forces.last().map(|f| f.value).ok_or("no force is reported");
    let (a, b) = (force(implicit)?, force(forward)?);
    let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    ledger
        .claim(format!("difference of the force on the block at the end, over its size, {name}"))
        .value(size(std::array::from_fn(|i| a[i] - b[i])) / size(a))
        .at_most(APART)
        .between(&implicit.scene, &forward.scene)
        .evidence(Evidence::SemiAnalytic, "implicit steps, whose balance holds to 1e-11")
        .because("a static-explicit step may leave `drift` of the largest force out of balance, and friction does not remember more")
        .why_not_tighter("what the last step leaves is part of the difference; rate-and-state friction adds 2e-6 of its own a step")
        .cost(&forward.cost)
        .record();
    let left = forward.report.steps.iter().map(|s| s.residual_ratio).fold(0.0, f64::max);
    ledger
        .claim(format!("largest residual left by a static-explicit step over the largest force, {name}"))
        .value(left)
        .at_most(DRIFT)
        .evidence(Evidence::Exact, "balance of forces")
        .because("what exceeds `drift` is corrected at once")
        .why_not_tighter("smaller residuals are carried into the next step")
        .record();
    Ok(())
}

fn law(ledger: &mut Ledger, name: &str, done: &BodyRun) -> Result<(), CaseError> {
    let end = &done.record.stage_end("slide").ok_or("the run has no end")?.interfaces[0];
    let closed = || (0..end.gap.len()).filter(|&k| end.status[k] == 2);
    let largest = closed().map(|k| MU * end.normal_traction[k]).fold(0.0, f64::max);
    let missed = closed().map(|k| (end.shear_traction[k].abs() - MU * end.normal_traction[k]).abs());
    ledger
        .claim(format!(
            "largest distance of sliding points from Coulomb's strength, over the largest, {} points, {name}",
            closed().count()
        ))
        .value(missed.fold(0.0, f64::max) / largest)
        .at_most(MISSED)
        .evidence(Evidence::Exact, "|t| = mu f_n")
        .because("tractions are answers of the law at every accepted state")
        .why_not_tighter("rounding of a product, which happens to be none here")
        .record();
    Ok(())
}

/// The same motion of the block along the base, as motion of the block and as motion of both in opposite directions.
fn frames(ledger: &mut Ledger, folder: &Path) -> Result<(), CaseError> {
    let run = |conditions: &str| -> Result<(BodyRun, Vec<[f64; 3]>), CaseError> {
        let scene = SceneText::new(include_str!("scene.toml"))
            .with("stages[1].conditions", conditions)
            .add("stages[1].steps", 200)
            .without("time.tolerance");
        let done = simulate_in(&scene.text()?, &folder.to_string_lossy())?;
        let from = done.steps_until("press")?;
        let forces = done.force("upper")?.split_off(from);
        Ok((done, forces))
    };
    let (one, alone) = run(r#"[{ set = "upper.top", x = { to = "40 mm" } }]"#)?;
    let (two, both) = run(
        r#"[{ set = "upper.top", x = { to = "20 mm" } }, { set = "lower.bottom", x = { to = "-20 mm" } }]"#,
    )?;
    let size = |f: &[f64; 3]| f.iter().map(|x| x * x).sum::<f64>().sqrt();
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| size(&std::array::from_fn(|i| a[i] - b[i])) / size(a);
    let largest = alone.iter().zip(&both).map(apart).fold(0.0, f64::max);
    ledger
        .claim("difference of the force on the block, if the base moves against it instead, over its size")
        .norm(format!("largest over {} steps of 0.2 mm", alone.len()))
        .value(if alone.len() == both.len() { largest } else { f64::NAN })
        .at_most(FRAMES)
        .between(&one.scene, &two.scene)
        .evidence(Evidence::Exact, "contact depends on relative motion alone")
        .because("both runs balance forces to 1e-11 of the largest")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .covers(&[Capability::FiniteSliding])
        .cost(&two.cost)
        .record();
    Ok(())
}

/// Gaps from a smoothed side, whose nodes lie on a cosine, against distances from the cosine.
fn curve(ledger: &mut Ledger, folder: &Path) -> Result<(), CaseError> {
    let [same, ..] = Change::all(false);
    let probe =
        Grid { min: [0.3, 0.0, 0.0], max: [1.7, 1.0, 0.0], cells: [13, 1, 0], sides: [WAVE, Side::Flat] };
    std::fs::write(folder.join("probe.msh"), probe.file(&same)?)?;
    let (mut levels, mut last) = (Vec::new(), None);
    for cells in [16, 32, 64] {
        let side = Grid {
            min: [-1.0, -1.0, 0.0],
            max: [3.0, 0.0, 0.0],
            cells: [4 * cells, 1, 0],
            sides: [Side::Flat, WAVE],
        };
        std::fs::write(folder.join("fine.msh"), side.file(&same)?)?;
        let done = simulate_in(include_str!("held.toml"), &folder.to_string_lossy())?;
        let points = &done.record.histories()[0].points;
        let missed = points.iter().map(|point| {
            let gap = point.normal_traction.last().copied().unwrap_or(f64::NAN) / HELD;
            (gap - depth(point.position)).abs()
        });
        levels.push((1.0 / cells as f64, missed.fold(0.0, f64::max)));
        last = Some(done);
    }
    let done = last.ok_or("nothing was run")?;
    ledger
        .order("gaps from a smoothed side, in the size of its faces over the wavelength")
        .levels(&levels)
        .expected(3.0)
        .within(0.3)
        .finest(
            4e-7,
            "w''' h^3/6 times the largest xi (1 - xi)(1 - 2 xi), 0.096, with w''' = 0.02 (2 pi)^3: 3.0e-7 m, and a third for the next order",
        )
        .evidence(Evidence::Exact, "distances from the cosine on which the nodes lie")
        .because("tangents of the parabola through a node and its neighbours err by w''' h^2/6, alike at both ends of an edge")
        .why_not_tighter("the points lie anywhere on the faces")
        .covers(&[Capability::FiniteSliding])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Penalty of the sides that are held \[Pa/m\], and the depth to which one is pressed \[m\].
const HELD: f64 = 1e9;
const PRESSED: f64 = 5e-3;

/// Distance of a pressed node from the cosine \[m\].
fn depth([x, y, _]: [f64; 3]) -> f64 {
    let (amplitude, k) = (0.02, std::f64::consts::TAU);
    let y = y - PRESSED;
    let mut s = x;
    // Newton's method for the foot: (s - x) + (w - y) w' = 0.
    for _ in 0..20 {
        let (sin, cos) = (k * s).sin_cos();
        let (w, first, second) = (amplitude * cos, -amplitude * k * sin, -amplitude * k * k * cos);
        s -= ((s - x) + (w - y) * first) / (1.0 + first * first + (w - y) * second);
    }
    (s - x).hypot(amplitude * (k * s).cos() - y)
}

/// Writes both mesh files.
fn write(folder: &Path) -> Result<(), CaseError> {
    let [same, ..] = Change::all(false);
    let lower =
        Grid { min: [-0.5, -1.0, 0.0], max: [5.5, 0.0, 0.0], cells: [96, 4, 0], sides: [Side::Flat, WAVE] };
    let upper =
        Grid { min: [0.0, 0.0, 0.0], max: [2.0, 1.0, 0.0], cells: [31, 4, 0], sides: [WAVE, Side::Flat] };
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("lower.msh"), lower.file(&same)?)?;
    std::fs::write(folder.join("upper.msh"), upper.file(&same)?)?;
    Ok(())
}
