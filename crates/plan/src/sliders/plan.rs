//! The problem to integrate, with warnings.

use crate::shared::checks::{Checks, Cost, SliderCheck, rates};
use asperity_cycles::slider::Problem;
use asperity_cycles::slider::stability::{Against, against};
use asperity_laws::Theta;
use asperity_run::Warning;

/// The problem to integrate, with warnings.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Sliders, springs and load, and the settings of the integration.
    pub problem: Problem,
    /// Warnings about settings that are probably not intended.
    pub warnings: Vec<Warning>,
    /// Stiffness of the springs against the critical one.
    pub checks: Checks,
    /// The state θ of the law of each slider, if it has one.
    pub thetas: Vec<Option<Theta>>,
}

impl From<Problem> for Plan {
    fn from(problem: Problem) -> Self {
        let of = |(name, against): (&String, Option<Against>)| {
            let Against { stiffness, critical, unstable } = against?;
            Some(SliderCheck { slider: name.clone(), stiffness, critical, unstable })
        };
        let sliders = problem.names.iter().zip(against(&problem)).filter_map(of).collect();
        let thetas = vec![None; problem.names.len()];
        let step_seconds = Some(rates::slider_step(problem.method, problem.names.len()));
        let cost = Cost { step_seconds, rows: rows(&problem), ..Cost::default() };
        Self { problem, warnings: Vec::new(), checks: Checks { sliders, cost, ..Checks::default() }, thetas }
    }
}

/// Number of rows at times, if no others are written.
fn rows(problem: &Problem) -> Option<usize> {
    let rows = &problem.output;
    let regular = rows.interval.map_or(0, |interval| (problem.end / interval) as usize + 1);
    rows.change.is_none().then_some(rows.times.len() + regular)
}
