//! Descriptions of failed steps.

use super::AssembledProblem;
use crate::{Failure, PlannedInterface, free};
use asperity_contact::Interface;

/// Share of the mean normal traction that radiation carries where slip is that of an event.
const RADIATED: f64 = 0.1;

impl<const D: usize> AssembledProblem<'_, D> {
    /// Describes a failed step, with degrees of freedom given by body and position.
    #[must_use]
    pub fn in_words(&self, failure: &Failure) -> String {
        match failure {
            Failure::Refused(why) | Failure::Violated(why) => why.clone(),
            Failure::Inaccurate { error } => {
                format!("friction coefficients are off by some {error:.1e} at the end of the step")
            }
            Failure::Objected(objection) => objection.to_string(),
            Failure::Interrupted => "the step was interrupted".into(),
            Failure::Unsolved { error, .. } => {
                let nodes = &self.numbering.nodes;
                if let Some(pivot) = error.pivot()
                    && let Some(words) = self.multiplier_in_words(pivot.equation, nodes)
                {
                    return words;
                }
                free::unsolved(&self.problem.model, error, |dof| self.node_of(dof))
            }
            Failure::Adrift { dof } => {
                self.multiplier_in_words(*dof, &self.numbering.nodes).unwrap_or_else(|| {
                    let (node, component) = self.node_of(*dof);
                    free::adrift(&self.problem.model, node, component, !self.problem.interfaces.is_empty())
                })
            }
        }
    }

    /// Description of a penalty so large that it slows the iterations, if there is one.
    pub fn blamed(&self) -> Option<&str> {
        self.problem.interfaces.iter().find_map(|i| i.blamed.as_deref())
    }

    /// Name of an interface whose law has cohesion, if there is one and steps are implicit.
    pub fn cohesive(&self) -> Option<&str> {
        if self.problem.stepping.is_forward() {
            return None;
        }
        let holds =
            |i: &&PlannedInterface| i.law.as_ref().is_some_and(|law| !law.bonded() && law.cohesion(0) > 0.0);
        self.problem.interfaces.iter().find(holds).map(|i| i.name.as_str())
    }

    /// Name of a damped interface that radiates a tenth of its mean normal traction or more at a point, while another is open, if there
    /// is one: where a point opens it radiates no more.
    pub fn lifting(&self) -> Option<&str> {
        let lifts = |(planned, interface): &(&PlannedInterface, &Interface<D>)| {
            let (points, damping) = (interface.points(), planned.damping.unwrap_or(0.0));
            let normal = &points.normal_traction;
            let mean = normal.iter().sum::<f64>() / normal.len() as f64;
            let fastest = points.slip_rate.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
            damping * fastest > RADIATED * mean && normal.iter().any(|f| *f <= 0.0)
        };
        let mut each = self.problem.interfaces.iter().zip(&self.interfaces);
        each.find(lifts).map(|(planned, _)| planned.name.as_str())
    }

    /// Describes the traction that an unknown represents, if it is a multiplier.
    fn multiplier_in_words(&self, unknown: usize, nodes: &[usize]) -> Option<String> {
        let mut first = nodes.len() * self.problem.model.idealisation.components();
        for (planned, interface) in self.problem.interfaces.iter().zip(&self.interfaces) {
            if (first..first + planned.unknowns).contains(&unknown) {
                let point = (unknown - first) / (planned.unknowns / planned.slave.len());
                return Some(format!(
                    "the system is singular: interface `{}` does not determine the traction at node {}",
                    planned.name,
                    interface.label(point)
                ));
            }
            first += planned.unknowns;
        }
        None
    }

    /// Mesh node and component of a degree of freedom of the system.
    fn node_of(&self, dof: usize) -> (usize, usize) {
        let components = self.problem.model.idealisation.components();
        (self.numbering.nodes[dof / components], dof % components)
    }

    /// Description of a motion that the system assembled last does not resist, if there is one.
    #[must_use]
    pub fn free_motion(&self) -> Option<String> {
        let system = self.stepper.as_ref()?.system();
        let nodes = &self.numbering.nodes;
        let places: Vec<[f64; D]> = nodes.iter().map(|&n| self.problem.model.mesh.nodes[n]).collect();
        let mode = system.free_mode(&places)?;
        Some(free::motion(&self.problem.model, &mode, nodes))
    }
}
