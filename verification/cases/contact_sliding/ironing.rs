//! A round die drawn over a soft slab: oscillation of the force with facets, smoothed facets, arcs and mortar.

use crate::cases::texts::{BodyRun, simulate_in, work};
use crate::{Capability, CaseError, Evidence, Ledger, Plot, Series};
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("ironing.toml");
/// Time from which the motion is steady: by then the die has moved by more than the width of contact \[s\].
const STEADY: f64 = 1.4;
/// Travel of the die \[m\].
const TRAVEL: f64 = 4.0;

/// A surface description of the die: name, changes to the scene, bound on the oscillation, its reason, and capabilities covered.
struct Variant {
    name: &'static str,
    changes: &'static [Change<'static>],
    bound: Option<(f64, &'static str)>,
    covers: &'static [Capability],
}

const VARIANTS: [Variant; 5] = [
    Variant {
        name: "flat facets, node-to-point",
        changes: &[],
        bound: None,
        covers: &[Capability::FiniteSliding],
    },
    Variant {
        name: "smoothed facets, node-to-point",
        changes: &[Add("interfaces.contact.smoothing", "cubic")],
        bound: Some((
            0.05,
            "about ten slave nodes carry the load, and one enters and one leaves in every step of the mesh: half of a tenth, \
             since those at the edges carry least",
        )),
        covers: &[Capability::FiniteSliding],
    },
    Variant {
        name: "quadratic arcs on second-order cells, node-to-point",
        changes: &[
            With("bodies.slab.mesh.block.divisions", "[24, 4]"),
            With("bodies.slab.mesh.block.element", "quad9"),
            With("bodies.die.mesh.gmsh.file", "die9.msh"),
        ],
        bound: Some((0.10, "as of smoothed facets, with nodes whose areas are as 1 to 2: twice that")),
        covers: &[Capability::FiniteSliding, Capability::Quadrilaterals],
    },
    Variant {
        name: "mortar",
        changes: &[With("interfaces.contact.measure", "mortar")],
        bound: Some((
            0.025,
            "weights of nodes that come and go begin at zero; the facets' corners remain, a twelfth of whose angle of 0.1 is \
             seen by the load",
        )),
        covers: &[Capability::Mortar, Capability::FiniteSliding],
    },
    Variant {
        name: "quadratic arcs on second-order cells, mortar",
        changes: &[
            With("interfaces.contact.measure", "mortar"),
            With("bodies.slab.mesh.block.element", "quad9"),
            With("bodies.die.mesh.gmsh.file", "die9.msh"),
        ],
        bound: Some((
            0.015,
            "weights of nodes that come and go begin at zero, and arcs have no corners: what remains is how the slab gives way at \
             corners and in the middle of its elements, of which eight lie under the die",
        )),
        covers: &[Capability::Mortar, Capability::FiniteSliding, Capability::Quadrilaterals],
    },
];

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plot = Plot::xy("ironing: force that pulls the die", "travel [m]", "F_x [kN/m]");
    let (mut rows, mut flat) = (Vec::new(), 0.0);
    for v in &VARIANTS {
        let done = simulate_in(&SceneText::new(SCENE).changed(v.changes).text()?, "contact_sliding")?;
        let steady = Steady::from_run(&done)?;
        match v.bound {
            None => flat = steady.oscillation,
            Some((bound, because)) => oscillates_less(ledger, v, &steady, (bound, because), flat, &done),
        }
        ledger
            .claim(format!("work of drawing less the work dissipated while steady, over the latter, {}", v.name))
            .value(((steady.work - steady.dissipated) / steady.dissipated).abs())
            .at_most(if v.bound.is_some() { 5e-3 } else { 0.05 })
            .evidence(Evidence::Exact, "in steady motion the slab keeps what it stores")
            .because(
                "what is stored oscillates with the force, whose mean over the length of a facet is the friction: a part of a period in seven, \
                 of an oscillation of a twentieth at most; with flat facets it is a quarter, and nodes that leave a facet take energy \
                 with them",
            )
            .why_not_tighter("part of a period at the end counts by chance")
            .covers(v.covers)
            .cost(&done.cost)
            .record();
        rows.push([
            v.name.to_owned(),
            format!("{:.2} %", 100.0 * steady.oscillation),
            format!("{:.4}", steady.ratio),
            done.report.counts.operations.iterations.to_string(),
            done.report.counts.rejected.to_string(),
            done.cost.wall.map_or_else(String::new, |w| format!("{w:.2}")),
        ]);
        plot = plot.series(Series::line(v.name, &steady.curve));
    }
    ledger.table(
        "drawing over the second half of the way",
        &["die", "peak to peak of F_x over its mean", "F_x/F_y", "iterations", "rejected", "seconds"],
        rows,
    );
    ledger.plot(plot);
    Ok(())
}

fn oscillates_less(
    ledger: &mut Ledger,
    v: &Variant,
    steady: &Steady,
    bound: (f64, &str),
    flat: f64,
    done: &BodyRun,
) {
    ledger
        .claim(format!("peak to peak of the drawing force over its mean, {}", v.name))
        .value(steady.oscillation)
        .at_most(bound.0)
        .evidence(Evidence::Exact, "over a slab that is the same everywhere the force is constant")
        .because(bound.1)
        .why_not_tighter("where extremes lie relative to steps is chance")
        .covers(v.covers)
        .cost(&done.cost)
        .record();
    ledger
        .claim(format!("oscillation with flat facets over that with {}", v.name))
        .value(flat / steady.oscillation)
        .at_least(2.0)
        .evidence(Evidence::Exact, "over a slab that is the same everywhere the force is constant")
        .because("a cure that leaves half of an illness is none")
        .why_not_tighter("the claim is the order of magnitude; sizes are in the table")
        .covers(v.covers)
        .cost(&done.cost)
        .record();
}

/// The steady part of a run.
struct Steady {
    oscillation: f64,
    /// Mean F_x over mean F_y.
    ratio: f64,
    work: f64,
    dissipated: f64,
    /// F_x \[kN/m\] against travel \[m\].
    curve: Vec<(f64, f64)>,
}

impl Steady {
    fn from_run(done: &BodyRun) -> Result<Steady, CaseError> {
        let (times, forces) = (done.record.times(), done.force("die")?);
        let first = times.iter().take_while(|&&t| t < STEADY).count();
        let x: Vec<f64> = forces[first..].iter().map(|f| f[0]).collect();
        let y: f64 = forces[first..].iter().map(|f| f[1]).sum();
        let way: Vec<f64> = times[first..].iter().map(|t| TRAVEL * (t - 1.0)).collect();
        let sum: f64 = x.iter().sum();
        let range = x.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (v.min(l), v.max(h)));
        let all = times.iter().zip(&forces).filter(|(t, _)| **t > 1.0);
        Ok(Steady {
            oscillation: (range.1 - range.0) / (sum / x.len() as f64).abs(),
            ratio: (sum / y).abs(),
            work: work(&x, &way).iter().sum(),
            dissipated: done.dissipated()[first + 1..].iter().sum(),
            curve: all.map(|(t, f)| (TRAVEL * (t - 1.0), f[0] * 1e-3)).collect(),
        })
    }
}
