//! Rate-and-state friction of an interface: a column that slides on a base and obeys the equations of a slider on a spring.

use super::slider::{self, Kind};
use super::texts::{self, BodyRun};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Floor, Ledger, Plot, Series};
use asperity::kinds::sliders::Entry;
use asperity_cycles::Thresholds;
use asperity_cycles::slider::{self as cycles, Problem, Rows, SliderState};
use asperity_friction::evolution::{ageing::Ageing, slip::Slip};
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider, SliderLaw};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use asperity_ode::Method;
use asperity_run::report::{Outcome, Stop};
use asperity_vary::Change::{self, Add};
use asperity_vary::SceneText;
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "interface_rate_state",
    readme: include_str!("README.md"),
    covers: &[Capability::InterfaceStates],
    quick: true,
    run,
};

const PLANE: &str = include_str!("scene.toml");
const SPACE: &str = include_str!("scene-3d.toml");
/// Parameters of the law; L in \[m\].
const A: f64 = 0.010;
const B: f64 = 0.015;
const LENGTH: f64 = 10e-6;
/// Load rate, also the rate of the initial steady state of the law \[m/s\].
const LOAD: f64 = 1e-6;
/// Penalty times penetration \[Pa\].
const NORMAL: f64 = 1e12 * 10e-6;
/// Height of the column \[m\] and its shear modulus \[Pa\], 2 E/5 with ν = 1/4.
const HEIGHT: f64 = 0.2;
const SHEAR: f64 = 10e9 / 2.5;
/// Tangential penalty \[Pa/m\].
const PENALTY: f64 = 1e12;
/// Duration of the pressing stage \[s\].
const PRESSED: f64 = 1.0;
/// End times of the later stages, counted from the end of pressing \[s\], and the load rate in each \[m/s\].
const STAGES: [(f64, f64); 5] =
    [(600.0, LOAD), (620.0, 10.0 * LOAD), (720.0, LOAD), (1720.0, 0.0), (1870.0, LOAD)];
/// Height of the unstable column \[m\]: G/h is half of f_n (b - a)/L.
const SOFT: f64 = 1.6;
/// Slip rate at which it counts as unstable \[m/s\].
const LIMIT: f64 = 10e-3;
/// Tolerance of the references.
const TIGHT: f64 = 1e-10;

/// Both evolution laws.
const KINDS: [Kind; 2] = [Kind::Ageing, Kind::Slip];
/// Bound on the error of friction at the default tolerance of scenes.
const DEFAULT: f64 = 1e-4;
/// Source of the references.
const SOURCE: &str = "one slider on a spring, Radau IIA of order 5 at 1e-10";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    in_time(ledger, "in the plane", PLANE)?;
    in_time(ledger, "in space", SPACE)?;
    forward(ledger, "in the plane", PLANE)?;
    forward(ledger, "in space", SPACE)?;
    elastic_base(ledger)?;
    orders(ledger)?;
    onset(ledger)?;
    work(ledger)
}

/// Implicit steps at the default tolerance of scenes, for both laws, measures and kinds of sliding.
fn in_time(ledger: &mut Ledger, space: &str, scene: &str) -> Result<(), CaseError> {
    for kind in KINDS {
        let (mut found, mut cost) = (Vec::new(), None);
        for measure in ["node-to-point", "mortar"] {
            for sliding in ["small", "finite"] {
                let done = texts::simulate(&with(SceneText::new(scene), kind, measure, sliding, &[])?)?;
                found.push(error(&done, &reference(kind, stiffness(HEIGHT), &done)?));
                if cost.is_none() && kind == KINDS[0] {
                    let title = format!("{} law {space}", word(kind));
                    ledger.picture(
                        title,
                        body_plots::recorded(&done.record, "")?,
                        "Mises stress after the first stage.",
                    );
                }
                cost.get_or_insert(done.cost);
            }
        }
        ledger
            .claim(format!(
                "{} law {space}: friction of every point at every step, less that of the slider, node-to-point (small, finite sliding) and mortar",
                word(kind)
            ))
            .values(&found)
            .equals_each(&[0.0; 4])
            .absolute(DEFAULT)
            .evidence(Evidence::SemiAnalytic, SOURCE)
            .because("the default bounds the error of a step by 2e-6, and what steps leave adds up over those in which traction relaxes, some tens")
            .covers(&[Capability::InterfaceStates])
            .cost(&cost.ok_or("nothing was run")?)
            .record();
    }
    Ok(())
}

