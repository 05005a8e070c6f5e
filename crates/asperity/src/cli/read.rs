//! Reads a scene file and plans it.

use super::begin::Begin;
use super::inputs::Inputs;
use crate::{checkpoint, kinds};
use asperity_cycles::slider::stability;
use asperity_output::figures::MeshPicture;
use asperity_plan::bodies::{self, AnyPlan};
use asperity_plan::reading::diagnostic::{Diagnostics, TextSettings, report_set};
use asperity_plan::reading::scene;
use asperity_plan::reading::scene::settings::{self, Origin, ResolvedText, Setting};
use asperity_plan::reading::sniff::{self, Reader};
use asperity_plan::shared::checks::Checks;
use asperity_plan::shared::setup::Setups;
use asperity_plan::shared::sha256::sha256;
use asperity_plan::sliders::planner;
use asperity_plan::{ScenePlan, dynamics, faults, sliders};
use asperity_reference::cite::{self, Citations};
use asperity_run::Warning;
use asperity_run::report::Kind;
use asperity_scene::warning::locate;
use miette::{IntoDiagnostic, WrapErr, miette};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

/// Plan of a scene, by kind.
pub(super) enum RunPlan {
    /// Deformable bodies.
    Bodies(Box<AnyPlan>),
    /// Spring-sliders.
    Sliders(Box<sliders::Plan>),
    /// Faults over earthquake cycles.
    Faults(Box<faults::Plan>),
    /// Bodies with mass.
    Dynamic(Box<dynamics::AnyPlan>),
}

impl RunPlan {
    /// Checks of the plan.
    pub fn checks(&self) -> &Checks {
        match self {
            Self::Bodies(plan) => plan.checks(),
            Self::Sliders(plan) => &plan.checks,
            Self::Faults(plan) => &plan.checks,
            Self::Dynamic(plan) => plan.checks(),
        }
    }

    /// Warnings of the plan.
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::Bodies(plan) => &plan.summary().warnings,
            Self::Sliders(plan) => &plan.warnings,
            Self::Faults(plan) => &plan.warnings,
            Self::Dynamic(plan) => plan.warnings(),
        }
    }

    /// Notes of the plan.
    pub fn notes(&self) -> Vec<String> {
        match self {
            Self::Bodies(plan) => plan.summary().remarks.clone(),
            Self::Sliders(plan) => stability::remarks(&plan.problem),
            Self::Faults(plan) => plan.notes.clone(),
            Self::Dynamic(plan) => plan.notes().to_vec(),
        }
    }

    /// Kind of run.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Bodies(_) => Kind::Bodies,
            Self::Sliders(_) => Kind::Sliders,
            Self::Faults(_) => Kind::Faults,
            Self::Dynamic(_) => Kind::Dynamics,
        }
    }

    /// Warnings of the plan, to be changed.
    pub fn warnings_mut(&mut self) -> &mut [Warning] {
        match self {
            Self::Bodies(plan) => plan.warnings_mut(),
            Self::Sliders(plan) => &mut plan.warnings,
            Self::Faults(plan) => &mut plan.warnings,
            Self::Dynamic(plan) => plan.warnings_mut(),
        }
    }
}

/// A plan with the identity of its input.
pub(super) struct Ready {
    pub plan: RunPlan,
    /// SHA-256 of the scene as it is kept.
    pub hash: String,
    /// Hash that a checkpoint must have to be resumed.
    pub physics: String,
    /// SHA-256 of the mesh files, by their names in the scene.
    pub meshes: BTreeMap<String, String>,
    /// Wall time of reading and planning \[s\].
    pub seconds: f64,
}

/// A scene that has been read and checked but not planned. Planning may take long.
pub(super) struct Source {
    text: Text,
    parsed: SceneContent,
    inputs: Inputs,
    clock: Instant,
}

/// Text of a scene.
struct Text {
    /// Name of the file.
    name: String,
    /// Text of the file.
    file: String,
    /// Text with the settings.
    resolved: ResolvedText,
    settings: Vec<Setting>,
}

impl Text {
    /// Errors as they are printed.
    fn report(&self, errors: &Diagnostics) -> miette::Report {
        let shown = TextSettings { resolved: &self.resolved, settings: &self.settings };
        report_set(&self.name, &self.file, shown, errors)
    }

    /// Gives a warning its line and column in the file, or names the setting that it is about.
    fn locate(&self, warning: &mut Warning) {
        match self.resolved.origin(warning.span.start) {
            Origin::Setting(number) if !warning.span.is_empty() => {
                warning.message = format!("--set {}: {}", self.settings[number], warning.message);
            }
            _ => {
                warning.span = self.resolved.range(&warning.span).unwrap_or_default();
                locate(warning, &self.file);
            }
        }
    }
}

/// Content of a scene file.
enum SceneContent {
    /// Spring-sliders; they are planned at once because this costs nothing.
    Sliders(Box<sliders::Plan>),
    /// Bodies, with or without faults.
    Bodies(Box<scene::model::Scene>),
}

