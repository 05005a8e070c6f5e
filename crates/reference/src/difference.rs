//! Differences between two tables of results, column by column.

/// A table with a header.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names of the columns.
    pub names: Vec<String>,
    /// Columns.
    pub columns: Vec<Column>,
    /// Number of rows.
    pub rows: usize,
}

/// Reason why a text is no table.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// Text that is no CSV.
    #[error(transparent)]
    Csv(#[from] csv::Error),
    /// Bytes that are no text.
    #[error(transparent)]
    Text(#[from] std::str::Utf8Error),
    /// A row with another number of entries than the first.
    #[error("line {line} has {entries} entries, the first row {width}")]
    Row {
        /// Number of the line, from 1.
        line: usize,
        /// Its entries.
        entries: usize,
        /// Entries of the first row.
        width: usize,
    },
}

/// Entries of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    /// All are numbers.
    Numbers(Vec<f64>),
    /// Some are not.
    Texts(Vec<String>),
}

/// Difference of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Name of the column.
    pub name: String,
    /// Largest difference; infinite where a number is missing on one side or texts differ.
    pub largest: f64,
    /// Largest difference over the largest value of the column, or of its vector \[-\].
    pub relative: f64,
    /// Row of the largest difference, from 1.
    pub row: usize,
    /// True if the entries are numbers of things or names, which no tolerance applies to.
    pub exact: bool,
}

impl Difference {
    /// True if the difference is within a tolerance.
    #[must_use]
    pub fn within(&self, tolerance: f64) -> bool {
        !self.exact && self.relative <= tolerance
    }
}

/// Columns that number things or name a state of them. Between two rows they have no value.
const NUMBERS: [&str; 7] =
    ["stage", "step", "node", "point", "snapshot", "status [0 open 1 stick 2 slip]", "paired [0 no 1 yes]"];
/// The column that counts steps: at other times it says nothing about the result.
const COUNT: &str = "step";

/// Extent that two tables have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Rows compared.
    pub rows: usize,
    /// Rows of the longer table.
    pub of: usize,
    /// Time that both cover over the time that either covers \[-\]; 1 for tables without times.
    pub share: f64,
    /// Time that one lacks at its start or end, over the time that either covers \[-\]. Where steps are adaptive the end of a run may
    /// lie up to an interval between rows after the last row, which is not counted.
    pub lacking: f64,
    /// True if the rows of the first were interpolated to the times of the second.
    pub interpolated: bool,
}

/// Share of the rows of the longer table that is compared at least: with fewer, most of what it holds has nothing beside it.
const ROWS: f64 = 0.5;

impl Overlap {
    /// True if enough was compared to judge the tables: all of the time but a tolerance, and not only a few of many rows.
    #[must_use]
    pub fn suffices(&self, tolerance: f64) -> bool {
        self.of == 0 || (self.rows as f64 >= ROWS * self.of as f64 && self.lacking <= tolerance)
    }
}

/// Result of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum TableComparison {
    /// Columns that differ, empty for equal tables, and what was compared.
    Columns(Vec<Difference>, Overlap),
    /// Tables that cannot be compared, with the reason.
    Other(String),
}

impl Table {
    /// Reads a table: in CSV, or of columns between blanks, which need no head.
    ///
    /// # Errors
    /// The first line that is not a row of the table.
    pub fn read(bytes: &[u8]) -> Result<Self, TableError> {
        let first = bytes.split(|byte| *byte == b'\n').find(|line| !is_remark(line)).unwrap_or_default();
        if first.contains(&b',') || !first.trim_ascii().contains(&b' ') {
            Self::csv(bytes)
        } else {
            Self::blanks(bytes)
        }
    }

