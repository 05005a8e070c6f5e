//! Plans a scene of spring-sliders.

mod digits;
mod history;
mod output;
mod parts;
mod settings;
mod start;
mod start_doubts;

use crate::doubts;
use crate::reading::columns::file::columns_of;
use crate::reading::diagnostic::{Diagnostic, Diagnostics};
use crate::reading::scene::model::Spanned;
use crate::reading::scene::reader;
use crate::reading::scene::slider::SliderScene;
use crate::sliders::Plan;
use asperity_cycles::slider::{Problem, Rows};
use asperity_friction::slider::{History, Slider, Spring, System};
use asperity_laws::{self as laws, Theta};
use asperity_scene::defaults;
use digits::unresolved;
use std::ops::Range;
use std::path::Path;

/// Reads, checks and plans a scene of spring-sliders, whose files are relative to the current folder.
///
/// # Errors
/// See [`read_in`].
pub fn read(text: &str) -> Result<Plan, Diagnostics> {
    read_in(text, Path::new("")).map(|(plan, _)| plan)
}

/// Reads, checks and plans a scene of spring-sliders whose files are relative to `folder`. The names of its files come with it.
///
/// # Errors
/// All errors of the scene, or the first one that prevents reading it.
pub fn read_in(text: &str, folder: &Path) -> Result<(Plan, Vec<Spanned<String>>), Diagnostics> {
    let scene = reader::read_sliders_with(text, &mut |file, wanted| columns_of(folder, file, wanted))?;
    let mut planner = Planner { errors: Vec::new(), end: scene.time.end.get_ref().0 };
    let plan = planner.plan(&scene);
    let mut errors = planner.errors;
    errors.sort_by_key(|e| (e.span.is_empty(), e.span.start));
    match plan {
        Some(plan) if errors.is_empty() => Ok((plan, scene.files().cloned().collect())),
        _ => Err(Diagnostics(errors)),
    }
}

/// Parts of a system of sliders; none where they have errors.
struct Parts {
    load: Option<History>,
    sliders: Vec<Option<Slider>>,
    springs: Vec<Option<Spring>>,
}

/// Turns a scene into a plan and collects errors.
struct Planner {
    errors: Vec<Diagnostic>,
    /// End of the run \[s\].
    end: f64,
}

