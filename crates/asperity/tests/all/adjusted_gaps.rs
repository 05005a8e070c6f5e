//! Start gaps that a scene sets, against closed forms.

use crate::common::{planned, simulate, varied};
use asperity_output::bodies::view::InterfaceFields;
use asperity_plan::bodies::AnyPlan;
use asperity_vary::Change::{self, Add, With};

const ENFORCEMENTS: [&str; 2] = [
    "{ kind = \"penalty\", normal = \"100 E/h\" }",
    "{ kind = \"augmented-lagrangian\", normal = \"1 E/h\" }",
];

/// Two columns under uniaxial strain, which a press moves by 9 um, by 10 um and by 25 um. `gap` is that of the meshes.
struct Columns {
    kinematics: &'static str,
    gap: f64,
    key: &'static str,
    measure: &'static str,
    sliding: &'static str,
    enforcement: &'static str,
    stepper: &'static str,
}

const YOUNG: f64 = 10e9;
/// Young's modulus over that of uniaxial strain at a Poisson ratio of 0.25.
const SOFTER: f64 = 1.25 * 0.5 / 0.75;

impl Columns {
    fn text(&self) -> String {
        let Self { kinematics, gap, key, measure, sliding, enforcement, stepper } = self;
        let space = *kinematics == "3d";
        let [from, to, element] = if space { [", 0", ", 2", "hex8"] } else { ["", "", "quad4"] };
        let divisions = |x: usize| if space { format!("{x}, 1, {x}") } else { format!("{x}, 1") };
        let sides = |body: &str| {
            let names: &[&str] = match *kinematics {
                "3d" => &["left", "right", "back", "front"],
                // The left side is the axis.
                "axisymmetric" => &["right"],
                _ => &["left", "right"],
            };
            let held = names.iter().map(|side| format!("{{ set = \"{body}.{side}\", symmetry = true }},\n"));
            held.collect::<String>()
        };
        format!(
            "schema = 1\ntitle = \"columns\"\nkinematics = \"{kinematics}\"\n[materials.rock]\nyoung = {YOUNG}\npoisson = 0.25\n\
             [bodies.lower]\nmaterial = \"rock\"\n\
             mesh.block = {{ min = [0, -1{from}], max = [2, 0{to}], divisions = [{}], element = \"{element}\" }}\n\
             [bodies.upper]\nmaterial = \"rock\"\n\
             mesh.block = {{ min = [0, {gap}{from}], max = [2, {}{to}], divisions = [{}], element = \"{element}\" }}\n\
             [interfaces.joint]\nslave = \"upper.bottom\"\nmaster = \"lower.top\"\nmeasure = \"{measure}\"\nsliding = \"{sliding}\"\n\
             enforcement = {enforcement}\n{key}\n\
             [[stages]]\nname = \"near\"\nduration = 1\nsteps = 1\nconditions = [\n{}{}{{ set = \"lower.bottom\", y = 0 }},\n\
             {{ set = \"upper.top\", y = {{ to = \"-9 um\" }} }} ]\n\
             [[stages]]\nname = \"at\"\nduration = 1\nsteps = 1\nconditions = [{{ set = \"upper.top\", y = {{ to = \"-10 um\" }} }}]\n\
             [[stages]]\nname = \"beyond\"\nduration = 1\nsteps = 3\nconditions = [{{ set = \"upper.top\", y = {{ to = \"-25 um\" }} }}]\n\
             [time]\nstepper = \"{stepper}\"\n",
            // Forces of node-to-point contact are uniform where meshes match.
            divisions(if *measure == "mortar" { 3 } else { 2 }),
            gap + 1.0,
            divisions(2),
            sides("lower"),
            sides("upper"),
        )
    }

    /// Fields at the ends of the stages.
    fn ends(&self) -> Vec<InterfaceFields> {
        let (_, record) = simulate(&self.text());
        record.stage_ends().iter().map(|end| end.interfaces[0].clone()).collect()
    }

    /// Pressure of columns of height 1 and a penalty that approach by `closed` \[m\].
    fn pressure(&self, closed: f64) -> f64 {
        // The size h of a cell is that of the slave side.
        let penalty = if self.enforcement.contains("\"penalty\"") { 1.0 / (100.0 * YOUNG) } else { 0.0 };
        closed / (2.0 * SOFTER / YOUNG + penalty)
    }
}

