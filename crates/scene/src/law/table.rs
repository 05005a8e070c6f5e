//! Laws that scenes may name, as plain values: the program that reads a scene says which it knows.

/// Admissible values of a parameter; all are finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Above zero.
    Positive,
    /// Zero or above.
    NotNegative,
    /// Any.
    Finite,
    /// Zero or above, and below `mu0`.
    BelowReference,
}

/// Friction laws that the program knows. Those whose strength depends on the slip rate, and their forms, belong to the language.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Laws {
    /// Kinds of law with an elastic domain.
    pub kinds: Vec<KindRow>,
    /// Evolutions of the state.
    pub evolutions: Vec<EvolutionRow>,
}

/// An evolution of the state.
#[derive(Clone, Debug, PartialEq)]
pub struct EvolutionRow {
    /// Name.
    pub name: &'static str,
    /// Parameters that this evolution has and others have not.
    pub parameters: Vec<ParameterRow>,
    /// Reason why it has one state variable, where it may not have several.
    pub one_state: Option<&'static str>,
    /// True if memories act on the logarithm of θ, through 1/b.
    pub of_logarithm: bool,
    /// Index of the parameter that is a memory of shear traction.
    pub memory: Option<usize>,
}

/// A kind of law with an elastic domain.
#[derive(Clone, Debug, PartialEq)]
pub struct KindRow {
    /// Name.
    pub name: &'static str,
    /// Parameters, all of them needed.
    pub parameters: Vec<ParameterRow>,
    /// True if `f_limit` may cap the strength.
    pub capped: bool,
    /// Order of two parameters.
    pub order: Option<OrderRow>,
}

/// Order of two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OrderRow {
    /// Index of the lower one.
    pub lower: usize,
    /// Index of the upper one.
    pub upper: usize,
    /// True if they may be equal.
    pub equal: bool,
    /// Remedy where they are not in this order.
    pub help: &'static str,
}

/// A parameter of a law, a number or a quantity of [`LawSpec`](crate::model::LawSpec).
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRow {
    /// Key.
    pub key: &'static str,
    /// Admissible values.
    pub bound: Bound,
    /// True if it may be left out.
    pub optional: bool,
    /// A usual value, as in scenes.
    pub example: &'static str,
}

impl Laws {
    /// Returns the kind of this name.
    pub(super) fn kind(&self, name: &str) -> Option<&KindRow> {
        self.kinds.iter().find(|row| row.name == name)
    }

    /// Returns the evolution of this name.
    #[must_use]
    pub fn evolution(&self, name: &str) -> Option<&EvolutionRow> {
        self.evolutions.iter().find(|row| row.name == name)
    }

    /// Returns the names of the evolutions.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.evolutions.iter().map(|row| row.name)
    }

    /// Returns the evolution that has a parameter alone.
    pub(super) fn owner(&self, key: &str) -> Option<&'static str> {
        let owns = |row: &&EvolutionRow| row.parameters.iter().any(|p| p.key == key);
        self.evolutions.iter().find(owns).map(|row| row.name)
    }
}
