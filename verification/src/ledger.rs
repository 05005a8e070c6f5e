//! Ledger of a case: claims, order studies, plots, tables, notes.
//!
//! ```
//! # use asperity_verification::{Cost, Evidence, Ledger};
//! # let mut ledger = Ledger::new(&[]);
//! let (stress, cost) = Cost::measure(|| 12.0004);
//! ledger
//!     .claim("mean normal stress, h = 1.25 mm")
//!     .unit("MPa")
//!     .value(stress)
//!     .equals(12.0)
//!     .relative(1e-4)
//!     .evidence(Evidence::Exact, "bar under prescribed ends")
//!     .because("the mesh error of a uniform field is zero; the penalty leaves 3e-5")
//!     .cost(&cost)
//!     .record();
//! ```

use crate::capability::Capability;
use crate::claim::{Claim, Evidence, JudgedClaim, Norm, Test};
use crate::cost::Cost;
use crate::order::{Floor, Level, OrderTest, Plateau};
use asperity_output::figures::Diagram;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Debug;

/// A table of the case's page.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Table {
    /// Caption.
    pub title: String,
    /// Column heads.
    pub head: Vec<String>,
    /// Rows of cells.
    pub rows: Vec<Vec<String>>,
}

/// A drawing on the page of a case: a field, a mesh or a sketch.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Title.
    pub title: String,
    /// Drawing as SVG.
    pub svg: String,
    /// Text below it.
    pub caption: String,
}

/// A part of a case with a page of its own.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Title.
    pub title: String,
    /// Scene it is about.
    pub scene: String,
    /// Tables.
    pub tables: Vec<Table>,
}

/// Everything a case recorded.
#[derive(Debug, Default)]
pub struct Record {
    /// Judged claims, in order.
    pub claims: Vec<JudgedClaim>,
    /// Drawings.
    pub pictures: Vec<Picture>,
    /// Plots.
    pub plots: Vec<Diagram>,
    /// Tables.
    pub tables: Vec<Table>,
    /// Pages of their own.
    pub sheets: Vec<Sheet>,
    /// Notes.
    pub notes: Vec<String>,
}

/// Collects the claims and figures of a case. Claims are judged as they are recorded.
#[derive(Debug)]
pub struct Ledger {
    covers: &'static [Capability],
    record: Record,
}

impl Ledger {
    /// An empty ledger whose claims are evidence for these capabilities unless they name others.
    pub fn new(covers: &'static [Capability]) -> Ledger {
        Ledger { covers, record: Record::default() }
    }

    /// Begins a claim on a quantity. It counts only after `record` is called.
    pub fn claim(&mut self, quantity: impl Into<String>) -> Draft<'_> {
        let common = Common::new(quantity.into(), self.covers);
        Draft {
            ledger: self,
            common,
            values: Vec::new(),
            references: Vec::new(),
            norm: Norm::Largest,
            test: None,
        }
    }

    /// Begins a claim on an order of convergence.
    pub fn order(&mut self, quantity: impl Into<String>) -> OrderDraft<'_> {
        let common = Common::new(quantity.into(), self.covers);
        OrderDraft { ledger: self, common, test: OrderTest::default(), finest: None }
    }

    /// States that a quantity is not covered, with the reason. Only for quantities that no issue names.
    pub fn not_covered(&mut self, quantity: impl Into<String>, reason: impl Into<String>) {
        let claim = Common::new(quantity.into(), &[]).with(Test::NotCovered { reason: reason.into() });
        self.record.claims.push(claim.judge());
    }

    /// Adds a plot to the case's page.
    pub fn plot(&mut self, plot: Diagram) {
        self.record.plots.push(plot);
    }

    /// Adds a page that the case's page links to.
    pub fn sheet(&mut self, sheet: Sheet) {
        self.record.sheets.push(sheet);
    }

    /// Adds a drawing to the case's page.
    pub fn picture(&mut self, title: impl Into<String>, svg: String, caption: impl Into<String>) {
        self.record.pictures.push(Picture { title: title.into(), svg, caption: caption.into() });
    }

    /// Adds a paragraph to the case's page.
    pub fn note(&mut self, text: impl Into<String>) {
        self.record.notes.push(text.into());
    }

    /// Adds a table to the case's page.
    pub fn table<R, C>(&mut self, title: impl Into<String>, head: &[&str], rows: R)
    where
        R: IntoIterator<Item = C>,
        C: IntoIterator<Item = String>,
    {
        self.record.tables.push(Table {
            title: title.into(),
            head: head.iter().map(|&cell| cell.to_owned()).collect(),
            rows: rows.into_iter().map(|row| row.into_iter().collect()).collect(),
        });
    }

    /// The claims recorded so far.
    pub fn claims(&self) -> &[JudgedClaim] {
        &self.record.claims
    }

    /// True if no claim was recorded.
    pub fn is_empty(&self) -> bool {
        self.record.claims.is_empty()
    }

    pub(crate) fn did_not_run(&mut self, error: &str) {
        let claim =
            Common::new("the case runs to its end".into(), &[]).with(Test::NotRun { error: error.into() });
        self.record.claims.push(claim.judge());
    }

    /// Finishes the ledger and returns its record.
    pub fn finish(self) -> Record {
        self.record
    }
}

