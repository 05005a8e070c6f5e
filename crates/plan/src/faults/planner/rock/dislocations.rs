//! Cells of faults as dislocations in elastic rock.

use super::super::backslip::PlateRates;
use super::super::placed_point::PlacedPoint;
use asperity_cycles::medium::patches::Patches;
use asperity_fem::material::elastic::Elastic;

/// Dislocations in homogeneous rock.
#[derive(Clone, Copy)]
pub(super) struct Dislocations<'a> {
    pub patches: &'a Patches,
    pub rock: &'a Elastic,
}

/// Points of faults that lag behind plates.
#[derive(Clone, Copy)]
pub(super) struct LaggingFaults<'a, const D: usize> {
    pub placed: &'a [PlacedPoint<D>],
    pub plates: &'a PlateRates,
}
