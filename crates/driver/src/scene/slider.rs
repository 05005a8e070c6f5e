//! Scenes of spring-sliders: `kinematics = "spring-slider"`.

mod course;

pub use course::{Course, Entry};

use super::law::{self, LawChoice};
use super::model::{LawSpec, Spanned};
use super::units::{Damping, Mass, Pressure, Spring, Time, Velocity};
use super::{SceneError, SceneErrors, explain, near};
use crate::ode::Method;
use crate::slider::{Plan, Thresholds};
use asperity_friction::Failure;
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
    #[serde(default)]
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

/// The kinematics there are.
const KINEMATICS: [&str; 3] = ["plane-strain", "3d", "spring-slider"];

/// So much of a scene as tells of what kind it is.
#[derive(Deserialize)]
struct Head {
    kinematics: Option<Spanned<String>>,
    sliders: Option<serde::de::IgnoredAny>,
}

impl Head {
    fn kinematics(&self) -> Option<&str> {
        self.kinematics.as_ref().map(|k| k.get_ref().as_str())
    }

    /// What is wrong with the kinematics of a scene of sliders.
    fn error(&self) -> Option<SceneError> {
        let kinematics = self.kinematics.as_ref()?;
        let (name, place) = (kinematics.get_ref().as_str(), kinematics.span());
        if name == "spring-slider" {
            return None;
        }
        Some(if KINEMATICS.contains(&name) {
            let message = format!("the scene has sliders, but its kinematics is \"{name}\"");
            SceneError::at(place, message, "sliders belong to `kinematics = \"spring-slider\"`")
        } else {
            let help = near::suggest(name, "kinematics", KINEMATICS);
            SceneError::at(place, format!("there is no kinematics `{name}`"), help)
        })
    }
}

/// Whether a scene file is read by [`read`]: its kinematics are spring-sliders or none that there are, or it has sliders.
#[must_use]
pub fn is_slider(text: &str) -> bool {
    toml::from_str::<Head>(text).is_ok_and(|head| {
        let bodies = head.kinematics().is_none_or(|k| k != "spring-slider" && KINEMATICS.contains(&k));
        !bodies || head.sliders.is_some()
    })
}

