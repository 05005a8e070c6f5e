//! Fluid injected into faults.

use super::Checker;
use crate::model::{Fault, Flux, Injection, Spanned, TimeSeries};
use crate::units::{Length, Time};

impl Checker<'_> {
    /// Checks the wells of a fault.
    pub(super) fn wells(&mut self, fault: &Fault) {
        let Some(wells) = &fault.injection else { return };
        if wells.0.is_empty() {
            self.error(
                fault.span(),
                "`injection` is a list without wells",
                "such as `injection = [{ at = \"2 km\", flux = \"1.25e-6 m/s\", .. }]`, or remove it",
            );
        }
        for (k, well) in wells.0.iter().enumerate() {
            self.well(well);
            for other in &wells.0[..k] {
                self.beside(well, other);
            }
        }
    }

    /// Refuses wells of a fault at one place, and in layers that differ: pressures of one layer add up.
    fn beside(&mut self, well: &Injection, other: &Injection) {
        if well.at.get_ref().0 == other.at.get_ref().0 {
            self.at_one_position(&well.at, &other.at);
        }
        for (key, one, two) in [
            ("diffusivity", &well.diffusivity, &other.diffusivity),
            ("porosity", &well.porosity, &other.porosity),
            ("compressibility", &well.compressibility, &other.compressibility),
        ] {
            if one.get_ref() != two.get_ref() {
                self.conflict(
                    &one.span(),
                    format!("two wells of a fault differ in `{key}`"),
                    format!("give them the same `{key}`: they share the layer in which fluid diffuses"),
                    (&two.span(), "the other well"),
                );
            }
        }
    }

    /// Refuses a well where another one is.
    pub(super) fn at_one_position(&mut self, well: &Spanned<Length>, other: &Spanned<Length>) {
        self.conflict(
            &well.span(),
            "two wells at one position of the fault",
            "one well with the sum of both, such as `flux = { steps = [[\"0 d\", \"1e-6 m/s\"], [\"10 d\", 0]] }`",
            (&other.span(), "the other well"),
        );
    }

    fn well(&mut self, injection: &Injection) {
        let positive = |v: f64| v > 0.0 && v.is_finite();
        self.flux(&injection.flux, injection.until.as_ref());
        for (name, value, example) in [
            ("diffusivity", &injection.diffusivity, "in m²/s, such as `diffusivity = 0.1`"),
            ("compressibility", &injection.compressibility, "in 1/Pa, such as `compressibility = 1e-8`"),
        ] {
            if !positive(*value.get_ref()) {
                self.error(value.span(), format!("`{name}` must be positive"), example);
            }
        }
        let porosity = *injection.porosity.get_ref();
        if !(positive(porosity) && porosity <= 1.0) {
            self.error(
                injection.porosity.span(),
                "`porosity` must lie between 0 and 1",
                "such as `porosity = 0.1`",
            );
        }
    }

    /// Checks the flux of a well and its end.
    pub(super) fn flux(&mut self, flux: &Spanned<Flux>, until: Option<&Spanned<Time>>) {
        if let Some(until) = until.filter(|t| !(t.get_ref().0 > 0.0 && t.get_ref().0.is_finite())) {
            self.error(
                until.span(),
                "`until` must be positive",
                "such as `until = \"100 d\"`, or leave it out",
            );
        }
        match flux.get_ref() {
            Flux::Constant(value) if !value.is_finite() || *value == 0.0 => self.error(
                flux.span(),
                "`flux` must not be zero",
                "such as `flux = \"1.25e-6 m/s\"`; negative for extraction",
            ),
            Flux::Constant(_) => {}
            Flux::Steps(steps) => {
                self.steps_of_flux(flux, steps);
                if let Some(until) = until {
                    self.conflict(
                        &until.span(),
                        "`until` of a well whose `flux` has steps",
                        "a last step with a flux of 0, such as `[\"100 d\", 0]`",
                        (&flux.span(), "the steps"),
                    );
                }
            }
        }
    }

    /// Checks that the times of a flux ascend from the start of the run on, and that something flows.
    fn steps_of_flux(&mut self, place: &Spanned<Flux>, steps: &TimeSeries) {
        let help = "pairs of time and the flux from then on, such as `steps = [[\"0 d\", \"1e-6 m/s\"], [\"10 d\", 0]]`";
        let finite = |step: &(f64, f64)| step.0.is_finite() && step.1.is_finite();
        if let Some(w) = steps.windows(2).find(|w| w[0].0 >= w[1].0) {
            let message = format!("the times of `flux` must ascend, found {} s after {} s", w[1].0, w[0].0);
            self.error(place.span(), message, help);
        } else if let Some(early) = steps.first().filter(|step| step.0 < 0.0) {
            let message = format!("`flux` has a step at {} s, before the run begins", early.0);
            self.error(
                place.span(),
                message,
                "times since the start; the pressure there is that of no fluid",
            );
        } else if !steps.iter().all(finite) || steps.iter().all(|step| step.1 == 0.0) {
            // A table in a file is empty where the file could not be read, which is an error of its own.
            if !(steps.is_empty() && steps.file().is_some()) {
                self.error(place.span(), "`flux` must not be zero at all times, nor infinite", help);
            }
        }
    }
}
