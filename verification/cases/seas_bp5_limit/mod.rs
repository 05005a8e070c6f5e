//! The SEAS benchmark BP5-QD in the half-space with finer cells, and the limit of its interval.

use crate::cases::seas_bp5::{EVENTS, INTERACT_1KM, along_rake, claim, events, interval};
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp5_limit",
    readme: include_str!("README.md"),
    covers: &[Capability::Medium, Capability::FaultCycles, Capability::Solid3d],
    quick: false,
    run,
};

/// Sizes of cells \[km\], and intervals of the other code with them \[yr\].
const GRIDS: [(f64, f64); 3] = [(1.0, INTERACT_1KM), (0.5, 237.814), (0.25, 238.214)];
/// Limit of the intervals of the other code \[yr\].
const LIMIT: f64 = 238.3;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut intervals = Vec::new();
    for (size, wanted) in GRIDS {
        let (found, _) = events(&along_rake(&format!("{size} km"))?, EVENTS)?;
        claim(ledger, &format!("{size} km"), &found, wanted);
        intervals.push(interval(&found));
    }
    let curve = |values: &mut dyn Iterator<Item = f64>| -> Vec<(f64, f64)> {
        GRIDS.iter().map(|grid| grid.0).zip(values).collect()
    };
    ledger.plot(
        Plot::xy("Interval between events", "size of cells [km]", "interval [yr]")
            .series(Series::line("here", &curve(&mut intervals.iter().copied())))
            .series(Series::points("interact", &curve(&mut GRIDS.iter().map(|grid| grid.1)))),
    );
    let (first, second) = (intervals[1] - intervals[0], intervals[2] - intervals[1]);
    let limit = intervals[2] + second / (first / second - 1.0);
    ledger
        .claim("limit of the intervals of three grids")
        .unit("yr")
        .value(limit)
        .equals(LIMIT)
        .relative(0.005)
        .uncertainty(0.1)
        .evidence(Evidence::OtherCode, "Richardson's limit of the intervals of interact")
        .because("the bound that volume meshes miss: they spread by some per cent")
        .why_not_tighter("the order of the other code's intervals, 2.6, is not that of cells of constant slip, so that its limit is known to 0.1 yr")
        .record();
    Ok(())
}
