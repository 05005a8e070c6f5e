//! Figures of stations: the state through time, and those that the phase portrait shows.

use super::{states, stations};
use asperity_cycles::FaultRun;
use asperity_output::figures::{Curves, Measure, Points, Portrait};
use asperity_plan::faults::{FaultView, Plan, Station};
use asperity_plan::shared::words::length;

/// Largest number of stations in the figure of states.
const MOST: usize = 5;
/// Pascals per megapascal, the unit of tractions of stations.
const MPA: f64 = 1e6;

/// A station: its fault, its name in figures, the path of its file and its point.
struct NamedStation<'a> {
    fault: &'a FaultView,
    name: String,
    path: String,
    point: usize,
}

fn named(plan: &Plan) -> Vec<NamedStation<'_>> {
    let all = plan.faults.iter().flat_map(|fault| fault.stations.iter().map(move |station| (fault, station)));
    let several = plan.faults.iter().filter(|fault| !fault.stations.is_empty()).count() > 1;
    all.zip(stations::all(plan))
        .map(|((fault, (asked, point)), (path, ..))| {
            let place = match asked {
                Station::Along(at) => short(*at),
                Station::At(at) => {
                    format!("({})", at.iter().map(|x| short(*x)).collect::<Vec<_>>().join(", "))
                }
            };
            let name = if several { format!("{}, {place}", fault.name) } else { place };
            NamedStation { fault, name, path: format!("stations/{}", path), point: *point }
        })
        .collect()
}

/// Length without the zeros at its end.
fn short(metres: f64) -> String {
    let text = length(metres);
    match text.split_once(' ') {
        Some((number, unit)) if number.contains('.') => {
            format!("{} {unit}", number.trim_end_matches('0').trim_end_matches('.'))
        }
        _ => text,
    }
}

/// Stations of the phase portrait: those whose points have been faster than the rate that begins events.
pub(super) fn portraits(plan: &Plan, run: &FaultRun) -> Vec<Portrait> {
    let on = plan.problem.settings.thresholds.on;
    let slips = |point: usize| {
        let peak = |event: &asperity_run::Event<asperity_cycles::Rupture>| {
            event.details.front.peaks.get(point).copied().unwrap_or_default()
        };
        run.events().iter().chain(run.under_way()).any(|event| peak(event) >= on)
    };
    let turns = plan.problem.fault.law.components() > 1;
    let (rate, shear) = if turns { (vec![3, 4], vec![5, 6]) } else { (vec![2], vec![3]) };
    let of = |station: NamedStation<'_>| Portrait {
        name: station.name,
        path: station.path,
        rate: rate.clone(),
        shear: shear.clone(),
        unit: MPA,
    };
    named(plan).into_iter().filter(|station| slips(station.point)).map(of).collect()
}

/// θ at the stations through time, and, where slip has one direction, θ in steady state at their slip rates.
pub(super) fn states(plan: &Plan) -> Option<Curves> {
    let turns = plan.problem.fault.law.components() > 1;
    let (rate, state) = if turns { (3, 7) } else { (2, 4) };
    let mut curves = Vec::new();
    for station in named(plan).into_iter().filter(|s| states::has_theta(plan, s.fault)).take(MOST) {
        let Some(theta) = plan.points[station.point].theta else { continue };
        let linear = |column, at_zero, slope| Points::Linear {
            table: station.path.clone(),
            spaced: true,
            column,
            logarithm: false,
            at_zero,
            slope,
        };
        curves.push((station.name.clone(), linear(state, 0.0, 1.0)));
        if !turns {
            curves.push((format!("{}, steady at V", station.name), linear(rate, theta.steady(), -1.0)));
        }
    }
    (!curves.is_empty()).then(|| Curves {
        file: "stations_state".into(),
        title: plan.title.clone(),
        x: ("Time".into(), Measure::Time),
        y: ("log₁₀ of state θ".into(), Measure::LogSeconds),
        curves,
        event: None,
        without_zero: false,
        until: None,
        pairs: !turns,
    })
}