/// Static-explicit steps at the default tolerance of scenes.
fn forward(ledger: &mut Ledger, space: &str, scene: &str) -> Result<(), CaseError> {
    let scene = SceneText::new(scene).with("time.stepper", "static-explicit");
    for kind in KINDS {
        let (mut found, mut cost) = (Vec::new(), None);
        for measure in ["node-to-point", "mortar"] {
            for sliding in ["small", "finite"] {
                let done = texts::simulate(&with(scene.clone(), kind, measure, sliding, &[])?)?;
                found.push(error(&done, &reference(kind, stiffness(HEIGHT), &done)?));
                cost.get_or_insert(done.cost);
            }
        }
        ledger
            .claim(format!(
                "{} law {space}, static-explicit: friction of every point at every step, less that of the slider, node-to-point (small, finite sliding) and mortar",
                word(kind)
            ))
            .values(&found)
            .equals_each(&[0.0; 4])
            .absolute(DEFAULT)
            .evidence(Evidence::SemiAnalytic, SOURCE)
            .because("the bound of implicit steps, of which 1e-5 of the largest force, four times that pressed at a corner at most, may be out of balance")
            .covers(&[Capability::InterfaceStates, Capability::StaticExplicit])
            .cost(&cost.ok_or("nothing was run")?)
            .record();
    }
    Ok(())
}

