//! The first page: the outcome and the cases by subject, with a filter and a search.

use super::history::Release;
use super::page::{Depth, escape, number, page, time, word};
use super::provenance::Provenance;
use super::subjects::{self, Subject};
use super::{claims, ids};
use crate::case::Outcome;
use crate::claim::{JudgedClaim, Mark, Verdict};
use crate::suite::Summary;
use serde_json::json;

/// The page.
pub fn whole(outcomes: &[Outcome], releases: &[Release], run: &Provenance) -> String {
    let summary = Summary::from_outcomes(outcomes);
    let subjects = subjects::all();
    let mut body = String::from("<h1>asperity: verification</h1>\n");
    body += &claims::summary(&summary, Depth::Top);
    body += &format!(
        "<p>Each {} compares a quantity of a run with a reference, within a {} set before the run. {}</p>\n",
        word("claim", "claim", Depth::Top),
        word("bound", "bound", Depth::Top),
        since(outcomes, releases),
    );
    body += &controls(&subjects);
    for subject in &subjects {
        body += &group(subject, outcomes);
    }
    let other = |outcome: &&Outcome| subjects::subject(&subjects, outcome.case.name) == "Other";
    let others: Vec<String> = outcomes.iter().filter(other).map(|o| o.case.name.to_owned()).collect();
    body += &group(&Subject { title: "Other".to_owned(), names: others }, outcomes);
    body += &format!("<script type=\"application/json\" id=\"claims\">{}</script>\n", searched(outcomes));
    page("asperity: verification", Depth::Top, run, &body)
}

/// Changes since the last release, in a sentence.
fn since(outcomes: &[Outcome], releases: &[Release]) -> String {
    let Some(last) = releases.last() else { return String::new() };
    let changes = super::history::changes(last, outcomes);
    format!(
        "Since {}: <a href=\"history.html#bounds\">{} bounds changed</a>, {} claims are new, {} are gone.",
        escape(&last.tag),
        changes.bounds.len(),
        changes.new,
        changes.gone.len()
    )
}

/// Filter and search; shown by a script, since they need it to work.
fn controls(subjects: &[Subject]) -> String {
    let options: String = subjects
        .iter()
        .map(|s| format!("<option value=\"{0}\">{1}</option>", ids::slug(&s.title), escape(&s.title)))
        .collect();
    format!(
        "<form id=\"controls\" hidden>\n\
         <label>Search <input type=\"search\" id=\"search\" placeholder=\"cases and claims\"></label>\n\
         <label>Subject <select id=\"subject\"><option value=\"\">all</option>{options}</select></label>\n\
         <label>Show <select id=\"state\"><option value=\"\">all cases</option>\
         <option value=\"disagrees\">with disagreements</option>\
         <option value=\"near\">with claims near their tolerance</option>\
         <option value=\"loose\">with loose tolerances without a reason</option>\
         <option value=\"order\">with claims of order</option>\
         <option value=\"long\">long cases</option></select></label>\n</form>\n\
         <div id=\"found\" hidden><h2>Claims found</h2><ul></ul></div>\n"
    )
}

fn group(subject: &Subject, outcomes: &[Outcome]) -> String {
    let find = |name: &String| outcomes.iter().find(|outcome| outcome.case.name == name);
    let cases: Vec<&Outcome> = subject.names.iter().filter_map(find).collect();
    if cases.is_empty() {
        return String::new();
    }
    let rows: String = cases.into_iter().map(row).collect();
    let id = ids::slug(&subject.title);
    format!(
        "<section class=\"subject\" data-subject=\"{id}\">\n<h2 id=\"{id}\">{}</h2>\n<ul class=\"cases\">\n\
         <li class=\"head\"><span>case</span><span>claims</span><span>largest error / bound</span>\
         <span>wall time</span></li>\n{rows}</ul></section>\n",
        escape(&subject.title)
    )
}

fn row(outcome: &Outcome) -> String {
    let claims = &outcome.record.claims;
    let summary = Summary::from_claims(claims);
    let state = if summary.disagree > 0 {
        format!("<b class=\"bad\">{} disagree</b>", summary.disagree)
    } else {
        format!("<span class=\"good\">{} hold</span>", summary.hold)
    };
    format!(
        "<li data-states=\"{}\" data-text=\"{}\"><span><a href=\"cases/{name}.html\"><b>{name}</b></a><br>{}</span>\
         <span>{state}</span><span title=\"largest error / bound\">{}</span><span>{}</span></li>\n",
        states(outcome, &summary),
        escape(&format!("{} {}", outcome.case.name, outcome.case.title()).to_lowercase()),
        escape(outcome.case.title()),
        worst(claims).map_or("–".to_owned(), number),
        time(outcome.wall),
        name = outcome.case.name,
    )
}

/// Words used by the filter.
fn states(outcome: &Outcome, summary: &Summary) -> String {
    let orders = outcome.record.claims.iter().any(|j| matches!(j.claim.test, crate::claim::Test::Order(_)));
    let states = [
        ("disagrees", summary.disagree > 0),
        ("near", summary.thin > 0),
        ("loose", summary.slack_unexplained > 0),
        ("order", orders),
        ("long", !outcome.case.quick),
    ];
    states.iter().filter(|(_, is)| *is).map(|(name, _)| *name).collect::<Vec<_>>().join(" ")
}

fn worst(claims: &[JudgedClaim]) -> Option<f64> {
    claims.iter().filter_map(|judged| judged.measured.map(|m| m.ratio)).max_by(f64::total_cmp)
}

/// Claims as the search needs them: case, name, quantity, state.
fn searched(outcomes: &[Outcome]) -> String {
    let mut found = Vec::new();
    for outcome in outcomes {
        let claims = &outcome.record.claims;
        for (judged, id) in claims.iter().zip(ids::unique(claims)) {
            let state = match (&judged.verdict, judged.mark) {
                (Verdict::Disagrees, _) => "disagrees",
                (_, Some(Mark::Thin)) => "near",
                (_, Some(Mark::SlackUnexplained)) => "loose",
                _ => "",
            };
            found.push(json!([outcome.case.name, id, judged.claim.quantity, state]));
        }
    }
    // `</` would end the script; JSON reads the escape as the same character.
    json!(found).to_string().split("</").collect::<Vec<_>>().join("<\\/")
}
