//! Critical stiffness: softer than that, a slider does not slide steadily.

use super::plan::Plan;
use asperity_friction::slider::{History, Slider};

/// Difference of ln V over which slopes are taken: what it leaves is of the order of its square.
const STEP: f64 = 1e-4;

/// The critical stiffness k_c of a slider that slides steadily at `rate` \[m/s\] under `normal` \[Pa\] beside springs whose other ends do
/// not change their rate: `(f_n/L)(b - a')(1 + n/a')` with `a' = a + eta V/f_n` and `n = M V^2/(f_n L)`, a and b being slopes of
/// friction by ln V there. 0: stable on any spring. None: the law has several states or remembers shear traction.
#[must_use]
pub fn critical_stiffness(slider: &Slider, rate: f64, normal: f64) -> Option<f64> {
    let law = &slider.law;
    let (speed, log) = (rate.abs(), rate.abs().ln());
    let Some(length) = law.length().filter(|_| law.states() > 0) else { return Some(0.0) };
    if law.states() != 1 || law.remembers_shear() {
        return None;
    }
    let mu = |log: f64, steady: f64| -> Option<f64> {
        let mut state = [0.0];
        law.steady(steady, &mut state);
        Some(law.scale() * law.at_rate(log.exp(), &state).ok()?)
    };
    let slope = |up: f64, down: f64| (up - down) / (2.0 * STEP);
    let a = slope(mu(log + STEP, log)?, mu(log - STEP, log)?);
    let b = a - slope(mu(log + STEP, log + STEP)?, mu(log - STEP, log - STEP)?);
    let a = a + slider.damping * speed / normal;
    let inertia = slider.mass.unwrap_or(0.0) * speed * speed / (normal * length);
    Some((normal / length * (b - a) * (1.0 + inertia / a)).max(0.0))
}

/// Of each slider: its stiffness K over the critical one under the load and the normal traction of time 0; the outer none where there is
/// nothing to compare.
fn ratios(plan: &Plan) -> Vec<Option<(f64, f64)>> {
    let rate = plan.system.load().piece(0.0).at(0.0).0;
    let each = plan.system.sliders().iter().enumerate();
    each.map(|(i, s)| {
        if rate == 0.0 || plan.system.imposed(i).is_some() {
            return None;
        }
        let critical = critical_stiffness(s, rate, s.normal.piece(0.0).at(0.0).0)?;
        Some((plan.system.stiffness(i), critical))
    })
    .collect()
}

/// Of each slider: its stability in words.
pub(super) fn words(plan: &Plan) -> Vec<Option<String>> {
    let coupled = !plan.system.springs().is_empty();
    let of = if coupled { "K of all its springs" } else { "k" };
    let each = ratios(plan).into_iter();
    each.map(|ratio| {
        ratio.map(|(stiffness, critical)| {
            if critical == 0.0 {
                "stable on any spring at the rate of the load point".to_string()
            } else {
                format!("{of}/k_c = {:.6}, k_c = {critical:.6e} Pa/m", stiffness / critical)
            }
        })
    })
    .collect()
}

/// What follows for the whole.
pub(super) fn remarks(plan: &Plan) -> Vec<String> {
    let steady = matches!(plan.system.load(), History::Constant(_))
        && plan.system.sliders().iter().all(|s| matches!(s.normal, History::Constant(_)));
    let mut ratios = ratios(plan).into_iter();
    let stable = ratios.all(|r| r.is_some_and(|(stiffness, critical)| stiffness >= critical));
    if plan.events.is_some() && steady && stable && plan.system.springs().is_empty() {
        return vec![
            "steady sliding at the rate of the load point is stable (k >= k_c): events come from the start alone, if at all"
                .to_string(),
        ];
    }
    Vec::new()
}

/// The sliders that run away: softer than critical, with neither damping nor mass.
pub(crate) fn runaways(plan: &Plan) -> Vec<(usize, f64)> {
    let each = ratios(plan).into_iter().enumerate();
    each.filter_map(|(i, ratio)| {
        let (stiffness, critical) = ratio?;
        let s = &plan.system.sliders()[i];
        let free = s.damping == 0.0 && s.mass.is_none();
        (free && stiffness < critical).then(|| (i, stiffness / critical))
    })
    .collect()
}
