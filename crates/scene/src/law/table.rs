//! Tables of the laws that scenes may name, as plain values supplied by the program.

/// Admissible values of a parameter; all of them are finite.
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

/// Friction laws known to the program. Laws whose strength depends on the slip rate, and their forms, are built into the scene
/// language and not listed here.
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
    /// Parameters specific to this evolution.
    pub parameters: Vec<ParameterRow>,
    /// Reason why only one state variable is admitted; `None` if several are.
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
    /// Parameters; optional ones are zero where they are absent.
    pub parameters: Vec<ParameterRow>,
    /// True if `f_limit` may cap the strength.
    pub capped: bool,
    /// Required order of two parameters, if any.
    pub order: Option<OrderRow>,
}

/// Required order of two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OrderRow {
    /// Index of the lower one.
    pub lower: usize,
    /// Index of the upper one.
    pub upper: usize,
    /// True if they may be equal.
    pub equal: bool,
    /// Suggested remedy if the order is violated.
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
    /// A typical value, as written in scenes.
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

    /// Returns the evolution to which a parameter is specific.
    pub(super) fn owner(&self, key: &str) -> Option<&'static str> {
        let owns = |row: &&EvolutionRow| row.parameters.iter().any(|p| p.key == key);
        self.evolutions.iter().find(owns).map(|row| row.name)
    }
}
