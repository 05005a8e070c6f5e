//! Rows of a CSV file in memory.

/// CSV rows in memory.
pub struct Rows(csv::Writer<Vec<u8>>);

impl Default for Rows {
    fn default() -> Self {
        Self(csv::Writer::from_writer(Vec::new()))
    }
}

impl Rows {
    /// Adds a row.
    pub fn push(&mut self, row: impl Iterator<Item = String>) {
        self.0.write_record(row.map(String::into_bytes)).expect("writing to a Vec cannot fail");
    }

    /// All rows.
    pub fn text(self) -> String {
        let bytes = self.0.into_inner().expect("writing to a Vec cannot fail");
        String::from_utf8(bytes).expect("rows are made of text")
    }
}
