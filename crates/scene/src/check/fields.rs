//! Checks of parameters of faults and interfaces that files give.

use super::Checker;
use crate::law;
use crate::model::{Fault, Interface};

impl Checker<'_> {
    /// Refuses a parameter that a file and a profile give.
    pub(super) fn fields(&mut self, fault: &Fault) {
        let all = &fault.profiles;
        let profiles = [&all.a, &all.b, &all.l, &all.normal, &all.shear];
        for ((key, field), profile) in fault.fields.all().into_iter().zip(profiles) {
            let profile = profile.as_ref().and_then(|p| p.0.first());
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
