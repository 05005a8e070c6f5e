//! Slip of the sliders from the tractions of their springs: `K u = k u_load - (T - T_0)`, with a matrix as sparse as the
//! springs.

use super::equations::Piece;
use super::problem::Problem;
use crate::problem::RunError;
use asperity_friction::slider::Condition;
use asperity_ode::Clock;
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut, Side};
use serde::{Deserialize, Serialize};

/// Solver for the slip of the sliders.
pub(crate) struct Slips {
    /// Factors of the stiffness matrix of the sliders whose slip rate is not imposed; none where all are.
    stiffness: Option<Llt<usize, f64>>,
    /// Equation of each slider; none where its slip rate is imposed.
    equations: Vec<Option<usize>>,
    /// Tractions at time 0 \[Pa\].
    first: Vec<f64>,
    travelled: SpringTravel,
}

/// State of the prescribed histories at the beginning of the current piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SpringTravel {
    /// Displacement of the load point \[m\].
    load: f64,
    /// Slip of the sliders whose rate is imposed \[m\].
    imposed: Vec<f64>,
    /// Time at which the piece began.
    entered: Clock,
}

impl SpringTravel {
    /// State of this many sliders at time 0.
    pub fn nowhere(sliders: usize) -> Self {
        Self { load: 0.0, imposed: vec![0.0; sliders], entered: Clock::new(0.0, 0.0) }
    }
}

impl Slips {
    pub fn new(problem: &Problem, travelled: SpringTravel) -> Result<Self, RunError> {
        let system = &problem.system;
        let n = problem.names.len();
        let mut count = 0;
        let mut equation = |i: usize| {
            let free = system.imposed(i).is_none();
            count += usize::from(free);
            free.then(|| count - 1)
        };
        let equations: Vec<Option<usize>> = (0..n).map(&mut equation).collect();
        let mut entries = Vec::new();
        for (i, equation) in equations.iter().enumerate() {
            entries.extend(equation.map(|e| Triplet::new(e, e, system.stiffness(i))));
        }
        for spring in system.springs() {
            let [a, b] = spring.between.map(|i| equations[i]);
            if let Some((a, b)) = a.zip(b).filter(|(a, b)| a != b) {
                entries.push(Triplet::new(a.max(b), a.min(b), -spring.stiffness));
            }
        }
        let held = count == 0 || count < n || system.sliders().iter().any(|s| s.stiffness > 0.0);
        let stiffness = if count == 0 {
            None
        } else {
            let matrix = SparseColMat::try_new_from_triplets(count, count, &entries).ok().filter(|_| held);
            let factor = matrix.and_then(|m| m.sp_cholesky(Side::Lower).ok());
            Some(factor.ok_or(RunError::Loose)?)
        };
        let segment = system.segment(0.0);
        let first = (0..n).map(|i| segment.condition(i, 0.0, &problem.start).traction).collect();
        Ok(Self { stiffness, equations, first, travelled })
    }

    /// Traction of a slider at time 0 \[Pa\]; none where its slip rate is imposed.
    pub fn first(&self, slider: usize) -> Option<f64> {
        self.equations[slider].map(|_| self.first[slider])
    }

    pub fn enter(&mut self, at: Clock) {
        self.travelled.entered = at;
    }

    pub fn leave(&mut self, piece: &Piece<'_>, at: Clock) {
        let load = self.load_at(piece, at);
        let imposed = (0..self.equations.len()).map(|i| self.imposed_at(piece, i, at)).collect();
        self.travelled = SpringTravel { load, imposed, ..self.travelled };
    }

    pub fn travelled(&self) -> &SpringTravel {
        &self.travelled
    }

    pub fn load_at(&self, piece: &Piece<'_>, at: Clock) -> f64 {
        let SpringTravel { load, entered, .. } = &self.travelled;
        load + piece.segment.load().integral(entered.seconds(), at.since(entered))
    }

    fn imposed_at(&self, piece: &Piece<'_>, i: usize, at: Clock) -> f64 {
        let SpringTravel { imposed, entered, .. } = &self.travelled;
        let since =
            |rate: &asperity_friction::slider::Piece| rate.integral(entered.seconds(), at.since(entered));
        imposed[i] + piece.segment.imposed(i).map_or(0.0, since)
    }

    pub fn slip(&self, piece: &Piece<'_>, at: Clock, load: f64, conditions: &[Condition]) -> Vec<f64> {
        let system = &piece.problem.system;
        let mut slip = vec![0.0; conditions.len()];
        let mut free = Vec::with_capacity(conditions.len());
        for (i, (c, s)) in conditions.iter().zip(system.sliders()).enumerate() {
            match self.equations[i] {
                Some(_) => free.push(s.stiffness * load - (c.traction - self.first[i])),
                None => slip[i] = self.imposed_at(piece, i, at),
            }
        }
        for spring in system.springs() {
            let [a, b] = spring.between;
            for (one, other) in [(a, b), (b, a)] {
                if let (Some(e), None) = (self.equations[one], self.equations[other]) {
                    free[e] += spring.stiffness * slip[other];
                }
            }
        }
        if let Some(stiffness) = &self.stiffness {
            let n = free.len();
            stiffness
                .solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(&mut free, n, 1));
        }
        for (slip, equation) in slip.iter_mut().zip(&self.equations) {
            if let Some(e) = equation {
                *slip = free[*e];
            }
        }
        slip
    }
}
