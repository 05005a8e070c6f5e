//! Reading of scenes: of bodies and faults, and of spring-sliders (`kinematics = "spring-slider"`).

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::files::{self, Columns};
use crate::keys::{self, Run, Tree};
use crate::kind::Kind;
use crate::law::Laws;
use crate::model::{Kinematics, Scene, Spanned, Stepper};
use crate::slider::SliderScene;
use crate::{azimuth, check, control_characters, explain, pairs, plausibility, suggestions};
use asperity_run::Warning;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::BTreeMap;
use std::path::Path;
use toml_edit::Document;

/// Reads and checks a scene with the friction laws known to the program. Files are named relative to `folder`, and `columns` reads those whose
/// numbers belong to the scene.
///
/// # Errors
/// All errors of the checks, or the first error of the text or of a file.
pub fn read(text: &str, folder: &Path, laws: &Laws, columns: &mut Columns<'_>) -> Result<Scene, Diagnostics> {
    if let Some(error) = control_characters::find(text) {
        return Err(Diagnostics(vec![error]));
    }
    let mut scene: Scene = toml::from_str(text).map_err(|e| reject(&e, text))?;
    scene.folder = folder.to_path_buf();
    let unclear = pairs::expand(&mut scene);
    if !unclear.is_empty() {
        return Err(Diagnostics(unclear));
    }
    let doubts = files::fill(&mut scene, columns).map_err(|error| Diagnostics(vec![error]))?;
    azimuth::rakes(&mut scene);
    let (mut errors, mut warnings) = check::check(&scene, laws);
    let run = Run {
        kind: scene.kind(),
        stated: scene.time.stepper.span(),
        kinematics: Some(*scene.kinematics.get_ref()),
    };
    judge(text, plausibility::SceneFacts::from_scene(&scene), run, &mut errors, &mut warnings);
    warnings.extend(doubts);
    scene.warnings = warnings;
    if errors.is_empty() { Ok(scene) } else { Err(Diagnostics(errors)) }
}

/// Keys of a scene of bodies that decide on its other keys.
#[derive(Deserialize)]
struct DecidingKeys {
    kinematics: Spanned<Kinematics>,
    time: DecidingTime,
    medium: Option<IgnoredAny>,
    #[serde(default)]
    faults: BTreeMap<String, IgnoredAny>,
}

/// The stepper in the table of time integration.
#[derive(Deserialize)]
struct DecidingTime {
    stepper: Spanned<Stepper>,
}

/// Explains an error of the reader in a scene of bodies. Where it lies within a key that the run does not have, the refusal of the
/// key comes instead: nobody should complete what is to be removed.
fn reject(error: &toml::de::Error, text: &str) -> Diagnostics {
    let error = explain::explain(error, text);
    let mut errors = vec![error.clone()];
    if let (Ok(keys), Ok(document)) = (toml::from_str::<DecidingKeys>(text), Document::parse(text)) {
        let stepper = &keys.time.stepper;
        let run = Run {
            kind: stepper.get_ref().kind(keys.medium.is_some(), !keys.faults.is_empty()),
            stated: stepper.span(),
            kinematics: Some(*keys.kinematics.get_ref()),
        };
        keys::refuse(&Tree::new(), &document, run, &mut errors);
    }
    if errors.contains(&error) { Diagnostics(vec![error]) } else { Diagnostics(errors) }
}

/// Known kinematics.
const KINEMATICS: [&str; 6] =
    ["plane-strain", "plane-stress", "axisymmetric", "antiplane", "3d", "spring-slider"];

/// Keys of a scene that determine its kind.
#[derive(Deserialize)]
struct Head {
    kinematics: Option<Spanned<toml::Value>>,
    sliders: Option<IgnoredAny>,
}

impl Head {
    /// True if the scene is one of bodies.
    fn bodies(&self) -> bool {
        let known = |k: &Spanned<toml::Value>| {
            k.get_ref().as_str().is_none_or(|k| k != "spring-slider" && KINEMATICS.contains(&k))
        };
        self.sliders.is_none() && self.kinematics.as_ref().is_none_or(known)
    }

