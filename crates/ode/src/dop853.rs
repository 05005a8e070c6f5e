//! Dormand and Prince's explicit method of order 8, with error estimates of order 5 and 3 and dense output of order 7.
//!
//! Source: E. Hairer, S. P. Norsett, G. Wanner, "Solving Ordinary Differential Equations I", 2nd ed. (1993), section II.10 and the
//! authors' code DOP853.

use super::dop853_table as table;
use super::dop853_table::{DENSE, ERROR_FIFTH, ERROR_THIRD, EXTENDED, NODES, STAGES, WEIGHTS};
use super::explicit::{Control, combine};
use super::one_step::{Formula, Span, Trial};
use super::problem::System;
use std::cell::{Cell, RefCell};

/// Coefficients of the dense output: those of Hermite's cubic and four above.
const COEFFICIENTS: usize = 7;

/// The method.
#[derive(Debug)]
pub(super) struct Dop853 {
    /// Rates of the stages, one after the other.
    k: RefCell<Vec<f64>>,
    stage: RefCell<Vec<f64>>,
    /// Coefficients of the dense output of the step last tried, valid where `dense_ready`.
    dense: RefCell<Vec<f64>>,
    dense_ready: Cell<bool>,
    fifth: Vec<f64>,
    third: Vec<f64>,
    /// State of the twelfth stage.
    twelfth: Vec<f64>,
    control: Control,
}

/// Weight of the third order estimate in the error.
const THIRD: f64 = 0.01;

impl Dop853 {
    pub fn new(size: usize) -> Self {
        Self {
            k: RefCell::new(vec![0.0; EXTENDED * size]),
            stage: RefCell::new(vec![0.0; size]),
            dense: RefCell::new(vec![0.0; COEFFICIENTS * size]),
            dense_ready: Cell::new(false),
            fifth: vec![0.0; size],
            third: vec![0.0; size],
            twelfth: vec![0.0; size],
            control: Control::new(8.0, 0.2, 1.0 / 3.0, 6.0),
        }
    }

    /// An estimate of `h |λ|` for the fastest decay, from the last stage and the end of the step, which are at the same time.
    pub fn stretch(&self, system: &System<'_>, span: &Span) -> f64 {
        let (n, k) = (span.y0.len(), self.k.borrow());
        let last = &k[(STAGES - 1) * n..STAGES * n];
        let (mut rates, mut states) = (0.0, 0.0);
        for (i, (rate, atol)) in last.iter().zip(system.atol).enumerate() {
            rates += ((span.f1[i] - rate) / atol).powi(2);
            states += ((span.y1[i] - self.twelfth[i]) / atol).powi(2);
        }
        if states > 0.0 { span.h * (rates / states).sqrt() } else { 0.0 }
    }

    /// Computes the three further stages and the coefficients.
    fn prepare(&self, system: &System<'_>, span: &Span) {
        let n = span.y0.len();
        let (mut k, mut stage, mut dense) =
            (self.k.borrow_mut(), self.stage.borrow_mut(), self.dense.borrow_mut());
        let (y0, y1, f0, f1, h) = (&span.y0, &span.y1, &span.f0, &span.f1, span.h);
        k[STAGES * n..(STAGES + 1) * n].copy_from_slice(f1);
        take_stage(system, span, &table::STAGE_14, &mut k, &mut stage);
        take_stage(system, span, &table::STAGE_15, &mut k, &mut stage);
        take_stage(system, span, &table::STAGE_16, &mut k, &mut stage);
        for i in 0..n {
            let rise = y1[i] - y0[i];
            dense[i] = rise;
            dense[n + i] = h * f0[i] - rise;
            dense[2 * n + i] = 2.0 * rise - h * (f0[i] + f1[i]);
        }
        for (row, coefficients) in DENSE.iter().zip(dense.chunks_exact_mut(n).skip(3)) {
            for (i, c) in coefficients.iter_mut().enumerate() {
                *c = h * row.iter().zip(k.chunks_exact(n)).map(|(w, rates)| w * rates[i]).sum::<f64>();
            }
        }
        self.dense_ready.set(true);
    }
}

/// Computes the rates of the stage after the first `S`.
#[inline(always)]
fn take_stage<const S: usize>(
    system: &System<'_>,
    span: &Span,
    weights: &[f64; S],
    k: &mut [f64],
    stage: &mut [f64],
) {
    let n = span.y0.len();
    combine(stage, &span.y0, span.h, weights, k);
    system.rates(span.t + NODES[S] * span.h, stage, &mut k[S * n..(S + 1) * n]);
}

impl Formula for Dop853 {
    fn order(&self) -> i32 {
        8
    }

