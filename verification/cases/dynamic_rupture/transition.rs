//! TPV104 in plane strain: a front faster than shear waves runs ahead and dies near 6.5 km.
//!
//! There the time at which the slip rate passes the threshold changes from one front to the other, and where it does depends on the
//! spacing: in the boundary integral, too, times change by 0.17 s from cells of 100 m to 50 m. Behind that place the difference is
//! that of the start of the slower front.

use super::reference::Reference;
use super::{Rupture, SPACING, Span, WHOLE, differences, drawn, largest, rupture_of};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_fem::element::ElementKind;
use std::ops::RangeInclusive;

const NAME: &str = "tpv104_II";
const TITLE: &str = "TPV104 in section, plane strain";

/// Rock for the part of the fault on which the fast front dies.
const PART: Span = Span { extent: [11e3, 5e3], end: 3.7 };

/// Places from the hypocentre \[m\].
type Places<'a> = &'a [RangeInclusive<f64>];

pub(super) fn claims(ledger: &mut Ledger, reference: &Reference) -> Result<(), CaseError> {
    let run = |spacing, span| rupture_of(ElementKind::Quad9, &reference.parameters(NAME)?, spacing, span);
    let first = run(SPACING, WHOLE)?;
    claim(ledger, reference, &first, (SPACING, &[3e3..=5e3, 11.5e3..=15e3]));
    drawn(ledger, &first, reference, (NAME, TITLE));
    let second = run(0.5 * SPACING, WHOLE)?;
    claim(ledger, reference, &second, (0.5 * SPACING, &[2e3..=6e3, 8.5e3..=15e3]));
    let third = run(0.25 * SPACING, PART)?;
    claim(ledger, reference, &third, (0.25 * SPACING, &[2e3..=9e3]));
    Ok(())
}

fn claim(ledger: &mut Ledger, reference: &Reference, found: &Rupture, (spacing, places): (f64, Places<'_>)) {
    let mut rows = differences(found, reference, NAME, 1);
    rows.retain(|(x, _)| places.iter().any(|p| p.contains(x)));
    let words: Vec<String> =
        places.iter().map(|p| format!("{:.1} to {:.1} km", 1e-3 * p.start(), 1e-3 * p.end())).collect();
    ledger
        .claim(format!("{TITLE}: rupture times on nodes {spacing:.0} m apart"))
        .norm(format!("largest relative difference over all places from {}", words.join(" and ")))
        .value(largest(&rows))
        .at_most(0.01)
        .uncertainty(1e-3)
        .evidence(
            Evidence::OtherCode,
            "spectral boundary integral (verification/independent/dynamic_rupture.py)",
        )
        .because("the accuracy of the other claims, except where a front faster than shear waves dies, which depends on the spacing")
        .covers(&[Capability::DynamicRupture])
        .cost(&found.cost)
        .record();
}
