//! Figures of a run: what they need beside its tables.

use super::compass::{Compass, View};
use super::fields::reached;
use super::instants::instants;
use super::shape::{at_corners, corners, shape};
use super::surface_figures::{self, event_onset};
use super::{
    coulomb_figures, locking, receiver_figures, source_time, states, station_figures, still_figures,
};
use crate::catalogue::slipped;
use asperity_cycles::{FaultRun, Rupture};
use asperity_output::figures::{
    Curves, EventFault, EventPanel, Fault, FaultCycles, Line, MappedQuantity, Measure, Plot, Points,
    RuptureShape, Sheet, short, springs_curves,
};
use asperity_output::stems;
use asperity_plan::faults::cadence::time;
use asperity_plan::faults::{FaultView, Plan};
use asperity_run::Event;

/// Figures of a run with a panel of its events.
#[must_use]
pub fn sheet(plan: &Plan, run: &FaultRun, panel: EventPanel) -> Sheet {
    let mut sheet = Sheet::new(&plan.title, [0.0, run.at.seconds()], plan.in_space);
    sheet.plots.push(Plot::Cycles(through(plan, run)));
    sheet.plots.extend(moment_rates(plan, run).into_iter().map(Plot::Curves));
    sheet.plots.extend(springs(plan).map(Plot::Curves));
    sheet.plots.extend(station_figures::states(plan).map(Plot::Curves));
    sheet.plots.extend(receiver_figures::displacements(plan).into_iter().map(Plot::Curves));
    let shapes: Vec<usize> = plan.faults.iter().map(|fault| sheet.shape(drawn(plan, fault))).collect();
    let names = stems(plan.faults.iter().map(|f| f.name.as_str()));
    sheet.plots.extend(on_faults(plan, run, (&names, &shapes)).into_iter().map(Plot::Event));
    sheet.plots.extend(still_figures::plots(plan, run, &names, &shapes));
    sheet.plots.push(Plot::Panel(panel));
    sheet.plots.extend(surface_figures::plots(plan, run));
    sheet.plots.extend(coulomb_figures::plots(plan, run));
    sheet
}

fn through(plan: &Plan, run: &FaultRun) -> FaultCycles {
    let line = |fault: &FaultView| {
        let along: Vec<f64> = plan.points[fault.points.clone()].iter().map(|p| p.along).collect();
        let ascends = along.windows(2).all(|w| w[0] < w[1]) && along.len() > 1;
        let (name, columns) = (fault.name.clone(), fault.points.clone());
        ascends.then(|| Line { name, columns, along, mapped: mapped(plan, fault) })
    };
    let events = run.events().iter().filter_map(|e| Some([e.onset.seconds(), e.end?.seconds()]));
    let under_way = run.under_way().map(|e| [e.onset.seconds(), run.at.seconds()]);
    FaultCycles {
        lines: plan.faults.iter().filter_map(line).collect(),
        events: events.chain(under_way).collect(),
        intervals: plan.cadence.contours.map(time),
        spacing: Some(plan.cadence.contours),
        chosen: instants(plan, run, CYCLES).into_iter().map(|at| (at.words, at.time)).collect(),
        stations: station_figures::portraits(plan, run),
    }
}

/// Largest number of events in the figure of coupling, of which each has two curves.
const CYCLES: usize = 4;

/// Quantities with profiles along a fault.
fn mapped(plan: &Plan, fault: &FaultView) -> Vec<MappedQuantity> {
    let state = states::any(plan)
        .then(|| if states::has_theta(plan, fault) { MappedQuantity::Theta } else { MappedQuantity::State });
    state.into_iter().chain(locking::loaded(plan, fault).then_some(MappedQuantity::Coupling)).collect()
}

/// Share of the largest moment rate below which the end of a curve is left out: afterslip lasts far longer than the rupture.
const TAIL: f64 = 0.01;