/// Reason why a claim that two settings agree is void.
const ALONE: &str = "the two settings that are to agree are the same";

/// Parts common to all kinds of claims.
#[derive(Debug)]
struct Common {
    quantity: String,
    unit: String,
    norm: String,
    evidence: Option<Evidence>,
    source: String,
    uncertainty: f64,
    because: String,
    why_not_tighter: String,
    covers: Vec<Capability>,
    cost: Cost,
    /// True if the two settings that the claim compares are identical.
    alone: bool,
}

impl Common {
    fn new(quantity: String, covers: &[Capability]) -> Common {
        Common {
            quantity,
            unit: String::new(),
            norm: String::new(),
            evidence: None,
            source: String::new(),
            uncertainty: 0.0,
            because: String::new(),
            why_not_tighter: String::new(),
            covers: covers.to_vec(),
            cost: Cost::default(),
            alone: false,
        }
    }

    fn with(self, test: Test) -> Claim {
        let test = if self.alone { Test::NotRun { error: ALONE.into() } } else { test };
        Claim {
            quantity: self.quantity,
            unit: self.unit,
            norm: self.norm,
            test,
            evidence: self.evidence,
            source: self.source,
            uncertainty: self.uncertainty,
            because: self.because,
            why_not_tighter: self.why_not_tighter,
            covers: self.covers,
            cost: self.cost,
        }
    }
}

macro_rules! common_setters {
    () => {
        /// Unit of the values and of the absolute bounds.
        pub fn unit(mut self, unit: impl Into<String>) -> Self {
            self.common.unit = unit.into();
            self
        }

        /// Norm or selection as text, such as "largest over the eight probes".
        pub fn norm(mut self, text: impl Into<String>) -> Self {
            self.common.norm = text.into();
            self
        }

        /// Kind of evidence and source of the reference.
        pub fn evidence(mut self, kind: Evidence, source: impl Into<String>) -> Self {
            self.common.evidence = Some(kind);
            self.common.source = source.into();
            self
        }

        /// Reason for the bound.
        pub fn because(mut self, reason: impl Into<String>) -> Self {
            self.common.because = reason.into();
            self
        }

        /// Reason why the bound is not tighter although the error is below a tenth of it.
        pub fn why_not_tighter(mut self, reason: impl Into<String>) -> Self {
            self.common.why_not_tighter = reason.into();
            self
        }

        /// Capabilities for which this claim is evidence, instead of those of the case.
        pub fn covers(mut self, capabilities: &[Capability]) -> Self {
            self.common.covers = capabilities.to_vec();
            self
        }

        /// Cost of the run behind the claim.
        pub fn cost(mut self, cost: &Cost) -> Self {
            self.common.cost = cost.clone();
            self
        }
    };
}

/// Kind of test selected by the last call on a draft.
#[derive(Clone, Copy, Debug)]
enum Choice {
    Absolute(f64),
    Relative(f64),
    AtMost(f64),
    AtLeast(f64),
    Count(u64, u64),
}

/// A claim being written.
#[derive(Debug)]
#[must_use = "a claim counts only once it is recorded"]
pub struct Draft<'a> {
    ledger: &'a mut Ledger,
    common: Common,
    values: Vec<f64>,
    references: Vec<f64>,
    norm: Norm,
    test: Option<Choice>,
}