    fn csv(bytes: &[u8]) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(bytes);
        let names = reader.headers()?.iter().map(str::to_string).collect();
        let records =
            reader.records().map(|record| Ok(record?.iter().map(|entry| entry.trim().to_string()).collect()));
        Self::from_rows(names, records)
    }

    fn blanks(bytes: &[u8]) -> Result<Self, TableError> {
        let text = std::str::from_utf8(bytes)?;
        let cells = |line: &str| line.split_whitespace().map(str::to_string).collect::<Vec<_>>();
        let mut lines = text.lines().enumerate().filter(|(_, line)| !is_remark(line.as_bytes())).peekable();
        let first = lines.peek().map(|(_, line)| cells(line)).unwrap_or_default();
        let headed = first.iter().any(|name| name.parse::<f64>().is_err());
        let width = first.len();
        let names = if headed { first } else { (1..=width).map(|k| format!("column {k}")).collect() };
        let rows = lines.skip(usize::from(headed)).map(|(number, line)| {
            let row = cells(line);
            let entries = row.len();
            if entries == width { Ok(row) } else { Err(TableError::Row { line: number + 1, entries, width }) }
        });
        Self::from_rows(names, rows)
    }

    fn from_rows(
        names: Vec<String>,
        rows: impl Iterator<Item = Result<Vec<String>, TableError>>,
    ) -> Result<Self, TableError> {
        let mut texts = vec![Vec::new(); names.len()];
        for row in rows {
            for (column, entry) in texts.iter_mut().zip(row?) {
                column.push(entry);
            }
        }
        let rows = texts.first().map_or(0, Vec::len);
        Ok(Self { names, columns: texts.into_iter().map(Column::new).collect(), rows })
    }

    /// Times of the rows, if the first column has them in order.
    fn times(&self) -> Option<&[f64]> {
        match (self.names.first()?, self.columns.first()?) {
            (name, Column::Numbers(times)) if is_time(name) && times.is_sorted() => Some(times),
            _ => None,
        }
    }
}

/// True for a line that is empty or a comment, in CSV and stations or in models of finite faults.
fn is_remark(line: &[u8]) -> bool {
    let line = line.trim_ascii();
    line.is_empty() || line.starts_with(b"#") || line.starts_with(b"%")
}

/// True for the name of a column of times; stations have `t`.
fn is_time(name: &str) -> bool {
    name == "t" || name.starts_with("time")
}

impl Column {
    fn new(texts: Vec<String>) -> Self {
        let numbers: Option<Vec<f64>> = texts.iter().map(|text| text.parse().ok()).collect();
        numbers.map_or(Self::Texts(texts), Self::Numbers)
    }
}

/// Compares two tables. Where their rows are at other times, those of the first are interpolated to the times that both cover.
#[must_use]
pub fn compare(a: &Table, b: &Table) -> TableComparison {
    if a.names != b.names {
        return TableComparison::Other("their columns differ".into());
    }
    let same = a.rows == b.rows && a.times() == b.times();
    let places: Vec<Option<Place>> = match (same, a.times(), b.times()) {
        (true, _, _) => (0..a.rows).map(|row| Some(Place::at(row))).collect(),
        (false, Some(from), Some(to)) => (0..b.rows).map(|row| Place::locate(from, to, row)).collect(),
        _ if a.names.first().is_some_and(|name| is_time(name)) => {
            return TableComparison::Other("the times of their rows are not in order".into());
        }
        _ => return TableComparison::Other(format!("they have {} and {} rows", a.rows, b.rows)),
    };
    let rows = places.iter().flatten().count();
    let [share, lacking] =
        if same { [1.0, 0.0] } else { shared(a.times().unwrap_or(&[]), b.times().unwrap_or(&[])) };
    let overlap = Overlap { rows, of: a.rows.max(b.rows), share, lacking, interpolated: !same };
    TableComparison::Columns(differences(a, b, &places, same), overlap)
}

/// Time that both cover, and time that one lacks, over the time that either covers.
fn shared(a: &[f64], b: &[f64]) -> [f64; 2] {
    let (&[a0, .., a1], &[b0, .., b1]) = (a, b) else { return [0.0, 1.0] };
    let (either, both) = (a1.max(b1) - a0.min(b0), a1.min(b1) - a0.max(b0));
    if both <= 0.0 {
        return [0.0, 1.0];
    }
    // Rows at the same times lie where they were asked for: then each missing row is missing.
    let (few, many) = if a.len() < b.len() { (a, b) } else { (b, a) };
    let same_times = few.iter().all(|time| many.binary_search_by(|t| t.total_cmp(time)).is_ok());
    let late = |times: &[f64]| if same_times { 0.0 } else { times[1] - times[0] };
    let early =
        |times: &[f64]| if same_times { 0.0 } else { times[times.len() - 1] - times[times.len() - 2] };
    let before = (a0 - b0).abs() - late(if a0 > b0 { a } else { b });
    let after = (a1 - b1).abs() - early(if a1 < b1 { a } else { b });
    [both / either, (before.max(0.0) + after.max(0.0)) / either]
}

/// Rows of the first table that a row of the second is compared with: two rows, and where the time is between them, from 0 to 1.
#[derive(Clone, Copy, Debug)]
struct Place {
    rows: [usize; 2],
    between: f64,
}

