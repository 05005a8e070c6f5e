//! Time integration.

use super::Checker;
use crate::model::{Rule, Spanned, Stepper};
use std::ops::Range;

/// Largest departure of a table from its chord within a step, relative to the range of the table.
const MOST_DEPARTURE: f64 = 0.1;
/// Largest admissible residual over the largest force. Tractions of the pressed surface are of the size of the largest force over
/// its area, and then err by a percent.
const MOST_DRIFT: f64 = 1e-2;

/// Admissible bounds on the error of friction coefficients. Newton's method leaves 1e-11 of the largest force, which hides
/// smaller errors. A hundredth is more than the changes of friction by rates and states.
const FRICTION_TOLERANCES: Range<f64> = 1e-9..1e-2;

/// Kinds of law whose strength depends on slip rather than slip rate, for which second-order backward differentiation is not
/// suited.
pub(super) const OF_SLIP: [&str; 2] = ["static-kinetic", "slip-weakening"];

impl Checker<'_> {
    pub(super) fn time(&mut self) {
        let time = &self.scene.time;
        let stepper = *time.stepper.get_ref();
        if let Some(tolerance) = time.tolerance.as_ref().filter(|t| t.get_ref().0 <= 0.0) {
            self.error(
                tolerance.span(),
                "`tolerance` must be positive: it bounds the error of slip in each step",
                "such as `tolerance = \"1 nm\"`",
            );
        }
        for (name, step) in
            [("first_step", &time.first_step), ("max_step", &time.max_step), ("min_step", &time.min_step)]
        {
            if let Some(step) = step.as_ref().filter(|s| s.get_ref().0 <= 0.0) {
                self.error(
                    step.span(),
                    format!("`{name}` must be positive"),
                    format!("such as `{name} = \"0.1 s\"`"),
                );
            }
        }
        if let Some(limit) = time.slip_rate_limit.as_ref().filter(|v| v.get_ref().0 <= 0.0) {
            self.error(
                limit.span(),
                "`slip_rate_limit` must be positive: beyond it the run stops",
                "such as `slip_rate_limit = \"1 m/s\"`; leave it out for the limit of radiation damping",
            );
        }
        self.order_of_steps();
        let numbers = [
            ("drift", &time.drift, "1e-4"),
            ("rate_change", &time.rate_change, "0.5"),
            ("zeta", &time.zeta, "0.1"),
            ("friction_tolerance", &time.friction_tolerance, "2e-6"),
            ("course_tolerance", &time.course_tolerance, "1e-4"),
        ];
        for (name, number, usual) in numbers {
            if let Some(number) = number.as_ref().filter(|n| !(*n.get_ref() > 0.0 && n.get_ref().is_finite()))
            {
                self.error(
                    number.span(),
                    format!("`{name}` must be positive and finite"),
                    format!("such as `{name} = {usual}`"),
                );
            }
        }
        if let Some(drift) = time.drift.as_ref().filter(|d| *d.get_ref() > MOST_DRIFT) {
            self.error(
                drift.span(),
                "`drift` is the share of the largest force that a step may leave out of balance, and more than a hundredth shows in all tractions",
                "at most 1e-2; the default is 1e-4",
            );
        }
        if let Some(tolerance) = time
            .friction_tolerance
            .as_ref()
            .filter(|t| *t.get_ref() > 0.0 && !FRICTION_TOLERANCES.contains(t.get_ref()))
        {
            self.error(
                tolerance.span(),
                "`friction_tolerance` bounds the error of friction coefficients of a step: less than 1e-9 is hidden by rounding, and 1e-2 and more \
                 bounds nothing",
                "between 1e-9 and 1e-2; the default is 2e-6",
            );
        }
        if let Some(tolerance) = time.course_tolerance.as_ref().filter(|t| *t.get_ref() > MOST_DEPARTURE) {
            self.error(
                tolerance.span(),
                "`course_tolerance` is the share of the range of a table that steps may pass over, and more than a tenth shows in all results",
                "at most 0.1; the default is 1e-4",
            );
        }
        if let Some(rule) = time.rule.as_ref().filter(|r| {
            *r.get_ref() == Rule::Bdf2 && !matches!(stepper, Stepper::FaultOde | Stepper::Explicit)
        }) {
            self.second_order(rule);
        }
    }

    fn order_of_steps(&mut self) {
        let time = &self.scene.time;
        let pairs = [
            ("min_step", &time.min_step, "first_step", &time.first_step),
            ("first_step", &time.first_step, "max_step", &time.max_step),
            ("min_step", &time.min_step, "max_step", &time.max_step),
        ];
        for (small, a, large, b) in pairs {
            if let (Some(a), Some(b)) = (a, b)
                && a.get_ref().0 > b.get_ref().0
            {
                self.conflict(
                    &a.span(),
                    format!("`{small}` is larger than `{large}`"),
                    "min_step <= first_step <= max_step",
                    (&b.span(), large),
                );
                return;
            }
        }
    }

    fn second_order(&mut self, rule: &Spanned<Rule>) {
        for (name, interface) in &self.scene.interfaces {
            let kind = interface.law.as_ref().and_then(|l| l.get_ref().kind.as_ref());
            if let Some(kind) = kind.filter(|k| OF_SLIP.contains(&k.get_ref().as_str())) {
                self.conflict(
                    &rule.span(),
                    format!(
                        "`bdf2` is for laws of the slip rate, but interface `{name}` has \"{}\"",
                        kind.get_ref()
                    ),
                    "use `rule = \"backward-euler\"`, or leave it out",
                    (&kind.span(), "the law of slip"),
                );
            }
        }
    }
}
