//! Report of a run of faults, `report.json`, and its events as CSV.

use super::catalogue_entries::locate;
use super::compression::Compression;
use super::floors::{FloorUse, uses};
use super::heats::{HeatedFault, heats};
use super::non_finite_point;
use super::openings::{OpenedFault, openings};
use super::rupture_length::rupture_length;
use super::sampled_end::{End, in_words};
use crate::catalogue::{Entry, FaultEvents, slipped, unended};
use crate::report::{ForceResult, PointResult, SpringResult, results};
use asperity_cycles::{
    Balance, Components, Episode, FaultRun, Layout, Mark, OPENING, Outrun, Rupture, Thresholds, steady,
};
use asperity_mechanics::coordinates;
use asperity_ode::{Failure, Outcome as Finish};
use asperity_output::decimals::legible;
use asperity_output::formats::catalogues::{SourceParameters, magnitude};
use asperity_plan::faults::{FaultView, Plan};
use asperity_plan::shared::checks::Checks;
use asperity_plan::shared::rate_bound;
use asperity_plan::shared::resolution::Resolution;
use asperity_plan::shared::words::{length, time};
use asperity_run::report::{Kind, Outcome, Phases, Stop};
use asperity_run::{Counts, EnergyTable, Event, Integration, SlipPoints, Warning};
use nalgebra::{Matrix3, Vector3};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;
use std::ops::Range;

/// Entry of an event, restricted to these points of all faults or of one.
fn entry(plan: &Plan, event: &Event<Rupture>, points: &Range<usize>) -> Entry {
    let entry = Entry::from_event(plan, event, points);
    let own = slipped(event, points);
    let turned =
        (plan.problem.fault.law.components() > 1).then(|| VectorSlip::new(plan, &event.details.slip, &own));
    let moment = turned.as_ref().map_or(entry.moment, |t| t.moment);
    // In the plane moments are per length, which only a place may give.
    let width = if plan.in_space { Some(1.0) } else { plan.frame.as_ref().and_then(|f| f.length) };
    Entry {
        moment,
        magnitude: width.map(|width| magnitude(moment * width)),
        rupture_length: rupture_length(plan, &own),
        direction: turned.as_ref().map(|t| t.direction),
        turned: turned.as_ref().map(|t| t.angle),
        // The reader of the scene ensures that the calendar covers the run.
        located: plan.frame.as_ref().and_then(|frame| locate(plan, frame, event, points).ok()),
        ..entry
    }
}

/// Entries of a catalogue, restricted to these points.
fn entries(plan: &Plan, events: &[Event<Rupture>], points: &Range<usize>) -> Vec<Entry> {
    events.iter().map(|event| entry(plan, event, points)).collect()
}

/// Entries of the slow events of all faults in the order of onset, if there are sources of them.
fn slow_events(plan: &Plan, run: &FaultRun) -> Option<Vec<Entry>> {
    let mut all = Vec::new();
    for (fault, events) in plan.faults.iter().zip(run.slow()?) {
        let mut before: Option<&Event<Rupture>> = None;
        for event in events {
            // Those that became fast lie between slow ones.
            let interval = before.replace(event).map(|before| event.onset.since(&before.onset));
            all.push(Entry { interval, ..entry(plan, event, &fault.points) });
        }
    }
    all.sort_by(|a, b| a.onset.total_cmp(&b.onset));
    Some(all)
}

/// Moment and direction of vector slip.
struct VectorSlip {
    moment: f64,
    direction: [f64; 3],
    angle: f64,
}

