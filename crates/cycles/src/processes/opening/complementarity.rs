//! Openings of faults, as the solution of a linear complementarity problem.
//!
//! N is the normal traction of the bodies without openings, less the pressure of fluid. Openings o add `C o`, with the
//! normal tractions C per opening of the condensed bodies. Where a fault may open
//!
//! ```text
//! o ≥ 0,   w = N + C o ≥ 0,   w o = 0
//! ```
//!
//! at each point: separated sides do not press on each other. With areas A, `A C` is symmetric and positive definite,
//! since the bodies are held. Therefore o is a unique function of N, continuous and piecewise linear (R. W. Cottle,
//! J.-S. Pang, R. E. Stone, "The Linear Complementarity Problem", 1992, theorems 3.1.6 and 3.1.7): it is not an unknown
//! in time. Its rate follows from that of N, `C_OO do_O/dt = -dN_O/dt` at the points O that are open, and shear
//! tractions of all points change at the rate `D do/dt`, with the shear tractions D per opening.
//!
//! O is found by exchanging all points that violate a condition, or one at a time where that makes no progress; this
//! ends after finitely many exchanges (J. J. Júdice, F. M. Pires, "A block principal pivoting algorithm for large-scale
//! strictly monotone linear complementarity problems", Computers and Operations Research 21, 1994). The search begins
//! from the points that were open last. Results do not depend on that, to the last bit: where a point is within
//! rounding of both states, the search is repeated from the points with N < 0.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use serde::{Deserialize, Serialize};

/// Violation of a condition that is tolerated, relative to the largest \|N\| of the points that may open: the rounding
/// of sums over some thousand points.
const ROUNDING: f64 = 1e-13;
/// Traction, or opening times its stiffness, relative to the largest \|N\|, above which the state of a point is
/// certain: rounding times a condition number of thousands.
const CLEAR: f64 = 1e-9;
/// Number of exchanges of all violating points that may fail to reduce their number before single points are exchanged,
/// as recommended by Júdice and Pires.
const PATIENCE: usize = 10;
/// Number of exchanges, plus ten for each point, after which the search gives up; a positive definite matrix takes
/// about ten in all.
const MOST_EXCHANGES: usize = 100;

/// Effect of openings on the tractions of all points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opening {
    /// Points that may open, ascending.
    points: Vec<usize>,
    /// Areas of these points \[m²; m per metre of thickness\].
    areas: Vec<f64>,
    /// Normal tractions of all points per opening, compression positive \[Pa/m\], opening by opening.
    normal: Vec<Vec<f64>>,
    /// Shear tractions of all points per opening, component by component; none where openings cause none.
    shear: Option<Vec<Vec<f64>>>,
}

/// The open points and their openings.
#[derive(Clone, Debug, Default)]
pub struct Crack {
    /// Indices of the open points among those that may open, ascending.
    open: Vec<usize>,
    /// Factor of `A C` restricted to the open points.
    factor: Option<Cholesky<f64, Dyn>>,
    /// Their openings \[m\].
    by: DVector<f64>,
    /// Rates of their openings \[m/s\].
    rate: DVector<f64>,
}

impl Opening {
    /// Openings of `points` with these areas, from the tractions of all points that each opening causes.
    #[must_use]
    pub fn new(
        points: Vec<usize>,
        areas: Vec<f64>,
        normal: Vec<Vec<f64>>,
        shear: Option<Vec<Vec<f64>>>,
    ) -> Self {
        Self { points, areas, normal, shear }
    }

    /// Points that may open.
    #[must_use]
    pub fn points(&self) -> &[usize] {
        &self.points
    }

    /// Memory of this many openings among this many points that slide along this many tangents \[bytes\].
    #[must_use]
    pub fn memory(openings: usize, points: usize, tangents: usize) -> usize {
        (1 + tangents) * openings * points * size_of::<f64>()
    }

