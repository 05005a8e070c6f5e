//! The seam: what a stepper knows of a body, a condensed body or an interface.
//!
//! A [`Term`] couples some of the system's degrees of freedom, adds its residual, and keeps its own history in two
//! copies: committed and trial. A residual writes the trial copy only; [`Term::accept`] commits it and [`Term::reject`]
//! drops it. Capabilities beyond the residual are separate traits, so that a stepper asks for exactly what it uses.

use crate::relative::RelativeDisplacements;
use std::fmt;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// The step a trial state belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Time at the end of the step \[s\].
    pub time: f64,
    /// Length of the step \[s\].
    pub dt: f64,
}

/// Reason why a term could not answer at a trial state. An outcome for the step controller, not an error of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The term that refused.
    pub term: String,
    /// The event, with the place (node, element) and the offending numbers.
    pub reason: String,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.term, self.reason)
    }
}

/// Reason why a step whose equations are solved should not stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Objection {
    /// The term that objects.
    pub term: String,
    /// The event, with the numbers.
    pub reason: String,
    /// Position in the reference configuration \[m\].
    pub position: [f64; 3],
    /// Slip rate there \[m/s\].
    pub rate: f64,
    /// True if a shorter step may be free of it.
    pub shorter: bool,
    /// True if it is for want of points: the step may be right, and what follows would be that of the mesh.
    pub coarse: bool,
}

impl fmt::Display for Objection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.term, self.reason)
    }
}

/// A contribution to the balance of forces `r(u) = f_int - f_ext = 0` on the system's degrees of freedom.
pub trait Term {
    /// Name for reports.
    fn name(&self) -> &str;

    /// Adds this term's residual \[N, or N/m of thickness in two dimensions\] at displacement `u` \[m\] to `r`. Both have
    /// one entry per degree of freedom of the system. Writes only trial history.
    ///
    /// # Errors
    /// [`Refusal`] when the trial state cannot be evaluated (the step is then halved).
    fn residual(&mut self, u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal>;

    /// Search and pairing may change here, at the start of a step or of a Newton iteration, and nowhere else.
    fn prepare(&mut self, _u: &[f64]) -> Result<(), Refusal> {
        Ok(())
    }

    /// Reason why the solution whose trial history this is should not be accepted, where it should not: the equations of the step hold, and
    /// the step does not follow what happens within it, or leaves the model.
    fn objection(&self) -> Option<Objection> {
        None
    }

    /// Largest difference between the term's own unknowns and the forces of the last residual \[N\]; 0 where it has none. See
    /// [`Term::direct`].
    fn unsettled(&self) -> f64 {
        0.0
    }

    /// Takes the direction of an iteration from the displacements of the last residual, for unknowns of the term's own that are
    /// eliminated from the system.
    fn direct(&mut self, _along: &[f64]) {}

    /// Moves such unknowns to a length along that direction; residuals that follow are at that length.
    fn advance(&mut self, _length: f64) {}

    /// Drops such unknowns until the next direction.
    fn restart(&mut self) {}

    /// Estimated error that the step leaves in friction coefficients \[-\]; 0 where none follows rates.
    fn error(&mut self) -> f64 {
        0.0
    }

    /// Commits the trial history of the last residual.
    fn accept(&mut self);

    /// Drops the trial history.
    fn reject(&mut self);
}

/// Block structure of a term's tangent: dense square blocks, each with its list of degrees of freedom. It never changes: a term whose blocks
/// change makes another one, which has another [`PatternId`].
#[derive(Clone, Debug)]
pub struct Pattern {
    blocks: Blocks,
    id: PatternId,
    /// See [`Pattern::most_products`]; counted when it is asked for first.
    products: OnceLock<usize>,
}

/// Identity of a pattern. Only a new pattern has a new one, and a clone keeps it, so that a factorisation that remembers it cannot be used
/// with other blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PatternId(u64);

impl PatternId {
    fn mint() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// Blocks of a pattern under construction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Blocks {
    /// Degrees of freedom of all blocks, one block after another.
    dofs: Vec<usize>,
    /// Start of each block in `dofs`; one more entry than there are blocks.
    starts: Vec<usize>,
}

impl Default for Blocks {
    fn default() -> Self {
        Self { dofs: Vec::new(), starts: vec![0] }
    }
}

impl Blocks {
    /// Blocks of one size, given one after another.
    #[must_use]
    pub fn uniform(dofs: Vec<usize>, size: usize) -> Self {
        let starts = (0..=dofs.len() / size.max(1)).map(|k| k * size).collect();
        Self { dofs, starts }
    }

