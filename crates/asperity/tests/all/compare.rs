//! Results of other programs judged against benchmarks: `asperity compare`.
#![allow(clippy::disallowed_methods)]

use asperity_reference::benchmark::{self, Judgement, Reference, Submission, Verdict};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The entry of the independent program, which shares no code with this one.
const INDEPENDENT: &str = include_str!("../../../../docs/src/benchmarks/sandwich/v1/results/scikit-fem.csv");

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/benchmarks").join(name)
}

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

/// Exit code, standard output and standard error of a comparison of a text with sandwich/v1.
fn compared(text: impl AsRef<[u8]>) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("r.csv"), text).unwrap();
    let arguments = ["compare", "r.csv", "--benchmark", "sandwich/v1", "--no-plots"];
    let output = asperity(folder.path(), &arguments);
    let read = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), read(&output.stdout), read(&output.stderr))
}

/// The independent result with the values of one quantity changed.
fn changed(quantity: &str, change: impl Fn(f64) -> Option<f64>) -> String {
    let line = |line: &str| match line.rsplit_once(',') {
        Some((head, value)) if head.starts_with(&format!("{quantity},")) => {
            change(value.parse().unwrap()).map(|value| format!("{head},{value}\n"))
        }
        _ => Some(format!("{line}\n")),
    };
    INDEPENDENT.lines().filter_map(line).collect()
}

/// Line of the table for a quantity.
fn row<'a>(table: &'a str, quantity: &str) -> &'a str {
    table.lines().find(|line| line.starts_with(quantity)).unwrap_or_else(|| panic!("{table}"))
}

#[test]
fn reference_values_in_a_file_judge_as_the_benchmark_they_are_from() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("r.csv"), INDEPENDENT).unwrap();
    let reference = include_str!("../../../../docs/src/benchmarks/sandwich/v1/reference.json");
    std::fs::write(folder.path().join("own.json"), reference).unwrap();
    let judged = |arguments: &[&str]| {
        let output = asperity(folder.path(), arguments);
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let named = judged(&["compare", "r.csv", "--benchmark", "sandwich/v1", "--no-plots"]);
    assert_eq!(judged(&["compare", "r.csv", "own.json", "--no-plots"]), named);
    let far = changed("mean_normal_traction", |value| Some(value + 1.0));
    std::fs::write(folder.path().join("r.csv"), far).unwrap();
    assert_eq!(judged(&["compare", "r.csv", "own.json", "--no-plots"]).0, Some(1));
    for (text, why) in [("{}", "missing field"), (&reference[..400], "EOF"), ("[1]", "own.json")] {
        std::fs::write(folder.path().join("own.json"), text).unwrap();
        let (code, _, told) = judged(&["compare", "r.csv", "own.json"]);
        assert!(code == Some(2) && told.contains(why) && told.contains("form of a benchmark"), "{told}");
    }
    assert_eq!(judged(&["compare", "r.csv", "absent.json"]).0, Some(2));
}

#[test]
fn the_result_of_the_independent_program_agrees_and_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("r.csv"), INDEPENDENT).unwrap();
    let arguments = ["compare", "r.csv", "--benchmark", "sandwich/v1", "--out", "plots"];
    let output = asperity(folder.path(), &arguments);
    let table = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{table}");
    assert!(table.contains("6 of 6 required quantities agree with sandwich/v1"), "{table}");
    for name in ["slip_y12", "slip_y25", "slip_y37", "mean_shear_traction"] {
        let svg = std::fs::read_to_string(folder.path().join(format!("plots/{name}.svg"))).unwrap();
        assert!(svg.contains(">reference<") && svg.contains(">result<"), "{name}");
        assert!(folder.path().join(format!("plots/{name}.png")).is_file(), "{name}");
    }
}

#[test]
fn without_a_folder_plots_go_below_out() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("r.csv"), INDEPENDENT).unwrap();
    asperity(folder.path(), &["compare", "r.csv", "--benchmark", "sandwich/v1"]);
    assert!(folder.path().join("out/compare/sandwich-v1/slip_y25.svg").is_file());
}