    /// Memory \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.normal.iter().chain(self.shear.iter().flatten()).map(|c| c.len() * size_of::<f64>()).sum()
    }

    /// Description for the plan.
    #[must_use]
    pub fn words(&self) -> String {
        let shear = if self.shear.is_some() { "normal and shear" } else { "normal" };
        format!("{shear} tractions of {} openings, {:.1} kB", self.points.len(), self.bytes() as f64 / 1e3)
    }

    /// Finds the openings under N, the normal tractions without opening, and adds their effect to N, which then
    /// vanishes at open points.
    ///
    /// # Errors
    /// A point whose state does not converge.
    pub fn solve(&self, crack: &mut Crack, pressed: &mut [f64]) -> Result<(), usize> {
        if self.points.iter().all(|&p| pressed[p] >= 0.0) {
            *crack = Crack::default();
            return Ok(());
        }
        let alone: Vec<f64> = pressed.to_vec();
        let before = crack.open.clone();
        if !before.is_empty() && self.search(crack, before, &alone, pressed).unwrap_or(false) {
            return Ok(());
        }
        let first = (0..self.points.len()).filter(|&k| alone[self.points[k]] < 0.0).collect();
        self.search(crack, first, &alone, pressed).map(|_| ())
    }

    /// Searches from these open points; true if the state of all points is certain. `alone` is N, and `pressed` is N
    /// with the effect of openings.
    fn search(
        &self,
        crack: &mut Crack,
        first: Vec<usize>,
        alone: &[f64],
        pressed: &mut [f64],
    ) -> Result<bool, usize> {
        let scale = self.points.iter().fold(0.0_f64, |s, &p| s.max(alone[p].abs()));
        let (mut fewest, mut patience) = (usize::MAX, PATIENCE);
        let mut open = first;
        for _ in 0..MOST_EXCHANGES + 10 * self.points.len() {
            self.admit(crack, open)?;
            self.part(crack, alone, pressed);
            let mut wrong = self.wrong(crack, pressed, scale);
            if wrong.is_empty() {
                let clear = self.clear(crack, pressed, scale);
                crack.open.iter().for_each(|&k| pressed[self.points[k]] = 0.0);
                return Ok(clear);
            }
            if wrong.len() < fewest {
                (fewest, patience) = (wrong.len(), PATIENCE);
            } else if patience > 0 {
                patience -= 1;
            } else {
                wrong = wrong.split_off(wrong.len() - 1);
            }
            open = exchanged(&crack.open, &wrong);
        }
        let last = self.wrong(crack, pressed, scale).first().copied();
        Err(self.points[last.unwrap_or_default()])
    }

    /// Makes these points the open ones.
    fn admit(&self, crack: &mut Crack, open: Vec<usize>) -> Result<(), usize> {
        let n = open.len();
        if crack.open == open && (n == 0 || crack.factor.is_some()) {
            return Ok(());
        }
        let entry = |i: usize, j: usize| self.areas[open[i]] * self.normal[open[j]][self.points[open[i]]];
        crack.factor = if n == 0 { None } else { Cholesky::new(DMatrix::from_fn(n, n, entry)) };
        crack.open = open;
        match (&crack.factor, crack.open.first()) {
            (None, Some(&first)) => Err(self.points[first]),
            _ => Ok(()),
        }
    }

    /// Openings of the open points that remove all traction from them, and the resulting normal tractions of all points.
    fn part(&self, crack: &mut Crack, alone: &[f64], pressed: &mut [f64]) {
        crack.by = self.answer(crack, alone);
        pressed.copy_from_slice(alone);
        for (&k, by) in crack.open.iter().zip(crack.by.iter()) {
            add(pressed, *by, &self.normal[k]);
        }
    }

    /// Openings that remove `traction` from the open points.
    fn answer(&self, crack: &Crack, traction: &[f64]) -> DVector<f64> {
        let force = |i: usize| -self.areas[crack.open[i]] * traction[self.points[crack.open[i]]];
        let forces = DVector::from_fn(crack.open.len(), |i, _| force(i));
        crack.factor.as_ref().map_or_else(|| DVector::zeros(0), |factor| factor.solve(&forces))
    }

    /// Points that violate a condition: open points that would overlap, and closed points in tension.
    fn wrong(&self, crack: &Crack, pressed: &[f64], scale: f64) -> Vec<usize> {
        let apart = crack.apart(self.points.len());
        let violates = |k: &usize| match apart[*k] {
            Some(by) => by < 0.0,
            None => pressed[self.points[*k]] < -ROUNDING * scale,
        };
        (0..self.points.len()).filter(violates).collect()
    }

    /// True if no point is within rounding of the other state.
    fn clear(&self, crack: &Crack, pressed: &[f64], scale: f64) -> bool {
        let apart = crack.apart(self.points.len());
        let traction = |k: usize| match apart[k] {
            Some(by) => by * self.normal[k][self.points[k]],
            None => pressed[self.points[k]],
        };
        (0..self.points.len()).all(|k| traction(k) > CLEAR * scale)
    }

    /// Adds the effect of the rates of openings to the rates of normal tractions, which vanish at open points, and to
    /// those of shear tractions.
    pub fn rates(&self, crack: &mut Crack, normal: &mut [f64], shear: &mut [f64]) {
        crack.rate = self.answer(crack, normal);
        for (&k, rate) in crack.open.iter().zip(crack.rate.iter()) {
            add(normal, *rate, &self.normal[k]);
        }
        crack.open.iter().for_each(|&k| normal[self.points[k]] = 0.0);
        self.shear(crack.open.iter().zip(crack.rate.iter()).map(|(&k, rate)| (k, *rate)), shear);
    }

    /// Adds the shear tractions caused by the openings of all points \[m\].
    pub fn sheared(&self, by: &[f64], shear: &mut [f64]) {
        self.shear(self.points.iter().enumerate().map(|(k, &p)| (k, by[p])), shear);
    }

    fn shear(&self, openings: impl Iterator<Item = (usize, f64)>, shear: &mut [f64]) {
        let Some(columns) = &self.shear else { return };
        openings.filter(|(_, by)| *by != 0.0).for_each(|(k, by)| add(shear, by, &columns[k]));
    }

    /// Adds the normal tractions caused by the openings of all points \[m\].
    pub fn pressing(&self, by: &[f64], normal: &mut [f64]) {
        for (&p, column) in self.points.iter().zip(&self.normal) {
            add(normal, by[p], column);
        }
    }

    /// Openings of all points \[m\], and their last rates unless `rate` is empty.
    pub fn evaluate(&self, crack: &Crack, by: &mut [f64], rate: &mut [f64]) {
        by.fill(0.0);
        rate.fill(0.0);
        for (i, &k) in crack.open.iter().enumerate() {
            by[self.points[k]] = crack.by[i];
            if let (Some(rate), Some(of)) = (rate.get_mut(self.points[k]), crack.rate.get(i)) {
                *rate = *of;
            }
        }
    }
}

