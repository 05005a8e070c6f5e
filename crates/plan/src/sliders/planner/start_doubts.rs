//! Starts of sliders that are probably not intended.

use crate::reading::scene::model::Spanned;
use crate::reading::scene::slider::{SliderScene, SliderSpec};
use crate::sliders::Plan;
use asperity_cycles::slider::stability;
use asperity_friction::slider::History;
use asperity_run::Warning;
use std::ops::Range;

/// Slip rate of a slider at the start \[m/s\], and its position in the scene.
fn start(spec: &SliderSpec) -> Option<(f64, Range<usize>)> {
    let law = spec.law.get_ref();
    let steady = law.v_initial.as_ref().or(law.v_ref.as_ref()).map(|v| (v.get_ref().0, v.span()));
    spec.start.as_ref().map(|v| (v.get_ref().0, v.span())).or(steady)
}

/// True if a slider has the state of steady slip at this rate \[m/s\], under a normal traction that stays.
fn is_steady(spec: &SliderSpec, normal: &History, rate: f64) -> bool {
    let law = spec.law.get_ref();
    let of_state = law.v_initial.as_ref().or(law.v_ref.as_ref()).is_none_or(|v| v.get_ref().0 == rate);
    let History::Constant(normal) = normal else { return false };
    of_state && law.normal_initial.as_ref().is_none_or(|before| before.get_ref().0 == *normal)
}

/// A warning for sliders that all slide with the load point, steadily and unstably: only rounding ends it.
fn equilibrium(scene: &SliderScene, plan: &Plan) -> Option<Warning> {
    let system = &plan.problem.system;
    let History::Constant(load) = system.load() else { return None };
    let mut each = scene.sliders.values().zip(system.sliders()).enumerate();
    let rests = each.all(|(i, (spec, slider))| {
        let rate = start(spec.get_ref()).map(|s| s.0);
        system.imposed(i).is_none() && rate == Some(*load) && is_steady(spec.get_ref(), &slider.normal, *load)
    });
    let unstable =
        stability::against(&plan.problem).iter().position(|one| one.is_some_and(|a| a.unstable))?;
    let (name, spec) = scene.sliders.iter().nth(unstable)?;
    let place = start(spec.get_ref())?.1;
    rests.then(|| {
        Warning::at(
            place,
            format!("`{name}` starts in steady slip with the load point, which is unstable: rounding decides when the first event comes"),
            "another `start`, such as 1.1 times the rate of the load point",
        )
    })
}

/// Warnings for sliders that start against their load.
fn against(scene: &SliderScene, plan: &Plan) -> Vec<Warning> {
    let system = &plan.problem.system;
    let load = system.segment(0.0).load().at(0.0).0;
    let of = |(i, (name, spec)): (usize, (&String, &Spanned<SliderSpec>))| {
        let (rate, place) = start(spec.get_ref())?;
        let driven = system.imposed(i).is_none() && system.sliders()[i].stiffness > 0.0;
        (driven && rate * load < 0.0).then(|| {
            Warning::at(
                place,
                format!(
                    "`{name}` starts at {rate:e} m/s against its load point, which moves at {load:e} m/s"
                ),
                "turn the sign of one of them: `start` is the slip rate at time 0",
            )
        })
    };
    scene.sliders.iter().enumerate().filter_map(of).collect()
}

/// Warnings about the start of sliders.
pub(super) fn starts(scene: &SliderScene, plan: &Plan) -> Vec<Warning> {
    equilibrium(scene, plan).into_iter().chain(against(scene, plan)).collect()
}