impl Source {
    /// Reads and checks a scene file with settings.
    pub fn read(path: &Path, settings: &[Setting]) -> miette::Result<Self> {
        let file = text(path).wrap_err_with(|| format!("cannot read the scene {}", path.display()))?;
        let clock = Instant::now();
        let name = path.display().to_string();
        let resolved = settings::apply(&file, settings).map_err(|why| miette!("{name}: {why}"))?;
        let text = Text { name, file, resolved, settings: settings.to_vec() };
        let told = |errors: &Diagnostics| text.report(errors);
        let (read, folder) = (text.resolved.text(), path.parent().unwrap_or(Path::new("")));
        let (parsed, inputs) = if scene::reader::is_slider(read) {
            let (plan, files) = planner::read_in(read, folder).map_err(|errors| told(&errors))?;
            let named: Vec<_> = files.iter().map(|file| (file.span(), file.get_ref().as_str())).collect();
            (SceneContent::Sliders(Box::new(plan)), Inputs::from_scene(read, folder, &named)?)
        } else {
            let parsed = scene::read_in(read, folder).map_err(|errors| told(&errors))?;
            let named: Vec<_> = parsed.files().map(|file| (file.span(), file.get_ref().as_str())).collect();
            let inputs = Inputs::from_scene(read, folder, &named)?;
            (SceneContent::Bodies(Box::new(parsed)), inputs)
        };
        Ok(Self { text, parsed, inputs, clock })
    }

    /// SHA-256 of the mesh files of a scene without faults through cycles. Only such a run ends at a time that no change of the scene can extend. `None` if the
    /// scene has such faults or a file cannot be read.
    pub fn meshes_of_whole(&self) -> Option<BTreeMap<String, String>> {
        match &self.parsed {
            SceneContent::Sliders(_) => self.inputs.hashes().ok(),
            SceneContent::Bodies(scene) if scene.faults.is_empty() || has_mass(scene) => {
                self.inputs.hashes().ok()
            }
            SceneContent::Bodies(_) => None,
        }
    }

    /// Input of a run of this scene, read from `path`.
    pub fn begin(&self, path: &Path) -> Begin {
        let (kind, title) = match &self.parsed {
            SceneContent::Sliders(plan) => (Kind::Sliders, &plan.problem.title),
            SceneContent::Bodies(scene) if has_mass(scene) => (Kind::Dynamics, &scene.title),
            SceneContent::Bodies(scene) if scene.faults.is_empty() => (Kind::Bodies, &scene.title),
            SceneContent::Bodies(scene) => (Kind::Faults, &scene.title),
        };
        let set = self.text.settings.iter().map(ToString::to_string).collect();
        Begin::now(kind, path, title, self.inputs.clone(), set)
    }

    /// Citations of the scene.
    pub fn citations(&self) -> miette::Result<Citations> {
        let citations = match &self.parsed {
            SceneContent::Sliders(_) => scene::reader::read_sliders(self.text.resolved.text())
                .and_then(|scene| cite::slider_citations(&scene)),
            SceneContent::Bodies(scene) => cite::scene_citations(scene),
        };
        citations.map_err(|errors| self.text.report(&errors))
    }

    /// Picture of the meshes of the scene; `None` for spring-sliders, which have none.
    pub fn picture(&self) -> miette::Result<Option<MeshPicture>> {
        let SceneContent::Bodies(scene) = &self.parsed else { return Ok(None) };
        let picture = bodies::picture(scene);
        picture.map(Some).map_err(|error| self.text.report(&Diagnostics::from(error)))
    }

    /// Plans the scene, with set-ups that are kept.
    pub fn plan(self, setups: &Setups) -> miette::Result<Ready> {
        let Self { text, parsed, inputs, clock } = self;
        let mut plan = match parsed {
            SceneContent::Sliders(plan) => RunPlan::Sliders(plan),
            SceneContent::Bodies(scene) => {
                // A mesh file that cannot be read is reported by the plan, which knows the position in the scene.
                match asperity_plan::plan_beside(&scene, setups) {
                    Ok(ScenePlan::Bodies(plan)) => RunPlan::Bodies(plan),
                    Ok(ScenePlan::Faults(plan)) => RunPlan::Faults(plan),
                    Ok(ScenePlan::Dynamic(plan)) => RunPlan::Dynamic(plan),
                    Err(error) => {
                        return Err(text.report(&Diagnostics::from(error)));
                    }
                }
            }
        };
        for warning in plan.warnings_mut() {
            text.locate(warning);
        }
        let (text, meshes) = (&inputs.text, inputs.hashes()?);
        let hashes = meshes.values().map(String::as_str);
        let physics = match &plan {
            RunPlan::Faults(_) => kinds::faults::physics(text, hashes),
            RunPlan::Bodies(_) | RunPlan::Sliders(_) | RunPlan::Dynamic(_) => {
                checkpoint::scene::hash(text, |_| (), hashes)
            }
        };
        let hash = sha256([text]);
        Ok(Ready { plan, hash, physics, meshes, seconds: clock.elapsed().as_secs_f64() })
    }
}

/// True if the bodies of a scene have mass.
fn has_mass(scene: &scene::model::Scene) -> bool {
    *scene.time.stepper.get_ref() == scene::model::Stepper::Explicit
}

/// Text of a scene file.
fn text(path: &Path) -> miette::Result<String> {
    let bytes = std::fs::read(path).into_diagnostic()?;
    let other = sniff::other(&bytes, Reader::Scene).filter(|_| !bytes.trim_ascii().is_empty());
    if let Some(wrong) = other {
        return Err(miette!(help = wrong.help, "{}", wrong.message));
    }
    String::from_utf8(sniff::unmarked(bytes)).into_diagnostic()
}
