//! Fluid that diffuses along faults: what scenes may give, and what a plan says of it.
#![allow(clippy::disallowed_methods)]

use crate::common::varied;
use asperity_cycles::Injection;
use asperity_cycles::PorePressure as _;
use asperity_cycles::diffusion::Diffusion;
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::Change::{self, Add, With, Without};
use std::fs;
use std::path::Path;

/// A fault in a whole space with a well in its middle.
const SCENE: &str = include_str!("../../../../verification/cases/fluid_along_fault/scene.toml");
/// A fault between bodies below a free surface.
const BETWEEN: &str = include_str!("../../../../scenes/fault-opening.toml");
const DAY: f64 = 86_400.0;

fn plan_in(text: &str, folder: &Path) -> Result<Plan, String> {
    let scene = scene::read_in(text, folder).map_err(|error| format!("{error:?}"))?;
    match plan_scene(&scene).map_err(|error| format!("{error:?}"))? {
        ScenePlan::Faults(plan) => Ok(*plan),
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

fn plan(text: &str) -> Plan {
    plan_in(text, Path::new(".")).unwrap()
}

/// Pressures of all points at a time \[Pa\].
fn pressures(plan: &Plan, time: f64) -> Vec<f64> {
    plan.problem.fault.processes.find::<Diffusion>().unwrap().at(time, plan.points.len())
}

#[test]
fn nodes_of_bodies_have_the_pressure_of_an_injection_into_the_same_layer() {
    let diffusion = r#"{ permeability = "1e-13 m^2", storage = 1e-9, viscosity = "1e-3 Pa s", wells = [{ at = "1 km", flux = "4e-6 m/s" }] }"#;
    let layer = Injection { flux: vec![(0.0, 4e-6)], diffusivity: 0.1, porosity: 0.1, compressibility: 1e-8 };
    let time = 5.0 * DAY;
    // Corners of linear elements are 100 m apart, and nodes of quadratic ones 50 m. The error at a node with a well is h²/(16 D t) of its pressure.
    for (element, size) in [("quad4", 100.0), ("quad9", 50.0)] {
        let text = varied(
            BETWEEN,
            &[
                Without("faults.main.injection"),
                Add("faults.main.diffusion", diffusion),
                With("bodies.crust.mesh.fault.growth", "2.0"),
                Change::WithOrSame("bodies.crust.mesh.fault.element", element),
            ],
        );
        let plan = plan(&text);
        let most = layer.pressure(0.0, time).0;
        let exact = plan.points.iter().map(|p| layer.pressure(p.along - 1e3, time).0);
        let error = pressures(&plan, time).into_iter().zip(exact).map(|(p, exact)| (p - exact).abs() / most);
        let (error, bound) = (error.fold(0.0, f64::max), size * size / (16.0 * 0.1 * time));
        assert!(error < 1.2 * bound, "{element}: {error} {bound}");
    }
}

#[test]
fn a_file_of_logarithms_and_a_table_of_fluxes_are_a_profile_and_steps() {
    let folder = tempfile::tempdir().unwrap();
    let rows = |of: &dyn Fn(f64) -> String| (0..=16).map(|k| of(f64::from(k))).collect::<String>();
    let permeability = String::from("distance [km],log10_permeability\n")
        + &rows(&|x| format!("{x},{}\n", -13.0 - 0.25 * x));
    fs::write(folder.path().join("k.csv"), permeability).unwrap();
    fs::write(folder.path().join("flux.csv"), "time [d],flux [m/s]\n10,2e-6\n40,5e-7\n").unwrap();
    let with_files = varied(
        SCENE,
        &[
            Without("faults.main.diffusion.permeability"),
            Add("faults.main.diffusion.fields", "{}"),
            Add(
                "faults.main.diffusion.fields.permeability",
                r#"{ file = "k.csv", column = "log10_permeability" }"#,
            ),
            With(
                "faults.main.diffusion.wells[0].flux",
                r#"{ steps = { file = "flux.csv", column = "flux" } }"#,
            ),
        ],
    );
    let found = plan_in(&with_files, folder.path()).unwrap();
    // At 20 m from one another, profiles between the points of the file are straight to 1e-4 of the permeability.
    let points = (0..=800).map(|k| 20.0 * f64::from(k));
    let points: Vec<String> =
        points.map(|x| format!("[{x}, {:e}]", 10_f64.powf(-13.0 - 0.25e-3 * x))).collect();
    let given = format!("{{ along = \"distance\", points = [{}] }}", points.join(", "));
    let with_values = varied(
        SCENE,
        &[
            Without("faults.main.diffusion.permeability"),
            Add("faults.main.diffusion.profiles", "{}"),
            Add("faults.main.diffusion.profiles.permeability", &given),
            With("faults.main.diffusion.wells[0].flux", r#"{ steps = [["10 d", 2e-6], ["40 d", 5e-7]] }"#),
        ],
    );
    let expected = pressures(&plan(&with_values), 100.0 * DAY);
    let most = expected.iter().fold(0.0_f64, |m, p| m.max(*p));
    for (p, exact) in pressures(&found, 100.0 * DAY).iter().zip(&expected) {
        assert!((p - exact).abs() < 1e-2 * most, "{p} {exact}");
    }
    assert!(
        found.notes.iter().any(|note| note.contains("`permeability` from 17 positions")),
        "{:?}",
        found.notes
    );
}

#[test]
fn what_is_doubtful_about_fluid_is_warned_of() {
    let flux = "faults.main.diffusion.wells[0].flux";
    for (change, words) in [
        (With("faults.main.diffusion.permeability", "1e-20 m^2"), "spreads over 587.9 mm until the run ends"),
        (With(flux, "1e-4 m/s"), "the run would end there"),
        (With(flux, r#"{ steps = [["500 d", 1e-6]] }"#), "begins after the end of the run"),
        (With("faults.main.diffusion.permeability", "0.1"), "permeabilities are 1e-25 to 1e-7 m2"),
        (With("faults.main.diffusion.viscosity", "1e3"), "viscosities of fluids are"),
    ] {
        let plan = plan(&varied(SCENE, &[change]));
        assert!(
            plan.warnings.iter().any(|w| w.to_string().contains(words)),
            "{change:?}: {:?}",
            plan.warnings
        );
    }
    assert!(plan(SCENE).warnings.is_empty(), "{:?}", plan(SCENE).warnings);
}

#[test]
fn what_is_doubtful_about_wells_is_warned_of_whatever_their_fluid_does() {
    let injection =
        r#"{ at = "8 km", flux = "1.25e-6 m/s", diffusivity = 0.1, porosity = 0.1, compressibility = 1e-8 }"#;
    let text = varied(SCENE, &[Without("faults.main.diffusion"), Add("faults.main.injection", injection)]);
    for (flux, words) in [
        ("1e-4 m/s", "the run would end there"),
        (r#"{ steps = [["500 d", 1e-6]] }"#, "begins after the end of the run"),
    ] {
        let plan = plan(&varied(&text, &[With("faults.main.injection.flux", flux)]));
        assert!(plan.warnings.iter().any(|w| w.to_string().contains(words)), "{words}: {:?}", plan.warnings);
    }
    assert!(plan(&text).warnings.is_empty(), "{:?}", plan(&text).warnings);
}

#[test]
fn fluid_along_faults_in_space_is_refused() {
    let line = "faults.main.line";
    let text = varied(
        SCENE,
        &[
            With("kinematics", "3d"),
            Without(line),
            Add(
                "faults.main.rectangle",
                r#"{ from = ["-1 km", "0 km", "0 km"], to = ["1 km", "0 km", "0 km"], dip = "90 deg", width = "2 km", size = "500 m" }"#,
            ),
            Add("faults.main.rake", "[1, 0, 0]"),
            Without("output.stations"),
        ],
    );
    let told = plan_in(&text, Path::new(".")).unwrap_err();
    assert!(told.contains("`diffusion` has no meaning in three dimensions"), "{told}");
}
