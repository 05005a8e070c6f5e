//! The sliders with their laws and the springs between them.

use super::Planner;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{LawSpec, Spanned};
use crate::reading::scene::slider::{SliderScene, SliderSpec, SpringSpec};
use crate::reading::scene::suggestions;
use crate::shared::law_errors::refused;
use crate::sliders::Plan;
use asperity_cycles::slider::stability;
use asperity_friction::slider::{History, Slider, SliderLaw, Spring, System};
use asperity_laws as laws;
use asperity_run::Warning;
use std::sync::Arc;

impl Planner {
    pub(super) fn slider(&mut self, spec: &SliderSpec) -> Option<Slider> {
        let law = self.law(&spec.law);
        let normal = self.normal(&spec.normal);
        let stiffness = spec.stiffness.as_ref();
        let stiffness = stiffness
            .map_or(Some(0.0), |k| self.positive("stiffness", k.get_ref().0, k.span(), "\"1.25 GPa/m\""));
        let damping = spec.damping.as_ref();
        let damping =
            damping.map_or(Some(0.0), |d| self.positive("damping", d.get_ref().0, d.span(), "\"5 MPa s/m\""));
        let mass = match &spec.mass {
            None => Some(None),
            Some(m) => self.positive("mass", m.get_ref().0, m.span(), "\"3000 kg/m^2\"").map(Some),
        };
        Some(Slider { law: law?, stiffness: stiffness?, damping: damping?, mass: mass?, normal: normal? })
    }

    /// Imposed slip rate of a slider, if any; the outer `None` is an error.
    pub(super) fn imposed(&mut self, spec: &SliderSpec) -> Option<Option<History>> {
        let Some(rate) = &spec.rate else { return Some(None) };
        let idle = [
            ("stiffness", spec.stiffness.as_ref().map(Spanned::span)),
            ("damping", spec.damping.as_ref().map(Spanned::span)),
            ("mass", spec.mass.as_ref().map(Spanned::span)),
            ("start", spec.start.as_ref().map(Spanned::span)),
        ];
        if let Some((name, Some(place))) = idle.into_iter().find(|i| i.1.is_some()) {
            let message = format!("`{name}` has no effect where the slip rate is imposed");
            let error = Diagnostic::at(place, message, format!("remove `{name}`, or remove `rate`"));
            self.errors.push(error.and(rate.span(), "`rate`"));
            return None;
        }
        self.course(rate, |v| v.0, "rate").map(Some)
    }

    /// A system with imposed slip rates.
    pub(super) fn impose(&mut self, mut system: System, rates: Vec<Option<History>>) -> Option<System> {
        for (i, rate) in rates.into_iter().enumerate() {
            let Some(rate) = rate else { continue };
            system = match system.impose(i, rate) {
                Ok(system) => system,
                Err(failure) => return self.error(0..0, failure.to_string(), "change that value"),
            };
        }
        Some(system)
    }

    /// Warnings about sliders whose run ends when quasi-static equilibrium is lost.
    pub(super) fn runaways(&mut self, scene: &SliderScene, plan: &mut Plan) {
        for (i, ratio) in stability::runaways(&plan.problem) {
            let name = &plan.problem.names[i];
            let spec = scene.sliders[name].get_ref();
            let place = spec.stiffness.as_ref().map_or(spec.law.span(), Spanned::span);
            let message = format!(
                "`{name}` is softer than critical (k/k_c = {ratio:.3}) and has neither damping nor mass: its slip rate grows \
                 beyond bounds in finite time, where the run ends"
            );
            let help = "give it `damping` (G/(2 c_s) for radiation) or `mass`, or a stiffer spring";
            plan.warnings.push(Warning::at(place, message, help));
        }
    }

    fn law(&mut self, spec: &Spanned<LawSpec>) -> Option<Arc<dyn SliderLaw>> {
        let choice: LawChoice = match laws::choose_sliding(spec) {
            Ok(choice) => choice,
            Err(errors) => {
                self.errors.extend(errors);
                return None;
            }
        };
        match laws::build_sliding(&choice) {
            Ok(Some(law)) => Some(law),
            Ok(None) => self.error(
                spec.span(),
                "a spring-slider needs a law with a slip rate: this one sticks until it slips",
                "kinds `rate` and `rate-and-state` have one",
            ),
            Err(failure) => {
                self.errors.push(refused(spec, &failure));
                None
            }
        }
    }

    pub(super) fn spring(&mut self, spec: &SpringSpec, names: &[String]) -> Option<Spring> {
        let between = spec.between.get_ref();
        if between.len() != 2 {
            let message = format!("a spring is between two sliders, found {}", between.len());
            return self.error(spec.between.span(), message, "such as `between = [\"left\", \"right\"]`");
        }
        let mut ends = [0; 2];
        for (end, name) in ends.iter_mut().zip(between) {
            let found = names.iter().position(|n| n == name.get_ref());
            let Some(found) = found else {
                let help = suggestions::suggest(name.get_ref(), "sliders", names.iter().map(String::as_str));
                return self.error(name.span(), format!("there is no slider `{}`", name.get_ref()), help);
            };
            *end = found;
        }
        if ends[0] == ends[1] {
            let message = "the spring leads from a slider to itself";
            return self.error(between[1].span(), message, "name two sliders");
        }
        let k = &spec.stiffness;
        let stiffness = self.positive("stiffness", k.get_ref().0, k.span(), "\"0.3 GPa/m\"")?;
        Some(Spring { between: ends, stiffness })
    }

    /// Checks that each slider is connected to the load point by a chain of springs.
    pub(super) fn held(&mut self, scene: &SliderScene, system: &System, names: &[String]) -> Option<()> {
        let each = system.sliders().iter().enumerate();
        let mut held: Vec<bool> =
            each.map(|(i, s)| s.stiffness > 0.0 || system.imposed(i).is_some()).collect();
        let mut grown = true;
        while grown {
            grown = false;
            for spring in system.springs() {
                let [a, b] = spring.between;
                grown |= held[a] != held[b];
                let either = held[a] || held[b];
                (held[a], held[b]) = (either, either);
            }
        }
        let loose = held.iter().position(|h| !h);
        let Some(loose) = loose else { return Some(()) };
        let span = scene.sliders[&names[loose]].span();
        let message = format!("no spring leads from `{}` to the load point", names[loose]);
        self.error(span, message, "give it a `stiffness`, or a spring to a slider that has one")
    }
}
