//! Energy budget of bodies.

use asperity_run::Energies;
use serde::{Deserialize, Serialize};

/// Energy budget since the start \[J, or J/m of thickness in plane strain and antiplane motion\]:
///
/// ```text
/// kinetic + strain + contact + springs + plastic + viscous + friction + numerical + handover + unbalanced = start + loads + motions
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy of the bodies.
    pub strain: f64,
    /// Elastic energy of the penalties of the interfaces.
    pub contact: f64,
    /// Elastic energy of the springs of load points.
    pub springs: f64,
    /// Energy dissipated by plastic flow.
    pub plastic: f64,
    /// Energy dissipated by viscous flow.
    pub viscous: f64,
    /// Energy dissipated by friction.
    pub friction: f64,
    /// Energy dissipated by the time integration.
    pub numerical: f64,
    /// Energy lost where bodies gain and lose their inertia.
    pub handover: f64,
    /// Work of forces out of balance between states of equilibrium.
    #[serde(default)]
    pub unbalanced: f64,
    /// Kinetic and elastic energy at the start.
    pub start: f64,
    /// Work of loads, weight and the initial stress of linear bodies.
    pub loads: f64,
    /// Work of prescribed motions and of load points.
    pub motions: f64,
}

impl Energy {
    /// The budget by the names of its parts. States of equilibrium have those without inertia, and motion has no forces out of
    /// balance.
    #[must_use]
    pub fn energies(&self, inertia: bool) -> Energies {
        let mut all = Energies {
            given: vec![("start", self.start), ("loads", self.loads), ("motions", self.motions)],
            kept: vec![
                ("kinetic", self.kinetic),
                ("elastic", self.strain),
                ("contact", self.contact),
                ("springs", self.springs),
            ],
            lost: vec![
                ("plastic", self.plastic),
                ("viscous", self.viscous),
                ("friction", self.friction),
                ("numerical", self.numerical),
                ("handover", self.handover),
                ("unbalanced", self.unbalanced),
            ],
            exchanged: 0.0,
        };
        let absent: &[&str] = if inertia { &["unbalanced"] } else { &["kinetic", "numerical", "handover"] };
        all.kept.retain(|part| !absent.contains(&part.0));
        all.lost.retain(|part| !absent.contains(&part.0));
        all
    }
}
