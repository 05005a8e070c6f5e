//! Pressure of pore fluid in excess of that at the start, from heat or from wells.

use asperity_cycles::diffusion::Diffusion;
use asperity_cycles::heat::{Heat, PRESSURE};
use asperity_cycles::{FLUID_PRESSURE, PointTractions, Pressure};
use asperity_plan::faults::Plan;

/// True if it changes at a point and is shown there.
pub(super) fn changes(plan: &Plan, point: usize) -> bool {
    let processes = &plan.problem.fault.processes;
    plan.heat_at(point).is_some_and(|heat| heat.layer.pressurisation.is_some())
        || processes.find::<Diffusion>().is_some_and(|fluid| fluid.reaches(point))
        || processes.find::<Pressure>().is_some_and(|fluid| fluid.reaches(point))
}

/// True if it changes at any point.
pub(super) fn any(plan: &Plan) -> bool {
    let processes = &plan.problem.fault.processes;
    processes.find::<Heat>().is_some_and(Heat::pressurises)
        || processes.find::<Diffusion>().is_some()
        || processes.find::<Pressure>().is_some()
}

/// Pressure of a point \[Pa\], of all sources together.
pub(super) fn at(pressed: &PointTractions, point: usize) -> f64 {
    [&PRESSURE, &FLUID_PRESSURE].into_iter().filter_map(|quantity| pressed.values(quantity).get(point)).sum()
}
