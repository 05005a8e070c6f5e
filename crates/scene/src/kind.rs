//! Kinds of run, to some of which a key of scenes may belong.

use serde::Serialize;

/// Kinds of run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Bodies with interfaces, by implicit steps.
    Implicit,
    /// Bodies with interfaces, by static-explicit steps.
    StaticExplicit,
    /// Bodies with interfaces, which have inertia while these slip fast.
    Auto,
    /// Faults between bodies, through cycles.
    Cycles,
    /// Faults in a medium without bodies, through cycles.
    Medium,
    /// Faults through cycles whose ruptures have mass.
    Ruptures,
    /// Bodies with mass, by explicit steps.
    Explicit,
    /// Spring-sliders.
    Sliders,
}

use Kind::{Auto, Cycles, Explicit, Implicit, Medium, Ruptures, Sliders, StaticExplicit};

/// All kinds.
pub(crate) const ALL: [Kind; 8] =
    [Implicit, StaticExplicit, Auto, Cycles, Medium, Ruptures, Explicit, Sliders];
/// Scenes of bodies or of faults.
pub(crate) const OF_BODIES: [Kind; 7] = [Implicit, StaticExplicit, Auto, Cycles, Medium, Ruptures, Explicit];
/// Scenes with interfaces.
pub(crate) const INTERFACES: &[Kind] = &[Implicit, StaticExplicit, Auto];
/// Scenes with interfaces whose steps iterate.
pub(crate) const ITERATED: &[Kind] = &[Implicit, Auto];
/// Scenes with faults.
pub(crate) const FAULTS: &[Kind] = &[Cycles, Medium, Ruptures, Explicit];
/// Faults through cycles whose ruptures have no mass.
pub(crate) const CYCLES: &[Kind] = &[Cycles, Medium];
/// Faults through cycles.
pub(crate) const FAULT_CYCLES: &[Kind] = &[Cycles, Medium, Ruptures];
/// Bodies in which waves run, at least in ruptures.
pub(crate) const WAVES: &[Kind] = &[Explicit, Ruptures];
/// Scenes with bodies.
pub(crate) const BODIES: &[Kind] = &[Implicit, StaticExplicit, Auto, Cycles, Ruptures, Explicit];
/// Scenes with bodies or a medium whose steps do not follow waves throughout.
pub(crate) const SLOW: &[Kind] = &[Implicit, StaticExplicit, Auto, Cycles, Medium, Ruptures];

/// Faults between bodies.
pub(crate) const BETWEEN_BODIES: &[Kind] = &[Cycles, Ruptures, Explicit];
/// Faults whose ruptures have mass throughout or never.
pub(crate) const WITHOUT_RUPTURES: &[Kind] = &[Cycles, Medium, Explicit];
/// Scenes with interfaces, or with faults between bodies through cycles.
pub(crate) const INTERFACES_OR_CYCLES: &[Kind] = &[Implicit, StaticExplicit, Auto, Cycles];
/// Scenes with interfaces, or with mass throughout.
pub(crate) const INTERFACES_OR_EXPLICIT: &[Kind] = &[Implicit, StaticExplicit, Auto, Explicit];

/// Kinds as scenes state them.
const WORDS: [(&[Kind], &str); 10] = [
    (&[Implicit], "\"implicit\""),
    (&[StaticExplicit], "\"static-explicit\""),
    (&[Cycles, Medium], "\"fault-ode\""),
    (&[Cycles], "\"fault-ode\" between bodies"),
    (&[Medium], "\"fault-ode\" in a medium"),
    (&[Auto, Ruptures], "\"auto\""),
    (&[Auto], "\"auto\" with interfaces"),
    (&[Ruptures], "\"auto\" with faults"),
    (&[Explicit], "\"explicit\""),
    (&[Sliders], "spring-sliders"),
];

impl Kind {
    /// The kind as a message names it.
    pub(crate) fn name(self) -> String {
        let words = words(&[self]);
        if self == Sliders { words } else { format!("the stepper {words}") }
    }
}

/// Kinds as text: values of `stepper`, with what the scene consists of where that matters.
#[must_use]
pub fn words(kinds: &[Kind]) -> String {
    listed(kinds, WORDS)
}

/// A list of things by the names of groups of them, of which the first come first.
pub(crate) fn listed<'a, T: Copy + PartialEq + 'a>(
    things: &[T],
    groups: impl IntoIterator<Item = (&'a [T], &'a str)>,
) -> String {
    let mut left = things.to_vec();
    let mut words = Vec::new();
    for (those, word) in groups {
        if those.iter().all(|thing| left.contains(thing)) {
            left.retain(|thing| !those.contains(thing));
            words.push(word);
        }
    }
    match words.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => words.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_named_by_their_stepper_and_only_where_needed_by_more() {
        assert_eq!(words(CYCLES), "\"fault-ode\"");
        assert_eq!(words(WAVES), "\"auto\" with faults and \"explicit\"");
        assert_eq!(words(INTERFACES), "\"implicit\", \"static-explicit\" and \"auto\" with interfaces");
        assert_eq!(words(&[Medium, Cycles, Auto, Ruptures]), "\"fault-ode\" and \"auto\"");
    }
}
