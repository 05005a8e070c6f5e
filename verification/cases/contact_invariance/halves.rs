//! Halves and quarters between planes of symmetry against the whole.

use crate::cases::texts::{BodyRun, simulate};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_output::bodies::view::InterfaceFields;
use asperity_vary::SceneText;

/// Enforcements: one that holds a constraint softly, and one that holds it exactly.
const ENFORCEMENTS: [(&str, &str); 2] = [
    ("penalty", "{ kind = \"penalty\", normal = \"1e12 Pa/m\", tangential = \"1e12 Pa/m\" }"),
    ("unknowns", "{ kind = \"augmented-lagrangian\", normal = \"1 E/h\", tangential = \"1 E/h\" }"),
];

/// Bounds on the differences of tractions over the largest, with their reasons.
const BOUNDS: [(&str, f64, &str); 2] = [
    (
        "small",
        1e-8,
        "residuals end at 1e-11 of the largest force; a status that is decided by rounding changes a traction by the increment of a step that is left",
    ),
    (
        "finite",
        5e-3,
        "facets overlap along their own normals: beside the plane one that is tilted by 0.05 to 0.1 looks across it, over gaps of 0.01 m by a \
         two-hundredth of its 0.2 m, and the image is not there",
    ),
];

/// A part of a scene between planes of symmetry: the axes normal to them.
struct Part {
    name: &'static str,
    scene: &'static str,
    stage: &'static str,
    axes: &'static [usize],
}

const PARTS: [Part; 3] = [
    Part {
        name: "half in the plane, pressed",
        scene: include_str!("whole_plane.toml"),
        stage: "press",
        axes: &[0],
    },
    Part { name: "half in space, dragged", scene: include_str!("whole.toml"), stage: "drag", axes: &[2] },
    Part {
        name: "quarter in space, pressed",
        scene: include_str!("whole.toml"),
        stage: "press",
        axes: &[0, 2],
    },
];

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for part in PARTS {
        for (sliding, bound, why) in BOUNDS {
            for (enforced, enforcement) in ENFORCEMENTS {
                let scene = SceneText::new(part.scene)
                    .with_or_same("interfaces.contact.sliding", sliding)
                    .with_or_same("interfaces.contact.enforcement", enforcement);
                let whole = simulate(&scene.clone().text()?)?;
                let found = simulate(&part.cut(scene)?)?;
                ledger
                    .claim(format!("tractions of all nodes against those of the whole, {}, {sliding} sliding, {enforced}", part.name))
                    .value(part.differs(&found, &whole)?)
                    .at_most(bound)
                    .evidence(Evidence::Exact, "symmetry: the whole moves as its image does")
                    .because(why)
                    .why_not_tighter("gaps and tilts are what the load makes of them, and systems of other sizes round otherwise")
                    .covers(&[Capability::ContactInvariance, Capability::Mortar])
                    .cost(&found.cost)
                    .record();
            }
        }
    }
    Ok(())
}

impl Part {
    /// The part of the scene on the positive sides of the planes.
    fn cut(&self, mut scene: SceneText) -> Result<String, CaseError> {
        if self.stage == "press" && self.scene.contains("\"drag\"") {
            scene = scene.without("stages[1]");
        }
        for &axis in self.axes {
            let side = ["left", "", "back"][axis];
            for (body, cells) in [("slab", [8, 4]), ("round", [7, 3])] {
                let block = format!("bodies.{body}.mesh.block");
                let plane = axis == 0 && self.axes.len() == 1;
                scene = scene
                    .with(&format!("{block}.min[{axis}]"), 0)
                    .with(&format!("{block}.divisions[{axis}]"), cells[usize::from(!plane)])
                    .push("stages[0].conditions", format!("{{ set = \"{body}.{side}\", symmetry = true }}"));
            }
        }
        Ok(scene.text()?)
    }

    /// Largest difference of tractions at the nodes of the part, over the largest traction.
    fn differs(&self, part: &BodyRun, whole: &BodyRun) -> Result<f64, CaseError> {
        let places = |done: &BodyRun| done.record.setup().interfaces[0].positions.clone();
        let (own, all) = (part.contact(self.stage)?, whole.contact(self.stage)?);
        let others = places(whole);
        let largest = all.normal_traction.iter().fold(0.0, |most: f64, t| most.max(*t));
        let mut worst: f64 = 0.0;
        for (p, x) in places(part).iter().enumerate() {
            let same = |y: &[f64; 3]| x.iter().zip(y).all(|(a, b)| (a - b).abs() < 1e-9);
            let q = others.iter().position(same).ok_or("a node of the part is none of the whole")?;
            for (a, b) in traction(own, p).iter().zip(traction(all, q)) {
                worst = worst.max((a - b).abs() / largest);
            }
        }
        Ok(worst)
    }
}

/// Normal and shear traction of a point \[Pa\].
fn traction(fields: &InterfaceFields, p: usize) -> [f64; 4] {
    let shear = fields.shear_vector.get(p).copied().unwrap_or([fields.shear_traction[p], 0.0, 0.0]);
    [fields.normal_traction[p], shear[0], shear[1], shear[2]]
}
