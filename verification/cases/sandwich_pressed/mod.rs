//! Stage 1 of the sandwich: normal stress on the interface.

use super::sandwich::{self, POISSON, U_X, YOUNG};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};

/// See the README.
pub const CASE: Case = Case {
    name: "sandwich_pressed",
    readme: include_str!("README.md"),
    covers: &[
        Capability::PlaneStrain,
        Capability::Quadrilaterals,
        Capability::PenaltyContact2d,
        Capability::Stages,
        Capability::Condensation,
    ],
    quick: true,
    run,
};

/// Element sizes \[mm\].
const SIZES: [f64; 4] = [2.5, 1.25, 0.625, 0.3125];

/// A geometry, its mean normal stress on each mesh from an independent solver \[MPa\], and the limit with its uncertainty.
struct Variant {
    name: &'static str,
    build: fn(sandwich::Scene) -> sandwich::Scene,
    table: [f64; 4],
    limit: f64,
    uncertainty: f64,
}

const VARIANTS: [Variant; 2] = [
    Variant {
        name: "base",
        build: |s| s,
        table: [9.35304, 9.33579, 9.32931, 9.32695],
        limit: 9.3256,
        uncertainty: 0.0005,
    },
    Variant {
        name: "block A 50 mm wide",
        build: sandwich::wide,
        table: [6.10249, 6.09516, 6.09240, 6.09140],
        limit: 6.0908,
        uncertainty: 0.0003,
    },
];

const INDEPENDENT: &str = "verification/independent (scikit-fem), h = 2.5 to 0.3125 mm";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    exact(ledger)?;
    for variant in &VARIANTS {
        converging(ledger, variant)?;
    }
    frictional(ledger)
}

/// Without overhang the field is uniform and lies in the finite-element space.
fn exact(ledger: &mut Ledger) -> Result<(), CaseError> {
    for h in SIZES {
        let scene = sandwich::press_only(sandwich::no_overhang(sandwich::size(sandwich::base()?, h)));
        let (run, cost) = Cost::measure(|| sandwich::simulate(&scene));
        let run = run?;
        // Two blocks of 25 mm in series with the penalty spring of stiffness 100 E/h per area.
        let modulus = YOUNG / (1.0 - POISSON * POISSON);
        let stress = U_X / (50e-3 / modulus + h * 1e-3 / (100.0 * YOUNG)) * 1e-6;
        ledger
            .claim(format!("mean normal stress without overhang, h = {h} mm"))
            .unit("MPa")
            .value(run.mean_normal("press")?)
            .equals(stress)
            .relative(1e-9)
            .evidence(Evidence::Exact, "bars in series: u_x / (50 mm (1 - nu^2)/E + h/(100 E))")
            .because(
                "the uniform field lies in the space; rounding times the condition of the stiffness is left",
            )
            .why_not_tighter(
                "rounding grows as h^-2 to about 1e-11 on the finest mesh; one bound serves all four",
            )
            .cost(&cost.counts(&run.report.counts))
            .record();
    }
    Ok(())
}

fn converging(ledger: &mut Ledger, variant: &Variant) -> Result<(), CaseError> {
    let mut means = Vec::new();
    let mut middle = Vec::new();
    for (h, reference) in SIZES.into_iter().zip(variant.table) {
        let scene = sandwich::press_only(sandwich::size((variant.build)(sandwich::base()?), h));
        let (run, cost) = Cost::measure(|| sandwich::simulate(&scene));
        let run = run?;
        let mean = run.mean_normal("press")?;
        let mid = run.end("press")?.normal_traction[run.node_at(25e-3)?] * 1e-6;
        means.push(mean);
        middle.push(mid / mean);
        ledger
            .claim(format!("mean normal stress, {}, h = {h} mm", variant.name))
            .unit("MPa")
            .value(mean)
            .equals(reference)
            .relative(1e-4)
            .evidence(Evidence::OtherCode, INDEPENDENT)
            .because("the same discretisation: six printed digits, and nothing else to differ in")
            .why_not_tighter(
                "the bound is the issue's; the digits that differ are those the reference does not print",
            )
            .cost(&cost.counts(&run.report.counts))
            .record();
    }
    let (limit, order) = sandwich::limit(&means);
    ledger
        .claim(format!("limit of the mean normal stress, {}", variant.name))
        .unit("MPa")
        .value(limit)
        .equals(variant.limit)
        .absolute(2.0 * variant.uncertainty)
        .uncertainty(variant.uncertainty)
        .evidence(Evidence::OtherCode, "limit extrapolated from an independent solver's four meshes")
        .because("uncertainty of the reference and of our own extrapolation, one each")
        .why_not_tighter("both limits are extrapolated from the same discretisation, so they agree better than either is known")
        .record();
    ledger.note(format!(
        "{}: observed order of the mean {order:.2}; the corner singularity is what limits it",
        variant.name
    ));
    if variant.name == "base" {
        ledger
            .claim("mid-point over mean normal stress, four meshes")
            .values(&middle)
            .equals_each(&[0.9236, 0.9252, 0.9258, 0.9261])
            .absolute(1e-4)
            .evidence(Evidence::OtherCode, INDEPENDENT)
            .because("four printed digits of the reference")
            .record();
        let points: Vec<(f64, f64)> =
            SIZES.iter().zip(&means).map(|(h, m)| (*h, (m - limit).abs() / limit)).collect();
        ledger.plot(
            Plot::xy("Mean normal stress: distance from the limit", "h [mm]", "relative difference")
                .axes(crate::Axis::Log, crate::Axis::Log)
                .series(Series::marked("base", &points)),
        );
    }
    Ok(())
}

/// The variant with friction in stage 1 as well.
fn frictional(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (h, reference) in [(1.25, 9.50709), (0.625, 9.499566)] {
        let mut scene = sandwich::frictional(sandwich::size(sandwich::base()?, h));
        scene.stages.truncate(1);
        scene.stages[0].steps = Some(asperity_plan::reading::scene::model::here(10));
        let (run, cost) = Cost::measure(|| sandwich::simulate(&scene));
        let run = run?;
        let cost = cost.counts(&run.report.counts);
        ledger
            .claim(format!("mean normal stress after a frictional stage 1, h = {h} mm"))
            .unit("MPa")
            .value(run.mean_normal("press")?)
            .equals(reference)
            .relative(2e-6)
            .evidence(Evidence::OtherCode, INDEPENDENT)
            .because("loading is proportional, so V and t/f_n are constant and neither solver has an error in time; six digits are printed")
            .why_not_tighter("the reference prints no more digits")
            .covers(&[Capability::VelocityFriction, Capability::Implicit, Capability::Condensation])
            .cost(&cost)
            .record();
        if h == 1.25 {
            let end = run.end("press")?;
            let ratio: Vec<f64> =
                end.shear_traction.iter().zip(&end.normal_traction).map(|(t, f)| t / f).collect();
            let smallest = ratio.iter().copied().fold(f64::INFINITY, f64::min);
            let largest = ratio.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let mut found = [smallest.abs(), largest.abs()];
            found.sort_by(f64::total_cmp);
            ledger
                .claim("extreme shear over normal traction after a frictional stage 1, h = 1.25 mm")
                .values(&found)
                .equals_each(&[0.3802, 0.4257])
                .absolute(1e-4)
                .evidence(Evidence::OtherCode, INDEPENDENT)
                .because("four printed digits; the loading is proportional and has no error in time")
                .covers(&[Capability::VelocityFriction, Capability::Implicit])
                .record();
        }
    }
    Ok(())
}
