//! A measured course with noise: where adaptive steps end.

use super::texts;
use crate::{Capability, CaseError, Evidence, Ledger};

/// Course without its noise: times \[s\] and displacements \[mm\].
const COURSE: [[f64; 2]; 5] = [[0.0, 0.0], [4.0, 1.0], [6.0, 1.0], [9.0, 0.25], [10.0, 0.25]];
/// Largest noise \[mm\], a fifth of what steps pass over.
const NOISE: f64 = 2e-5;
/// Length of the bar \[mm\].
const LENGTH: f64 = 2e3;

/// The course at a time.
fn course(t: f64) -> f64 {
    let piece = COURSE.windows(2).find(|w| t <= w[1][0]).unwrap_or(&COURSE[3..]);
    let [[a, from], [b, to]] = [piece[0], piece[1]];
    from + (to - from) * (t - a) / (b - a)
}

fn scene(stepper: &str) -> String {
    let entry = |k: i32| {
        let t = f64::from(k) / 10.0;
        let corner = COURSE.iter().any(|c| c[0] == t);
        // Noise without a pattern, which leaves the corners in place.
        let noise =
            if corner { 0.0 } else { NOISE * (2.0 * (f64::from(k) * 0.618_033_988_749_894_9).fract() - 1.0) };
        format!("[{t:?}, {:?}]", 1e-3 * (course(t) + noise))
    };
    let rows: Vec<String> = (0..=100).map(entry).collect();
    format!(
        "schema = 1\ntitle = \"a measured course\"\nkinematics = \"plane-strain\"\n[materials.rock]\nyoung = 10e9\npoisson = 0\n\
         [bodies.bar]\nmaterial = \"rock\"\nmesh.block = {{ min = [0, 0], max = [{:?}, 1], divisions = [2, 1], element = \"quad4\" }}\n\
         [[stages]]\nname = \"draw\"\nduration = 10\nconditions = [{{ set = \"bar.left\", x = 0 }}, {{ set = \"bar.bottom\", y = 0 }}, \
         {{ set = \"bar.right\", x = {{ table = [{}] }} }}]\n\
         [time]\nstepper = \"{stepper}\"\nmax_step = 3\nfirst_step = 1\n[output]\npoints.end = {{ body = \"bar\", at = [{:?}, 0.5] }}\n",
        1e-3 * LENGTH,
        rows.join(", "),
        1e-3 * LENGTH
    )
}

/// See the module.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    for stepper in ["implicit", "static-explicit"] {
        let done = texts::simulate(&scene(stepper))?;
        let times = done.record.times();
        let corners: Vec<f64> = COURSE[1..].iter().map(|c| c[0]).collect();
        let nearest = |corner: &f64| {
            times
                .iter()
                .copied()
                .min_by(|a, b| (a - corner).abs().total_cmp(&(b - corner).abs()))
                .unwrap_or(f64::NAN)
        };
        ledger
            .claim(format!(
                "ends of steps nearest to the corners of a measured course with noise, {stepper} steps"
            ))
            .unit("s")
            .values(&corners.iter().map(nearest).collect::<Vec<_>>())
            .equals_each(&corners)
            .absolute(1e-9)
            .evidence(
                Evidence::Exact,
                "the corners of the course without its noise, of a fifth of the tolerance of courses",
            )
            .because("steps end at corners, to rounding; entries are a tenth of a second apart")
            .why_not_tighter("there is nothing but rounding")
            .covers(&[Capability::Loads, Capability::Stages])
            .cost(&done.cost)
            .record();
        let found: Vec<f64> =
            done.record.samples().iter().map(|s| 1e3 * s.points[0].displacement[0]).collect();
        let exact: Vec<f64> = times.iter().map(|t| course(*t)).collect();
        ledger
            .claim(format!("displacement of a bar along a measured course with noise, {stepper} steps"))
            .unit("mm")
            .values(&found)
            .equals_each(&exact)
            .absolute(2.0 * NOISE)
            .evidence(Evidence::Exact, "the course without its noise")
            .because("the noise, which the entries on both sides of a time may have")
            .covers(&[Capability::Loads, Capability::Stages])
            .cost(&done.cost)
            .record();
        // A step moves the course by a twentieth of its range: 20, 1, 15 and 1 steps, and as many in the shares of entries that a
        // corner of the noise would make of each.
        ledger
            .claim(format!("steps along a measured course with noise over those along its four straight parts, {stepper} steps"))
            .value(times.len() as f64 / 37.0)
            .equals(1.0)
            .absolute(0.2)
            .evidence(Evidence::Exact, "a twentieth of the range in each step: 20, 1, 15 and 1 steps, with a largest step of 3 s")
            .because("first steps are shorter than the longest ones; a corner at each entry would make 100 of them")
            .covers(&[Capability::Loads, Capability::Stages])
            .cost(&done.cost)
            .record();
    }
    Ok(())
}
