//! Frictional heat: temperature and pore pressure in closed form, and events of a slider with them.

mod events;
mod imposed;

use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_cycles::heat::{Layer, Modes, Pressurisation};
use imposed::{Steps, heated};
use std::f64::consts::PI;

/// See the README.
pub const CASE: Case = Case {
    name: "frictional_heat",
    readme: include_str!("README.md"),
    covers: &[Capability::FrictionalHeat, Capability::FaultCycles],
    quick: true,
    run,
};

/// A zone of 1 mm with the properties of the scene.
const LAYER: Layer = Layer {
    thickness: 1e-3,
    capacity: 2.7e6,
    diffusivity: 1e-6,
    ambient: 400.0,
    pressurisation: Some(FLUID),
};
const FLUID: Pressurisation = Pressurisation { coefficient: 1e5, diffusivity: 1e-5 };
/// Friction coefficient, effective normal traction at the start \[Pa\] and slip rate \[m/s\] of the closed forms.
const FRICTION: f64 = 0.6;
const NORMAL: f64 = 50e6;
const RATE: f64 = 1.0;
/// Relative error of the sum over modes, as the module `modes` of the crate states it.
const MODES: f64 = 2e-6;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    densities(ledger);
    constant_flux(ledger)?;
    adiabatic(ledger)?;
    plane(ledger)?;
    order(ledger)?;
    events::run(ledger)
}

/// Claims the density of heat at the centre of a zone, at times over fifteen decades.
fn densities(ledger: &mut Ledger) {
    let (width, longest) = (LAYER.width(), 3e10);
    let (modes, cost) = Cost::measure(|| Modes::new(width, LAYER.diffusivity, longest));
    let exact = |s: f64| 1.0 / (2.0 * PI * (width * width + 2.0 * LAYER.diffusivity * s)).sqrt();
    let times = (0..=300).map(|k| 1e-5 * (longest / 1e-5_f64).powf(f64::from(k) / 300.0));
    let error = |s: f64| (modes.density(s) / exact(s) - 1.0).abs();
    let worst = times.chain([0.0]).map(error).fold(0.0, f64::max);
    ledger
        .claim(format!(
            "density of heat at the centre by {} modes, from 0 s to 1000 yr: largest relative error",
            modes.len()
        ))
        .value(worst)
        .at_most(MODES)
        .evidence(Evidence::Exact, "a Gaussian that spreads, 1/sqrt(2 pi (w^2 + 2 alpha s))")
        .because(
            "1.0e-6 of the trapezoidal rule, 2e-7 above the largest wave number and 5e-7 below the smallest",
        )
        .covers(&[Capability::FrictionalHeat])
        .cost(&cost)
        .record();
}

/// Claims the temperature under constant heating, in a zone and at times at which it is a plane.
fn constant_flux(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (flux, width) = (3e7, LAYER.width());
    let zone = |time: f64| {
        let spread = (width * width + 2.0 * LAYER.diffusivity * time).sqrt();
        flux / LAYER.capacity * (spread - width) / (LAYER.diffusivity * (2.0 * PI).sqrt())
    };
    let half_space = |time: f64| flux / LAYER.capacity * (time / (PI * LAYER.diffusivity)).sqrt();
    let (mut worst, mut last) = (0.0_f64, 0.0);
    let end = 1e6;
    let (steps, cost) = Cost::measure(|| {
        heated(LAYER, &|_, _| flux, (end, Steps::Error(1.0)), &mut |time, surface| {
            last = surface.temperature[0] - LAYER.ambient;
            worst = worst.max((last / zone(time) - 1.0).abs());
        })
    });
    let cost = cost.count("steps", steps? as f64);
    ledger
        .claim(
            "temperature under constant heating, largest relative error over the steps of a run of 12 days",
        )
        .value(worst)
        .at_most(MODES)
        .evidence(Evidence::Exact, "q (sqrt(w^2 + 2 alpha t) - w)/(rho c alpha sqrt(2 pi))")
        .because("a constant is integrated exactly in steps of any length; the error is that of the modes")
        .why_not_tighter("the integral over time averages an error that oscillates")
        .covers(&[Capability::FrictionalHeat])
        .cost(&cost)
        .record();
    // The zone is colder than a plane by its width over the distance of diffusion.
    let share = width / (2.0 * LAYER.diffusivity * end).sqrt();
    ledger
        .claim("temperature of a half-space under constant flux on each side, relative error")
        .value((last / half_space(end) - 1.0).abs())
        .at_most(1.01 * share)
        .evidence(Evidence::Exact, "q/2 on each side: T = q sqrt(t/(pi alpha))/(rho c)")
        .because("the zone is not a plane: it is colder by w/sqrt(2 alpha t) of it")
        .covers(&[Capability::FrictionalHeat])
        .cost(&cost)
        .record();
    Ok(())
}

