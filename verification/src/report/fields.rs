//! Pictures of scenes of the cases, drawn by the product's plots: Mises stress at the end of a stage, slip rates of faults and
//! spring-sliders.

use super::figures;
use super::page::escape;
use crate::cases::programs::{self, Folder};
use crate::ledger::Picture;
use asperity_driver::{plan, run, scene};
use asperity_output::{Recorder, plots};
use std::path::Path;

/// Case, scene in the repository, and stage.
const FIELDS: [(&str, &str, &str); 31] = [
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
    ("static_explicit_jumps", "verification/cases/static_explicit_jumps/blocks.toml", "shear"),
    ("two_rings", "verification/cases/two_rings/scene.toml", "press"),
];

/// Case, scene in the repository, plot of its run, and title, for faults and spring-sliders.
const PLOTS: [(&str, &str, &str, &str); 10] = [
    ("event_files", "verification/cases/event_files/scene.toml", "largest_rate", "Largest slip rate"),
    ("event_numbers", "verification/cases/event_numbers/rupture.toml", "main_rate", MAP),
    ("fault_balance", "verification/cases/fault_balance/scene.toml", "main_rate", MAP),
    ("fault_bend", "scenes/fault-bend.toml", "main_rate", MAP),
    ("fault_opening", "verification/cases/fault_opening/thrust.toml", "main_rate", MAP),
    ("fault_turning", "verification/cases/fault_turning/scene.toml", "largest_rate", "Largest slip rate"),
    ("sandwich_state", "scenes/sandwich-state.toml", "largest_rate", "Largest slip rate"),
    ("seas_bp6", "scenes/bp6-a.toml", "main_slip", "Slip through time"),
    (
        "slider_cycles",
        "scenes/spring-slider.toml",
        "sliders_relative_velocity",
        "Slip rate of the tutorial's slider",
    ),
    (
        "slider_outputs",
        "scenes/spring-slider.toml",
        "sliders_friction_slip",
        "Friction of the tutorial's slider",
    ),
];
const MAP: &str = "Slip rate through time";

/// Pictures of a case, or the reason why one cannot be drawn.
pub fn of(case: &str) -> String {
    let fields = FIELDS.iter().filter(|(name, ..)| *name == case);
    let fields = fields.map(|(_, scene, stage)| one(scene, draw(scene, stage)));
    let plots = PLOTS.iter().filter(|(name, ..)| *name == case);
    fields.chain(plots.map(|(_, scene, plot, title)| one(scene, plotted(scene, plot, title)))).collect()
}

fn one(scene: &str, picture: Result<Picture, String>) -> String {
    match picture {
        Ok(picture) => figures::picture(&picture),
        Err(why) => format!("<p class=\"small\">No field of {}: {}</p>\n", escape(scene), escape(&why)),
    }
}

/// Plot that a run of the program writes.
fn plotted(path: &str, plot: &str, title: &str) -> Result<Picture, String> {
    let file = root().join(path);
    let folder = Folder::new(&format!("plot-{plot}")).map_err(|error| error.to_string())?;
    let mut command = programs::asperity(&[]).map_err(|error| error.to_string())?;
    command.arg("run").arg(file).arg("--out").arg(folder.path().join("out"));
    programs::finished(&mut command, &[0]).map_err(|error| error.to_string())?;
    let file = folder.path().join("out/plots").join(plot).with_extension("svg");
    let svg = std::fs::read_to_string(file).map_err(|error| error.to_string())?;
    Ok(Picture { title: title.to_owned(), svg, caption: format!("Scene {path}.") })
}

/// Folder of the workspace.
fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package)
}

fn draw(path: &str, stage: &str) -> Result<Picture, String> {
    let file = root().join(path);
    let text = std::fs::read_to_string(&file).map_err(|error| error.to_string())?;
    let folder = file.parent().unwrap_or(root());
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
    use super::{FIELDS, PLOTS, draw};

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
        let names = FIELDS.iter().map(|(name, ..)| name).chain(PLOTS.iter().map(|(name, ..)| name));
        for name in names {
            assert!(crate::cases::ALL.iter().any(|case| case.name == *name), "{name}");
        }
    }
}
