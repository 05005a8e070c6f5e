//! Tsitouras' explicit method of order 5(4) with its free dense output of order 4.
//!
//! Source: Ch. Tsitouras, "Runge-Kutta pairs of order 5(4) satisfying only the first column simplifying assumption", Computers &
//! Mathematics with Applications 62 (2011) 770-775.

use super::explicit::{Control, combine};
use super::one_step::{Formula, Span, Trial};
use super::problem::System;

/// Stages; the last is the rate at the end of the step.
const STAGES: usize = 7;

/// Nodes of the second to the sixth stage, as fractions of the step.
const NODES: [f64; 5] = [0.161, 0.327, 0.9, 0.980_025_540_904_509_7, 1.0];

/// Weights of the rates in the second to the sixth stage.
const SECOND: [f64; 1] = [0.161];
const THIRD: [f64; 2] = [-0.008_480_655_492_356_989, 0.335_480_655_492_357];
const FOURTH: [f64; 3] = [2.897_153_057_105_493, -6.359_448_489_975_075, 4.362_295_432_869_581_5];
const FIFTH: [f64; 4] =
    [5.325_864_828_439_257, -11.748_883_564_062_828, 7.495_539_342_889_836_5, -0.092_495_066_361_755_25];
const SIXTH: [f64; 5] = [
    5.861_455_442_946_42,
    -12.920_969_317_847_11,
    8.159_367_898_576_159,
    -0.071_584_973_281_401,
    -0.028_269_050_394_068_383,
];
/// Weights of the rates in the step.
const WEIGHTS: [f64; 6] = [
    0.096_460_766_818_065_23,
    0.01,
    0.479_889_650_414_499_6,
    1.379_008_574_103_742,
    -3.290_069_515_436_081,
    2.324_710_524_099_774,
];

/// Weights of the rates in the error estimate.
const ERROR: [f64; STAGES] = [
    -0.001_780_011_052_225_777,
    -0.000_816_434_459_656_746_9,
    0.007_880_878_010_261_995,
    -0.144_711_007_173_262_9,
    0.582_357_165_452_555_2,
    -0.458_082_105_929_186_97,
    1.0 / 66.0,
];

/// Coefficients of the second, third and fourth power of the fraction of the step in the weights of the dense output; only the
/// first rate has a first power.
const DENSE: [[f64; 3]; STAGES] = [
    [-2.763_706_197_274_826, 2.913_255_461_821_912_6, -1.053_088_497_729_021_6],
    [0.1317, -0.2234, 0.1017],
    [3.930_296_236_894_751_6, -5.941_033_872_131_505, 2.490_627_285_651_253],
    [-12.411_077_166_933_676, 30.338_188_630_282_32, -16.548_102_889_244_902],
    [37.509_313_416_511_04, -88.178_904_894_766_4, 47.379_521_962_819_28],
    [-27.896_526_289_197_286, 65.091_894_674_793_66, -34.870_657_861_496_61],
    [1.5, -4.0, 2.5],
];

/// The method.
#[derive(Debug)]
pub(super) struct Tsit5 {
    /// Rates of the stages, one after the other.
    k: Vec<f64>,
    stage: Vec<f64>,
    error: Vec<f64>,
    control: Control,
}

impl Tsit5 {
    pub fn new(size: usize) -> Self {
        Self {
            k: vec![0.0; STAGES * size],
            stage: vec![0.0; size],
            error: vec![0.0; size],
            control: Control::new(5.0, 0.75, 0.2, 10.0),
        }
    }

    /// Computes the rates of the stage after the first `S`.
    #[inline(always)]
    fn stage<const S: usize>(&mut self, system: &System<'_>, span: &Span, weights: &[f64; S]) {
        let n = span.y0.len();
        combine(&mut self.stage, &span.y0, span.h, weights, &self.k);
        system.rates(span.t + NODES[S - 1] * span.h, &self.stage, &mut self.k[S * n..(S + 1) * n]);
    }
}

impl Formula for Tsit5 {
    fn order(&self) -> i32 {
        5
    }

    fn attempt(&mut self, system: &System<'_>, span: &mut Span) -> Trial {
        let n = span.y0.len();
        let h = span.h;
        self.k[..n].copy_from_slice(&span.f0);
        self.stage(system, span, &SECOND);
        self.stage(system, span, &THIRD);
        self.stage(system, span, &FOURTH);
        self.stage(system, span, &FIFTH);
        self.stage(system, span, &SIXTH);
        combine(&mut span.y1, &span.y0, h, &WEIGHTS, &self.k);
        system.rates(span.t + h, &span.y1, &mut span.f1);
        self.k[(STAGES - 1) * n..].copy_from_slice(&span.f1);
        self.stage.fill(0.0);
        combine(&mut self.error, &self.stage, h, &ERROR, &self.k);
        Trial::Error(system.norm(&self.error, &span.y0, &span.y1))
    }

    fn share(&mut self, h: f64, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        self.control.share(h, error, accepted, rejected_before)
    }

    fn forget(&mut self) {
        self.control.forget();
    }

    fn interpolate(&self, _system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]) {
        let mut weights = DENSE.map(|[a, b, c]| fraction * fraction * (a + fraction * (b + fraction * c)));
        weights[0] += fraction;
        combine(y, &span.y0, span.h, &weights, &self.k);
    }
}

#[cfg(test)]
mod tests {
    use super::{DENSE, ERROR, FIFTH, FOURTH, NODES, SECOND, SIXTH, STAGES, THIRD, WEIGHTS};

    fn nodes() -> [f64; STAGES] {
        [0.0, NODES[0], NODES[1], NODES[2], NODES[3], NODES[4], 1.0]
    }

    fn dot(weights: &[f64], values: &[f64]) -> f64 {
        weights.iter().zip(values).map(|(w, v)| w * v).sum()
    }

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-13, "{a} is not {b}");
    }

    #[test]
    fn the_weights_satisfy_conditions_of_order_five() {
        let rows: [&[f64]; STAGES] = [&[], &SECOND, &THIRD, &FOURTH, &FIFTH, &SIXTH, &WEIGHTS];
        let power = |k: i32| nodes().map(|c| c.powi(k));
        for (row, node) in rows.iter().zip(nodes()) {
            near(row.iter().sum(), node);
        }
        for k in 0..5 {
            near(dot(&WEIGHTS, &power(k)), 1.0 / f64::from(k + 1));
        }
        for (j, l) in (0..4).flat_map(|j| (0..4 - j).map(move |l| (j, l))) {
            let inner: Vec<f64> = rows.iter().zip(power(j)).map(|(row, c)| c * dot(row, &power(l))).collect();
            near(dot(&WEIGHTS, &inner), 1.0 / f64::from((l + 1) * (j + l + 2)));
        }
        for k in 0..4 {
            near(dot(&ERROR, &power(k)), 0.0);
        }
    }

    #[test]
    fn the_dense_output_is_of_order_four_and_ends_at_the_step() {
        for x in [0.1_f64, 0.5, 0.9, 1.0] {
            let mut weights = DENSE.map(|[a, b, c]| x * x * (a + x * (b + x * c)));
            weights[0] += x;
            for k in 0..4 {
                near(dot(&weights, &nodes().map(|c| c.powi(k))), x.powi(k + 1) / f64::from(k + 1));
            }
        }
        let ends = DENSE.map(|[a, b, c]| a + b + c);
        for (s, weight) in WEIGHTS.into_iter().enumerate() {
            near(ends[s] + if s == 0 { 1.0 } else { 0.0 }, weight);
        }
    }
}
