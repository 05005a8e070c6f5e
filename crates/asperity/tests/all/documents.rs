//! Documents are correct: their scenes are accepted, and their commands print what is shown below them.
//!
//! A `console` block has commands after `$ `, each followed by its output. A line of three points represents any number
//! of lines. Lines of progress and times are left out. Counts may differ by a twentieth and results by 1e-4, as on
//! another processor.

use asperity_plan::reading::scene;
use std::path::{Path, PathBuf};

/// Pages with commands, in the order of reading.
const PAGES: [&str; 3] =
    ["docs/src/tutorial.md", "docs/src/contact-3d-howto.md", "docs/src/spring-slider-howto.md"];
/// Change of a count that depends on rounding.
const COUNTS: f64 = 0.05;
/// Change of a result that depends on rounding.
const RESULTS: f64 = 1e-4;

/// The program of the how-to, which prints.
#[allow(clippy::print_stdout)]
mod program {
    include!("../documents/program.rs");

    #[test]
    fn the_program_of_the_how_to_runs_as_it_stands_there() {
        main().unwrap();
        let page = std::fs::read_to_string(super::root().join("docs/src/spring-slider-howto.md")).unwrap();
        assert_eq!(super::blocks(&page, "rust"), [include_str!("../documents/program.rs")]);
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Blocks of a kind in a page.
pub fn blocks(page: &str, kind: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut inside: Option<bool> = None;
    for line in page.lines() {
        if let Some(rest) = line.strip_prefix("```") {
            inside = if inside.is_some() { None } else { Some(rest == kind) };
            if inside == Some(true) {
                found.push(String::new());
            }
        } else if inside == Some(true) {
            let block = found.last_mut().unwrap();
            block.push_str(line);
            block.push('\n');
        }
    }
    found
}

/// Pages of a folder and of its subfolders.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(pages(&path));
        } else if path.extension().is_some_and(|e| e == "md") {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn refusal(text: &str) -> Option<String> {
    if scene::reader::is_slider(text) {
        return asperity_plan::sliders::planner::read(text).err().map(|e| e.to_string());
    }
    match scene::read_in(text, &root().join("crates/asperity/tests/meshes")) {
        Err(errors) => Some(errors.to_string()),
        Ok(scene) => asperity_plan::plan_scene(&scene).err().map(|e| e.to_string()),
    }
}

#[test]
fn every_scene_of_the_book_is_accepted() {
    let mut scenes = 0;
    for path in pages(&root().join("docs/src")) {
        let page = std::fs::read_to_string(&path).unwrap();
        for text in blocks(&page, "toml").iter().filter(|text| text.starts_with("schema = 1")) {
            let refused = refusal(text);
            assert!(refused.is_none(), "{}: {}", path.display(), refused.unwrap());
            scenes += 1;
        }
    }
    assert!(scenes >= 12, "only {scenes} scenes");
}

/// Commands of a block, each with its expected output.
fn commands(block: &str) -> Vec<(String, Vec<String>)> {
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    for line in block.lines() {
        match line.strip_prefix("$ ") {
            Some(command) => found.push((command.to_owned(), Vec::new())),
            None => found.last_mut().unwrap().1.push(line.to_owned()),
        }
    }
    found
}

/// A line without numbers, and the numbers in it.
fn parted(line: &str) -> (String, Vec<String>) {
    let (mut words, mut numbers) = (String::new(), Vec::new());
    let mut rest = line.trim_end();
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        words.push_str(&rest[..at]);
        words.push('#');
        let number = &rest[at..];
        let exponent = |k: usize| {
            number[k..].starts_with('e')
                && number[k + 1..].trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit())
        };
        let mut length = number.len();
        let mut previous = ' ';
        for (k, c) in number.char_indices() {
            let part = c.is_ascii_digit() || c == '.' || exponent(k) || c == '-' && previous == 'e';
            if !part {
                length = k;
                break;
            }
            previous = c;
        }
        let whole = number[..length].trim_end_matches('.');
        numbers.push(whole.to_owned());
        rest = &number[whole.len()..];
    }
    words.push_str(rest);
    (words, numbers)
}

