//! Scenes of spring-sliders: `kinematics = "spring-slider"`.

use super::law::{self, LawChoice};
use super::model::{LawSpec, Spanned};
use super::units::{Damping, Mass, Pressure, Spring, Time, Velocity};
use super::{SceneError, SceneErrors, explain, near};
use crate::ode::Method;
use crate::slider::{Plan, Thresholds};
use asperity_friction::slider::{History, Slider, Sliding, System};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;
use std::str::FromStr;
use std::sync::Arc;

/// A scene of spring-sliders.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliderScene {
    /// Version of the scene format; 1.
    pub schema: Spanned<u32>,
    /// Title, shown in reports.
    pub title: String,
    /// "spring-slider".
    pub kinematics: Spanned<String>,
    /// Load point.
    pub load: Load,
    /// Sliders by name, in the order of the names.
    pub sliders: BTreeMap<String, Spanned<SliderSpec>>,
    /// Springs between sliders.
    #[serde(default)]
    pub springs: Vec<Spanned<SpringSpec>>,
    /// Time integration.
    pub time: SliderTime,
    /// Events.
    pub events: Option<EventSpec>,
}

/// The load point.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Its rate \[m/s\].
    pub rate: Spanned<Course<Velocity>>,
}

/// A slider.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliderSpec {
    /// Friction.
    pub law: Spanned<LawSpec>,
    /// Normal traction f_n \[Pa\].
    pub normal: Spanned<Course<Pressure>>,
    /// Stiffness k to the load point \[Pa/m\].
    pub stiffness: Option<Spanned<Spring>>,
    /// Radiation damping η \[Pa s/m\].
    pub damping: Option<Spanned<Damping>>,
    /// Mass per area M \[kg/m²\].
    pub mass: Option<Spanned<Mass>>,
    /// Slip rate at time 0 \[m/s\]; without it that of the law's initial steady state.
    pub start: Option<Spanned<Velocity>>,
}

/// A spring between two sliders.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpringSpec {
    /// Names of the sliders.
    pub between: [Spanned<String>; 2],
    /// Stiffness \[Pa/m\].
    pub stiffness: Spanned<Spring>,
}

/// A course over time: a constant, a table, or a sine.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Course<Q> {
    /// Constant.
    Constant(Q),
    /// Piecewise linear, with steps where two entries have one time.
    Table {
        /// [time, value], ...
        table: Vec<(Time, Q)>,
    },
    /// Around a mean.
    Sine {
        /// Mean.
        mean: Q,
        /// Amplitude.
        amplitude: Q,
        /// Period \[s\].
        period: Time,
        /// Time of a rising crossing of the mean \[s\].
        start: Option<Time>,
    },
}

/// Time integration.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliderTime {
    /// End \[s\].
    pub end: Spanned<Time>,
    /// Method.
    pub method: Option<Spanned<String>>,
    /// Error allowed in ln V and in what is worth as much of each state, per step \[-\].
    pub tolerance: Option<Spanned<f64>>,
    /// First step \[s\].
    pub first_step: Option<Spanned<Time>>,
    /// Largest step \[s\].
    pub max_step: Option<Spanned<Time>>,
    /// Steps after which to give up.
    pub most_steps: Option<Spanned<usize>>,
}

/// Events.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventSpec {
    /// Slip rate above which an event begins \[m/s\].
    pub above: Spanned<Velocity>,
    /// Slip rate below which it ends \[m/s\]; a tenth of `above` where absent.
    pub below: Option<Spanned<Velocity>>,
    /// Events of the first slider after which the run ends.
    pub stop_after: Option<Spanned<usize>>,
    /// Whether the extremes of the slip rate are found, not only seen at steps (default true).
    pub peaks: Option<bool>,
}

/// The kinematics of a scene file, if so much can be read.
#[must_use]
pub fn is_slider(text: &str) -> bool {
    #[derive(Deserialize)]
    struct Head {
        kinematics: String,
    }
    toml::from_str::<Head>(text).is_ok_and(|head| head.kinematics == "spring-slider")
}

/// Reads, checks and plans a scene of spring-sliders.
///
/// # Errors
/// All that is wrong with it, or the first thing that keeps it from being read.
pub fn read(text: &str) -> Result<Plan, SceneErrors> {
    let scene: SliderScene =
        toml::from_str(text).map_err(|e| SceneErrors(vec![explain::explain(&e, text)]))?;
    let mut planner = Planner { errors: Vec::new() };
    let plan = planner.plan(&scene);
    let mut errors = planner.errors;
    errors.sort_by_key(|e| (e.span.is_empty(), e.span.start));
    match plan {
        Some(plan) if errors.is_empty() => Ok(plan),
        _ => Err(SceneErrors(errors)),
    }
}

/// Turns a scene into a plan and collects what is wrong.
struct Planner {
    errors: Vec<SceneError>,
}

