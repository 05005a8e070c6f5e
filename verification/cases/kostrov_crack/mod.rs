//! A crack that grows at a given speed from a point, against Kostrov's closed form.

mod front;
mod growing;

use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use growing::{DROP, HALF, Mode, ROCK, SPEED, errors, grow};
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;

/// See the README.
pub const CASE: Case = Case {
    name: "kostrov_crack",
    readme: include_str!("README.md"),
    covers: &[Capability::DynamicRupture, Capability::PlaneStrain, Capability::Antiplane],
    quick: true,
    run,
};

/// Spacings of nodes \[m\].
const SPACINGS: [f64; 3] = [200.0, 100.0, 50.0];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    claims(ledger, Mode::Antiplane, "antiplane", factor_antiplane())?;
    claims(ledger, Mode::Plane, "plane strain", factor_plane()?)
}

/// C in D = C Δτ/μ √(v²t² - x²) of antiplane motion, 2/E with the complete elliptic integral of the second kind of 1 - v²/c_s².
fn factor_antiplane() -> f64 {
    let parameter = 1.0 - (SPEED / ROCK.shear).powi(2);
    // The middle rule converges exponentially: the integrand is periodic and smooth.
    let n = 200;
    let width = FRAC_PI_2 / f64::from(n);
    let value = |k: i32| (1.0 - parameter * ((f64::from(k) + 0.5) * width).sin().powi(2)).sqrt();
    2.0 / ((0..n).map(value).sum::<f64>() * width)
}

/// The same of plane strain, an integral over the transfer function of a half-space.
fn factor_plane() -> Result<f64, CaseError> {
    let all: Value = serde_json::from_str(include_str!("../../independent/dynamic_rupture.json"))?;
    let own = &all["checks"]["kostrov"]["II"]["0.5"]["factor"];
    Ok(own.as_f64().ok_or("the factor of mode II is missing")?)
}

fn claims(ledger: &mut Ledger, mode: Mode, name: &str, factor: f64) -> Result<(), CaseError> {
    let (mut levels, mut last) = ([Vec::new(), Vec::new()], None);
    for spacing in SPACINGS {
        let crack = grow(mode, spacing)?;
        for (levels, error) in levels.iter_mut().zip(errors(&crack, factor)?) {
            levels.push((spacing, error));
        }
        last = Some(crack);
    }
    let last = last.ok_or("no level was computed")?;
    let kinds = [
        ("slip", "root mean square of relative differences over nine tenths of the crack"),
        (
            "mean slip rate over the last tenth of the time",
            "root mean square of relative differences over seven tenths of the crack",
        ),
    ];
    let evidence = if mode == Mode::Antiplane { Evidence::Exact } else { Evidence::SemiAnalytic };
    for ((kind, norm), levels) in kinds.into_iter().zip(&levels) {
        ledger
            .order(format!("{kind} of a growing crack in {name}, against the spacing of nodes"))
            .norm(norm)
            .levels(levels)
            .expected(1.0)
            .within(0.25)
            .or_better()
            .evidence(evidence, "Kostrov (1964); Broberg (1978)")
            .because("the front is known to a part of the spacing, which is an error of first order in the length of the crack")
            .finest(0.005, "half a spacing of 50 m over the half length of 6 km is 0.4 %")
            .cost(&last.cost)
            .record();
    }
    let [_, (time, slip)] = &last.slips[..] else { return Ok(()) };
    let modulus = ROCK.density * ROCK.shear * ROCK.shear;
    let exact = |x: f64| factor * DROP / modulus * ((SPEED * time).powi(2) - x * x).max(0.0).sqrt();
    let (mut found, mut closed) = (Vec::new(), Vec::new());
    for (x, slip) in last.at.iter().zip(slip).filter(|(x, _)| x.abs() < 1.1 * HALF) {
        found.push((*x, *slip));
        closed.push((*x, exact(*x)));
    }
    ledger.plot(
        Plot::xy(format!("Slip of a growing crack, {name}"), "position along the crack [m]", "slip [m]")
            .series(Series::line("closed form", &closed))
            .series(Series::line("nodes 50 m apart", &found)),
    );
    Ok(())
}
