//! Choice of the linear solver. It depends on the scene alone, so that neither the choice nor the results depend on the machine.

use super::assembly::Assembly;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Method as Asked, Path as PathChoice, Scene, Spanned};
use crate::shared::amounts::{memory, size};
use crate::shared::model::counts;
use crate::shared::model::forecast::{self, Factorisation};
use asperity_contact::Sliding;
use asperity_fem::assembly::{FACTORED_COMPONENTS, LowerTriangle, Symmetry};
use asperity_fem::dof::{Constraints, Equations};
use asperity_fem::term::Pattern;
use asperity_fem::{FemError, condense};
use asperity_mechanics::solver::{Analyses, Method, Solver, local, retained, symmetry};
use asperity_mechanics::{CellBlock, Model, Path, PlannedInterface, Spring, Stage, Stepping};
use asperity_scene::defaults;

/// Memory of the iterative method over that of its matrix; 2.5 to 3.8 in the benchmark.
const HIERARCHY: usize = 4;
/// The same with a matrix and its neighbour of which levels are made, and the basis of GMRES.
const AGGREGATED: usize = 6;
/// Residual over the load of a direction of Newton's method: with smaller ones it takes no fewer iterations.
const DIRECTION: f64 = 1e-5;
/// Number of degrees of freedom up to which a plan analyses the system of generated blocks, which takes a second in 3D. For larger systems memory is
/// estimated from counts, and the run does the analysis, unless the estimate is so near what is allowed that it does not decide.
const ANALYSED: usize = 50_000;
/// Operations of a Cholesky factorisation of the bodies above which LU, several times as many, is avoided: a hundredth of a second.
const LU_AVOIDED: f64 = 1e7;
/// Operations of a Cholesky factorisation of a step above which levels are better: with 6e9 they take nine tenths of its time, and a third of its
/// memory.
const FACTORS_AVOIDED: f64 = 2e10;
/// Iterations with levels after which a factor is made: they cost as much as the factorisation of 150 000 unknowns.
const MOST_BEFORE_FACTORS: usize = 180;
/// Operations of a factorisation in the time that levels, some ten products with them and an assembly take for each unknown: 16 to 22 us of CPU
/// a step with 250 000 to 1 900 000 unknowns of hexahedra.
const OF_LEVELS: f64 = 7e4;
/// The same with plastic cells of second order and large deformation over that: 38 to 52 us with 29 000 to 150 000 unknowns.
const NONLINEAR: f64 = 2.3;
/// Operations of a dense factorisation of the condensed interface above which tractions are solved for instead: a tenth of a second.
const DENSE_AVOIDED: f64 = 1e8;
/// Products with the compliance of pairs, its factor and the bodies in an iteration of Newton's method.
const PRODUCTS: usize = 8;
/// Operations of a factorisation in the time in which a product reads a value.
const WAIT: f64 = 4.5;
/// Memory and operations of LU over those of Cholesky with the same pattern: both triangles, without the fill due to pivoting.
const UNSYMMETRIC: usize = 2;

/// Chooses the linear solver, on this path or, if the scene leaves it open and memory does not suffice for condensation, on the full
/// one.
///
/// # Errors
/// [`Diagnostic`] if the method cannot be used for the scene, or takes more memory than is allowed.
pub fn choose<const D: usize>(assembly: &Assembly<'_, D>, path: Path) -> Result<(Path, Solver), Diagnostic> {
    let Assembly { scene, model, interfaces, stages, stepping, .. } = assembly;
    let choice = Choice { scene, model, interfaces, stages, stepping };
    let full = || choice.full().map(|solver| (Path::Full, solver));
    match path {
        Path::Full => full(),
        Path::Condensed => match choice.condensed() {
            Ok(solver) => Ok((Path::Condensed, solver)),
            Err(refused) if scene.time.path == PathChoice::Auto => full().map_err(|_| refused),
            Err(refused) => Err(choice.or_full(refused)),
        },
    }
}