impl Crack {
    /// Openings of the points that may open; none at closed ones.
    fn apart(&self, points: usize) -> Vec<Option<f64>> {
        let mut apart = vec![None; points];
        self.open.iter().zip(self.by.iter()).for_each(|(&k, by)| apart[k] = Some(*by));
        apart
    }
}

fn add(sum: &mut [f64], factor: f64, part: &[f64]) {
    sum.iter_mut().zip(part).for_each(|(s, p)| *s += factor * p);
}

/// Open points after these have changed state; ascending.
fn exchanged(open: &[usize], changed: &[usize]) -> Vec<usize> {
    let mut all: Vec<usize> = open.iter().copied().filter(|k| changed.binary_search(k).is_err()).collect();
    all.extend(changed.iter().filter(|k| open.binary_search(k).is_err()));
    all.sort_unstable();
    all
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Openings of some points of a row under the tractions of dislocations: 1/(k² - 1/4) on a neighbour k points away.
    /// Areas differ.
    fn row(points: usize, may: impl Fn(usize) -> bool) -> Opening {
        let area = |p: usize| 1.0 + 0.5 * ((p * p) as f64).sin();
        let force = |i: usize, j: usize| {
            let k = i as f64 - j as f64;
            -1.0 / (k * k - 0.25)
        };
        let open: Vec<usize> = (0..points).filter(|&p| may(p)).collect();
        let column = |&j: &usize| (0..points).map(|i| force(i, j) / area(i)).collect::<Vec<f64>>();
        let normal: Vec<Vec<f64>> = open.iter().map(column).collect();
        let shear = normal.iter().map(|c| c.iter().map(|v| 0.3 * v).collect()).collect();
        Opening::new(open.clone(), open.iter().map(|&p| area(p)).collect(), normal, Some(shear))
    }

    /// Tractions that are tensile in places, which move along the row with time.
    fn tractions(points: usize, time: f64) -> Vec<f64> {
        (0..points)
            .map(|p| (0.37 * p as f64 + time).sin() + 0.8 * (1.7 * p as f64 - 0.3 * time).cos() + 0.4)
            .collect()
    }

    fn solved(opening: &Opening, crack: &mut Crack, alone: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut pressed = alone.to_vec();
        opening.solve(crack, &mut pressed).unwrap();
        let mut by = vec![0.0; alone.len()];
        opening.evaluate(crack, &mut by, &mut vec![0.0; alone.len()]);
        (pressed, by)
    }

    #[test]
    fn each_point_is_open_without_traction_or_closed_and_pressed() {
        let opening = row(60, |p| p % 7 != 3);
        let alone = tractions(60, 0.2);
        let (pressed, by) = solved(&opening, &mut Crack::default(), &alone);
        assert!(by.iter().any(|o| *o > 0.0) && opening.points().iter().any(|&p| by[p] == 0.0));
        for &p in opening.points() {
            assert!(by[p] >= 0.0 && pressed[p] >= -1e-12 && by[p] * pressed[p] == 0.0, "{p}");
        }
        let mut again = alone;
        opening.pressing(&by, &mut again);
        for (p, (a, b)) in pressed.iter().zip(&again).enumerate() {
            assert!((a - b).abs() < 1e-12, "{p} {a} {b}");
        }
    }

    #[test]
    fn what_was_open_before_does_not_change_a_bit() {
        let opening = row(80, |_| true);
        let mut warm = Crack::default();
        for k in 0..200 {
            let alone = tractions(80, 0.1 * f64::from(k));
            assert_eq!(
                solved(&opening, &mut warm, &alone),
                solved(&opening, &mut Crack::default(), &alone),
                "{k}"
            );
        }
    }

    /// A point without any traction is on the border between both states, and may be found in the state it was in.
    #[test]
    fn a_point_on_the_border_of_both_states_does_not_depend_on_the_past_either() {
        let opening = row(12, |_| true);
        for k in 0..40 {
            let mut alone = vec![1.0; 12];
            (alone[3], alone[4]) = (-1.0 - 0.07 * f64::from(k), 5.0);
            let (pressed, _) = solved(&opening, &mut Crack::default(), &alone);
            alone[4] -= pressed[4];
            let mut warm = Crack::default();
            let mut before = alone.clone();
            before[4] -= 0.1;
            let (_, by) = solved(&opening, &mut warm, &before);
            assert!(by[4] > 0.0, "{k}");
            assert_eq!(
                solved(&opening, &mut warm, &alone),
                solved(&opening, &mut Crack::default(), &alone),
                "{k}"
            );
        }
    }

    #[test]
    fn rates_are_those_of_openings() {
        let opening = row(50, |p| p != 20);
        let (time, step) = (0.2, 1e-6);
        let at = |time: f64| {
            let mut crack = Crack::default();
            let (pressed, by) = solved(&opening, &mut crack, &tractions(50, time));
            let mut shear = vec![0.0; 50];
            opening.sheared(&by, &mut shear);
            (pressed, by, shear, crack)
        };
        let (before, mut now, after) = (at(time - step), at(time), at(time + step));
        let alone = |time: f64| tractions(50, time);
        let mut normal: Vec<f64> =
            alone(time + step).iter().zip(alone(time - step)).map(|(b, a)| (b - a) / (2.0 * step)).collect();
        let (mut shear, mut by, mut rate) = (vec![0.0; 50], vec![0.0; 50], vec![0.0; 50]);
        opening.rates(&mut now.3, &mut normal, &mut shear);
        opening.evaluate(&now.3, &mut by, &mut rate);
        for p in 0..50 {
            let slope = |a: &[f64], b: &[f64]| (b[p] - a[p]) / (2.0 * step);
            // Finite differences of numbers of order one over a step of 1e-6.
            assert!((slope(&before.0, &after.0) - normal[p]).abs() < 1e-8, "{p}");
            assert!((slope(&before.1, &after.1) - rate[p]).abs() < 1e-8, "{p}");
            assert!((slope(&before.2, &after.2) - shear[p]).abs() < 1e-8, "{p}");
        }
    }

    #[test]
    fn where_nothing_pulls_nothing_opens() {
        let opening = row(10, |_| true);
        let mut crack = Crack::default();
        solved(&opening, &mut crack, &tractions(10, 0.0));
        let (pressed, by) = solved(&opening, &mut crack, &[2.0; 10]);
        assert_eq!((pressed, by), (vec![2.0; 10], vec![0.0; 10]));
    }
}
