//! Plots of sliders over time and over displacement.

use super::thin::Row;
use asperity_cycles::slider::Problem;
use asperity_output::plots::{Chart, Measure};
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

/// Charts of a run, without those over a displacement that does not change.
pub(super) fn charts(problem: &Problem, traces: &[&Trace]) -> Vec<Chart> {
    let moves = |column: usize| traces.iter().any(|t| t.rows.iter().any(|r| r[column] != t.rows[0][column]));
    let drawn = DRAWINGS.iter().filter(|d| moves(d.1));
    drawn
        .map(|&(file, along, x, up, y)| Chart {
            file: format!("sliders_{file}"),
            title: problem.title.clone(),
            x: (x, measure(along)),
            y: (y, measure(up)),
            curves: problem
                .names
                .iter()
                .zip(traces)
                .map(|(name, t)| (name.clone(), t.rows.iter().map(|r| (r[along], r[up])).collect()))
                .collect(),
        })
        .collect()
}
