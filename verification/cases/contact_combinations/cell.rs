//! One combination: its scene, what came of it, and the strength its law gives.

use super::super::texts::vary;
use crate::CaseError;
use asperity_driver::observe::Recorder;
use asperity_driver::report::Outcome;
use asperity_driver::{plan, run, scene};
use std::path::Path;

const SCENE: &str = include_str!("scene.toml");

/// Space the bodies live in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinematics {
    PlaneStrain,
    PlaneStress,
    Space,
}

/// What the slab is made of, and how its strain is measured.
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

/// How gaps and slip are measured.
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

    /// Way of the die, over half the slab's cells where pairs follow, and a part of a cell where they do not \[m\].
    pub fn way(self) -> f64 {
        if self.follows { 0.5 } else { 0.002 }
    }
}

/// When friction begins to act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// With the second stage.
    Smooth,
    /// With the first touch.
    Rough,
}

/// Friction laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    Coulomb,
    Capped,
    Weakening,
    Rate,
    RateCapped,
    Ageing,
    Slip,
}

/// All of them.
pub const LAWS: [Law; 7] =
    [Law::Coulomb, Law::Capped, Law::Weakening, Law::Rate, Law::RateCapped, Law::Ageing, Law::Slip];

/// Kinds of enforcement as a scene spells them.
pub const ENFORCEMENTS: [&str; 3] = ["penalty", "uzawa", "augmented-lagrangian"];

const MU: f64 = 0.4;
/// F_limit of the capped laws \[Pa\]; the mean normal traction is some 20 MPa.
const CAP: f64 = 5e6;
/// a and b.
const A: f64 = 0.015;
const B: f64 = 0.01;
/// V* \[m/s\].
const V_REF: f64 = 1e-3;

impl Law {
    /// As a table says it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Coulomb => "Coulomb",
            Self::Capped => "Coulomb, F_limit",
            Self::Weakening => "slip weakening",
            Self::Rate => "rate",
            Self::RateCapped => "rate, F_limit",
            Self::Ageing => "ageing",
            Self::Slip => "slip",
        }
    }

    /// As a scene says it, for a way \[m\] of the die: twenty lengths of its states, ten of its weakening.
    fn text(self, way: f64) -> String {
        let rate = format!("form = \"regularised\", mu0 = {MU}, a = {A}, v_ref = \"1 mm/s\"");
        let state = format!(
            "mu0 = {MU}, a = {A}, b = {B}, l = \"{} m\", v_ref = \"1 mm/s\", v_initial = \"1 mm/s\"",
            way / 20.0
        );
        match self {
            Self::Coulomb => format!("kind = \"coulomb\", mu = {MU}"),
            Self::Capped => format!("kind = \"coulomb\", mu = {MU}, f_limit = \"5 MPa\""),
            Self::Weakening => {
                format!("kind = \"slip-weakening\", mu_s = 0.44, mu_k = {MU}, d_c = \"{} m\"", way / 10.0)
            }
            Self::Rate => format!("kind = \"rate\", {rate}"),
            Self::RateCapped => format!("kind = \"rate\", {rate}, f_limit = \"5 MPa\""),
            Self::Ageing => format!("kind = \"rate-and-state\", evolution = \"ageing\", {state}"),
            Self::Slip => format!("kind = \"rate-and-state\", evolution = \"slip\", {state}"),
        }
    }

    /// Shear traction \[Pa\] of a point that has slid on at the rate \[m/s\] for many lengths, under a normal traction \[Pa\].
    pub fn strength(self, normal: f64, rate: f64) -> f64 {
        let steady = |b: f64| A * (rate / (2.0 * V_REF) * ((MU + b * (V_REF / rate).ln()) / A).exp()).asinh();
        match self {
            Self::Coulomb | Self::Weakening => MU * normal,
            Self::Capped => (MU * normal).min(CAP),
            Self::Rate => steady(0.0) * normal,
            Self::RateCapped => (steady(0.0) * normal).min(CAP),
            Self::Ageing | Self::Slip => steady(B) * normal,
        }
    }
}

/// A combination.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    pub kinematics: Kinematics,
    pub bodies: Bodies,
    pub pairing: Pairing,
    pub enforcement: &'static str,
    pub law: Law,
    pub start: Start,
    pub forward: bool,
}

/// What came of a combination.
#[derive(Clone, Debug)]
pub enum End {
    /// It ran to its end.
    Ran {
        /// Force on the die at the ends of both stages \[N, N/m\].
        forces: [[f64; 3]; 2],
        /// Largest distance of a shear traction from the strength at the end, over the largest strength.
        missed: f64,
        /// Largest residual left by a step, over the largest force.
        residual: f64,
    },
    /// It was refused, with the reason.
    Refused(String),
    /// It stopped, with the reason.
    Stopped(String),
}