/// Moment rate of each event that has a file.
fn moment_rates(plan: &Plan, run: &FaultRun) -> Vec<Curves> {
    let measure = if plan.in_space { Measure::MomentRate } else { Measure::MomentRatePerLength };
    let one = |(number, event): (usize, &Event<Rupture>)| {
        let table = format!("{}/{}", source_time::FOLDER, source_time::name(number));
        Curves {
            file: format!("event_{number:03}_moment_rate"),
            title: format!("{}, event {}", plan.title, number + 1),
            x: ("Time since onset".into(), Measure::Time),
            y: ("Moment rate".into(), measure),
            curves: vec![("all faults".into(), Points::Table { table, x: 0, y: 1, size: false })],
            event: Some(event_onset(number, event)),
            without_zero: false,
            until: Some(TAIL),
            pairs: false,
        }
    };
    run.events().iter().enumerate().take(plan.event_files).map(one).collect()
}

/// A fault as figures show it.
fn drawn(plan: &Plan, fault: &FaultView) -> RuptureShape {
    let views = &plan.points[fault.points.clone()];
    match &fault.outline {
        Some(outline) => RuptureShape::Surface(corners(outline, views, &compass(plan))),
        None => shape(plan.in_space, fault, views, &compass(plan)),
    }
}

fn compass(plan: &Plan) -> Compass<'_> {
    Compass { up: plan.up, frame: plan.frame.as_ref() }
}

/// Hypocentre of an event in the map of a fault in space that contains it.
fn hypocentre(plan: &Plan, fault: &FaultView, event: &Event<Rupture>) -> Option<(f64, f64)> {
    let point = event.details.hypocentre;
    let views = &plan.points[fault.points.clone()];
    let view = || View::from_points(views, &compass(plan), fault.outline.is_some());
    (plan.in_space && fault.points.contains(&point)).then(|| view().place(&plan.points[point].at))
}

/// Faults in the events that have files.
fn on_faults(plan: &Plan, run: &FaultRun, (names, shapes): (&[String], &[usize])) -> Vec<EventFault> {
    let mut all = Vec::new();
    for (number, event) in run.events().iter().enumerate().take(plan.event_files) {
        let largest = slipped(event, &(0..plan.points.len()));
        for ((name, fault), &shape) in names.iter().zip(&plan.faults).zip(shapes) {
            // A fault that takes no part in the event has no figures.
            if !largest.iter().any(|p| fault.points.contains(p)) {
                continue;
            }
            let points = || fault.points.clone();
            let shown = |values: Vec<f64>| -> Vec<f64> {
                let values = fault.outline.as_ref().map_or(values.clone(), |o| at_corners(o, &values));
                values.into_iter().map(short).collect()
            };
            let times = points().map(|p| reached(event, p)).collect();
            let slips: Vec<f64> = points().map(|p| event.details.slip.size(p)).collect();
            all.push(EventFault {
                stem: format!("{name}_event_{number:03}"),
                event: event_onset(number, event),
                fault: Fault { name: fault.name.clone(), points: points(), shape, arrivals: shown(times) },
                // Each triangle has its own, so that a map has the largest one.
                slip: slips.into_iter().map(short).collect(),
                hypocentre: hypocentre(plan, fault, event),
            });
        }
    }
    all
}

/// Macroscopic friction against the way of each load point, from the tables of springs.
fn springs(plan: &Plan) -> Option<Curves> {
    let sampling = plan.sampling.as_ref().filter(|s| !s.sampled.springs.is_empty())?;
    let tables = sampling.sampled.tables();
    let first = tables.len() - sampling.sampled.springs.len();
    // Time, stage, step, load point, displacement, force and friction.
    let points = |path: &str| Points::Table { table: path.into(), x: 3, y: 6, size: true };
    let all = sampling.sampled.springs.iter().zip(&tables[first..]);
    Some(springs_curves(&plan.title, all.map(|(spring, file)| (spring.name(), points(&file.path))).collect()))
}
