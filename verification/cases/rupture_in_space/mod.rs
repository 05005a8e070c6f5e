//! Rupture of a plane fault in space, against a spectral boundary integral: its first two seconds.

mod reference;
mod rock;
mod rupture;

use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
pub(crate) use reference::{Parameters, Reference, SAMPLE, Station};
pub(crate) use rock::Span;
pub(crate) use rupture::{Rupture, differences, follow, largest, mean, rupture, sampled, times_at};

/// See the README.
pub const CASE: Case = Case {
    name: "rupture_in_space",
    readme: include_str!("README.md"),
    covers: &[Capability::DynamicRupture, Capability::Solid3d],
    quick: true,
    run,
};

/// Source of the reference.
pub(crate) const SOURCE: &str =
    "spectral boundary integral in three dimensions (verification/independent/rupture_in_space.py)";

/// Spacings of nodes \[m\]: each has nodes on the borders of the fault and of the square.
const SPACINGS: [f64; 3] = [300.0, 250.0, 150.0];

/// Rock around the part of the fault that ruptures first.
const FIRST: Span = Span {
    kind: ElementKind::Hex8,
    spacing: SPACINGS[0],
    extent: [8.1e3, 4.5e3, 7.2e3],
    end: 2.3,
    viscosity: 0.0,
    whole: false,
};

/// Rupture times of the reference up to this one are compared \[s\]. The coarsest cells are late by a quarter.
const UNTIL: f64 = 1.8;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Reference::read()?;
    let p = reference.parameters()?;
    let of = |span: &Span| rupture(&p, span, &[]);
    let runs = SPACINGS.map(|spacing| of(&Span { spacing, ..FIRST }));
    let runs: Vec<Rupture> = runs.into_iter().collect::<Result<_, _>>()?;
    order(ledger, &reference, &runs);
    let second = of(&Span { kind: ElementKind::Hex27, spacing: SPACINGS[2], ..FIRST })?;
    at_second_order(ledger, &reference, &second);
    symmetry(ledger, &runs[0], &of(&Span { whole: true, ..FIRST })?);
    energy(ledger, "hex8", &runs[2]);
    draw(ledger, &reference, &second);
    Ok(())
}

/// Rupture times along the slip and across it.
fn draw(ledger: &mut Ledger, reference: &Reference, found: &Rupture) {
    let expected = reference.times(0);
    let mut plot = Plot::xy("Rupture times", "distance from the middle [km]", "time [s]");
    for (axis, name) in [(0, "along the slip"), (1, "across the slip")] {
        let near = |row: &&([f64; 2], f64)| row.0[1 - axis] == 0.0 && row.1 <= UNTIL;
        let (places, times): (Vec<[f64; 2]>, Vec<f64>) = expected.iter().filter(near).copied().unzip();
        let at = |times: Vec<f64>| -> Vec<(f64, f64)> {
            places.iter().map(|place| 1e-3 * place[axis]).zip(times).collect()
        };
        plot = plot
            .series(Series::line(format!("hex27, {name}"), &at(times_at(found, 0, &places))))
            .series(Series::points(format!("boundary integral, {name}"), &at(times)));
    }
    ledger.plot(plot);
}

fn order(ledger: &mut Ledger, reference: &Reference, runs: &[Rupture]) {
    let errors = runs.iter().map(|r| mean(&differences(r, reference, 0, UNTIL)));
    let levels: Vec<(f64, f64)> = SPACINGS.into_iter().zip(errors).collect();
    ledger
        .order("hex8: rupture times of the first 1.8 s against the spacing of nodes")
        .norm("root mean square of relative differences")
        .levels(&levels)
        .expected(2.0)
        .within(0.5)
        .or_better()
        .evidence(Evidence::OtherCode, SOURCE)
        .because("split nodes converge with a power of about 2 in rupture time (Day et al. 2005)")
        .finest(
            0.05,
            "cells of 150 m have two to four nodes in the cohesive zone, and the square is hardly larger than what nucleates: it starts late",
        )
        .cost(&runs[2].cost)
        .record();
}

fn at_second_order(ledger: &mut Ledger, reference: &Reference, found: &Rupture) {
    ledger
        .claim("hex27: rupture times of the first 1.8 s on nodes 150 m apart")
        .norm("root mean square of relative differences")
        .value(mean(&differences(found, reference, 0, UNTIL)))
        .at_most(0.02)
        .uncertainty(3e-4)
        .evidence(Evidence::OtherCode, SOURCE)
        .because(
            "the phase error of cells of second order is a third of that of linear cells with as many nodes",
        )
        .cost(&found.cost)
        .record();
}

/// The whole rock ruptures as its quarter does.
fn symmetry(ledger: &mut Ledger, quarter: &Rupture, whole: &Rupture) {
    let mirrored: Vec<[f64; 2]> = whole.at.iter().map(|at| at.map(f64::abs)).collect();
    let times = times_at(quarter, 0, &mirrored);
    let rest = |(a, b): (&f64, &f64)| if a.is_nan() && b.is_nan() { 0.0 } else { (a - b).abs() / b };
    let rests =
        whole.times[0].iter().zip(&times).map(rest).map(|d| if d.is_nan() { f64::INFINITY } else { d });
    ledger
        .claim("rupture times of the whole rock, and of a quarter with the conditions of symmetry on nodes 300 m apart")
        .norm("largest relative difference over all points")
        .value(rests.fold(0.0, f64::max))
        .at_most(1e-9)
        .evidence(Evidence::Exact, "the problem is symmetric about z = 0 and antisymmetric about x = 0")
        .because("some hundred steps of rounding, which the onset of slip amplifies")
        .why_not_tighter("both runs sum forces in different orders")
        .record();
}

/// Claims that the energy budget closes.
pub(crate) fn energy(ledger: &mut Ledger, name: &str, found: &Rupture) {
    let budget = found.budget;
    ledger
        .claim(format!("{name}: missing energy over its largest part"))
        .value(budget.energies().imbalance())
        .at_most(1e-13)
        .evidence(Evidence::Exact, "central differences keep the balance of energy but for rounding")
        .because("a step rounds by 1e-16, and some thousand steps at most by their sum")
        .why_not_tighter("roundings of single steps cancel in part")
        .record();
}
