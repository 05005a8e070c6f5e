//! Results of the independent programs.

use crate::CaseError;
use serde_json::Value;

/// A file of results.
pub struct Results(Value);

impl Results {
    /// Reads the text of a file.
    pub fn read(text: &str) -> Result<Self, CaseError> {
        Ok(Self(serde_json::from_str(text)?))
    }

    /// The value of a key.
    pub fn at(&self, key: &str) -> Result<Self, CaseError> {
        self.0.get(key).cloned().map(Self).ok_or_else(|| format!("the results have no `{key}`").into())
    }

    /// The members of a list.
    pub fn list(&self) -> Result<Vec<Self>, CaseError> {
        let list = self.0.as_array().ok_or("the results have no list here")?;
        Ok(list.iter().cloned().map(Self).collect())
    }

    /// A number.
    pub fn number(&self) -> Result<f64, CaseError> {
        self.0.as_f64().ok_or_else(|| "the results have no number here".into())
    }

    /// A list of numbers.
    pub fn numbers(&self) -> Result<Vec<f64>, CaseError> {
        self.list()?.iter().map(Self::number).collect()
    }

    /// A list of lists of numbers.
    pub fn rows(&self) -> Result<Vec<Vec<f64>>, CaseError> {
        self.list()?.iter().map(Self::numbers).collect()
    }
}
