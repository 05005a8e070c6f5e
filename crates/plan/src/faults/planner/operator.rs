//! Source of operators.

use crate::shared::setup::Setups;
use asperity_cycles::operator::Form;

/// Form in which operators are made, and the set-ups that keep them beside a run.
#[derive(Clone, Copy)]
pub(super) struct OperatorSource<'a> {
    pub form: Form,
    pub setups: &'a Setups,
}
