//! Contours of rupture time over a quarter of the fault.

use super::UNTIL;
use crate::cases::rupture_in_space::{Reference, Rupture, times_at};
use crate::{Ledger, Plot, Series};

/// Time between contours \[s\].
const STEP: f64 = 0.5;

/// Places where a front is at a time: on each row of places the first at which the time is passed.
fn front(rows: &[([f64; 2], f64)], time: f64) -> Vec<(f64, f64)> {
    let pairs = rows.iter().zip(&rows[1..]).filter(|(a, b)| a.0[1] == b.0[1]);
    let crossed = pairs.filter(|(a, b)| a.1 <= time && b.1 > time);
    crossed
        .map(|((at, t), (next, u))| (1e-3 * (at[0] + (time - t) / (u - t) * (next[0] - at[0])), 1e-3 * at[1]))
        .collect()
}

pub(super) fn draw(ledger: &mut Ledger, reference: &Reference, found: &Rupture) {
    let expected = reference.times(0);
    let places: Vec<[f64; 2]> = expected.iter().map(|row| row.0).collect();
    let here: Vec<([f64; 2], f64)> = places.iter().copied().zip(times_at(found, 0, &places)).collect();
    let mut plot = Plot::xy("Contours of rupture time", "along the slip [km]", "across the slip [km]");
    let (mut solid, mut dotted) = (Vec::new(), Vec::new());
    for k in 1..(UNTIL / STEP).ceil() as usize {
        let time = STEP * k as f64;
        solid.extend(front(&here, time));
        dotted.extend(front(&expected, time));
    }
    plot = plot
        .series(Series::marked("hex27, nodes 94 m apart", &solid))
        .series(Series::points("boundary integral", &dotted))
        .caption("Every half second, at places 500 m apart across the slip.");
    ledger.plot(plot);
}
