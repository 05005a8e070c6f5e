//! Plates as Slab2 publishes them: grids of heights in km in netCDF-4, longitudes from 0 to 360, NaN beside the plate.

use asperity_plan::faults::Plan;
use asperity_plan::reading::scene::read_in;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::Change::{Add, With};
use std::path::Path;

use crate::common::varied;

/// The plate of `fem/tests/data`: 5 km deep at 233 degrees east and 40 degrees north, 8 km deeper with each degree eastwards and 0.8
/// km northwards.
const SCENE: &str = r#"schema = 1
title = "a plate"
kinematics = "3d"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[medium]
kind = "half-space"
material = "rock"
[faults.plate]
triangles.depths = { file = "plate-nc4.grd", top = "15 km", bottom = "30 km", size = "25 km", unit = "km" }
azimuth = "250 deg"
rate = "1e-9 m/s"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "1 m", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
damping = "radiation"
under_resolved = "allow"
[place]
epoch = "2000-01-01T00:00:00Z"
latitude = "42 deg"
longitude = "-125 deg"
strike = "0 deg"
up = [0, 1, 0]
along = [0, 0, -1]
[[stages]]
name = "cycles"
duration = "1 yr"
[time]
stepper = "fault-ode"
"#;

fn plan(text: &str) -> Plan {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fem/tests/data");
    let read = read_in(text, &folder).unwrap_or_else(|e| panic!("{e}\n{text}"));
    match plan_scene(&read).unwrap_or_else(|e| panic!("{e} {:?}\n{text}", e.help)) {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has a fault"),
    }
}

#[test]
fn heights_in_netcdf_4_are_the_depths_of_a_plate() {
    let file = |name: &str| format!("\"{name}\"");
    let points = |name: &str| {
        let path = "faults.plate.triangles.depths.file";
        let text =
            if name == "plate-nc4.grd" { SCENE.into() } else { varied(SCENE, &[With(path, &file(name))]) };
        let plan = plan(&text);
        assert!(plan.notes.iter().any(|note| note.contains("its file has heights")), "{:?}", plan.notes);
        plan.points.iter().map(|p| p.at).collect::<Vec<_>>()
    };
    let found = points("plate-nc4.grd");
    assert!(found.len() > 20);
    // East is x, and north is -z, from 125 degrees west and 42 degrees north.
    for at in &found {
        let depth = -at[1];
        assert!((15e3..30e3).contains(&depth), "{at:?}");
        // A degree is 111 km northwards, and that times the cosine of the latitude eastwards.
        let (north, latitude) = (-at[2] / 111.1e3, 42.0 - at[2] / 111.1e3);
        let east = at[0] / (111.3e3 * latitude.to_radians().cos());
        let expected = 5e3 + 8e3 * (235.0 + east - 233.0) + 0.8e3 * (42.0 + north - 40.0);
        assert!((depth - expected).abs() < 300.0, "{at:?}: {depth} {expected}");
    }
    for name in ["plate-nc4-packed.grd", "plate-nc3.grd"] {
        assert_eq!(points(name), found, "{name}");
    }
}

#[test]
fn a_field_in_netcdf_4_is_that_of_the_classic_format() {
    let start = |name: &str| {
        let field = format!(
            r#"{{ rate = {{ file = "{name}", column = "z", unit = "um/s", interpolation = "nearest" }} }}"#
        );
        let changes = [Add("faults.plate.fields", &field), With("faults.plate.rate", "-1e-9 m/s")];
        plan(&varied(SCENE, &changes)).problem.start.clone()
    };
    assert_eq!(start("plate-nc4-packed.grd"), start("plate-nc3.grd"));
}
