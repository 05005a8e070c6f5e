//! Processes of a fault that cannot be together, each with its reason.

use super::Checker;
use crate::model::{Fault, Injections, Spanned};
use std::ops::Range;

/// Keys of the processes of a fault.
pub const PROCESSES: [&str; 6] = ["pulses", "injection", "diffusion", "heat", "opening", "normal_floor"];

/// Two processes that cannot be together on a fault.
#[derive(Clone, Copy, Debug)]
pub struct Incompatibility {
    /// Key of one.
    pub one: &'static str,
    /// Key of the other.
    pub other: &'static str,
    /// Reason.
    pub reason: &'static str,
    /// Name of the other.
    named: &'static str,
}

/// All pairs that cannot be together.
pub const APART: [Incompatibility; 4] = [
    Incompatibility {
        one: "heat",
        other: "injection",
        reason: "heat of friction is not computed where fluid is injected",
        named: "the injection",
    },
    Incompatibility {
        one: "heat",
        other: "diffusion",
        reason: "heat of friction is not computed where fluid diffuses along a fault",
        named: "the diffusion",
    },
    Incompatibility {
        one: "diffusion",
        other: "injection",
        reason: "`injection` and `diffusion` describe the fluid of one fault: each has its own wells",
        named: "the injection",
    },
    Incompatibility {
        one: "heat",
        other: "opening",
        reason: "heat of friction is not computed on faults that open",
        named: "`opening`",
    },
];

/// Position of the key of a process, if the fault has the process.
pub(super) fn process(fault: &Fault, key: &str) -> Option<Range<usize>> {
    match key {
        "pulses" => fault.pulses.first().map(|pulse| pulse.traction.span()),
        "injection" => fault.injection.as_ref().map(Injections::span),
        "diffusion" => fault.diffusion.as_ref().map(|diffusion| diffusion.viscosity.span()),
        "heat" => fault.heat.as_ref().map(|heat| heat.thickness.span()),
        "opening" => fault.opening.as_ref().filter(|opens| *opens.get_ref()).map(Spanned::span),
        "normal_floor" => fault.normal_floor.as_ref().map(Spanned::span),
        _ => None,
    }
}

impl Checker<'_> {
    /// Refuses processes that cannot be together.
    pub(super) fn processes_of(&mut self, fault: &Fault) {
        for Incompatibility { one, other, reason, named } in APART {
            if let [Some(place), Some(beside)] = [one, other].map(|key| process(fault, key)) {
                let help = format!("remove `{one}` or `{other}`");
                self.conflict(&place, reason, help, (&beside, named));
            }
        }
    }
}
