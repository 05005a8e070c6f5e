//! Glossary of the pages.

use super::page::{Depth, escape, page};
use super::provenance::Provenance;

/// Anchor, word and meaning.
pub const WORDS: [(&str, &str, &str); 25] = [
    (
        "claim",
        "claim, check",
        "A statement about one quantity of a run: its value, a reference, and how far they may lie apart. It holds or disagrees.",
    ),
    (
        "holds",
        "holds",
        "The error is at most the bound, everything the claim must state is stated, and its negative control fails as it must.",
    ),
    (
        "disagrees",
        "disagrees",
        "The error exceeds the bound or is no number, the run failed, or the claim lacks its source or its reason. The suite then fails.",
    ),
    ("not-covered", "not covered", "A quantity that nobody compares yet, with the reason."),
    (
        "error",
        "error",
        "The distance of the value from the reference, in the norm that the claim names. For a relative bound it is divided by the size of the reference.",
    ),
    (
        "bound",
        "bound, tolerance",
        "The largest error with which a claim holds. It is set before the run and has a reason.",
    ),
    ("ratio", "error / bound", "The share of its tolerance that a claim uses. Above 1 it disagrees."),
    (
        "near",
        "near its tolerance (also: thin)",
        "The error is within 20 % of the bound: above four fifths of it. A small change may make the claim disagree.",
    ),
    (
        "loose",
        "loose (also: slack)",
        "The bound is more than ten times looser than needed: the error is below a tenth of it. Such a bound hardly tests the result, so the claim says why it may not be tighter, or is listed as being without a reason yet.",
    ),
    (
        "control",
        "negative control",
        "After a claim holds, the harness moves its value by three bounds. A claim that still holds tests nothing and counts as a disagreement.",
    ),
    (
        "uncertainty",
        "uncertainty of the reference",
        "How far the reference itself may be off. It must be smaller than the bound.",
    ),
    ("exact", "exact", "The reference is a closed-form solution or an identity."),
    ("manufactured", "manufactured", "The reference is a chosen solution whose loads were computed from it."),
    (
        "semi-analytic",
        "semi-analytic",
        "The reference is a series, a quadrature or an ordinary differential equation, evaluated to a known accuracy.",
    ),
    (
        "converged-self",
        "converged-self",
        "The reference is a finer run of this program. It shows convergence, not that the equations are right.",
    ),
    ("other-code", "other-code", "The reference was computed by an independent program."),
    ("experiment", "experiment", "The reference was measured."),
    (
        "order",
        "order",
        "The power with which the error falls as cells or steps are refined. It is fitted to the finest three levels above the floor. In figures a triangle shows the expected slope: 1 along, the order upwards.",
    ),
    (
        "floor",
        "floor",
        "The level below which an error cannot fall by the refinement in question, such as rounding or the error of the mesh while steps are refined.",
    ),
    (
        "capability",
        "capability",
        "A part of the program that evidence may cover: a row of the coverage matrix.",
    ),
    ("quick", "quick, full", "Quick cases run within seconds, on every change. The others run with --full."),
    (
        "work",
        "work",
        "What a result costs in counts that no machine changes: steps, factorisations, solutions, evaluations.",
    ),
    ("wall", "wall time", "Time by the clock. It depends on the machine and on what else runs there."),
    (
        "defect",
        "planted defect",
        "A plausible mistake that is made on purpose in a copy of the sources. A claim should then disagree; a defect that no claim detects shows what the suite does not test.",
    ),
    (
        "margin",
        "margin",
        "Error over bound of a claim that detects a planted defect: how clearly it is detected.",
    ),
];

/// Page of the glossary.
pub fn whole(run: &Provenance) -> String {
    let entries: String = WORDS
        .iter()
        .map(|(anchor, word, meaning)| {
            format!("<dt id=\"{anchor}\">{}</dt><dd>{}</dd>\n", escape(word), escape(meaning))
        })
        .collect();
    let body = format!("<h1>Words</h1>\n<dl class=\"words\">\n{entries}</dl>\n");
    page("Words", Depth::Top, run, &body)
}
