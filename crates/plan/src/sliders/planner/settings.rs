//! Settings of time integration and events.

use super::Planner;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{EventSpec, Spanned};
use crate::reading::scene::slider::SliderTime;
use crate::reading::scene::suggestions;
use crate::reading::scene::units::Time;
use asperity_cycles::Thresholds;
use asperity_ode::Method;
use asperity_scene::defaults;
use std::str::FromStr;

/// Settings of `[time]`; `None` for invalid values.
pub(super) struct Settings {
    pub end: Option<f64>,
    pub method: Option<Method>,
    pub tolerance: Option<f64>,
    pub first_step: Option<f64>,
    pub largest_step: Option<f64>,
    pub most_steps: Option<usize>,
}

/// Smallest tolerance per step; below it errors are rounding.
const SMALLEST_TOLERANCE: f64 = 1e-14;
/// Largest tolerance per step; above it the result is not a solution.
const LARGEST_TOLERANCE: f64 = 0.1;

impl Planner {
    pub(super) fn settings(&mut self, time: &SliderTime) -> Settings {
        let mut length = |name: &str, value: Option<&Spanned<Time>>, example: &str| {
            value.and_then(|v| self.positive(name, v.get_ref().0, v.span(), example))
        };
        let end = length("end", Some(&time.end), "\"1000 s\"");
        let first_step = length("first_step", time.first_step.as_ref(), "\"1 ms\"");
        let largest_step = length("max_step", time.max_step.as_ref(), "\"1 s\"");
        if let (Some(first), Some(largest)) = (&time.first_step, &time.max_step)
            && first.get_ref().0 > largest.get_ref().0
        {
            let message = "`first_step` is larger than `max_step`";
            let error = Diagnostic::at(first.span(), message, "first_step <= max_step");
            self.errors.push(error.and(largest.span(), "max_step"));
        }
        Settings {
            end,
            method: time.method.as_ref().and_then(|m| self.method(m)),
            tolerance: time.tolerance.as_ref().and_then(|t| self.tolerance(t)),
            first_step,
            largest_step,
            most_steps: self.count("most_steps", time.most_steps.as_ref()),
        }
    }

    fn method(&mut self, method: &Spanned<String>) -> Option<Method> {
        let name = method.get_ref();
        let found = Method::from_str(name).ok();
        if found.is_none() {
            let help = suggestions::suggest(name, "methods", Method::ALL.map(Method::name));
            self.error::<()>(method.span(), format!("there is no method `{name}`"), help);
        }
        found
    }

    fn tolerance(&mut self, tolerance: &Spanned<f64>) -> Option<f64> {
        let value = *tolerance.get_ref();
        if (SMALLEST_TOLERANCE..=LARGEST_TOLERANCE).contains(&value) {
            return Some(value);
        }
        let help = format!("from {SMALLEST_TOLERANCE:e}, which rounding allows, to {LARGEST_TOLERANCE}");
        self.error(tolerance.span(), format!("`tolerance` is {value:?}"), help)
    }

    pub(super) fn events(&mut self, spec: &EventSpec) -> Option<Thresholds> {
        self.count("stop_after", spec.stop_after.as_ref());
        let on = self.positive("above", spec.above.get_ref().0, spec.above.span(), "\"1 mm/s\"")?;
        let off = match &spec.below {
            None => defaults::EVENT_ENDS * on,
            Some(below) => {
                let off = self.positive("below", below.get_ref().0, below.span(), "\"0.1 mm/s\"")?;
                if off >= on {
                    let message = format!("`below` ({off:?} m/s) is not below `above` ({on:?} m/s)");
                    return self.error(below.span(), message, "an event ends at a lower rate than it begins");
                }
                off
            }
        };
        Some(Thresholds { on, off })
    }
}
