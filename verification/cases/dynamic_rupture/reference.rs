//! Reference results, and the parameters that they belong to.

use crate::CaseError;
use serde_json::Value;

/// Results of the boundary integral.
pub(super) struct Reference(Value);

/// Friction of a problem.
#[derive(Clone, Debug)]
pub(super) enum Friction {
    SlipWeakening { mu_s: f64, mu_d: f64, length: f64, half_length: f64 },
    RateAndState { a: f64, more_a: f64, b: f64, length: f64, flash: Option<Flash>, rate: f64, pulse: Pulse },
}

/// Flash heating: V_w, its increase outside \[m/s\], and the weakened coefficient.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flash {
    pub v_w: f64,
    pub more_v_w: f64,
    pub f_w: f64,
}

/// Traction that nucleates the rupture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pulse {
    pub traction: f64,
    pub radius: f64,
    pub rise: f64,
}

/// A problem.
#[derive(Clone, Debug)]
pub(super) struct Parameters {
    pub antiplane: bool,
    pub density: f64,
    pub cp: f64,
    pub cs: f64,
    pub normal: f64,
    pub shear: f64,
    /// Patches of other initial traction: centre, half width \[m\], traction \[Pa\].
    pub patches: Vec<[f64; 3]>,
    pub f0: f64,
    pub v0: f64,
    pub friction: Friction,
    /// W and w of the smooth border of parameters \[m\].
    pub border: [f64; 2],
}

impl Parameters {
    /// True if both halves of the fault are alike.
    pub fn is_even(&self) -> bool {
        self.patches.iter().all(|[centre, ..]| *centre == 0.0)
    }

    /// Radius within which traction is imposed \[m\]; 0 without.
    pub fn nucleated(&self) -> f64 {
        match &self.friction {
            Friction::SlipWeakening { .. } => 0.0,
            Friction::RateAndState { pulse, .. } => pulse.radius,
        }
    }
}

impl Reference {
    pub fn read() -> Result<Self, CaseError> {
        Ok(Self(serde_json::from_str(include_str!("../../independent/dynamic_rupture.json"))?))
    }

    fn problem(&self, name: &str) -> &Value {
        &self.0["problems"][name]
    }

    pub fn parameters(&self, name: &str) -> Result<Parameters, CaseError> {
        let p = &self.problem(name)["parameters"];
        let of = |v: &Value, key: &str| {
            v[key].as_f64().ok_or_else(|| CaseError::from(format!("{name} has no parameter {key}")))
        };
        let get = |key: &str| of(p, key);
        let patch = |v: &Value| Ok([of(v, "centre_m")?, of(v, "half_width_m")?, of(v, "tau0_pa")?]);
        let patches = p["patches"].as_array().map_or(&[][..], Vec::as_slice).iter().map(patch);
        let friction = if p["mu_s"].is_number() {
            let (mu_s, mu_d, length) = (get("mu_s")?, get("mu_d")?, get("d_c_m")?);
            Friction::SlipWeakening { mu_s, mu_d, length, half_length: get("half_length_m")? }
        } else {
            let flash = if p["f_w"].is_number() {
                Some(Flash { v_w: get("v_w_m_s")?, more_v_w: get("delta_v_w_m_s")?, f_w: get("f_w")? })
            } else {
                None
            };
            let pulse =
                Pulse { traction: get("pulse_pa")?, radius: get("pulse_radius_m")?, rise: get("pulse_s")? };
            let (a, more_a, b) = (get("a")?, get("delta_a")?, get("b")?);
            Friction::RateAndState {
                a,
                more_a,
                b,
                length: get("L_m")?,
                flash,
                rate: get("v_ini_m_s")?,
                pulse,
            }
        };
        Ok(Parameters {
            antiplane: p["mode"] == "III",
            density: get("rho_kg_m3")?,
            cp: get("cp_m_s")?,
            cs: get("cs_m_s")?,
            normal: get("sigma_pa")?,
            shear: get("tau0_pa")?,
            patches: patches.collect::<Result<_, CaseError>>()?,
            f0: get("f0")?,
            v0: get("v0_m_s")?,
            friction,
            border: [get("W_m").unwrap_or(f64::INFINITY), get("w_m").unwrap_or(1.0)],
        })
    }

    /// Rupture times from 2 to 15 km from the hypocentre \[s\].
    pub fn times(&self, name: &str, front: &str) -> Vec<(f64, f64)> {
        let problem = self.problem(name);
        let values = &problem["rupture_s"][front]["extrapolated"];
        let places = problem["x_m"].as_array().map_or(&[][..], Vec::as_slice);
        let row = |(k, x): (usize, &Value)| Some((x.as_f64()?, values[k].as_f64()?));
        let within = |(x, _): &(f64, f64)| (2000.0..15e3).contains(&x.abs());
        places.iter().enumerate().filter_map(row).filter(within).collect()
    }

    /// Slip rates of a station through time \[s, m/s\], until the end of the runs.
    pub fn history(&self, name: &str, x: f64) -> Vec<(f64, f64)> {
        let stations = self.problem(name)["stations"].as_array().map_or(&[][..], Vec::as_slice);
        let Some(station) = stations.iter().find(|s| s["x_m"].as_f64() == Some(x)) else { return Vec::new() };
        let rates = station["rate_m_s"].as_array().map_or(&[][..], Vec::as_slice);
        let row = |(k, v): (usize, &Value)| Some((0.05 * k as f64, v.as_f64()?));
        rates.iter().enumerate().filter_map(row).take_while(|(t, _)| *t <= super::WHOLE.end).collect()
    }
}
