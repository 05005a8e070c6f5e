//! Energy budgets of bodies that pass through states of equilibrium, against closed forms.

use crate::common::{close, simulate, varied};
use asperity::kinds::bodies::RunReport;
use asperity_vary::Change::{self, Add, With};

const PRESSURE: f64 = 1e6;
const MU: f64 = 0.4;
const SLID: f64 = 1e-3;

/// A block under a pressure of 1 MPa that is drawn along a plate by 1 mm.
const SLIDE: &str = r#"
schema = 1
title = "a block that slides under a pressure"
kinematics = "plane-strain"
[materials.steel]
young = "200 GPa"
poisson = 0.3
[bodies.plate]
material = "steel"
mesh.block = { min = [0, "-10 mm"], max = ["60 mm", 0], size = "5 mm", element = "quad4" }
[bodies.block]
material = "steel"
mesh.block = { min = ["20 mm", 0], max = ["40 mm", "10 mm"], divisions = [6, 3], element = "quad4" }
[interfaces.joint]
slave = "block.bottom"
master = "plate.top"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "coulomb", mu = 0.4 }
[[stages]]
name = "press"
duration = "1 s"
steps = 4
conditions = [
    { set = "plate.bottom", x = 0, y = 0 },
    { set = "block.top", pressure = { to = "1 MPa" } },
    { set = "block.left", x = 0 },
]
[[stages]]
name = "slide"
duration = "1 s"
steps = 20
conditions = [
    { set = "plate.bottom", x = 0, y = 0 },
    { set = "block.top", pressure = "1 MPa" },
    { set = "block.left", x = { to = "1 mm" } },
]
[time]
stepper = "implicit"
"#;

