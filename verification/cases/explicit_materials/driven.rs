//! Attenuation and phase speed of a shear wave that is driven through a Maxwell body.
//!
//! With the complex modulus G* = G i ω T/(1 + i ω T) the wave e^(i (ω t - k x)) has k² = ρ ω²/G* = (ω/c)² (1 - i/(ω T)).

use super::{problem, table};
use crate::cases::waves::run;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_mechanics::dynamics::Explicit;
use asperity_vary::SceneText;
use std::f64::consts::{PI, TAU};

const SCENE: &str = include_str!("driven.toml");

/// c = 1 m/s, and T \[s\].
const TIME: f64 = 0.5;

/// ω \[rad/s\].
const OMEGA: f64 = TAU;

/// Duration of the run \[s\].
const END: f64 = 14.0;

/// Periods over which the motion rises, so that it has no slow parts whose flow lasts.
const RISE: f64 = 4.0;

/// Points of the table of the motion per period.
const POINTS: u32 = 400;

/// Stations \[m\].
const STATIONS: [f64; 2] = [0.5, 1.5];

/// Periods at the end over which the motion is analysed.
const LAST: f64 = 4.0;

/// Cells per metre.
const PER_METRE: usize = 40;

/// Real part of k and the attenuation, minus its imaginary part \[1/m\].
fn exact() -> [f64; 2] {
    let (re, im) = (1.0, -1.0 / (OMEGA * TIME));
    let size = (re * re + im * im).sqrt();
    [(0.5 * (size + re)).sqrt() * OMEGA, (0.5 * (size - re)).sqrt() * OMEGA]
}

/// Motion of the driven end \[m\].
fn motion(t: f64) -> f64 {
    let x = (t / RISE).min(1.0);
    (0.5 - 0.5 * (PI * x).cos()) * (OMEGA * t).sin()
}

/// Amplitude and phase of each station over the last periods.
fn measured() -> Result<([(f64, f64); 2], Cost), CaseError> {
    let times = (0..=POINTS * END as u32).map(|k| f64::from(k) / f64::from(POINTS));
    let scene = SceneText::new(SCENE).with("stages[0].conditions[0].z", table(times.map(|t| (t, motion(t)))));
    let problem = problem(scene)?;
    let nodes = STATIONS.map(|x| (x * PER_METRE as f64).round() as usize);
    let mut sums = [[0.0; 2]; 2];
    let watch = |run: &mut Explicit<'_, 2>| {
        let t = run.time();
        if t > END - LAST + 0.5 * run.dt() {
            for (sum, node) in sums.iter_mut().zip(nodes) {
                let u = run.displacement()[node];
                sum[0] += u * (OMEGA * t).cos();
                sum[1] += u * (OMEGA * t).sin();
            }
        }
    };
    let (result, cost) = Cost::measure(|| run(&problem, watch));
    let steps = result?.steps() as f64;
    let of = |[c, s]: [f64; 2]| (c.hypot(s), c.atan2(s));
    Ok((sums.map(of), cost.count("steps", steps)))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let ([(near, early), (far, late)], cost) = measured()?;
    let way = STATIONS[1] - STATIONS[0];
    // Stations are about a wavelength apart: the phase between them lies within half a turn of the exact one.
    let [wavenumber, attenuation] = exact();
    let turn = early - late - wavenumber * way;
    let found = wavenumber * way + turn - TAU * (turn / TAU).round();
    let size = wavenumber.hypot(attenuation) / PER_METRE as f64;
    let rows = [
        (
            "phase speed of a driven shear wave in a Maxwell body",
            "m/s",
            OMEGA * way / found,
            OMEGA / wavenumber,
            1.0,
        ),
        (
            "attenuation of a driven shear wave in a Maxwell body",
            "1/m",
            (near / far).ln() / way,
            attenuation,
            3.0,
        ),
    ];
    for (what, unit, value, reference, power) in rows {
        ledger
            .claim(what)
            .unit(unit)
            .value(value)
            .equals(reference)
            .relative(power * 2.0 * size * size / 24.0)
            .evidence(Evidence::Exact, "k² = (ω/c)² (1 - i/(ω T)), from the complex modulus")
            .because(
                "linear elements shift k by k³h²/24, whose imaginary part is three times as large over that of k; steps of half the stable one \
                 shift the relaxation by as much at most",
            )
            .covers(&[Capability::Viscoelasticity, Capability::Waves])
            .cost(&cost)
            .record();
    }
    Ok(())
}
