//! A pressed and sheared pair rotated as a whole: its contact forces rotate with it.

use super::texts::{BodyRun, simulate};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_rotation",
    readme: include_str!("README.md"),
    covers: &[Capability::FiniteSliding, Capability::FiniteStrain],
    quick: true,
    run,
};

const PLANE: &str = include_str!("scene.toml");
const SOLID: &str = include_str!("solid.toml");

/// A variant: its name, its changes to the scene, and its capability beyond those of the case.
type Variant = (&'static str, &'static [Change<'static>], Capability);

const MORTAR: Change<'_> = With("interfaces.contact.measure", "mortar");
const SMOOTHED: Change<'_> = Add("interfaces.contact.smoothing", "cubic");

const PLANE_VARIANTS: &[Variant] = &[
    ("flat segments", &[], Capability::PenaltyContact2d),
    (
        "quadratic segments",
        &[With("bodies.lower.mesh.block.element", "quad9"), With("bodies.upper.mesh.block.element", "quad9")],
        Capability::PenaltyContact2d,
    ),
    ("smoothed segments", &[SMOOTHED], Capability::PenaltyContact2d),
    ("mortar", &[MORTAR], Capability::Mortar),
    (
        "mortar, quad8 on tri6",
        &[
            MORTAR,
            With("bodies.lower.mesh.block.element", "tri6"),
            With("bodies.upper.mesh.block.element", "quad8"),
        ],
        Capability::Mortar,
    ),
];

const SOLID_VARIANTS: &[Variant] = &[
    ("bilinear segments", &[], Capability::PenaltyContact3d),
    (
        "biquadratic segments",
        &[With("bodies.lower.mesh.block.element", "hex27"), With("bodies.upper.mesh.block.element", "hex27")],
        Capability::PenaltyContact3d,
    ),
    ("smoothed segments", &[SMOOTHED], Capability::PenaltyContact3d),
    ("mortar", &[MORTAR], Capability::Mortar),
    ("mortar, tet10 on hex27", &TET10_ON_HEX27, Capability::Mortar),
    ("mortar, hex20 on tet10", &HEX20_ON_TET10, Capability::Mortar),
];

const TET10_ON_HEX27: [Change<'_>; 3] = [
    MORTAR,
    With("bodies.lower.mesh.block.element", "hex27"),
    With("bodies.upper.mesh.block.element", "tet10"),
];
const HEX20_ON_TET10: [Change<'_>; 3] = [
    MORTAR,
    With("bodies.lower.mesh.block.element", "tet10"),
    With("bodies.upper.mesh.block.element", "hex20"),
];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    for (text, axis, variants, space) in [
        (PLANE, [0.0, 0.0, 1.0], PLANE_VARIANTS, "in the plane"),
        (SOLID, [1.0, 2.0, 3.0], SOLID_VARIANTS, "in space"),
    ] {
        for &(name, changes, capability) in variants {
            let done = simulate(&SceneText::new(text).changed(changes).text()?)?;
            let what = format!("{name}, {space}");
            rows.push(total_form(ledger, &what, &done, axis, capability)?);
        }
    }
    ledger.table(
        "a full turn in 24 steps",
        &["segments", "largest deviation of the force", "of the tractions", "Newton iterations"],
        rows,
    );
    rate_form(ledger)
}

/// `v` rotated by `angle` about `axis`.
fn turned(v: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let size = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
    let a = axis.map(|c| c / size);
    let along: f64 = a.iter().zip(&v).map(|(a, v)| a * v).sum();
    let cross = [a[1] * v[2] - a[2] * v[1], a[2] * v[0] - a[0] * v[2], a[0] * v[1] - a[1] * v[0]];
    let (s, c) = angle.sin_cos();
    std::array::from_fn(|i| along * a[i] * (1.0 - c) + c * v[i] + s * cross[i])
}

fn size(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Largest |F - R F0|/|F0| over the steps of the rotation by `angle` \[rad\].
fn deviation(done: &BodyRun, axis: [f64; 3], angle: f64) -> Result<f64, CaseError> {
    let forces = done.force("contact")?;
    let first = done.steps_until("shear")?;
    let (start, times) = (forces[first - 1], done.record.times());
    let begin = times[first - 1];
    let each = forces[first..].iter().zip(&times[first..]).map(|(f, t)| {
        let expected = turned(start, axis, angle * (t - begin));
        size(std::array::from_fn(|i| f[i] - expected[i])) / size(start)
    });
    Ok(each.fold(0.0, f64::max))
}

fn total_form(
    ledger: &mut Ledger,
    what: &str,
    done: &BodyRun,
    axis: [f64; 3],
    capability: Capability,
) -> Result<[String; 4], CaseError> {
    let error = deviation(done, axis, 2.0 * std::f64::consts::PI)?;
    ledger
        .claim(format!("contact force against the turned force at every step, {what}"))
        .value(error)
        .at_most(1e-10)
        .evidence(Evidence::Exact, "a rigid motion of everything changes no force but its direction")
        .because(
            "gaps and slips are measured in frames that turn with the master, and the bodies turn their stress by a rotation \
             that is exact for rigid motion: Newton stops at 1e-11 of the largest force",
        )
        .why_not_tighter("the last Newton step squares the residual, and often leaves far less than its bound")
        .covers(&[capability, Capability::FiniteSliding, Capability::FiniteStrain])
        .cost(&done.cost)
        .record();
    let (before, after) = (done.contact("shear")?, done.contact("turn")?);
    let largest = before.normal_traction.iter().fold(0.0, |m: f64, t| m.max(*t));
    let values = |f: &asperity_output::bodies::view::InterfaceFields| -> Vec<f64> {
        f.normal_traction.iter().chain(&f.shear_traction).map(|t| t / largest).collect()
    };
    let (now, then) = (values(after), values(before));
    ledger
        .claim(format!("tractions at all slave nodes after a full turn, over the largest, {what}"))
        .values(&now)
        .equals_each(&then)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "a rigid motion of everything changes no traction")
        .because(
            "as above; a traction is penalty times gap, and the penalty of ten times E/h multiplies what Newton leaves of \
             displacements",
        )
        .why_not_tighter("as above")
        .covers(&[capability])
        .cost(&done.cost)
        .record();
    let traction = now.iter().zip(&then).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    Ok([
        what.to_owned(),
        format!("{error:.1e}"),
        format!("{traction:.1e}"),
        done.report.counts.operations.iterations.to_string(),
    ])
}

/// Forward steps with flat, smoothed and averaged segments.
fn rate_form(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, changes) in
        [("flat segments", None), ("smoothed segments", Some(SMOOTHED)), ("mortar", Some(MORTAR))]
    {
        quarter(ledger, name, changes)?;
    }
    Ok(())
}

/// A quarter turn in forward steps of one degree, the default of a scene.
fn quarter(ledger: &mut Ledger, name: &str, changes: Option<Change<'static>>) -> Result<(), CaseError> {
    let scene = SceneText::new(PLANE)
        .with("time.stepper", "static-explicit")
        .with("stages[2].conditions[0].rotate.by", "90 deg")
        .with("stages[2].conditions[1].rotate.by", "90 deg")
        .with("stages[2].steps", 90)
        .changed(changes.as_slice());
    let done = simulate(&scene.text()?)?;
    ledger
        .claim(format!("contact force against the turned force over a quarter of a turn, forward steps of a degree, {name}"))
        .value(deviation(&done, [0.0, 0.0, 1.0], std::f64::consts::FRAC_PI_2)?)
        .at_most(2e-4)
        .evidence(Evidence::Exact, "a rigid motion of everything changes no force but its direction")
        .because("a step leaves at most 1e-4 of the largest force out of balance")
        .why_not_tighter("the residual is measured at a node, the force is that of the whole face")
        .covers(&[Capability::StaticExplicit, Capability::FiniteSliding])
        .cost(&done.cost)
        .record();
    Ok(())
}
