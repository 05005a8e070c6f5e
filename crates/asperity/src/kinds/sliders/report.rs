//! Report of a run of spring-sliders, `report.json`.

use super::events::NamedEvent;
use crate::report::results;
use asperity_cycles::slider::{Problem, SliderRun};
use asperity_cycles::{Outrun, Thresholds};
use asperity_ode::Outcome as Finish;
use asperity_plan::shared::checks::Checks;
use asperity_plan::shared::rate_bound;
use asperity_run::report::{Kind, Outcome, Phases, Stop};
use asperity_run::{Counts, EnergyTable, Integration, Warning};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;

/// Counts of an integration as reports have them.
fn counts(c: &asperity_ode::Counts) -> Counts<Integration> {
    let operations = Integration {
        right_hand_sides: Some(c.rates),
        jacobians: Some(c.jacobians),
        factorisations: Some(c.factorisations),
        solves: Some(c.solves),
        restarts: Some(c.restarts),
    };
    Counts { steps: c.steps, rejected: c.rejected, operations, ..Counts::default() }
}

/// State of a slider at the end.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Final {
    /// Name.
    pub slider: String,
    /// Slip rate \[m/s\].
    pub slip_rate: f64,
    /// Friction coefficient \[-\].
    pub friction: f64,
    /// State variables, in the form that the law evolves.
    pub states: Vec<f64>,
}

/// Report of a run.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Report {
    /// Description of the dynamics.
    pub dynamics: String,
    /// Names of the sliders.
    pub sliders: Vec<String>,
    /// Warnings of the problem.
    pub warnings: Vec<Warning>,
    /// Checks of the plan.
    pub checks: Checks,
    /// Method of integration.
    pub method: String,
    /// Tolerance per step \[-\].
    pub tolerance: f64,
    /// Thresholds of events.
    pub thresholds: Option<Thresholds>,
    /// Outcome.
    pub outcome: Outcome,
    /// Time at the end \[s\].
    pub end: f64,
    /// Sliders at the end.
    pub last: Vec<Final>,
    /// Events.
    pub events: Vec<NamedEvent>,
    /// Energy budget \[J/m²\], summed over the sliders; absent if the run was not observed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy: Option<EnergyTable>,
    /// Work.
    pub counts: Counts<Integration>,
    /// Wall time.
    #[serde(skip)]
    pub seconds: Phases,
}

results!(Report, Kind::Sliders);

/// Outcome of a run in which a slider was faster than shear waves beyond a time \[s\].
fn outran(problem: &Problem, Outrun { point, rate }: Outrun, time: f64) -> Outcome {
    let (name, slider) = (problem.names[point].clone(), &problem.system.sliders()[point]);
    let bounded = slider.damping > 0.0 || slider.mass.is_some();
    let reason =
        rate_bound::reason(&format!("`{name}`"), "its point", time, [rate, problem.fastest], bounded);
    let kind = Stop::Outrun { surface: name, position: [0.0; 3], slip_rate: rate };
    Outcome::Stopped { stage: None, time, reason, kind }
}

impl Report {
    /// Report of a run of a problem.
    #[must_use]
    pub fn new(problem: &Problem, run: &SliderRun) -> Self {
        let time = run.at.seconds();
        let outcome = match &run.outcome {
            Finish::Completed | Finish::Stopped => Outcome::Completed,
            Finish::Failed { reason } => {
                let reason = run.progress.hint.clone().unwrap_or_else(|| reason.to_string());
                run.progress.outrun.map_or(
                    Outcome::Stopped { stage: None, time, reason, kind: Stop::Integration },
                    |slider| outran(problem, slider, time),
                )
            }
        };
        let segment = problem.system.segment(run.at.seconds());
        let last = problem.names.iter().zip(problem.system.sliders()).enumerate().map(|(i, (name, s))| {
            let y = problem.system.slider_unknowns(i, &run.unknowns);
            let (speed, friction) = segment.slip(i, run.at.seconds(), &run.unknowns);
            Final {
                slider: name.clone(),
                slip_rate: speed.rate,
                friction,
                states: y[1..=s.law.states()].to_vec(),
            }
        });
        let energy = run.progress.budget.as_ref();
        let energy = energy.map(|budget| EnergyTable::new("J/m²", &budget.energy().energies()));
        let doubt = |energy: &EnergyTable| {
            energy.doubt("the steps are too long for it", "take a smaller `tolerance` in `[time]`")
        };
        Self {
            warnings: energy.iter().filter_map(doubt).collect(),
            dynamics: problem.dynamics().to_string(),
            sliders: problem.names.clone(),
            checks: Checks::default(),
            method: problem.method.name().to_string(),
            tolerance: problem.tolerance,
            thresholds: problem.events,
            outcome,
            end: run.at.seconds(),
            last: last.collect(),
            events: NamedEvent::all(run, &problem.names),
            energy,
            counts: counts(&run.counts),
            seconds: Phases::default(),
        }
    }

    /// Summary to be read at the end of the run.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::from("results\n");
        for NamedEvent { surface, entry: e } in &self.events {
            let told =
                |value: Option<f64>, unit: &str| value.map_or("-".into(), |v| format!("{v:.6} {unit}"));
            let _ = writeln!(
                text,
                "  `{surface}` at {:.6} s: interval {}, slip {}, peak {:.6e} m/s, stress drop {}",
                e.onset,
                told(e.interval, "s"),
                told(e.slip.map(|s| s * 1e6), "um"),
                f64::from(e.direction) * e.peak_rate,
                told(e.stress_drop.map(|s| s / 1e6), "MPa")
            );
        }
        for l in &self.last {
            let _ = writeln!(
                text,
                "  `{}` at the end, {:.6} s: V = {:.6e} m/s, friction {:.6}",
                l.slider, self.end, l.slip_rate, l.friction
            );
        }
        if let Some(energy) = &self.energy {
            let _ = writeln!(text, "  {}", energy.text());
        }
        let c = &self.counts;
        let _ = writeln!(
            text,
            "  {} steps ({} rejected), {} right-hand sides, {} Jacobians, {} factorisations",
            c.steps,
            c.rejected,
            c.operations.right_hand_sides.unwrap_or(0),
            c.operations.jacobians.unwrap_or(0),
            c.operations.factorisations.unwrap_or(0)
        );
        let Phases { steps, output, .. } = self.seconds;
        let _ = writeln!(text, "  seconds: steps {steps:.3}, output {output:.3}");
        text
    }
}