impl VectorSlip {
    fn new(plan: &Plan, slip: &Components<Vec<f64>>, slipped: &[usize]) -> Self {
        let (mut tensor, mut mean, mut parts) = (Matrix3::zeros(), Vector3::zeros(), [0.0; 2]);
        for &p in slipped {
            let point = &plan.points[p];
            let weight = point.shear_modulus * point.area;
            let way = Vector3::from(plan.vector(slip, p)) * weight;
            let couple = Vector3::from(point.normal) * way.transpose();
            tensor += couple + couple.transpose();
            mean += way;
            parts = std::array::from_fn(|c| parts[c] + weight * slip.component(c)[p]);
        }
        Self {
            moment: tensor.norm() / std::f64::consts::SQRT_2,
            direction: (mean / mean.norm()).into(),
            angle: parts[1].atan2(parts[0]).to_degrees(),
        }
    }
}

/// A cycle, from the end of an event to the end of the next.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Cycle {
    /// Duration of the cycle \[s\].
    pub duration: f64,
    /// Slip integrated over the area during its event; for vector slip, along the rake \[m³; m²\].
    pub seismic: f64,
    /// Slip integrated over the area before its event.
    pub aseismic: f64,
    /// Slip at the rates that would keep tractions constant under the loads, if the loads are constant.
    pub driven: Option<f64>,
    /// Energies of the cycle.
    pub energy: EnergyTable,
}

/// Ratio of load-driven slip to all slip since the previous event below which an event counts as an aftershock, part of the previous event's slip.
/// For events that alternate in size the ratio lies between one half and two.
const AFTERSHOCK: f64 = 0.1;

/// Unit of energies.
fn unit(plan: &Plan) -> &'static str {
    if plan.in_space { "J" } else { "J/m" }
}

impl Cycle {
    fn new(marks: &[Mark], event: &Event<Rupture>, plan: &Plan, driven: Option<f64>) -> Self {
        let (a, b) = (&marks[0], &marks[1]);
        let seismic: f64 =
            event.details.slip.component(0).iter().zip(&plan.points).map(|(s, p)| s * p.area).sum();
        let duration = b.time - a.time;
        Self {
            duration,
            seismic,
            aseismic: b.potency - a.potency - seismic,
            driven: driven.map(|rate| rate * duration),
            energy: EnergyTable::new(unit(plan), &b.energy.since(&a.energy).energies()),
        }
    }

    /// Slip over the area in the whole cycle, over the slip driven by the loads; `None` for an aftershock, which the previous event drives.
    #[must_use]
    pub fn closure(&self) -> Option<f64> {
        let slip = self.seismic + self.aseismic;
        self.driven.filter(|driven| driven.abs() > AFTERSHOCK * slip.abs()).map(|driven| slip / driven)
    }
}

/// Report of a run.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Report {
    /// Outcome.
    pub outcome: Outcome,
    /// Warnings of the plan.
    pub warnings: Vec<Warning>,
    /// Resolution of faults on which friction weakens.
    pub resolution: Vec<Resolution>,
    /// Checks of the plan.
    pub checks: Checks,
    /// Use of the floors of normal traction.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub floors: Vec<FloorUse>,
    /// Openings of the faults that may open.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub openings: Vec<OpenedFault>,
    /// Heat of the faults that friction heats.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub heat: Vec<HeatedFault>,
    /// Errors of the operator, if it is compressed from its entries.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compression: Option<Compression>,
    /// Method of integration.
    pub method: String,
    /// Error tolerance of ln V in a step.
    pub tolerance: f64,
    /// Time at the end \[s\].
    pub end: f64,
    /// Slip rates that begin and end events.
    pub thresholds: Thresholds,
    /// Events of all faults together, detected by the fastest point of all.
    pub events: Vec<Entry>,
    /// Onset of an event in progress at the end \[s\].
    pub under_way: Option<f64>,
    /// Catalogue of each fault, if there are several.
    #[serde(rename = "catalogues", skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<FaultEvents>,
    /// Slow events of all faults, if the scene asks for them: none of them is part of an event of `events`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slow_events: Option<Vec<Entry>>,
    /// Energies up to the end.
    pub energy: EnergyTable,
    /// Ruptures in which bodies had mass, and the errors of the hand-overs.
    #[serde(rename = "passages", skip_serializing_if = "Vec::is_empty")]
    pub ruptures: Vec<Episode>,
    /// Cycles, from the end of each event to the end of the next.
    pub cycles: Vec<Cycle>,
    /// Values at points of the bodies at the end.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<PointResult>,
    /// Forces on sets at the end.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub forces: Vec<ForceResult>,
    /// Springs at the end.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub springs: Vec<SpringResult>,
    /// Work.
    pub counts: Counts<Integration>,
    /// Wall time.
    #[serde(skip)]
    pub seconds: Phases,
}