const SPACE: &[Change<'_>] = &[
    With("kinematics", "3d"),
    With("bodies.plate.mesh.block.min", r#"[0, "-10 mm", 0]"#),
    With("bodies.plate.mesh.block.max", r#"["60 mm", 0, "10 mm"]"#),
    With("bodies.plate.mesh.block.element", "hex8"),
    With("bodies.block.mesh.block.min", r#"["20 mm", 0, 0]"#),
    With("bodies.block.mesh.block.max", r#"["40 mm", "10 mm", "10 mm"]"#),
    With("bodies.block.mesh.block.element", "hex8"),
    With("bodies.block.mesh.block.divisions", "[6, 3, 3]"),
    Add("stages[0].conditions[0].z", "0"),
    Add("stages[0].conditions[2].z", "0"),
    Add("stages[1].conditions[0].z", "0"),
    Add("stages[1].conditions[2].z", "0"),
];
const MORTAR: Change<'_> = With("interfaces.joint.measure", "mortar");
const FINITE: Change<'_> = With("interfaces.joint.sliding", "finite");
const FULL: Change<'_> = Add("time.path", "full");
const PLASTIC: Change<'_> =
    Add("materials.steel.plasticity", r#"{ hardening = "linear", yield = "1 MPa", modulus = "20 GPa" }"#);

fn part(report: &RunReport, name: &str) -> f64 {
    report.energy.part(name)
}

#[test]
fn a_block_that_slides_dissipates_friction_times_pressure_times_area_times_way() {
    let plane: &[Change<'_>] = &[];
    for (space, area) in [(plane, 0.02), (SPACE, 0.02 * 0.01)] {
        for own in [&[][..], &[MORTAR], &[FINITE], &[MORTAR, FINITE], &[FULL], &[PLASTIC, FINITE]] {
            let (report, record) = simulate(&changed(&[space, own]));
            let friction = part(&report, "friction");
            // Points begin to slip after the shear of the block behind its drawn side, some 0.1 um of 1 mm.
            // Points of a mortar interface that slides far change their areas and tractions in each step.
            let bound = if own == [MORTAR, FINITE] { 3e-3 } else { 1e-4 };
            close(friction, MU * PRESSURE * area * SLID, bound);
            assert_eq!(report.results[1].friction_work, friction);
            let end = &record.stage_ends()[1].interfaces[0];
            let sum: f64 = end.friction_work.iter().zip(&end.area).map(|(work, area)| work * area).sum();
            // Areas of mortar interfaces follow the overlap, and this sum has the last ones.
            close(sum, friction, bound);
            // The first of 20 steps has the way on which all points begin to slip: its works miss half of what it dissipates.
            let first = friction / 20.0;
            let missing = -report.energy.missing;
            assert!(missing > 0.2 * first && missing < 0.51 * first, "{missing:e} {first:e}");
        }
    }
}

#[test]
fn a_way_and_back_dissipates_twice_although_slip_turns_within_a_step() {
    let back = r#"{ table = [[0, 0], [0.5, "1 mm"], [1, 0]] }"#;
    let (report, record) = simulate(&varied(SLIDE, &[With("stages[1].conditions[2].x", back)]));
    close(part(&report, "friction"), 2.0 * MU * PRESSURE * 0.02 * SLID, 1e-3);
    let friction = record.energy("friction").unwrap();
    assert!(friction.windows(2).all(|pair| pair[1] >= pair[0]), "{friction:?}");
}

/// The sliding block with changes.
fn changed(changes: &[&[Change<'_>]]) -> String {
    let parts = changes.iter().filter(|part| !part.is_empty());
    parts.fold(SLIDE.to_string(), |scene, part| varied(&scene, part))
}

#[test]
fn a_sleeve_that_slides_on_a_shaft_dissipates_friction_on_its_whole_round() {
    let round = [
        With("kinematics", "axisymmetric"),
        With("bodies.plate.mesh.block.min", r#"[0, 0]"#),
        With("bodies.plate.mesh.block.max", r#"["10 mm", "60 mm"]"#),
        With("bodies.block.mesh.block.min", r#"["10 mm", "20 mm"]"#),
        With("bodies.block.mesh.block.max", r#"["20 mm", "40 mm"]"#),
        With("bodies.block.mesh.block.divisions", "[3, 6]"),
        With("interfaces.joint.slave", "block.left"),
        With("interfaces.joint.master", "plate.right"),
        With(
            "stages[0].conditions",
            r#"[{ set = "plate.bottom", y = 0 }, { set = "block.right", pressure = { to = "1 MPa" } }, { set = "block.top", y = 0 }]"#,
        ),
        With(
            "stages[1].conditions",
            r#"[{ set = "plate.bottom", y = 0 }, { set = "block.right", pressure = "1 MPa" }, { set = "block.top", y = { to = "1 mm" } }]"#,
        ),
    ];
    let (report, record) = simulate(&varied(SLIDE, &round));
    let pressed = &record.stage_ends()[0].interfaces[0];
    let area: f64 = pressed.area.iter().sum();
    close(area, std::f64::consts::TAU * 0.01 * 0.02, 1e-9);
    // Friction that pulls the sleeve lengthens it, which changes its grip once.
    let slid = &record.stage_ends()[1].interfaces[0];
    let normal: f64 = slid.area.iter().zip(&slid.normal_traction).map(|(a, f)| a * f).sum();
    close(part(&report, "friction"), MU * normal * SLID, 2e-3);
    assert_eq!(report.energy.unit, "J");
}

#[test]
fn both_paths_have_one_budget() {
    for own in [&[][..], &[MORTAR]] {
        let (condensed, full) = (simulate(&changed(&[own])).0, simulate(&changed(&[own, &[FULL]])).0);
        for name in ["elastic", "contact", "friction", "loads", "motions"] {
            close(part(&condensed, name), part(&full, name), 1e-6);
        }
        // The side drawn in the second stage was held in the first: nothing jumps.
        for report in [condensed, full] {
            assert!(
                part(&report, "unbalanced").abs() < 1e-9 * part(&report, "motions"),
                "{:?}",
                report.energy
            );
        }
    }
}

#[test]
fn a_support_that_goes_loses_what_it_held_on_both_paths() {
    // The block is pressed by its upper side, which a load takes over and leaves at once.
    let press =
        r#"[{ set = "plate.bottom", x = 0, y = 0 }, { set = "block.top", x = 0, y = { to = "-1 um" } }]"#;
    let less = r#"[{ set = "plate.bottom", x = 0, y = 0 }, { set = "block.top", x = 0, y = "free", pressure = "1 kPa" }]"#;
    let changes = [
        With("stages[0].conditions", press),
        With("stages[1].conditions", less),
        Change::Without("interfaces.joint.law"),
        Change::Without("interfaces.joint.enforcement.tangential"),
    ];
    for own in [&[][..], &[FULL]] {
        let (report, record) = simulate(&changed(&[&changes, own]));
        let held: f64 = ["elastic", "contact"].into_iter().map(|name| record.energy(name).unwrap()[3]).sum();
        assert!(held > 0.0 && part(&report, "elastic") < 1e-3 * held, "{:?}", report.energy);
        // The load does next to no work on the way back: bodies lose what they had.
        close(part(&report, "unbalanced"), held, 1e-2);
        assert!(report.energy.imbalance < 1e-6, "{:?}", report.energy);
    }
}

const YOUNG: f64 = 200e9;
const YIELD: f64 = 200e6;
const STRAIN: f64 = 4e-3;

/// A bar of 1 m in plane stress that is stretched beyond its yield stress.
const STRETCH: &str = r#"
schema = 1
title = "a bar that yields"
kinematics = "plane-stress"
[materials.steel]
young = "200 GPa"
poisson = 0.3
plasticity = { hardening = "perfect", yield = "200 MPa" }
[bodies.bar]
material = "steel"
mesh.block = { min = [0, 0], max = ["1 m", "0.1 m"], divisions = [4, 1], element = "quad4" }
[[stages]]
name = "pull"
duration = "1 s"
steps = 8
conditions = [
    { set = "bar.left", x = 0 },
    { set = "bar.bottom", y = 0 },
    { set = "bar.right", x = { to = "4 mm" } },
]
[time]
stepper = "implicit"
"#;

#[test]
fn a_bar_that_yields_dissipates_its_yield_stress_times_its_plastic_strain() {
    let elastic = YIELD / YOUNG;
    let exact = [0.5 * YIELD * elastic, YIELD * (STRAIN - elastic), YIELD * (STRAIN - 0.5 * elastic)]
        .map(|w| 0.1 * w);
    for scene in [STRETCH.to_string(), varied(STRETCH, &[With("time.stepper", "static-explicit")])] {
        let (report, _) = simulate(&scene);
        for (name, exact) in ["elastic", "plastic", "motions"].into_iter().zip(exact) {
            // The bar yields at the end of the second of eight steps.
            close(part(&report, name), exact, 1e-6);
        }
        assert!(report.energy.imbalance < 1e-6, "{:?}", report.energy);
        assert_eq!(report.energy.unit, "J");
    }
}

#[test]
fn what_a_budget_misses_falls_with_the_square_of_the_steps() {
    let harden = With(
        "materials.steel.plasticity",
        r#"{ hardening = "power", yield = "200 MPa", strain = 1e-3, exponent = 0.2 }"#,
    );
    let missed = |steps: &str| {
        simulate(&varied(STRETCH, &[harden, With("stages[0].steps", steps)])).0.energy.missing.abs()
    };
    let (coarse, fine) = (missed("20"), missed("80"));
    assert!(fine > 0.0 && coarse / fine > 12.0, "{coarse:e} {fine:e}");
}

#[test]
fn a_bar_that_relaxes_turns_its_elastic_energy_into_heat() {
    let relaxing = [
        With("kinematics", "plane-strain"),
        Change::Without("materials.steel.plasticity"),
        Add("materials.steel.viscosity", "1e11 Pa s"),
        With("stages[0].steps", "200"),
        Change::Push(
            "stages",
            r#"{ name = "hold", duration = "20 s", steps = 400, conditions = [{ set = "bar.left", x = 0 }, { set = "bar.bottom", y = 0 }, { set = "bar.right", x = "hold" }] }"#,
        ),
    ];
    let (report, _) = simulate(&varied(STRETCH, &relaxing));
    assert!(part(&report, "viscous") > 0.5 * part(&report, "motions"), "{:?}", report.energy);
    // The trapezoidal rule over steps of a twentieth of the time of relaxation.
    assert!(report.energy.imbalance < 1e-3, "{:?}", report.energy);
}
