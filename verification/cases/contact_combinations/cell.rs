//! One combination: its scene, its outcome, and the strength of its friction law.

use crate::CaseError;
use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use asperity_run::report::Outcome;
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;
use std::path::Path;

const SCENE: &str = include_str!("scene.toml");

/// Kinematics of the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinematics {
    PlaneStrain,
    PlaneStress,
    /// A ring that expands against a tube and slides along it.
    Axisymmetric,
    Space,
}

/// Material and strain measure of the slab.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bodies {
    pub plastic: bool,
    pub finite: bool,
}

impl Bodies {
    pub const ELASTIC: Self = Self { plastic: false, finite: false };
    pub const PLASTIC_FINITE: Self = Self { plastic: true, finite: true };
    pub const ALL: [Self; 4] = [
        Self::ELASTIC,
        Self { plastic: true, finite: false },
        Self { plastic: false, finite: true },
        Self::PLASTIC_FINITE,
    ];
}

/// Contact measure and sliding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pairing {
    pub mortar: bool,
    pub follows: bool,
}

impl Pairing {
    pub const ALL: [Self; 4] = [
        Self { mortar: false, follows: false },
        Self { mortar: false, follows: true },
        Self { mortar: true, follows: false },
        Self { mortar: true, follows: true },
    ];

    /// Travel of the die \[m\]: over half the slab's cells in finite sliding, a fraction of a cell in small sliding.
    pub fn way(self) -> f64 {
        if self.follows { 0.5 } else { 0.002 }
    }
}

/// Instant at which friction begins to act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// From the second stage on.
    Smooth,
    /// From first contact on.
    Rough,
}

/// Face of the die.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    Flat,
    /// Part of a cylinder, or of a ball in 3D; its edge never touches.
    Round,
}

/// Friction laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    Coulomb,
    Capped,
    Kinetic,
    Weakening,
    Rate,
    RateCapped,
    Ageing,
    Slip,
}

/// All friction laws.
pub const LAWS: [Law; 8] = [
    Law::Coulomb,
    Law::Capped,
    Law::Kinetic,
    Law::Weakening,
    Law::Rate,
    Law::RateCapped,
    Law::Ageing,
    Law::Slip,
];

/// Kinds of enforcement as a scene spells them.
pub const ENFORCEMENTS: [&str; 3] = ["penalty", "uzawa", "augmented-lagrangian"];

const UZAWA: &str =
    "{ kind = \"uzawa\", normal = \"20 E/h\", tangential = \"20 E/h\", penetration = \"1e-9 h\" }";
const UNKNOWNS: &str = "{ kind = \"augmented-lagrangian\", normal = \"1 E/h\", tangential = \"1 E/h\" }";

/// Step limit where bodies yield, or where points close under friction within implicit steps (static-explicit steps end at each
/// closing). No error estimate covers either. Plastic flow over half a metre of sliding causes an error of 1e-3 of the force in
/// both steppers at the default step of a twentieth of a stage, 4e-5 in steps of 20 ms, and 1e-5 in steps of 5 ms.
const SHORT_STEPS: Change<'_> = Add("time.max_step", "5 ms");
/// The same for plastic bodies in 3D, where a step costs ten times as much.
const SHORT_STEPS_IN_SPACE: Change<'_> = Add("time.max_step", "20 ms");

const MU: f64 = 0.4;
/// Static friction coefficient of the static-kinetic law.
const STATIC: f64 = 0.44;
/// F_limit of the capped laws \[Pa\]; the mean normal traction is about 20 MPa.
const CAP: f64 = 5e6;
/// a and b.
const A: f64 = 0.015;
const B: f64 = 0.01;
/// V* \[m/s\].
const V_REF: f64 = 1e-3;

