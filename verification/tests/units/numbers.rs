use asperity_verification::{cases, glob, numbers};

/// Text between backticks, and words outside that name all columns of a kind.
fn names(cell: &str) -> Vec<String> {
    let quoted: Vec<String> = cell.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    if quoted.is_empty() { vec![cell.trim().to_owned()] } else { quoted }
}

/// Files and columns of the tables of signs in the book, with the kind of run.
fn book_columns() -> Vec<(&'static str, String, String)> {
    let text = include_str!("../../../docs/src/signs.md");
    let (mut kind, mut all) = ("", Vec::new());
    for line in text.lines() {
        kind = match line {
            "## Bodies and interfaces" => "bodies",
            "## Faults through earthquake cycles" => "faults",
            "## Bodies with mass" => "dynamics",
            "## Spring-sliders" => "sliders",
            _ if line.starts_with("## ") => "",
            _ => kind,
        };
        let cells: Vec<&str> = line.split('|').collect();
        if kind.is_empty() || cells.len() < 4 || !cells[1].contains('`') {
            continue;
        }
        let columns = names(cells[2]);
        for file in
            names(cells[1]).into_iter().filter(|file| file != "events_*.csv" && file != "slow_events.csv")
        {
            all.extend(columns.iter().map(|column| (kind, file.clone(), column.clone())));
        }
    }
    all
}

#[test]
fn every_column_of_the_tables_of_signs_is_a_number() {
    let numbers = numbers::all().unwrap();
    // Each row names several files, and not all have each of its columns.
    for (kind, file, column) in book_columns() {
        let known = numbers.iter().any(|n| n.kind == kind && glob::matches(&column, &n.name));
        let of_file = numbers.iter().any(|n| n.kind == kind && n.file == file);
        assert!(known && of_file, "{kind}: {file}: {column}");
    }
}

#[test]
fn claims_of_numbers_stand_in_cases_of_the_suite() {
    for number in numbers::all().unwrap() {
        for (case, quantity) in &number.claims {
            assert!(cases::ALL.iter().any(|c| c.name == case), "{case}");
            assert!(!quantity.trim_matches('*').is_empty(), "{}: {}", number.file, number.name);
        }
    }
}
