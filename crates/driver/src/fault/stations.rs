//! Files of stations in the format of the SEAS community, one for each.

use super::cadence::NO_RATE;
use super::equations::size;
use super::plan::Plan;
use super::run::Moment;
use crate::observe::decimals::{fixed, scientific};
use crate::scene::model::Station;
use std::path::PathBuf;

/// Points of all stations.
pub(super) fn points(plan: &Plan) -> Vec<usize> {
    plan.faults.iter().flat_map(|f| f.stations.iter().map(|s| s.1)).collect()
}

/// Names of the files of all stations with their headers.
pub(super) fn heads(plan: &Plan) -> Vec<(PathBuf, String)> {
    let mut heads = Vec::new();
    for fault in &plan.faults {
        // Tenths of a kilometre in three digits, as the benchmarks name their stations, where that tells them apart.
        let tenths = |asked: &Station| match asked {
            Station::Along(s) => (s / 100.0).round(),
            Station::At(_) => f64::NAN,
        };
        let apart = fault.stations.windows(2).all(|w| tenths(&w[0].0) < tenths(&w[1].0));
        for (k, (asked, point)) in fault.stations.iter().enumerate() {
            let tenths = tenths(asked);
            let name = if apart && !tenths.is_nan() {
                format!("{}_dp{tenths:03}", fault.name)
            } else {
                format!("{}_{k:03}", fault.name)
            };
            heads.push((name.into(), head(plan, &fault.name, asked, *point)));
        }
    }
    heads
}

/// Names of columns with their units, and of fields.
const ALONG_A_LINE: (&[&str], &str) = (
    &["Slip (m)", "Slip rate (log10 m/s)", "Shear stress (MPa)", "State (log10 s)", "Normal stress (MPa)"],
    "t slip slip_rate shear_stress state normal_stress",
);
/// Where slip may turn.
const IN_A_PLANE: (&[&str], &str) = (
    &[
        "Slip_2 (m)",
        "Slip_3 (m)",
        "Slip_rate_2 (log10 m/s)",
        "Slip_rate_3 (log10 m/s)",
        "Shear_stress_2 (MPa)",
        "Shear_stress_3 (MPa)",
        "State (log10 s)",
        "Normal stress (MPa)",
    ],
    "t slip_2 slip_3 slip_rate_2 slip_rate_3 shear_stress_2 shear_stress_3 state normal_stress",
);

fn head(plan: &Plan, fault: &str, asked: &Station, point: usize) -> String {
    let view = &plan.points[point];
    let location = match asked {
        Station::Along(s) => format!("{s} m along fault {fault}, point at {:.6} m", view.along),
        Station::At(at) => format!("{at:?} m on fault {fault}, point at {:?} m", view.at),
    };
    let mut head = format!(
        "# problem={}\n# code=asperity\n# code_version={}\n# tributary_area={:.6e} {}\n# location= {location}\n",
        plan.title,
        env!("CARGO_PKG_VERSION"),
        view.area,
        if plan.in_space { "m2" } else { "m per m" }
    );
    if let Some(across) = &view.across {
        head.push_str(&format!("# directions: 2 is along {:?}, 3 along {across:?}\n", view.slides));
    }
    let (columns, names) = if view.across.is_some() { IN_A_PLANE } else { ALONG_A_LINE };
    let opens = opens(plan, point);
    let last = opens.then_some(&"Opening (m)");
    for (k, column) in std::iter::once(&"Time (s)").chain(columns).chain(last).enumerate() {
        head.push_str(&format!("# Column #{} = {column}\n", k + 1));
    }
    head.push_str(names);
    head.push_str(if opens { " opening" } else { "" });
    head.push('\n');
    head
}

/// Whether the fault of a point opens.
fn opens(plan: &Plan, point: usize) -> bool {
    plan.faults.iter().any(|f| f.normal.opens && f.points.contains(&point))
}

/// The row of a station.
pub(super) fn row(plan: &Plan, now: &Moment<'_>, point: usize) -> String {
    let (states, n) = (plan.fault.law.states(), plan.points.len());
    let normal = now.normal(point);
    let theta = plan.points[point]
        .theta
        .filter(|_| states == 1)
        .map_or(f64::NAN, |(time, per)| (time.ln() + now.states()[point] * per) / std::f64::consts::LN_10);
    let mut row = format!("{:.14e}", now.at.seconds());
    let components = || (point..now.rate.len()).step_by(n);
    for i in components() {
        row.push_str(&format!(" {}", scientific(now.slip()[i], 9)));
    }
    for i in components() {
        let rate = if now.rate.len() > n { now.rate[i].abs().max(NO_RATE) } else { size(now.rate, n, point) };
        row.push_str(&format!(" {}", fixed(rate.log10(), 9)));
    }
    for i in components() {
        // The traction that friction resists with: what drives less the damping.
        let shear = normal * plan.fault.law.scale(point) * now.unknowns[i];
        row.push_str(&format!(" {}", scientific(shear / 1e6, 9)));
    }
    row.push_str(&format!(" {} {}", fixed(theta, 9), scientific(normal / 1e6, 9)));
    if let Some(opening) = now.opening(point).filter(|_| opens(plan, point)) {
        row.push_str(&format!(" {}", scientific(opening, 9)));
    }
    row.push('\n');
    row
}