impl Law {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Coulomb => "Coulomb",
            Self::Capped => "Coulomb, F_limit",
            Self::Kinetic => "static-kinetic",
            Self::Weakening => "slip weakening",
            Self::Rate => "rate",
            Self::RateCapped => "rate, F_limit",
            Self::Ageing => "ageing",
            Self::Slip => "slip",
        }
    }

    /// Text in a scene, for a travel of the die \[m\] of twenty state evolution distances or ten weakening distances.
    fn text(self, way: f64) -> String {
        let rate = format!("form = \"regularised\", mu0 = {MU}, a = {A}, v_ref = \"1 mm/s\"");
        let state = format!(
            "mu0 = {MU}, a = {A}, b = {B}, l = \"{} m\", v_ref = \"1 mm/s\", v_initial = \"1 mm/s\"",
            way / 20.0
        );
        match self {
            Self::Coulomb => format!("kind = \"coulomb\", mu = {MU}"),
            Self::Capped => format!("kind = \"coulomb\", mu = {MU}, f_limit = \"5 MPa\""),
            Self::Kinetic => format!("kind = \"static-kinetic\", mu_s = {STATIC}, mu_k = {MU}"),
            Self::Weakening => {
                format!("kind = \"slip-weakening\", mu_s = {STATIC}, mu_k = {MU}, d_c = \"{} m\"", way / 10.0)
            }
            Self::Rate => format!("kind = \"rate\", {rate}"),
            Self::RateCapped => format!("kind = \"rate\", {rate}, f_limit = \"5 MPa\""),
            Self::Ageing => format!("kind = \"rate-and-state\", evolution = \"ageing\", {state}"),
            Self::Slip => format!("kind = \"rate-and-state\", evolution = \"slip\", {state}"),
        }
    }

    /// Contribution of the state to friction: of a state variable in output form, or in steady state at a rate.
    fn state_friction(self, state: Option<f64>, rate: f64) -> f64 {
        match (self, state) {
            (Self::Ageing, Some(psi)) => B * psi,
            (Self::Slip, Some(friction)) => friction,
            (Self::Ageing | Self::Slip, None) => B * (V_REF / rate).ln(),
            _ => 0.0,
        }
    }

    /// Shear traction \[Pa\] of a point that slides at a rate \[m/s\] under a normal traction \[Pa\], with the given state or in
    /// steady state.
    pub fn strength(self, normal: f64, rate: f64, state: Option<f64>) -> f64 {
        let friction =
            A * (rate / (2.0 * V_REF) * ((MU + self.state_friction(state, rate)) / A).exp()).asinh();
        match self {
            Self::Coulomb | Self::Kinetic | Self::Weakening => MU * normal,
            Self::Capped => (MU * normal).min(CAP),
            Self::RateCapped => (friction * normal).min(CAP),
            Self::Rate | Self::Ageing | Self::Slip => friction * normal,
        }
    }

    /// Difference between a shear traction and the strength. A point at rest bears any traction up to the static strength; under
    /// the static-kinetic law a point may come to rest again while others slide.
    fn distance(self, shear: f64, strength: f64, normal: f64, rests: bool) -> f64 {
        if self == Self::Kinetic && rests {
            (shear - STATIC * normal).max(0.0)
        } else {
            (shear - strength).abs()
        }
    }

    /// True if the law has a state that evolves with slip over a characteristic distance.
    pub fn evolves(self) -> bool {
        matches!(self, Self::Ageing | Self::Slip)
    }
}

/// A combination.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    pub kinematics: Kinematics,
    pub face: Face,
    pub bodies: Bodies,
    pub pairing: Pairing,
    pub enforcement: &'static str,
    pub law: Law,
    pub start: Start,
    pub forward: bool,
}

/// Outcome of a combination.
#[derive(Clone, Debug)]
pub enum End {
    /// It completed.
    Ran {
        /// Force on the die at the ends of both stages \[N, N/m\].
        forces: [[f64; 3]; 2],
        /// Largest difference between shear traction and strength at the end, at each point's rate and state, over the largest
        /// strength.
        missed: f64,
        /// The same with the strength in steady state, if there is one.
        unsteady: Option<f64>,
        /// Largest residual left by a step, over the largest force.
        residual: f64,
    },
    /// It was refused for this reason.
    Refused(String),
    /// It stopped for this reason.
    Stopped(String),
}

