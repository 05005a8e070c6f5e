//! Checks of frictional heat on faults.

use super::Checker;
use crate::model::{Fault, Heat, Spanned};
use std::ops::Range;

/// Largest thickness of a zone that slips \[m\]; thicker ones are slips of units.
const THICKEST: f64 = 100.0;

/// A value of a key: its name, value and position.
type Value = (&'static str, f64, Range<usize>);

impl Checker<'_> {
    pub(super) fn heat_of(&mut self, fault: &Fault) {
        let Some(heat) = &fault.heat else { return };
        let thickness = heat.thickness.get_ref().0;
        if thickness > THICKEST {
            self.error(
                heat.thickness.span(),
                format!("a zone of {thickness:?} m across the fault is no zone that slips"),
                "`thickness` is that of the layer that friction heats, such as `thickness = \"10 mm\"`",
            );
        }
        self.positive_heat(("thickness", thickness, heat.thickness.span()), "10 mm");
        let (value, place) = (heat.diffusivity.get_ref().0, heat.diffusivity.span());
        self.positive_heat(("diffusivity", value, place), "1 mm^2/s");
        let (value, place) = (heat.capacity.get_ref().0, heat.capacity.span());
        self.positive_heat(("capacity", value, place), "2.7 MJ/(m^3 K)");
        if let Some(fluid) = heat.pressurisation.as_ref().map(Spanned::get_ref) {
            let (value, place) = (fluid.coefficient.get_ref().0, fluid.coefficient.span());
            self.positive_heat(("coefficient", value, place), "0.5 MPa/K");
            let (value, place) = (fluid.diffusivity.get_ref().0, fluid.diffusivity.span());
            self.positive_heat(("diffusivity", value, place), "1 mm^2/s");
        }
        self.temperatures(fault, heat);
        self.weakening(fault, heat);
    }

    /// Refuses a value that is not positive.
    fn positive_heat(&mut self, (key, value, place): Value, example: &str) {
        if !(value > 0.0 && value.is_finite()) {
            self.error(
                place,
                format!("`{key}` of the heat must be positive"),
                format!("such as `{key} = \"{example}\"`"),
            );
        }
    }

    /// Checks that the initial temperature is given once, and that the others exceed it.
    fn temperatures(&mut self, fault: &Fault, heat: &Heat) {
        let law = fault.law.get_ref().temperature.as_ref();
        match (&heat.temperature, law) {
            (None, None) => self.error(
                heat.thickness.span(),
                "the heat of the fault has no `temperature` at the start",
                "such as `temperature = \"500 K\"`",
            ),
            (Some(own), Some(law)) => self.conflict(
                &own.span(),
                "the initial temperature is given twice",
                "remove it here: it is that of the law",
                (&law.span(), "`temperature` of the law"),
            ),
            _ => {}
        }
        if let Some(own) = &heat.temperature {
            self.positive_heat(("temperature", own.get_ref().0, own.span()), "500 K");
        }
        let Some(start) = heat.temperature.as_ref().map(|t| t.get_ref().0).or(law.map(|t| *t.get_ref()))
        else {
            return;
        };
        let above = [("melting", &heat.melting), ("weakening_temperature", &heat.weakening_temperature)];
        for (key, given) in above {
            let Some(given) =
                given.as_ref().filter(|t| !(t.get_ref().0 > start && t.get_ref().0.is_finite()))
            else {
                continue;
            };
            self.error(
                given.span(),
                format!("`{key}` must exceed the temperature at the start, {start:?} K"),
                format!("such as `{key} = \"1200 K\"`"),
            );
        }
    }

    /// Checks that the law has contacts that weaken where their temperature is given.
    fn weakening(&mut self, fault: &Fault, heat: &Heat) {
        let evolution = fault.law.get_ref().evolution.as_ref();
        let flash = evolution.is_some_and(|e| e.get_ref() == "flash");
        if let Some(weakening) = heat.weakening_temperature.as_ref().filter(|_| !flash) {
            self.conflict(
                &weakening.span(),
                "`weakening_temperature` is that of contacts that weaken by flash heating, and the law has none",
                "use `evolution = \"flash\"`, or remove it",
                (&fault.law.span(), "the law"),
            );
        }
    }
}
