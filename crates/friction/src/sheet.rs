//! Evaluation of many points with the regularised form and the ageing law at once.
//!
//! While μ/a is large, the form equals its logarithm and V is a single exponential; healing is another. Where it is not, V has a
//! second one, see [`Line`]. They are evaluated for several points together, by a polynomial that the compiler vectorises. Near
//! rest the equations of [`crate::slider`] are used, of which these are a special case.

use crate::drive::{Drive, UnknownRates, Unknowns};
use crate::slider::Line;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// Points evaluated together.
const LANES: usize = 8;

/// Groups of a task. Groups are independent, so that results do not depend on the number of threads.
const TASK: usize = 128;
/// Number of points from which they are divided into tasks: starting them takes some microseconds.
const WORTH_TASKS: usize = 8192;

/// Lines of [`LANES`] points.
#[derive(Clone, Copy, Debug)]
struct Lines {
    from: f64,
    least: f64,
    offset: [f64; LANES],
    per_a: [f64; LANES],
    a: [f64; LANES],
    b: [f64; LANES],
    healing: [f64; LANES],
    per_length: [f64; LANES],
}

/// Points in groups.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    lines: Vec<Lines>,
    arch: Arch,
}

/// m and s of a group of points.
struct Group {
    m: [f64; LANES],
    s: [f64; LANES],
}

impl Group {
    #[inline(always)]
    fn new(m: &[f64], s: &[f64]) -> Self {
        Self { m: load(m), s: load(s) }
    }

    /// |V| and ∂V/∂m.
    #[inline(always)]
    fn speed(&self, lines: &Lines) -> [LaneValues; 2] {
        let state = each(&each(&lines.b, &self.s, |b, s| b * s), &lines.per_a, |bs, per_a| bs * per_a);
        let size = each(&self.m, &self.m, |m, _| m.abs());
        let less = each(&size, &lines.offset, |m, offset| m - offset);
        let speed = exp(&each(&less, &state, |m, state| m - state));
        if size.iter().all(|m| *m > lines.from) {
            return [speed, speed];
        }
        let share = exp(&each(&size, &size, |m, _| -2.0 * m));
        [
            each(&speed, &share, |speed, share| speed * (1.0 - share)),
            each(&speed, &share, |speed, share| speed * (1.0 + share)),
        ]
    }
}

impl Sheet {
    /// Sheet of points that have a line each; the last group is padded with the last of them.
    pub fn new(points: &[Line]) -> Self {
        let group = |lines: &[Line]| {
            let of =
                |value: &dyn Fn(&Line) -> f64| std::array::from_fn(|k| value(&lines[k.min(lines.len() - 1)]));
            Lines {
                from: lines.iter().map(|l| l.from).fold(0.0, f64::max),
                least: lines.iter().map(|l| l.least).fold(0.0, f64::max),
                offset: of(&|l| l.offset),
                per_a: of(&|l| 1.0 / l.a),
                a: of(&|l| l.a),
                b: of(&|l| l.b),
                healing: of(&|l| l.healing),
                per_length: of(&|l| 1.0 / l.length),
            }
        };
        Self { lines: points.chunks(LANES).map(group).collect(), arch: Arch::new() }
    }

    /// Computes slip rates of all points \[m/s\]; `other` gives that of a point near rest.
    pub fn slip_rates(&self, now: Unknowns<'_>, rate: &mut [f64], other: impl Fn(usize) -> f64) {
        let (m, s) = (now.m.all(), now.states.all());
        let of_task = |task: usize, rate: &mut [f64]| {
            let points = task * TASK * LANES..task * TASK * LANES + rate.len();
            let (m, s) = (&m[points.clone()], &s[points]);
            self.arch.dispatch(SlipRates { lines: &self.lines[task * TASK..], m, s, rate });
        };
        if self.worth_tasks() {
            rate.par_chunks_mut(TASK * LANES).enumerate().for_each(|(task, rate)| of_task(task, rate));
        } else {
            rate.chunks_mut(TASK * LANES).enumerate().for_each(|(task, rate)| of_task(task, rate));
        }
        self.elsewhere(m, |k| rate[k] = other(k));
    }

