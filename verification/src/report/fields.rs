//! Field pictures: Mises stress at the end of a stage of a scene of the case, drawn by the product's plots.

use super::figures;
use super::page::escape;
use crate::ledger::Picture;
use asperity_driver::{plan, run, scene};
use asperity_output::{Recorder, plots};
use std::path::Path;

/// Case, scene in the repository, and stage.
const FIELDS: [(&str, &str, &str); 22] = [
    ("antiplane", "verification/cases/antiplane/crack.toml", ""),
    ("block_dragged", "verification/cases/block_dragged/scene.toml", "press"),
    ("contact_enforcement", "verification/cases/contact_enforcement/scene.toml", "shear"),
    ("contact_hard", "verification/cases/contact_hard/scene.toml", "shear"),
    ("contact_patch_mortar", "verification/cases/contact_patch_mortar/scene.toml", "press"),
    ("contact_rotation", "verification/cases/contact_rotation/scene.toml", "turn"),
    ("coulomb_strip", "verification/cases/coulomb_strip/scene.toml", "first"),
    ("flat_punch", "verification/cases/flat_punch/scene.toml", "press"),
    ("frictional_bar", "verification/cases/frictional_bar/scene.toml", "push"),
    ("frictional_crack", "verification/cases/frictional_crack/scene.toml", "slip"),
    ("hertz_line", "scenes/hertz.toml", "press"),
    ("hertz_sphere", "verification/cases/hertz_sphere/scene.toml", "press"),
    ("hertz_ball", "verification/cases/hertz_ball/scene.toml", "press"),
    ("interface_instability", "verification/cases/interface_instability/scene.toml", "press"),
    ("nafems_roller", "verification/cases/nafems_roller/scene.toml", "press"),
    ("partial_slip", "scenes/hertz.toml", "shear"),
    ("sandwich_pressed", "scenes/sandwich.toml", "press"),
    ("sandwich_sheared", "scenes/sandwich.toml", "shear"),
    ("sandwich_steppers", "scenes/sandwich.toml", "shear"),
    ("sandwich_state", "scenes/sandwich-state.toml", "slide"),
    ("two_rings", "verification/cases/two_rings/scene.toml", "press"),
    ("wavy_sliding", "verification/cases/wavy_sliding/scene.toml", "slide"),
];

/// Pictures of a case, or the reason why one cannot be drawn.
pub fn of(case: &str) -> String {
    let fields = FIELDS.iter().filter(|(name, ..)| *name == case);
    fields.map(|(_, scene, stage)| one(scene, stage)).collect()
}

fn one(scene: &str, stage: &str) -> String {
    match draw(scene, stage) {
        Ok(picture) => figures::picture(&picture),
        Err(why) => format!("<p class=\"small\">No field of {}: {}</p>\n", escape(scene), escape(&why)),
    }
}

fn draw(path: &str, stage: &str) -> Result<Picture, String> {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = package.parent().unwrap_or(package);
    let text = std::fs::read_to_string(root.join(path)).map_err(|error| error.to_string())?;
    let scene = scene::read(&text).map_err(|error| error.to_string())?;
    let plan = plan::plan(&scene).map_err(|error| error.to_string())?;
    let mut record = Recorder::new().with_bodies();
    run::run(&plan, &mut record).map_err(|error| error.to_string())?;
    let named = record.stage_ends().iter().find(|end| stage.is_empty() || end.name == stage);
    let stage = named.map(|end| end.name.clone()).ok_or("the stage was not reached")?;
    let svg = plots::field(&record, &stage).ok_or("it has no bodies")?;
    let title = format!("Mises stress at the end of stage “{stage}”");
    Ok(Picture { title, svg, caption: format!("Scene {path}.") })
}

#[cfg(test)]
mod unit {
    use super::{FIELDS, draw};

    #[test]
    fn fields_of_small_scenes_are_drawn() {
        for name in ["contact_enforcement", "frictional_bar", "antiplane"] {
            let (_, scene, stage) = FIELDS.iter().find(|(case, ..)| *case == name).unwrap();
            assert!(draw(scene, stage).is_ok_and(|picture| picture.svg.contains("<image")), "{name}");
        }
    }

    #[test]
    fn fields_are_of_cases() {
        for (name, ..) in FIELDS {
            assert!(crate::cases::ALL.iter().any(|case| case.name == name), "{name}");
        }
    }
}