results!(Report, Kind::Faults);

/// Reason for the failure of an integration, in terms of the fault if possible.
fn why(plan: &Plan, run: &FaultRun, failure: &Failure) -> String {
    let reason = failure.to_string();
    if let Some(Outrun { point, rate }) = run.progress.outrun {
        let fault = plan.source(point);
        let place = format!("point {point}, {}", coordinates::in_words(&plan.points[point].at));
        let rates = [rate, plan.problem.settings.fastest];
        let radiates = plan.problem.fault.damping[point] > 0.0;
        return rate_bound::reason(&format!("fault `{fault}`"), &place, run.at.seconds(), rates, radiates);
    }
    if let Some(place) =
        non_finite_point::place(plan, &run.unknowns).filter(|_| *failure == Failure::NotFinite)
    {
        return format!("{reason}: {place}");
    }
    if let Some(point) = run.progress.opens {
        let view = &plan.points[point];
        let fault = plan.faults.iter().find(|f| f.points.contains(&point)).map_or("", |f| f.name.as_str());
        let place = if plan.in_space {
            format!("z = {:e} m", view.at[2])
        } else {
            format!("{:e} m along it", view.along)
        };
        let (x, y) = (view.at[0], view.at[1]);
        if plan.faults.iter().any(|f| f.normal.opens && f.points.contains(&point)) {
            return format!(
                "{reason}: which points of fault `{fault}` are open does not settle at x = {x:e} m, y = {y:e} m, {place}; are the bodies held?"
            );
        }
        if plan.heat_at(point).is_some_and(|heat| heat.layer.pressurisation.is_some()) {
            return format!(
                "{reason}: the effective normal traction of fault `{fault}` falls to zero at x = {x:e} m, y = {y:e} m, {place}, as its fluid warms and the bodies unload it: lower \
                 the `coefficient` of its `pressurisation`, give it a `normal_floor` that friction uses where there is less, or raise `normal` there"
            );
        }
        return format!(
            "{reason}: the normal traction of fault `{fault}` falls to zero at x = {x:e} m, y = {y:e} m, {place}, and it does not open: give the fault a `normal_floor` that \
             friction uses where there is less, with `opening = true` where its sides may part, or `normal_changes = false`, or raise `normal` there"
        );
    }
    if plan.problem.fault.damping.contains(&0.0) {
        return format!(
            "{reason}: in an instability slip rates grow without bound where nothing is radiated; add `damping = \"radiation\"` to the fault"
        );
    }
    reason
}

/// An event by its number, in a line.
fn in_a_line(number: usize, e: &Entry) -> String {
    let begin = match e.hypocentre_along {
        Some(along) => format!("{} along", length(along)),
        None => {
            let [x, y, z] = e.hypocentre.map(length);
            format!("at ({x}, {y}, {z}) on")
        }
    };
    let interval = e.interval.map_or(String::new(), |i| format!(", {} after the one before", time(i)));
    format!(
        "event {number} at {}{interval}: duration {}, {} of it above the threshold, peak {} m/s, slip up to {}, stress drop {} MPa, nucleates {begin} `{}`",
        time(e.onset),
        time(e.duration),
        time(e.duration_above),
        legible(e.peak_rate, 4),
        length(e.largest_slip),
        legible(e.stress_drop / 1e6, 3),
        e.surface
    )
}

