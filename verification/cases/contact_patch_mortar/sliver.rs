//! A facet of which a master covers only a part: the gaps of its nodes are averages over that part.

use crate::cases::texts::simulate;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

/// Penalty \[Pa/m\].
const PENALTY: f64 = 1000.0;
/// Mean depth of the upper block in the lower one, and by how much it differs at the ends of the overlap \[m\].
const DEPTH: f64 = 0.01;
const TILT: f64 = 0.001;
/// Parts of the facet that are covered, along x and in space along z.
const COVERED: [f64; 3] = [0.5, 0.1, 0.01];

/// A block of one cell on a narrow one with a tilted top; all nodes where they meet are held.
fn blocks(covered: f64, space: bool, sliding: &str) -> SceneText {
    let (kinematics, still) = if space { ("3d", ", z = 0") } else { ("plane-strain", "") };
    let extrude = |to: f64| if space { format!("extrude = [0, {to:?}]") } else { String::new() };
    let (lower, upper) = (extrude(covered), extrude(1.0));
    let (low, high) = (1.0 - TILT, 1.0 + TILT);
    SceneText::new(&format!(
        r#"
schema = 1
title = "a facet that is covered in part"
kinematics = "{kinematics}"
[materials.stiff]
young = 1000
poisson = 0.3
[bodies.lower]
mesh.quadrilateral = {{ corners = [[0, 0], [{covered:?}, 0], [{covered:?}, {high:?}], [0, {low:?}]], divisions = [3, 1], element = "quad4" }}
material = "stiff"
{lower}
[bodies.upper]
mesh.quadrilateral = {{ corners = [[0, {high:?}], [1, {high:?}], [1, 2], [0, 2]], divisions = [1, 1], element = "quad4" }}
material = "stiff"
{upper}
[interfaces.contact]
slave = "upper.bottom"
master = "lower.top"
measure = "mortar"
sliding = "{sliding}"
enforcement = {{ kind = "penalty", normal = "{PENALTY:?} Pa/m" }}
[[stages]]
name = "press"
duration = 1
steps = 1
conditions = [
    {{ set = "lower.bottom", x = 0, y = 0{still} }}, {{ set = "lower.top", x = 0, y = 0{still} }},
    {{ set = "upper.bottom", x = 0, y = {{ to = -{pressed:?} }}{still} }}, {{ set = "upper.top", x = 0, y = {{ to = -{pressed:?} }}{still} }},
]
[time]
stepper = "implicit"
"#,
        pressed = DEPTH + TILT
    ))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    for space in [false, true] {
        for sliding in ["small", "finite"] {
            let mut largest = 0.0_f64;
            for covered in COVERED {
                let done = simulate(&blocks(covered, space, sliding).text()?)?;
                let depths = done.contact("press")?.normal_traction.iter().map(|f| f / PENALTY);
                largest = depths.map(|d| (d - DEPTH).abs() / TILT).fold(largest, f64::max);
            }
            let where_ = if space { "in space" } else { "in the plane" };
            ledger
                .claim(format!(
                    "gap of a node of a facet that is covered in part, less the mean gap, over its range, {where_}, {sliding} sliding"
                ))
                .norm("largest over all nodes; covered by 0.5, 0.1 and 0.01 of its length")
                .value(largest)
                .at_most(1.0)
                .evidence(Evidence::Exact, "an average lies between the least and the largest value")
                .because("weights that are nowhere negative and sum to one make averages, whatever part is covered")
                .why_not_tighter("the weights of the far node concentrate at the border of the covered part, where the gap is largest")
                .covers(&[Capability::Mortar])
                .record();
        }
    }
    Ok(())
}
