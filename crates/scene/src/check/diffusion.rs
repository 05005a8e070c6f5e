//! Fluid that diffuses along faults.

use super::Checker;
use crate::model::{Diffusion, Fault, ParameterProfiles};

impl Checker<'_> {
    pub(super) fn diffusion(&mut self, fault: &Fault) {
        let Some(diffusion) = &fault.diffusion else { return };
        self.hydraulic(diffusion);
        let viscosity = &diffusion.viscosity;
        if viscosity.get_ref().0 <= 0.0 {
            self.error(
                viscosity.span(),
                "`viscosity` must be positive",
                "water has `viscosity = \"1e-3 Pa s\"`",
            );
        }
        let wells = diffusion.wells.get_ref();
        if wells.is_empty() {
            self.error(
                diffusion.wells.span(),
                "`diffusion` has no wells",
                "such as `wells = [{ at = \"2 km\", flux = \"1.25e-6 m/s\" }]`, or remove it",
            );
        }
        for (k, well) in wells.iter().enumerate() {
            self.flux(&well.flux, well.until.as_ref());
            if let Some(other) = wells[..k].iter().find(|other| other.at.get_ref() == well.at.get_ref()) {
                self.at_one_position(&well.at, &other.at);
            }
        }
    }

    /// Checks that permeability and storage are given once each, and positive.
    fn hydraulic(&mut self, diffusion: &Diffusion) {
        for (key, value, profile, field) in diffusion.parameters() {
            let example = if key == "permeability" { "\"1e-15 m^2\"" } else { "1e-9" };
            let value = value.as_ref();
            if let Some((found, place)) = value.filter(|(found, _)| !(*found > 0.0 && found.is_finite())) {
                let message = format!("`{key}` must be positive, found {found:?}");
                self.error(place.clone(), message, format!("such as `{key} = {example}`"));
            }
            for profile in profile.iter().flat_map(|ParameterProfiles(list)| list) {
                self.profile(key, profile, Some(1.0));
            }
            let profiled = profile.and_then(|p| p.0.first()).map(|p| p.points.span());
            let given = [value.map(|v| v.1.clone()), profiled, field.map(|f| f.file.span())];
            match given.into_iter().flatten().collect::<Vec<_>>().as_slice() {
                [] => self.error(
                    diffusion.viscosity.span(),
                    format!("`diffusion` has no `{key}`"),
                    format!(
                        "`{key} = {example}`, or values along the fault by `profiles.{key}` or `fields.{key}`"
                    ),
                ),
                [_] => {}
                [first, second, ..] => self.conflict(
                    second,
                    format!("`{key}` of `diffusion` is given twice"),
                    format!("one of `{key}`, `profiles.{key}` and `fields.{key}`"),
                    (first, "the other one"),
                ),
            }
        }
    }
}
