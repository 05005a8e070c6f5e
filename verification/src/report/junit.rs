//! Claims as JUnit XML for continuous integration.

use super::page::escape;
use crate::case::Outcome;
use crate::claim::{JudgedClaim, Verdict};
use crate::suite::Summary;
use std::fmt::Write as _;

/// The document.
pub fn document(outcomes: &[Outcome]) -> String {
    let summary = Summary::from_outcomes(outcomes);
    let wall: f64 = outcomes.iter().map(|outcome| outcome.wall).sum();
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"asperity verification\" {}>\n",
        counts(&summary, wall)
    );
    for outcome in outcomes {
        let claims = &outcome.record.claims;
        let name = outcome.case.name;
        let counts = counts(&Summary::from_claims(claims), outcome.wall);
        let _ = writeln!(out, "  <testsuite name=\"{name}\" {counts}>");
        claims.iter().for_each(|judged| out += &one(name, judged));
        out += "  </testsuite>\n";
    }
    out + "</testsuites>\n"
}

fn counts(summary: &Summary, wall: f64) -> String {
    let tests = summary.hold + summary.disagree + summary.not_covered;
    format!(
        "tests=\"{tests}\" failures=\"{}\" errors=\"0\" skipped=\"{}\" time=\"{wall:.3}\"",
        summary.disagree, summary.not_covered
    )
}

fn one(case: &str, judged: &JudgedClaim) -> String {
    let wall = judged.claim.cost.wall.unwrap_or(0.0);
    let head = format!(
        "    <testcase classname=\"{case}\" name=\"{}\" time=\"{wall:.3}\"",
        escape(&judged.claim.quantity)
    );
    match &judged.verdict {
        Verdict::Holds => format!("{head}/>\n"),
        Verdict::Disagrees => {
            let problem = escape(judged.problem.as_deref().unwrap_or(""));
            let size = judged
                .measured
                .map_or(String::new(), |m| format!("error {:e}, bound {:e}", m.error, m.bound));
            format!("{head}>\n      <failure message=\"{problem}\">{size}</failure>\n    </testcase>\n")
        }
        Verdict::NotCovered(reason) => {
            format!("{head}>\n      <skipped message=\"{}\"/>\n    </testcase>\n", escape(reason))
        }
    }
}
