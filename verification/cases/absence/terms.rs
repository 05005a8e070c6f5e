//! Terms that a scene may declare, and the source files that compute them.

use super::callgrind::Instructions;
use std::path::Path;

/// A term of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// Bodies with stiffness.
    Bodies,
    /// Bodies that store their stress: plastic, viscous or of finite strain.
    History,
    /// Plasticity.
    Plasticity,
    /// Viscosity.
    Viscosity,
    /// Iterative solution of linear systems.
    IterativeSolver,
    /// Contact.
    Contact,
    /// Mortar contact.
    Mortar,
    /// Node-to-point contact with finite sliding.
    FinitePoints,
    /// A friction law.
    Friction,
    /// State variables of friction.
    Evolution,
    /// Faults of condensed bodies.
    Faults,
    /// Spring-sliders.
    Sliders,
    /// Injected fluid.
    Fluid,
    /// Pictures.
    Plots,
}

impl Term {
    /// All terms.
    pub const ALL: [Self; 14] = [
        Self::Bodies,
        Self::History,
        Self::Plasticity,
        Self::Viscosity,
        Self::IterativeSolver,
        Self::Contact,
        Self::Mortar,
        Self::FinitePoints,
        Self::Friction,
        Self::Evolution,
        Self::Faults,
        Self::Sliders,
        Self::Fluid,
        Self::Plots,
    ];

    /// Name on the report page.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bodies => "bodies",
            Self::History => "stress history",
            Self::Plasticity => "plasticity",
            Self::Viscosity => "viscosity",
            Self::IterativeSolver => "iterative solver",
            Self::Contact => "contact",
            Self::Mortar => "mortar",
            Self::FinitePoints => "finite sliding of points",
            Self::Friction => "friction",
            Self::Evolution => "state evolution",
            Self::Faults => "faults",
            Self::Sliders => "spring-sliders",
            Self::Fluid => "fluid",
            Self::Plots => "plots",
        }
    }

    /// Prefixes of the paths of the files that compute it.
    fn files(self) -> &'static [&'static str] {
        match self {
            Self::Bodies => &["crates/fem/src/"],
            Self::History => &["crates/fem/src/nonlinear/", "crates/fem/src/material/constitutive.rs"],
            Self::Plasticity => &["crates/fem/src/material/j2.rs", "crates/fem/src/material/hardening.rs"],
            Self::Viscosity => &["crates/fem/src/material/maxwell.rs"],
            Self::IterativeSolver => &["crates/fem/src/iterative/"],
            Self::Contact => &["crates/contact/src/"],
            Self::Mortar => &["crates/contact/src/measure/mortar/"],
            Self::FinitePoints => &[
                "crates/contact/src/measure/node_to_point/finite.rs",
                "crates/contact/src/measure/node_to_point/track.rs",
            ],
            Self::Friction => &["crates/friction/src/"],
            Self::Evolution => &["crates/friction/src/evolution/", "crates/friction/src/component.rs"],
            Self::Faults => &[
                "crates/cycles/src/operator/",
                "crates/cycles/src/medium/condensed.rs",
                "crates/cycles/src/course/cycle.rs",
                "crates/cycles/src/equations/",
            ],
            Self::Sliders => &["crates/cycles/src/slider/"],
            Self::Fluid => &["crates/cycles/src/processes/injection.rs"],
            Self::Plots => &["crates/output/src/figures/png.rs", "crates/output/src/figures/svg.rs"],
        }
    }

    /// File that is named and does not exist, so that its instructions would always be none.
    pub fn missing() -> Option<&'static str> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?;
        Self::ALL
            .iter()
            .flat_map(|term| term.files())
            .chain(&NO_TERM)
            .copied()
            .find(|file| !root.join(file).exists())
    }

    /// Instructions of the term in a run.
    pub fn instructions(self, run: &Instructions) -> u64 {
        let is_of = |path: &str| self.files().iter().any(|f| path.starts_with(f)) && !NO_TERM.contains(&path);
        run.iter().filter(|(path, _)| is_of(path)).map(|(_, count)| count).sum()
    }
}

/// Files that compute no term: the tables of the names of laws, which the scene reader consults before it reads a scene, and the
/// list of state variables of a point, which may be empty.
const NO_TERM: [&str; 3] = [
    "crates/friction/src/kind.rs",
    "crates/friction/src/evolution/table.rs",
    "crates/friction/src/evolution/state.rs",
];
