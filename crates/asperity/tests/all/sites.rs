//! Receivers and sites at the free surface, with faults that are curved and creep.

use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use std::fmt::Write as _;
use std::path::Path;

const DIP: f64 = 70.0;

/// A scene with a fault of this geometry and rake that creeps, and a second fault that is not parallel to it and hardly creeps.
fn text(geometry: &str, rake: [f64; 3], output: &str) -> String {
    let mut text = "schema = 1\ntitle = \"sites\"\nkinematics = \"3d\"\n[materials.rock]\nyoung = \"80 GPa\"\npoisson = 0.25\ndensity = 2670\n\
         [medium]\nkind = \"half-space\"\nmaterial = \"rock\"\n"
        .to_string();
    let other = "rectangle = { from = [40, -9, 0], to = [40, -9, 4], dip = \"90 deg\", width = 2, size = 2 }";
    let parts = [("main", geometry, rake, 1e-9), ("other", other, [0.0, 0.0, 1.0], 1e-30)];
    for (name, geometry, rake, creep) in parts {
        let _ = writeln!(
            text,
            "[faults.{name}]\n{geometry}\nrake = {rake:?}\n\
             law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.010, b = 0.015, l = \"40 cm\", v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\" }}\n\
             normal = \"50 MPa\"\nunder_resolved = \"allow\"\nrate = 1e-9\ndamping = \"radiation\"\ncreep = {{ rate = {creep:e} }}"
        );
    }
    text + "[[stages]]\nname = \"cycles\"\nduration = \"100 yr\"\n[time]\nstepper = \"fault-ode\"\n[output]\n"
        + output
        + "\n[place]\nepoch = \"2000-01-01T00:00:00Z\"\nlatitude = \"35.9 deg\"\nlongitude = \"-120.5 deg\"\nstrike = \"317 deg\"\n"
}

fn planned(text: &str, folder: &Path) -> Result<Plan, String> {
    let scene = scene::read_in(text, folder).map_err(|e| e.to_string())?;
    match plan_scene(&scene).map_err(|e| e.message)? {
        ScenePlan::Faults(plan) => Ok(*plan),
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

/// The fault of Okada (1985), table 2: 3 long, 2 wide, its lower edge at a depth of 4; x along strike, and -z in the direction of his y.
fn corners() -> [[f64; 3]; 4] {
    let (sine, cosine) = DIP.to_radians().sin_cos();
    let at = |x: f64, up: f64| [x, -4.0 + up * sine, -up * cosine];
    [at(0.0, 2.0), at(3.0, 2.0), at(3.0, 0.0), at(0.0, 0.0)]
}

#[test]
fn receivers_beside_curved_faults_move_as_okada_gives_it_relative_to_their_plates() {
    let here = tempfile::tempdir().unwrap();
    let [a, b, c, d] = corners();
    let mut stl = "solid s\n".to_string();
    for triangle in [[a, b, c], [a, c, d]] {
        stl += "facet\n";
        triangle.iter().for_each(|[x, y, z]| stl += &format!("vertex {x:?} {y:?} {z:?}\n"));
        stl += "endfacet\n";
    }
    std::fs::write(here.path().join("f.stl"), stl + "endsolid s\n").unwrap();
    let rectangle =
        format!("rectangle = {{ from = {a:?}, to = {b:?}, dip = \"{DIP} deg\", width = 2, size = 1.5 }}");
    let (sine, cosine) = DIP.to_radians().sin_cos();
    // Case 2 of the table at x = 2, y = 3: strike slip and dip slip.
    let cases = [
        ([1.0, 0.0, 0.0], [-8.689e-3, -4.298e-3, -2.747e-3]),
        ([0.0, sine, -cosine], [-4.682e-3, -3.527e-2, -3.564e-2]),
    ];
    for (rake, [x, y, z]) in cases {
        for geometry in [rectangle.as_str(), "triangles.stl = { file = \"f.stl\" }"] {
            let plan = planned(&text(geometry, rake, "receivers.gps = [2, 0, -3]"), here.path()).unwrap();
            let (receiver, rates) = (&plan.receivers.all[0], &plan.receivers.rates);
            assert_eq!(receiver.plates, [0.0; 3]);
            assert!(
                plan.notes.iter().any(|n| n.starts_with("receivers move relative to the plates below")),
                "{:?}",
                plan.notes
            );
            // A locked fault moves it back at the rate of the plates.
            let locked = receiver.caused(rates.iter().map(|rate| -rate));
            for (found, table) in locked.iter().zip([x, z, -y]) {
                // Four printed digits.
                assert!(
                    (found / -1e-9 - table).abs() < 6e-4 * table.abs(),
                    "{geometry}: {locked:?}, not {table}"
                );
            }
        }
    }
}

#[test]
fn sites_lie_where_their_longitude_and_latitude_say_in_the_scene_or_in_a_file() {
    let here = tempfile::tempdir().unwrap();
    let [from, to, ..] = corners();
    let geometry =
        format!("rectangle = {{ from = {from:?}, to = {to:?}, dip = \"{DIP} deg\", width = 2, size = 1.5 }}");
    let of = |output: &str| planned(&text(&geometry, [1.0, 0.0, 0.0], output), here.path());
    // 2 km along N43W of the origin by PROJ 9.5.1; x lies to the right of the strike, and z points against it.
    let site = "sites.A = { longitude = \"-120.5151114591227 deg\", latitude = \"35.9131816680096 deg\" }\n";
    let write = |text: &str| std::fs::write(here.path().join("s.csv"), text).unwrap();
    write("name,lon,lat\nB-1,-120.5151114591227,35.9131816680096\nC,-120.5,35.9\n");
    let plan = of(&format!("{site}site_file = \"s.csv\"\nreceivers.D = [1, 0, 0]")).unwrap();
    let found: Vec<(&str, [f64; 3])> = plan.receivers.all.iter().map(|r| (r.name.as_str(), r.at)).collect();
    let expected =
        [("D", [1.0, 0.0, 0.0]), ("A", [0.0, 0.0, -2e3]), ("B-1", [0.0, 0.0, -2e3]), ("C", [0.0, 0.0, 0.0])];
    assert_eq!(found.len(), expected.len());
    for ((name, at), (wanted, exact)) in found.iter().zip(expected) {
        assert_eq!(*name, wanted);
        assert!(at.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-3), "{name}: {at:?}");
    }
    for (file, words) in [
        ("name,lon,lat\nA,-120.5,35.9\n", "line 2: there is another receiver `A`"),
        ("name,lon,lat\na b,-120.5,35.9\n", "line 2: `a b` cannot be the name of a site"),
        ("name,lon,lat\nE,-120.5,135.9\n", "line 2: no longitude and latitude"),
        ("name,lon,lat\nE,20.5,35.9\n", "is not within 900 km"),
        ("name,x,lat\nE,20.5,35.9\n", "no column `longitude`"),
    ] {
        write(file);
        let message = of(&format!("{site}site_file = \"s.csv\"")).unwrap_err();
        assert!(message.contains(words), "{message} has no `{words}`");
    }
}
