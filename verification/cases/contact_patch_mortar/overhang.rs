//! A block whose sides are held slides past the end of the one below: the area that presses is the overlap.

use crate::cases::texts::simulate;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_output::bodies::PointHistory;
use asperity_vary::SceneText;

/// Penalty \[Pa/m\] and depth \[m\]: the traction where the blocks face each other is their product.
const PENALTY: f64 = 1000.0;
const DOWN: f64 = 0.01;
/// Coefficient of friction.
const MU: f64 = 0.3;
/// Travel along x, and in space along z \[m\].
const ALONG: f64 = 0.7;
const ACROSS: f64 = 0.35;
/// Steps of the travel.
const STEPS: usize = 7;

/// Blocks of which the upper one is pressed on the lower one, then slides past its end; all nodes where they meet are held.
fn blocks(space: bool, rough: bool) -> SceneText {
    let (kinematics, element, far, [lower, upper], still, travel) = if space {
        ("3d", "hex8", ", 1", ["[4, 1, 4]", "[3, 1, 3]"], ", z = 0", format!(", z = {{ to = {ACROSS:?} }}"))
    } else {
        ("plane-strain", "quad4", "", ["[5, 2]", "[4, 2]"], "", String::new())
    };
    let near = if space { ", 0" } else { "" };
    let (law, tangential) = if rough {
        (
            format!("law = {{ kind = \"coulomb\", mu = {MU:?} }}"),
            format!(", tangential = \"{PENALTY:?} Pa/m\""),
        )
    } else {
        (String::new(), String::new())
    };
    SceneText::new(&format!(
        r#"
schema = 1
title = "a block past the end"
kinematics = "{kinematics}"
[materials.stiff]
young = 1000
poisson = 0.3
[bodies.lower]
mesh.block = {{ min = [0, 0{near}], max = [1, 1{far}], divisions = {lower}, element = "{element}" }}
material = "stiff"
[bodies.upper]
mesh.block = {{ min = [0, 1{near}], max = [1, 2{far}], divisions = {upper}, element = "{element}" }}
material = "stiff"
[interfaces.contact]
slave = "upper.bottom"
master = "lower.top"
measure = "mortar"
sliding = "finite"
enforcement = {{ kind = "penalty", normal = "{PENALTY:?} Pa/m"{tangential} }}
{law}
[[stages]]
name = "press"
duration = 1
steps = 1
conditions = [
    {{ set = "lower.bottom", x = 0, y = 0{still} }}, {{ set = "lower.top", x = 0, y = 0{still} }},
    {{ set = "upper.bottom", x = 0, y = {{ to = -{DOWN:?} }}{still} }}, {{ set = "upper.top", x = 0, y = {{ to = -{DOWN:?} }}{still} }},
]
[[stages]]
name = "slide"
duration = 1
steps = {STEPS}
conditions = [{{ set = "upper.bottom", x = {{ to = {ALONG:?} }}{travel} }}, {{ set = "upper.top", x = {{ to = {ALONG:?} }}{travel} }}]
[time]
stepper = "implicit"
"#
    ))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (space, rough) in [(false, false), (false, true), (true, false), (true, true)] {
        let done = simulate(&blocks(space, rough).text()?)?;
        let from = done.steps_until("press")?;
        let points = &done.record.histories()[0].points;
        let force = |k: usize, traction: fn(&PointHistory) -> &Vec<f64>| -> f64 {
            points.iter().map(|p| p.area[k] * traction(p)[k]).sum()
        };
        let times = &done.record.times()[from..];
        let overlap = |t: f64| {
            let across = if space { 1.0 - ACROSS * (t - 1.0) } else { 1.0 };
            (1.0 - ALONG * (t - 1.0)) * across
        };
        let steps = from..from + times.len();
        let found: Vec<f64> =
            steps.clone().map(|k| force(k, |p| &p.normal_traction) / (PENALTY * DOWN)).collect();
        let exact: Vec<f64> = times.iter().map(|t| overlap(*t)).collect();
        let where_ = if space { "in space" } else { "in the plane" };
        let how = if rough { "friction" } else { "no friction" };
        ledger
            .claim(format!(
                "force across on a block that slides past the end, over penalty times depth, {where_}, {how}"
            ))
            .values(&found)
            .equals_each(&exact)
            .absolute(1e-13)
            .evidence(Evidence::Exact, "a uniform pressure on the overlap of the blocks")
            .because("nothing deforms: positions of 1 round to 2e-16, in gaps of 0.01")
            .why_not_tighter("rounding")
            .covers(&[Capability::Mortar, Capability::FiniteSliding])
            .cost(&done.cost)
            .record();
        let tractions: Vec<f64> = steps
            .clone()
            .flat_map(|k| points.iter().filter(move |p| p.area[k] > 0.0).map(move |p| p.normal_traction[k]))
            .map(|f| f / (PENALTY * DOWN))
            .collect();
        ledger
            .claim(format!("normal traction of each slave node that faces the block below, over penalty times depth, {where_}, {how}"))
            .values(&tractions)
            .equals_each(&vec![1.0; tractions.len()])
            .absolute(1e-12)
            .evidence(Evidence::Exact, "the gap is the depth wherever there is overlap")
            .because("positions of 1 round to 2e-16, in gaps of 0.01, of nodes with a fiftieth of their area left")
            .why_not_tighter("rounding grows as the overlap of a node vanishes")
            .covers(&[Capability::Mortar, Capability::FiniteSliding])
            .cost(&done.cost)
            .record();
        if rough {
            let along: Vec<f64> =
                steps.map(|k| force(k, |p| &p.shear_traction).abs() / (MU * PENALTY * DOWN)).collect();
            ledger
                .claim(format!("force along on a block that slides past the end, over mu times penalty and depth, {where_}"))
                .values(&along)
                .equals_each(&exact)
                .absolute(1e-13)
                .evidence(Evidence::Exact, "a uniform pressure on the overlap of the blocks, times mu")
                .because("each step is thirty times the travel to the limit of friction; gaps round as above")
                .why_not_tighter("rounding")
                .covers(&[Capability::Mortar, Capability::FiniteSliding, Capability::Coulomb])
                .cost(&done.cost)
                .record();
        }
    }
    Ok(())
}