/// Change of ln V on return to equilibrium from which what follows a rupture is doubtful.
const JUMP: f64 = 1.0;

/// Warnings about ruptures with mass after which tractions jump.
fn jumps(ruptures: &[Episode]) -> impl Iterator<Item = Warning> {
    ruptures.iter().filter(|rupture| rupture.unbalanced > JUMP).map(|rupture| {
        let message = format!(
            "when bodies lost their mass after the rupture of {}, tractions jumped by {:.1} a f_n, and ln V with them: what follows it is wrong by as much",
            time(rupture.begin),
            rupture.unbalanced
        );
        let help = "while bodies have mass, sides that absorb waves carry no load: put them farther away, or let the sides that carry loads move or rest";
        Warning::at(0..0, message, help)
    })
}

/// A rupture with mass and the errors of its hand-overs, as text.
fn passage(rupture: &Episode) -> String {
    let Episode { begin, end, steps, radiation, unbalanced, unbalanced_drop, kinetic, .. } = rupture;
    format!(
        "bodies had mass for {} from {} on, in {steps} steps; tractions over a f_n differed by up to {radiation:.1e} before, and by {unbalanced:.1e} after, \
         which is {unbalanced_drop:.1e} of the stress drop; {kinetic:.1e} of the largest kinetic energy was left",
        time(end - begin),
        time(*begin)
    )
}

fn outcome(plan: &Plan, run: &FaultRun) -> Outcome {
    match &run.outcome {
        Finish::Completed | Finish::Stopped => Outcome::Completed,
        Finish::Failed { reason } => {
            let (time, reason) = (run.at.seconds(), why(plan, run, reason));
            let kind = run.progress.outrun.map_or(Stop::Integration, |o| Stop::Outrun {
                surface: plan.source(o.point),
                position: plan.points[o.point].at,
                slip_rate: o.rate,
            });
            Outcome::Stopped { stage: None, time, reason, kind }
        }
    }
}

impl Report {
    /// Report of a run of a plan.
    #[must_use]
    pub fn new(plan: &Plan, run: &FaultRun, balance: &mut Balance<'_>) -> Self {
        let events = run.events();
        let slip = &run.unknowns[Layout::from_fault(&plan.problem.fault).slip()];
        let pressed = plan.problem.fault.pressed(run.at, &run.unknowns);
        let End { points, forces, springs } = End::from_run(plan, run, &pressed);
        let energy = EnergyTable::new(unit(plan), &balance.energy(slip, &pressed).energies());
        let unbalanced =
            energy.doubt("the steps are too long for it", "take a smaller `log_rate_tolerance` in `[time]`");
        let marks = balance.marks();
        let driven = if marks.len() > 1 { steady(&plan.problem) } else { None };
        let driven = driven.map(|rate| rate.iter().zip(&plan.points).map(|(v, p)| v * p.area).sum());
        let cycle = |(pair, event): (&[Mark], &Event<Rupture>)| Cycle::new(pair, event, plan, driven);
        let cycles = marks.windows(2).zip(events.iter().skip(1)).map(cycle).collect();
        let of_fault = |(fault, source): (&FaultView, usize)| FaultEvents {
            surface: fault.name.clone(),
            events: entries(plan, run.catalogue.ended(source), &fault.points),
            under_way: run.catalogue.under_way(source).map(|e| e.onset.seconds()),
        };
        let (heat, molten) = heats(plan, balance.account());
        Self {
            outcome: outcome(plan, run),
            warnings: {
                let found = molten.into_iter().chain(unbalanced).chain(jumps(&run.progress.episodes));
                plan.warnings.iter().cloned().chain(found).collect()
            },
            resolution: plan.resolution.clone(),
            checks: plan.checks.without_memory(),
            floors: uses(plan, balance.account()),
            openings: openings(plan, balance.account(), pressed.values(&OPENING)),
            heat,
            compression: Compression::from_operator(plan.problem.fault.operator.as_ref()),
            method: plan.problem.settings.method.name().to_string(),
            tolerance: plan.problem.settings.tolerance,
            end: run.at.seconds(),
            thresholds: plan.problem.settings.thresholds,
            events: entries(plan, events, &(0..plan.points.len())),
            under_way: run.under_way().map(|e| e.onset.seconds()),
            faults: plan.faults.iter().zip(1..run.sources()).map(of_fault).collect(),
            slow_events: slow_events(plan, run),
            energy,
            ruptures: run.progress.episodes.clone(),
            cycles,
            points,
            forces,
            springs,
            counts: Counts {
                steps: run.counts.steps,
                rejected: run.counts.rejected,
                points: Some(plan.points.len()),
                operations: Integration {
                    right_hand_sides: Some(run.counts.rates),
                    ..Integration::default()
                },
                ..Counts::default()
            },
            seconds: Phases::default(),
        }
    }