/// Claims the strength of fluid and heat that cannot escape (Rice 2006).
fn adiabatic(ledger: &mut Ledger) -> Result<(), CaseError> {
    let tight = 1e-16;
    let fluid = Pressurisation { diffusivity: 3.0 * tight, ..FLUID };
    let layer = Layer { diffusivity: tight, pressurisation: Some(fluid), ..LAYER };
    let decay = layer.capacity * layer.thickness / (FRICTION * fluid.coefficient);
    let end = 4.0 * decay / RATE;
    let mut worst = 0.0_f64;
    let (steps, cost) = Cost::measure(|| {
        let heating = |_: f64, pressure: f64| FRICTION * (NORMAL - pressure) * RATE;
        heated(layer, &heating, (end, Steps::Error(1e-3)), &mut |time, surface| {
            let exact = (-RATE * time / decay).exp();
            worst = worst.max((1.0 - surface.pressure[0] / NORMAL - exact).abs());
        })
    });
    let cost = cost.count("steps", steps? as f64);
    ledger
        .claim("strength without drainage and conduction up to a slip of 4 delta_c, over the initial strength: largest error")
        .value(worst)
        .at_most(MODES)
        .evidence(Evidence::Exact, "exp(-delta/delta_c), delta_c = rho c h/(f Lambda): Rice (2006)")
        .because("an error e of the density changes delta_c, and the strength by e x exp(-x) with x = delta/delta_c")
        .why_not_tighter("the density at time 0 errs by less than the bound for all times")
        .covers(&[Capability::FrictionalHeat])
        .cost(&cost)
        .record();
    Ok(())
}

/// Rice's slip length L* \[m\] of slip on a plane.
fn slip_length() -> f64 {
    let roots = FLUID.diffusivity.sqrt() + LAYER.diffusivity.sqrt();
    4.0 / (FRICTION * FRICTION) * (LAYER.capacity / FLUID.coefficient * roots).powi(2) / RATE
}

/// Slip at which strengths on a plane are compared, over L*.
const FAR: f64 = 4.0;
/// The thinnest zone that is compared with a plane \[m\].
const FINEST: f64 = 4e-5;

/// Claims the strength of slip on a plane (Rice 2006) as the limit of thin zones.
fn plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let length = slip_length();
    let exact = |x: f64| x.exp() * libm::erfc(x.sqrt());
    let (mut levels, mut spent, mut curve) = (Vec::new(), None, Vec::new());
    for thickness in [3.2e-4, 1.6e-4, 8e-5, FINEST] {
        let layer = Layer { thickness, ..LAYER };
        let heating = |_: f64, pressure: f64| FRICTION * (NORMAL - pressure) * RATE;
        let mut last = 0.0;
        curve.clear();
        let (steps, cost) = Cost::measure(|| {
            let end = FAR * length / RATE;
            heated(layer, &heating, (end, Steps::Error(1e-4)), &mut |time, surface| {
                last = 1.0 - surface.pressure[0] / NORMAL;
                curve.push((RATE * time / length, last));
            })
        });
        spent = Some(cost.count("steps", steps? as f64));
        levels.push((thickness, (last / exact(FAR) - 1.0).abs()));
    }
    let cost = spent.ok_or("no level")?;
    let width = Layer { thickness: FINEST, ..LAYER }.width();
    ledger
        .order("strength of slip on a plane after a slip of 4 L*, against the thickness of the zone")
        .levels(&levels)
        .expected(2.0)
        .within(0.15)
        .evidence(Evidence::Exact, "f (sigma_n - p_0) exp(delta/L*) erfc(sqrt(delta/L*)): Rice (2006)")
        .because("what the densities lack beside those of a plane is w/sqrt(2 pi) in all, for heat and fluid alike: it cancels in the pressure, and w^2 is left")
        .finest(
            width * width * RATE / (4.0 * LAYER.diffusivity * FAR * length),
            "kernels are those of a plane w^2/(2 alpha) later, and the strength falls with the root of time",
        )
        .covers(&[Capability::FrictionalHeat])
        .cost(&cost)
        .record();
    let exact: Vec<(f64, f64)> =
        (0..=200).map(|k| f64::from(k) * FAR / 200.0).map(|x| (x, exact(x))).collect();
    ledger.plot(
        Plot::xy("Strength of slip on a plane", "slip over L* [-]", "strength over that at the start [-]")
            .series(Series::line("closed form", &exact))
            .series(Series::line("zone of 40 um", &curve)),
    );
    Ok(())
}