impl Planner {
    fn error<T>(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.errors.push(SceneError::at(span, message, help));
        None
    }

    fn plan(&mut self, scene: &SliderScene) -> Option<Plan> {
        if *scene.schema.get_ref() != 1 {
            let message = format!("this program reads schema 1, not {}", scene.schema.get_ref());
            self.error::<()>(scene.schema.span(), message, "set `schema = 1`");
        }
        if scene.sliders.is_empty() {
            return self.error(0..0, "the scene has no slider", "add a table `[sliders.NAME]`");
        }
        let load = self.course(&scene.load.rate, |v| v.0, "rate");
        let names: Vec<String> = scene.sliders.keys().cloned().collect();
        let sliders: Vec<Option<Slider>> = scene.sliders.values().map(|s| self.slider(s.get_ref())).collect();
        let springs: Vec<_> = scene.springs.iter().map(|s| self.spring(s.get_ref(), &names)).collect();
        let time = self.time(&scene.time);
        let events = scene.events.as_ref().map(|e| self.events(e));
        let (load, sliders) = (load?, sliders.into_iter().collect::<Option<Vec<_>>>()?);
        let springs = springs.into_iter().collect::<Option<Vec<_>>>()?;
        let system = match System::new(sliders, springs, load) {
            Ok(system) => system,
            Err(failure) => return self.error(0..0, failure.to_string(), "change that value"),
        };
        self.held(scene, &system, &names)?;
        let start = self.start(scene, &system)?;
        let mut plan = Plan::new(system, start, time?);
        plan.title.clone_from(&scene.title);
        plan.names = names;
        self.settings(&scene.time, &mut plan);
        if let (Some(thresholds), Some(spec)) = (events, &scene.events) {
            plan.events = Some(thresholds?);
            plan.peaks = spec.peaks.unwrap_or(true);
            plan.most_events = spec.stop_after.as_ref().map(|n| *n.get_ref());
        }
        Some(plan)
    }

    fn positive(&mut self, name: &str, value: f64, span: Range<usize>, example: &str) -> Option<f64> {
        if value > 0.0 && value.is_finite() {
            return Some(value);
        }
        let message = format!("`{name}` must be positive, found {value:?}");
        self.error(span, message, format!("such as `{name} = {example}`"))
    }

    fn course<Q>(&mut self, course: &Spanned<Course<Q>>, si: fn(&Q) -> f64, name: &str) -> Option<History> {
        let history = match course.get_ref() {
            Course::Constant(value) => Ok(History::Constant(si(value))),
            Course::Table { table } => History::table(table.iter().map(|(t, v)| (t.0, si(v))).collect()),
            Course::Sine { mean, amplitude, period, start } => {
                History::sine(si(mean), si(amplitude), period.0, start.map_or(0.0, |s| s.0))
            }
        };
        match history {
            Ok(history) => Some(history),
            Err(asperity_friction::Failure::Parameter { name: part, value, admissible }) => {
                let message = format!("the {part} of `{name}` has {value:e}, which is not admissible");
                self.error(course.span(), message, format!("it takes {admissible}"))
            }
            Err(other) => self.error(course.span(), other.to_string(), "change that value"),
        }
    }

    fn slider(&mut self, spec: &SliderSpec) -> Option<Slider> {
        let law = self.law(&spec.law);
        let normal = self.course(&spec.normal, |p| p.0, "normal");
        if let Some(history) = &normal
            && history.least() <= 0.0
        {
            let message = format!("the normal traction falls to {:?} Pa", history.least());
            self.error::<()>(spec.normal.span(), message, "it stays above zero: a slider does not open");
        }
        let stiffness = spec.stiffness.as_ref();
        let stiffness = stiffness.map_or(Some(0.0), |k| {
            self.positive("stiffness", k.get_ref().0, k.span(), "\"1.25 GPa/m\"")
        });
        let damping = spec.damping.as_ref();
        let damping = damping.map_or(Some(0.0), |d| {
            self.positive("damping", d.get_ref().0, d.span(), "\"5 MPa s/m\"")
        });
        let mass = match &spec.mass {
            None => Some(None),
            Some(m) => self.positive("mass", m.get_ref().0, m.span(), "\"3000 kg/m^2\"").map(Some),
        };
        Some(Slider { law: law?, stiffness: stiffness?, damping: damping?, mass: mass?, normal: normal? })
    }

    fn law(&mut self, spec: &Spanned<LawSpec>) -> Option<Arc<dyn Sliding>> {
        let choice: LawChoice = match law::choose(spec) {
            Ok(choice) => choice,
            Err(errors) => {
                self.errors.extend(errors);
                return None;
            }
        };
        match crate::laws::build_sliding(&choice) {
            Ok(Some(law)) => Some(law),
            Ok(None) => self.error(
                spec.span(),
                "a spring-slider needs a law with a slip rate: this one sticks until it slips",
                "kinds `rate` and `rate-and-state` have one",
            ),
            Err(failure) => self.error(spec.span(), failure.to_string(), "change that value"),
        }
    }

