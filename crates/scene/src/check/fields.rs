//! Checks of parameters of faults that files give.

use super::Checker;
use crate::model::Fault;

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
}
