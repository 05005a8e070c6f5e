//! Plots of sliders over time and over displacement.

use super::thin::Row;
use asperity_output::plots::{Curves, Measure, Points};
use serde::{Deserialize, Serialize};

/// Data of a slider for plots.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Trace {
    /// Time \[s\], slip \[m\], displacement of the load point \[m\], slip rate \[m/s\], friction \[-\], traction \[Pa\].
    rows: Vec<[f64; 6]>,
}

const TIME: usize = 0;
const SLIP: usize = 1;
const LOAD: usize = 2;
const RATE: usize = 3;
const FRICTION: usize = 4;
const TRACTION: usize = 5;

impl Trace {
    pub fn push(&mut self, row: &Row) {
        let c = &row.condition;
        self.rows.push([row.time, row.slip, row.load, c.rate, c.friction, c.traction]);
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
        _ => 7,
    }
}

/// A slider: its name, and the path of its table or what was kept of it.
pub(super) type Source<'a> = (&'a str, Result<String, &'a Trace>);

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
        curves: sliders.iter().map(|(name, source)| ((*name).into(), points(source, along, up))).collect(),
        event: None,
        without_zero: false,
        until: None,
    };
    DRAWINGS.iter().map(one).collect()
}
