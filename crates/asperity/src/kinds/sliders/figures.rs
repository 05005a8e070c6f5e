//! Plots of sliders over time and over displacement.

use super::thin::Row;
use asperity_laws::Theta;
use asperity_output::figures::{Curves, Measure, Points};
use serde::{Deserialize, Serialize};

/// Data of a slider for plots.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Trace {
    /// Time \[s\], slip \[m\], displacement of the load point \[m\], slip rate \[m/s\], friction \[-\], traction \[Pa\], first state
    /// variable, 0 without one.
    rows: Vec<[f64; 7]>,
}

const TIME: usize = 0;
const SLIP: usize = 1;
const LOAD: usize = 2;
const RATE: usize = 3;
const FRICTION: usize = 4;
const TRACTION: usize = 5;
const STATE: usize = 6;

impl Trace {
    pub fn push(&mut self, row: &Row) {
        let c = &row.condition;
        let state = row.states.first().copied().unwrap_or_default();
        self.rows.push([row.time, row.slip, row.load, c.rate, c.friction, c.traction, state]);
    }
}

/// End of the file name, column and label of the horizontal axis, column and label of the vertical axis.
type Drawing = (&'static str, usize, &'static str, usize, &'static str);

const DRAWINGS: [Drawing; 5] = [
    ("relative_displacement", TIME, "Time", SLIP, "Slip"),
    ("friction", TIME, "Time", FRICTION, "Friction coefficient"),
    ("relative_velocity", TIME, "Time", RATE, "Slip rate"),
    ("friction_slip", SLIP, "Slip", FRICTION, "Friction coefficient"),
    ("traction_load", LOAD, "Displacement of the load point", TRACTION, "Traction"),
];

fn measure(column: usize) -> Measure {
    match column {
        TIME => Measure::Time,
        SLIP | LOAD => Measure::Length,
        RATE => Measure::Velocity,
        TRACTION => Measure::Stress,
        _ => Measure::Number,
    }
}

/// Column of the table of a slider that holds a quantity.
fn in_table(column: usize) -> usize {
    match column {
        TIME => 0,
        SLIP => 2,
        RATE => 3,
        FRICTION => 4,
        TRACTION => 5,
        STATE => 8,
        _ => 7,
    }
}

/// A slider in figures.
pub(super) struct Source<'a> {
    /// Its name.
    pub name: &'a str,
    /// Path of its table, or what was kept of it.
    pub rows: Result<String, &'a Trace>,
    /// Number of states of its law.
    pub states: usize,
    /// The state θ of its law, if it has one.
    pub theta: Option<Theta>,
}

/// Curves of a run.
pub(super) fn curves(title: &str, sliders: &[Source<'_>]) -> Vec<Curves> {
    let points = |source: &Result<String, &Trace>, along: usize, up: usize| match source {
        Ok(table) => Points::Table { table: table.clone(), x: in_table(along), y: in_table(up), size: false },
        Err(trace) => {
            let column = |k: usize| trace.rows.iter().map(|row| row[k]).collect();
            Points::Kept { times: column(TIME), x: column(along), y: column(up) }
        }
    };
    let one = |&(file, along, x, up, y): &Drawing| Curves {
        file: format!("sliders_{file}"),
        title: title.into(),
        x: (x.into(), measure(along)),
        y: (y.into(), measure(up)),
        curves: sliders.iter().map(|s| (s.name.into(), points(&s.rows, along, up))).collect(),
        event: None,
        without_zero: false,
        until: None,
        pairs: false,
    };
    DRAWINGS.iter().map(one).chain(states(title, sliders)).collect()
}

/// θ and θ in steady state at the slip rate, of the sliders whose laws have it; otherwise first state variables.
fn states(title: &str, sliders: &[Source<'_>]) -> Option<Curves> {
    let thetas: Vec<(&Source<'_>, Theta)> = sliders.iter().filter_map(|s| Some((s, s.theta?))).collect();
    let mut curves = Vec::new();
    for (slider, theta) in &thetas {
        let (at_zero, slope) = theta.linear();
        curves.push((slider.name.to_string(), linear(slider, (STATE, false), (at_zero, slope))));
        let steady = linear(slider, (RATE, true), (theta.steady(), -1.0));
        curves.push((format!("{}, steady at V", slider.name), steady));
    }
    if thetas.is_empty() {
        let states = sliders.iter().filter(|s| s.states > 0);
        curves.extend(states.map(|s| (s.name.to_string(), linear(s, (STATE, false), (0.0, 1.0)))));
    }
    let (name, measure) = if thetas.is_empty() {
        ("State variable", Measure::Number)
    } else {
        ("log₁₀ of state θ", Measure::LogSeconds)
    };
    (!curves.is_empty()).then(|| Curves {
        file: "sliders_state".into(),
        title: title.into(),
        x: ("Time".into(), Measure::Time),
        y: (name.into(), measure),
        curves,
        event: None,
        without_zero: false,
        until: None,
        pairs: !thetas.is_empty(),
    })
}

/// Linear function of a column, or of the logarithm of its size, over time.
fn linear(slider: &Source<'_>, (column, logarithm): (usize, bool), (at_zero, slope): (f64, f64)) -> Points {
    match &slider.rows {
        Ok(table) => Points::Linear {
            table: table.clone(),
            spaced: false,
            column: in_table(column),
            logarithm,
            at_zero,
            slope,
        },
        Err(trace) => Points::over_time(trace.rows.iter().map(|row| {
            let value = if logarithm { row[column].abs().log10() } else { row[column] };
            (row[TIME], at_zero + slope * value)
        })),
    }
}