#[test]
fn a_result_that_slips_a_tenth_too_much_differs_in_that_alone() {
    let (code, table, _) = compared(changed("slip_y25", |v| Some(1.1 * v)));
    assert_eq!(code, Some(1));
    assert!(row(&table, "slip_y25").ends_with("DIFFERS"), "{table}");
    // The end, where slip is largest, is farthest off.
    assert!(row(&table, "slip_y25").contains("50 [um]"), "{table}");
    assert_eq!(table.matches("DIFFERS").count(), 1, "{table}");
    assert!(table.contains("5 of 6 required quantities agree"), "{table}");
}

#[test]
fn another_unit_and_another_sign_are_suspected() {
    let (code, table, _) = compared(changed("mean_normal_traction", |v| Some(1e6 * v)));
    assert_eq!(code, Some(1));
    assert!(
        table.contains("mean_normal_traction: the value is 1e6 times the reference: is it in MPa?"),
        "{table}"
    );
    let (_, table, _) = compared(changed("mean_normal_traction", |v| Some(-v)));
    assert!(table.contains("mean_normal_traction: the sign is the opposite"), "{table}");
}

#[test]
fn a_required_value_that_is_missing_is_told_and_an_optional_one_may_be() {
    let (code, table, _) = compared(changed("friction_end", |_| None));
    assert_eq!(code, Some(1));
    assert!(row(&table, "friction_end").ends_with("MISSING"), "{table}");
    // The last of eleven values left empty.
    let (code, table, _) = compared(changed("slip_y12", |v| (v < 30.0).then_some(v)));
    assert_eq!(code, Some(1));
    let told = row(&table, "slip_y12");
    assert!(told.contains(" 10/11 ") && told.ends_with("MISSING"), "{table}");
    let (code, table, _) = compared(changed("mean_normal_traction_wide", |_| None));
    assert_eq!(code, Some(0));
    assert!(row(&table, "mean_normal_traction_wide").ends_with("not given"), "{table}");
}

#[test]
fn an_optional_value_that_differs_is_no_agreement() {
    let (code, table, _) = compared(changed("mean_normal_traction_wide", |v| Some(1.1 * v)));
    assert_eq!(code, Some(1));
    assert!(table.contains("6 of 6 required quantities agree"), "{table}");
}

#[test]
fn every_text_that_is_no_table_is_refused_with_its_place() {
    const HEAD: &str = "quantity,at,value\n";
    for (text, message) in [
        (String::new(), "r.csv:1:1: the table is empty"),
        ("# a remark\n\n".into(), "r.csv:3:1: the table is empty"),
        ("name,at,value\n".into(), "r.csv:1:1: `name` is not the column `quantity`"),
        ("quantity,at,result\n".into(), "r.csv:1:13: `result` is not the column `value`"),
        (
            format!("{HEAD}mean_normal_tracton,,9.3\n"),
            "r.csv:2:1: `mean_normal_tracton` is not a quantity of sandwich/v1; did you mean `mean_normal_traction`?",
        ),
        (format!("{HEAD}mean_normal_traction,,9.3 MPa\n"), "r.csv:2:23: `9.3 MPa` is not a number"),
        (format!("{HEAD}mean_normal_traction,,  abc\n"), "r.csv:2:25: `abc` is not a number"),
        (format!("{HEAD}mean_normal_traction,,nan\n"), "r.csv:2:23: `nan` is not finite"),
        (
            format!("{HEAD}mean_normal_traction,3,9.3\n"),
            "r.csv:2:22: `mean_normal_traction` is one value; leave `at` empty",
        ),
        (
            format!("{HEAD}# u_y in um\nslip_y25,,1\n"),
            "r.csv:3:10: `slip_y25` needs its coordinate `at`, one of 5, 10, 12",
        ),
        (
            format!("{HEAD}slip_y25,11,1\n"),
            "r.csv:2:10: `slip_y25` is not asked for at 11; it is at 5, 10, 12",
        ),
        (format!("{HEAD}slip_y25,5\n"), "r.csv:2:11: the line ends after 2 of 3 fields"),
        (format!("{HEAD}slip_y25,5,1,2\n"), "r.csv:2:14: the line has 4 fields"),
        (
            format!("{HEAD}slip_y25,5,0\r\nslip_y25,5.0,1\r\n"),
            "r.csv:3:10: `slip_y25` has this value in line 2 already",
        ),
    ] {
        let (code, _, told) = compared(&text);
        assert_eq!(code, Some(2), "{text:?}: {told}");
        assert!(told.starts_with(&format!("error: {message}")), "{text:?}: {told}");
    }
    let (code, _, told) = compared([&b"quantity,at,value\nslip_y25,5,"[..], &[0xff]].concat());
    assert_eq!((code, told.as_str()), (Some(2), "error: r.csv:2:12: the file is not text in UTF-8\n"));
}

