//! Field pictures: Mises stress at the end of a stage of a scene of the case, drawn by the product's plots.

use super::figures;
use super::page::escape;
use crate::ledger::Picture;
use asperity_driver::{plan, run, scene};
use asperity_output::{Recorder, plots};
use std::path::Path;

/// Case, scene in the repository, and stage.
const FIELDS: [(&str, &str, &str); 33] = [
    ("antiplane", "verification/cases/antiplane/crack.toml", ""),
    ("antiplane", "verification/cases/antiplane/prism.toml", ""),
    ("block_dragged", "verification/cases/block_dragged/scene.toml", "press"),
    ("contact_combinations", "verification/cases/contact_combinations/scene.toml", "draw"),
    ("contact_enforcement", "verification/cases/contact_enforcement/scene.toml", "shear"),
    ("contact_facets", "verification/cases/contact_facets/scene.toml", "drag"),
    ("contact_hard", "verification/cases/contact_hard/scene.toml", "shear"),
    ("contact_patch_mortar", "verification/cases/contact_patch_mortar/scene.toml", "press"),
    ("contact_rotation", "verification/cases/contact_rotation/scene.toml", "turn"),
    ("contact_sliding", "verification/cases/contact_sliding/wedge.toml", "push"),
    ("contact_sliding", "verification/cases/contact_sliding/ironing.toml", "draw"),
    ("cook_membrane", "scenes/cook.toml", "shear"),
    ("coulomb_strip", "verification/cases/coulomb_strip/scene.toml", "first"),
    ("elastic_plastic_cylinder", "scenes/cylinder.toml", "inflate"),
    ("flat_punch", "verification/cases/flat_punch/scene.toml", "press"),
    ("frictional_bar", "verification/cases/frictional_bar/scene.toml", "push"),
    ("frictional_crack", "verification/cases/frictional_crack/scene.toml", "slip"),
    ("hertz_line", "scenes/hertz.toml", "press"),
    ("hertz_sphere", "verification/cases/hertz_sphere/scene.toml", "press"),
    ("hertz_ball", "verification/cases/hertz_ball/scene.toml", "press"),
    ("interface_instability", "verification/cases/interface_instability/scene.toml", "press"),
    ("interface_prestress", "verification/cases/interface_prestress/wedge.toml", "rest"),
    ("nafems_roller", "verification/cases/nafems_roller/scene.toml", "press"),
    ("newton_convergence", "scenes/ironing.toml", "draw"),
    ("partial_slip", "scenes/hertz.toml", "shear"),
    ("restarts", "verification/cases/restarts/die.toml", "draw"),
    ("sandwich_pressed", "scenes/sandwich.toml", "press"),
    ("sandwich_sheared", "scenes/sandwich.toml", "shear"),
    ("sandwich_steppers", "scenes/sandwich.toml", "shear"),
    ("sandwich_state", "scenes/sandwich-state.toml", "slide"),
    ("static_explicit_jumps", "verification/cases/static_explicit_jumps/blocks.toml", "shear"),
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
    let file = root.join(path);
    let text = std::fs::read_to_string(&file).map_err(|error| error.to_string())?;
    let folder = file.parent().unwrap_or(root);
    let scene = scene::read_in(&text, folder).map_err(|error| error.to_string())?;
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
        for name in ["contact_enforcement", "frictional_bar", "antiplane", "contact_sliding", "restarts"] {
            for (_, scene, stage) in FIELDS.iter().filter(|(case, ..)| *case == name) {
                let drawn = draw(scene, stage);
                assert!(
                    drawn.as_ref().is_ok_and(|picture| picture.svg.contains("<image")),
                    "{scene}: {drawn:?}"
                );
            }
        }
    }

    #[test]
    fn fields_are_of_cases() {
        for (name, ..) in FIELDS {
            assert!(crate::cases::ALL.iter().any(|case| case.name == name), "{name}");
        }
    }
}
