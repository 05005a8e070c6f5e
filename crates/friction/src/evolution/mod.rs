//! Evolution of the state: one law per file. Each has its exact step at constant V, and a variable that represents thirty
//! decades of state without loss of precision.
//!
//! A new law is one short file: its row of the table ([`Definition`]), the contribution φ(s) of its variable s, the steady state, the rate,
//! and the step. Its type is then listed in [`each_evolution`](crate::each_evolution).

pub mod ageing;
mod definition;
pub mod flash;
pub mod nagata;
pub mod prz;
mod relaxation;
pub mod slip;
mod state;
pub mod stateless;
mod table;

/// Evaluates an expression once for each evolution of the table; the given name represents its type.
#[macro_export]
macro_rules! each_evolution {
    ($law:ident => $do:expr) => {
        $crate::each_evolution!($law => $do; ageing::Ageing, slip::Slip, prz::Prz, nagata::Nagata, flash::Flash)
    };
    ($law:ident => $do:expr; $($module:ident::$name:ident),*) => {
        $({
            type $law = $crate::evolution::$module::$name;
            $do
        })*
    };
}

pub use definition::{Bound, Common, Definition, Front, Parameter, TableEvolution, Unit, Variable};
pub(crate) use state::AT_REST;
pub use state::{Evolution, Rate, Speed, StateUpdate};
pub use table::{Visit, definition, definitions, with};
