//! Outputs: how many, of what.

use super::Checker;
use crate::scene::near::suggest;

/// More probes of an interface, or outputs of a stage, than this are a slip of the keyboard: each output is a file.
const MOST_OUTPUTS: usize = 100_000;

impl Checker<'_> {
    pub(super) fn output(&mut self) {
        self.samples();
        for (name, probes) in &self.scene.output.probes {
            if !self.scene.interfaces.contains_key(name) {
                let known = self.scene.interfaces.keys().map(String::as_str);
                self.error(
                    probes.span(),
                    format!("probes on `{name}`, but there is no such interface"),
                    suggest(name, "interfaces", known),
                );
            }
            if *probes.get_ref() > MOST_OUTPUTS {
                self.too_many(probes, "probes", MOST_OUTPUTS);
            }
            if *probes.get_ref() == 0 {
                self.error(
                    probes.span(),
                    format!("no probes on `{name}`"),
                    "at least 1, or leave the line out",
                );
            }
        }
        for (name, count) in
            [("fields", &self.scene.output.fields), ("profiles", &self.scene.output.profiles)]
        {
            if let Some(count) = count.as_ref().filter(|c| *c.get_ref() > MOST_OUTPUTS) {
                self.too_many(count, name, MOST_OUTPUTS);
            }
            if let Some(count) = count.as_ref().filter(|c| *c.get_ref() == 0) {
                self.error(
                    count.span(),
                    format!("`{name}` must be at least 1: the end of each stage"),
                    format!("such as `{name} = 1`"),
                );
            }
        }
    }

    /// Points and forces.
    fn samples(&mut self) {
        let axes: Vec<usize> = (0..self.dimension()).collect();
        for (name, spec) in &self.scene.output.points {
            self.name("a point", name, spec.span());
            let body = &spec.get_ref().body;
            if !self.scene.bodies.contains_key(body.get_ref()) {
                let known = self.scene.bodies.keys().map(String::as_str);
                self.error(
                    body.span(),
                    format!("there is no body `{}`", body.get_ref()),
                    suggest(body.get_ref(), "bodies", known),
                );
            }
            self.count(&spec.get_ref().at, "at", &axes);
        }
        for (name, spec) in &self.scene.output.forces {
            self.name("a force", name, spec.span());
            self.set(&spec.get_ref().set);
        }
    }
}