    fn spring(
        &mut self,
        spec: &SpringSpec,
        names: &[String],
    ) -> Option<asperity_friction::slider::Spring> {
        let mut ends = [0; 2];
        for (end, name) in ends.iter_mut().zip(&spec.between) {
            let found = names.iter().position(|n| n == name.get_ref());
            let Some(found) = found else {
                let help = near::suggest(name.get_ref(), "sliders", names.iter().map(String::as_str));
                return self.error(name.span(), format!("there is no slider `{}`", name.get_ref()), help);
            };
            *end = found;
        }
        if ends[0] == ends[1] {
            let message = "the spring leads from a slider to itself";
            return self.error(spec.between[1].span(), message, "name two sliders");
        }
        let k = &spec.stiffness;
        let stiffness = self.positive("stiffness", k.get_ref().0, k.span(), "\"0.3 GPa/m\"")?;
        Some(asperity_friction::slider::Spring { between: ends, stiffness })
    }

    fn time(&mut self, time: &SliderTime) -> Option<f64> {
        self.positive("end", time.end.get_ref().0, time.end.span(), "\"1000 s\"")
    }

    fn settings(&mut self, time: &SliderTime, plan: &mut Plan) {
        if let Some(method) = &time.method {
            match Method::from_str(method.get_ref()) {
                Ok(m) => plan.method = m,
                Err(_) => {
                    let help = near::suggest(method.get_ref(), "methods", Method::ALL.map(Method::name));
                    let message = format!("there is no method `{}`", method.get_ref());
                    self.error::<()>(method.span(), message, help);
                }
            }
        }
        if let Some(t) = &time.tolerance {
            let value = *t.get_ref();
            if (SMALLEST_TOLERANCE..=LARGEST_TOLERANCE).contains(&value) {
                plan.tolerance = value;
            } else {
                let message = format!("`tolerance` is {value:?}");
                let help = format!("from {SMALLEST_TOLERANCE:e}, which rounding allows, to {LARGEST_TOLERANCE}");
                self.error::<()>(t.span(), message, help);
            }
        }
        let mut length = |name: &str, value: &Option<Spanned<Time>>| {
            let value = value.as_ref()?;
            self.positive(name, value.get_ref().0, value.span(), "\"1 s\"")
        };
        plan.first_step = length("first_step", &time.first_step);
        plan.largest_step = length("max_step", &time.max_step);
        if let Some(most) = &time.most_steps {
            plan.most_steps = *most.get_ref();
        }
    }

    fn events(&mut self, spec: &EventSpec) -> Option<Thresholds> {
        let on = self.positive("above", spec.above.get_ref().0, spec.above.span(), "\"1 mm/s\"")?;
        let off = match &spec.below {
            // An order of magnitude lower, so that a rate that hovers at the threshold is one event.
            None => 0.1 * on,
            Some(below) => {
                let off = self.positive("below", below.get_ref().0, below.span(), "\"0.1 mm/s\"")?;
                if off >= on {
                    let message = format!("`below` ({off:?} m/s) is not below `above` ({on:?} m/s)");
                    return self.error(below.span(), message, "an event ends at a lower rate than it begins");
                }
                off
            }
        };
        Some(Thresholds { on, off })
    }

    /// Whether a chain of springs leads from each slider to the load point.
    fn held(&mut self, scene: &SliderScene, system: &System, names: &[String]) -> Option<()> {
        let mut held: Vec<bool> = system.sliders().iter().map(|s| s.stiffness > 0.0).collect();
        for _ in names {
            for spring in system.springs() {
                let [a, b] = spring.between;
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

    fn start(&mut self, scene: &SliderScene, system: &System) -> Option<Vec<f64>> {
        let (mut rates, mut states) = (Vec::new(), Vec::new());
        for (spec, slider) in scene.sliders.values().zip(system.sliders()) {
            let spec = spec.get_ref();
            let initial = spec.law.get_ref().v_initial.as_ref().or(spec.law.get_ref().v_ref.as_ref());
            let steady = initial.map_or(1.0, |v| v.get_ref().0);
            let rate = match &spec.start {
                None => steady,
                Some(start) => {
                    self.positive("start", start.get_ref().0, start.span(), "\"1 um/s\"")?
                }
            };
            let mut state = vec![0.0; slider.law.states()];
            slider.law.steady(steady.ln(), &mut state);
            rates.push(rate);
            states.push(state);
        }
        match system.start(&rates, &states) {
            Ok(start) => Some(start),
            Err(failure) => self.error(0..0, failure.to_string(), "change the start"),
        }
    }
}

/// A tolerance per step below this is rounding.
const SMALLEST_TOLERANCE: f64 = 1e-14;
/// A tolerance per step above this is no solution.
const LARGEST_TOLERANCE: f64 = 0.1;
