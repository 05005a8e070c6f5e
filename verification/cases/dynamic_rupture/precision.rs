//! Error of rupture times against the spacing of nodes, and the work that an error takes, for two elements.

use super::reference::Reference;
use super::{WHOLE, differences, rupture_of};
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;

/// Problem in antiplane motion.
const NAME: &str = "tpv205_III";

/// Spacings of nodes \[m\]. Below them the error is not far enough above the uncertainty of the reference, 0.1 %.
const SPACINGS: [f64; 3] = [400.0, 200.0, 100.0];

/// A run: spacing of nodes \[m\], root mean square of relative differences of rupture times, and cost.
struct Level {
    spacing: f64,
    error: f64,
    cost: Cost,
}

fn level(reference: &Reference, kind: ElementKind, spacing: f64) -> Result<Level, CaseError> {
    let found = rupture_of(kind, &reference.parameters(NAME)?, spacing, WHOLE)?;
    let rows = differences(&found, reference, NAME, 1);
    let square = rows.iter().map(|r| r.1 * r.1).sum::<f64>() / rows.len() as f64;
    Ok(Level { spacing, error: square.sqrt(), cost: found.cost })
}

pub(super) fn claims(ledger: &mut Ledger, reference: &Reference) -> Result<(), CaseError> {
    let mut all = Vec::new();
    for kind in [ElementKind::Quad4, ElementKind::Quad9] {
        let levels = SPACINGS.map(|h| level(reference, kind, h));
        all.push((kind.name(), levels.into_iter().collect::<Result<Vec<_>, _>>()?));
    }
    for (element, levels) in &all {
        order(ledger, element, levels);
    }
    draw(ledger, &all);
    Ok(())
}

fn order(ledger: &mut Ledger, element: &str, levels: &[Level]) {
    let errors: Vec<(f64, f64)> = levels.iter().map(|l| (l.spacing, l.error)).collect();
    let largest = if element == "quad9" { 0.006 } else { 0.02 };
    ledger
        .order(format!("TPV205-2D, antiplane, {element}: rupture times against the spacing of nodes"))
        .norm("root mean square of relative differences")
        .levels(&errors)
        .expected(2.0)
        .within(0.5)
        .or_better()
        .evidence(Evidence::OtherCode, "spectral boundary integral, extrapolated to cells of no size")
        .because(
            "split nodes converge with a power between 2 and 3 in rupture time (Day et al. 2005, figure 11)",
        )
        .finest(
            largest,
            "a bound of 1 % on the largest difference for quad9; the phase error of linear cells is three times as large at equal nodes",
        )
        .covers(&[Capability::DynamicRupture])
        .cost(&levels[SPACINGS.len() - 1].cost)
        .record();
}

fn draw(ledger: &mut Ledger, all: &[(&str, Vec<Level>)]) {
    let axes = ["wall time [s]", "work in cells times steps"];
    for (k, work) in axes.into_iter().enumerate() {
        let of = |level: &Level| -> f64 {
            let count = |name: &str| level.cost.work.get(name).copied().unwrap_or(f64::NAN);
            if k == 0 { level.cost.wall.unwrap_or(f64::NAN) } else { count("cells") * count("steps") }
        };
        let mut plot = Plot::work_precision(
            "TPV205-2D, antiplane",
            "root mean square error of rupture times",
            work.to_string(),
        );
        for (element, levels) in all {
            let points: Vec<(f64, f64)> = levels.iter().map(|l| (l.error, of(l))).collect();
            plot = plot.series(Series::marked(*element, &points));
        }
        ledger.plot(plot.caption("Nodes 400, 200 and 100 m apart."));
    }
    let rows = all.iter().flat_map(|(element, levels)| {
        levels.iter().map(move |l| {
            [
                (*element).to_string(),
                format!("{:.0}", l.spacing),
                format!("{:.3}", 100.0 * l.error),
                format!("{:.2}", l.cost.wall.unwrap_or(f64::NAN)),
            ]
        })
    });
    let head = ["element", "spacing of nodes [m]", "error of rupture times [%]", "wall time [s]"];
    ledger.table("TPV205-2D, antiplane: error and time", &head, rows.collect::<Vec<_>>());
}
