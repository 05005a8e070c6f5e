//! Bodies with initial gravitational stress, and interfaces with the corresponding initial tractions.

mod parted;
mod sheet;

use super::texts::{BodyRun, simulate_in};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "interface_prestress",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Loads,
        Capability::PenaltyContact2d,
        Capability::PenaltyContact3d,
        Capability::Mortar,
        Capability::Coulomb,
    ],
    quick: true,
    run,
};

const FOLDER: &str = "interface_prestress";
const BLOCKS: &str = include_str!("blocks.toml");
const WEDGE: &str = include_str!("wedge.toml");
const PRESSED: &str = include_str!("pressed.toml");
/// ρ g \[N/m3\].
const WEIGHT: f64 = 2700.0 * 9.81;
/// Horizontal over vertical stress.
const K0: f64 = 0.5;
/// Height of the blocks and of the cells at their interface \[m\].
const HEIGHT: f64 = 1000.0;
const CELL: f64 = 125.0;
/// Settlement of blocks without initial stress: ρ g H²/2 over the modulus of uniaxial strain \[m\].
const SETTLED: f64 = WEIGHT * HEIGHT * HEIGHT / 2.0 / (50e9 * 0.75 / (1.25 * 0.5));
/// Rounding of displacements \[m\]: forces of 1e10 N/m cancel to a relative 1e-15 at each node, and about a hundred nodes above
/// each other add up.
const ROUNDING: f64 = 1e-10;
const MOHR: &str =
    "stresses on Mohr's circle: f_n = v (cos² + K0 sin²), t = v (1 - K0) sin cos, v = rho g depth";

type Changes = &'static [Change<'static>];
const MORTAR: Change<'_> = With("interfaces.fault.measure", "mortar");
const FINITE: Change<'_> = With("interfaces.fault.sliding", "finite");
const EXPLICIT: Change<'_> = With("time.stepper", "static-explicit");
const UZAWA: [Change<'_>; 2] = [
    With("interfaces.fault.enforcement.kind", "uzawa"),
    Add("interfaces.fault.enforcement.penetration", "1e-6 h"),
];
const UNKNOWNS: Change<'_> = With("interfaces.fault.enforcement.kind", "augmented-lagrangian");
const LARGE: [Change<'_>; 2] = [Add("bodies.left.strain", "finite"), Add("bodies.right.strain", "finite")];
const QUAD8: [Change<'_>; 2] = [
    With("bodies.left.mesh.quadrilateral.element", "quad8"),
    With("bodies.right.mesh.quadrilateral.element", "quad8"),
];
const RATE: Change<'_> = With(
    "interfaces.fault.law",
    "{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.01, b = 0.005, l = \"1 mm\", v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\" }",
);
const SPACE: [Change<'_>; 6] = [
    With("kinematics", "3d"),
    Add("bodies.left.extrude", "[0, 250, 500]"),
    Add("bodies.right.extrude", "[0, 250, 500]"),
    With("bodies.left.gravity", "[0, -9.81, 0]"),
    With("bodies.right.gravity", "[0, -9.81, 0]"),
    With(
        "stages[0].conditions",
        "[{ set = \"left.back\", z = 0 }, { set = \"left.front\", z = 0 }, { set = \"right.back\", z = 0 }, \
          { set = \"right.front\", z = 0 }, { set = \"left.left\", x = 0 }, { set = \"right.right\", x = 0 }, \
          { set = \"left.bottom\", y = 0 }, { set = \"right.bottom\", y = 0 }]",
    ),
];

