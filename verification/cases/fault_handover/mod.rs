//! Ruptures handed over to bodies with mass and back, where radiation damping is exact.

use crate::cases::seas::{self, CycleResults, YEAR};
use crate::cases::slider_scene;
use crate::{Axis, Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity::kinds::sliders::Entry;
use asperity_cycles::{Balance, Episode, slider as cycles};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_handover",
    readme: include_str!("README.md"),
    covers: &[
        Capability::FaultCycles,
        Capability::DynamicRupture,
        Capability::Antiplane,
        Capability::AgeingLaw,
    ],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");
/// Shear modulus of the rock \[Pa\].
const MODULUS: f64 = 80.095_300_8e9 / 2.5;
/// Density \[kg/m³\].
const DENSITY: f64 = 2670.0;
/// Stiffness of a spring per area of its side \[Pa/m\].
const SPRING: f64 = 2e6;
/// Widths of a slab \[m\].
const WIDTHS: [f64; 3] = [50.0, 25.0, 12.5];
/// Slip rate below which the slabs lose their mass \[m/s\].
const BELOW: f64 = 1e-4;
/// a f_n \[Pa\].
const DIRECT: f64 = 0.010 * 50e6;
/// Source of the reference.
const SLIDER: &str = "spring-slider with radiation damping, stiffness 1/(2W/G + 2/κ), by radau5";

/// Shear wave speed \[m/s\].
fn speed() -> f64 {
    (MODULUS / DENSITY).sqrt()
}

/// Stiffness of both slabs of this width with their springs \[Pa/m\].
fn stiffness(width: f64) -> f64 {
    1.0 / (2.0 * width / MODULUS + 2.0 / SPRING)
}

/// A run of slabs.
struct Slabs {
    found: CycleResults,
    episodes: Vec<Episode>,
    /// Imbalance of the energy budget at the end over its largest part.
    imbalance: f64,
    /// Slip rate after the onset of the last event: time since then \[s\] and rate \[m/s\].
    history: Vec<(f64, f64)>,
}

fn slabs(scene: SceneText, width: f64) -> Result<Slabs, CaseError> {
    let scene = scene
        .with_or_same("bodies.a.mesh.block.min[0]", format!("-{width} m"))
        .with_or_same("bodies.b.mesh.block.max[0]", format!("{width} m"));
    let text = scene.text()?;
    let mut plan = seas::plan(&text)?;
    // The balance needs the problem while the plan gives its bodies away.
    let problem = seas::plan(&text)?.problem;
    let mut balance = Balance::new(&problem);
    let mut imbalance = f64::NAN;
    let mut history = Vec::new();
    let (found, episodes) = seas::found_with_mass(&mut plan, |now| {
        balance.step(now);
        if now.events().len() > 2 {
            imbalance = balance.energy(now.slip().all(), now.pressed).imbalance();
        }
        if let Some(event) = now.under_way().filter(|_| now.events().len() == 2) {
            history.push((now.at.since(&event.onset), now.largest));
        }
    })?;
    Ok(Slabs { found, episodes, imbalance, history })
}

/// Interval between the second and the third event \[yr\].
fn interval(found: &CycleResults) -> f64 {
    found.events[2].interval.unwrap_or(f64::NAN) / YEAR
}

/// Interval \[yr\], peak slip rate \[m/s\] and slip \[m\] of the third event of the slider.
struct Slider {
    interval: f64,
    peak: f64,
    slip: f64,
    history: Vec<(f64, f64)>,
}

fn slider(width: f64) -> Result<Slider, CaseError> {
    let (stiffness, damping) = (stiffness(width), 0.5 * DENSITY * speed());
    let text = format!(
        "schema = 1\ntitle = \"s\"\nkinematics = \"spring-slider\"\n[load]\nrate = \"1e-9 m/s\"\n[sliders.block]\nnormal = \"50 MPa\"\n\
         stiffness = \"{stiffness:?} Pa/m\"\ndamping = \"{damping:?} Pa s/m\"\nstart = \"1.2e-9 m/s\"\n\
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.010, b = 0.015, l = \"8 mm\", v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\" }}\n\
         [time]\nend = \"1000 yr\"\n[events]\nabove = \"1e-2 m/s\"\nstop_after = 3\n"
    );
    let plan = slider_scene::plan(&text)?;
    let mut rows = Vec::new();
    let run = cycles::run(&plan, &mut |now: &cycles::SliderState<'_>| {
        rows.push((now.at.seconds(), now.conditions[0].rate));
    })?;
    let event = Entry::all(&run).pop().ok_or("the slider has no event")?;
    let history = rows.iter().map(|(t, v)| (t - event.onset, *v)).filter(|(t, _)| (0.0..40.0).contains(t));
    Ok(Slider {
        interval: event.interval.unwrap_or(f64::NAN) / YEAR,
        peak: event.peak_rate,
        slip: event.slip.unwrap_or(f64::NAN),
        history: history.collect(),
    })
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut levels: [Vec<(f64, f64)>; 2] = [Vec::new(), Vec::new()];
    let mut last = None;
    for width in WIDTHS {
        let (found, exact) = (slabs(SceneText::new(SCENE), width)?, slider(width)?);
        levels[0].push((width, (interval(&found.found) / exact.interval - 1.0).abs()));
        levels[1].push((width, (found.found.events[2].peak / exact.peak - 1.0).abs()));
        last = Some((found, exact));
    }
    let (found, exact) = last.ok_or("no width")?;
    events(ledger, &found, &exact);
    orders(ledger, &levels);
    returns(ledger, &found);
    rates(ledger, &found)?;
    let plot = Plot::xy("Slip rate of the third event", "time since the onset [s]", "V [m/s]")
        .axes(Axis::Linear, Axis::Log)
        .series(Series::line("slider with damping", &exact.history))
        .series(Series::line("slabs of 12.5 m with mass", &found.history));
    ledger.plot(plot.caption("Slabs with mass on the slider, from hand-over to hand-over."));
    Ok(())
}

