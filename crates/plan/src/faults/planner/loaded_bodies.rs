//! Bodies under their loads.

use crate::shared::loading::Stage;
use crate::shared::model::Model;

/// Bodies under the loads of a stage.
#[derive(Clone, Copy)]
pub(super) struct LoadedBodies<'a, const D: usize> {
    pub model: &'a Model<D>,
    pub stage: &'a Stage,
}
