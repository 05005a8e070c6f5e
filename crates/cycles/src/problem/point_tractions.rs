//! Tractions at a moment, and what processes show.

/// Normal tractions of the points of a fault at a moment, and what its processes show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointTractions {
    /// f_n as friction uses it \[Pa\].
    pub normal: Vec<f64>,
    /// Values of processes at all points.
    pub fields: Vec<Field>,
}

impl PointTractions {
    /// Values of a quantity at all points; none if no process shows it.
    #[must_use]
    pub fn values(&self, quantity: &Quantity) -> &[f64] {
        self.fields.iter().find(|f| f.quantity == quantity).map_or(&[], |f| &f.values)
    }
}

/// A quantity that a process shows at the points of faults.
#[derive(Debug, PartialEq)]
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Meaning.
    pub meaning: &'static str,
    /// Value that events record, if they do.
    pub over_events: Option<OverEvents>,
}

/// A value of a quantity that events record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverEvents {
    /// Its change at each point.
    Change,
    /// Its largest value at any point at the ends of steps.
    Largest,
}

/// Values of a quantity at all points.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The quantity.
    pub quantity: &'static Quantity,
    /// Values; NaN at points that have none.
    pub values: Vec<f64>,
}