fn events(ledger: &mut Ledger, found: &Slabs, exact: &Slider) {
    let event = &found.found.events[2];
    ledger
        .claim("interval between the second and the third event, slabs of 12.5 m")
        .unit("yr")
        .value(interval(&found.found))
        .equals(exact.interval)
        .relative(1e-4)
        .uncertainty(1e-3)
        .evidence(Evidence::SemiAnalytic, SLIDER)
        .because("the mass of the slabs, of first order in their width")
        .cost(&found.found.cost)
        .record();
    ledger
        .claim("slip of the third event, slabs of 12.5 m")
        .unit("m")
        .value(event.details.slip.all()[0])
        .equals(exact.slip)
        .relative(1e-4)
        .evidence(Evidence::SemiAnalytic, SLIDER)
        .because("as for the interval")
        .cost(&found.found.cost)
        .record();
    ledger
        .claim("peak slip rate of the third event, slabs of 12.5 m")
        .unit("m/s")
        .value(event.peak)
        .equals(exact.peak)
        .relative(3e-3)
        .evidence(Evidence::SemiAnalytic, SLIDER)
        .because("of first order in the width: the peak lasts as long as some hundred travel times")
        .cost(&found.found.cost)
        .record();
    ledger
        .claim("imbalance of energy at the end over its largest part, slabs of 12.5 m")
        .value(found.imbalance)
        .at_most(2e-8)
        .evidence(
            Evidence::Exact,
            "work of the loads = stored energy + work of friction + energy of damping and waves",
        )
        .because(
            "tractions are linear within a hundred thousand explicit steps to an event; the cycles add less",
        )
        .cost(&found.found.cost)
        .record();
}

fn orders(ledger: &mut Ledger, levels: &[Vec<(f64, f64)>; 2]) {
    for ((name, finest), levels) in [("interval", 1e-4), ("peak slip rate", 3e-3)].into_iter().zip(levels) {
        ledger
            .order(format!("relative difference of the {name} from that of the slider over the width"))
            .levels(levels)
            .expected(1.0)
            .within(0.1)
            .finest(finest, "half of what a slab of 25 m may differ by")
            .evidence(Evidence::SemiAnalytic, SLIDER)
            .because("a slab without width has no mass, and radiation damping is exact")
            .record();
    }
}

/// Claims on the difference of tractions as the mass is lost.
fn returns(ledger: &mut Ledger, found: &Slabs) {
    let width = WIDTHS[2];
    let expected = stiffness(width) * BELOW * 2.0 * width / speed() / DIRECT;
    let of: Vec<f64> = found.episodes.iter().map(|e| e.unbalanced).collect();
    ledger
        .claim("difference of tractions with mass and in equilibrium at the end of each rupture, over a f_n")
        .values(&of)
        .equals_each(&vec![expected; of.len()])
        .relative(0.03)
        .evidence(
            Evidence::Exact,
            "k V 2W/c: the springs see the slip a travel time late, and so does the fault",
        )
        .because("V has just passed its bound, and changes by a hundredth over the wait")
        .cost(&found.found.cost)
        .record();
}

/// Claim that the slip rate of the hand-over does not matter.
fn rates(ledger: &mut Ledger, found: &Slabs) -> Result<(), CaseError> {
    let handover = "{ above = \"10 mm/s\", below = \"1 mm/s\" }";
    let later = slabs(SceneText::new(SCENE).add("time.handover", handover), WIDTHS[2])?;
    let rates = |slabs: &Slabs| slabs.episodes.iter().map(|e| e.rate).collect::<Vec<_>>();
    ledger
        .claim("interval with hand-overs at 10 and 1 mm/s instead of 1 and 0.1 mm/s")
        .unit("yr")
        .value(interval(&later.found))
        .equals(interval(&found.found))
        .relative(5e-7)
        .evidence(Evidence::ConvergedSelf, "hand-overs at a tenth of these slip rates")
        .because("both problems are the same up to the mass of the slabs, which does not act at so low rates")
        .between(&rates(found), &rates(&later))
        .cost(&later.found.cost)
        .record();
    Ok(())
}
