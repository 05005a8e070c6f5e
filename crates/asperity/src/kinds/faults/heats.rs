//! Heat of faults during a run.

use asperity_cycles::heat::HeatRecord;
use asperity_plan::faults::{HeatView, Plan};
use asperity_plan::shared::words::time;
use asperity_run::Warning;
use schemars::JsonSchema;
use serde::Serialize;

/// Heat of a fault.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct HeatedFault {
    /// Fault.
    pub fault: String,
    /// Temperature at the start \[K\].
    pub ambient: f64,
    /// Largest temperature \[K\].
    pub largest_temperature: f64,
    /// Position of the largest temperature \[m\].
    pub at: [f64; 3],
    /// Time of the largest temperature \[s\].
    pub when: f64,
    /// Largest pore pressure in excess of that at the start, with `pressurisation` \[Pa\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_pressure: Option<f64>,
    /// Points that exceeded the temperature of melting, if it is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub molten: Option<usize>,
    /// Number of points of the fault.
    pub of: usize,
}

/// Heat of all faults that have some, and warnings of melting.
#[must_use]
pub fn heats(plan: &Plan, warmed: Option<&HeatRecord>) -> (Vec<HeatedFault>, Vec<Warning>) {
    let (mut all, mut warnings) = (Vec::new(), Vec::new());
    for fault in &plan.faults {
        let (Some(heat), Some(warmed)) = (&fault.heat, warmed) else { continue };
        let warmest = warmed.summary(fault.points.clone(), heat.melting.unwrap_or(f64::INFINITY));
        let found = HeatedFault {
            fault: fault.name.clone(),
            ambient: heat.layer.ambient,
            largest_temperature: warmest.temperature,
            at: warmest.point.map_or([0.0; 3], |p| plan.points[p].at),
            when: warmest.when,
            largest_pressure: heat.layer.pressurisation.map(|_| warmest.pressure),
            molten: heat.melting.map(|_| warmest.beyond),
            of: fault.points.len(),
        };
        warnings.extend(molten(&found, heat));
        all.push(found);
    }
    (all, warnings)
}

/// Warning about a fault that exceeded the temperature of melting.
fn molten(found: &HeatedFault, heat: &HeatView) -> Option<Warning> {
    let (melting, molten) = (heat.melting?, found.molten.filter(|m| *m > 0)?);
    Some(Warning::at(
        0..0,
        format!(
            "fault `{}` reached {:.0} K and exceeded `melting`, {melting:?} K, at {molten} of {} points: friction of solids does not hold there",
            found.fault, found.largest_temperature, found.of
        ),
        "a thicker zone heats less; `evolution = \"flash\"` and `pressurisation` weaken faults before they melt",
    ))
}

impl HeatedFault {
    /// Summary for the results.
    #[must_use]
    pub fn words(&self) -> String {
        let [x, y, z] = self.at;
        let pressure = self
            .largest_pressure
            .map_or(String::new(), |p| format!("; pore pressure rose by up to {:.4} MPa", p / 1e6));
        format!(
            "heat of fault `{}`: up to {:.1} K at {} (at x = {x:e} m, y = {y:e} m, z = {z:e} m), {:.1} K at the start{pressure}",
            self.fault,
            self.largest_temperature,
            time(self.when),
            self.ambient
        )
    }
}