#[test]
fn a_mark_of_byte_order_and_ends_of_lines_of_other_systems_are_read() {
    let text: String = INDEPENDENT.lines().flat_map(|line| [line, "\r\n"]).collect();
    let (code, table, told) = compared(format!("\u{feff}{text}"));
    assert_eq!(code, Some(0), "{table}{told}");
}

#[test]
fn a_file_or_benchmark_that_is_not_there_ends_with_2() {
    let folder = tempfile::tempdir().unwrap();
    let of = |arguments: &[&str]| {
        let output = asperity(folder.path(), arguments);
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, told) = of(&["compare", "none.csv", "--benchmark", "sandwich/v1"]);
    assert!(code == Some(2) && told.starts_with("error: cannot read none.csv"), "{told}");
    let (code, told) = of(&["compare", "none.csv", "--benchmark", "sandwich/v2"]);
    assert!(code == Some(2) && told.contains("did you mean `sandwich/v1`?"), "{told}");
}

#[test]
fn the_list_has_every_benchmark_and_the_template_asks_for_every_value() {
    let run = |arguments: &[&str]| {
        let output = asperity(Path::new("."), arguments);
        assert!(output.status.success(), "{arguments:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let list = run(&["compare", "--list"]);
    for reference in benchmark::all() {
        let name = &reference.benchmark;
        assert!(list.lines().any(|line| line.starts_with(&format!("{name} "))), "{list}");
        let template = run(&["compare", "--template", "--benchmark", name]);
        let empty = Submission::read(template.as_bytes(), reference).unwrap();
        assert!(empty.rows.is_empty(), "{name}");
        assert!(!Judgement::new(reference, &empty).agrees(), "{name}");
        let rows = template.lines().filter(|line| line.ends_with(',')).count();
        assert_eq!(rows, reference.quantities.iter().map(|q| q.places.len()).sum::<usize>(), "{name}");
    }
}

/// The reference as a result, with every value moved by this share of its tolerance.
fn moved(reference: &Reference, share: f64) -> Submission {
    let mut text = String::from("quantity,at,value\n");
    for quantity in &reference.quantities {
        for place in &quantity.places {
            let at = place.at.map_or(String::new(), |at| at.to_string());
            text += &format!("{},{at},{}\n", quantity.name, place.value + share * place.tolerance);
        }
    }
    Submission::read(text.as_bytes(), reference).unwrap()
}

#[test]
fn every_value_is_judged_by_its_own_tolerance() {
    for reference in benchmark::all() {
        for (share, agrees) in [(0.0, true), (0.99, true), (-0.99, true), (1.01, false), (-1.01, false)] {
            let result = moved(reference, share);
            let judgement = Judgement::new(reference, &result);
            assert_eq!(judgement.agrees(), agrees, "{} {share}", reference.benchmark);
            let expected = |verdict| match share.abs() {
                0.0 => verdict == Verdict::Within,
                s if s < 1.0 => matches!(verdict, Verdict::Agrees | Verdict::Within),
                _ => verdict == Verdict::Differs,
            };
            assert!(judgement.rows.iter().all(|row| expected(row.verdict)), "{}", reference.benchmark);
        }
    }
}

#[test]
fn the_entries_of_this_program_and_of_others_agree() {
    for reference in benchmark::all() {
        let results = folder(&reference.benchmark).join("results");
        let mut seen = 0;
        for entry in std::fs::read_dir(&results).unwrap() {
            let path = entry.unwrap().path();
            let result = Submission::read(&std::fs::read(&path).unwrap(), reference)
                .unwrap_or_else(|defect| panic!("{}:{defect}", path.display()));
            let judgement = Judgement::new(reference, &result);
            assert!(judgement.agrees(), "{}\n{judgement}", path.display());
            seen += 1;
        }
        assert!(seen >= 2, "{}: {seen} results", reference.benchmark);
    }
}