/// The axisymmetric scene: a ring in place of the die, expanded against a tube.
const AXIS: [Change<'_>; 15] = [
    With("kinematics", "axisymmetric"),
    With("bodies.slab.mesh.block.min", r#"["1.4 m", "0 m"]"#),
    With("bodies.slab.mesh.block.max", r#"["1.9 m", "2 m"]"#),
    With("bodies.slab.mesh.block.divisions", "[3, 12]"),
    With("bodies.die.mesh.block.min", r#"["1 m", "0.5 m"]"#),
    With("bodies.die.mesh.block.max", r#"["1.4 m", "1.3 m"]"#),
    With("bodies.die.mesh.block.divisions", "[2, 5]"),
    With("interfaces.contact.slave", "die.right"),
    With("interfaces.contact.master", "slab.left"),
    With("stages[0].conditions[0].set", "slab.right"),
    With("stages[0].conditions[1].set", "die.left"),
    With("stages[0].conditions[1].x", r#"{ to = "1 mm" }"#),
    With("stages[0].conditions[1].y", "0"),
    With("stages[1].conditions[0].set", "die.left"),
    With("output.forces.die.set", "die.left"),
];

/// The scene in 3D.
const SPACE: [Change<'_>; 11] = [
    With("kinematics", "3d"),
    With("bodies.slab.mesh.block.element", "hex8"),
    With("bodies.slab.mesh.block.min", r#"["0 m", "-0.5 m", "0 m"]"#),
    With("bodies.slab.mesh.block.max", r#"["2 m", "0 m", "0.3 m"]"#),
    With("bodies.slab.mesh.block.divisions", "[12, 3, 1]"),
    With("bodies.die.mesh.block.element", "hex8"),
    With("bodies.die.mesh.block.min", r#"["0.5 m", "0 m", "0 m"]"#),
    With("bodies.die.mesh.block.max", r#"["1.3 m", "0.4 m", "0.3 m"]"#),
    With("bodies.die.mesh.block.divisions", "[5, 2, 1]"),
    Add("stages[0].conditions[0].z", "0"),
    Add("stages[0].conditions[1].z", "0"),
];

impl Cell {
    /// Text of its scene.
    ///
    /// # Errors
    /// If the scene lacks a key that is varied.
    pub fn text(&self) -> Result<String, CaseError> {
        let way = self.pairing.way();
        let mut scene = self
            .in_space(SceneText::new(SCENE))
            .with_or_same("interfaces.contact.law", format!("{{ {} }}", self.law.text(way)));
        match self.enforcement {
            "uzawa" => scene = scene.with("interfaces.contact.enforcement", UZAWA),
            "augmented-lagrangian" => scene = scene.with("interfaces.contact.enforcement", UNKNOWNS),
            _ => {}
        }
        if self.pairing.mortar {
            scene = scene.with("interfaces.contact.measure", "mortar");
        }
        if self.pairing.follows {
            scene = scene.with("interfaces.contact.sliding", "finite");
        }
        if self.bodies.plastic {
            let hardening = r#"{ hardening = "linear", yield = "20 MPa", modulus = "1 GPa" }"#;
            scene = scene.add("materials.soft.plasticity", hardening);
        }
        if self.bodies.finite {
            scene = scene.add("bodies.slab.strain", "finite").add("bodies.die.strain", "finite");
        }
        if self.start == Start::Smooth {
            scene = scene.add("stages[0].frictionless", r#"["contact"]"#);
        }
        if self.forward {
            scene = scene.with("time.stepper", "static-explicit").without("time.tolerance");
        }
        let closes = !self.forward && self.face == Face::Round && self.start == Start::Rough;
        if closes || self.bodies.plastic && self.kinematics != Kinematics::Space {
            scene = scene.changed(&[SHORT_STEPS]);
        } else if self.bodies.plastic {
            scene = scene.changed(&[SHORT_STEPS_IN_SPACE]);
        }
        Ok(scene.text()?)
    }

    /// The scene with the kinematics, face and travel of the die.
    fn in_space(&self, scene: SceneText) -> SceneText {
        let way = format!("{{ to = \"{} m\" }}", self.pairing.way());
        let drawn = "stages[1].conditions[0]";
        let scene = match self.kinematics {
            Kinematics::PlaneStrain => scene.with_or_same(&format!("{drawn}.x"), way),
            Kinematics::PlaneStress => {
                scene.with("kinematics", "plane-stress").with_or_same(&format!("{drawn}.x"), way)
            }
            Kinematics::Axisymmetric => {
                scene.changed(&AXIS).without(&format!("{drawn}.x")).add(&format!("{drawn}.y"), way)
            }
            Kinematics::Space => scene.changed(&SPACE).with_or_same(&format!("{drawn}.x"), way),
        };
        if self.face == Face::Flat {
            return scene;
        }
        let apex = if self.kinematics == Kinematics::Space { "x = 0.9, z = 0.15" } else { "x = 0.9" };
        let circle = format!("{{ kind = \"circle\", radius = \"40 m\", apex = {{ {apex} }} }}");
        scene.add("bodies.die.mesh.block.curves", format!("{{ bottom = {circle} }}"))
    }

    /// Runs the combination.
    ///
    /// # Errors
    /// If the run cannot be set up after its plan was accepted, or records no force.
    pub fn end(&self) -> Result<End, CaseError> {
        let text = self.text()?;
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let planned = scene::read_in(&text, folder)
            .map_err(|e| e.to_string())
            .and_then(|scene| bodies::plan(&scene).map_err(|e| e.to_string()));
        let plan = match planned {
            Ok(plan) => plan,
            Err(reason) => return Ok(End::Refused(reason.lines().next().unwrap_or_default().to_owned())),
        };
        let mut record = Recorder::new();
        let report = kinds::bodies::run(&plan, &mut record)?;
        if let Outcome::Stopped { reason, .. } = report.outcome {
            return Ok(End::Stopped(reason));
        }
        let forces: Vec<[f64; 3]> = report.forces.iter().map(|f| f.value).collect();
        let forces = [forces[0], forces[1]];
        let end = record.stage_end("draw").ok_or("the run has no end")?;
        let fields = &end.interfaces[0];
        let (mut missed, mut unsteady, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (k, &normal) in fields.normal_traction.iter().enumerate().filter(|(_, f)| **f > 0.0) {
            let state = fields.states.first().map(|s| s[k]);
            let (rate, shear) = (fields.slip_rate[k].abs(), fields.shear_traction[k].abs());
            let [own, steady] = [state, None].map(|s| self.law.strength(normal, rate, s));
            missed = missed.max(self.law.distance(shear, own, normal, fields.status[k] == 1));
            unsteady = unsteady.max((shear - steady).abs());
            largest = largest.max(own);
        }
        // Points of a round face are loaded and unloaded as they pass nodes, so that their rates and states never become steady.
        let settles = self.law.evolves() && self.face == Face::Flat;
        let residual = report.steps.iter().map(|s| s.residual_ratio).fold(0.0, f64::max);
        Ok(End::Ran {
            forces,
            missed: missed / largest,
            unsteady: settles.then_some(unsteady / largest),
            residual,
        })
    }
}
