//! Identity of runs of faults that are parts of one run: their physics is the same, even if one of them lasts longer.

use asperity_plan::faults::Plan;

/// Hash of the physics of the scene `text` and of mesh files with these hashes. It leaves out the entries that only determine the extent of a run or
/// the description of its events: title, `events.stop_after`, the duration of the last stage and `[place]`. The layout of the file has no effect. The effect
/// of the duration on the loads so far is checked separately; see [`loads`].
#[must_use]
pub fn physics<'a>(text: &str, meshes: impl Iterator<Item = &'a str>) -> String {
    crate::checkpoint::scene::hash(text, without_extent, meshes)
}

fn without_extent(scene: &mut toml::Table) {
    scene.remove("place");
    if let Some(events) = scene.get_mut("events").and_then(toml::Value::as_table_mut) {
        events.remove("stop_after");
    }
    let stages = scene.get_mut("stages").and_then(toml::Value::as_array_mut);
    if let Some(last) = stages.and_then(|stages| stages.last_mut()).and_then(toml::Value::as_table_mut) {
        last.remove("duration");
    }
}

/// Loads until `at`, in parts between changes of rate. Each entry holds the end of the part (if before `at`) and two sums that identify the rates of
/// shear and of normal traction \[s, Pa/s\].
#[must_use]
pub fn loads(plan: &Plan, at: f64) -> Vec<[f64; 3]> {
    let end = plan.problem.settings.end;
    let mut ends = plan.problem.loading.breaks(0.0, end);
    ends.push(end);
    let mut parts = Vec::new();
    let mut begin = 0.0;
    for end in ends {
        let rates = plan.problem.loading.rates(0.5 * (begin + end), plan.points.len(), true);
        // The weights differ from point to point, so that a load at other points gives another sum.
        let sum = |rates: &[f64]| rates.iter().enumerate().map(|(i, r)| r * (1.0 + (i as f64).sin())).sum();
        parts.push([if end < at { end } else { f64::MAX }, sum(&rates.0), sum(&rates.1)]);
        if end >= at {
            break;
        }
        begin = end;
    }
    parts
}

/// Relative rounding error of a rate that is given as the value at the end of a stage.
const ROUNDING: f64 = 1e-12;

/// True if the loads are the same to within rounding.
#[must_use]
pub fn same(a: &[[f64; 3]], b: &[[f64; 3]]) -> bool {
    let near = |(x, y): (&f64, &f64)| (x - y).abs() <= ROUNDING * x.abs().max(y.abs());
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.iter().zip(b).all(near))
}
