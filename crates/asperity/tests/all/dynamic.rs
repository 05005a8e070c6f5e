//! Bodies with mass: plans, files, and runs that are interrupted.
#![allow(clippy::disallowed_methods)]

use crate::common::{told, varied};
use crate::resume::{assert_same, folder, run, text};
use asperity_plan::dynamics;
use asperity_plan::dynamics::{AnyPlan, Plan};
use asperity_plan::reading::scene;
use asperity_vary::Change::{self, Add, Push, With, Without};
use std::fs;

/// A rupture in plane strain with absorbing sides, stations and seismograms.
pub const SCENE: &str = r#"
schema = 1
title = "a rupture"
kinematics = "plane-strain"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.A]
mesh.fault = { trace = [[0, "2 km"], [0, "-2 km"]], spacing = "200 m", min = ["-2 km", "-4 km"], max = ["2 km", "4 km"], growth = 1.0, element = "quad4" }
material = "rock"
[faults.main]
minus = "A.fault.minus"
plus = "A.fault.plus"
law = { kind = "slip-weakening", mu_s = 0.677, mu_k = 0.525, d_c = "40 cm" }
normal = "120 MPa"
shear = "70 MPa"
patches = [{ box = { y = { from = "-1 km", to = "1 km" } }, shear = "81.6 MPa" }]
pulses = [{ traction = "2 MPa", centre = [0, 0], radius = "1 km", duration = "0.5 s" }]
[[stages]]
name = "rupture"
duration = "2 s"
conditions = [{ set = "A.left", absorbing = true }, { set = "A.right", absorbing = true }]
[time]
stepper = "explicit"
[output]
sampling = "20 ms"
fields = 2
stations.main = [[0, "1 km"]]
seismograms.S1 = { body = "A", at = ["1 km", "500 m"] }
"#;

