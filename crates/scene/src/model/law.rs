//! Friction laws as declared in a scene.

use crate::key_default::usual;
use crate::kind;
use crate::spanned::Spanned;
use crate::state_values::Several;
use crate::units::{Length, Pressure, Velocity};
use schemars::JsonSchema;
use serde::Deserialize;

/// A friction law as written in a scene. The plan checks which parameters belong to which kind.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LawSpec {
    /// coulomb, static-kinetic, slip-weakening, rate, rate-and-state, tied.
    pub kind: Option<Spanned<String>>,
    /// Coulomb: friction coefficient \[-\].
    pub mu: Option<Spanned<f64>>,
    /// Static-kinetic, slip-weakening: coefficient before slip \[-\].
    pub mu_s: Option<Spanned<f64>>,
    /// Static-kinetic, slip-weakening: coefficient during or after slip \[-\].
    pub mu_k: Option<Spanned<f64>>,
    /// Slip-weakening: slip over which the coefficient falls \[m\].
    pub d_c: Option<Spanned<Length>>,
    /// Coulomb, slip-weakening: shear traction that a closed point carries at no normal traction \[Pa\].
    pub cohesion: Option<Spanned<Pressure>>,
    /// Strength form: regularised, bare or cut-off.
    #[schemars(extend("x-default" = usual("regularised").only("with laws of the slip rate")))]
    pub form: Option<Spanned<String>>,
    /// State evolution: ageing, slip, prz, nagata or flash.
    pub evolution: Option<Spanned<String>>,
    /// Reference coefficient μ0 \[-\].
    pub mu0: Option<Spanned<f64>>,
    /// Direct effect a \[-\].
    pub a: Option<Spanned<f64>>,
    /// Evolution effect b \[-\], of each state variable.
    pub b: Option<Spanned<Several<f64>>>,
    /// Characteristic slip L \[m\], of each state variable.
    pub l: Option<Spanned<Several<Length>>>,
    /// Reference slip rate Vref \[m/s\].
    pub v_ref: Option<Spanned<Velocity>>,
    /// Initial state: slip rate at which the point was in steady state \[m/s\].
    pub v_initial: Option<Spanned<Velocity>>,
    /// Form cut-off: cut-off rate V1 of the direct effect \[m/s\].
    pub v_cut: Option<Spanned<Velocity>>,
    /// Evolution ageing: cut-off rate V2 of the state effect \[m/s\].
    pub v_cut_state: Option<Spanned<Velocity>>,
    /// Memory of normal traction α \[-\], of each state variable.
    #[schemars(extend("x-default" = usual(0).only("with a state variable")))]
    pub alpha: Option<Spanned<Several<f64>>>,
    /// With α > 0: normal traction under which the point was in steady state \[Pa\].
    pub normal_initial: Option<Spanned<Pressure>>,
    /// Evolution nagata: memory of shear traction c \[-\].
    pub c: Option<Spanned<f64>>,
    /// Evolution flash: fully weakened coefficient μ_w \[-\].
    pub mu_w: Option<Spanned<f64>>,
    /// Evolution flash: slip rate V_w at which weakening begins \[m/s\].
    pub v_w: Option<Spanned<Velocity>>,
    /// Activation energy Q \[J/mol\].
    pub activation: Option<Spanned<f64>>,
    /// Temperature for which the parameters hold \[K\].
    pub t_ref: Option<Spanned<f64>>,
    /// Temperature \[K\].
    pub temperature: Option<Spanned<f64>>,
    /// F_limit: largest shear traction \[Pa\].
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-instead" = "a smaller `normal` or `mu0` lowers the strength of a fault"))]
    pub f_limit: Option<Spanned<Pressure>>,
}
