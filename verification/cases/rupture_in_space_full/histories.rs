//! Slip and slip rate at stations through time.

use crate::cases::rupture_in_space::{Reference, Rupture, SAMPLE, SOURCE, Station, sampled};
use crate::{Evidence, Ledger, Plot, Series};

/// Root mean square of differences over that of the reference.
fn relative(found: &[f64], expected: &[f64]) -> f64 {
    let pairs = || found.iter().zip(expected);
    let square: f64 = pairs().map(|(a, b)| (a - b).powi(2)).sum();
    (square / pairs().map(|(_, b)| b * b).sum::<f64>()).sqrt()
}

/// Largest slip across over that along, where the latter exceeds a tenth of its largest value.
fn turning(found: &Rupture) -> f64 {
    let most = found.slip.iter().map(|s| s[0]).fold(0.0, f64::max);
    found.slip.iter().filter(|s| s[0] > 0.1 * most).map(|s| (s[1] / s[0]).abs()).fold(0.0, f64::max)
}

pub(super) fn claims(ledger: &mut Ledger, reference: &Reference, found: &Rupture) {
    ledger
        .claim("largest slip across over slip along at the end, hex27 with nodes 94 m apart")
        .value(turning(found))
        .equals(reference.turning())
        .relative(0.15)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("it lies beside the corners of the fault, where slip falls to nothing over some cells")
        .record();
    let stations = reference.stations();
    let slip = |k: usize, s: &Station| relative(&sampled(found, k, 0, s.slip.len() - 1), &s.slip);
    let errors: Vec<f64> = stations.iter().enumerate().map(|(k, s)| slip(k, s)).collect();
    ledger
        .claim("slip at four stations through time, hex27 with nodes 94 m apart")
        .norm("largest over the stations of the root mean square difference over the root mean square")
        .value(errors.iter().map(|e| if e.is_nan() { f64::INFINITY } else { *e }).fold(0.0, f64::max))
        .at_most(0.02)
        .uncertainty(1e-3)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("a front that is half a per cent late at 3 s changes slip by 1 % of that in the first second and a half")
        .cost(&found.cost)
        .record();
    for (k, s) in stations.iter().enumerate() {
        let [x, z] = s.at.map(|v| 1e-3 * v);
        let here: Vec<(f64, f64)> = found.histories.iter().map(|(t, at)| (*t, at[k][1])).collect();
        let there: Vec<(f64, f64)> =
            s.rate.iter().enumerate().map(|(i, v)| (SAMPLE * i as f64, *v)).collect();
        ledger.plot(
            Plot::xy(
                format!("Slip rate {x} km along the slip and {z} km across it"),
                "time [s]",
                "slip rate [m/s]",
            )
            .series(Series::line("hex27, nodes 94 m apart", &here))
            .series(Series::points("boundary integral, cells of 37.5 m", &there)),
        );
    }
}
