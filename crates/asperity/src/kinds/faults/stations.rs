//! Station files in the format of the SEAS community, one per station.

use super::pore;
use super::rows::{Course, Table};
use asperity_cycles::heat::TEMPERATURE;
use asperity_cycles::{Moment, OPENING};
use asperity_output::formats::seas::{Head, Row};
use asperity_output::tables::Column;
use asperity_plan::faults::cadence::NO_RATE;
use asperity_plan::faults::{FaultView, Plan, PointView, Station};

/// Names of the files of the stations of a fault. Distance in tenths of a kilometre, three digits, as in the names of the
/// benchmarks, if this distinguishes them; otherwise their numbers.
pub(crate) fn names(fault: &FaultView) -> Vec<String> {
    let tenths = |asked: &Station| match asked {
        Station::Along(s) => (s / 100.0).round(),
        Station::At(_) => f64::NAN,
    };
    let apart = fault.stations.windows(2).all(|w| tenths(&w[0].0) < tenths(&w[1].0));
    let name = |(k, (asked, _)): (usize, &(Station, usize))| {
        let tenths = tenths(asked);
        if apart && !tenths.is_nan() {
            format!("{}_dp{tenths:03}", fault.name)
        } else {
            format!("{}_{k:03}", fault.name)
        }
    };
    fault.stations.iter().enumerate().map(name).collect()
}

/// Names of all station files, with their points, headers and columns.
pub(super) fn all(plan: &Plan) -> Vec<(String, usize, String, Vec<Column>)> {
    let mut all = Vec::new();
    for fault in &plan.faults {
        for (name, (asked, point)) in names(fault).into_iter().zip(&fault.stations) {
            let location = location(fault, asked, &plan.points[*point]);
            let head = head(plan, &location, *point);
            all.push((name, *point, head.text(), head.columns()));
        }
    }
    all
}

/// Tables of all stations.
pub(super) fn tables(plan: &Plan) -> impl Iterator<Item = Table<'_>> {
    all(plan).into_iter().map(move |(name, point, head, columns)| {
        let row = move |now: &Moment<'_>| row(plan, now, point);
        Table::new(format!("stations/{name}"), columns, Course::Point(point), row).headed(head)
    })
}

/// Words for the location of a station of a fault at a point.
pub(crate) fn location(fault: &FaultView, asked: &Station, view: &PointView) -> String {
    let fault = &fault.name;
    match asked {
        Station::Along(s) => format!("{s} m along fault {fault}, point at {:.6} m", view.along),
        Station::At(at) => format!("{at:?} m on fault {fault}, point at {:?} m", view.at),
    }
}

/// Head of the file of a station at a point, of a fault that neither opens nor heats.
pub(crate) fn plain<'a>(title: &'a str, location: &'a str, view: &PointView, in_space: bool) -> Head<'a> {
    Head {
        title,
        version: env!("CARGO_PKG_VERSION"),
        area: view.area,
        in_space,
        location,
        directions: view.across.map(|across| [view.slides, across]),
        opens: false,
        heats: false,
        pressurises: false,
    }
}

fn head<'a>(plan: &'a Plan, location: &'a str, point: usize) -> Head<'a> {
    Head {
        opens: opens(plan, point),
        heats: plan.heat_at(point).is_some(),
        pressurises: pore::changes(plan, point),
        ..plain(&plan.title, location, &plan.points[point], plan.in_space)
    }
}

/// True if the fault of a point may open.
fn opens(plan: &Plan, point: usize) -> bool {
    plan.faults.iter().any(|f| f.normal.opens && f.points.contains(&point))
}

fn row(plan: &Plan, now: &Moment<'_>, point: usize) -> String {
    let states = plan.problem.fault.law.states();
    let normal = now.normal(point);
    let theta = plan.points[point].theta.filter(|_| states == 1);
    let log_state = theta.map_or(f64::NAN, |theta| theta.log10(now.states().at(point)[0]));
    let row = Row {
        time: now.at.seconds(),
        slip: now.slip().at(point).collect(),
        rate: now.rate.at(point).map(|v| v.abs().max(NO_RATE)).collect(),
        // Traction that friction resists: the driving traction minus damping.
        shear: now.m().at(point).map(|m| normal * plan.problem.fault.law.scale(point) * m).collect(),
        log_state,
        normal,
        opening: now.at(&OPENING, point).filter(|_| opens(plan, point)),
        temperature: now.at(&TEMPERATURE, point).filter(|_| plan.heat_at(point).is_some()),
        pressure: pore::changes(plan, point).then(|| pore::at(now.pressed, point)),
    };
    row.text()
}