    /// Events as entries of seismological catalogues, in order of onset. With several faults, these are the events of each fault.
    #[must_use]
    pub fn located(&self) -> Vec<SourceParameters> {
        let apart: Vec<&Entry> = self.faults.iter().flat_map(|f| &f.events).collect();
        let mut all = if self.faults.is_empty() { self.events.iter().collect() } else { apart };
        all.sort_by(|a, b| a.onset.total_cmp(&b.onset));
        all.into_iter().filter_map(|e| e.located.clone()).collect()
    }

    /// Summary to be read at the end of the run.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::from("results\n");
        for (k, event) in self.events.iter().enumerate() {
            let _ = writeln!(text, "  {}", in_a_line(k + 1, event));
        }
        if let Some(onset) = self.under_way {
            let _ = writeln!(text, "  {}", unended(onset));
        }
        for FaultEvents { surface, events, .. } in &self.faults {
            let intervals: Vec<f64> = events.iter().filter_map(|e| e.interval).collect();
            let mean = intervals.iter().sum::<f64>() / intervals.len() as f64;
            let every = if intervals.is_empty() {
                String::new()
            } else {
                format!(", every {} in the mean", time(mean))
            };
            let _ = writeln!(text, "  fault `{surface}` by itself: {} events{every}", events.len());
        }
        if let Some(slow) = &self.slow_events {
            let _ = writeln!(text, "  {} slow events", slow.len());
        }
        for rupture in &self.ruptures {
            let _ = writeln!(text, "  {}", passage(rupture));
        }
        for (k, cycle) in self.cycles.iter().enumerate() {
            let Some(closure) = cycle.closure() else { continue };
            let share = cycle.seismic / (cycle.seismic + cycle.aseismic);
            let _ = writeln!(
                text,
                "  cycle to event {}: {:.2} % of the slip in events, slip {:.4} of what the loads drive",
                k + 2,
                100.0 * share,
                closure
            );
        }
        let _ = writeln!(text, "  {}", self.energy.text());
        for floor in &self.floors {
            let _ = writeln!(text, "  {}", floor.words());
        }
        for opened in &self.openings {
            let _ = writeln!(text, "  {}", opened.words());
        }
        for heat in &self.heat {
            let _ = writeln!(text, "  {}", heat.words());
        }
        for spring in &self.springs {
            let _ = writeln!(text, "  {}", in_words(spring));
        }
        let _ = writeln!(text, "  end at {}", time(self.end));
        let c = &self.counts;
        let _ = writeln!(
            text,
            "  {} steps ({} rejected), {} right-hand sides of {} points",
            c.steps,
            c.rejected,
            c.operations.right_hand_sides.unwrap_or(0),
            c.points.unwrap_or(0)
        );
        let Phases { plan, steps, output, .. } = self.seconds;
        let _ = writeln!(text, "  seconds: plan {plan:.2}, steps {steps:.2}, output {output:.2}");
        text
    }
}
