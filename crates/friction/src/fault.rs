//! Points of a fault whose bodies are condensed onto it: the equations of a slider at every point, on slices, with parameters
//! that may vary from point to point.
//!
//! The unknowns of a point are m = μ/a and the state variables of its law, as in [`crate::slider`]: V follows from them without
//! iteration, and an error of m is one of ln V. The rate of the traction that the whole fault exerts on the point replaces the
//! springs of a slider.

use crate::Failure;
pub use crate::drive::{Drive, UnknownRates, Unknowns};
use crate::points::Components;
use crate::sheet::Sheet;
use crate::slider::{Forcing, Line, SliderLaw};

/// Laws of the points of a fault.
pub trait FaultLaw: Send + Sync + std::fmt::Debug {
    /// Number of points.
    fn points(&self) -> usize;

    /// Components of slip.
    fn components(&self) -> usize {
        1
    }

    /// State variables of a point.
    fn states(&self) -> usize;

    /// Signed slip rates V \[m/s\] from m and the states.
    fn slip_rates(&self, now: Unknowns<'_>, rate: Components<&mut [f64]>);

    /// Rates of change of m and of the states \[1/s\].
    fn rates(&self, drive: Drive<'_>, now: Unknowns<'_>, rates: UnknownRates<'_>);

    /// Rates of change of m and of the states of a point whose slip has one component, as [`SliderLaw::equations`].
    fn point_rates(&self, point: usize, forcing: &Forcing, unknowns: &[f64], rates: &mut [f64]);

    /// a of a point \[-\]: μ = a m.
    fn scale(&self, point: usize) -> f64;

    /// Change of the state variables of a point that is equivalent to a change of ln V by one, for error norms.
    fn state_scale(&self, point: usize) -> f64;

    /// Shortest characteristic slip L of a point \[m\], if it has one.
    fn length(&self, point: usize) -> Option<f64>;

    /// Writes the steady states of a point at ln V.
    fn steady(&self, point: usize, log_rate: f64, states: &mut [f64]);

    /// Changes the state of a point so that its friction coefficient at slip rate `rate` \[m/s\] is `mu`.
    ///
    /// # Errors
    /// Those of [`SliderLaw::states_for`], with the number of the point.
    fn states_for(&self, point: usize, rate: f64, mu: f64, states: &mut [f64]) -> Result<(), Failure>;

    /// m of a point at a slip rate \[m/s\] of either sign.
    ///
    /// # Errors
    /// [`Failure::BareLogAtRest`] where the form has no value at this rate.
    fn at_rate(&self, point: usize, rate: f64, states: &[f64]) -> Result<f64, Failure>;

    /// Makes the contacts of a point weaken at a temperature \[K\], with parameters that are those at `ambient` \[K\].
    /// `false` if its law has no such contacts.
    fn heat(&mut self, point: usize, weakening: f64, ambient: f64) -> bool;

    /// True if friction depends on temperature.
    fn warms(&self) -> bool;

    /// A copy, whose temperatures may be changed apart from those of the original.
    fn copy(&self) -> Box<dyn FaultLaw>;

    /// Sets the temperature of a point \[K\].
    fn warm(&mut self, point: usize, temperature: f64);

    /// ∂ln V/∂T of a point \[1/K\] at constant m and states.
    fn log_rate_by_temperature(&self, point: usize) -> f64;
}

/// One law for each point, all of one kind.
#[derive(Clone, Debug)]
pub struct Points<L> {
    laws: Vec<L>,
    /// Present if all laws are of the kind that is evaluated for many points at once.
    sheet: Option<Sheet>,
}

impl<L: SliderLaw> Points<L> {
    /// From the laws of the points: at least one, all with the same number of states.
    #[must_use]
    pub fn new(laws: Vec<L>) -> Self {
        debug_assert!(laws.windows(2).all(|w| w[0].states() == w[1].states()));
        let lines: Option<Vec<Line>> = laws.iter().map(SliderLaw::line).collect();
        let sheet = lines.filter(|l| !l.is_empty()).map(|lines| Sheet::new(&lines));
        Self { laws, sheet }
    }

    /// The same laws, evaluated one point at a time.
    #[must_use]
    pub fn one_by_one(laws: Vec<L>) -> Self {
        Self { sheet: None, ..Self::new(laws) }
    }

    /// Visits the law of each point with its unknowns as those of a slider.
    fn for_each(&self, now: Unknowns<'_>, mut visit: impl FnMut(usize, &L, &[f64])) {
        let mut y = [0.0; MOST];
        for (k, (law, m)) in self.laws.iter().zip(now.m.all()).enumerate() {
            let states = now.states.at(k);
            y[0] = *m;
            y[1..=states.len()].copy_from_slice(states);
            visit(k, law, &y[..=states.len()]);
        }
    }
}

/// Largest number of unknowns of a point, m included: that of a slider.
const MOST: usize = 16;

impl<L: SliderLaw + Clone + 'static> FaultLaw for Points<L> {
    fn points(&self) -> usize {
        self.laws.len()
    }

    fn states(&self) -> usize {
        self.laws.first().map_or(0, |law| law.states())
    }

    fn slip_rates(&self, now: Unknowns<'_>, mut rate: Components<&mut [f64]>) {
        let rate = rate.all_mut();
        match &self.sheet {
            Some(sheet) => {
                let (m, states) = (now.m.all(), now.states.all());
                sheet.slip_rates(now, rate, |k| self.laws[k].slip(&[m[k], states[k]]).0.rate);
            }
            None => self.for_each(now, |k, law, y| rate[k] = law.slip(y).0.rate),
        }
    }

    fn rates(&self, drive: Drive<'_>, now: Unknowns<'_>, mut rates: UnknownRates<'_>) {
        if let Some(sheet) = &self.sheet {
            let (m, states) = (now.m.all(), now.states.all());
            return sheet.rates(&drive, now, rates, |k| {
                let mut dy = [0.0; 2];
                self.laws[k].equations(&drive.forcing(k, 0), &[m[k], states[k]], &mut dy);
                dy
            });
        }
        let mut dy = [0.0; MOST];
        self.for_each(now, |k, law, y| {
            law.equations(&drive.forcing(k, 0), y, &mut dy[..y.len()]);
            rates.m.all_mut()[k] = dy[0];
            rates.states.at_mut(k).copy_from_slice(&dy[1..y.len()]);
        });
    }

    fn point_rates(&self, point: usize, forcing: &Forcing, unknowns: &[f64], rates: &mut [f64]) {
        self.laws[point].equations(forcing, unknowns, rates);
    }

    fn scale(&self, point: usize) -> f64 {
        self.laws[point].scale()
    }

    fn state_scale(&self, point: usize) -> f64 {
        self.laws[point].state_scale()
    }

    fn length(&self, point: usize) -> Option<f64> {
        self.laws[point].length()
    }

    fn steady(&self, point: usize, log_rate: f64, states: &mut [f64]) {
        self.laws[point].steady(log_rate, states);
    }

    fn states_for(&self, point: usize, rate: f64, mu: f64, states: &mut [f64]) -> Result<(), Failure> {
        self.laws[point].states_for(rate, mu, states).map_err(|f| f.at(point))
    }

    fn at_rate(&self, point: usize, rate: f64, states: &[f64]) -> Result<f64, Failure> {
        self.laws[point].at_rate(rate, states).map_err(|f| f.at(point))
    }

    fn heat(&mut self, point: usize, weakening: f64, ambient: f64) -> bool {
        self.laws[point].heat(weakening, ambient)
    }

    fn warms(&self) -> bool {
        self.laws.iter().any(SliderLaw::warms)
    }

    fn copy(&self) -> Box<dyn FaultLaw> {
        Box::new(self.clone())
    }

    // The laws of a sheet do not depend on temperature.
    fn warm(&mut self, point: usize, temperature: f64) {
        self.laws[point].warm(temperature);
    }

    fn log_rate_by_temperature(&self, point: usize) -> f64 {
        self.laws[point].log_rate_by_temperature()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::{Drive, FaultLaw, Points, UnknownRates, Unknowns};
    use crate::evolution::ageing::Ageing;
    use crate::points::{Components, PerPoint};
    use crate::rate::RateLaw;
    use crate::strength::Parameters;
    use crate::strength::regularised::Regularised;

    type Law = RateLaw<Regularised, Ageing>;

    fn laws(n: usize) -> Vec<Law> {
        let law = |k: usize| {
            let a = 0.008 + 0.002 * (k % 9) as f64;
            let form = Regularised(Parameters::new(0.6, a, 1e-6).unwrap());
            RateLaw::new(form, Ageing::new(0.015, 0.008, 1e-6).unwrap(), 1e-9, None).unwrap()
        };
        (0..n).map(law).collect()
    }

    fn unknowns<'a>(m: &'a [f64], states: &'a [f64]) -> Unknowns<'a> {
        Unknowns { m: Components::new(m, m.len()), states: PerPoint::new(states, 1) }
    }

    /// V and the rates of m and of the states.
    fn rates(law: &dyn FaultLaw, drive: Drive<'_>, now: Unknowns<'_>) -> [Vec<f64>; 3] {
        let n = law.points();
        let (mut v, mut dm, mut ds) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        law.slip_rates(now, Components::new(&mut v, n));
        let own = UnknownRates { m: Components::new(&mut dm, n), states: PerPoint::new(&mut ds, 1) };
        law.rates(drive, now, own);
        [v, dm, ds]
    }

    #[test]
    fn rates_do_not_depend_on_the_number_of_threads() {
        let n = 9001;
        let law = Points::new(laws(n));
        let m: Vec<f64> = (0..n).map(|k| 12.0 + 0.003 * k as f64).collect();
        let states = vec![7.0; n];
        let (normal, pull, damping) = (vec![5e7; n], vec![1e-2; n], vec![4.6e6; n]);
        let shear_rate = Components::new(pull.as_slice(), n);
        let drive = Drive { normal: &normal, normal_rate: None, shear_rate, damping: &damping };
        let of = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| rates(&law, drive, unknowns(&m, &states)))
        };
        assert_eq!(of(1), of(2));
        let each = Points::one_by_one(laws(n));
        let mut v = vec![0.0; n];
        each.slip_rates(unknowns(&m, &states), Components::new(&mut v, n));
        for (a, b) in of(3)[0].iter().zip(&v) {
            assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn many_points_at_once_have_the_rates_of_each_by_itself() {
        // A number of points that leaves a partial group, coefficients of both signs down to zero, and states around the steady
        // one.
        let n = 43;
        let (many, each) = (Points::new(laws(n)), Points::one_by_one(laws(n)));
        let m: Vec<f64> = (0..n).map(|k| (k as f64 - 10.0) * 2.3).collect();
        let states: Vec<f64> = (0..n).map(|k| 6.0 + (k % 7) as f64 - 0.02 * k as f64).collect();
        let normal: Vec<f64> = (0..n).map(|k| 5e7 + 1e5 * k as f64).collect();
        let pull: Vec<f64> = (0..n).map(|k| 1e-2 * (k as f64 - 20.0)).collect();
        let change = vec![-3e-3; n];
        for (normal_rate, damping) in [(None, 0.0), (Some(change.as_slice()), 4.6e6)] {
            let damping: Vec<f64> = (0..n).map(|k| damping * (1.0 + 0.01 * k as f64)).collect();
            let shear_rate = Components::new(pull.as_slice(), n);
            let drive = Drive { normal: &normal, normal_rate, shear_rate, damping: &damping };
            let found = [&many as &dyn FaultLaw, &each].map(|law| rates(law, drive, unknowns(&m, &states)));
            for (a, b) in found[0].iter().zip(&found[1]) {
                for (k, (a, b)) in a.iter().zip(b).enumerate() {
                    // Rounding of ln V, and of differences in the rates.
                    assert!((a - b).abs() <= 1e-12 * b.abs() + 1e-25, "{k}: {a} is not {b}");
                }
            }
        }
    }
}