/// Columns of every kind with a gap of the meshes and a key.
fn every(gap: f64, key: &'static str, check: impl Fn(&Columns)) {
    for kinematics in ["plane-strain", "axisymmetric", "3d"] {
        for (measure, sliding) in [
            ("mortar", "small"),
            ("mortar", "finite"),
            ("node-to-point", "small"),
            ("node-to-point", "finite"),
        ] {
            for (enforcement, stepper) in [
                (ENFORCEMENTS[0], "implicit"),
                (ENFORCEMENTS[1], "implicit"),
                (ENFORCEMENTS[0], "static-explicit"),
            ] {
                check(&Columns { kinematics, gap, key, measure, sliding, enforcement, stepper });
            }
        }
    }
}

/// Share by which a pressure may err: the gaps of 10 um are differences of lengths of 1 m.
const EXACT: f64 = 1e-9;

fn assert_pressed(columns: &Columns, fields: &InterfaceFields, closed: f64) {
    let wanted = columns.pressure(closed);
    for p in &fields.normal_traction {
        assert!(
            (p - wanted).abs() <= EXACT * columns.pressure(10e-6),
            "{p} for {wanted}\n{}",
            columns.text()
        );
    }
}

#[test]
fn blocks_with_a_clearance_close_when_they_have_approached_by_it() {
    for gap in [0.0, 0.02, -0.02] {
        every(gap, "clearance = \"10 um\"", |columns| {
            let ends = columns.ends();
            assert_pressed(columns, &ends[0], 0.0);
            assert!(ends[0].gap.iter().all(|g| (g - 1e-6).abs() < 1e-14), "{:?}", ends[0].gap);
            assert_pressed(columns, &ends[1], 0.0);
            assert_pressed(columns, &ends[2], 15e-6);
        });
    }
}

#[test]
fn adjusted_blocks_are_in_contact_from_the_start() {
    for gap in [0.02, -0.02] {
        every(gap, "adjust = \"to-contact\"", |columns| {
            let ends = columns.ends();
            assert_pressed(columns, &ends[0], 9e-6);
            assert_pressed(columns, &ends[2], 25e-6);
        });
    }
}

#[test]
fn adjusted_blocks_carry_their_initial_stress_from_the_start() {
    for (enforcement, measure) in ENFORCEMENTS.into_iter().zip(["mortar", "node-to-point"]) {
        // Farther apart than what counts as closed without an adjustment, a tenth of the element size.
        let (kinematics, gap, key) = ("plane-strain", 0.2, "adjust = \"to-contact\"\ninitial_stress = true");
        let (sliding, stepper) = ("small", "implicit");
        let columns = Columns { kinematics, gap, key, measure, sliding, enforcement, stepper };
        let stress = ["lower", "upper"].map(|body| format!("bodies.{body}.initial_stress"));
        let pressed = stress.each_ref().map(|path| Add(path, "[\"-1 MPa\", \"-1 MPa\", 0]"));
        let text = varied(&columns.text(), &pressed);
        let plan = planned(&text);
        assert!(plan.summary().warnings.is_empty(), "{:?}", plan.summary().warnings);
        let (_, record) = simulate(&text);
        for p in &record.stage_ends()[0].interfaces[0].normal_traction {
            let wanted = 1e6 + columns.pressure(9e-6);
            assert!((p - wanted).abs() <= EXACT * wanted, "{p} for {wanted}");
        }
    }
}

#[test]
fn points_beside_the_master_are_moved_as_the_closest_that_faces_it() {
    let (kinematics, gap, key) = ("plane-strain", 0.02, "adjust = \"to-contact\"");
    let (sliding, stepper, enforcement) = ("finite", "implicit", ENFORCEMENTS[0]);
    for measure in ["mortar", "node-to-point"] {
        let text = Columns { kinematics, gap, key, measure, sliding, enforcement, stepper }.text();
        let beyond = varied(&text, &[With("bodies.upper.mesh.block.min[0]", "-2")]);
        let AnyPlan::Two(plan) = planned(&beyond) else { panic!("it is plane") };
        assert!(plan.summary.start_gaps[0].unpaired > 0, "{:?}", plan.summary.start_gaps);
        let shift = plan.problem.interfaces[0].shift.as_ref().unwrap();
        assert!(shift.iter().all(|s| (s - gap).abs() < 1e-12), "{shift:?}");
    }
}

