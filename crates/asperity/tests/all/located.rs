//! Catalogues in the exchange formats of seismology, compared with files of real events: `catalogues/events.ndk` and
//! `catalogues/CMTSOLUTION` are the examples with which ObsPy tests its readers, solutions of the Global CMT project.

use crate::common::varied;
use asperity::kinds::faults::catalogue_entries::locate;
use asperity_output::formats::catalogues::{Plane, SourceParameters, Spot, Tensor, cmtsolution, quakeml};
use asperity_plan::reading::scene;
use asperity_vary::Change::{Add, With, Without};

const NDK: &str = include_str!("../catalogues/events.ndk");
const CMT: &str = include_str!("../catalogues/CMTSOLUTION");

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

/// Largest difference of two tensors, relative to the moment of the second.
fn off(a: &Tensor, b: &Tensor) -> f64 {
    a.0.iter().zip(&b.0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / b.moment()
}

#[test]
fn nodal_planes_are_those_of_the_global_cmt_catalogue() {
    let lines: Vec<&str> = NDK.lines().collect();
    assert!(lines.len() >= 25);
    for event in lines.chunks_exact(5) {
        let values = numbers(&event[3][2..]);
        let power = 10f64.powi(event[3][..2].trim().parse().unwrap());
        let tensor = Tensor(std::array::from_fn(|k| values[2 * k] * power));
        // Strike, dip and rake of both planes in whole degrees, after the axes and the moment.
        let axes = numbers(&event[4][3..]);
        let moment = axes[9] * power;
        assert!((tensor.moment() / moment - 1.0).abs() < 2e-3, "{}", event[0]);
        let plane = |k: usize| Plane { strike: axes[k], dip: axes[k + 1], rake: axes[k + 2] };
        for found in tensor.planes() {
            // Angles of similar planes may differ much, but tensors may not: rounding to whole degrees is within 0.5
            // degrees, 0.009 rad, in each of three angles.
            let rebuilt = Tensor::from_plane(&found, 1.0);
            for given in [plane(10), plane(13)] {
                let off = off(&rebuilt, &Tensor::from_plane(&given, 1.0));
                assert!(off < 0.03, "{}: {found:?} {given:?} {off}", event[0]);
            }
        }
    }
}

/// The event of the example.
fn iran() -> SourceParameters {
    let value = |name: &str| {
        let line = CMT.lines().find(|l| l.starts_with(name)).unwrap();
        line.split_whitespace().last().unwrap().parse::<f64>().unwrap()
    };
    let names = ["Mrr", "Mtt", "Mpp", "Mrt", "Mrp", "Mtp"];
    let tensor = Tensor(names.map(|name| value(name) / 1e7));
    SourceParameters {
        time: "2003-12-26T01:56:52.4Z".into(),
        hypocentre: Spot { latitude: 29.0, longitude: 58.31, depth: 10e3 },
        centroid: Spot {
            latitude: value("latitude"),
            longitude: value("longitude"),
            depth: value("depth") * 1e3,
        },
        planes: tensor.planes(),
        tensor,
        moment: Some(tensor.moment()),
        magnitude: Some(6.8),
        onset: "2003-12-26T01:56:52.4Z".parse().unwrap(),
        duration: 2.0 * value("half duration"),
    }
}

#[test]
fn a_cmtsolution_has_the_columns_of_the_example() {
    let written = cmtsolution("a b", &[iran()]).unwrap();
    let (found, expected): (Vec<&str>, Vec<&str>) = (written.lines().collect(), CMT.lines().collect());
    // All but the name of the catalogue, the magnitudes and the region.
    assert_eq!(found[0][4..50], expected[0][4..50]);
    assert_eq!(&found[0][..5], " SIM ");
    assert_eq!(found[1], "event name:            a_b-1");
    assert_eq!(found[3..13], expected[3..13]);
    let mut later = iran();
    later.onset = "2003-12-26T01:56:52.407891Z".parse().unwrap();
    let written = cmtsolution("a", &[later.clone(), later.clone()]).unwrap();
    assert!(written.contains("time shift:         0.007891"), "{written}");
    assert_eq!(written.matches("event name:").count(), 2);
    later.magnitude = None;
    assert_eq!(cmtsolution("a", &[later]), None);
}

#[test]
fn quakeml_says_that_events_are_simulated_and_gives_no_magnitude_without_a_length() {
    let title = "rocks & <faults>";
    let text = String::from_utf8(quakeml(title, "id", &[iran()]).unwrap()).unwrap();
    for part in [
        "<q:quakeml xmlns=\"http://quakeml.org/xmlns/bed/1.2\"",
        "<type>other event</type>",
        "rocks &amp; &lt;faults&gt;. Simulated event",
        "<value>2003-12-26T01:56:52.4Z</value>",
        "<preferredMagnitudeID>smi:local/asperity/id/1/magnitude</preferredMagnitudeID>",
        "<Mrr>",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let plane = SourceParameters { moment: None, magnitude: None, ..iran() };
    let text = String::from_utf8(quakeml(title, "id", &[plane]).unwrap()).unwrap();
    for part in ["<magnitude", "<momentTensor", "Mw", "<Mrr>"] {
        assert!(!text.contains(part), "{part} is in\n{text}");
    }
    assert!(text.contains("per metre of length out of the plane") && text.contains("<nodalPlane1>"));
}

/// An event of a scene in which all points slip by the same amount, with the sign of `slip`.
fn uniform(text: &str, slip: f64) -> SourceParameters {
    slipped(text, &[slip])
}

/// The same with all components of slip.
fn slipped(text: &str, components: &[f64]) -> SourceParameters {
    use asperity_cycles::{Components, Rupture};
    use asperity_ode::Clock;
    use asperity_plan::{ScenePlan, plan_scene};
    use asperity_run::Event;
    let plan = match plan_scene(&asperity_plan::reading::scene::read(text).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    };
    let n = plan.points.len();
    let event = Event {
        onset: Clock::new(86_400.0, 0.5),
        interval: None,
        end: Some(Clock::new(86_400.0, 10.5)),
        peak: 1.0,
        details: Rupture {
            above: 8.0,
            hypocentre: n - 1,
            slip: Components::new(components.iter().flat_map(|&slip| vec![slip; n]).collect(), n),
            drop: Components::new(vec![0.0; n * components.len()], n),
            ..Rupture::default()
        },
    };
    let located = locate(&plan, plan.frame.as_ref().unwrap(), &event, &(0..plan.points.len())).unwrap();
    let area: f64 = plan.points.iter().map(|p| p.area).sum();
    let length = if text.contains("\"3d\"") {
        1.0
    } else if text.contains("60 km\"\n") {
        60e3
    } else {
        80e3
    };
    let slip = components.iter().map(|c| c * c).sum::<f64>().sqrt();
    let moment = plan.points[0].shear_modulus * area * length * slip;
    assert!((located.moment.unwrap() / moment - 1.0).abs() < 1e-12);
    assert!((located.tensor.moment() / moment - 1.0).abs() < 1e-12);
    located
}

fn assert_plane(located: &SourceParameters, expected: Plane) {
    let double = Tensor::from_plane(&expected, located.moment.unwrap());
    assert!(off(&located.tensor, &double) < 1e-7, "{:?} is not {expected:?}", located.planes);
}

#[test]
fn mechanisms_are_those_of_the_scene_seen_along_its_strike() {
    let strike_slip = include_str!("../../../../interop/strike_slip.toml");
    // The plus side, on the right, moves towards an observer who looks along the strike.
    let located = uniform(strike_slip, 2.0);
    assert_plane(&located, Plane { strike: 317.0, dip: 90.0, rake: 180.0 });
    assert_eq!(located.time, "1987-03-06T06:07:08.625Z");
    // The fault is a line below the origin.
    let spot = located.hypocentre;
    assert!((spot.latitude - 35.9).abs() < 1e-12 && (spot.longitude + 120.5).abs() < 1e-12, "{spot:?}");
    assert!(spot.depth > 20e3 && located.centroid.depth < spot.depth, "{located:?}");
    assert_plane(&uniform(strike_slip, -2.0), Plane { strike: 317.0, dip: 90.0, rake: 0.0 });
    let thrust = include_str!("../../../../interop/thrust.toml");
    // The fault dips to the right, and the plus side lies above it.
    let located = uniform(thrust, 1.0);
    assert_plane(&located, Plane { strike: 20.0, dip: 30.0, rake: 90.0 });
    assert_plane(&uniform(thrust, -1.0), Plane { strike: 20.0, dip: 30.0, rake: -90.0 });
    // Down the dip of 30 degrees to the right of N20E, which is S70E, beyond the date line; 2 km deeper than the trace says.
    let spot = located.hypocentre;
    // PROJ 9.5.1, for 20021.6136 m on the transverse Mercator projection of WGS84 around the origin.
    assert!((spot.depth - (2e3 + 20_021.613_586 * 30f64.to_radians().tan())).abs() < 1e-3, "{spot:?}");
    assert_spot(&spot, [-33.561_573_905_4, -179.897_385_145_1]);
}

/// Asserts a latitude and a longitude \[degrees\] within a tenth of a millimetre.
fn assert_spot(spot: &Spot, [latitude, longitude]: [f64; 2]) {
    let off = (spot.latitude - latitude).abs().max((spot.longitude - longitude).abs());
    assert!(off < 1e-9, "{spot:?}");
}

/// Two blocks with a fault between them, y up and the fault along z.
const UPRIGHT: &str = r#"
schema = 1
title = "two blocks"
kinematics = "3d"
[materials.rock]
young = "80 GPa"
poisson = 0.25
[bodies.A]
material = "rock"
mesh.block = { min = ["-2 km", "-2 km", 0], max = [0, 0, "2 km"], divisions = [1, 2, 2], element = "hex8" }
[bodies.B]
material = "rock"
mesh.block = { min = [0, "-2 km", 0], max = ["2 km", 0, "2 km"], divisions = [1, 2, 2], element = "hex8" }
[faults.main]
minus = "A.right"
plus = "B.left"
rake = [0, 0, 1]
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
under_resolved = "allow"
rate = 1e-9
damping = 5e6
[[stages]]
name = "cycles"
duration = "100 yr"
conditions = [{ set = "A.left", x = 0, y = 0, z = { rate = -0.5e-9 } }, { set = "B.right", x = 0, y = 0, z = { rate = 0.5e-9 } }]
[time]
stepper = "fault-ode"
[place]
epoch = "1987-03-05T06:07:08Z"
latitude = "35.9 deg"
longitude = "-120.5 deg"
strike = "317 deg"
up = [0, 2, 0]
along = [0, 0, 1]
"#;

#[test]
fn mechanisms_in_space_follow_the_directions_the_scene_gives() {
    // An observer who looks along z with y up has x to the left: the plus side, on the left, moves away, as in a
    // right-lateral event.
    let located = uniform(UPRIGHT, 2.0);
    assert_plane(&located, Plane { strike: 317.0, dip: 90.0, rake: 180.0 });
    // The last point is the highest or lowest; all lie on the fault below the origin, 2 km along N43W at most.
    let spot = located.hypocentre;
    // PROJ 9.5.1, for 2 km along N43W on the transverse Mercator projection of WGS84 around the origin.
    assert_spot(&spot, [35.9131816680096, -120.5151114591227]);
    assert!((-1e-6..=2e3 + 1e-6).contains(&spot.depth), "{spot:?}");
    // The plus side, on the left, moves up.
    let thrust = uniform(&varied(UPRIGHT, &[With("faults.main.rake", "[0, 1, 0]")]), 1.0);
    assert_plane(&thrust, Plane { strike: 317.0, dip: 90.0, rake: -90.0 });
    // Free slip: along z, and across it down, normal x rake.
    let free = varied(UPRIGHT, &[Add("faults.main.slip", "free")]);
    let (sine, cosine) = 30f64.to_radians().sin_cos();
    assert_plane(
        &slipped(&free, &[2.0 * cosine, 2.0 * sine]),
        Plane { strike: 317.0, dip: 90.0, rake: 150.0 },
    );
    // Without the directions of the place, y is up and x to the right of the strike, as in the plane: slip along z moves the
    // plus side, on the right, back.
    let usual = varied(UPRIGHT, &[Without("place.up"), Without("place.along")]);
    assert_plane(&uniform(&usual, 1.0), Plane { strike: 317.0, dip: 90.0, rake: 180.0 });
    // Gravity says what is up: slip along z is then down dip.
    let pulled = varied(
        UPRIGHT,
        &[
            Without("place.up"),
            Without("place.along"),
            Add("bodies.A.gravity", "[0, 0, 9.81]"),
            Add("bodies.B.gravity", "[0, 0, 9.81]"),
            Add("materials.rock.density", "2670"),
            Without("faults.main.normal"),
        ],
    );
    let read = asperity_plan::reading::scene::read(&pulled).unwrap_or_else(|e| panic!("{e}"));
    let axes = read.axes();
    assert_eq!((axes.up, axes.along), ([0.0, 0.0, -9.81], [0.0, -9.81, 0.0]));
}

/// A vertical fault in a half-space that reaches the surface, y up, and slips to the right along z through one event.
pub const STRIKE_SLIP: &str = r#"
schema = 1
title = "a strike-slip fault"
kinematics = "3d"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = "2670 kg/m^3"
[medium]
kind = "half-space"
material = "rock"
[faults.main]
rectangle = { from = [0, 0, "6 km"], to = [0, 0, "-6 km"], width = "6 km", size = "2 km" }
rake = [0, 0, 1]
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, v_ref = "1 um/s", v_initial = "1e-9 m/s", a = 0.01, b = 0.015, l = "20 mm" }
normal = "50 MPa"
rate = "1.2e-9 m/s"
under_resolved = "allow"
damping = "radiation"
creep = { rate = 1e-9 }
[[stages]]
name = "c"
duration = "1000 yr"
[time]
stepper = "fault-ode"
[events]
above = "1e-2 m/s"
stop_after = 1
[output]
surface = { spacing = "2 km" }
[place]
epoch = "2000-01-01T00:00:00Z"
latitude = "35 deg"
longitude = "135 deg"
strike = "70 deg"
"#;

#[test]
fn degrees_without_a_unit_are_no_radians() {
    let told = |latitude: &str| match scene::read(&varied(STRIKE_SLIP, &[With("place.latitude", latitude)])) {
        Ok(_) => String::new(),
        Err(errors) => errors.to_string(),
    };
    for latitude in ["35", "-35"] {
        let said = told(latitude);
        assert!(said.contains("in degrees it is") && said.contains(latitude), "{latitude}: {said}");
    }
    // 35 degrees, and angles of less than a turn.
    assert_eq!(told("0.610865"), "");
    assert_eq!(told("0"), "");
}

#[test]
fn a_strike_slip_event_in_a_half_space_is_published_as_one_below_the_ground() {
    let here = crate::resume::folder(STRIKE_SLIP);
    let ran = crate::resume::run(here.path(), "out", &[]);
    assert!(ran.status.success(), "{}", crate::resume::text(&ran.stderr));
    let out = here.path().join("out");
    let quakeml = std::fs::read_to_string(out.join("events.quakeml")).unwrap();
    let value = |text: &str, key: &str| -> f64 {
        let rest = text.split(&format!("<{key}>")).nth(1).unwrap();
        let value = rest.split("</value>").next().unwrap();
        numbers(value.split("<value>").last().unwrap())[0]
    };
    let plane = |key: &str| {
        let rest = quakeml.split(&format!("<{key}>")).nth(1).unwrap().to_string();
        ["strike", "dip", "rake"].map(|angle| value(&rest, angle))
    };
    let both = ["nodalPlane1", "nodalPlane2"].map(plane);
    let is = |found: &[f64; 3], wanted: [f64; 3]| {
        found.iter().zip(wanted).all(|(a, b)| ((a - b + 540.0) % 360.0 - 180.0).abs() < 0.1)
    };
    // The plus side, right of the strike N70E, moves back along it.
    let wanted = [70.0, 90.0, 180.0];
    assert!(
        both.iter().any(|p| is(p, wanted) || is(p, [250.0, 90.0, 180.0]) || is(p, [250.0, 90.0, -180.0])),
        "{both:?}"
    );
    let depth = value(quakeml.split("<origin ").nth(1).unwrap(), "depth");
    assert!((1e3..=5e3).contains(&depth), "{depth}");
    let cmt = std::fs::read_to_string(out.join("CMTSOLUTION")).unwrap();
    let entry = |name: &str| {
        numbers(cmt.lines().find(|l| l.starts_with(name)).unwrap().split(':').nth(1).unwrap())[0]
    };
    assert!((1.0..=5.0).contains(&entry("depth")), "{cmt}");
    let largest = ["Mtt", "Mpp", "Mtp"].map(&entry).into_iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    assert!(["Mrr", "Mrt", "Mrp"].into_iter().all(|name| entry(name).abs() < 1e-6 * largest), "{cmt}");
    // The northern and eastern ends move to the east and west by tens of times more than the ground rises anywhere: an upright
    // fault that slips along strike lifts its quadrants a little.
    let map = |name: &str| {
        let bytes = std::fs::read(out.join("events").join(format!("surface_000_{name}.grd"))).unwrap();
        let rows = asperity_fem::mesh::netcdf::rows(&bytes).unwrap();
        rows.iter().map(|row| row[2].abs()).fold(0.0, f64::max)
    };
    assert!(map("up") < 0.3 * map("east"), "{} {}", map("up"), map("east"));
    let fsp = std::fs::read_dir(out.join("events")).unwrap().map(|f| f.unwrap().path());
    let mut fsp = fsp.filter(|f| f.extension().is_some_and(|e| e == "fsp"));
    let fsp = fsp.next().unwrap();
    let fsp = std::fs::read_to_string(fsp).unwrap();
    let mechanism = fsp.lines().find(|l| l.contains("STRK =") || l.contains("STRK=")).unwrap();
    assert!(mechanism.contains("DIP"), "{mechanism}");
    let rows: Vec<Vec<f64>> =
        fsp.lines().filter(|l| !l.starts_with('%') && !l.trim().is_empty()).map(numbers).collect();
    assert_eq!(rows.len(), 18);
    // Latitude, longitude, east, north and depth \[km\] of the upper edge of each cell.
    assert!(rows.iter().all(|row| (-1e-3..=4.01).contains(&row[4])), "{rows:?}");
}
