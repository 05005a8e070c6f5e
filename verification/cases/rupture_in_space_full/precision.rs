//! Error of rupture times over the whole fault against the spacing of nodes, for two elements.

use super::{LATE, UNTIL, WHOLE};
use crate::cases::rupture_in_space::{self as first, Reference, Rupture, SOURCE, Span, differences, mean};
use crate::{CaseError, Evidence, Ledger};
use asperity_fem::element::ElementKind;

/// Elements, spacings of nodes \[m\], and bounds on the error on the finest. Borders of fault and square are borders of cells.
const STUDIES: [(ElementKind, [f64; 3], f64); 2] =
    [(ElementKind::Hex8, [300.0, 150.0, 100.0], 0.02), (ElementKind::Hex27, [250.0, 150.0, 93.75], 0.005)];

/// Viscosity that scenes have by default; its time is that of the steps, so that what it changes is of order one.
const VISCOSITY: f64 = 0.1;

/// Distance along either axis from which the finest run is within a per cent \[m\]. Nearer to the square the start is late.
const FAR: f64 = 3500.0;

pub(super) fn claims(
    ledger: &mut Ledger,
    reference: &Reference,
    p: &first::Parameters,
) -> Result<Rupture, CaseError> {
    let stations = reference.stations();
    let mut rows = Vec::new();
    let mut last = None;
    for (kind, spacings, bound) in STUDIES {
        let mut levels = Vec::new();
        for spacing in spacings {
            let end = if spacing > 200.0 { LATE } else { WHOLE.end };
            let found = first::rupture(p, &Span { kind, spacing, end, ..WHOLE }, &stations)?;
            levels.push((spacing, mean(&differences(&found, reference, 0, UNTIL))));
            rows.push(row((kind, spacing, 0.0), &found, reference));
            last = Some(found);
        }
        if let Some(found) = &last {
            order(ledger, kind, (&levels, bound), found);
        }
    }
    let (kind, spacing) = (ElementKind::Hex27, 150.0);
    let damped = first::rupture(p, &Span { kind, spacing, viscosity: VISCOSITY, ..WHOLE }, &stations)?;
    rows.push(row((kind, spacing, VISCOSITY), &damped, reference));
    let head = [
        "element",
        "spacing of nodes [m]",
        "viscosity",
        "mean, 1 mm/s [%]",
        "largest [%]",
        "largest from 3.5 km on [%]",
        "mean, 0.1 m/s [%]",
        "wall time [s]",
    ];
    ledger.table("Differences of rupture times from the boundary integral", &head, rows);
    let finest = last.ok_or("no run")?;
    ledger
        .claim("hex27: rupture times on nodes 94 m apart, from 3.5 km on")
        .norm("largest relative difference over all places at least 3.5 km from the middle along or across the slip")
        .value(far(&finest, reference))
        .at_most(0.01)
        .uncertainty(5e-4)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("the accuracy asked of a mesh with three to five nodes in the cohesive zone (Day et al. 2005)")
        .cost(&finest.cost)
        .record();
    Ok(finest)
}

fn far(found: &Rupture, reference: &Reference) -> f64 {
    let mut rows = differences(found, reference, 0, UNTIL);
    rows.retain(|(at, _)| at[0].max(at[1]) >= FAR);
    first::largest(&rows)
}

fn row(
    (kind, spacing, viscosity): (ElementKind, f64, f64),
    found: &Rupture,
    reference: &Reference,
) -> [String; 8] {
    let slow = differences(found, reference, 0, UNTIL);
    let fast = differences(found, reference, 1, UNTIL);
    let percent = |v: f64| format!("{:.2}", 100.0 * v);
    [
        kind.name().to_string(),
        format!("{spacing}"),
        format!("{viscosity}"),
        percent(mean(&slow)),
        percent(first::largest(&slow)),
        percent(far(found, reference)),
        percent(mean(&fast)),
        format!("{:.0}", found.cost.wall.unwrap_or(f64::NAN)),
    ]
}

fn order(ledger: &mut Ledger, kind: ElementKind, (levels, bound): (&[(f64, f64)], f64), finest: &Rupture) {
    ledger
        .order(format!("{}: rupture times of the whole fault against the spacing of nodes", kind.name()))
        .norm("root mean square of relative differences")
        .levels(levels)
        .expected(2.0)
        .within(0.5)
        .or_better()
        .evidence(Evidence::OtherCode, SOURCE)
        .because("split nodes converge with a power between 2 and 3 in rupture time (Day et al. 2005, figure 11)")
        .finest(
            bound,
            "half a per cent for cells of second order, half of the largest difference allowed; linear cells of as many nodes have three times their phase error or more",
        )
        .cost(&finest.cost)
        .record();
}