    /// Error in the kinematics of a scene of sliders, if any.
    fn error(&self) -> Option<Diagnostic> {
        let help = "sliders belong to `kinematics = \"spring-slider\"`";
        let Some(kinematics) = &self.kinematics else {
            return Some(Diagnostic::at(0..1, "the key `kinematics` is missing", help));
        };
        let place = kinematics.span();
        let Some(name) = kinematics.get_ref().as_str() else {
            return Some(Diagnostic::at(place, "the kinematics is a text in quotes", help));
        };
        if name == "spring-slider" {
            return None;
        }
        Some(if KINEMATICS.contains(&name) {
            let message = format!("the scene has sliders, but its kinematics is \"{name}\"");
            Diagnostic::at(place, message, help)
        } else {
            let help = suggestions::suggest(name, "kinematics", KINEMATICS);
            Diagnostic::at(place, format!("there is no kinematics `{name}`"), help)
        })
    }
}

/// True if a scene file is to be read by [`read_sliders_with`]: it has sliders, or its kinematics is "spring-slider" or unknown.
#[must_use]
pub fn is_slider(text: &str) -> bool {
    toml::from_str::<Head>(text).is_ok_and(|head| !head.bodies())
}

/// Reads a scene of spring-sliders. `columns` reads the files of its courses.
///
/// # Errors
/// The first error of the reader, or of a file.
pub fn read_sliders_with(text: &str, columns: &mut Columns<'_>) -> Result<SliderScene, Diagnostics> {
    let mut scene = read_sliders(text)?;
    let doubts = files::fill_tables(scene.tables_mut(), columns);
    scene.warnings.extend(doubts.map_err(|error| Diagnostics(vec![error]))?);
    Ok(scene)
}

/// Reads a scene of spring-sliders apart from the files of its courses.
///
/// # Errors
/// The first error of the reader.
pub fn read_sliders(text: &str) -> Result<SliderScene, Diagnostics> {
    if let Some(error) = toml::from_str::<Head>(text).ok().and_then(|head| head.error()) {
        return Err(Diagnostics(vec![error]));
    }
    if let Some(error) = control_characters::find(text) {
        return Err(Diagnostics(vec![error]));
    }
    let mut scene: SliderScene =
        toml::from_str(text).map_err(|e| Diagnostics(vec![explain::explain(&e, text)]))?;
    let mut errors = Vec::new();
    let run = Run { kind: Kind::Sliders, stated: scene.kinematics.span(), kinematics: None };
    judge(text, plausibility::SceneFacts::SLIDERS, run, &mut errors, &mut scene.warnings);
    if errors.is_empty() { Ok(scene) } else { Err(Diagnostics(errors)) }
}

/// Adds what a walk through the text finds: keys that do not belong to the run, and implausible values.
fn judge(
    text: &str,
    facts: plausibility::SceneFacts,
    run: Run,
    errors: &mut Vec<Diagnostic>,
    warnings: &mut Vec<Warning>,
) {
    let Ok(document) = Document::parse(text) else { return };
    let tree = Tree::new();
    keys::refuse(&tree, &document, run, errors);
    plausibility::judge(&tree, &document, facts, errors, warnings);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Messages about a scene with a fault that the reader does not accept.
    fn rejected(kinematics: &str, fault: &str) -> Vec<String> {
        let text = format!(
            "schema = 1\ntitle = \"t\"\nkinematics = \"{kinematics}\"\n[time]\nstepper = \"fault-ode\"\n[faults.main]\n{fault}\n"
        );
        let Diagnostics(all) = reject(&toml::from_str::<Scene>(&text).unwrap_err(), &text);
        all.into_iter().map(|error| error.message).collect()
    }

    #[test]
    fn a_key_that_the_run_does_not_have_is_refused_before_its_table_is_found_incomplete() {
        let forms =
            ["injection = { flux = 1 }", "injection = [{ flux = 1 }]", "[faults.main.injection]\nflux = 1"];
        for wells in forms {
            assert_eq!(rejected("3d", wells), ["`injection` has no meaning in three dimensions"], "{wells}");
            assert_eq!(rejected("antiplane", wells), ["the key `at` is missing"], "{wells}");
        }
    }

    #[test]
    fn an_error_beside_a_key_that_the_run_does_not_have_comes_first() {
        let whole =
            "injection = { at = 0, flux = 1e-6, diffusivity = 0.1, porosity = 0.1, compressibility = 1e-8 }";
        assert_eq!(rejected("3d", &format!("norma = 1e6\n{whole}")), ["there is no key `norma` here"]);
    }
}
