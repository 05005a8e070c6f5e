//! Bodies condensed onto the degrees of freedom of their interfaces.

use super::bodies::{Bodies, BodiesState};
use crate::energy::{BodyEnergy, BodyWorks, linear_forces};
use crate::error::SetUpError;
use crate::solver::{self, Analyses};
use crate::{Body, CellBlock, Problem, free};
use asperity_fem::FemError;
use asperity_fem::condense::{Analysis, ChannelWorks, Condensation, CondensedBody};
use asperity_fem::dof::{Channel, Constraints};
use asperity_fem::term::ForwardTerm;
use asperity_run::Operations;

/// One term per body, on its retained degrees of freedom; none before the first stage.
pub struct CondensedBodies<'a, const D: usize> {
    problem: &'a Problem<D>,
    retained: Vec<Vec<usize>>,
    terms: Vec<CondensedBody>,
    /// Works of the channels of each body.
    works: Vec<ChannelWorks>,
    factorisations: usize,
    solves: usize,
}

impl<'a, const D: usize> CondensedBodies<'a, D> {
    /// Takes the bodies of a problem, with the degrees of freedom that each retains.
    #[must_use]
    pub fn new(problem: &'a Problem<D>, retained: Vec<Vec<usize>>) -> Self {
        Self { problem, retained, terms: Vec::new(), works: Vec::new(), factorisations: 0, solves: 0 }
    }

    fn solves(&self) -> usize {
        self.terms.iter().map(|b| b.reduction().solves()).sum()
    }
}

impl<const D: usize> Bodies<D> for CondensedBodies<'_, D> {
    fn load(&mut self, constraints: &Constraints, renewed: bool) -> Result<(), SetUpError> {
        if renewed {
            self.solves += self.solves();
            self.terms = condense(self.problem, &self.retained, constraints)?;
            self.factorisations += self.terms.len();
        }
        for (body, term) in self.problem.model.bodies.iter().zip(&mut self.terms) {
            term.set_channels(local_channels(constraints, body.dofs.clone()));
        }
        let bodies = self.problem.model.bodies.iter().zip(&self.terms);
        self.works =
            bodies.map(|(body, term)| channel_works(self.problem, body, term, constraints)).collect();
        Ok(())
    }

    fn terms(&mut self) -> Vec<&mut dyn ForwardTerm> {
        self.terms.iter_mut().map(|b| b as &mut dyn ForwardTerm).collect()
    }

    fn displacement(&self, u: &[f64], time: f64) -> Vec<f64> {
        self.terms.iter().flat_map(|b| b.recover(u, time)).collect()
    }

    fn energies(&self, u: &[f64], time: f64) -> BodyEnergy {
        let each = self.works.iter().zip(&self.terms);
        BodyEnergy {
            stored: each.map(|(works, body)| works.elastic(body, (u, time))).sum(),
            ..BodyEnergy::default()
        }
    }

    fn works(&self, from: (&[f64], f64), to: (&[f64], f64)) -> BodyWorks {
        let mut sum = BodyWorks::default();
        for (works, body) in self.works.iter().zip(&self.terms) {
            let [loads, motions] = works.works(body, from, to);
            sum = BodyWorks { loads: sum.loads + loads, motions: sum.motions + motions };
        }
        sum
    }

    fn blocks(&self) -> &[CellBlock<D>] {
        &self.problem.model.blocks
    }

    fn add_counts(&self, counts: &mut Operations) {
        counts.body_factorisations += self.factorisations;
        counts.body_solves += self.solves + self.solves();
    }

    fn save(&self) -> BodiesState {
        let solves = self.solves + self.solves();
        BodiesState { histories: Vec::new(), factorisations: self.factorisations, solves }
    }

    fn restore(&mut self, saved: &BodiesState) -> bool {
        self.factorisations = saved.factorisations;
        // Solves with the present factors have already been counted.
        self.solves = saved.solves.saturating_sub(self.solves());
        saved.histories.is_empty()
    }
}

/// Condenses every body onto its retained degrees of freedom.
fn condense<const D: usize>(
    problem: &Problem<D>,
    retained: &[Vec<usize>],
    constraints: &Constraints,
) -> Result<Vec<CondensedBody>, SetUpError> {
    let mut first = 0;
    let mut terms = Vec::new();
    let prepared = match &problem.solver.prepared {
        Analyses::Bodies(analyses) if constraints.fixed == problem.stages[0].fixed => Some(analyses),
        _ => None,
    };
    let mut left = problem.solver.memory;
    for (k, (body, retained)) in problem.model.bodies.iter().zip(retained).enumerate() {
        let told = |e: FemError| {
            let first = body.nodes.start;
            let place = |dof: usize| (first + dof / D, dof % D);
            let reason = free::unsolved(&problem.model, &e, place);
            SetUpError::Body { body: body.name.clone(), reason }
        };
        let stiffness = problem.model.stiffness(body);
        let dofs = &body.dofs;
        let analysis = match prepared {
            Some(analyses) => analyses[k].clone(),
            None => {
                let (kept, fixed) = (solver::local(retained, dofs), solver::local(&constraints.fixed, dofs));
                Analysis::new(&[&stiffness.pattern], dofs.len(), &kept, &fixed).map_err(told)?
            }
        };
        let kept = analysis.kept();
        let reduction = Condensation::prepared(&stiffness, analysis).factor(left).map_err(told)?;
        left = left.saturating_sub(kept);
        let system: Vec<usize> = (first..first + retained.len()).collect();
        first += retained.len();
        terms.push(CondensedBody::new(format!("body `{}`", body.name), reduction, &system));
    }
    Ok(terms)
}

/// Works of the channels of one body.
fn channel_works<const D: usize>(
    problem: &Problem<D>,
    body: &Body<D>,
    term: &CondensedBody,
    constraints: &Constraints,
) -> ChannelWorks {
    let internal = |own: &[f64]| {
        let mut all = vec![0.0; problem.model.dofs()];
        all[body.dofs.clone()].copy_from_slice(own);
        linear_forces(&problem.model.blocks[body.blocks.clone()], &all)[body.dofs.clone()].to_vec()
    };
    ChannelWorks::new(term, &local_channels(constraints, body.dofs.clone()), internal)
}

/// Channels of one body in its own numbering.
fn local_channels(constraints: &Constraints, dofs: std::ops::Range<usize>) -> Vec<Channel> {
    let own = |list: &[(usize, f64)]| -> Vec<(usize, f64)> {
        list.iter().filter(|(d, _)| dofs.contains(d)).map(|&(d, v)| (d - dofs.start, v)).collect()
    };
    constraints
        .channels
        .iter()
        .map(|c| Channel {
            prescribed: own(&c.prescribed),
            forces: own(&c.forces),
            amplitude: c.amplitude.clone(),
        })
        .filter(|c| !c.prescribed.is_empty() || !c.forces.is_empty())
        .collect()
}
