//! Zones of faults in which slip heats rock and fluid.

use super::modes::Modes;
use asperity_friction::fault::FaultLaw;
use std::f64::consts::PI;
use std::ops::Range;

/// Zone of a fault in which slip heats rock and fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Thickness h \[m\].
    pub thickness: f64,
    /// Heat capacity per volume ρ c \[J/(m³ K)\].
    pub capacity: f64,
    /// Thermal diffusivity α_th \[m²/s\].
    pub diffusivity: f64,
    /// Temperature T_0 at the start \[K\].
    pub ambient: f64,
    /// Pressure of pore fluid, where there is any.
    pub pressurisation: Option<Pressurisation>,
}

/// Pore fluid that heat expands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressurisation {
    /// Pressure per temperature without drainage, Λ \[Pa/K\].
    pub coefficient: f64,
    /// Hydraulic diffusivity α_hy \[m²/s\].
    pub diffusivity: f64,
}

impl Layer {
    /// Standard deviation w of the distribution of slip \[m\].
    #[must_use]
    pub fn width(&self) -> f64 {
        self.thickness / (2.0 * PI).sqrt()
    }
}

/// Relative difference of the two diffusivities below which they count as this far apart: the expression of p is a
/// quotient of differences. The pressure changes by less than this share.
const APART: f64 = 1e-6;

/// Points of a fault that slip heats, with their modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    pub(super) points: Range<usize>,
    /// Number of the first point among all heated points.
    pub(super) first: usize,
    pub(super) layer: Layer,
    pub(super) thermal: Modes,
    pub(super) hydraulic: Option<Hydraulic>,
    /// Position of the first mode among all modes.
    pub(super) modes: usize,
}

/// Modes of the pressure, and factors of `p = own D_hy - thermal D_th`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Hydraulic {
    pub(super) modes: Modes,
    /// \[Pa m³/J\].
    pub(super) own: f64,
    /// \[Pa m³/J\].
    pub(super) thermal: f64,
}

impl Hydraulic {
    fn new(layer: &Layer, fluid: Pressurisation, longest: f64) -> Self {
        let (own, thermal) = (fluid.diffusivity, layer.diffusivity);
        let near = (own / thermal - 1.0).abs() < APART;
        let own = if near { thermal * (1.0 + APART) } else { own };
        let factor = fluid.coefficient / (layer.capacity * (own - thermal));
        Self { modes: Modes::new(layer.width(), own, longest), own: factor * own, thermal: factor * thermal }
    }
}

impl Zone {
    /// Number of modes of a point.
    pub(super) fn stride(&self) -> usize {
        self.thermal.len() + self.hydraulic.as_ref().map_or(0, |h| h.modes.len())
    }

    /// Points of the fault.
    #[must_use]
    pub fn points(&self) -> Range<usize> {
        self.points.clone()
    }

    /// The layer.
    #[must_use]
    pub fn layer(&self) -> &Layer {
        &self.layer
    }
}

/// Heat on the points of faults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heat {
    pub(super) zones: Vec<Zone>,
}

impl Heat {
    /// Adds the zone of these points, for runs up to `longest` \[s\].
    pub fn add(&mut self, points: Range<usize>, layer: Layer, longest: f64) {
        let thermal = Modes::new(layer.width(), layer.diffusivity, longest);
        let hydraulic = layer.pressurisation.map(|fluid| Hydraulic::new(&layer, fluid, longest));
        let (first, modes) = (self.points(), self.modes());
        self.zones.push(Zone { points, first, layer, thermal, hydraulic, modes });
    }

    /// Zones.
    #[must_use]
    pub fn zones(&self) -> &[Zone] {
        &self.zones
    }

    /// Number of heated points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.zones.iter().map(|z| z.points.len()).sum()
    }

    /// Number of modes of all points.
    #[must_use]
    pub fn modes(&self) -> usize {
        self.zones.iter().map(|z| z.points.len() * z.stride()).sum()
    }

    /// Memory of the modes during a run \[bytes\]: the present ones, and copies at the last restart and for a checkpoint.
    #[must_use]
    pub fn bytes(&self) -> usize {
        3 * self.modes() * size_of::<f64>()
    }

    /// True if fluid changes normal tractions.
    #[must_use]
    pub fn pressurises(&self) -> bool {
        self.zones.iter().any(|z| z.hydraulic.is_some())
    }

    /// Heat per area at the heated points that changes ln V by about one, through the pressure or the temperature
    /// \[J/m²\].
    pub(crate) fn scales(&self, law: &dyn FaultLaw, normal: &[f64]) -> Vec<f64> {
        let of = |zone: &Zone, p: usize| {
            let Layer { thickness, capacity, ambient, .. } = zone.layer;
            let by_temperature = law.log_rate_by_temperature(p);
            let warming = if by_temperature > 0.0 { 1.0 / by_temperature } else { ambient };
            let fluid = zone.layer.pressurisation.map(|f| law.scale(p) * normal[p] / f.coefficient);
            thickness * capacity * warming.min(fluid.unwrap_or(f64::INFINITY))
        };
        self.zones.iter().flat_map(|zone| zone.points().map(move |p| of(zone, p))).collect()
    }

    /// Numbers of the heated points among all points, in order.
    pub fn heated(&self) -> impl Iterator<Item = usize> + '_ {
        self.zones.iter().flat_map(Zone::points)
    }
}
