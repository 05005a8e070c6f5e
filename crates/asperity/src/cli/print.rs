//! Output of the commands on standard output.

use super::read::RunPlan;
use asperity_output::terminal::printing::out;

/// Prints the plan and its checks.
pub(super) fn plan(plan: &RunPlan) {
    out(format_args!("{}", plan_text(plan)));
}

/// The plan and its checks as printed.
pub(super) fn plan_text(plan: &RunPlan) -> String {
    let checks = plan.checks();
    match plan {
        RunPlan::Bodies(plan) => format!("{}{checks}", plan.summary()),
        RunPlan::Sliders(plan) => format!("{}{checks}", plan.summary()),
        RunPlan::Faults(plan) => format!("{}{checks}", plan.summary()),
        RunPlan::Dynamic(plan) => format!("{}{checks}", plan.summary()),
    }
}
