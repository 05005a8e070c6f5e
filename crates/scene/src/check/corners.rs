//! Corners of traces.

use super::Checker;
use crate::model::{InterpolationSpec, Kinematics, Spanned, Trace};

/// Angle from which a corner of a trace is doubtful \[degrees\]: slip of 1 m across a corner of 2 degrees between cells of 1 km changes
/// normal tractions by about a megapascal.
const CORNER: f64 = 2.0;

impl Checker<'_> {
    /// Warns of the sharpest corner of a polyline. In antiplane motion the direction of slip is the same everywhere.
    pub(super) fn corners(&mut self, trace: &Spanned<Trace>, curve: InterpolationSpec) {
        if curve == InterpolationSpec::Spline || *self.scene.kinematics.get_ref() == Kinematics::Antiplane {
            return;
        }
        let vertices: Vec<[f64; 2]> = trace.get_ref().iter().map(|x| x.map(|c| c.0)).collect();
        let turns = vertices.windows(3).map(|w| (angle(w), w[1]));
        let Some((turn, [x, y])) = turns.reduce(|most, turn| if turn.0 > most.0 { turn } else { most })
        else {
            return;
        };
        if turn >= CORNER {
            self.warn(
                trace.span(),
                format!("the trace has a corner of {turn:.1} degrees at ({x}, {y}) m, where tractions grow without bound as cells shrink"),
                "leave `interpolation = \"polyline\"` out for a smooth curve, unless the corner is meant; events may start there, and their recurrence depends on the cells",
            );
        }
    }
}

/// Angle by which a line turns at the middle one of three vertices \[degrees\].
fn angle(w: &[[f64; 2]]) -> f64 {
    let [u, v] = [[0, 1], [1, 2]].map(|[a, b]| [w[b][0] - w[a][0], w[b][1] - w[a][1]]);
    (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).abs().to_degrees()
}