fn plan(changes: &[Change<'_>]) -> Plan<2> {
    let text = varied(SCENE, changes);
    let read = scene::read(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    match dynamics::plan(&read).unwrap_or_else(|e| panic!("{e} {:?}", e.help)) {
        AnyPlan::Two(plan) => *plan,
        AnyPlan::Three(_) => panic!("the scene is plane"),
    }
}

#[test]
fn steps_divide_the_samples_and_stay_below_the_stable_one() {
    let found = plan(&[]);
    assert!(found.dt <= 0.5 * found.stable.step);
    assert_eq!(found.cadence.rows as f64 * found.dt, found.interval());
    assert!((found.interval() - 0.02).abs() < 1e-15 && (found.end() - 2.0).abs() < 1e-12);
    assert_eq!(found.problem.step_of(0, &found.stable), found.dt);
    // One step per sample would be too long for half the stable step, but not for nine tenths of it.
    assert_eq!([found.cadence.rows, plan(&[Add("time.courant", "0.9")]).cadence.rows], [2, 1]);
    let given = plan(&[Without("output.sampling"), Add("stages[0].steps", "150")]);
    assert_eq!((given.steps, given.cadence.rows), (150, 1));
    assert!(given.problem.step_of(0, &given.stable) == given.dt);
}

#[test]
fn viscosity_shortens_the_stable_step_as_its_theory_says() {
    let [without, with] = ["0.0", "0.1"].map(|beta| plan(&[Add("time.viscosity", beta)]).stable.step);
    assert!((without / with - 1.2_f64.sqrt()).abs() < 1e-14);
}

#[test]
fn tractions_at_the_start_are_those_of_fault_patch_and_pulse() {
    let found = plan(&[]);
    let fault = found.problem.fault.as_ref().unwrap();
    let pulse = &fault.pulses[0];
    for (p, view) in found.points.iter().enumerate() {
        let y = view.at[1];
        let patched = if y.abs() <= 1e3 { 81.6e6 } else { 70e6 };
        assert_eq!((fault.normal[p], fault.shear.component(0)[p]), (120e6, patched));
        let r = (y / 1e3).powi(2);
        let shape = if r < 1.0 { (r / (r - 1.0)).exp() } else { 0.0 };
        assert!((pulse.amplitude[p] - 2e6 * shape).abs() < 1e-6, "{y}");
        assert_eq!(fault.points[p].along, [[0.0, 1.0, 0.0]]);
    }
    // Slip that turns about is driven the other way.
    let turned =
        plan(&[With("faults.main.shear", "-70 MPa"), With("faults.main.patches[0].shear", "-81.6 MPa")]);
    let turned = &turned.problem.fault.as_ref().unwrap().pulses[0].amplitude;
    assert!(turned.iter().zip(&pulse.amplitude).all(|(a, b)| *a == -b));
}

#[test]
fn points_on_and_beyond_the_border_of_creep_at_no_rate_are_locked() {
    let found = plan(&[Add("faults.main.creep", "{ beyond = \"3 km\", rate = 0 }")]);
    let fault = found.problem.fault.as_ref().unwrap();
    // Of 19 points at every 200 m, those at 3.0 to 3.8 km along the fault are locked.
    assert_eq!((fault.points.len(), fault.ties.len(), found.points.len()), (14, 5, 14));
    assert!(found.points.iter().all(|p| p.along < 3e3 - 1.0));
    assert!(found.summary().contains("5 points of the faults are locked"), "{}", found.summary());
}

#[test]
fn absorbing_sides_have_the_impedances_of_the_rock() {
    let found = plan(&[]);
    // A node in the middle of a side of cells of 200 m; the normal is x.
    let middle = |d: &&asperity_mechanics::dynamics::Dashpot| {
        let at = found.problem.model.mesh.nodes[d.node];
        at[0] < 0.0 && at[1].abs() < 1.0
    };
    let dashpot = found.problem.absorbing.iter().find(middle).unwrap();
    let (young, nu, density) = (80e9, 0.25, 2670.0_f64);
    let shear: f64 = young / (2.0 * (1.0 + nu));
    let pressure = young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let impedance = |modulus: f64| (modulus * density).sqrt() * 200.0;
    assert!((dashpot.damping[0][0] / impedance(pressure) - 1.0).abs() < 1e-12);
    assert!((dashpot.damping[1][1] / impedance(shear) - 1.0).abs() < 1e-12);
}

#[test]
fn an_antiplane_fault_ruptures_out_of_the_plane() {
    let folder = folder(&varied(SCENE, &[With("kinematics", "antiplane")]));
    let done = run(folder.path(), "out", &["--no-plots"]);
    assert!(done.status.success(), "{}", told(&done));
    let table = fs::read_to_string(folder.path().join("out/seismograms/S1.csv")).unwrap();
    assert!(table.starts_with("time [s],velocity_z [m/s],displacement_z [m]\n0e0,0e0,0e0\n"), "{table}");
    let report = fs::read_to_string(folder.path().join("out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["ruptures"][0]["points"], serde_json::json!([19, 19]));
    // Slip follows the traction of the patch, and the balance of energy closes.
    assert!(report["ruptures"][0]["largest_slip"].as_f64().unwrap() > 0.4);
    assert!(report["energy"]["imbalance"].as_f64().unwrap() < 1e-10);
}

#[test]
fn a_run_that_is_interrupted_and_resumed_leaves_the_files_of_one_left_alone() {
    let folder = folder(SCENE);
    let folder = folder.path();
    let whole = run(folder, "whole", &[]);
    assert!(whole.status.success(), "{}", told(&whole));
    let arguments = ["--resume", "--wall-time", "0 s", "--checkpoint-every", "0 s"];
    // Each part takes one step; what the first parts leave is resumed to the end.
    for part in 0..4 {
        let ended = run(folder, "parts", &arguments);
        assert_eq!(ended.status.code(), Some(3), "part {part}: {}", told(&ended));
    }
    assert!(folder.join("parts/checkpoint").exists() || folder.join("parts").read_dir().unwrap().count() > 3);
    let last = run(folder, "parts", &["--resume"]);
    assert!(last.status.success(), "{}", told(&last));
    assert!(text(&last.stdout).contains("resumed at "), "{}", text(&last.stdout));
    assert_same(folder, "parts");
}

#[test]
fn a_fault_that_may_not_open_stops_the_run_where_its_sides_part() {
    // A load pulls the right side away.
    let pulled = [
        Without("faults.main.pulses"),
        With("faults.main.normal", "1 MPa"),
        With("faults.main.shear", "0.1 MPa"),
        Without("faults.main.patches"),
        Add("faults.main.under_resolved", "allow"),
        With("stages[0].conditions", r#"[{ set = "A.right", traction = ["20 MPa", 0] }]"#),
    ];
    let folder = folder(&varied(SCENE, &pulled));
    let stopped = run(folder.path(), "out", &["--no-plots"]);
    assert_eq!(stopped.status.code(), Some(2), "{}", told(&stopped));
    assert!(told(&stopped).contains("add `opening = true` to the fault"), "{}", told(&stopped));
    let mut opens = pulled.to_vec();
    opens.push(Add("faults.main.opening", "true"));
    fs::write(folder.path().join("s.toml"), varied(SCENE, &opens)).unwrap();
    let done = run(folder.path(), "open", &["--no-plots"]);
    assert!(done.status.success(), "{}", told(&done));
    let station = fs::read_to_string(folder.path().join("open/stations/main_000")).unwrap();
    let gap: f64 = station.lines().last().unwrap().split(' ').next_back().unwrap().parse().unwrap();
    assert!(gap > 0.0, "{gap}");
}

#[test]
fn a_seismogram_on_the_cut_of_its_body_is_refused() {
    let at = |x: &str| {
        let text = varied(SCENE, &[With("output.seismograms.S1.at", &format!(r#"["{x}", "500 m"]"#))]);
        dynamics::plan(&scene::read(&text).unwrap()).map(|_| ()).map_err(|e| e.to_string())
    };
    let refused = at("0 km").unwrap_err();
    assert!(refused.contains("the seismogram `S1` at (0, 500) m lies on a fault"), "{refused}");
    assert_eq!(at("1 m"), Ok(()));
}

#[test]
fn velocities_of_seismograms_are_the_rates_of_their_displacements_at_the_same_time() {
    // With one step a sample, v at a step is exactly (u after - u before)/(2 dt).
    let folder = folder(&varied(SCENE, &[Add("time.courant", "0.9")]));
    let done = run(folder.path(), "out", &["--no-plots"]);
    assert!(done.status.success(), "{}", told(&done));
    let table = fs::read_to_string(folder.path().join("out/seismograms/S1.csv")).unwrap();
    let number = |v: &str| v.parse::<f64>().unwrap();
    let rows: Vec<Vec<f64>> = table.lines().skip(1).map(|row| row.split(',').map(number).collect()).collect();
    assert_eq!(rows.len(), 101);
    let largest = rows.iter().map(|r| r[2].abs()).fold(0.0, f64::max);
    assert!(largest > 0.1, "{largest}");
    for w in rows.windows(3) {
        for c in [1, 2] {
            let rate = (w[2][c + 2] - w[0][c + 2]) / (w[2][0] - w[0][0]);
            assert!((w[1][c] - rate).abs() < 1e-10 * largest, "{} s: {} {rate}", w[1][0], w[1][c]);
        }
    }
}

/// A rupture on the plane between two blocks in space.
pub const IN_SPACE: &str = r#"
schema = 1
title = "a rupture in space"
kinematics = "3d"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.A]
mesh.block = { min = ["-1.5 km", "-2 km", "-2 km"], max = [0, "2 km", "2 km"], size = "250 m", element = "hex8" }
material = "rock"
[bodies.B]
mesh.block = { min = [0, "-2 km", "-2 km"], max = ["1.5 km", "2 km", "2 km"], size = "250 m", element = "hex8" }
material = "rock"
[faults.main]
minus = "A.right"
plus = "B.left"
rake = [0, 0, 1]
slip = "free"
law = { kind = "slip-weakening", mu_s = 0.677, mu_k = 0.525, d_c = "20 cm" }
normal = "120 MPa"
shear = "68 MPa"
patches = [{ disc = { centre = [0, 0, 0], radius = "1.3 km" }, shear = "82 MPa" }]
under_resolved = "allow"
[[stages]]
name = "rupture"
duration = "0.8 s"
conditions = [{ set = "A.left", absorbing = true }, { set = "B.right", absorbing = true }]
[time]
stepper = "explicit"
[output]
fields = 2
stations.main = [[0, 0, 0]]
seismograms.PLUS = { body = "B", at = [0, 0, 0] }
"#;

#[test]
fn a_rupture_in_space_slips_along_its_traction_and_is_symmetric() {
    let folder = folder(IN_SPACE);
    let done = run(folder.path(), "out", &[]);
    assert!(done.status.success(), "{}", told(&done));
    let out = folder.path().join("out");
    let report: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(out.join("report.json")).unwrap()).unwrap();
    assert!(report["energy"]["imbalance"].as_f64().unwrap() < 1e-10);
    let table = fs::read_to_string(out.join("rupture_times.csv")).unwrap();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|r| r.split(',').skip(1).map(|v| v.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 17 * 17);
    // Points mirrored about the centre rupture at the same time, and some do not rupture.
    assert!(rows.iter().any(|r| r[3].is_nan()) && rows.iter().any(|r| r[3] > 0.0));
    for r in &rows {
        let mirror = rows.iter().find(|m| (m[1] + r[1]).abs() < 1.0 && (m[2] + r[2]).abs() < 1.0).unwrap();
        assert!(
            (r[3].is_nan() && mirror[3].is_nan()) || (r[3] - mirror[3]).abs() <= 1e-9,
            "{r:?} {mirror:?}"
        );
    }
    // Slip at the centre is along the rake, the first of its two components.
    let station = fs::read_to_string(out.join("stations/main_000")).unwrap();
    let last: Vec<f64> = station.lines().last().unwrap().split(' ').map(|v| v.parse().unwrap()).collect();
    assert!(last[1] > 0.2 && last[2].abs() < 1e-9 * last[1], "{last:?}");
    // The plus side moves along the rake by half the slip.
    let plus = fs::read_to_string(out.join("seismograms/PLUS.csv")).unwrap();
    let moved: Vec<f64> = plus.lines().last().unwrap().split(',').map(|v| v.parse().unwrap()).collect();
    assert!((moved[6] / last[1] - 0.5).abs() < 1e-6 && moved[5].abs() < 1e-9, "{moved:?} {last:?}");
    for file in ["plots/main_rupture_times.png", "plots/main_film.png", "fields/main_00002.vtu"] {
        assert!(out.join(file).exists(), "{file}");
    }
}

#[test]
fn the_first_row_has_the_slip_rate_of_the_scene() {
    let law = r#"{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.008, b = 0.012, l = "20 mm", v_ref = "1 um/s", v_initial = "1e-12 m/s" }"#;
    let changes = [
        With("faults.main.law", law),
        Add("faults.main.rate", "1e-12 m/s"),
        With("stages[0].duration", "0.1 s"),
    ];
    let folder = folder(&varied(SCENE, &changes));
    let done = run(folder.path(), "out", &["--no-plots"]);
    assert!(done.status.success(), "{}", told(&done));
    let read = |file: &str| fs::read_to_string(folder.path().join("out").join(file)).unwrap();
    let first = |text: &str, by: char| -> Vec<f64> {
        let row = text.lines().find(|line| line.starts_with('0')).unwrap();
        row.split(by).map(|v| v.parse().unwrap()).collect()
    };
    assert!((first(&read("stations/main_000"), ' ')[2] + 12.0).abs() < 1e-9);
    assert!(first(&read("rate_profiles.csv"), ',')[1..].iter().all(|log| (log + 12.0).abs() < 1e-9));
    // Points at rest have the least rate, which the head states.
    let still = crate::resume::folder(&varied(SCENE, &[Without("faults.main.patches")]));
    assert!(run(still.path(), "out", &["--no-plots"]).status.success());
    let station = fs::read_to_string(still.path().join("out/stations/main_000")).unwrap();
    assert!(station.contains("# least_slip_rate=1e-20 m/s, which means rest\n"), "{station}");
    assert_eq!(first(&station, ' ')[2], -20.0);
}

/// Rupture times by position of a run of the rupture in space with some changes.
fn times_in_space(changes: &[Change<'_>]) -> Vec<([f64; 2], f64)> {
    let folder = folder(&varied(IN_SPACE, changes));
    let done = run(folder.path(), "out", &["--no-plots"]);
    assert!(done.status.success(), "{}", told(&done));
    let table = fs::read_to_string(folder.path().join("out/rupture_times.csv")).unwrap();
    let row = |row: &str| {
        let v: Vec<f64> = row.split(',').skip(1).map(|v| v.parse().unwrap()).collect();
        ([v[1], v[2]], v[3])
    };
    table.lines().skip(1).map(row).collect()
}

#[test]
fn a_fault_that_meets_planes_of_symmetry_ruptures_as_the_whole_one() {
    let whole = times_in_space(&[]);
    // The upper half, y > 0: symmetric. Of it the half z > 0: antisymmetric, as slip is along z.
    let quarter = times_in_space(&[
        With("bodies.A.mesh.block.min", "[\"-1.5 km\", 0, 0]"),
        With("bodies.B.mesh.block.min", "[0, 0, 0]"),
        Push("stages[0].conditions", "{ set = \"A.bottom\", y = 0 }"),
        Push("stages[0].conditions", "{ set = \"B.bottom\", y = 0 }"),
        Push("stages[0].conditions", "{ set = \"A.back\", x = 0, y = 0 }"),
        Push("stages[0].conditions", "{ set = \"B.back\", x = 0, y = 0 }"),
    ]);
    assert_eq!(quarter.len(), 9 * 9);
    for (at, time) in quarter {
        let same = whole.iter().find(|w| (w.0[0] - at[0]).hypot(w.0[1] - at[1]) < 1.0).unwrap().1;
        assert!((time.is_nan() && same.is_nan()) || (time - same).abs() < 1e-9, "{at:?}: {time} {same}");
    }
}

#[test]
fn a_point_that_conditions_hold_along_the_rake_does_not_slip() {
    let held = times_in_space(&[
        Push("stages[0].conditions", "{ set = \"A.front\", x = 0, y = 0, z = 0 }"),
        Push("stages[0].conditions", "{ set = \"B.front\", x = 0, y = 0, z = 0 }"),
        With("faults.main.patches[0].disc.radius", "3 km"),
    ]);
    for (at, time) in held {
        assert_eq!(time.is_nan(), at[1] > 1999.0, "{at:?}: {time}");
    }
}

#[test]
fn the_estimate_of_memory_counts_one_matrix_for_cells_of_one_shape() {
    let sizes = ["A", "B"].map(|b| format!("bodies.{b}.mesh.block.size"));
    let text = varied(IN_SPACE, &[With(&sizes[0], "125 m"), With(&sizes[1], "125 m")]);
    let AnyPlan::Three(plan) = dynamics::plan(&scene::read(&text).unwrap()).unwrap() else { panic!() };
    // 24 576 cells of one shape in each of two bodies; matrices of their own would take 113 MB.
    assert_eq!(plan.stable.highest.kept, 2 * 24 * 24);
    assert!(plan.memory_bytes < 80_000_000, "{}", plan.memory_bytes);
}

/// Slip at the station at the end of a run of the rupture that pulses start, without a patch.
fn slip_at_the_end(changes: &[Change<'_>]) -> f64 {
    let changes = [
        [Without("faults.main.patches"), With("faults.main.pulses[0].traction", "16 MPa")].as_slice(),
        changes,
    ]
    .concat();
    let folder = folder(&varied(SCENE, &changes));
    let done = run(folder.path(), "out", &["--no-plots"]);
    assert!(done.status.success(), "{}", told(&done));
    let report = fs::read_to_string(folder.path().join("out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert!(report["energy"]["imbalance"].as_f64().unwrap() < 1e-10, "{report}");
    let station = fs::read_to_string(folder.path().join("out/stations/main_000")).unwrap();
    station.lines().last().unwrap().split(' ').nth(1).unwrap().parse().unwrap()
}

#[test]
fn bodies_that_could_flow_or_turn_and_do_not_rupture_as_elastic_ones_and_are_damped_alike() {
    let elastic = slip_at_the_end(&[]);
    assert!(elastic > 0.3, "{elastic}");
    let stressed = [
        Without("faults.main.normal"),
        Without("faults.main.shear"),
        Add("bodies.A.initial_stress", "[\"-120 MPa\", \"-120 MPa\", 0, \"70 MPa\", 0, 0]"),
    ];
    let yielding = Add("materials.rock.plasticity", "{ hardening = \"perfect\", yield = \"5 GPa\" }");
    let plastic = slip_at_the_end(&[stressed.as_slice(), &[yielding]].concat());
    let flowing = slip_at_the_end(&[Add("materials.rock.viscosity", "1e22")]);
    // Flow in 2 s of a relaxation time of 1e22 Pa s/32 GPa.
    assert!((flowing / elastic - 1.0).abs() < 1e-9, "{flowing} {elastic}");
    // The forces of the initial stress, which are taken off, err by some ulps.
    assert!((plastic / elastic - 1.0).abs() < 1e-9, "{plastic} {elastic}");
    // Strains are 2e-4.
    let turning = slip_at_the_end(&[Add("bodies.A.strain", "finite")]);
    assert!((turning / elastic - 1.0).abs() < 2e-3, "{turning} {elastic}");
    let undamped = slip_at_the_end(&[Add("materials.rock.viscosity", "1e22"), Add("time.viscosity", "0.0")]);
    assert!((undamped / elastic - 1.0).abs() > 1e-4, "{undamped} {elastic}");
}

#[test]
fn a_plastic_body_under_its_initial_stress_rests() {
    let at_rest = plan(&[
        Without("faults.main.patches"),
        Without("faults.main.pulses"),
        Without("faults.main.normal"),
        Without("faults.main.shear"),
        Add("bodies.A.initial_stress", "[\"-120 MPa\", \"-120 MPa\", \"70 MPa\"]"),
        Add("materials.rock.plasticity", "{ hardening = \"perfect\", yield = \"200 MPa\" }"),
    ]);
    let mut explicit = asperity_mechanics::dynamics::Explicit::new(&at_rest.problem).unwrap();
    explicit.begin_stage(0).unwrap();
    for _ in 0..50 {
        explicit.step().unwrap();
    }
    // An elastic body would strain by 1e-3 if nothing held this stress, and move by meters.
    let most = explicit.displacement().iter().fold(0.0_f64, |most, u| most.max(u.abs()));
    assert!(most < 1e-9, "{most}");
}

#[test]
fn the_report_says_what_a_cell_costs_and_what_sets_the_step() {
    let folder = folder(SCENE);
    let done = run(folder.path(), "out", &["--no-plots"]);
    let said = text(&done.stdout);
    assert!(said.contains(" ns a cell and step"), "{said}");
    // 20 ms are 0.83 of a step at `courant`: two steps.
    let reason = "of the largest stable one: `courant` = 0.5 at most, and 2 whole steps between samples";
    assert!(said.contains(reason), "{said}");
}

/// A bar of steel, ν = 0, whose end is drawn at a rate: the wave strains it by the rate over c = 5 km/s.
fn drawn(rate: &str, strain: &str) -> String {
    format!(
        r#"
schema = 1
title = "a bar that is drawn"
kinematics = "plane-strain"
[materials.steel]
young = "200 GPa"
poisson = 0
density = 8000
[bodies.bar]
mesh.block = {{ min = [0, 0], max = [2, "20 mm"], divisions = [100, 1], element = "quad4" }}
material = "steel"
strain = "{strain}"
[[stages]]
name = "drawn"
duration = "300 us"
conditions = [{{ set = "bar.right", x = {{ rate = "{rate}" }} }}, {{ set = "bar.bottom", symmetry = true }}]
[time]
stepper = "explicit"
"#
    )
}

#[test]
fn strains_of_waves_that_are_not_small_are_told() {
    let warnings = |rate: &str, strain: &str| {
        let folder = folder(&drawn(rate, strain));
        let done = run(folder.path(), "out", &["--no-plots"]);
        assert!(done.status.success(), "{}", told(&done));
        let report = fs::read_to_string(folder.path().join("out/report.json")).unwrap();
        let said = text(&done.stderr).contains("warning: body `bar` is strained by 0.0");
        (said, report.contains("body `bar` is strained by 0.0"))
    };
    assert_eq!(warnings("400 m/s", "small"), (true, true));
    assert_eq!(warnings("100 m/s", "small"), (false, false));
    assert_eq!(warnings("400 m/s", "finite"), (false, false));
}
