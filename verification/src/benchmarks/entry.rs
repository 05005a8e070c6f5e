//! Results of a benchmark as a table that `asperity compare` reads.

use super::rounding::digits;
use asperity_reference::benchmark::Reference;
use std::fmt::Write as _;

/// Significant digits of the values of an entry.
const DIGITS: usize = 9;

/// Results of one code.
pub struct Entry {
    /// Name of the file, without extension.
    pub file: &'static str,
    /// Remarks at the top of the file: code, method, discretisation.
    pub remarks: Vec<(&'static str, String)>,
    /// Values of each quantity in the order of the reference.
    pub values: Vec<(&'static str, Vec<f64>)>,
}

impl Entry {
    /// An entry of a code, without values.
    pub fn new(file: &'static str, code: &str, method: &str, discretisation: &str) -> Self {
        let remarks = vec![
            ("code", code.to_string()),
            ("method", method.to_string()),
            ("discretisation", discretisation.to_string()),
        ];
        Self { file, remarks, values: Vec::new() }
    }

    /// Adds the values of a quantity.
    pub fn with(mut self, quantity: &'static str, values: impl Into<Vec<f64>>) -> Self {
        self.values.push((quantity, values.into()));
        self
    }

    /// Text of the table of results.
    #[must_use]
    pub fn text(&self, reference: &Reference) -> String {
        let mut text = format!("# benchmark: {}\n", reference.benchmark);
        for (key, value) in &self.remarks {
            let _ = writeln!(text, "# {key}: {value}");
        }
        text += "quantity,at,value\n";
        for quantity in &reference.quantities {
            let values = self.values.iter().find(|(name, _)| *name == quantity.name);
            for (place, value) in quantity.places.iter().zip(values.map_or(&[][..], |(_, v)| v)) {
                let at = place.at.map_or(String::new(), |at| at.to_string());
                let _ = writeln!(text, "{},{at},{}", quantity.name, digits(*value, DIGITS));
            }
        }
        text
    }
}