/// Variants, and whether tractions are nodal values (coefficients of a field) or means over tributary areas.
const PLANE: [(&str, Changes, bool); 14] = [
    ("node-to-point", &[], false),
    ("node-to-point, finite sliding", &[FINITE], false),
    ("mortar", &[MORTAR], false),
    ("mortar, finite sliding", &[MORTAR, FINITE], true),
    ("node-to-point, static-explicit", &[EXPLICIT], false),
    ("mortar, static-explicit", &[MORTAR, EXPLICIT], false),
    ("mortar, finite sliding, static-explicit", &[MORTAR, FINITE, EXPLICIT], true),
    ("node-to-point, Uzawa", &UZAWA, false),
    ("mortar, augmented Lagrangian", &[MORTAR, UNKNOWNS], false),
    ("node-to-point, finite strain", &LARGE, false),
    ("mortar, finite strain, static-explicit", &[MORTAR, LARGE[0], LARGE[1], EXPLICIT], false),
    ("mortar, quad8", &[MORTAR, QUAD8[0], QUAD8[1]], true),
    ("node-to-point, rate and state", &[RATE], false),
    ("mortar, rate and state, static-explicit", &[MORTAR, RATE, EXPLICIT], false),
];
const IN_SPACE: [(&str, Changes, bool); 5] = [
    ("node-to-point", &[], false),
    ("node-to-point, finite sliding", &[FINITE], false),
    ("mortar", &[MORTAR], false),
    ("mortar, finite sliding", &[MORTAR, FINITE], true),
    ("mortar, static-explicit", &[MORTAR, EXPLICIT], false),
];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    blocks(ledger)?;
    meshes_that_do_not_match(ledger)?;
    wedge(ledger)?;
    as_pressed_by_loads(ledger)?;
    parted::claims(ledger)?;
    sheet::claims(ledger)
}

/// Spurious motion of the parts at rest.
struct Rest {
    /// Largest displacement \[m\].
    moved: f64,
    /// Largest slip \[m\].
    slipped: f64,
    done: BodyRun,
}

fn rest(text: &str) -> Result<Rest, CaseError> {
    let done = simulate_in(text, FOLDER)?;
    let end = done.record.stage_end("rest").ok_or("the stage was not reached")?;
    let bodies = end.bodies.as_ref().ok_or("no fields")?;
    let size = |v: &[f64]| v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let moved = size(bodies.displacement.as_flattened());
    let slipped = size(&end.interfaces[0].slip);
    Ok(Rest { moved, slipped, done })
}

/// Depth that corresponds to the traction of a node \[m\].
fn depth(y: f64, at_nodes: bool) -> f64 {
    let ends = |y: f64| {
        if y > -1.0 {
            CELL / 3.0
        } else if y < 1.0 - HEIGHT {
            -CELL / 3.0
        } else {
            0.0
        }
    };
    if at_nodes { -y } else { -y + ends(y) }
}

/// Largest error of normal and shear tractions over the largest normal traction.
fn wrong(rest: &Rest, at_nodes: bool) -> f64 {
    let (sin, cos) = std::f64::consts::FRAC_PI_3.sin_cos();
    let (normal, shear) = (cos * cos + K0 * sin * sin, (1.0 - K0) * sin * cos);
    let points = &rest.done.record.histories()[0].points;
    let last = |v: &[f64]| v.last().copied().unwrap_or(f64::NAN);
    let errors = points.iter().map(|p| {
        let vertical = WEIGHT * depth(p.position[1], at_nodes);
        // The left block overhangs the right one and is driven down, along the tangent.
        let (f, t) =
            (last(&p.normal_traction) - normal * vertical, last(&p.shear_traction) - shear * vertical);
        f.abs().max(t.abs())
    });
    errors.fold(0.0, f64::max) / (normal * WEIGHT * HEIGHT)
}