/// ∫ g(t - s) exp(s/τ) ds over (0, t) with a diffusivity, in closed form \[s/m\].
fn grown(diffusivity: f64, tau: f64, time: f64) -> f64 {
    let (w, s) = (LAYER.width(), 1.0 / tau);
    let end = |u: f64| libm::erf((s * u / (2.0 * diffusivity)).sqrt());
    let factor = (s * (time + w * w / (2.0 * diffusivity))).exp() / (2.0 * diffusivity);
    let spread = w * w + 2.0 * diffusivity * time;
    factor * (diffusivity / s).sqrt() * (end(spread) - end(w * w))
}

/// Claims the order in the length of steps, for heating that grows exponentially.
fn order(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (tau, end, flux) = (0.5, 2.0, 1e6);
    let thermal = flux * grown(LAYER.diffusivity, tau, end);
    let own = flux * grown(FLUID.diffusivity, tau, end);
    let warmer = thermal / LAYER.capacity;
    let factor = FLUID.coefficient / (LAYER.capacity * (FLUID.diffusivity - LAYER.diffusivity));
    let pressure = factor * (FLUID.diffusivity * own - LAYER.diffusivity * thermal);
    let (mut levels, mut spent) = ([Vec::new(), Vec::new()], None);
    for count in [8, 16, 32] {
        let mut last = [0.0; 2];
        let (steps, cost) = Cost::measure(|| {
            let heating = |time: f64, _: f64| flux * (time / tau).exp();
            heated(LAYER, &heating, (end, Steps::Equal(count)), &mut |_, surface| {
                last = [surface.temperature[0] - LAYER.ambient, surface.pressure[0]];
            })
        });
        spent = Some(cost.count("steps", steps? as f64));
        let length = end / count as f64;
        levels[0].push((length, (last[0] / warmer - 1.0).abs()));
        levels[1].push((length, (last[1] / pressure - 1.0).abs()));
    }
    let cost = spent.ok_or("no level")?;
    // Order, and why it is expected.
    let expected = [
        (
            3.75,
            "steps of 0.06 to 0.25 s are about the time w^2/alpha = 0.16 s of thermal diffusion over the zone, between the orders 4 of shorter and 3.5 of longer steps",
        ),
        (3.5, "steps of 0.06 to 0.25 s are longer than the time w^2/alpha = 0.016 s of fluid in the zone"),
    ];
    for ((what, levels), (order, because)) in
        ["temperature", "pore pressure"].into_iter().zip(&levels).zip(expected)
    {
        ledger
            .order(format!("{what} of heating that grows e-fold in 0.5 s, against the length of steps"))
            .levels(levels)
            .expected(order)
            .within(0.25)
            .evidence(Evidence::Exact, "error functions of the Gaussian kernel and an exponential")
            .because(because)
            .finest(5e-6, "an eighth of the growth time: (1/8)^4/60, and the error of the modes, 2e-6 and more for the difference of two densities")
            .why_not_tighter("errors of steps and of modes may cancel")
            .covers(&[Capability::FrictionalHeat])
            .cost(&cost)
            .record();
    }
    let line = |k: usize, name: &str| Series::line(name, &levels[k]);
    ledger.plot(
        Plot::xy("Error after 2 s", "length of steps [s]", "relative error [-]")
            .axes(Axis::Log, Axis::Log)
            .series(line(0, "temperature"))
            .series(line(1, "pore pressure")),
    );
    Ok(())
}