impl Draft<'_> {
    common_setters!();

    /// The two settings that should agree: scenes, their texts or their plans. If they are identical, the claim disagrees, since
    /// it compares a run with itself.
    pub fn between<T: Debug + ?Sized>(mut self, one: &T, other: &T) -> Self {
        self.common.alone |= format!("{one:?}") == format!("{other:?}");
        self
    }

    /// Value of the code.
    pub fn value(self, value: f64) -> Self {
        self.values(&[value])
    }

    /// Several values of the code, compared in one norm.
    pub fn values(mut self, values: &[f64]) -> Self {
        self.values = values.to_vec();
        self
    }

    /// Reference value.
    pub fn equals(self, reference: f64) -> Self {
        self.equals_each(&[reference])
    }

    /// Reference values, one by one.
    pub fn equals_each(mut self, references: &[f64]) -> Self {
        self.references = references.to_vec();
        self
    }

    /// Uncertainty of the reference, in its unit. If it exceeds the bound, the claim disagrees.
    pub fn uncertainty(mut self, uncertainty: f64) -> Self {
        self.common.uncertainty = uncertainty;
        self
    }

    /// Uses the root mean square of the differences instead of the largest.
    pub fn root_mean_square(mut self) -> Self {
        self.norm = Norm::RootMeanSquare;
        self
    }

    /// Bounds the error, in the unit of the values.
    pub fn absolute(mut self, bound: f64) -> Self {
        self.test = Some(Choice::Absolute(bound));
        self
    }

    /// Bounds the error as a fraction of the reference.
    pub fn relative(mut self, bound: f64) -> Self {
        self.test = Some(Choice::Relative(bound));
        self
    }

    /// Bounds a single value from above by a positive number, for errors, residuals and remainders.
    pub fn at_most(mut self, bound: f64) -> Self {
        self.test = Some(Choice::AtMost(bound));
        self
    }

    /// Bounds a single value from below by a positive number, for factors and ratios.
    pub fn at_least(mut self, bound: f64) -> Self {
        self.test = Some(Choice::AtLeast(bound));
        self
    }

    /// Claims an exact count. Only valid if control flow cannot depend on the last bits.
    pub fn count(mut self, value: u64, expected: u64) -> Self {
        self.test = Some(Choice::Count(value, expected));
        self
    }

    /// Judges the claim and enters it.
    pub fn record(self) {
        let Draft { ledger, common, values, references, norm, test } = self;
        let one = if let [value] = values[..] { value } else { f64::NAN };
        let test = match test {
            Some(Choice::Absolute(bound)) => Test::Absolute { values, references, norm, bound },
            Some(Choice::Relative(bound)) => Test::Relative { values, references, norm, bound },
            Some(Choice::AtMost(bound)) => Test::AtMost { value: one, bound },
            Some(Choice::AtLeast(bound)) => Test::AtLeast { value: one, bound },
            Some(Choice::Count(value, expected)) => Test::Count { value, expected },
            None => Test::NotRun { error: "the claim has no bound".into() },
        };
        ledger.record.claims.push(common.with(test).judge());
    }
}

/// A claim on an order being written. It becomes two claims: on the order, and on the error of the finest level.
#[derive(Debug)]
#[must_use = "a claim counts only once it is recorded"]
pub struct OrderDraft<'a> {
    ledger: &'a mut Ledger,
    common: Common,
    test: OrderTest,
    finest: Option<(f64, String)>,
}

impl OrderDraft<'_> {
    common_setters!();

    /// The levels (size, error), from coarse to fine; at least three.
    pub fn levels(mut self, levels: &[(f64, f64)]) -> Self {
        self.test.levels = levels.iter().map(|&level| Level::from(level)).collect();
        self
    }

    /// Theoretical order.
    pub fn expected(mut self, order: f64) -> Self {
        self.test.expected = order;
        self
    }

    /// Largest allowed deviation from the expected order.
    pub fn within(mut self, tolerance: f64) -> Self {
        self.test.tolerance = tolerance;
        self
    }

    /// Accepts higher orders than expected.
    pub fn or_better(mut self) -> Self {
        self.test.or_better = true;
        self
    }

    /// Floor that the errors may reach: levels at or below it are ignored in the order.
    pub fn floor(mut self, floor: Floor, level: f64) -> Self {
        self.test.plateau = Some(Plateau { floor, level });
        self
    }

    /// Bounds the error on the finest level; an order without this bound disagrees.
    pub fn finest(mut self, bound: f64, because: impl Into<String>) -> Self {
        self.finest = Some((bound, because.into()));
        self
    }

    /// Judges both claims and enters them.
    pub fn record(self) {
        let OrderDraft { ledger, mut common, test, finest } = self;
        let error = test.levels.last().map_or(f64::NAN, |level| level.error);
        let (bound, because) = finest.unwrap_or((f64::NAN, String::new()));
        let absolute = Common {
            quantity: format!("{}: error on the finest level", common.quantity),
            unit: common.unit.clone(),
            norm: common.norm.clone(),
            evidence: common.evidence,
            source: common.source.clone(),
            uncertainty: 0.0,
            because,
            why_not_tighter: common.why_not_tighter.clone(),
            covers: common.covers.clone(),
            cost: common.cost.clone(),
            alone: false,
        };
        common.quantity = format!("{}: order", common.quantity);
        ledger.record.claims.push(common.with(Test::Order(test)).judge());
        ledger.record.claims.push(absolute.with(Test::AtMost { value: error, bound }).judge());
    }
}
