//! Output of the commands on standard output.

use super::read::Planned;
use asperity_output::terminal::printing::out;

/// Prints the plan and its checks.
pub(super) fn plan(plan: &Planned) {
    out(format_args!("{}", plan_text(plan)));
}

/// The plan and its checks as printed.
pub(super) fn plan_text(plan: &Planned) -> String {
    let checks = plan.checks();
    match plan {
        Planned::Bodies(plan) => format!("{}{checks}", plan.summary()),
        Planned::Sliders(plan) => format!("{}{checks}", plan.summary()),
        Planned::Faults(plan) => format!("{}{checks}", plan.summary()),
        Planned::Dynamic(plan) => format!("{}{checks}", plan.summary()),
    }
}