impl Cell {
    fn text(&self) -> Result<String, CaseError> {
        let way = self.pairing.way();
        let law = format!("law = {{ {} }}", self.law.text(way));
        let way = format!("x = {{ to = \"{way} m\" }} }}]");
        let enforcement = format!("kind = \"{}\"", self.enforcement);
        let mut changes = vec![
            ("law = { kind = \"coulomb\", mu = 0.4 }", law.as_str()),
            ("x = { to = \"0.002 m\" } }]", way.as_str()),
        ];
        if self.enforcement != "penalty" {
            changes.push(("kind = \"penalty\"", &enforcement));
        }
        if self.enforcement == "augmented-lagrangian" {
            changes.push((", normal = \"20 E/h\", tangential = \"20 E/h\"", ""));
        }
        if self.pairing.mortar {
            changes.push(("\"node-to-point\"", "\"mortar\""));
        }
        if self.pairing.follows {
            changes.push(("sliding = \"small\"", "sliding = \"finite\""));
        }
        if self.bodies.plastic {
            let (poisson, hardening) = (
                "young = \"10 GPa\"\npoisson = 0.25",
                "young = \"10 GPa\"\npoisson = 0.25\nplasticity = { hardening = \"linear\", yield = \"20 MPa\", modulus = \"1 GPa\" }",
            );
            changes.push((poisson, hardening));
        }
        if self.bodies.finite {
            changes.push(("material = \"soft\"", "material = \"soft\"\nstrain = \"finite\""));
            changes.push(("material = \"hard\"", "material = \"hard\"\nstrain = \"finite\""));
        }
        match self.kinematics {
            Kinematics::PlaneStrain => {}
            Kinematics::PlaneStress => changes.push(("\"plane-strain\"", "\"plane-stress\"")),
            Kinematics::Space => changes.extend([
                ("\"plane-strain\"", "\"3d\""),
                ("\"quad4\"", "\"hex8\""),
                ("\"-0.5 m\"]", "\"-0.5 m\", \"0 m\"]"),
                ("\"0 m\"], divisions = [12, 3]", "\"0 m\", \"0.3 m\"], divisions = [12, 3, 1]"),
                ("min = [\"0.5 m\", \"0 m\"]", "min = [\"0.5 m\", \"0 m\", \"0 m\"]"),
                ("\"0.4 m\"], divisions = [5, 2]", "\"0.4 m\", \"0.3 m\"], divisions = [5, 2, 1]"),
                ("x = 0, y = 0 }", "x = 0, y = 0, z = 0 }"),
                ("x = 0, y = { to", "x = 0, z = 0, y = { to"),
            ]),
        }
        if self.start == Start::Smooth {
            changes.push(("name = \"press\"", "name = \"press\"\nfrictionless = [\"contact\"]"));
        }
        if self.forward {
            changes.push(("stepper = \"implicit\"\ntolerance = \"10 um\"", "stepper = \"static-explicit\""));
        }
        vary(SCENE, &changes)
    }

    /// Runs the combination.
    ///
    /// # Errors
    /// When its run cannot be set up after its plan was accepted, or has no force to show.
    pub fn end(&self) -> Result<End, CaseError> {
        let text = self.text()?;
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let planned = scene::read_in(&text, folder)
            .map_err(|e| e.to_string())
            .and_then(|scene| plan::plan(&scene).map_err(|e| e.to_string()));
        let plan = match planned {
            Ok(plan) => plan,
            Err(reason) => return Ok(End::Refused(reason.lines().next().unwrap_or_default().to_owned())),
        };
        let mut record = Recorder::new();
        let report = run::run(&plan, &mut record)?;
        if let Outcome::Stopped { reason, .. } = report.outcome {
            return Ok(End::Stopped(reason));
        }
        let forces: Vec<[f64; 3]> = report.forces.iter().map(|f| f.value).collect();
        let forces = [forces[0], forces[1]];
        let end = record.stage_end("draw").ok_or("the run has no end")?;
        let fields = &end.interfaces[0];
        let (mut missed, mut largest) = (0.0_f64, 0.0_f64);
        for (k, &normal) in fields.normal_traction.iter().enumerate().filter(|(_, f)| **f > 0.0) {
            let strength = self.law.strength(normal, fields.slip_rate[k].abs());
            missed = missed.max((fields.shear_traction[k].abs() - strength).abs());
            largest = largest.max(strength);
        }
        let residual = report.steps.iter().map(|s| s.residual_ratio).fold(0.0, f64::max);
        Ok(End::Ran { forces, missed: missed / largest, residual })
    }
}
