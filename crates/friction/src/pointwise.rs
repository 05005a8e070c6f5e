//! A law with parameters of its own at each point of a surface.

use crate::Failure;
use crate::law::{Increments, Law, Limit, PresentStates, RateBounds, Rates, Responses, StepOutcome, Trials};
use crate::yielding::smaller;

/// Laws of the points of a surface, by their numbers; all of one kind, with the same number of states.
#[derive(Clone, Debug)]
pub struct PointwiseLaw<L> {
    laws: Vec<L>,
    name: &'static str,
    states: usize,
}

impl<L: Law> PointwiseLaw<L> {
    /// Laws of the points 0, 1, ..
    ///
    /// # Errors
    /// [`Failure::Parameter`] without points, and for laws with different numbers of states.
    pub fn new(laws: Vec<L>) -> Result<Self, Failure> {
        let refused = |admissible| Failure::Parameter { name: "laws", value: laws.len() as f64, admissible };
        let first = laws.first().ok_or_else(|| refused("one law for each point"))?;
        let (name, states) = (first.name(), first.states());
        if laws.iter().any(|law| law.states() != states) {
            return Err(refused("laws with the same number of states"));
        }
        Ok(Self { laws, name, states })
    }

    /// Law of an entry of the slices.
    fn law(&self, points: &[usize], k: usize) -> &L {
        &self.laws[points[k]]
    }
}

impl<L: Law> Law for PointwiseLaw<L> {
    fn name(&self) -> &'static str {
        self.name
    }

    fn states(&self) -> usize {
        self.states
    }

    fn has_elastic_domain(&self) -> bool {
        self.laws.iter().all(Law::has_elastic_domain)
    }

    fn bonded(&self) -> bool {
        self.laws.iter().all(Law::bonded)
    }

    fn slippery(&self) -> bool {
        self.laws.iter().all(Law::slippery)
    }

    fn cohesion(&self, point: usize) -> f64 {
        self.laws[point].cohesion(0)
    }

    fn initial(&self, states: &mut [f64]) {
        if self.states > 0 {
            self.laws
                .iter()
                .zip(states.chunks_exact_mut(self.states))
                .for_each(|(law, own)| law.initial(own));
        }
    }

    fn coefficient(
        &self,
        normal: &[f64],
        rate: &[f64],
        states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        let n = self.states;
        for (k, mu) in mu.chunks_exact_mut(1).enumerate() {
            self.laws[k]
                .coefficient(&normal[k..=k], &rate[k..=k], &states[k * n..(k + 1) * n], mu)
                .map_err(|f| f.at(k))?;
        }
        Ok(())
    }

    fn respond(&self, trials: Trials<'_>, old: &[f64], mut out: Responses<'_>) -> Result<(), Failure> {
        let n = self.states;
        for k in 0..trials.normal.len() {
            self.law(trials.points, k)
                .respond(trials.one(k), &old[k * n..(k + 1) * n], out.one(k, n))
                .map_err(|f| f.at(k))?;
        }
        Ok(())
    }

    fn error(&self, outcome: StepOutcome<'_>, out: &mut [f64]) {
        for (k, out) in out.chunks_exact_mut(1).enumerate() {
            self.law(outcome.points, k).error(outcome.one(k, self.states), out);
        }
    }

    fn rates(&self, present: PresentStates<'_>, mut out: Rates<'_>) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            let law = self.law(present.points, k);
            law.rates(present.one(k, self.states), out.one(k)).map_err(|f| f.at(k))?;
        }
        Ok(())
    }

    fn limit(&self, present: PresentStates<'_>, step: Increments<'_>, bounds: RateBounds) -> Option<Limit> {
        let of = |k: usize| {
            let law = self.law(present.points, k);
            let found = law.limit(present.one(k, self.states), step.one(k), bounds)?;
            Some(Limit { point: k, ..found })
        };
        (0..present.normal.len()).map(of).fold(None, smaller)
    }

    fn stands(&self, present: PresentStates<'_>, k: usize) -> bool {
        self.law(present.points, k).stands(present.one(k, self.states), 0)
    }
}
