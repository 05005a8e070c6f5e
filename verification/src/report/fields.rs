//! Pictures of scenes of the cases, drawn by the product's plots: Mises stress at the end of a stage, slip rates of faults and
//! spring-sliders.

use super::figures;
use super::page::escape;
use crate::cases::body_plots;
use crate::ledger::Picture;
use asperity_plan::reading::scene;
use std::path::Path;

/// Case, scene in the repository, and stage.
pub const FIELDS: [(&str, &str, &str); 33] = [
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
    ("first_slip", "verification/cases/first_slip/scene.toml", ""),
    ("flat_punch", "verification/cases/flat_punch/scene.toml", "press"),
    ("frictional_bar", "verification/cases/frictional_bar/scene.toml", "push"),
    ("frictional_crack", "verification/cases/frictional_crack/scene.toml", "slip"),
    ("hertz_ball", "verification/cases/hertz_ball/scene.toml", "press"),
    ("hertz_line", "scenes/hertz.toml", "press"),
    ("hertz_sphere", "verification/cases/hertz_sphere/scene.toml", "press"),
    ("interface_prestress", "verification/cases/interface_prestress/wedge.toml", "rest"),
    ("nafems_roller", "verification/cases/nafems_roller/scene.toml", "press"),
    ("newton_convergence", "scenes/ironing.toml", "draw"),
    ("partial_slip", "scenes/hertz.toml", "shear"),
    ("restarts", "verification/cases/restarts/die.toml", "draw"),
    ("sandwich_3d", "scenes/sandwich-3d.toml", ""),
    ("sandwich_pressed", "scenes/sandwich.toml", "press"),
    ("sandwich_sheared", "scenes/sandwich.toml", "shear"),
    ("sandwich_steppers", "scenes/sandwich.toml", "shear"),
    ("stage_paths", "verification/cases/stage_paths/scene.toml", ""),
    ("static_explicit_jumps", "verification/cases/static_explicit_jumps/blocks.toml", "shear"),
    ("steel_strip", "verification/cases/steel_strip/scene.toml", ""),
];

/// Case, scene in the repository, plot of its run, and title, for faults and spring-sliders.
pub const PLOTS: [(&str, &str, &str, &str); 22] = [
    ("event_files", "verification/cases/event_files/scene.toml", "largest_rate", "Largest slip rate"),
    ("event_numbers", "verification/cases/event_numbers/rupture.toml", "main_rate", MAP),
    ("fault_balance", "verification/cases/fault_balance/scene.toml", "main_rate", MAP),
    ("fault_bend", "scenes/fault-bend.toml", "main_rate", MAP),
    ("fault_medium", "scenes/bp1-half-space.toml", "main_rate", MAP),
    ("fault_opening", "verification/cases/fault_opening/thrust.toml", "main_rate", MAP),
    (
        "fault_pressing",
        "verification/cases/fault_pressing/block.toml",
        "springs_friction",
        "Macroscopic friction",
    ),
    ("fault_turning", "verification/cases/fault_turning/scene.toml", "largest_rate", "Largest slip rate"),
    (
        "fluid_along_fault",
        "verification/cases/fluid_along_fault/scene.toml",
        "main_slip",
        "Slip through time",
    ),
    ("frictional_heat", "scenes/thermal-pressurisation.toml", "largest_rate", "Largest slip rate"),
    ("sandwich_state", "scenes/sandwich-state.toml", "largest_rate", "Largest slip rate"),
    ("seas_bp1", "scenes/bp1.toml", "main_rate", MAP),
    ("seas_bp1_25m", "scenes/bp1.toml", "main_rate", MAP),
    ("seas_bp1_full", "scenes/bp1.toml", "main_rate", MAP),
    ("seas_bp1_methods", "scenes/bp1.toml", "main_rate", MAP),
    ("seas_bp2", "scenes/bp2.toml", "main_rate", MAP),
    ("seas_bp3", "scenes/bp3.toml", "main_rate", MAP),
    ("seas_bp3_25m", "scenes/bp3.toml", "main_rate", MAP),
    ("seas_bp3_full", "scenes/bp3.toml", "main_rate", MAP),
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

/// Cases whose subject is not a field, and why.
pub const WITHOUT: [(&str, &str); 7] = [
    (
        "absence",
        "instructions and bytes of runs are counted here; the fields of these scenes are on the pages of their cases",
    ),
    ("output_files", "files are compared number by number; their fields are on the pages of other cases"),
    ("kinds_agree", "runs of four kinds are compared at their ends, where slip and stress are uniform"),
    ("contact_pairing", "the partner of a single point is followed, and no field is computed"),
    ("explicit_files", "files are compared number by number; waves are on the pages of other cases"),
    ("stabilised_steps", "a row of equations is integrated, which has no mesh"),
    ("scene_units", "values of a scene are compared in several units, and no field is computed"),
];

/// Pictures of a case, or the reason why one cannot be drawn.
pub fn pictures(case: &str) -> String {
    let fields = FIELDS.iter().filter(|(name, ..)| *name == case);
    let fields = fields.map(|(_, scene, stage)| one(scene, draw(scene, stage)));
    let plots = PLOTS.iter().filter(|(name, ..)| *name == case);
    let without = WITHOUT.iter().filter(|(name, _)| *name == case);
    let without = without.map(|(_, why)| format!("<p class=\"small\">No field: {}.</p>\n", escape(why)));
    fields
        .chain(plots.map(|(_, scene, plot, title)| one(scene, plotted(scene, plot, title))))
        .chain(without)
        .collect()
}

fn one(scene: &str, picture: Result<Picture, String>) -> String {
    match picture {
        Ok(picture) => figures::picture(&picture),
        Err(why) => format!("<p class=\"small\">No field of {}: {}</p>\n", escape(scene), escape(&why)),
    }
}

/// Plot that a run of the program writes.
fn plotted(path: &str, plot: &str, title: &str) -> Result<Picture, String> {
    let svg = body_plots::plot_of(&root().join(path), plot).map_err(|error| error.to_string())?;
    Ok(Picture { title: title.to_owned(), svg, caption: format!("Scene {path}.") })
}

/// Folder of the workspace.
fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package)
}

/// Draws a stage of the scene at `path`.
///
/// # Errors
/// A description if the scene cannot be read or drawn.
pub fn draw(path: &str, stage: &str) -> Result<Picture, String> {
    let file = root().join(path);
    let text = std::fs::read_to_string(&file).map_err(|error| error.to_string())?;
    let folder = file.parent().unwrap_or(root());
    let scene = scene::read_in(&text, folder).map_err(|error| error.to_string())?;
    let svg = body_plots::mises(&scene, stage).map_err(|error| error.to_string())?;
    let when = if stage.is_empty() { "the first stage".to_owned() } else { format!("stage “{stage}”") };
    let title = format!("Mises stress at the end of {when}");
    Ok(Picture { title, svg, caption: format!("Scene {path}.") })
}