fn blocks(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plane = PLANE.iter().map(|v| (v, false));
    let mut rows = Vec::new();
    let (mut moved, mut slipped, mut errors) = (0.0_f64, 0.0_f64, [0.0_f64; 2]);
    for ((name, changes, at_nodes), space) in plane.chain(IN_SPACE.iter().map(|v| (v, true))) {
        let scene = SceneText::new(BLOCKS).changed(if space { &SPACE } else { &[] });
        let rest = rest(&scene.changed(changes).text()?).map_err(|e| format!("{name}: {e}"))?;
        let error = wrong(&rest, *at_nodes);
        (moved, slipped) = (moved.max(rest.moved), slipped.max(rest.slipped));
        let kind = &mut errors[usize::from(changes.contains(&UNKNOWNS))];
        *kind = kind.max(error);
        let where_ = if space { "space" } else { "plane" };
        rows.push(vec![
            format!("{name}, {where_}"),
            format!("{:.1e}", rest.moved),
            format!("{:.1e}", rest.slipped),
            format!("{error:.1e}"),
        ]);
    }
    ledger.table(
        "At rest",
        &["contact", "displacement [m]", "slip [m]", "error of tractions over the largest"],
        rows,
    );
    let still = "nothing moves where stress, weight and tractions are in balance";
    ledger
        .claim("largest displacement of any of them over the settling without initial stress")
        .value(moved / SETTLED)
        .at_most(ROUNDING)
        .evidence(Evidence::Exact, still)
        .because("rounding of nodal forces, added up over the height")
        .why_not_tighter("rounding depends on the order of sums, which differs from measure to measure")
        .record();
    ledger
        .claim("largest slip of any of them over the settling without initial stress")
        .value(slipped / SETTLED)
        .at_most(ROUNDING)
        .evidence(Evidence::Exact, still)
        .because("shear over normal traction is 0.346, below mu = 0.6")
        .why_not_tighter("rounding depends on the order of sums, which differs from measure to measure")
        .record();
    ledger
        .claim("largest error of a normal or shear traction over the largest normal traction, but for multipliers as unknowns")
        .value(errors[0])
        .at_most(1e-8)
        .evidence(Evidence::Exact, MOHR)
        .because("a penalty of 100 E/h turns rounding of displacements into tractions of some 1e-9 of those of rest")
        .why_not_tighter("rounding depends on the order of sums, which differs from measure to measure")
        .record();
    ledger
        .claim("largest error of a normal or shear traction over the largest normal traction, multipliers as unknowns")
        .value(errors[1])
        .at_most(1e-6)
        .evidence(Evidence::Exact, MOHR)
        .because(
            "at the lower end both sides are held in y, so that one component of the traction is not determined: what regularises \
             it takes up rounding of gaps times 1e8",
        )
        .why_not_tighter("rounding depends on the order of sums")
        .record();
    Ok(())
}

/// Non-matching cells on the two sides of the interface.
fn meshes_that_do_not_match(ledger: &mut Ledger) -> Result<(), CaseError> {
    let refined = |own: usize, other: usize, changes: Changes| -> Result<Rest, CaseError> {
        let scene = SceneText::new(BLOCKS)
            .with_or_same("bodies.left.mesh.quadrilateral.divisions", format!("[6, {own}]"))
            .with("bodies.right.mesh.quadrilateral.divisions", format!("[6, {other}]"));
        rest(&scene.changed(changes).text()?)
    };
    let mut levels = Vec::new();
    for k in [1, 2, 4] {
        let found = refined(8 * k, 11 * k, &[MORTAR])?;
        levels.push((1.0 / k as f64, found.moved / SETTLED));
    }
    ledger
        .order("largest displacement over the settling without initial stress, mortar, 8 against 11 cells and finer")
        .levels(&levels)
        .expected(2.0)
        .within(0.5)
        .or_better()
        .because("forces on a master are off by the change of the traction over a cell times the size of the cell")
        .finest(1e-4, "dual functions transmit a uniform traction exactly, one that varies up to its change over a cell on an area of a cell")
        .evidence(Evidence::Exact, "nothing moves where stress, weight and tractions are in balance")
        .record();
    let exact = refined(8, 11, &[MORTAR, FINITE])?;
    ledger
        .claim("largest displacement over the settling without initial stress, mortar with finite sliding, 8 against 11 cells")
        .value(exact.moved / SETTLED)
        .at_most(ROUNDING)
        .evidence(Evidence::Exact, "its functions are the shape functions, which hold a traction that varies linearly")
        .because("rounding of nodal forces, added up over the height")
        .why_not_tighter("rounding depends on the order of sums")
        .record();
    Ok(())
}

