//! Reference values of a benchmark.

use serde::{Deserialize, Serialize};

/// Version of the format of reference files.
pub const SCHEMA: u32 = 1;

/// Reference values of a benchmark, with their uncertainty.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Version of the format; [`SCHEMA`].
    pub schema: u32,
    /// Name with its version, such as `sandwich/v1`.
    pub benchmark: String,
    /// Title.
    pub title: String,
    /// Licence of the values, as an SPDX expression.
    pub license: String,
    /// Quantities to report.
    pub quantities: Vec<Quantity>,
}

/// A quantity: one value, or values along a coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Name in tables of results.
    pub name: String,
    /// Meaning, as an axis of a plot has it.
    pub meaning: String,
    /// Unit of the values; 1 for a number.
    pub unit: String,
    /// True if a result needs it.
    pub required: bool,
    /// Coordinate of the values; absent for a single value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub along: Option<Along>,
    /// Origin of the values and of their uncertainty.
    pub source: String,
    /// Reason for the tolerance.
    pub because: String,
    /// The values.
    pub places: Vec<Place>,
}

/// Coordinate of a quantity.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Along {
    /// Meaning, as an axis of a plot has it.
    pub meaning: String,
    /// Unit; 1 for a number.
    pub unit: String,
}

/// A reference value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Coordinate; absent for a single value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<f64>,
    /// Value.
    pub value: f64,
    /// Uncertainty of the value; 0 for a closed form.
    pub uncertainty: f64,
    /// Largest difference of a result that agrees.
    pub tolerance: f64,
}

/// Share of the largest coordinate within which two coordinates are the same: the sixth digit, which every program prints.
const SAME: f64 = 1e-6;

impl Quantity {
    /// The reference value at a coordinate.
    #[must_use]
    pub fn place(&self, at: Option<f64>) -> Option<&Place> {
        let largest = self.places.iter().filter_map(|p| p.at).fold(0.0, |m: f64, at| m.max(at.abs()));
        self.places.iter().find(|place| match (place.at, at) {
            (None, None) => true,
            (Some(a), Some(b)) => (a - b).abs() <= SAME * largest,
            _ => false,
        })
    }
}

impl Reference {
    /// The quantity of this name.
    #[must_use]
    pub fn quantity(&self, name: &str) -> Option<&Quantity> {
        self.quantities.iter().find(|q| q.name == name)
    }

    /// Faults of the reference itself, as sentences; none if it is sound.
    #[must_use]
    pub fn problems(&self) -> Vec<String> {
        let mut problems = Vec::new();
        let mut told = |fault: bool, text: String| {
            if fault {
                problems.push(text);
            }
        };
        told(self.schema != SCHEMA, format!("the schema is {}", self.schema));
        told(!self.quantities.iter().any(|q| q.required), "no quantity is required".into());
        for (i, quantity) in self.quantities.iter().enumerate() {
            let name = &quantity.name;
            told(self.quantities[..i].iter().any(|q| q.name == *name), format!("{name} is listed twice"));
            told(quantity.places.is_empty(), format!("{name} has no values"));
            let one = quantity.along.is_none();
            told(one && quantity.places.len() != 1, format!("{name} has no coordinate"));
            told(quantity.places.iter().any(|p| p.at.is_none() != one), format!("{name}: coordinates"));
            let ascending = quantity.places.windows(2).all(|pair| pair[0].at < pair[1].at);
            told(!ascending, format!("{name}: coordinates do not ascend"));
            for place in &quantity.places {
                let sound =
                    place.value.is_finite() && place.uncertainty >= 0.0 && place.tolerance.is_finite();
                told(!sound, format!("{name}: a value is not finite"));
                // A tolerance below the uncertainty would refuse what the reference cannot tell from the truth.
                told(place.tolerance <= 2.0 * place.uncertainty, format!("{name}: tolerance"));
            }
        }
        problems
    }

    /// The values in the form of a table of results, with uncertainty and tolerance.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = format!(
            "# {}: {}\n# reference values, {}\nquantity,at,value,uncertainty,tolerance\n",
            self.benchmark, self.title, self.license
        );
        self.each(|q, p, at| {
            text += &format!("{},{at},{},{},{}\n", q.name, p.value, p.uncertainty, p.tolerance);
        });
        text
    }

    /// An empty table of results.
    #[must_use]
    pub fn template(&self) -> String {
        let mut text = format!(
            "# benchmark: {}\n# code:\n# version:\n# by:\n# method:\n# discretisation:\nquantity,at,value\n",
            self.benchmark
        );
        for quantity in &self.quantities {
            let along = quantity.along.as_ref();
            let along = along.map_or(String::new(), |a| format!(", at {} [{}]", lower(&a.meaning), a.unit));
            let optional = if quantity.required { "" } else { ", optional" };
            text += &format!("# {} [{}]{along}{optional}\n", quantity.meaning, quantity.unit);
            for place in &quantity.places {
                text +=
                    &format!("{},{},\n", quantity.name, place.at.map_or(String::new(), |at| at.to_string()));
            }
        }
        text
    }

    fn each<'a>(&'a self, mut row: impl FnMut(&'a Quantity, &'a Place, String)) {
        for quantity in &self.quantities {
            for place in &quantity.places {
                row(quantity, place, place.at.map_or(String::new(), |at| at.to_string()));
            }
        }
    }
}

/// The text with a small first letter.
fn lower(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}
