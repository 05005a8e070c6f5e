//! Checks of parameters of faults and interfaces that files give.

use super::Checker;
use crate::law;
use crate::model::{Fault, Interface, Spanned};

impl Checker<'_> {
    /// Refuses a parameter that a file and a profile give.
    pub(super) fn fields(&mut self, fault: &Fault) {
        self.field_of_difference(fault);
        self.field_of_state(fault);
        let profiles = fault.profiles.all();
        for (key, field) in fault.fields.all() {
            let profile = profiles.iter().find(|p| p.0 == key).and_then(|p| p.1?.0.first());
            if let (Some(field), Some(profile)) = (field, profile) {
                self.conflict(
                    &field.file.span(),
                    format!("`{key}` is given by a file and by a profile"),
                    format!("one of `fields.{key}` and `profiles.{key}`; `patches` apply after either"),
                    (&profile.points.span(), "the profile"),
                );
            }
        }
    }

    /// Refuses b from two sources: a file of a - b and another one.
    fn field_of_difference(&mut self, fault: &Fault) {
        let Some(difference) = &fault.fields.a_minus_b else { return };
        let profile = fault.profiles.b.as_ref().and_then(|p| p.0.first()).map(|p| p.points.span());
        let Some(other) = fault.fields.b.as_ref().map(|f| f.file.span()).or(profile) else { return };
        self.conflict(
            &difference.file.span(),
            "a file gives `a_minus_b`, from which `b` follows, and another entry gives `b`",
            "one of them",
            (&other, "`b`"),
        );
    }

    /// Refuses a shear traction beside slip rates and states, of which two give the third.
    fn field_of_state(&mut self, fault: &Fault) {
        let scene = self.scene;
        let Some(state) = &fault.fields.state else { return };
        let profile = fault.profiles.shear.as_ref().and_then(|p| p.0.first()).map(|p| p.points.span());
        let patch = fault.patches.iter().find_map(|p| p.shear.as_ref()).map(Spanned::span);
        let bodies = [&fault.minus, &fault.plus].map(|side| scene.body_of(side));
        let of_bodies = bodies.iter().flatten().find_map(|b| {
            b.initial_stress.as_ref().map(Spanned::span).or(b.gravity.as_ref().map(Spanned::span))
        });
        let pressed = scene.stages.get(1).map(|stage| stage.duration.span());
        let given = fault.shear.as_ref().map(Spanned::span);
        let given = given.or(fault.fields.shear.as_ref().map(|f| f.file.span())).or(profile).or(patch);
        let Some(other) = given.or(of_bodies).or(pressed) else { return };
        self.conflict(
            &state.file.span(),
            "a file gives the states of the fault, and its shear traction is given as well: it follows from states and slip rates",
            "`fields.state` with `rate` or `fields.rate`, or a shear traction, from which the state follows",
            (&other, "the shear traction"),
        );
    }

    /// Refuses parameters from files that the law of an interface does not have.
    pub(super) fn law_fields(&mut self, name: &str, interface: &Interface) {
        let Some(spec) = &interface.law else {
            for (key, field) in interface.fields.given() {
                self.error(
                    field.file.span(),
                    format!("interface `{name}` takes `{key}` from a file, but has no friction law"),
                    "add the law whose parameter it is, or remove `fields`",
                );
            }
            return;
        };
        // A law that is not complete is refused as such.
        let Ok(choice) = law::choose(spec, self.laws) else { return };
        let varies = |key: &str| choice.varies(key, self.laws).is_some();
        let all: Vec<&str> =
            interface.fields.all().into_iter().map(|f| f.0).filter(|key| varies(key)).collect();
        let strange: Vec<_> = interface.fields.given().filter(|(key, _)| !varies(key)).collect();
        for (key, field) in strange {
            let help = match &all[..] {
                [] => "remove it: a bond has no parameters".to_owned(),
                all => format!("files may give {} to this law", all.join(", ")),
            };
            self.conflict(
                &field.file.span(),
                format!(
                    "`{key}` varies along interface `{name}`, and its law does not have exactly one `{key}`"
                ),
                help,
                (&spec.span(), "the law"),
            );
        }
    }
}
