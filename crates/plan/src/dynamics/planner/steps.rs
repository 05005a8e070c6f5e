//! Number and length of the steps, and the steps between outputs.

use super::super::plan::Cadence;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use asperity_mechanics::Stage;
use asperity_mechanics::dynamics::StableStep;
use asperity_scene::defaults;

/// Default rows, profiles and fields of a run.
const OUTPUTS: [usize; 3] = [defaults::WAVE_ROWS, defaults::WAVE_PROFILES, defaults::WAVE_FIELDS];
/// Relative rounding of times given as decimals.
const ROUNDING: f64 = 1e-9;

/// Steps of a run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StepChoice {
    pub steps: usize,
    pub dt: f64,
    /// Step over the stable one, just so large that the number of steps does not exceed its own.
    pub courant: f64,
    pub cadence: Cadence,
    /// Reason for their length.
    pub why: String,
}

/// Time of viscosity over the step.
pub(super) fn viscosity(scene: &Scene) -> f64 {
    scene.time.viscosity.as_ref().map_or(defaults::VISCOSITY, |v| *v.get_ref())
}

/// Step over the stable one.
pub(super) fn courant(scene: &Scene) -> f64 {
    scene.time.courant.as_ref().map_or(defaults::COURANT, |c| *c.get_ref())
}

/// Chooses the steps of the only stage.
///
/// # Errors
/// [`Diagnostic`] where the scene asks for steps beyond the stable one, or for samples that do not fit the duration.
pub(super) fn choose(scene: &Scene, stage: &Stage, stable: &StableStep) -> Result<StepChoice, Diagnostic> {
    let duration = stage.end - stage.start;
    let longest = courant(scene) * stable.step;
    let samples = samples(scene, duration)?;
    let bound = format!("`courant` = {}", courant(scene));
    let (steps, why) = match scene.stages[0].steps.as_ref() {
        Some(given) => {
            let steps = *given.get_ref();
            within(scene, duration / steps as f64, duration, stable)?;
            if let (Some(samples), Some(sampling)) = (samples, &scene.output.sampling)
                && !steps.is_multiple_of(samples)
            {
                return Err(Diagnostic::at(
                    sampling.span(),
                    format!("{steps} steps are not a whole number between two of {samples} samples"),
                    format!("`steps = {}`, or leave `steps` out", steps.next_multiple_of(samples)),
                )
                .and(given.span(), "the steps"));
            }
            (steps, "`steps` of the stage".to_string())
        }
        None => {
            let samples = samples.unwrap_or(1);
            let between = (duration / samples as f64 / longest * (1.0 - ROUNDING)).ceil().max(1.0);
            let steps = samples * between as usize;
            let why = match scene.output.sampling {
                Some(_) => format!("{bound} at most, and {between} whole steps between samples"),
                None => bound,
            };
            (steps, why)
        }
    };
    let dt = duration / steps as f64;
    Ok(StepChoice {
        why,
        steps,
        dt,
        courant: dt / stable.step * (1.0 + ROUNDING),
        cadence: cadence(scene, steps, samples),
    })
}

/// Number of samples of the run, if the scene gives their interval.
fn samples(scene: &Scene, duration: f64) -> Result<Option<usize>, Diagnostic> {
    let Some(sampling) = &scene.output.sampling else { return Ok(None) };
    let exact = duration / sampling.get_ref().0;
    let samples = exact.round().max(1.0);
    if (exact / samples - 1.0).abs() > ROUNDING {
        let near = duration / samples;
        return Err(Diagnostic::at(
            sampling.span(),
            format!("the run lasts {exact:.4} intervals of `sampling`, which is no whole number"),
            format!("such as `sampling = \"{near} s\"`, or another duration"),
        )
        .and(scene.stages[0].duration.span(), "the duration"));
    }
    Ok(Some(samples as usize))
}

/// Refuses steps beyond the stable one.
fn within(scene: &Scene, dt: f64, duration: f64, stable: &StableStep) -> Result<(), Diagnostic> {
    if dt <= stable.step {
        return Ok(());
    }
    let place = scene.stages[0].steps.as_ref().map(|s| s.span()).unwrap_or_default();
    Err(Diagnostic::at(
        place,
        format!(
            "steps of {dt:.4e} s are longer than the stable step, {:.4e} s, and grow without bound",
            stable.step
        ),
        format!("`steps = {}` or more, or leave `steps` out", (duration / stable.step).ceil()),
    ))
}

fn cadence(scene: &Scene, steps: usize, samples: Option<usize>) -> Cadence {
    let output = &scene.output;
    let given = [
        samples,
        output.profiles.as_ref().map(|p| *p.get_ref()),
        output.fields.as_ref().map(|f| *f.get_ref()),
    ];
    let [rows, profiles, fields] =
        std::array::from_fn(|k| (steps / given[k].unwrap_or(OUTPUTS[k]).max(1)).max(1));
    Cadence { rows, profiles, fields }
}
