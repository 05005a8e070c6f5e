//! Interfaces and their laws.

use super::Checker;
use crate::scene::law;
use crate::scene::model::{Interface, MeshSource, Sliding, Spanned};
use crate::scene::units::Penalty;

/// Elements in two dimensions whose faces have nodes only at their corners; in three all have.
const LINEAR: [&str; 2] = ["quad4", "tri3"];
/// Elements with nodes between the corners.
const QUADRATIC: [&str; 2] = ["quad9", "tri6"];

impl Checker<'_> {
    pub(super) fn interfaces(&mut self) {
        for (name, interface) in &self.scene.interfaces {
            self.name("an interface", name, interface.slave.span());
            self.sides(name, interface);
            self.penalty(&interface.enforcement.normal, "normal");
            if let Some(tangential) = &interface.enforcement.tangential {
                self.penalty(tangential, "tangential");
            }
            match (&interface.law, &interface.enforcement.tangential) {
                (Some(_), None) => self.error(
                    interface.enforcement.normal.span(),
                    format!("interface `{name}` has friction, but its enforcement has no tangential penalty"),
                    "add `tangential = \"100 E/h\"` to the enforcement",
                ),
                (None, Some(tangential)) => self.error(
                    tangential.span(),
                    format!("interface `{name}` has a tangential penalty, but no friction law"),
                    "remove `tangential`, or add a law such as `law = { kind = \"coulomb\", mu = 0.6 }`",
                ),
                _ => {}
            }
            if let Some(spec) = &interface.law {
                self.errors.extend(law::choose(spec).err().unwrap_or_default());
                let form = &spec.get_ref().form;
                let rate = spec.get_ref().kind.as_ref().is_some_and(|k| k.get_ref() == "rate");
                if let Some(form) = form.as_ref().filter(|f| rate && f.get_ref() == "bare") {
                    self.error(
                        form.span(),
                        "the bare logarithm has no value at rest, and with the law \"rate\" the interface starts at rest",
                        "use `form = \"regularised\"`, which is the same at every rate that matters; the bare form \
                         needs the initial rate of a law with state, `v_initial`",
                    );
                }
            }
        }
    }

    fn sides(&mut self, name: &str, interface: &Interface) {
        let (slave, master) = (self.set(&interface.slave), self.set(&interface.master));
        if let (Some((a, _, _)), Some((b, _, _))) = (&slave, &master)
            && a == b
        {
            self.error(
                interface.master.span(),
                format!("slave and master of interface `{name}` are both sides of body `{a}`"),
                "an interface lies between two bodies",
            );
        }
        if *interface.sliding.get_ref() != Sliding::Finite {
            return;
        }
        for (body, _, _) in [slave, master].into_iter().flatten() {
            let MeshSource::Block(block) = &self.scene.bodies[&body].mesh;
            let element = block.element.get_ref();
            if QUADRATIC.contains(&element.as_str()) {
                self.error(
                    interface.sliding.span(),
                    format!("finite sliding needs linear elements, but body `{body}` has `{element}`"),
                    format!("use {} there, or `sliding = \"small\"`", LINEAR.join(" or ")),
                );
            }
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
