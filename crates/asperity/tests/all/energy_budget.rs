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
mesh.block = { min = ["20 mm", 0], max = ["40 mm", "10 mm"], size = "4 mm", element = "quad4" }
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
            let scene = varied(&varied(SLIDE, space), own);
            let (report, record) = simulate(&scene);
            let friction = part(&report, "friction");
            // Points begin to slip up to the shear of the block behind its drawn side, 0.1 um of 1 mm.
            close(friction, MU * PRESSURE * area * SLID, 1e-3);
            assert_eq!(report.results[1].friction_work, friction);
            let end = &record.stage_ends()[1].interfaces[0];
            let sum: f64 = end.friction_work.iter().zip(&end.area).map(|(work, area)| work * area).sum();
            // Areas of mortar interfaces follow the overlap, and the sum has the last ones.
            close(sum, friction, 1e-6);
            // One step of 20 has the way on which points begin to slip; the rest is uniform.
            assert!(report.energy.imbalance < 1e-3, "{own:?} {:?}", report.energy);
        }
    }
}

#[test]
fn both_paths_have_one_budget() {
    for own in [&[][..], &[MORTAR]] {
        let (condensed, full) =
            (simulate(&varied(SLIDE, own)).0, simulate(&varied(&varied(SLIDE, own), &[FULL])).0);
        assert_ne!(condensed.plan, full.plan);
        for name in ["elastic", "contact", "friction", "loads", "motions"] {
            close(part(&condensed, name), part(&full, name), 1e-6);
        }
        // The side drawn in the second stage was held in the first: nothing jumps.
        for report in [condensed, full] {
            assert!(
                part(&report, "unbalanced").abs() < 1e-6 * part(&report, "motions"),
                "{:?}",
                report.energy
            );
        }
    }
}

#[test]
fn a_support_that_goes_loses_what_it_held_on_both_paths() {
    // The block is pressed by its upper side, which the second stage lets go.
    let press =
        r#"[{ set = "plate.bottom", x = 0, y = 0 }, { set = "block.top", x = 0, y = { to = "-1 um" } }]"#;
    let away = r#"[{ set = "plate.bottom", x = 0, y = 0 }, { set = "block.top", x = 0 }]"#;
    let still = With("stages[1].conditions", away);
    let changes = [With("stages[0].conditions", press), still];
    for own in [&[][..], &[FULL]] {
        let scene = varied(&varied(SLIDE, &changes), own);
        let (report, record) = simulate(&scene);
        let (start, end) = (energy_at(&record, 3), &report.energy);
        assert!(start.0 > 0.0 && part(&report, "elastic") < 1e-3 * start.0, "{end:?}");
        // The penalties and the bodies lose all they had.
        close(part(&report, "unbalanced"), start.0 + start.1, 1e-2);
        assert!(end.imbalance < 1e-2, "{end:?}");
    }
}

/// Elastic energy of bodies and penalties after a step.
fn energy_at(record: &asperity_output::bodies::Recorder, step: usize) -> (f64, f64) {
    (record.energy("elastic").unwrap()[step], record.energy("contact").unwrap()[step])
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
    for stepper in ["implicit", "static-explicit"] {
        let (report, _) = simulate(&varied(STRETCH, &[With("time.stepper", stepper)]));
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
        r#"{ hardening = "swift", yield = "200 MPa", strain = 1e-3, exponent = 0.2 }"#,
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
