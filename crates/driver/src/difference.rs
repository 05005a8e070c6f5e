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
    /// Largest difference over the largest value of the column \[-\].
    pub relative: f64,
    /// Row of the largest difference, from 1.
    pub row: usize,
}

/// Result of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum Compared {
    /// Columns that differ; empty for equal tables. True if the rows of the first were interpolated to the times of the second.
    Columns(Vec<Difference>, bool),
    /// Tables that cannot be compared, with the reason.
    Other(String),
}

impl Table {
    /// Reads a table in CSV.
    ///
    /// # Errors
    /// The first line that is not a row of the table.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(bytes);
        let names: Vec<String> =
            reader.headers().map_err(|error| error.to_string())?.iter().map(str::to_string).collect();
        let mut texts = vec![Vec::new(); names.len()];
        for record in reader.records() {
            for (column, entry) in texts.iter_mut().zip(&record.map_err(|error| error.to_string())?) {
                column.push(entry.trim().to_string());
            }
        }
        let rows = texts.first().map_or(0, Vec::len);
        Ok(Self { names, columns: texts.into_iter().map(Column::new).collect(), rows })
    }

    /// Times of the rows, if the first column has them in order.
    fn times(&self) -> Option<&[f64]> {
        match (self.names.first()?, self.columns.first()?) {
            (name, Column::Numbers(times)) if name.starts_with("time") && times.is_sorted() => Some(times),
            _ => None,
        }
    }
}

impl Column {
    fn new(texts: Vec<String>) -> Self {
        let numbers: Option<Vec<f64>> = texts.iter().map(|text| text.parse().ok()).collect();
        numbers.map_or(Self::Texts(texts), Self::Numbers)
    }
}

/// Compares two tables. Where their rows are at other times, those of the first are interpolated to the times that both cover.
#[must_use]
pub fn compare(a: &Table, b: &Table) -> Compared {
    if a.names != b.names {
        return Compared::Other("their columns differ".into());
    }
    let same_times = a.rows == b.rows && a.times() == b.times();
    match (same_times, a.times(), b.times()) {
        (true, _, _) => Compared::Columns(differences(a, b, |column, row| column.get(row).copied()), false),
        (false, Some(from), Some(to)) => {
            let at = |column: &[f64], row: usize| interpolated(from, column, to[row]);
            Compared::Columns(differences(a, b, at), true)
        }
        _ => Compared::Other(format!("they have {} and {} rows", a.rows, b.rows)),
    }
}

/// Value at a time by linear interpolation; `None` outside the times.
fn interpolated(times: &[f64], values: &[f64], at: f64) -> Option<f64> {
    let after = times.partition_point(|time| *time < at);
    let (time, value) = (*times.get(after)?, values[after]);
    if time == at || after == 0 {
        return (time == at).then_some(value);
    }
    let (before, first) = (times[after - 1], values[after - 1]);
    Some(first + (value - first) * (at - before) / (time - before))
}

/// Columns that differ, with the value of a column of the first table in a row of the second.
fn differences(a: &Table, b: &Table, value: impl Fn(&[f64], usize) -> Option<f64>) -> Vec<Difference> {
    let columns = a.names.iter().zip(a.columns.iter().zip(&b.columns));
    let difference = |(name, pair): (&String, (&Column, &Column))| match pair {
        (Column::Numbers(a), Column::Numbers(b)) => {
            let each = b.iter().enumerate().filter_map(|(row, b)| Some((row, apart(value(a, row)?, *b))));
            let (row, largest) = each.reduce(|most, next| if next.1 > most.1 { next } else { most })?;
            let size = a.iter().chain(b).filter(|v| v.is_finite()).fold(0.0_f64, |most, v| most.max(v.abs()));
            let relative = if largest > 0.0 { largest / size } else { 0.0 };
            Some(Difference { name: name.clone(), largest, relative, row: row + 1 })
        }
        (Column::Texts(a), Column::Texts(b)) if a.len() == b.len() => {
            let row = a.iter().zip(b).position(|(a, b)| a != b)?;
            Some(Difference {
                name: name.clone(),
                largest: f64::INFINITY,
                relative: f64::INFINITY,
                row: row + 1,
            })
        }
        (Column::Texts(_), Column::Texts(_)) => None,
        _ => Some(Difference { name: name.clone(), largest: f64::INFINITY, relative: f64::INFINITY, row: 1 }),
    };
    columns.filter_map(difference).filter(|difference| difference.largest > 0.0).collect()
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