/// True if two numbers agree up to the effects of rounding during a run.
fn near(a: &str, b: &str) -> bool {
    let bound = if a.contains(['.', 'e']) { RESULTS } else { COUNTS };
    let (Ok(a), Ok(b)) = (a.parse::<f64>(), b.parse::<f64>()) else { return a == b };
    (a - b).abs() <= bound * a.abs().max(b.abs())
}

fn alike(a: &str, b: &str) -> bool {
    let ((words, numbers), (others, values)) = (parted(a), parted(b));
    words == others && numbers.len() == values.len() && numbers.iter().zip(&values).all(|(a, b)| near(a, b))
}

fn is_progress(line: &str) -> bool {
    line.trim_start().split_once(" %").is_some_and(|(share, _)| share.parse::<u8>().is_ok())
}

/// The first line of `expected` that is not printed where it should be.
fn missing<'a>(expected: &'a [String], printed: &[&str]) -> Option<&'a str> {
    let Some((first, rest)) = expected.split_first() else {
        return (!printed.is_empty()).then_some("the end");
    };
    if first == "..." {
        // Consecutive lines of three points, with progress between them, count as one.
        let rest = &rest[rest.iter().take_while(|line| *line == "...").count()..];
        let next = rest.first()?;
        let Some(at) = printed.iter().position(|line| alike(next, line)) else { return Some(next) };
        return missing(rest, &printed[at..]);
    }
    match printed.split_first() {
        Some((line, others)) if alike(first, line) => missing(rest, others),
        _ => Some(first),
    }
}

#[cfg(unix)]
#[test]
fn the_commands_of_the_documents_print_what_stands_there() {
    let binary = Path::new(env!("CARGO_BIN_EXE_asperity")).parent().unwrap().to_owned();
    let path = format!("{}:{}", binary.display(), std::env::var("PATH").unwrap_or_default());
    for page in PAGES {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("scenes")).unwrap();
        for name in ["sandwich.toml", "spring-slider.toml"] {
            std::fs::copy(root().join("scenes").join(name), folder.path().join("scenes").join(name)).unwrap();
        }
        let text = std::fs::read_to_string(root().join(page)).unwrap();
        let commands: Vec<_> = blocks(&text, "console").iter().flat_map(|block| commands(block)).collect();
        assert!(!commands.is_empty(), "{page} has no commands");
        for (command, expected) in commands {
            let both = format!("{{ {command}; }} 2>&1");
            let shell = std::process::Command::new("sh")
                .args(["-c", &both])
                .current_dir(folder.path())
                .env("PATH", &path)
                .output()
                .unwrap();
            let printed = String::from_utf8(shell.stdout).unwrap();
            let lines: Vec<&str> = printed.lines().filter(|line| !is_progress(line)).collect();
            let expected: Vec<String> = expected.into_iter().filter(|line| !is_progress(line)).collect();
            let lines = &lines[..lines.len() - lines.iter().rev().take_while(|line| line.is_empty()).count()];
            let wrong = missing(&expected, lines);
            assert!(
                wrong.is_none(),
                "{page}: `{command}` does not print\n{}\nbut\n{printed}",
                wrong.unwrap()
            );
        }
    }
}

#[test]
fn changed_words_counts_and_results_are_noticed() {
    let line = |steps, of, traction, rate| {
        format!("  {steps} {of} (0 rejected), traction {traction} MPa, V = {rate} m/s")
    };
    let expected = line(231, "steps", "9.335791", "1.0e-4");
    assert!(alike(&expected, &line(235, "steps", "9.335792", "1.0e-4")));
    for other in [
        line(271, "steps", "9.335791", "1.0e-4"),
        line(231, "steps", "9.345791", "1.0e-4"),
        line(231, "steps", "9.335791", "1.0e-5"),
        line(231, "stops", "9.335791", "1.0e-4"),
    ] {
        assert!(!alike(&expected, &other), "{other}");
    }
    let expected = ["...", "b 1", "..."].map(str::to_owned);
    assert_eq!(missing(&expected, &["a", "b 1", "c"]), None);
    assert_eq!(missing(&expected, &["a", "c"]), Some("b 1"));
    assert_eq!(missing(&expected[..2], &["b 1", "c"]), Some("the end"));
}