impl Place {
    fn at(row: usize) -> Self {
        Self { rows: [row, row], between: 0.0 }
    }

    /// Place of a row of the second table; `None` outside the times of the first. Where both have several rows at a time, as where
    /// something jumps, the first belongs to the first, and so on.
    fn locate(from: &[f64], to: &[f64], row: usize) -> Option<Self> {
        let time = to[row];
        let after = from.partition_point(|t| *t < time);
        let equal = from.partition_point(|t| *t <= time) - after;
        if equal > 0 {
            let before = row - to.partition_point(|t| *t < time);
            return Some(Self::at(after + before.min(equal - 1)));
        }
        let before = after.checked_sub(1)?;
        let (start, end) = (from[before], *from.get(after)?);
        Some(Self { rows: [before, after], between: (time - start) / (end - start) })
    }

    /// Value by linear interpolation.
    fn value(&self, values: &[f64]) -> f64 {
        let [first, second] = self.rows.map(|row| values[row]);
        if self.between == 0.0 { first } else { first + (second - first) * self.between }
    }
}

/// Columns that differ, with the rows of the first table beside those of the second.
fn differences(a: &Table, b: &Table, places: &[Option<Place>], same: bool) -> Vec<Difference> {
    let columns = a.names.iter().zip(a.columns.iter().zip(&b.columns));
    let difference = |(name, pair): (&String, (&Column, &Column))| match pair {
        (Column::Numbers(a), Column::Numbers(b)) if NUMBERS.contains(&name.as_str()) => {
            let counted = same || name != COUNT;
            named(name, places.iter().filter(|_| counted), a, b)
        }
        (Column::Numbers(one), Column::Numbers(other)) => {
            measured(name, places, [one, other], largest(&[a, b], name))
        }
        (Column::Texts(a), Column::Texts(b)) => named(name, places.iter(), a, b),
        _ => Some(other(name, 0)),
    };
    columns.filter_map(difference).collect()
}

/// Name of a vector of which a column has a component.
fn vector(name: &str) -> Option<&str> {
    ["_x", "_y", "_z"].iter().find_map(|axis| name.strip_suffix(axis))
}

/// Largest size of the values of a column, or of all components of its vector: one that vanishes by symmetry is rounding of the others.
fn largest(tables: &[&Table], name: &str) -> f64 {
    let beside = |other: &str| other == name || vector(name).is_some_and(|own| vector(other) == Some(own));
    let columns =
        tables.iter().flat_map(|t| t.names.iter().zip(&t.columns)).filter(|(other, _)| beside(other));
    let sizes = columns.map(|(_, column)| match column {
        Column::Numbers(values) => {
            values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |most, v| most.max(v.abs()))
        }
        Column::Texts(_) => 0.0,
    });
    sizes.fold(0.0, f64::max)
}

/// Difference of measured values, if there is one; relative to `size`.
fn measured(name: &str, places: &[Option<Place>], [a, b]: [&[f64]; 2], size: f64) -> Option<Difference> {
    let pairs = places.iter().zip(b).enumerate();
    let each = pairs.filter_map(|(row, (place, b))| Some((row, apart(place.as_ref()?.value(a), *b))));
    let (row, largest) = each.reduce(|most, next| if next.1 > most.1 { next } else { most })?;
    let difference =
        || Difference { name: name.into(), largest, relative: largest / size, row: row + 1, exact: false };
    (largest > 0.0).then(difference)
}

/// Difference of entries that are equal or not, if there is one. Between two rows the entry is that of either.
fn named<'a, T: PartialEq>(
    name: &str,
    places: impl Iterator<Item = &'a Option<Place>>,
    a: &[T],
    b: &[T],
) -> Option<Difference> {
    let differs = |(place, b): (&Option<Place>, &T)| {
        place.as_ref().is_some_and(|place| place.rows.iter().all(|row| a[*row] != *b))
    };
    places.zip(b).position(differs).map(|row| other(name, row))
}

/// Difference of entries that no number measures, in a row from 0.
fn other(name: &str, row: usize) -> Difference {
    let beyond = f64::INFINITY;
    Difference { name: name.into(), largest: beyond, relative: beyond, row: row + 1, exact: true }
}

/// Distance of two numbers; zero for two that are not numbers.
fn apart(a: f64, b: f64) -> f64 {
    match (a.is_nan(), b.is_nan()) {
        (true, true) => 0.0,
        (false, false) if a == b => 0.0,
        (false, false) => (a - b).abs(),
        _ => f64::INFINITY,
    }
}