impl Planner {
    pub(super) fn error<T>(
        &mut self,
        span: Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<T> {
        self.errors.push(Diagnostic::at(span, message, help));
        None
    }

    pub(super) fn plan(&mut self, scene: &SliderScene) -> Option<Plan> {
        if *scene.schema.get_ref() != 1 {
            let message = format!("there is no version {} of the scene format", scene.schema.get_ref());
            self.error::<()>(scene.schema.span(), message, "this program reads `schema = 1`");
        }
        if scene.sliders.is_empty() {
            return self.error(0..0, "the scene has no slider", "add a table `[sliders.NAME]`");
        }
        let names: Vec<String> = scene.sliders.keys().cloned().collect();
        let parts = self.parts(scene, &names);
        let settings = self.settings(&scene.time);
        let events = scene.events.as_ref().map(|e| self.events(e));
        let rates: Vec<_> = scene.sliders.values().map(|s| self.imposed(s.get_ref())).collect();
        let output = match (&scene.output, settings.end) {
            (Some(spec), Some(end)) => self.output(spec, &names, end),
            _ => Some(Rows::default()),
        };
        let system = self.join(parts)?;
        let system = self.impose(system, rates.into_iter().collect::<Option<Vec<_>>>()?)?;
        self.held(scene, &system, &names)?;
        let start = self.start(scene, &system)?;
        let mut problem = Problem::new(system, start, settings.end?);
        problem.title.clone_from(&scene.title);
        problem.names = names;
        problem.method = settings.method.unwrap_or(problem.method);
        problem.tolerance = settings.tolerance.unwrap_or(defaults::SLIDER_TOLERANCE);
        problem.most_steps = settings.most_steps.unwrap_or(defaults::SLIDER_STEPS);
        (problem.first_step, problem.largest_step) = (settings.first_step, settings.largest_step);
        problem.output = output?;
        let extremes = scene.output.as_ref().and_then(|o| o.extremes.as_ref());
        problem.peaks = extremes.is_some_and(|e| *e.get_ref());
        if let (Some(thresholds), Some(spec)) = (events, &scene.events) {
            problem.events = Some(thresholds?);
            problem.peaks = spec.peaks.as_ref().is_none_or(|p| *p.get_ref());
            problem.most_events = spec.stop_after.as_ref().map(|n| *n.get_ref());
        }
        let mut plan = Plan::from(problem);
        let theta = |law| laws::choose_sliding(law).ok().and_then(|law| Theta::from_law(&law));
        plan.thetas = scene.sliders.values().map(|spec| theta(&spec.get_ref().law)).collect();
        plan.warnings.clone_from(&scene.warnings);
        if let (Some(limits), Some(spec)) = (plan.problem.events, &scene.events) {
            // Of a load whose rate changes, that at the start.
            let loading = plan.problem.system.segment(0.0).load().at(0.0).0.abs();
            plan.warnings.extend(doubts::thresholds(spec, limits, loading, false));
            let checks = &plan.checks.sliders;
            let stable = checks.len() == plan.problem.names.len() && checks.iter().all(|c| c.critical == 0.0);
            plan.warnings.extend(doubts::idle_wait(spec, !stable));
        }
        let starts = start_doubts::starts(scene, &plan);
        doubts::add(&mut plan.warnings, starts);
        self.runaways(scene, &mut plan);
        unresolved(scene, &mut plan);
        Some(plan)
    }

    /// The parts of a system, as far as they have no errors.
    fn parts(&mut self, scene: &SliderScene, names: &[String]) -> Parts {
        // If slip rates are imposed and no spring leads to a load point, none is needed.
        let specs = || scene.sliders.values().map(|s| s.get_ref());
        let driven = specs().any(|s| s.rate.is_some()) && specs().all(|s| s.stiffness.is_none());
        let load = match &scene.load {
            Some(load) => self.course(&load.rate, |v| v.0, "rate"),
            None if driven => Some(History::Constant(0.0)),
            None => self.error(0..0, "the scene has no load point", "add a table `[load]` with its `rate`"),
        };
        let sliders = scene.sliders.values().map(|s| self.slider(s.get_ref())).collect();
        let springs = scene.springs.iter().map(|s| self.spring(s.get_ref(), names)).collect();
        Parts { load, sliders, springs }
    }

    /// The system of parts that have no errors.
    fn join(&mut self, Parts { load, sliders, springs }: Parts) -> Option<System> {
        let (load, sliders) = (load?, sliders.into_iter().collect::<Option<Vec<_>>>()?);
        match System::new(sliders, springs.into_iter().collect::<Option<Vec<_>>>()?, load) {
            Ok(system) => Some(system),
            Err(failure) => self.error(0..0, failure.to_string(), "change that value"),
        }
    }

    /// A count that must be at least one.
    pub(super) fn count(&mut self, name: &str, value: Option<&Spanned<usize>>) -> Option<usize> {
        let value = value?;
        if *value.get_ref() == 0 {
            let help = "at least 1, or leave the line out";
            return self.error(value.span(), format!("`{name}` must be positive"), help);
        }
        Some(*value.get_ref())
    }

    pub(super) fn positive(
        &mut self,
        name: &str,
        value: f64,
        span: Range<usize>,
        example: &str,
    ) -> Option<f64> {
        if value > 0.0 && value.is_finite() {
            return Some(value);
        }
        let message = format!("`{name}` must be positive, found {value:?}");
        self.error(span, message, format!("such as `{name} = {example}`"))
    }
}