/// A base of the same rock, half as high as the column, whose compliance adds to that of the column.
fn elastic_base(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = SceneText::new(PLANE)
        .with("bodies.base.mesh.block.min", r#"["0 m", "-0.1 m"]"#)
        .with("bodies.base.mesh.block.max", r#"["0.1 m", "0 m"]"#)
        .with("bodies.base.mesh.block.divisions", "[2, 1]")
        // Top, left and right of the base.
        .without("stages[0].conditions[0].x")
        .without("stages[0].conditions[2].x")
        .without("stages[0].conditions[3].x");
    let (mut found, mut cost) = (Vec::new(), None);
    for measure in ["node-to-point", "mortar"] {
        let done = texts::simulate(&with(scene.clone(), Kind::Ageing, measure, "small", &[])?)?;
        found.push(error(&done, &reference(Kind::Ageing, stiffness(1.5 * HEIGHT), &done)?));
        cost.get_or_insert(done.cost);
    }
    ledger
        .claim("ageing law, elastic base: friction of every point at every step, less that of the slider, node-to-point and mortar")
        .values(&found)
        .equals_each(&[0.0; 2])
        .absolute(DEFAULT)
        .evidence(Evidence::SemiAnalytic, SOURCE)
        .because("column, base and penalty are springs in series; the bound is that of the default")
        .covers(&[Capability::InterfaceStates])
        .cost(&cost.ok_or("nothing was run")?)
        .record();
    Ok(())
}

/// Equal steps through the tenfold velocity step.
fn orders(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = SceneText::new(PLANE).without("stages[5]").without("stages[4]").without("stages[3]");
    let rules = [("bdf2", "second-order differences", 2.0), ("backward-euler", "backward Euler", 1.0)];
    let mut rows = Vec::new();
    for kind in KINDS {
        for (rule, name, order) in rules {
            let (mut levels, mut cost) = (Vec::new(), None);
            for steps in [800u16, 1600, 3200, 6400] {
                let scene = scene.clone().add("stages[2].steps", steps);
                let time = [Add("time.rule", rule)];
                let done = texts::simulate(&with(scene, kind, "node-to-point", "small", &time)?)?;
                let reference = reference(kind, stiffness(HEIGHT), &done)?;
                let error = error_since(PRESSED + STAGES[0].0, &done, &reference);
                levels.push((20.0 / f64::from(steps), error));
                rows.push([
                    word(kind).to_string(),
                    name.to_string(),
                    format!("{steps}"),
                    format!("{error:.3e}"),
                ]);
                cost = Some(done.cost);
            }
            // V rises by a factor of about 13, mostly within the time of a load of two L at the new rate: steps of 0.02 e-folds.
            let finest = if rule == "bdf2" { 1e-5 } else { 1e-3 };
            ledger
                .order(format!("friction through a velocity step in equal steps, {} law, {name}", word(kind)))
                .levels(&levels)
                .expected(order)
                .within(0.2)
                .floor(Floor::Rounding, 1e-9)
                .finest(finest, "some a/2 (second order: a) times the change of ln V in a step to that power, 0.02 to 0.05")
                .evidence(Evidence::SemiAnalytic, SOURCE)
                .because("order of the difference, and of a state that takes its exact step at the rate of the difference")
                .why_not_tighter("the coarsest steps slip by half of what a step may, and higher terms show")
                .covers(&[Capability::InterfaceStates])
                .cost(&cost.ok_or("nothing was run")?)
                .record();
        }
    }
    ledger.table("velocity step in equal steps", &["law", "rule", "steps", "error of friction"], rows);
    Ok(())
}

/// Time at which a column below the critical stiffness becomes unstable.
fn onset(ledger: &mut Ledger) -> Result<(), CaseError> {
    for kind in KINDS {
        let scene = SceneText::new(PLANE)
            .with("bodies.column.mesh.block.max[1]", format!("{SOFT} m"))
            .with("stages[1].duration", "5000 s");
        let limit = format!("{LIMIT:e}");
        let reference = by_slider(kind, stiffness(SOFT))?;
        let mut times = Vec::new();
        let mut cost = None;
        for tolerance in [None, Some("2e-5"), Some("2e-7")] {
            let mut time = vec![Add("time.slip_rate_limit", &limit)];
            time.extend(tolerance.map(|t| Add("time.friction_tolerance", t)));
            let done = texts::attempt(&with(scene.clone(), kind, "node-to-point", "small", &time)?)?;
            let Outcome::Stopped { time, kind: Stop::Instability { .. }, .. } = done.report.outcome else {
                return Err("it did not stop".into());
            };
            times.push((time - PRESSED) / reference);
            cost.get_or_insert(done.cost);
        }
        ledger
            .claim(format!(
                "{} law, k/k_c = 0.5: time at which V passes 10 mm/s over that of the slider, at the default, ten times and a tenth of it",
                word(kind)
            ))
            .values(&times)
            .equals_each(&[1.0; 3])
            .relative(1e-4)
            .evidence(Evidence::SemiAnalytic, "one slider on a spring, Radau IIA of order 5 with an event")
            .because("errors of friction of 1e-4 grow by some e-folds until it runs away, and the load then gains 1e-2 of friction a second")
            .covers(&[Capability::InterfaceStates, Capability::InterfaceInstability])
            .cost(&cost.ok_or("nothing was run")?)
            .record();
    }
    Ok(())
}

/// Error against computational work of both rules.
fn work(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    for kind in KINDS {
        let name = format!("{} law", word(kind));
        let mut plot = Plot::work_precision(
            format!("{name}: loading, velocity steps, hold and slide"),
            "largest error of friction",
            "Newton iterations",
        );
        let mut needed = Vec::new();
        for (rule, finest) in [("bdf2", 8), ("backward-euler", 6)] {
            let mut points = Vec::new();
            for power in 3..=finest {
                let tolerance = format!("2e-{power}");
                let time = [Add("time.rule", rule), Add("time.friction_tolerance", &tolerance)];
                let scene = SceneText::new(PLANE);
                let done = texts::simulate(&with(scene, kind, "node-to-point", "small", &time)?)?;
                let error = error(&done, &reference(kind, stiffness(HEIGHT), &done)?);
                let counts = &done.report.counts;
                points.push((error, counts.operations.iterations as f64));
                rows.push([
                    name.clone(),
                    rule.to_string(),
                    format!("2e-{power}"),
                    format!("{error:.2e}"),
                    format!("{}", counts.steps),
                    format!("{}", counts.operations.iterations),
                ]);
            }
            needed.push(at(&points, DEFAULT).ok_or("no setting reaches the error")?);
            plot = plot.series(Series::marked(rule, &points));
        }
        ledger.plot(plot.caption(
            "`friction_tolerance` from 2e-3 to 2e-8 (backward Euler to 2e-6). Where tolerances are loose, steps are bounded by a tenth of L.",
        ));
        ledger
            .claim(format!(
                "{name}: Newton iterations for an error of 1e-4, second-order differences over backward Euler"
            ))
            .value(needed[0] / needed[1])
            .at_most(0.25)
            .evidence(Evidence::SemiAnalytic, SOURCE)
            .because("the default rule is the one that needs least at the accuracy of the default")
            .why_not_tighter("the ratio is what the case measures")
            .covers(&[Capability::InterfaceStates])
            .record();
    }
    ledger.table(
        "error and work",
        &["law", "rule", "friction_tolerance", "error", "steps", "iterations"],
        rows,
    );
    Ok(())
}

/// Work at which an error is reached, interpolated logarithmically between the adjacent settings and extrapolated beyond the last.
fn at(points: &[(f64, f64)], error: f64) -> Option<f64> {
    let mut pairs = points.windows(2);
    let pair = pairs.clone().find(|w| w[0].0 > error && w[1].0 <= error).or_else(|| pairs.next_back())?;
    let share = (pair[0].0 / error).ln() / (pair[0].0 / pair[1].0).ln();
    Some((pair[0].1.ln() + share * (pair[1].1 / pair[0].1).ln()).exp())
}

/// A scene with keys of time.
fn with(
    scene: SceneText,
    kind: Kind,
    measure: &str,
    sliding: &str,
    time: &[Change<'_>],
) -> Result<String, CaseError> {
    let scene = scene
        .add("interfaces.fault.measure", measure)
        .add("interfaces.fault.sliding", sliding)
        .add("interfaces.fault.law.evolution", word(kind));
    Ok(scene.changed(time).text()?)
}

/// Stiffness of a column of this height \[m\] in series with the penalty \[Pa/m\].
fn stiffness(height: f64) -> f64 {
    1.0 / (height / SHEAR + 1.0 / PENALTY)
}

fn word(kind: Kind) -> &'static str {
    match kind {
        Kind::Ageing => "ageing",
        Kind::Slip => "slip",
    }
}

fn law(kind: Kind) -> Result<Arc<dyn SliderLaw>, CaseError> {
    let form = Regularised(Parameters::new(slider::MU0, A, slider::V_REF)?);
    Ok(match kind {
        Kind::Ageing => Arc::new(RateLaw::new(form, Ageing::new(B, LENGTH, slider::V_REF)?, LOAD, None)?),
        Kind::Slip => Arc::new(RateLaw::new(form, Slip::new(B, LENGTH, slider::V_REF)?, LOAD, None)?),
    })
}

/// A slider on an initially slack spring.
fn slack(kind: Kind, stiffness: f64, load: History, end: f64) -> Result<Problem, CaseError> {
    let slider =
        Slider { law: law(kind)?, stiffness, damping: 0.0, mass: None, normal: History::Constant(NORMAL) };
    let mut plan = slider::plan(slider, load, LOAD, 1.0, end)?;
    // The unknown mu/a is zero: the spring is slack.
    plan.start[0] = 0.0;
    plan.method = Method::Radau5;
    plan.tolerance = TIGHT;
    Ok(plan)
}

/// Friction of the slider at the times of a run since the law began to act.
fn reference(kind: Kind, stiffness: f64, done: &BodyRun) -> Result<Vec<f64>, CaseError> {
    let times: Vec<f64> = done.record.times().iter().map(|t| t - PRESSED).filter(|&t| t > 0.0).collect();
    let (mut table, mut from) = (Vec::new(), 0.0);
    for (end, rate) in STAGES {
        table.extend([[from, rate], [end, rate]]);
        from = end;
    }
    let mut plan = slack(kind, stiffness, History::table(table)?, from)?;
    plan.output = Rows { change: None, times, interval: None, histories: None };
    let mut friction = Vec::new();
    let mut look = |now: &SliderState<'_>| {
        if now.asked {
            friction.push(now.conditions[0].friction);
        }
    };
    cycles::run(&plan, &mut look)?;
    Ok(friction)
}

/// Time at which the slider exceeds the limit rate \[s\].
fn by_slider(kind: Kind, stiffness: f64) -> Result<f64, CaseError> {
    let mut plan = slack(kind, stiffness, History::Constant(LOAD), 1e5)?;
    plan.events = Some(Thresholds { on: LIMIT, off: 0.1 * LIMIT });
    plan.most_events = Some(1);
    // The run has no end condition: it fails after the limit has been exceeded.
    let run = cycles::run(&plan, &mut ())?;
    Ok(Entry::all(&run).first().ok_or("the slider did not pass the limit")?.onset)
}

/// Largest difference of friction from that of the slider over all points and steps under the law.
fn error(done: &BodyRun, reference: &[f64]) -> f64 {
    error_since(0.0, done, reference)
}

/// The same difference after a given time of the run \[s\].
fn error_since(time: f64, done: &BodyRun, reference: &[f64]) -> f64 {
    let times = done.record.times();
    let before = (times.len() - reference.len()).max(times.iter().take_while(|&&t| t <= time).count());
    let reference = &reference[before + reference.len() - times.len()..];
    let points = &done.record.histories()[0].points;
    let each = points.iter().flat_map(|p| p.friction[before..].iter().zip(reference));
    each.map(|(found, wanted)| (found - wanted).abs()).fold(0.0, f64::max)
}
