//! Readers of output files, independent of the code that writes them.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// A column of a table, or an array of a field file.
pub struct Column {
    /// Name without unit and position; `each point` where the table has a column for each point.
    pub name: String,
    /// Number of values at one time or point.
    pub components: usize,
    /// Row by row or point by point.
    pub values: Vec<f64>,
}

/// A column or an array as the text about the files of a run describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnDescription {
    /// Names of its files, where `*` is any text.
    pub files: Vec<String>,
    /// Name, with `*` for parts of the scene; `each point` where the table has a column for each point.
    pub column: String,
    pub unit: String,
    pub sign: String,
    /// Number of components and place of an array.
    pub array: Option<(usize, String)>,
}

/// Columns and arrays in the text about the files of a run.
pub fn described(out: &Path) -> Vec<ColumnDescription> {
    let text = fs::read_to_string(out.join("README.md")).unwrap();
    let rows = text.lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let [_, files, column, unit, sign, _, ref rest @ ..] = cells[..] else { panic!("{row}") };
        let array = match rest {
            [components, at, ..] => Some((components.parse().unwrap(), (*at).to_owned())),
            _ => None,
        };
        let files = files.split(", ").map(|file| file.trim_matches('`').to_owned()).collect();
        let column = column.trim_matches('`').into();
        ColumnDescription { files, column, unit: unit.into(), sign: sign.into(), array }
    })
    .collect()
}

/// True if a name is of this form, with at most one `*`.
pub fn fits(name: &str, form: &str) -> bool {
    match form.split_once('*') {
        Some((start, end)) => {
            name.starts_with(start) && name.ends_with(end) && name.len() >= start.len() + end.len()
        }
        None => name == form,
    }
}

/// Files below a folder, in the order of their names.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { found.extend(files(&path)) } else { found.push(path) }
    }
    found.sort();
    found
}

/// The columns of a table: of CSV, or of a station.
pub fn table(text: &str) -> Vec<Column> {
    let lines = || text.lines().filter(|line| !line.starts_with('#'));
    let by = if lines().next().unwrap().contains(',') { ',' } else { ' ' };
    let plain = |name: &str| match name.parse::<f64>() {
        Ok(_) => "each point".to_owned(),
        Err(_) => name.split(" [").next().unwrap().to_owned(),
    };
    let column = |(k, name): (usize, &str)| {
        let values = lines().skip(1).map(|line| line.split(by).nth(k).unwrap().parse().unwrap_or(f64::NAN));
        Column { name: plain(name), components: 1, values: values.collect() }
    };
    lines().next().unwrap().split(by).enumerate().map(column).collect()
}

/// One array of the appended section: words that count blocks, their sizes, and the blocks as zlib streams.
fn decode(text: &str) -> Vec<u8> {
    let words = |text: &str| -> Vec<usize> {
        let bytes = STANDARD.decode(text).unwrap();
        bytes.chunks(8).map(|w| u64::from_le_bytes(w.try_into().unwrap()) as usize).collect()
    };
    // Three words fill 32 characters exactly.
    let head = ((3 + words(&text[..32])[0]) * 8).div_ceil(3) * 4;
    let sizes = words(&text[..head])[3..].to_vec();
    let data = STANDARD.decode(&text[head..head + sizes.iter().sum::<usize>().div_ceil(3) * 4]).unwrap();
    let (mut out, mut rest) = (Vec::new(), data.as_slice());
    for size in sizes {
        let (block, next) = rest.split_at(size);
        flate2::read::ZlibDecoder::new(block).read_to_end(&mut out).unwrap();
        rest = next;
    }
    out
}

/// The arrays of a field file, `Points` among them.
pub fn arrays(text: &str) -> Vec<Column> {
    let (head, appended) = text.split_once("<AppendedData encoding=\"base64\">\n_").unwrap();
    let value = |line: &str, key: &str| {
        let rest = line.split_once(&format!(" {key}=\""))?.1;
        Some(rest.split_once('"').unwrap().0.to_owned())
    };
    let lines = head.lines().filter(|line| line.starts_with("<DataArray"));
    let array = |line: &str| {
        let bytes = decode(&appended[value(line, "offset").unwrap().parse().unwrap()..]);
        let values = match value(line, "type").unwrap().as_str() {
            "Float64" => bytes.chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect(),
            "Int64" => bytes.chunks(8).map(|b| i64::from_le_bytes(b.try_into().unwrap()) as f64).collect(),
            _ => bytes.into_iter().map(f64::from).collect(),
        };
        let components = value(line, "NumberOfComponents").map_or(1, |n| n.parse().unwrap());
        Column { name: value(line, "Name").unwrap(), components, values }
    };
    lines.map(array).collect()
}