    /// No blocks, with room for so many degrees of freedom.
    #[must_use]
    pub fn with_capacity(dofs: usize) -> Self {
        Self { dofs: Vec::with_capacity(dofs), starts: vec![0] }
    }

    /// Adds a block.
    pub fn push(&mut self, dofs: impl IntoIterator<Item = usize>) {
        self.dofs.extend(dofs);
        self.starts.push(self.dofs.len());
    }

    /// Adds the blocks of a pattern, without a copy where there are none yet.
    pub fn append(&mut self, pattern: Pattern) {
        if self.dofs.is_empty() {
            *self = pattern.blocks;
            return;
        }
        let offset = self.dofs.len();
        self.starts.extend(pattern.blocks.starts[1..].iter().map(|s| s + offset));
        self.dofs.extend(pattern.blocks.dofs);
    }
}

impl From<Blocks> for Pattern {
    fn from(blocks: Blocks) -> Self {
        Self::new(blocks)
    }
}

impl Default for Pattern {
    fn default() -> Self {
        Self::new(Blocks::default())
    }
}

impl Pattern {
    /// Makes a pattern, and its identity.
    #[must_use]
    pub fn new(blocks: Blocks) -> Self {
        Self { blocks, id: PatternId::mint(), products: OnceLock::new() }
    }

    /// Makes a pattern of blocks given one after another.
    pub fn from_blocks<'a>(blocks: impl IntoIterator<Item = &'a [usize]>) -> Self {
        let mut all = Blocks::default();
        blocks.into_iter().for_each(|block| all.push(block.iter().copied()));
        Self::new(all)
    }

    /// Returns the identity.
    #[must_use]
    pub fn id(&self) -> PatternId {
        self.id
    }

    /// Takes other blocks, and another identity with them; none where they are the same.
    pub fn renew(&mut self, blocks: Blocks) {
        if self.blocks != blocks {
            *self = Self::new(blocks);
        }
    }

    /// Degrees of freedom of all blocks, one block after another.
    #[must_use]
    pub fn dofs(&self) -> &[usize] {
        &self.blocks.dofs
    }

    /// Start of each block in [`Pattern::dofs`]; one more entry than there are blocks.
    #[must_use]
    pub fn starts(&self) -> &[usize] {
        &self.blocks.starts
    }

    /// Degrees of freedom of a block.
    #[must_use]
    pub fn block(&self, k: usize) -> &[usize] {
        &self.dofs()[self.starts()[k]..self.starts()[k + 1]]
    }

    /// Degrees of freedom of each block, in order.
    pub fn blocks(&self) -> impl Iterator<Item = &[usize]> {
        self.starts().windows(2).map(|w| &self.dofs()[w[0]..w[1]])
    }

    /// Largest number of products of an entry and a displacement whose sum is the force along one degree of freedom.
    #[must_use]
    pub fn most_products(&self) -> usize {
        *self.products.get_or_init(|| {
            let mut products = vec![0; self.dofs().iter().max().map_or(0, |last| last + 1)];
            for block in self.blocks() {
                block.iter().for_each(|&dof| products[dof] += block.len());
            }
            products.into_iter().max().unwrap_or(0)
        })
    }

    /// Number of values of a tangent with this pattern: the sum of the squares of the block sizes.
    #[must_use]
    pub fn values(&self) -> usize {
        self.blocks().map(|b| b.len() * b.len()).sum()
    }
}

