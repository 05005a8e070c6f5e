//! Interfaces and their laws.

use super::Checker;
use crate::law;
use crate::model::{DampingSpec, Enforcement, EnforcementKind, Interface, LawSpec, Spanned, Stepper};
use crate::names::SIDES;
use crate::units::{Penalty, Penetration};

/// True if a law bonds its interface.
pub(super) fn is_tied(law: &Spanned<LawSpec>) -> bool {
    law.get_ref().kind.as_ref().is_some_and(|k| k.get_ref() == "tied")
}

/// Kinds of law that depend on the slip rate.
pub(super) const RATED: [&str; 2] = ["rate-and-state", "rate"];

/// Body, axis and end of a side.
type Side = (String, usize, usize);

impl Checker<'_> {
    pub(super) fn interfaces(&mut self) {
        for (name, interface) in &self.scene.interfaces {
            self.name("an interface", name, interface.slave.span());
            self.sides(name, interface);
            self.penalty(&interface.enforcement.normal, "normal");
            if let Some(tangential) = &interface.enforcement.tangential {
                self.penalty(tangential, "tangential");
            }
            self.enforcement(name, &interface.enforcement);
            match (&interface.law, &interface.enforcement.tangential) {
                (Some(law), None) => self.error(
                    interface.enforcement.normal.span(),
                    format!(
                        "interface `{name}` {}, but its enforcement has no tangential penalty",
                        if is_tied(law) { "is tied" } else { "has friction" }
                    ),
                    "add `tangential = \"100 E/h\"` to the enforcement",
                ),
                (None, Some(tangential)) => self.error(
                    tangential.span(),
                    format!("interface `{name}` has a tangential penalty, but no friction law"),
                    "remove `tangential`, or add a law such as `law = { kind = \"coulomb\", mu = 0.6 }`",
                ),
                _ => {}
            }
            self.damping(name, interface);
            self.start_gaps(name, interface);
            self.law_fields(name, interface);
            if let Some(key) = interface.under_resolved.as_ref().filter(|_| interface.law.is_none()) {
                self.error(
                    key.span(),
                    format!(
                        "interface `{name}` has `under_resolved`, but no friction law that points resolve"
                    ),
                    "remove `under_resolved`, or add a law",
                );
            }
            if let Some(spec) = &interface.law {
                self.errors.extend(law::choose(spec, self.laws).err().unwrap_or_default());
                let form = &spec.get_ref().form;
                let rate = spec.get_ref().kind.as_ref().is_some_and(|k| k.get_ref() == "rate");
                if let Some(form) = form.as_ref().filter(|_| rate) {
                    self.at_rest(form);
                }
            }
        }
    }

    /// Checks radiation damping, which acts beside friction that depends on the slip rate, in implicit steps.
    fn damping(&mut self, name: &str, interface: &Interface) {
        let Some(damping) = &interface.damping else { return };
        if let DampingSpec::Value(value) = *damping.get_ref()
            && !(value > 0.0 && value.is_finite())
        {
            self.error(
                damping.span(),
                format!("the `damping` of interface `{name}` must be positive"),
                "such as `damping = \"radiation\"` or `damping = \"4.6 MPa s/m\"`; leave it out for none",
            );
        }
        let kind = interface.law.as_ref().and_then(|l| l.get_ref().kind.as_ref());
        let of_rate = kind.is_some_and(|k| RATED.contains(&k.get_ref().as_str()));
        match &interface.law {
            None => self.error(
                damping.span(),
                format!("interface `{name}` has `damping`, but no friction"),
                "remove it, or add a law of the slip rate: \"rate-and-state\" or \"rate\"",
            ),
            Some(law) if !of_rate => self.conflict(
                &damping.span(),
                format!("interface `{name}` has `damping`, but its law does not depend on the slip rate"),
                "a law of kind \"rate-and-state\" or \"rate\" has a slip rate that damping can bound; remove `damping` otherwise",
                (&law.span(), "the law"),
            ),
            Some(_) => {}
        }
        let waves = self.scene.inertia().is_some() && matches!(damping.get_ref(), DampingSpec::Radiation);
        if waves {
            self.conflict(
                &damping.span(),
                format!("interface `{name}` is damped by radiation, and bodies with inertia carry the waves themselves"),
                "remove `damping`; a value in Pa s/m damps beside the waves",
                (&self.scene.time.stepper.span(), "the stepper"),
            );
        }
    }

    /// Checks that an enforcement has the keys it needs and none of another kind.
    fn enforcement(&mut self, name: &str, enforcement: &Enforcement) {
        let kind = &enforcement.kind;
        let uzawa = *kind.get_ref() == EnforcementKind::Uzawa;
        if uzawa && enforcement.penetration.is_none() {
            self.error(
                kind.span(),
                format!("the enforcement \"uzawa\" of interface `{name}` needs `penetration`, where to end"),
                "such as `penetration = \"1e-6 h\"`, a share of the element size, or a length",
            );
        }
        if let Some(penetration) = &enforcement.penetration {
            let (Penetration::Value(value) | Penetration::Sizes(value)) = *penetration.get_ref();
            if value <= 0.0 {
                self.error(
                    penetration.span(),
                    "`penetration` must be positive",
                    "such as `penetration = \"1e-6 h\"`; \"augmented-lagrangian\" leaves none",
                );
            }
        }
        if let Some(most) = enforcement.augmentations.as_ref().filter(|m| *m.get_ref() == 0) {
            self.error(most.span(), "`augmentations` must be at least 1", "or use `kind = \"penalty\"`");
        }
        let stepper = &self.scene.time.stepper;
        if *kind.get_ref() != EnforcementKind::Penalty && *stepper.get_ref() == Stepper::StaticExplicit {
            self.conflict(
                &kind.span(),
                "the static-explicit stepper follows rates and has no iteration that could move multipliers",
                "use `kind = \"penalty\"`, or the stepper \"implicit\"",
                (&stepper.span(), "the stepper"),
            );
        }
    }

    /// Refuses strengths without state that are undefined at rest, where the interface starts.
    fn at_rest(&mut self, form: &Spanned<String>) {
        let strength = match form.get_ref().as_str() {
            "bare" => "the bare logarithm",
            "cut-off" => "the strength with a cut-off",
            _ => return,
        };
        self.error(
            form.span(),
            format!("{strength} has no value at rest, and with the law \"rate\" the interface starts at rest"),
            "use `form = \"regularised\"`, which is regular at rest; the other forms need the initial rate of a law with \
             state, `v_initial`",
        );
    }

    fn sides(&mut self, name: &str, interface: &Interface) {
        let slave = self.set(&interface.slave);
        for (k, one) in interface.master.iter().enumerate() {
            if let (Some(slave), Some(master)) = (&slave, &self.set(one)) {
                self.pairing(name, [&interface.slave, one], slave, master);
            }
            if let Some(twin) = interface.master.iter().take(k).find(|twin| twin.get_ref() == one.get_ref()) {
                let message = format!("`{one}` is twice a master of interface `{name}`");
                self.conflict(&one.span(), message, "remove one of the two", (&twin.span(), "and here"));
            }
        }
        self.twins(name, interface);
    }

    /// Checks that two sides can be in contact: they belong to different bodies, and face each other.
    fn pairing(&mut self, name: &str, sides: [&Spanned<String>; 2], slave: &Side, master: &Side) {
        let [slave_name, master_name] = sides;
        let (place, also) = (master_name.span(), (&slave_name.span(), "the slave"));
        if slave.0 == master.0 {
            let message =
                format!("slave and master of interface `{name}` are both sides of body `{}`", slave.0);
            self.conflict(&place, message, "an interface lies between two bodies", also);
        } else if slave.1 != master.1 || slave.2 == master.2 {
            let facing = format!("{}.{}", master.0, SIDES[slave.1][1 - slave.2]);
            let message =
                format!("`{slave_name}` and `{master_name}` of interface `{name}` do not face each other");
            self.conflict(&place, message, format!("`{facing}` faces `{slave_name}`"), also);
        }
    }

    /// Refuses interfaces between the same two sides.
    fn twins(&mut self, name: &str, interface: &Interface) {
        let pairs = |i: &Interface| -> Vec<[String; 2]> {
            let ordered = |master: &Spanned<String>| {
                let mut pair = [i.slave.get_ref().clone(), master.get_ref().clone()];
                pair.sort();
                pair
            };
            i.master.iter().map(ordered).collect()
        };
        let own = pairs(interface);
        let mut before = self.scene.interfaces.iter().take_while(|(other, _)| other.as_str() != name);
        if let Some((other, twin)) =
            before.find(|(_, other)| pairs(other).iter().any(|pair| own.contains(pair)))
        {
            let message = format!("interfaces `{other}` and `{name}` lie between the same sides");
            let help = "contact there would be counted twice: remove one of the two";
            self.conflict(&interface.slave.span(), message, help, (&twin.slave.span(), "and here"));
        }
    }

    fn penalty(&mut self, penalty: &Spanned<Penalty>, name: &str) {
        let (Penalty::Value(value) | Penalty::YoungPerSize(value)) = *penalty.get_ref();
        if value <= 0.0 {
            self.error(
                penalty.span(),
                format!("the {name} penalty must be positive"),
                format!(
                    "such as `{name} = \"100 E/h\"`, a hundred times Young's modulus over the element size"
                ),
            );
        }
    }
}