/// A round body in a round bed of other facets, which overlap.
const BED: &str = r#"
schema = 1
title = "a round body in its bed"
kinematics = "plane-strain"
[materials.steel]
young = "200 GPa"
poisson = 0.3
[bodies.bed]
material = "steel"
mesh.block = { min = [-0.4, -0.5], max = [0.4, 0], divisions = [5, 2], element = "quad4", curves.top = { kind = "circle", radius = -1, apex = { x = 0 } } }
[bodies.body]
material = "steel"
mesh.block = { min = [-0.3, 0], max = [0.3, 0.5], divisions = [7, 2], element = "quad4", curves.bottom = { kind = "circle", radius = 1, apex = { x = 0 } } }
[interfaces.skin]
slave = "body.bottom"
master = "bed.top"
measure = "mortar"
sliding = "finite"
enforcement = { kind = "augmented-lagrangian", normal = "1 E/h", tangential = "1 E/h" }
law = { kind = "coulomb", mu = 0.2 }
[[stages]]
name = "rest"
duration = 1
steps = 2
conditions = [{ set = "bed.bottom", x = 0, y = 0 }, { set = "body.top", x = 0, y = 0 }]
[time]
stepper = "implicit"
"#;

const IN_SPACE: [Change<'_>; 7] = [
    With("kinematics", "3d"),
    With("bodies.bed.mesh.block.min", "[-0.4, -0.5, -0.4]"),
    With("bodies.bed.mesh.block.max", "[0.4, 0, 0.4]"),
    With("bodies.body.mesh.block.min", "[-0.3, 0, -0.3]"),
    With("bodies.body.mesh.block.max", "[0.3, 0.5, 0.3]"),
    Add("stages[0].conditions[0].z", "0"),
    Add("stages[0].conditions[1].z", "0"),
];
const CELLS: [Change<'_>; 6] = [
    With("bodies.bed.mesh.block.divisions", "[5, 1, 5]"),
    With("bodies.body.mesh.block.divisions", "[4, 1, 4]"),
    With("bodies.bed.mesh.block.element", "hex8"),
    With("bodies.body.mesh.block.element", "hex8"),
    With("bodies.bed.mesh.block.curves.top.apex", "{ x = 0, z = 0 }"),
    With("bodies.body.mesh.block.curves.bottom.apex", "{ x = 0, z = 0 }"),
];
const REVOLVED: [Change<'_>; 5] = [
    With("kinematics", "axisymmetric"),
    With("bodies.bed.mesh.block.min", "[0, -0.5]"),
    With("bodies.body.mesh.block.min", "[0, 0]"),
    With("bodies.bed.mesh.block.divisions", "[4, 2]"),
    With("bodies.body.mesh.block.divisions", "[5, 2]"),
];

#[test]
fn facets_of_one_curve_that_overlap_press_nothing_once_they_are_adjusted() {
    let space = [&IN_SPACE[..], &CELLS[..]].concat();
    for changes in [&[][..], &REVOLVED, &space] {
        let text = varied(BED, changes);
        let sides = [
            ("mortar", "small"),
            ("mortar", "finite"),
            ("node-to-point", "small"),
            ("node-to-point", "finite"),
        ];
        for (measure, sliding) in sides {
            let text = varied(
                &text,
                &[
                    Change::WithOrSame("interfaces.skin.measure", measure),
                    Change::WithOrSame("interfaces.skin.sliding", sliding),
                ],
            );
            let largest = |text: &str| {
                let (_, record) = simulate(text);
                let fields = &record.stage_ends().last().unwrap().interfaces[0];
                fields.normal_traction.iter().fold(0.0, |most: f64, p| most.max(p.abs()))
            };
            let pressed = largest(&text);
            assert!(pressed > 1e8, "{measure}, {sliding}: facets press with {pressed} Pa\n{text}");
            let adjusted = varied(&text, &[Add("interfaces.skin.adjust", "to-contact")]);
            // Gaps are rounded to the spacing of numbers of the size of the bodies.
            let rest = largest(&adjusted);
            assert!(rest <= 1e-12 * 200e9, "{measure}, {sliding}: {rest} Pa");
            let plan = planned(&adjusted);
            let [start] = &plan.summary().start_gaps[..] else { panic!("one interface") };
            assert!(start.adjusted > 0 && start.adjustment > 1e-4, "{start:?}");
            assert_eq!(start.gap, [0.0; 2]);
            let told = plan.summary().to_string();
            assert!(
                told.contains(&format!("gaps of {} nodes are adjusted by up to", start.adjusted)),
                "{told}"
            );
        }
    }
}
