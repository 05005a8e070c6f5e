//! Checks that the harness judges as documented: every kind of claim has a control that must fail.
#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_verification::case::Outcome;
use asperity_verification::claim::{CONTROL_BOUNDS, JudgedClaim, Mark};
use asperity_verification::ledger::{Draft, OrderDraft};
use asperity_verification::pool::{self, Limits};
use asperity_verification::report::{self, coverage, json, junit, page, provenance::Provenance};
use asperity_verification::suite::{Selection, SelectionError, Summary};
use asperity_verification::supervise::{LostCase, State, supervise};
use asperity_verification::{
    Capability, Case, CaseError, Cost, Evidence, Floor, Ledger, Plot, Series, Verdict,
};
use std::path::Path;

fn judge(write: impl FnOnce(Draft<'_>) -> Draft<'_>) -> JudgedClaim {
    let mut ledger = Ledger::new(&[Capability::PlaneStrain]);
    let draft = ledger.claim("q").evidence(Evidence::Exact, "formula").because("rounding");
    write(draft).record();
    ledger.claims()[0].clone()
}

fn judge_order(write: impl FnOnce(OrderDraft<'_>) -> OrderDraft<'_>) -> (JudgedClaim, JudgedClaim) {
    let mut ledger = Ledger::new(&[]);
    let draft = ledger.order("q").evidence(Evidence::Exact, "formula").because("theory");
    write(draft).record();
    (ledger.claims()[0].clone(), ledger.claims()[1].clone())
}

fn second_order(draft: OrderDraft<'_>) -> OrderDraft<'_> {
    draft
        .levels(&[(0.4, 0.16), (0.2, 0.04), (0.1, 0.01)])
        .expected(2.0)
        .within(0.1)
        .finest(0.02, "twice the estimate")
}

/// One claim of each kind that holds.
fn holding() -> Vec<(&'static str, JudgedClaim)> {
    vec![
        ("absolute", judge(|d| d.value(1.05).equals(1.0).absolute(0.1))),
        ("absolute, below", judge(|d| d.value(0.95).equals(1.0).absolute(0.1))),
        ("absolute, many", judge(|d| d.values(&[1.05, -2.0]).equals_each(&[1.0, -2.0]).absolute(0.1))),
        (
            "rms",
            judge(|d| d.values(&[1.05, -2.0]).equals_each(&[1.0, -2.0]).absolute(0.1).root_mean_square()),
        ),
        ("relative", judge(|d| d.value(-10.5).equals(-10.0).relative(0.1))),
        ("relative, many", judge(|d| d.values(&[10.5, 0.0]).equals_each(&[10.0, 0.0]).relative(0.1))),
        ("at most", judge(|d| d.value(0.5).at_most(1.0))),
        ("at least", judge(|d| d.value(2.0).at_least(1.0))),
        ("count", judge(|d| d.count(7, 7))),
        ("order", judge_order(|d| second_order(d).within(0.1)).0),
        ("order or better", judge_order(|d| second_order(d).expected(1.5).or_better()).0),
    ]
}

#[test]
fn a_claim_within_its_bound_holds_and_three_bounds_off_disagrees() {
    for (kind, judged) in holding() {
        assert_eq!(judged.verdict, Verdict::Holds, "{kind}: {:?}", judged.problem);
        let mut moved = judged.claim.clone();
        moved.test = judged.claim.test.perturbed(CONTROL_BOUNDS).unwrap();
        assert_eq!(moved.judge().verdict, Verdict::Disagrees, "{kind}");
    }
}

#[test]
fn errors_are_measured_in_the_unit_of_their_bound() {
    let measured =
        judge(|d| d.values(&[10.5, 3.0]).equals_each(&[10.0, 3.0]).relative(0.1)).measured.unwrap();
    assert!((measured.error - 0.05).abs() < 1e-15 && (measured.ratio - 0.5).abs() < 1e-14);
    let rms = judge(|d| d.values(&[3.0, 4.0]).equals_each(&[0.0, 0.0]).absolute(9.0).root_mean_square());
    assert!((rms.measured.unwrap().error - 12.5_f64.sqrt()).abs() < 1e-15);
    assert_eq!(judge(|d| d.value(-3.0).at_most(1.0)).measured.unwrap().ratio, 0.0);
}

#[test]
fn what_is_not_a_number_disagrees() {
    for judged in [
        judge(|d| d.value(f64::NAN).equals(1.0).absolute(0.1)),
        judge(|d| d.values(&[f64::NAN, 1.0]).equals_each(&[1.0, 1.0]).absolute(0.1)),
        judge(|d| d.value(1.0).equals(f64::NAN).absolute(0.1)),
        judge(|d| d.value(1.0).equals(f64::INFINITY).relative(0.1)),
        judge(|d| d.value(f64::NAN).at_most(1.0)),
        judge(|d| d.value(f64::NAN).at_least(1.0)),
        judge(|d| d.value(f64::INFINITY).at_least(1.0)),
        judge(|d| d.value(1.0).equals(1.0).absolute(f64::NAN)),
        judge(|d| d.value(1.0).equals(1.0).absolute(f64::INFINITY)),
        judge(|d| d.value(1.0).equals(1.0).absolute(0.0)),
        judge_order(|d| second_order(d).levels(&[(0.4, 0.16), (0.2, f64::NAN), (0.1, 0.01)])).0,
        judge_order(|d| second_order(d).levels(&[(0.4, 0.16), (0.2, 0.04), (0.1, f64::NAN)])).1,
    ] {
        assert_eq!(judged.verdict, Verdict::Disagrees, "{:?}", judged.claim.test);
        assert!(judged.problem.is_some());
    }
}

#[test]
fn a_claim_that_says_too_little_disagrees() {
    let mut ledger = Ledger::new(&[]);
    ledger.claim("no evidence").value(1.0).equals(1.0).absolute(0.1).because("x").record();
    ledger
        .claim("no source")
        .value(1.0)
        .equals(1.0)
        .absolute(0.1)
        .because("x")
        .evidence(Evidence::Exact, " ")
        .record();
    ledger.claim("no reason").value(1.0).equals(1.0).absolute(0.1).evidence(Evidence::Exact, "x").record();
    let full = |ledger: &mut Ledger, write: fn(Draft<'_>) -> Draft<'_>| {
        write(ledger.claim("q").evidence(Evidence::Exact, "x").because("x")).record();
    };
    full(&mut ledger, |d| d.value(1.0).equals(1.0));
    full(&mut ledger, |d| d.equals(1.0).absolute(0.1));
    full(&mut ledger, |d| d.values(&[1.0, 2.0]).equals(1.0).absolute(0.1));
    full(&mut ledger, |d| d.values(&[0.5, 0.5]).at_most(1.0));
    full(&mut ledger, |d| d.value(0.0).equals(0.0).relative(0.1));
    full(&mut ledger, |d| d.value(1.0).equals(1.0).absolute(0.1).uncertainty(0.2));
    full(&mut ledger, |d| d.value(1.0).equals(1.0).absolute(0.1).uncertainty(f64::NAN));
    for judged in ledger.claims() {
        assert_eq!(judged.verdict, Verdict::Disagrees, "{}", judged.claim.quantity);
    }
}

#[test]
fn a_bound_below_the_rounding_of_its_value_is_caught_by_the_control() {
    let judged = judge(|d| d.value(1.0e20).equals(1.0e20).absolute(1.0));
    assert_eq!(judged.verdict, Verdict::Disagrees);
    assert!(judged.problem.unwrap().starts_with("negative control"));
}

#[test]
fn a_claim_that_two_settings_agree_disagrees_where_they_are_one() {
    let judged = |one, other| judge(|d| d.value(1.05).equals(1.0).absolute(0.1).between(one, other));
    assert_eq!(judged("condensed", "full").verdict, Verdict::Holds);
    let alone = judged("full", "full");
    assert_eq!(alone.verdict, Verdict::Disagrees);
    assert!(alone.problem.unwrap().contains("the two settings that are to agree are the same"));
}

#[test]
fn slack_asks_for_a_reason_and_thin_is_marked() {
    assert_eq!(judge(|d| d.value(1.005).equals(1.0).absolute(0.1)).mark, Some(Mark::SlackUnexplained));
    let explained =
        judge(|d| d.value(1.005).equals(1.0).absolute(0.1).why_not_tighter("the reference's digits"));
    assert_eq!(explained.mark, Some(Mark::Slack));
    assert_eq!(judge(|d| d.value(1.05).equals(1.0).absolute(0.1)).mark, None);
    assert_eq!(judge(|d| d.value(1.09).equals(1.0).absolute(0.1)).mark, Some(Mark::Thin));
    assert_eq!(judge(|d| d.count(7, 7)).mark, None);
}

#[test]
fn a_wrong_order_disagrees_and_a_better_one_only_when_it_may() {
    let first = [(0.4, 0.4), (0.2, 0.2), (0.1, 0.1)];
    assert_eq!(judge_order(|d| second_order(d).levels(&first)).0.verdict, Verdict::Disagrees);
    assert_eq!(judge_order(|d| second_order(d).expected(1.0)).0.verdict, Verdict::Disagrees);
    assert_eq!(judge_order(|d| second_order(d).expected(1.0).or_better()).0.verdict, Verdict::Holds);
}

#[test]
fn levels_on_the_plateau_say_nothing_about_the_order() {
    let levels = [(0.8, 0.64), (0.4, 0.16), (0.2, 0.04), (0.1, 0.012), (0.05, 0.011)];
    assert_eq!(judge_order(|d| second_order(d).levels(&levels)).0.verdict, Verdict::Disagrees);
    let floored = |level| judge_order(move |d| second_order(d).levels(&levels).floor(Floor::Space, level)).0;
    assert_eq!(floored(0.013).verdict, Verdict::Holds);
    assert_eq!(floored(0.5).verdict, Verdict::Disagrees, "one level above the plateau is no order");
}

#[test]
fn an_order_needs_three_refining_levels_and_an_absolute_error() {
    for levels in [
        &[(0.2, 0.04), (0.1, 0.01)][..],
        &[(0.1, 0.01), (0.2, 0.04), (0.4, 0.16)],
        &[(0.4, 0.1), (0.2, 0.0), (0.1, 0.0)],
    ] {
        assert_eq!(
            judge_order(|d| second_order(d).levels(levels)).0.verdict,
            Verdict::Disagrees,
            "{levels:?}"
        );
    }
    let (order, finest) = judge_order(second_order);
    assert_eq!((order.verdict, finest.verdict), (Verdict::Holds, Verdict::Holds));
    assert_eq!(judge_order(|d| second_order(d).finest(0.005, "x")).1.verdict, Verdict::Disagrees);
    let mut ledger = Ledger::new(&[]);
    let draft = ledger.order("q").evidence(Evidence::Exact, "x").because("x");
    draft.levels(&[(0.4, 0.16), (0.2, 0.04), (0.1, 0.01)]).expected(2.0).within(0.1).record();
    assert_eq!(ledger.claims()[1].verdict, Verdict::Disagrees, "no bound on the finest level");
}

const README: &str = "# A <case>\n\n## Problem\nText & more.\n";

fn case(run: fn(&mut Ledger) -> Result<(), CaseError>) -> Case {
    Case { name: "synthetic", readme: README, covers: &[Capability::Scenes], quick: true, run }
}

fn good(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (value, cost) = Cost::measure(|| 1.05);
    let cost = cost.count("solves", 3).counts(&serde_json::json!({ "steps": 4, "rejected": 0, "name": "x" }));
    let draft =
        ledger.claim("first <quantity>").unit("MPa").value(value).equals(1.0).absolute(0.1).cost(&cost);
    draft.evidence(Evidence::Exact, "formula").because("rounding").norm("largest").record();
    let values = [1.05; 6];
    let draft = ledger.claim("many").values(&values).equals_each(&[1.0; 6]).relative(0.1);
    draft.evidence(Evidence::OtherCode, "code").because("its digits").covers(&[Capability::Outputs]).record();
    second_order(ledger.order("q").evidence(Evidence::ConvergedSelf, "finer").because("theory"))
        .floor(Floor::Rounding, 1e-14)
        .record();
    ledger.not_covered("thermal stress", "nobody asks for it");
    let series = Series::marked("implicit", &[(0.1, 1.0), (0.01, 10.0), (0.0, 20.0)])
        .failed(0.001, "diverged & stopped");
    ledger.plot(Plot::work_precision("Work", "error [µm]", "solves").series(series).caption("A caption."));
    ledger.plot(Plot::xy("Flat", "x", "y").series(Series::line("", &[(0.0, 2.0), (1.0, 2.0)])));
    ledger.table("A table", &["h", "value"], [[String::from("1"), String::from("<2>")]]);
    ledger.note("A note.");
    Ok(())
}

fn only_claim(outcome: &Outcome) -> &JudgedClaim {
    assert_eq!(outcome.record.claims.len(), 1);
    &outcome.record.claims[0]
}

#[test]
fn a_case_that_fails_panics_or_says_nothing_disagrees() {
    let failing = case(|_| Err("no such scene".into())).execute();
    assert_eq!(only_claim(&failing).problem.as_deref(), Some("no such scene"));
    let silent = case(|_| Ok(())).execute();
    assert_eq!(only_claim(&silent).verdict, Verdict::Disagrees);
    let panicking = case(|_| panic!("index {}", 3)).execute();
    assert_eq!(only_claim(&panicking).problem.as_deref(), Some("panicked: index 3"));
    assert!(!Summary::from_outcomes(&[failing, silent, panicking]).passes());
}

#[test]
fn a_case_that_fails_late_keeps_what_it_claimed() {
    let outcome = case(|ledger| {
        good(ledger)?;
        Err("later".into())
    })
    .execute();
    let summary = Summary::from_claims(&outcome.record.claims);
    assert_eq!((summary.hold, summary.disagree, summary.not_covered), (4, 1, 1));
}

#[test]
fn the_last_line_counts_claims() {
    let summary = Summary::from_outcomes(&[case(good).execute()]);
    assert_eq!(summary.to_string(), "claims: 4 hold, 0 disagree, 1 not covered");
    assert!(summary.passes());
    assert!(!Summary::default().passes(), "no claim is no success");
}

#[test]
fn an_empty_selection_is_an_error() {
    let long = Case { quick: false, ..case(good) };
    let choose = |glob: &str, full, cases: &[Case]| {
        Selection { full, glob: Some(glob.to_owned()) }.select(cases).map(|chosen| chosen.len())
    };
    assert_eq!(choose("*", false, &[]), Err(SelectionError::NoCases));
    assert!(matches!(choose("x*", true, &[long]), Err(SelectionError::NoMatch { .. })));
    assert!(matches!(choose("syn*", false, &[long]), Err(SelectionError::OnlyLong { .. })));
    assert_eq!(choose("syn*", true, &[long]), Ok(1));
    assert_eq!(choose("syn*", false, &[case(good), long]), Ok(1));
}

#[test]
fn the_report_keeps_machine_dependent_values_under_run() {
    let report = |machine: &str, wall| {
        let outcome = Outcome { wall, ..case(good).execute() };
        let run = Provenance { machine: machine.to_owned(), ..Provenance::default() };
        serde_json::to_value(json::report(&[outcome], &run)).unwrap()
    };
    let (mut a, mut b) = (report("one", 1.0), report("other", 2.0));
    assert_ne!(a["run"], b["run"]);
    assert_eq!(a["run"]["walls"]["synthetic"]["case"], 1.0);
    assert!(a["run"]["walls"]["synthetic"]["claims"][0].is_f64());
    assert_eq!(
        a["cases"][0]["claims"][0]["cost"]["work"],
        serde_json::json!({ "solves": 3.0, "steps": 4.0 })
    );
    assert_eq!(a["cases"][0]["claims"][0]["test"]["kind"], "absolute");
    for value in [&mut a, &mut b] {
        value.as_object_mut().unwrap().remove("run");
    }
    assert_eq!(a, b);
}

#[test]
fn the_format_of_the_report_changes_only_on_purpose() {
    let report = serde_json::to_value(json::report(&[case(good).execute()], &Provenance::default()));
    let mut report = report.unwrap();
    report.as_object_mut().unwrap().remove("run");
    round(&mut report);
    insta::assert_json_snapshot!(report);
}

/// Rounds every number to nine decimals: logarithms differ in their last bits between systems.
fn round(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Object(fields) => fields.values_mut().for_each(round),
        serde_json::Value::Array(items) => items.iter_mut().for_each(round),
        serde_json::Value::Number(n) if n.is_f64() => {
            *value = serde_json::json!((n.as_f64().unwrap() * 1e9).round() / 1e9);
        }
        _ => {}
    }
}

/// Folder of the report of a synthetic case, removed when dropped.
struct ReportFolder(std::path::PathBuf);

impl ReportFolder {
    fn new(name: &str) -> ReportFolder {
        let folder = std::env::temp_dir().join(format!("asperity-harness-{name}-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("cases")).unwrap();
        std::fs::write(folder.join("cases/old.html"), "old").unwrap();
        report::write(&folder, &[case(good).execute()], &Provenance::gather(false, false, 1.0)).unwrap();
        ReportFolder(folder)
    }

    fn text(&self, file: &str) -> String {
        std::fs::read_to_string(self.0.join(file)).unwrap()
    }
}

impl Drop for ReportFolder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

const PAGES: [&str; 9] = [
    "index.html",
    "coverage.html",
    "precision.html",
    "defects.html",
    "history.html",
    "tests.html",
    "words.html",
    "cases/synthetic.html",
    "sources/synthetic.html",
];

#[test]
fn pages_show_claims_and_escape_text() {
    let written = ReportFolder::new("texts");
    let index = written.text("index.html");
    assert!(index.contains("claims: 4 hold, 0 disagree, 1 not covered") && index.contains("A &lt;case&gt;"));
    let page = written.text("cases/synthetic.html");
    for text in [
        "first &lt;quantity&gt;",
        "<h2>Problem</h2>",
        "diverged &amp; stopped",
        "&lt;2&gt;",
        "1 points cannot",
        "</svg>",
        "id=\"first-quantity\"",
        "href=\"#first-quantity\"",
        "Observed 2 over the finest 3 levels",
        "Cost to reach an error of 1, 0.1, 0.01 %",
    ] {
        assert!(page.contains(text), "{text}");
    }
}

#[test]
fn pages_need_no_network() {
    let written = ReportFolder::new("network");
    for file in PAGES {
        let page = written.text(file);
        for name in ["http://www.w3.org/2000/svg", "http://www.w3.org/1998/Math/MathML"] {
            // These are names of formats, which are never fetched.
            assert!(!page.contains(&format!("href=\"{name}")) && !page.contains(&format!("src=\"{name}")));
        }
        for outside in ["src=\"http", "href=\"http", "@import", "url(", "fetch("] {
            assert!(!page.contains(outside), "{file}: {outside}");
        }
    }
}

#[test]
fn every_page_is_stamped() {
    let written = ReportFolder::new("stamp");
    for file in PAGES {
        let page = written.text(file);
        for fact in ["command", "machine", "compiler", "threads", "date"] {
            assert!(page.contains(&format!("<dt>{fact}</dt>")), "{file}: {fact}");
        }
    }
}

#[test]
fn links_between_pages_lead_to_files_and_anchors() {
    let written = ReportFolder::new("links");
    for file in PAGES {
        let page = written.text(file);
        let folder = Path::new(file).parent().unwrap();
        for target in page.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
            let to = if path.is_empty() { Path::new(file).to_owned() } else { folder.join(path) };
            // Cases that did not run in this test have no page, although the pages of defects and history link to them.
            if target.starts_with("data:") || (path.contains("cases/") && !path.contains("synthetic")) {
                continue;
            }
            let text =
                std::fs::read_to_string(written.0.join(&to)).unwrap_or_else(|_| panic!("{file}: {target}"));
            assert!(anchor.is_empty() || text.contains(&format!("id=\"{anchor}\"")), "{file}: {target}");
        }
    }
}

#[test]
fn capabilities_without_a_claim_or_a_test_have_no_evidence() {
    let outcomes = [case(good).execute()];
    let page = coverage::whole(&outcomes, (&[], &[]), &Provenance::default());
    assert_eq!(
        page.matches(">no evidence<").count(),
        Capability::ALL.len() - 2,
        "scenes and outputs have some"
    );
}

#[test]
fn junit_counts_claims_and_tells_why_they_fail() {
    let bad = case(|ledger| {
        ledger.claim("x < y").value(2.0).at_most(1.0).record();
        Ok(())
    });
    let text = junit::document(&[case(good).execute(), bad.execute()]);
    assert!(text.contains("<testsuites name=\"asperity verification\" tests=\"6\" failures=\"1\""), "{text}");
    assert!(text.contains("name=\"x &lt; y\""));
    assert!(text.contains("<failure message=\"the error exceeds the bound\">"), "{text}");
    assert!(text.contains("<skipped message=\"nobody asks for it\"/>"));
}

#[test]
fn the_schema_of_the_report_is_published_and_the_report_has_its_keys() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src/verification.schema.json");
    let schema = json::schema();
    let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    assert!(
        std::fs::read_to_string(&path).is_ok_and(|kept| kept == text),
        "the schema is stale: run the test with UPDATE_SCHEMA=1"
    );
    let outcomes = [case(good).execute()];
    let run = Provenance::default();
    let report = serde_json::to_value(json::report(&outcomes, &run)).unwrap();
    let missing = unknown(&report, &schema, &schema);
    assert_eq!(missing, Vec::<String>::new());
}

/// Keys of a value that are not in its schema.
fn unknown(value: &serde_json::Value, schema: &serde_json::Value, root: &serde_json::Value) -> Vec<String> {
    let mut named = std::collections::BTreeMap::new();
    let mut open = Vec::new();
    properties(schema, root, &mut named, &mut open);
    let items = |value: &serde_json::Value| value.as_array().cloned().unwrap_or_default();
    let mut found = Vec::new();
    match value {
        serde_json::Value::Object(fields) => {
            for (key, value) in fields {
                match named.get(key).or(open.first()) {
                    Some(schema) => found.extend(unknown(value, schema, root)),
                    None => found.push(key.clone()),
                }
            }
        }
        serde_json::Value::Array(_) => {
            for item in items(value) {
                found.extend(unknown(
                    &item,
                    resolved(schema, root).get("items").unwrap_or(&serde_json::json!({})),
                    root,
                ));
            }
        }
        _ => {}
    }
    found
}

fn resolved<'a>(schema: &'a serde_json::Value, root: &'a serde_json::Value) -> &'a serde_json::Value {
    match schema.get("$ref").and_then(|path| path.as_str()) {
        Some(path) => root.pointer(path.trim_start_matches('#')).unwrap(),
        None => schema,
    }
}

/// Keys that a schema names in any of its alternatives, and the schemas of additional keys.
fn properties<'a>(
    schema: &'a serde_json::Value,
    root: &'a serde_json::Value,
    named: &mut std::collections::BTreeMap<String, &'a serde_json::Value>,
    open: &mut Vec<&'a serde_json::Value>,
) {
    let schema = resolved(schema, root);
    for (key, value) in schema.get("properties").and_then(|p| p.as_object()).into_iter().flatten() {
        named.insert(key.clone(), value);
    }
    open.extend(schema.get("additionalProperties").filter(|value| value.is_object()));
    for list in ["allOf", "anyOf", "oneOf"] {
        for part in schema.get(list).and_then(|l| l.as_array()).into_iter().flatten() {
            properties(part, root, named, open);
        }
    }
}

#[test]
fn numbers_are_printed_with_four_digits() {
    for (value, text) in [
        (0.0, "0"),
        (1.0, "1"),
        (0.012346, "0.01235"),
        (12345.6, "12346"),
        (100.0, "100"),
        (1.5e-7, "1.500e-7"),
    ] {
        assert_eq!(page::number(value), text);
    }
}

#[test]
fn a_report_replaces_the_pages_of_an_earlier_one() {
    let written = ReportFolder::new("replaces");
    assert!(!written.0.join("cases/old.html").exists());
    for file in PAGES.into_iter().chain(["report.json", "cases/synthetic.json"]) {
        assert!(written.text(file).len() > 100, "{file}");
    }
}

fn execute(cases: &[&Case], jobs: usize, limits: &Limits, done: impl FnMut(&Outcome)) -> Vec<Outcome> {
    pool::execute(cases, jobs.try_into().unwrap(), limits, |_| Ok(()), done).unwrap()
}

#[test]
fn cases_at_a_time_end_in_the_order_of_the_list() {
    fn slow(ledger: &mut Ledger) -> Result<(), CaseError> {
        std::thread::sleep(std::time::Duration::from_millis(30));
        good(ledger)
    }
    let named = |name: &'static str, run| Case { name, ..case(run) };
    let cases = [named("a", slow), named("b", good), named("c", slow), named("d", good), named("e", good)];
    let cases: Vec<&Case> = cases.iter().collect();
    for jobs in [1, 2, 9] {
        let mut seen = Vec::new();
        let outcomes = execute(&cases, jobs, &Limits::default(), |outcome| seen.push(outcome.case.name));
        assert_eq!(seen, ["a", "b", "c", "d", "e"]);
        assert!(outcomes.iter().map(|outcome| outcome.case.name).eq(seen));
    }
}

#[test]
fn a_case_that_hangs_disagrees_by_its_name_and_the_others_run() {
    fn hangs(_: &mut Ledger) -> Result<(), CaseError> {
        loop {
            std::thread::sleep(std::time::Duration::from_secs(1));
        }
    }
    let named = |name: &'static str, run| Case { name, ..case(run) };
    let cases = [named("a", good), named("b", hangs), named("c", good)];
    let cases: Vec<&Case> = cases.iter().collect();
    // A hundredth of a second on record makes a limit of a tenth.
    let limits = Limits { recorded: [("b".to_owned(), 0.01)].into(), shortest: 0.0 };
    for jobs in [1, 2] {
        let outcomes = execute(&cases, jobs, &limits, |_| ());
        let disagree: Vec<usize> =
            outcomes.iter().map(|outcome| Summary::from_claims(&outcome.record.claims).disagree).collect();
        assert_eq!(disagree, [0, 1, 0]);
        let problem = only_claim(&outcomes[1]).problem.as_deref().unwrap();
        assert!(problem.contains("10 times its recorded time"), "{problem}");
    }
}

#[test]
fn limits_follow_the_pace_of_the_run_and_the_longest_case_where_there_is_no_record() {
    let limits = Limits { recorded: [("a".to_owned(), 30.0), ("b".to_owned(), 2.0)].into(), shortest: 6.0 };
    assert_eq!(limits.limit("a", 1.0), Some(300.0));
    assert_eq!(limits.limit("b", 1.5), Some(90.0));
    assert_eq!(limits.limit("new", 1.0), Some(300.0));
    assert_eq!(Limits::default().limit("a", 1.0), None);
    let ended = |wall| Outcome { wall, ..Case { name: "b", ..case(good) }.execute() };
    assert_eq!(limits.pace([&ended(5.0)]), 2.5);
    assert_eq!(limits.pace([&ended(1.0)]), 1.0);
}

/// A process that says it runs `cases` and is then killed, unless `lost` cases are named in its file.
fn killed(state: &Path, running: &str) -> std::process::Command {
    let script = r#"if grep -q '"case"' "$1"; then sed -i 's/"ended":false/"ended":true/' "$1"
        else sed -i "s/\"running\":\[\]/\"running\":$2/" "$1"; kill -KILL $$; fi"#;
    let mut process = std::process::Command::new("sh");
    process.arg("-c").arg(script).arg("sh").arg(state).arg(running);
    process
}

#[test]
fn a_case_that_ends_its_process_is_left_out_and_named() {
    let folder = ReportFolder::new("crash");
    let state = folder.0.join("state.json");
    let alone = |_: &str| std::process::Command::new("true");
    let end = supervise(&state, || killed(&state, r#"["a"]"#), alone).unwrap();
    assert!(end.success());
    let State { lost, ended, .. } = State::read(&state).unwrap();
    let how = "the process ended: signal: 9 (SIGKILL)".to_owned();
    assert_eq!((lost, ended), (vec![LostCase { case: "a".into(), how: how.clone() }], true));

    // Of two that ran side by side, the one that also ends a process of its own.
    let alone = |case: &str| match case {
        "b" => killed(&state, r#"["b"]"#),
        _ => {
            let mut ends = std::process::Command::new("sed");
            ends.args(["-i", r#"s/"ended":false/"ended":true/"#]).arg(&state);
            ends
        }
    };
    supervise(&state, || killed(&state, r#"["a","b"]"#), alone).unwrap();
    assert_eq!(State::read(&state).unwrap().lost, [LostCase { case: "b".into(), how }]);
}