/// Reads, checks and plans a scene of spring-sliders.
///
/// # Errors
/// All that is wrong with it, or the first thing that keeps it from being read.
pub fn read(text: &str) -> Result<Plan, SceneErrors> {
    if let Some(error) = toml::from_str::<Head>(text).ok().and_then(|head| head.error()) {
        return Err(SceneErrors(vec![error]));
    }
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
            let message = format!("there is no version {} of the scene format", scene.schema.get_ref());
            self.error::<()>(scene.schema.span(), message, "this program reads `schema = 1`");
        }
        if scene.sliders.is_empty() {
            return self.error(0..0, "the scene has no slider", "add a table `[sliders.NAME]`");
        }
        let load = self.course(&scene.load.rate, |v| v.0, "rate");
        let names: Vec<String> = scene.sliders.keys().cloned().collect();
        let sliders: Vec<Option<Slider>> = scene.sliders.values().map(|s| self.slider(s.get_ref())).collect();
        let springs: Vec<_> = scene.springs.iter().map(|s| self.spring(s.get_ref(), &names)).collect();
        let settings = self.settings(&scene.time);
        let events = scene.events.as_ref().map(|e| self.events(e));
        let (load, sliders) = (load?, sliders.into_iter().collect::<Option<Vec<_>>>()?);
        let springs = springs.into_iter().collect::<Option<Vec<_>>>()?;
        let system = match System::new(sliders, springs, load) {
            Ok(system) => system,
            Err(failure) => return self.error(0..0, failure.to_string(), "change that value"),
        };
        self.held(scene, &system, &names)?;
        let start = self.start(scene, &system)?;
        let mut plan = Plan::new(system, start, settings.end?);
        plan.title.clone_from(&scene.title);
        plan.names = names;
        plan.method = settings.method.unwrap_or(plan.method);
        plan.tolerance = settings.tolerance.unwrap_or(plan.tolerance);
        plan.most_steps = settings.most_steps.unwrap_or(plan.most_steps);
        (plan.first_step, plan.largest_step) = (settings.first_step, settings.largest_step);
        if let (Some(thresholds), Some(spec)) = (events, &scene.events) {
            plan.events = Some(thresholds?);
            plan.peaks = spec.peaks.unwrap_or(true);
            plan.most_events = spec.stop_after.as_ref().map(|n| *n.get_ref());
        }
        Some(plan)
    }

    /// A count of at least one.
    fn count(&mut self, name: &str, value: Option<&Spanned<usize>>) -> Option<usize> {
        let value = value?;
        if *value.get_ref() == 0 {
            let help = "at least 1, or leave the line out";
            return self.error(value.span(), format!("`{name}` must be positive"), help);
        }
        Some(*value.get_ref())
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
            Course::Table(table) => {
                self.order(table, course.span(), name)?;
                let entries = table.iter().map(Spanned::get_ref);
                History::table(entries.map(|e| (e.time.0, si(&e.value))).collect())
            }
            Course::Sine { mean, amplitude, period, start } => {
                let length = self.positive("period", period.get_ref().0, period.span(), "\"20 s\"")?;
                History::sine(si(mean), si(amplitude), length, start.map_or(0.0, |s| s.0))
            }
        };
        match history {
            Ok(history) => Some(history),
            Err(failure) => self.error(course.span(), failure.to_string(), "change that value"),
        }
    }

    /// Whether the times of a table make a course.
    fn order<Q>(&mut self, table: &[Spanned<Entry<Q>>], place: Range<usize>, name: &str) -> Option<()> {
        if table.is_empty() {
            return self.error(place, format!("the table of `{name}` has no entry"), "[[time, value], ..]");
        }
        let time = |entry: &Spanned<Entry<Q>>| entry.get_ref().time.0;
        for (k, entry) in table.iter().enumerate().skip(1) {
            let (before, now) = (&table[k - 1], time(entry));
            if now < time(before) {
                let message =
                    format!("the times of `{name}` do not increase: {now:?} s after {:?} s", time(before));
                let error = SceneError::at(entry.span(), message, "write the entries in the order of time");
                self.errors.push(error.and(before.span(), "the entry before"));
                return None;
            }
            if k > 1 && now == time(&table[k - 2]) {
                let message = format!("`{name}` has three entries at {now:?} s");
                return self.error(
                    entry.span(),
                    message,
                    "a step has two: the value before and the one after",
                );
            }
        }
        Some(())
    }

    /// Whether a normal traction holds the slider at all times.
    fn presses(&mut self, spec: &Spanned<Course<Pressure>>, normal: &History) {
        let least = normal.least();
        if least > 0.0 {
            return;
        }
        let place = match spec.get_ref() {
            Course::Table(table) => table.iter().find(|e| e.get_ref().value.0 == least).map(Spanned::span),
            Course::Constant(_) | Course::Sine { .. } => None,
        };
        let (message, help) = match spec.get_ref() {
            Course::Constant(_) => {
                (format!("`normal` must be positive, found {least:?}"), ", such as \"5 MPa\"")
            }
            _ => (format!("the normal traction falls to {least:?} Pa"), ": a slider does not open"),
        };
        let help = format!("it stays above zero{help}");
        self.error::<()>(place.unwrap_or_else(|| spec.span()), message, help);
    }

    fn slider(&mut self, spec: &SliderSpec) -> Option<Slider> {
        let law = self.law(&spec.law);
        let normal = self.course(&spec.normal, |p| p.0, "normal");
        if let Some(history) = &normal {
            self.presses(&spec.normal, history);
        }
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

    fn law(&mut self, spec: &Spanned<LawSpec>) -> Option<Arc<dyn Sliding>> {
        let choice: LawChoice = match law::choose(spec) {
            Ok(choice) => choice,
            Err(errors) => {
                self.errors.extend(errors);
                return None;
            }
        };
        if let Some(limit) = &spec.get_ref().f_limit {
            let message = "a spring-slider has no limit of the shear traction";
            self.error::<()>(limit.span(), message, "remove `f_limit`");
        }
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

    fn spring(&mut self, spec: &SpringSpec, names: &[String]) -> Option<asperity_friction::slider::Spring> {
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

    fn settings(&mut self, time: &SliderTime) -> Settings {
        let mut length = |name: &str, value: Option<&Spanned<Time>>, example: &str| {
            value.and_then(|v| self.positive(name, v.get_ref().0, v.span(), example))
        };
        let end = length("end", Some(&time.end), "\"1000 s\"");
        let first_step = length("first_step", time.first_step.as_ref(), "\"1 ms\"");
        let largest_step = length("max_step", time.max_step.as_ref(), "\"1 s\"");
        if let (Some(first), Some(largest)) = (&time.first_step, &time.max_step)
            && first.get_ref().0 > largest.get_ref().0
        {
            let message = "`first_step` is larger than `max_step`";
            let error = SceneError::at(first.span(), message, "first_step <= max_step");
            self.errors.push(error.and(largest.span(), "max_step"));
        }
        Settings {
            end,
            method: time.method.as_ref().and_then(|m| self.method(m)),
            tolerance: time.tolerance.as_ref().and_then(|t| self.tolerance(t)),
            first_step,
            largest_step,
            most_steps: self.count("most_steps", time.most_steps.as_ref()),
        }
    }

    fn method(&mut self, method: &Spanned<String>) -> Option<Method> {
        let name = method.get_ref();
        let found = Method::from_str(name).ok();
        if found.is_none() {
            let help = near::suggest(name, "methods", Method::ALL.map(Method::name));
            self.error::<()>(method.span(), format!("there is no method `{name}`"), help);
        }
        found
    }

    fn tolerance(&mut self, tolerance: &Spanned<f64>) -> Option<f64> {
        let value = *tolerance.get_ref();
        if (SMALLEST_TOLERANCE..=LARGEST_TOLERANCE).contains(&value) {
            return Some(value);
        }
        let help = format!("from {SMALLEST_TOLERANCE:e}, which rounding allows, to {LARGEST_TOLERANCE}");
        self.error(tolerance.span(), format!("`tolerance` is {value:?}"), help)
    }

    fn events(&mut self, spec: &EventSpec) -> Option<Thresholds> {
        self.count("stop_after", spec.stop_after.as_ref());
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
            let law = spec.law.get_ref();
            let initial = law.v_initial.as_ref().or(law.v_ref.as_ref());
            let steady = initial.map_or(1.0, |v| v.get_ref().0);
            let rate = match &spec.start {
                None => steady,
                Some(start) => self.positive("start", start.get_ref().0, start.span(), "\"1 um/s\"")?,
            };
            let pressed = law.normal_initial.as_ref().map(|p| p.get_ref().0);
            match initial_states(slider, steady, pressed) {
                Ok(found) => states.push(found),
                Err(failure) => {
                    return self.error(spec.law.span(), failure.to_string(), "change that value");
                }
            }
            rates.push(rate);
        }
        match system.start(&rates, &states) {
            Ok(start) => Some(start),
            Err(failure) => self.error(0..0, failure.to_string(), "change the start"),
        }
    }
}

/// The state variables of a slider that was in steady state at a slip rate \[m/s\], and under this normal traction \[Pa\]
/// where the state remembers normal traction.
fn initial_states(slider: &Slider, steady: f64, pressed: Option<f64>) -> Result<Vec<f64>, Failure> {
    let n = slider.law.states();
    let mut y = vec![0.0; n + 2];
    slider.law.steady(steady.ln(), &mut y[1..=n]);
    let now = slider.normal.piece(0.0).at(0.0).0;
    if let Some(before) = pressed.filter(|&p| p != now) {
        // As if the slider went on at its rate while the normal traction changed to that of time 0.
        y[0] = slider.law.at_rate(steady, &y[1..=n])?;
        slider.law.jump(&mut y, before, now, 0.0, true)?;
    }
    Ok(y[1..=n].to_vec())
}

/// `[time]`, where it was right.
struct Settings {
    end: Option<f64>,
    method: Option<Method>,
    tolerance: Option<f64>,
    first_step: Option<f64>,
    largest_step: Option<f64>,
    most_steps: Option<usize>,
}

/// A tolerance per step below this is rounding.
const SMALLEST_TOLERANCE: f64 = 1e-14;
/// A tolerance per step above this is no solution.
const LARGEST_TOLERANCE: f64 = 0.1;
