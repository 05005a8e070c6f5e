//! Text of a plan.

use super::plan::Plan;
use asperity_cycles::slider::stability;
use std::fmt::Write as _;

impl Plan {
    /// Summary to be read before the run.
    #[must_use]
    pub fn summary(&self) -> String {
        let problem = &self.problem;
        let mut text = format!("plan: {}\n", problem.title);
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "  {name:<18}{value}");
        };
        line("kinematics", format!("spring-slider, {}", problem.dynamics()));
        for (name, s) in problem.names.iter().zip(problem.system.sliders()) {
            let states = match s.law.states() {
                0 => "no state".to_string(),
                1 => "1 state variable".to_string(),
                n => format!("{n} state variables"),
            };
            line(name, format!("{}, {states}, k = {:.6e} Pa/m", s.law.name(), s.stiffness));
        }
        for (name, words) in problem.names.iter().zip(stability::words(problem)) {
            words.into_iter().for_each(|words| line(name, words));
        }
        for spring in problem.system.springs() {
            let [a, b] = spring.between.map(|i| problem.names[i].as_str());
            line("spring", format!("{a} to {b}, k = {:.6e} Pa/m", spring.stiffness));
        }
        line(
            "unknowns",
            format!("{}: friction over a, states{}", problem.start.len(), self.inertial_words()),
        );
        line("method", format!("{} with tolerance {:e}", problem.method.name(), problem.tolerance));
        line("end", self.end_words());
        for remark in stability::remarks(problem) {
            line("note", remark);
        }
        for warning in &self.warnings {
            line("warning", warning.to_string());
        }
        text
    }

    fn inertial_words(&self) -> &'static str {
        if self.problem.system.sliders().iter().any(|s| s.mass.is_some()) { ", net traction" } else { "" }
    }

    fn end_words(&self) -> String {
        let problem = &self.problem;
        match (&problem.events, problem.most_events) {
            (Some(t), Some(n)) => format!("{} s, or {n} events above {:e} m/s", problem.end, t.on),
            (Some(t), None) => format!("{} s; events above {:e} m/s", problem.end, t.on),
            (None, _) => format!("{} s", problem.end),
        }
    }
}
