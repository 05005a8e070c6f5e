//! Results of the boundary integral, and the problem that they belong to.

use crate::CaseError;
use serde_json::Value;

/// Results of the boundary integral.
pub(crate) struct Reference(Value);

/// The problem TPV3.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parameters {
    pub density: f64,
    pub cp: f64,
    pub cs: f64,
    pub normal: f64,
    pub shear: f64,
    pub mu_s: f64,
    pub mu_d: f64,
    pub length: f64,
    /// Half length and half width of the fault \[m\].
    pub half: [f64; 2],
    /// Half side of the square of higher traction \[m\], and that traction \[Pa\].
    pub square: [f64; 2],
}

/// Slip rates that mark the front \[m/s\].
pub(crate) const FRONTS: [(&str, f64); 2] = [("0.001", 1e-3), ("0.1", 0.1)];

/// Time between values of histories \[s\].
pub(crate) const SAMPLE: f64 = 0.05;

/// A station: where it lies \[m\], slip along x \[m\] and its rate \[m/s\] through time.
#[derive(Clone, Debug)]
pub(crate) struct Station {
    pub at: [f64; 2],
    pub slip: Vec<f64>,
    pub rate: Vec<f64>,
}

/// Numbers of a list; NaN for null.
fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().map_or(&[][..], Vec::as_slice).iter().map(|v| v.as_f64().unwrap_or(f64::NAN)).collect()
}

impl Reference {
    pub fn read() -> Result<Self, CaseError> {
        Ok(Self(serde_json::from_str(include_str!("../../independent/rupture_in_space.json"))?))
    }

    pub fn parameters(&self) -> Result<Parameters, CaseError> {
        let p = &self.0["tpv3"]["parameters"];
        let get = |key: &str| {
            p[key].as_f64().ok_or_else(|| CaseError::from(format!("there is no parameter {key}")))
        };
        Ok(Parameters {
            density: get("rho_kg_m3")?,
            cp: get("cp_m_s")?,
            cs: get("cs_m_s")?,
            normal: get("sigma_pa")?,
            shear: get("tau0_pa")?,
            mu_s: get("mu_s")?,
            mu_d: get("mu_d")?,
            length: get("d_c_m")?,
            half: [get("half_x_m")?, get("half_z_m")?],
            square: [get("square_half_m")?, get("square_tau0_pa")?],
        })
    }

    /// Rupture times \[s\] at places (x, z) \[m\] of a quarter of the fault; NaN where they jump.
    pub fn times(&self, front: usize) -> Vec<([f64; 2], f64)> {
        let problem = &self.0["tpv3"];
        let (xs, zs) = (numbers(&problem["x_m"]), numbers(&problem["z_m"]));
        let values = &problem["rupture_s"][FRONTS[front].0]["extrapolated"];
        let mut all = Vec::new();
        for (z, row) in zs.iter().zip(values.as_array().map_or(&[][..], Vec::as_slice)) {
            all.extend(xs.iter().zip(numbers(row)).map(|(x, t)| ([*x, *z], t)));
        }
        all
    }

    /// Largest slip along z over that along x at the end, where the latter exceeds a tenth of its largest value.
    pub fn turning(&self) -> f64 {
        self.0["tpv3"]["turning"].as_f64().unwrap_or(f64::NAN)
    }

    pub fn stations(&self) -> Vec<Station> {
        let of = |s: &Value| {
            let at = numbers(&s["at_m"]);
            Station {
                at: std::array::from_fn(|k| at.get(k).copied().unwrap_or(f64::NAN)),
                slip: numbers(&s["slip_m"]),
                rate: numbers(&s["rate_m_s"]),
            }
        };
        self.0["tpv3"]["stations"].as_array().map_or(&[][..], Vec::as_slice).iter().map(of).collect()
    }
}