fn wedge(ledger: &mut Ledger) -> Result<(), CaseError> {
    let relaxed = SceneText::new(WEDGE)
        .without("interfaces.fault.initial_stress")
        .without("bodies.base.initial_stress")
        .without("bodies.wedge.initial_stress");
    let settled = rest(&relaxed.text()?)?;
    ledger
        .claim("displacement of a wedge that starts without stress (how far it settles otherwise)")
        .unit("m")
        .value(settled.moved)
        .at_least(1.0)
        .evidence(
            Evidence::Exact,
            "rho g H²/2M of 6 km is 8 m, and more than an eighth of it is left on a slope",
        )
        .because("shows that the scene would move")
        .why_not_tighter("the number means nothing")
        .record();
    for (name, changes) in [
        ("node-to-point", &[][..]),
        ("mortar", &[MORTAR][..]),
        ("node-to-point, static-explicit", &[EXPLICIT][..]),
    ] {
        let still = rest(&SceneText::new(WEDGE).changed(changes).text()?)?;
        ledger
            .claim(format!(
                "largest slip or displacement of a wedge over its settling without initial stress, {name}"
            ))
            .value(still.moved.max(still.slipped) / settled.moved)
            .at_most(ROUNDING)
            .evidence(Evidence::Exact, "nothing moves where stress, weight and tractions are in balance")
            .because("rounding of nodal forces, added up over the height")
            .why_not_tighter("rounding depends on the order of sums")
            .record();
    }
    Ok(())
}

/// Claims that tractions from initial stress act like tractions from loads in later stages.
fn as_pressed_by_loads(ledger: &mut Ledger) -> Result<(), CaseError> {
    // Uniaxial strain under 5 MPa: the lateral stress is nu/(1 - nu) times as large.
    let stress = format!("[{0:e}, -5e6, {0:e}, 0, 0, 0]", -5e6 / 3.0);
    let by_loads = SceneText::new(PRESSED);
    let by_stress = SceneText::new(PRESSED)
        .add("bodies.lower.initial_stress", &stress)
        .add("bodies.upper.initial_stress", &stress)
        .add("interfaces.fault.initial_stress", true)
        .with("stages[0].conditions[5].traction[1]", -5e6);
    let rounding = (1e-9, "the same equations for both, to rounding");
    let displaced = (
        1e-4,
        "finite sliding sees sides that the load has displaced at a strain of 4e-4, of which overlaps feel a part",
    );
    for (name, changes, (bound, because)) in [
        ("node-to-point", &[][..], rounding),
        ("mortar, finite sliding", &[MORTAR, FINITE][..], displaced),
        ("node-to-point, static-explicit", &[EXPLICIT][..], rounding),
    ] {
        let one = simulate_in(&by_stress.clone().changed(changes).text()?, FOLDER)?;
        let other = simulate_in(&by_loads.clone().changed(changes).text()?, FOLDER)?;
        let (a, b) = (one.contact("shear")?, other.contact("shear")?);
        ledger
            .claim(format!(
                "normal tractions after shear and less load, from a stress and from loads, {name}"
            ))
            .unit("Pa")
            .values(&a.normal_traction)
            .equals_each(&b.normal_traction)
            .between(&one.scene, &other.scene)
            .relative(bound)
            .evidence(Evidence::Exact, "linear bodies: the same blocks pressed by a load in a first stage")
            .because(because)
            .why_not_tighter("rounding and the share of the strain depend on the steps")
            .record();
        ledger
            .claim(format!("slip after shear and less load, from a stress and from loads, {name}"))
            .unit("m")
            .values(&a.slip)
            .equals_each(&b.slip)
            .between(&one.scene, &other.scene)
            .relative(bound)
            .evidence(Evidence::Exact, "linear bodies: the same blocks pressed by a load in a first stage")
            .because(because)
            .why_not_tighter("rounding and the share of the strain depend on the steps")
            .record();
        let open = one.contact("lift")?.status.iter().filter(|s| **s == 0).count();
        ledger
            .claim(format!("open points once lifted, {name}"))
            .count(open as u64, 5)
            .evidence(Evidence::Exact, "the top is lifted by 2 mm, and nothing holds the blocks together")
            .because("a count")
            .record();
    }
    Ok(())
}
