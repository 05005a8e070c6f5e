//! Curved contact rotated, mirrored, in other units and cut along planes of symmetry.

pub mod bodies;
mod halves;

use super::texts::{BodyRun, simulate_in};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::Change::{self as Vary, Add, With};
use asperity_vary::SceneText;
use bodies::{Change, Grid, Side};
use std::path::PathBuf;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_invariance",
    readme: include_str!("README.md"),
    covers: &[Capability::ContactInvariance],
    quick: true,
    run,
};

/// Name of the measure in claims, its keys in the scene, and sliding.
const MEASURES: [(&str, &[Vary<'_>], &str); 5] = [
    ("node-to-point, small", &[], "small"),
    ("node-to-point", &[], "finite"),
    ("node-to-point, smoothed", &[Add("interfaces.contact.smoothing", "cubic")], "finite"),
    ("mortar, small", &[MORTAR], "small"),
    ("mortar", &[MORTAR], "finite"),
];
const MORTAR: Vary<'_> = With("interfaces.contact.measure", "mortar");

const ENFORCEMENTS: [(&str, &str); 3] = [
    ("penalty", "{ kind = \"penalty\", normal = \"100 E/h\", tangential = \"100 E/h\" }"),
    ("Uzawa", "{ kind = \"uzawa\", normal = \"30 E/h\", tangential = \"30 E/h\", penetration = \"1e-9 h\" }"),
    ("unknowns", "{ kind = \"augmented-lagrangian\", normal = \"1 E/h\", tangential = \"1 E/h\" }"),
];

/// Bound on the differences of normal tractions, shear tractions and forces, each over its largest value.
const BOUND: f64 = 1e-10;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for space in [false, true] {
        let [same, changes @ ..] = Change::all(space);
        for measure in MEASURES {
            for enforcement in ENFORCEMENTS {
                let reference = ComparableRun::new(space, measure, enforcement.1, &same)?;
                if !space && enforcement == ENFORCEMENTS[0] {
                    let svg = body_plots::recorded(&reference.done.record, "drag")?;
                    ledger.picture(
                        format!("Dragged, {}", measure.0),
                        svg,
                        "Mises stress at the end of stage “drag”.",
                    );
                }
                for change in &changes {
                    let found = ComparableRun::new(space, measure, enforcement.1, change)?;
                    let where_ = if space { "in space" } else { "in the plane" };
                    ledger
                        .claim(format!(
                            "largest change of tractions and forces, {}, {} by {}, {where_}",
                            change.name, measure.0, enforcement.0
                        ))
                        .value(found.differs(&reference))
                        .at_most(BOUND)
                        .between(&found.setting(), &reference.setting())
                        .evidence(Evidence::Exact, "the problem is the same")
                        .because(
                            "residuals end at 1e-11 of the largest force or below, and the last Newton step squares what is left; eight steps \
                             carry it on; integrals over overlaps do not depend on the order of a facet's nodes",
                        )
                        .why_not_tighter("positions times the penalty are rounded to 1e-12 of the tractions, differently in other axes")
                        .covers(&[Capability::ContactInvariance])
                        .cost(&found.done.cost)
                        .record();
                }
            }
        }
    }
    halves::run(ledger)
}

/// Results of a run in the axes and units of the original scene.
struct ComparableRun {
    done: BodyRun,
    normal: Vec<f64>,
    shear: Vec<f64>,
    forces: Vec<f64>,
}

impl ComparableRun {
    fn new(
        space: bool,
        (name, measure, sliding): (&str, &[Vary<'_>], &str),
        enforcement: &str,
        change: &Change,
    ) -> Result<Self, CaseError> {
        let text = scene(space, (measure, sliding), enforcement, change)?;
        let folder = write(space, change)?;
        let done = simulate_in(&text, &folder.to_string_lossy());
        std::fs::remove_dir_all(&folder)?;
        let done = done.map_err(|e| format!("{}, {name}, {enforcement}: {e}", change.name))?;
        let pascal = change.stress.recip();
        let end = &done.record.stage_end("drag").ok_or("no stage was completed")?.interfaces[0];
        let of = |t: &[f64]| t.iter().map(|t| t.abs() * pascal).collect();
        let (normal, shear) = (of(&end.normal_traction), of(&end.shear_traction));
        let newton = pascal / change.size.powi(if space { 2 } else { 1 });
        let forces = done.report.forces.iter();
        let forces = forces.flat_map(|f| change.back(f.value).map(|v| v * newton)).collect();
        Ok(Self { done, normal, shear, forces })
    }

    /// Scene and nodal positions.
    fn setting(&self) -> (&str, &[[f64; 3]]) {
        (&self.done.scene, &self.done.record.setup().mesh.nodes)
    }

    /// Largest difference, each quantity over its largest value.
    fn differs(&self, other: &Self) -> f64 {
        let kinds =
            [(&self.normal, &other.normal), (&self.shear, &other.shear), (&self.forces, &other.forces)];
        let worst = |(a, b): (&Vec<f64>, &Vec<f64>)| {
            let largest = b.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            a.iter().zip(b).map(|(a, b)| (a - b).abs() / largest).fold(0.0, f64::max)
        };
        kinds.into_iter().map(worst).fold(0.0, f64::max)
    }
}

fn scene(
    space: bool,
    (measure, sliding): (&[Vary<'_>], &str),
    enforcement: &str,
    change: &Change,
) -> Result<String, CaseError> {
    let axes = if space { "xyz" } else { "xy" };
    let motion = |v: [f64; 3]| {
        let each = axes.chars().zip(change.transform(v)).map(|(a, v)| format!("{a} = {{ to = {v:?} }}"));
        each.collect::<Vec<_>>().join(", ")
    };
    let held = axes.chars().map(|a| format!("{a} = 0")).collect::<Vec<_>>().join(", ");
    // With small sliding the pairs of points are fixed.
    let way = if sliding == "small" { 0.01 } else { 0.15 };
    let along = if space { 0.5 * way } else { 0.0 };
    let scene = SceneText::new(include_str!("scene.toml"))
        .with_or_same("materials.rock.young", 1e9 * change.stress)
        .with_or_same("kinematics", if space { "3d" } else { "plane-strain" })
        .changed(measure)
        .with_or_same("interfaces.contact.sliding", sliding)
        .with_or_same("interfaces.contact.enforcement", enforcement)
        .with("stages[0].conditions[0]", format!("{{ set = \"flat.bottom\", {held} }}"))
        .with("stages[0].conditions[1]", format!("{{ set = \"round.top\", {} }}", motion([0.0, -0.02, 0.0])))
        .with(
            "stages[1].conditions[0]",
            format!("{{ set = \"round.top\", {} }}", motion([way, -0.02, along])),
        );
    Ok(scene.text()?)
}

/// Writes both mesh files to a separate folder. No node of one body lies above an edge of the other.
fn write(space: bool, change: &Change) -> Result<PathBuf, CaseError> {
    let deep = |z: [f64; 2]| if space { z } else { [0.0; 2] };
    let (flat, round) = (deep([-0.57, 0.67]), deep([-0.35, 0.35]));
    let [flat, round] = [
        Grid {
            min: [-0.61, -0.4, flat[0]],
            max: [0.73, 0.0, flat[1]],
            cells: if space { [7, 2, 6] } else { [27, 8, 0] },
            sides: [Side::Flat; 2],
        },
        Grid {
            min: [-0.35, 0.0, round[0]],
            max: [0.35, 0.3, round[1]],
            cells: if space { [5, 2, 5] } else { [20, 8, 0] },
            sides: [Side::Round(1.0), Side::Flat],
        },
    ];
    let folder = std::env::temp_dir().join(format!("asperity-contact-invariance-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("flat.msh"), flat.file(change)?)?;
    std::fs::write(folder.join("round.msh"), round.file(change)?)?;
    Ok(folder)
}