/// Gives the consistent tangent `K = ∂r/∂u`.
pub trait Linearized: Term {
    /// The present block structure.
    fn pattern(&self) -> &Pattern;

    /// Writes the tangent at the state of the last residual: for each block of the pattern its entries row by row.
    fn tangent(&mut self, values: &mut [f64]);

    /// Writes a symmetric matrix near the tangent in the same order, from which an unsymmetric system is preconditioned. It resists
    /// no motion that the tangent does not resist.
    fn symmetric_tangent(&mut self, values: &mut [f64]) {
        self.tangent(values);
    }

    /// The tangent, where it is the same at every state and in every step, as [`Linearized::tangent`] writes it. A system of
    /// such terms alone is factored once.
    fn constant_tangent(&self) -> Option<&[f64]> {
        None
    }

    /// Relative displacements of pairs, where each block of the tangent is `s_k s_j M` with the weights s of one pair and a matrix M
    /// over its components.
    fn relative(&self) -> Option<&RelativeDisplacements> {
        None
    }

    /// The term as one whose constraints a stepper enforces by augmentation, where it is one.
    fn augmented(&mut self) -> Option<&mut dyn Augmented> {
        None
    }
}

/// Constraints enforced by multipliers that move between solutions of the balance of forces (Uzawa's method): within a
/// solution the term acts like springs about the forces reached before.
pub trait Augmented {
    /// Largest violation of the constraints at the state of the last residual, over the tolerance \[-\].
    fn violation(&self) -> f64;

    /// Augmentations a step may take.
    fn most(&self) -> usize;

    /// Makes the forces of the last residual the multipliers of the next; [`Term::reject`] takes that back.
    fn augment(&mut self);

    /// The largest violation as text, for a step that gives up.
    fn violated(&self) -> Refusal;
}

/// The largest admissible fraction of a forward step (the R-minimum rule).
#[derive(Clone, Debug, PartialEq)]
pub struct Fraction {
    /// r in (0, 1\].
    pub value: f64,
    /// Which limit binds and where ("r4 open -> closed, node 17").
    pub cause: String,
    /// Identifier of the limit ("r4").
    pub limit: &'static str,
}

impl Fraction {
    /// True if the limit bounds what a step may err, so that a longer one would not do, and is not an event.
    #[must_use]
    pub fn bounds_accuracy(&self) -> bool {
        matches!(self.limit, "r2" | "r3" | "r8")
    }
}

/// Serves forward (rate-form) steps: `K Δu = ΔF`, from the committed state.
pub trait ForwardTerm: Linearized {
    /// Writes the rate tangent in the order of the pattern, and adds the constant part of the force increment over `dt`
    /// that does not depend on Δu (with the sign of a residual) to `constant`.
    ///
    /// # Errors
    /// [`Refusal`] when the linearisation does not exist (for a rate law: E_t + H ≤ 0).
    fn rate(&mut self, at: Instant, values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal>;

    /// Switches what answers the increment `du` otherwise than the rate tangent assumed: what was to slip and would slip backwards,
    /// or was to stick and is at its strength already. Returns true if any point switched: the increment must then be recomputed.
    /// Nothing switches for ever within one step.
    fn switch(&mut self, _du: &[f64], _at: Instant) -> bool {
        false
    }

    /// The largest fraction of the increment `du` over `dt` this term admits, or `None` when it sets no limit.
    fn limit(&mut self, _du: &[f64], _at: Instant) -> Option<Fraction> {
        None
    }
}

/// Gives and takes committed history as plain values.
pub trait Restorable {
    /// The values.
    type State;

    /// Committed history, and all else that decides how the term answers what follows, to the last bit.
    fn save(&self) -> Self::State;

    /// Restores what [`Restorable::save`] gave. Returns false, changing nothing, when the sizes do not fit.
    fn restore(&mut self, saved: &Self::State) -> bool;
}