/// Cost of LU, where that of Cholesky with the same pattern is this one.
fn lu(cost: Factorisation) -> Factorisation {
    let Factorisation { bytes, operations } = cost;
    Factorisation { bytes: UNSYMMETRIC * bytes, operations: UNSYMMETRIC as f64 * operations }
}

struct Choice<'a, const D: usize> {
    scene: &'a Scene,
    model: &'a Model<D>,
    interfaces: &'a [PlannedInterface],
    stages: &'a [Stage],
    stepping: &'a Stepping,
}

impl<const D: usize> Choice<'_, D> {
    fn memory(&self) -> usize {
        memory(self.scene)
    }

    /// First stage with an unsymmetric tangent.
    fn unsymmetric(&self) -> Option<&Stage> {
        let general =
            |s: &&Stage| symmetry(self.model, self.interfaces, self.stepping, s) == Symmetry::General;
        self.stages.iter().find(general)
    }

    /// Cost estimated from counts alone, if the model is large and the estimate decides whether they are allowed.
    fn counted<T>(&self, cost: impl Fn(&Scene) -> Option<T>, bytes: impl Fn(&T) -> usize) -> Option<T> {
        if self.model.dofs() <= ANALYSED {
            return None;
        }
        let memory = self.memory() as f64;
        cost(self.scene).filter(|cost| {
            let bytes = bytes(cost) as f64;
            forecast::SURE * bytes > memory || bytes <= forecast::SURE * memory
        })
    }

    /// Memory for condensing the bodies onto `retained`, without the interface.
    fn condensations(&self, retained: &[Vec<usize>]) -> Result<(Analyses, usize), Diagnostic> {
        if let Some(bytes) = self.counted(forecast::condensation, |bytes| *bytes) {
            return Ok((Analyses::Nothing, bytes));
        }
        let mut analyses = Vec::new();
        let fixed = &self.stages[0].fixed;
        for (body, retained) in self.model.bodies.iter().zip(retained) {
            let dofs = &body.dofs;
            let pattern = self.model.pattern(body);
            let analysis =
                condense::Analysis::new(&[&pattern], dofs.len(), &local(retained, dofs), &local(fixed, dofs));
            let place = || self.scene.bodies[&body.name].material.span();
            let refused = |e: FemError| Diagnostic::body(&body.name, place(), e.to_string());
            analyses.push(analysis.map_err(refused)?);
        }
        let bytes = condense::Analysis::bytes_of_all(&analyses);
        Ok((Analyses::Bodies(analyses), bytes))
    }

    fn condensed(&self) -> Result<Solver, Diagnostic> {
        let retained = retained(self.model, self.interfaces, self.stages);
        let (prepared, bodies) = self.condensations(&retained)?;
        let unknowns = self.interfaces.iter().map(|i| i.unknowns).sum::<usize>();
        let kept = retained.iter().map(Vec::len).sum::<usize>() + unknowns;
        let friction = self.unsymmetric().is_some();
        let operations = (kept as f64).powi(3) / if friction { 1.5 } else { 3.0 };
        let (method, dense, operations, why) = if self.has_pairs() && operations > DENSE_AVOIDED {
            let points = self.interfaces.iter().map(|i| i.slave.len()).sum::<usize>();
            let components = points * self.model.idealisation.components();
            let of_bodies = retained.iter().map(|r| r.len().pow(2)).sum::<usize>();
            let widest = retained.iter().map(Vec::len).max().unwrap_or(0);
            // Compliance and factor; of each body the sum of constant terms, and its factor.
            let values = 2 * components.pow(2) + 2 * of_bodies + widest * components;
            let read = PRODUCTS * (2 * components.pow(2) + of_bodies);
            let how = if components > FACTORED_COMPONENTS {
                "GMRES with a dense LU factor of an earlier step"
            } else {
                "direct: dense LU"
            };
            let why = format!("{how} for the tractions at {points} points, bodies by Cholesky factors");
            (Method::Flexibility, values, WAIT * read as f64, why)
        } else {
            let interface = if friction { "LU where friction acts" } else { "Cholesky factors" };
            let why = format!("direct: bodies by Cholesky factors, the interface by dense {interface}");
            // The interface matrix, its factor, and the copy made for a term.
            (Method::Dense, 3 * kept * kept, operations, why)
        };
        let bytes = bodies + dense * size_of::<f64>();
        if bytes > self.memory() {
            let what = format!("condensing the bodies onto {kept} degrees of freedom");
            return Err(self.too_much(&what, bytes, false));
        }
        Ok(Solver { method, memory: self.memory(), prepared, bytes, operations: Some(operations), why })
    }

    /// True if contact acts through the relative displacements of pairs alone, whose tractions can be solved for.
    fn has_pairs(&self) -> bool {
        let fixed = |i: &PlannedInterface| i.sliding == Sliding::Small && i.unknowns == 0;
        self.interfaces.iter().all(fixed) && self.scene.solver.method() != Asked::Direct
    }

    /// A refusal of the condensation that names the full system where that is solved.
    fn or_full(&self, refused: Diagnostic) -> Diagnostic {
        if self.full().is_err() {
            return refused;
        }
        let full = "use `path = \"full\"` in `[time]`";
        let help = refused.help.map_or_else(|| full.to_string(), |help| format!("{full}, or {help}"));
        Diagnostic { help: Some(help), ..refused }
    }

    fn full(&self) -> Result<Solver, Diagnostic> {
        let method = self.scene.solver.method();
        if method == Asked::Iterative {
            return self.iterative("the scene asks for it".into());
        }
        let unsymmetric = self.unsymmetric();
        let (prepared, cost) = match self.counted(forecast::factorisation, |cost| cost.bytes) {
            Some(cost) => (Analyses::Nothing, cost),
            None => {
                let patterns: Vec<&Pattern> = self.model.blocks.iter().map(CellBlock::pattern).collect();
                let analysis = LowerTriangle::new(&patterns, &self.equations()).analyse();
                let analysis = analysis.map_err(|e| self.at_memory(e.to_string()))?;
                let symbolic = analysis.symbolic();
                let cost = Factorisation { bytes: symbolic.bytes(), operations: symbolic.operations() };
                (Analyses::System(analysis), cost)
            }
        };
        if unsymmetric.is_some() && self.avoids_lu(cost) {
            let cost = Factorisation { bytes: cost.bytes + self.matrix(), ..cost };
            let fits = cost.bytes <= self.memory();
            if fits && method == Asked::Auto && self.avoids_factors(cost) {
                return Ok(self.levels_first(prepared));
            }
            if fits {
                return Ok(self.preconditioned(prepared, cost));
            }
        }
        let cost = if unsymmetric.is_some() { lu(cost) } else { cost };
        let bytes = cost.bytes;
        if bytes <= self.memory() {
            return Ok(self.direct(prepared, cost));
        }
        if method == Asked::Auto && self.may_iterate() {
            let why = format!("a factorisation would take {} of {}", size(bytes), size(self.memory()));
            return self.iterative(why);
        }
        let what = format!("the factorisation of {} degrees of freedom", self.model.dofs());
        Err(self.too_much(&what, bytes, unsymmetric.is_none() || (self.definite() && self.corrects())))
    }

    /// True if LU of an unsymmetric matrix takes so long that iterations with a Cholesky factor are better, and can take its place.
    fn avoids_lu(&self, cost: Factorisation) -> bool {
        let asked = self.scene.solver.method() == Asked::Direct;
        cost.operations > LU_AVOIDED && self.definite() && !asked && !self.stepping.is_forward()
    }

    /// True if a Cholesky factor of each step takes so long that levels are better, and can take its place.
    fn avoids_factors(&self, cost: Factorisation) -> bool {
        cost.operations > FACTORS_AVOIDED && self.may_iterate() && self.levels() <= self.memory()
    }

    /// Levels, and a factor in steps where they do not serve.
    fn levels_first(&self, prepared: Analyses) -> Solver {
        let (tolerance, most) = self.iteration_bounds();
        let tolerance = tolerance.unwrap_or(DIRECTION);
        let most_iterations = most.unwrap_or(MOST_BEFORE_FACTORS);
        let method = Method::Aggregated { factors: true, tolerance, most_iterations };
        let why = format!(
            "iterative: a factorisation takes longer; GMRES to {tolerance:e} of the load, with smoothed aggregation, and with a \
             Cholesky factor for the rest of a step in which that fails"
        );
        Solver {
            method,
            memory: self.memory(),
            prepared,
            bytes: self.levels(),
            operations: Some(self.iterated()),
            why,
        }
    }

    /// Tolerance and largest number of iterations that the scene asks for.
    fn iteration_bounds(&self) -> (Option<f64>, Option<usize>) {
        let solver = &self.scene.solver;
        let tolerance = solver.tolerance.as_ref().map(|t| *t.get_ref());
        (tolerance, solver.most_iterations.as_ref().map(|m| *m.get_ref()))
    }

    /// Operations of a factorisation in the time of an iteration of Newton's method with levels.
    fn iterated(&self) -> f64 {
        let of_cells = if self.model.is_linear() { 1.0 } else { NONLINEAR };
        OF_LEVELS * of_cells * self.model.dofs() as f64
    }

    /// Memory of levels, of the matrix and its neighbour, and of the basis of GMRES \[bytes\].
    fn levels(&self) -> usize {
        AGGREGATED * self.matrix()
    }

    /// Memory of the matrix \[bytes\].
    fn matrix(&self) -> usize {
        forecast::matrix_bytes(&counts(&self.model.mesh), self.model.idealisation.components())
    }

    fn preconditioned(&self, prepared: Analyses, cost: Factorisation) -> Solver {
        Solver {
            method: Method::Preconditioned,
            memory: self.memory(),
            prepared,
            bytes: cost.bytes,
            operations: Some(cost.operations),
            why:
                "GMRES with a Cholesky factor of each step; LU, where the matrix is unsymmetric, takes longer"
                    .into(),
        }
    }

    /// True if the iterative method is a remedy when factors do not fit into memory.
    fn may_iterate(&self) -> bool {
        let linear = self.interfaces.is_empty() && self.model.is_linear();
        D == 3 && self.pulled().is_none() && self.definite() && (linear || self.corrects())
    }

    /// True if steps look for equilibrium, whatever a solution leaves.
    fn corrects(&self) -> bool {
        self.scene.inertia().is_none() && !self.stepping.is_forward()
    }

    /// True if multipliers are no unknowns, which make the matrix indefinite.
    fn definite(&self) -> bool {
        self.interfaces.iter().all(|i| i.unknowns == 0)
    }

    /// Equation numbering of the first stage.
    fn equations(&self) -> Equations {
        let constraints = Constraints { fixed: self.stages[0].fixed.clone(), channels: Vec::new() };
        constraints.equations(self.model.dofs())
    }

    fn direct(&self, prepared: Analyses, cost: Factorisation) -> Solver {
        let general =
            |s: &&Stage| symmetry(self.model, self.interfaces, self.stepping, s) == Symmetry::General;
        let count = self.stages.iter().filter(general).count();
        let factors = match count {
            0 => "symmetric factorisation (Cholesky)".to_string(),
            n if n == self.stages.len() => "unsymmetric factorisation (LU)".to_string(),
            _ => {
                let names: Vec<String> =
                    self.stages.iter().filter(general).map(|s| format!("`{}`", s.name)).collect();
                format!("symmetric factorisation (Cholesky), unsymmetric (LU) in {}", names.join(", "))
            }
        };
        let still = self.scene.inertia().is_none();
        let once = self.interfaces.is_empty() && self.model.is_linear() && still;
        let often = if once { ", once for each set of supports" } else { "" };
        Solver {
            method: Method::Sparse,
            memory: self.memory(),
            prepared,
            bytes: cost.bytes,
            operations: (!once).then_some(cost.operations),
            why: format!("direct: {factors}{often}"),
        }
    }

    /// First spring of the scene.
    fn pulled(&self) -> Option<&Spring> {
        self.stages.iter().flat_map(|s| &s.springs).next()
    }

    fn iterative(&self, why: String) -> Result<Solver, Diagnostic> {
        let solver = &self.scene.solver;
        if let Some(spring) = self.pulled() {
            return Err(Diagnostic::at(
                solver.method.as_ref().map_or(0..0, Spanned::span),
                format!(
                    "the iterative method numbers every node on its own, but a spring moves `{}` as one",
                    spring.set
                ),
                "use `method = \"direct\"`, or leave it out",
            ));
        }
        let given = solver.method.as_ref().map_or(0..0, Spanned::span);
        if !self.definite() {
            return Err(Diagnostic::at(
                given,
                "the iterative method needs a matrix that is nearly positive definite, but multipliers that are unknowns \
                 (\"augmented-lagrangian\") make it indefinite",
                "use `method = \"direct\"`, or leave it out",
            ));
        }
        let symmetric = self.unsymmetric().is_none();
        if !symmetric && self.stepping.is_forward() {
            return Err(Diagnostic::at(
                given,
                "the iterative method leaves residuals that steps of \"static-explicit\" do not correct",
                "use `method = \"direct\"`, or leave it out",
            ));
        }
        let bytes = if symmetric { HIERARCHY * self.matrix() } else { self.levels() };
        if bytes > self.memory() {
            let what = format!("the iterative solution of {} degrees of freedom", self.model.dofs());
            return Err(self.too_much(&what, bytes, false));
        }
        let (tolerance, most) = self.iteration_bounds();
        let most_iterations = most.unwrap_or(defaults::MOST_ITERATIONS);
        let (method, how) = if symmetric {
            let tolerance = tolerance.unwrap_or(defaults::SOLVER_TOLERANCE);
            (
                Method::Iterative { tolerance, most_iterations },
                format!("conjugate gradients to {tolerance:e}"),
            )
        } else {
            let tolerance = tolerance.unwrap_or(DIRECTION);
            (
                Method::Aggregated { factors: false, tolerance, most_iterations },
                format!("GMRES to {tolerance:e}"),
            )
        };
        let why = format!("iterative: {why}; {how} of the load, with smoothed aggregation");
        let (memory, prepared) = (self.memory(), Analyses::Nothing);
        let once = self.interfaces.is_empty() && self.model.is_linear();
        let operations = (!once).then(|| self.iterated());
        Ok(Solver { method, memory, prepared, bytes, operations, why })
    }

    /// Error for a system that is too large to be numbered.
    fn at_memory(&self, message: String) -> Diagnostic {
        let solver = &self.scene.solver;
        let given = solver.memory.as_ref().map(Spanned::span).or(solver.method.as_ref().map(Spanned::span));
        let place = given.unwrap_or_else(|| forecast::place_of_size(self.scene));
        Diagnostic::at(place, message, "take a coarser mesh")
    }

    fn too_much(&self, what: &str, bytes: usize, iterative: bool) -> Diagnostic {
        let iterative = if iterative { ", use `method = \"iterative\"` in `[solver]`" } else { "" };
        Diagnostic::at(
            forecast::place_of_size(self.scene),
            format!("{what} needs about {}, and {} are allowed", size(bytes), size(self.memory())),
            format!(
                "raise `memory` in `[solver]` where the machine has it{iterative}, or take a coarser mesh"
            ),
        )
    }
}
