//! `report.json` of a spring-slider.

use crate::report::{Origin, Status};
use crate::warning::Warning;
use asperity_cycles::slider::{Event, Problem, Run, Thresholds};
use asperity_ode::{Counts, Outcome};
use serde::Serialize;
use std::fmt::Write as _;

/// Work, in operations that do not depend on the machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and not accepted.
    pub rejected: u64,
    /// Right-hand sides.
    pub right_hand_sides: u64,
    /// Jacobians.
    pub jacobians: u64,
    /// Factorisations.
    pub factorisations: u64,
    /// Solutions with them.
    pub solves: u64,
    /// Restarts after events.
    pub restarts: u64,
}

impl From<Counts> for Work {
    fn from(c: Counts) -> Self {
        Self {
            steps: c.steps,
            rejected: c.rejected,
            right_hand_sides: c.rates,
            jacobians: c.jacobians,
            factorisations: c.factorisations,
            solves: c.solves,
            restarts: c.restarts,
        }
    }
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// At the end asked for.
    Completed,
    /// After the events asked for.
    EnoughEvents,
    /// Before; everything until then stands.
    Stopped {
        /// Why.
        reason: String,
    },
    /// A signal ended it; everything until then stands.
    Interrupted,
}

/// What may differ from machine to machine and from run to run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Provenance {
    /// Wall time of the integration, its outputs included \[s\].
    pub seconds: f64,
    /// Commit of the program.
    pub commit: String,
    /// Most memory the process had \[bytes\]; absent where the system does not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_bytes: Option<usize>,
    /// What it was begun from.
    #[serde(flatten)]
    pub origin: Origin,
}

/// A slider at the end.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Final {
    /// Name.
    pub slider: String,
    /// Slip rate \[m/s\].
    pub slip_rate: f64,
    /// Friction coefficient \[-\].
    pub friction: f64,
    /// State variables, as the law evolves them.
    pub states: Vec<f64>,
}

/// The report of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Title of the scene.
    pub title: String,
    /// Version of the program.
    pub version: String,
    /// SHA-256 of the scene file.
    pub scene_sha256: String,
    /// Dynamics in words.
    pub dynamics: String,
    /// Sliders by name.
    pub sliders: Vec<String>,
    /// Warnings of the problem.
    pub warnings: Vec<Warning>,
    /// Method of integration.
    pub method: String,
    /// Tolerance per step \[-\].
    pub tolerance: f64,
    /// Thresholds of events.
    pub thresholds: Option<Thresholds>,
    /// How it ended.
    pub outcome: End,
    /// When \[s\].
    pub end: f64,
    /// The sliders then.
    pub last: Vec<Final>,
    /// Events.
    pub events: Vec<Event>,
    /// Work.
    pub counts: Work,
    /// Machine-dependent.
    pub run: Provenance,
}

impl Report {
    /// The report of a run of a problem.
    #[must_use]
    pub fn new(problem: &Problem, run: &Run) -> Self {
        let outcome = match &run.outcome {
            Outcome::Completed => End::Completed,
            Outcome::Stopped if run.interrupted => End::Interrupted,
            Outcome::Stopped => End::EnoughEvents,
            Outcome::Failed { reason } => {
                End::Stopped { reason: run.hint.clone().unwrap_or_else(|| reason.to_string()) }
            }
        };
        let segment = problem.system.segment(run.at.seconds());
        let last = problem.names.iter().zip(problem.system.sliders()).enumerate().map(|(i, (name, s))| {
            let y = problem.system.of(i, &run.unknowns);
            let (speed, friction) = segment.slip(i, run.at.seconds(), &run.unknowns);
            Final {
                slider: name.clone(),
                slip_rate: speed.rate,
                friction,
                states: y[1..=s.law.states()].to_vec(),
            }
        });
        Self {
            title: problem.title.clone(),
            version: env!("CARGO_PKG_VERSION").to_string(),
            scene_sha256: String::new(),
            dynamics: problem.dynamics().to_string(),
            sliders: problem.names.clone(),
            warnings: Vec::new(),
            method: problem.method.name().to_string(),
            tolerance: problem.tolerance,
            thresholds: problem.events,
            outcome,
            end: run.at.seconds(),
            last: last.collect(),
            events: run.catalogue.events.clone(),
            counts: run.counts.into(),
            run: Provenance { commit: crate::report::commit().to_string(), ..Provenance::default() },
        }
    }

    /// How the run stands.
    #[must_use]
    pub fn status(&self) -> Status {
        match self.outcome {
            End::Completed | End::EnoughEvents => Status::Completed,
            End::Stopped { .. } => Status::Stopped,
            End::Interrupted => Status::Interrupted,
        }
    }

    /// What a person should read at the end.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::from("results\n");
        for e in &self.events {
            let told =
                |value: Option<f64>, unit: &str| value.map_or("-".into(), |v| format!("{v:.6} {unit}"));
            let _ = writeln!(
                text,
                "  `{}` at {:.6} s: interval {}, slip {}, peak {:.6e} m/s, stress drop {}",
                self.sliders[e.slider],
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
        let c = &self.counts;
        let _ = writeln!(
            text,
            "  {} steps ({} rejected), {} right-hand sides, {} Jacobians, {} factorisations",
            c.steps, c.rejected, c.right_hand_sides, c.jacobians, c.factorisations
        );
        let _ = writeln!(text, "  seconds: {:.3}", self.run.seconds);
        text
    }
}