    /// Computes rates of m and of the states \[1/s\]; `other` gives those of a point near rest.
    pub fn rates(
        &self,
        drive: &Drive<'_>,
        now: Unknowns<'_>,
        mut rates: UnknownRates<'_>,
        other: impl Fn(usize) -> [f64; 2],
    ) {
        let (m, s) = (now.m.all(), now.states.all());
        let (dm, ds) = (rates.m.all_mut(), rates.states.all_mut());
        let of_task = |task: usize, dm: &mut [f64], ds: &mut [f64]| {
            let points = task * TASK * LANES..task * TASK * LANES + dm.len();
            let (m, s, drive) = (&m[points.clone()], &s[points.clone()], drive.slice(points));
            self.arch.dispatch(Rates { lines: &self.lines[task * TASK..], drive: &drive, m, s, dm, ds });
        };
        let size = TASK * LANES;
        if self.worth_tasks() {
            let tasks = dm.par_chunks_mut(size).zip(ds.par_chunks_mut(size)).enumerate();
            tasks.for_each(|(task, (dm, ds))| of_task(task, dm, ds));
        } else {
            let tasks = dm.chunks_mut(size).zip(ds.chunks_mut(size)).enumerate();
            tasks.for_each(|(task, (dm, ds))| of_task(task, dm, ds));
        }
        self.elsewhere(m, |k| [dm[k], ds[k]] = other(k));
    }

    fn worth_tasks(&self) -> bool {
        self.lines.len() * LANES >= WORTH_TASKS
    }

    /// Calls `what` for the points near rest, including those whose m is not a number.
    fn elsewhere(&self, m: &[f64], mut what: impl FnMut(usize)) {
        for (g, (lines, m)) in self.lines.iter().zip(m.chunks(LANES)).enumerate() {
            for (k, m) in m.iter().enumerate() {
                let holds = m.abs() > lines.least;
                if !holds {
                    what(g * LANES + k);
                }
            }
        }
    }
}

/// Operation on all points with the vector units of the processor. It is not a closure: pulp calls closures through a function that is
/// compiled without those units.
struct SlipRates<'a> {
    lines: &'a [Lines],
    m: &'a [f64],
    s: &'a [f64],
    rate: &'a mut [f64],
}

impl WithSimd for SlipRates<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let points = self.m.chunks(LANES).zip(self.s.chunks(LANES)).zip(self.rate.chunks_mut(LANES));
        for (lines, ((m, s), rate)) in self.lines.iter().zip(points) {
            let [speed, _] = Group::new(m, s).speed(lines);
            for ((rate, speed), m) in rate.iter_mut().zip(speed).zip(m) {
                *rate = speed.copysign(*m);
            }
        }
    }
}

/// The same for rates of m and of the states.
struct Rates<'a> {
    lines: &'a [Lines],
    drive: &'a Drive<'a>,
    m: &'a [f64],
    s: &'a [f64],
    dm: &'a mut [f64],
    ds: &'a mut [f64],
}

impl WithSimd for Rates<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Drive { normal, shear_rate, damping, normal_rate } = *self.drive;
        let unknowns = self.m.chunks(LANES).zip(self.s.chunks(LANES));
        let forcing = normal.chunks(LANES).zip(shear_rate.all().chunks(LANES)).zip(damping.chunks(LANES));
        let rates = self.dm.chunks_mut(LANES).zip(self.ds.chunks_mut(LANES));
        let points = unknowns.zip(forcing).zip(rates).enumerate();
        for (lines, (g, (((m, s), ((normal, pull), damping)), (dm, ds)))) in self.lines.iter().zip(points) {
            let normal_rate = match normal_rate {
                Some(rates) => load(&rates[g * LANES..][..m.len()]),
                None => [0.0; LANES],
            };
            let (m_rate, s_rate) =
                Group::new(m, s).rates(lines, &load(normal), &normal_rate, &load(pull), &load(damping));
            dm.copy_from_slice(&m_rate[..dm.len()]);
            ds.copy_from_slice(&s_rate[..ds.len()]);
        }
    }
}

