//! Checks of patches of faults.

use super::Checker;
use crate::model::{Fault, PATCHED, Patch, Spanned};

impl Checker<'_> {
    pub(super) fn patches(&mut self, fault: &Fault) {
        for patch in &fault.patches {
            self.extent_of(patch, fault);
            self.values_of(patch, fault);
        }
    }

    fn extent_of(&mut self, patch: &Patch, fault: &Fault) {
        let place = patch.span().unwrap_or_else(|| fault.law.span());
        if patch.within.is_some() == patch.disc.is_some() {
            self.error(
                place,
                "a patch needs either `box` or `disc`",
                "such as `{ box = { y = { from = \"-16 km\", to = \"-4 km\" } }, a = 0.01 }`",
            );
        }
        if let Some(within) = &patch.within {
            self.ranges("box", within);
        }
        if let Some(disc) = &patch.disc {
            let (wanted, centre) = (if self.in_space() { 3 } else { 2 }, disc.centre.get_ref());
            if centre.len() != wanted || !centre.iter().all(|x| x.0.is_finite()) {
                self.error(
                    disc.centre.span(),
                    format!(
                        "the centre of a disc has {wanted} finite coordinates here, found {}",
                        centre.len()
                    ),
                    "such as `centre = [\"0 km\", \"-10 km\"]`, in three dimensions with z",
                );
            }
            let radius = disc.radius.get_ref().0;
            if !(radius > 0.0 && radius.is_finite()) {
                self.error(disc.radius.span(), "`radius` must be positive", "such as `radius = \"200 m\"`");
            }
        }
        if let Some(edge) =
            patch.edge.as_ref().filter(|e| !(e.get_ref().0 >= 0.0 && e.get_ref().0.is_finite()))
        {
            self.error(edge.span(), "`edge` must not be negative", "such as `edge = \"2 km\"`");
        }
        let wide = patch.edge.as_ref().is_some_and(|e| e.get_ref().0 > 0.0);
        if let Some(smooth) = patch.smooth.as_ref().filter(|s| *s.get_ref() && !wide) {
            self.error(
                smooth.span(),
                "`smooth` is how values pass over the `edge` of a patch, and this one has none",
                "such as `edge = \"3 km\"`, or remove `smooth`",
            );
        }
    }

    fn values_of(&mut self, patch: &Patch, fault: &Fault) {
        let values = patch.values();
        if values.iter().all(Option::is_none) {
            self.error(
                patch.span().unwrap_or_else(|| fault.law.span()),
                "a patch without a value",
                format!("give one of {}", PATCHED.map(|key| format!("`{key}`")).join(", ")),
            );
        }
        let sense = fault.rate.get_ref().0.signum();
        for (key, value) in PATCHED.into_iter().zip(values) {
            let Some((value, place)) = value else { continue };
            if key == "rate" && !fault.slides() {
                self.error(
                    place,
                    "`rate` of a patch, but the fault has no `rate` outside it",
                    "add `rate` to the fault",
                );
                continue;
            }
            let turned = ["shear", "rate"].contains(&key);
            let positive = if turned { value * sense } else { value };
            let signed = !turned || fault.slides();
            let none = key == "cohesion" && value == 0.0;
            if !((positive > 0.0 || !signed || none) && value.is_finite()) {
                let what = match key {
                    "cohesion" => "not be negative",
                    _ if turned => "have the sign of `rate` of the fault",
                    _ => "be positive",
                };
                self.error(
                    place,
                    format!("`{key}` of a patch must {what}, found {value:?}"),
                    "check its sign and its unit",
                );
            }
        }
        // Beside an initial stress both are refused already.
        let bodies = [&fault.minus, &fault.plus].map(|side| self.scene.body_of(side));
        let stressed = bodies.iter().flatten().any(|body| body.initial_stress.is_some());
        let given = |key: &Option<Spanned<_>>, profile: bool| key.is_some() || profile || stressed;
        for (key, patched, base) in [
            ("normal", &patch.normal, given(&fault.normal, fault.has_normal_along())),
            ("shear", &patch.shear, given(&fault.shear, fault.has_shear_along())),
        ] {
            if let Some(value) = patched.as_ref().filter(|_| !base) {
                self.error(
                    value.span(),
                    format!("`{key}` of a patch, but the fault has no `{key}` outside it"),
                    format!("add `{key}` or `profiles.{key}` to the fault"),
                );
            }
        }
    }
}