    fn attempt(&mut self, system: &System<'_>, span: &mut Span) -> Trial {
        self.dense_ready.set(false);
        let n = span.y0.len();
        let (h, k, stage) = (span.h, self.k.get_mut(), self.stage.get_mut());
        k[..n].copy_from_slice(&span.f0);
        take_stage(system, span, &table::STAGE_2, k, stage);
        take_stage(system, span, &table::STAGE_3, k, stage);
        take_stage(system, span, &table::STAGE_4, k, stage);
        take_stage(system, span, &table::STAGE_5, k, stage);
        take_stage(system, span, &table::STAGE_6, k, stage);
        take_stage(system, span, &table::STAGE_7, k, stage);
        take_stage(system, span, &table::STAGE_8, k, stage);
        take_stage(system, span, &table::STAGE_9, k, stage);
        take_stage(system, span, &table::STAGE_10, k, stage);
        take_stage(system, span, &table::STAGE_11, k, stage);
        take_stage(system, span, &table::STAGE_12, k, stage);
        self.twelfth.copy_from_slice(stage);
        combine(&mut span.y1, &span.y0, h, &WEIGHTS, k);
        stage.fill(0.0);
        combine(&mut self.fifth, stage, h, &ERROR_FIFTH, k);
        combine(&mut self.third, stage, h, &ERROR_THIRD, k);
        let fifth = system.norm(&self.fifth, &span.y0, &span.y1);
        let third = system.norm(&self.third, &span.y0, &span.y1);
        let both = (fifth * fifth + THIRD * third * third).sqrt();
        let error = if both == 0.0 { 0.0 } else { fifth * fifth / both };
        if error <= 1.0 {
            system.rates(span.t + h, &span.y1, &mut span.f1);
        }
        Trial::Error(error)
    }

    fn complete(&mut self, system: &System<'_>, span: &mut Span) {
        system.rates(span.t + span.h, &span.y1, &mut span.f1);
    }

    fn share(&mut self, h: f64, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        self.control.share(h, error, accepted, rejected_before)
    }

    fn forget(&mut self) {
        self.control.forget();
    }

    fn interpolate(&self, system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]) {
        if !self.dense_ready.get() {
            self.prepare(system, span);
        }
        let dense = self.dense.borrow();
        let n = y.len();
        y.fill(0.0);
        for (number, coefficients) in dense.chunks_exact(n).enumerate().rev() {
            let factor = if number % 2 == 0 { fraction } else { 1.0 - fraction };
            for (value, c) in y.iter_mut().zip(coefficients) {
                *value = (*value + c) * factor;
            }
        }
        for (value, start) in y.iter_mut().zip(&span.y0) {
            *value += start;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::table::*;

    /// Rows of the stage weights, by stage number from 0.
    fn rows() -> [&'static [f64]; EXTENDED] {
        [
            &[],
            &STAGE_2,
            &STAGE_3,
            &STAGE_4,
            &STAGE_5,
            &STAGE_6,
            &STAGE_7,
            &STAGE_8,
            &STAGE_9,
            &STAGE_10,
            &STAGE_11,
            &STAGE_12,
            &WEIGHTS,
            &STAGE_14,
            &STAGE_15,
            &STAGE_16,
        ]
    }

    fn power(k: i32) -> Vec<f64> {
        NODES.iter().map(|c| c.powi(k)).collect()
    }

    /// The weights of the stages applied to `values`.
    fn apply(values: &[f64]) -> Vec<f64> {
        rows().iter().map(|row| dot(row, values)).collect()
    }

    fn dot(weights: &[f64], values: &[f64]) -> f64 {
        weights.iter().zip(values).map(|(w, v)| w * v).sum()
    }

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-13, "{a} is not {b}");
    }

    #[test]
    fn the_nodes_are_the_sums_of_the_rows() {
        for (sum, node) in apply(&power(0)).iter().zip(NODES) {
            near(*sum, node);
        }
    }

    #[test]
    fn the_weights_satisfy_conditions_of_order_eight() {
        for k in 0..8 {
            near(dot(&WEIGHTS, &power(k)), 1.0 / f64::from(k + 1));
        }
        // Trees with one branch: sum b_i c_i^j sum a_ik c_k^l = 1/((l + 1)(j + l + 2)).
        for (j, l) in (0..7).flat_map(|j| (0..7 - j).map(move |l| (j, l))) {
            let inner: Vec<f64> = apply(&power(l)).iter().zip(power(j)).map(|(a, c)| a * c).collect();
            near(dot(&WEIGHTS, &inner), 1.0 / f64::from((l + 1) * (j + l + 2)));
        }
        // The tall tree: each level integrates the one above.
        let mut chain = power(0);
        let mut expected = 1.0;
        for level in 1..=8 {
            expected /= f64::from(level);
            near(dot(&WEIGHTS, &chain), expected);
            chain = apply(&chain);
        }
    }

    #[test]
    fn the_error_estimates_vanish_for_low_orders() {
        for k in 0..5 {
            near(dot(&ERROR_FIFTH, &power(k)), 0.0);
        }
        for k in 0..3 {
            near(dot(&ERROR_THIRD, &power(k)), 0.0);
        }
    }
}