impl Group {
    /// Rates of m and s: the equations of [`crate::slider`] without springs, with P = ∂V/∂m and Q = -V b/a ds/dt.
    #[inline(always)]
    fn rates(
        &self,
        lines: &Lines,
        normal: &[f64; LANES],
        normal_rate: &[f64; LANES],
        pull: &[f64; LANES],
        damping: &[f64; LANES],
    ) -> ([f64; LANES], [f64; LANES]) {
        let [speed, slope] = self.speed(lines);
        let healing = exp(&each(&self.s, &self.s, |s, _| -s));
        let (mut dm, mut ds) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            ds[k] = lines.healing[k] * healing[k] - speed[k] * lines.per_length[k];
        }
        for k in 0..LANES {
            let drift = -speed[k].copysign(self.m[k]) * lines.per_a[k] * lines.b[k] * ds[k];
            let gained = pull[k] - self.m[k] * (normal_rate[k] * lines.a[k]) - damping[k] * drift;
            dm[k] = gained / (normal[k] * lines.a[k] + damping[k] * slope[k]);
        }
        (dm, ds)
    }
}

/// The values, padded with the last one.
#[inline(always)]
fn load(values: &[f64]) -> [f64; LANES] {
    match values.first_chunk::<LANES>() {
        Some(all) => *all,
        None => std::array::from_fn(|k| values[k.min(values.len() - 1)]),
    }
}

/// Arguments between which the result is a normal number.
const LEAST: f64 = -708.0;
const MOST: f64 = 709.0;
/// Constant whose addition rounds to an integer, which is then in the last bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts; this one has so few digits that its multiples are exact.
const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
/// Remainder of ln 2 after the first part.
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
/// Inverse factorials from 1/13! to 1: for |r| <= ln 2/2, the next term is 4e-18 of the sum.
const TERMS: [f64; 14] = [
    1.605_904_383_682_161_3e-10,
    2.087_675_698_786_81e-9,
    2.505_210_838_544_172e-8,
    2.755_731_922_398_589e-7,
    2.755_731_922_398_589_3e-6,
    2.480_158_730_158_73e-5,
    1.984_126_984_126_984e-4,
    1.388_888_888_888_889e-3,
    8.333_333_333_333_333e-3,
    4.166_666_666_666_666_4e-2,
    1.666_666_666_666_666_6e-1,
    0.5,
    1.0,
    1.0,
];

/// A value for each point of a group.
type LaneValues = [f64; LANES];

/// Applies an operation to each point. One operation at a time goes over all points, so that the compiler takes vectors of them.
#[inline(always)]
fn each(a: &LaneValues, b: &LaneValues, operation: impl Fn(f64, f64) -> f64) -> LaneValues {
    let mut all = [0.0; LANES];
    for k in 0..LANES {
        all[k] = operation(a[k], b[k]);
    }
    all
}

/// e^x to about an ulp, without branches. Below [`LEAST`] and above [`MOST`] it is the value there; NaN for x = NaN.
#[inline(always)]
fn exp(x: &LaneValues) -> LaneValues {
    // Comparisons with NaN are false, so that it is kept.
    let x = each(x, x, |x, _| if x < LEAST { LEAST } else { x });
    let x = each(&x, &x, |x, _| if x > MOST { MOST } else { x });
    let shifted = each(&x, &x, |x, _| x * std::f64::consts::LOG2_E + ROUND);
    let n = each(&shifted, &shifted, |shifted, _| shifted - ROUND);
    let r = each(&x, &n, |x, n| (x - n * LN_2_HIGH) - n * LN_2_LOW);
    let mut sum = [TERMS[0]; LANES];
    for term in &TERMS[1..] {
        sum = each(&sum, &r, |sum, r| sum * r + term);
    }
    each(&sum, &shifted, |sum, shifted| f64::from_bits(sum.to_bits().wrapping_add(shifted.to_bits() << 52)))
}

#[cfg(test)]
mod tests {
    use super::{LANES, exp};

    fn one(x: f64) -> f64 {
        exp(&[x; LANES])[0]
    }

    #[test]
    fn the_exponential_has_an_error_of_two_units_in_the_last_place() {
        let mut worst = 0.0_f64;
        for k in -70_000..=70_000 {
            let x = f64::from(k) * 0.010_1;
            worst = worst.max((one(x) / x.exp() - 1.0).abs());
        }
        assert!(worst <= 2.0 * f64::EPSILON, "{worst}");
        assert_eq!(one(0.0), 1.0);
    }

    #[test]
    fn what_is_no_number_stays_none_and_what_overflows_is_huge() {
        assert!(one(f64::NAN).is_nan());
        assert!(one(f64::INFINITY) > 1e307 && one(1e300) > 1e307);
        assert!(one(-1e300) < 1e-307 && one(-1e300) >= 0.0);
    }
}
