//! Numbers and kinds of outputs.

use super::Checker;
use crate::model::Spanned;
use crate::suggestions::suggest;

/// Largest number of probes of an interface, or of outputs of a stage. More are a typing error: each output is a file.
const MOST_OUTPUTS: usize = 100_000;

/// Smallest admissible limit of a growing file \[bytes\]. Below it there is no room for a profile of a fault.
const LEAST_FILE: f64 = 1e4;

impl Checker<'_> {
    pub(super) fn output(&mut self) {
        self.samples();
        self.receivers();
        self.sites();
        self.surface();
        self.coulomb();
        self.platform();
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

    /// Checks points and forces.
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

    /// Checks the slip rate at which points of faults through cycles have ruptured; explicit steps check their own.
    fn rupture_rate(&mut self) {
        let rate = self.scene.output.rupture_rate.as_ref().filter(|_| !self.has_waves());
        if let Some(rate) = rate.filter(|v| !(v.get_ref().0 > 0.0 && v.get_ref().0.is_finite())) {
            self.error(
                rate.span(),
                "`rupture_rate` must be positive",
                "such as `rupture_rate = \"0.1 m/s\"`",
            );
        }
    }

    /// Checks the times of outputs of faults.
    pub(super) fn cadence(&mut self) {
        self.rupture_rate();
        let output = &self.scene.output;
        let mut amounts = Vec::new();
        if let Some(cadence) = output.cadence.as_ref().map(Spanned::get_ref) {
            amounts.extend(cadence.decades.as_ref().map(|d| ("decades", d.span(), *d.get_ref())));
            amounts.extend(cadence.slip.as_ref().map(|s| ("slip", s.span(), s.get_ref().0)));
            amounts.extend(cadence.longest.as_ref().map(|t| ("longest", t.span(), t.get_ref().0)));
            amounts.extend(cadence.shortest.as_ref().map(|t| ("shortest", t.span(), t.get_ref().0)));
        }
        if let Some(contours) = &output.contours {
            amounts.extend(contours.get_ref().iter().map(|t| ("contours", contours.span(), t.0)));
        }
        for (name, place, amount) in amounts {
            if !(amount > 0.0 && amount.is_finite()) {
                self.error(
                    place,
                    format!("`{name}` must be positive, found {amount}"),
                    "leave it out for the default; every step makes a row where `decades` is tiny",
                );
            }
        }
        if let Some(count) = output.event_files.as_ref().filter(|c| *c.get_ref() > MOST_OUTPUTS) {
            self.too_many(count, "event_files", MOST_OUTPUTS);
        }
        if let Some(contours) = &output.contours {
            let [between, within] = contours.get_ref().map(|t| t.0);
            if within > between {
                self.error(
                    contours.span(),
                    "profiles in events come more rarely than between them",
                    "first the time between events, then that in them, such as [\"5 yr\", \"1 s\"]",
                );
            }
        }
        if let Some(most) =
            output.largest_file.as_ref().filter(|m| m.get_ref().0.is_nan() || m.get_ref().0 < LEAST_FILE)
        {
            self.error(
                most.span(),
                format!("files of {} bytes at most have no room", most.get_ref().0),
                "at least \"10 kB\", such as \"100 MB\"",
            );
        }
    }
}
