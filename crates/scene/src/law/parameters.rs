//! Parameters given in a specification, with their positions.

use crate::model::{LawSpec, Spanned};
use crate::units::{Length, Pressure, Velocity};
use std::ops::Range;

/// A value of the specification, convertible to SI units.
pub(super) trait Quantity: Copy {
    fn si(self) -> f64;
}

impl Quantity for f64 {
    fn si(self) -> f64 {
        self
    }
}

macro_rules! quantities {
    ($($name:ident)*) => {$(
        impl Quantity for $name {
            fn si(self) -> f64 {
                self.0
            }
        }
    )*};
}

quantities!(Length Pressure Velocity);

/// Keys with the positions of their values, if given.
macro_rules! places {
    ($law:ident: $($key:ident)*) => {
        [$((stringify!($key), $law.$key.as_ref().map(Spanned::span))),*]
    };
}

/// Parameters that are given, with their positions, in the order of the specification.
#[must_use]
pub fn given(law: &LawSpec) -> Vec<(&'static str, Range<usize>)> {
    let places = places!(law: mu mu_s mu_k d_c cohesion form evolution mu0 a b l v_ref v_initial v_cut v_cut_state alpha normal_initial
                         c mu_w v_w activation t_ref temperature f_limit);
    places.into_iter().filter_map(|(name, place)| place.map(|p| (name, p))).collect()
}

/// SI value and position of a parameter that is a single number; `None` if absent.
pub(super) fn scalar(law: &LawSpec, key: &str) -> Option<(f64, Range<usize>)> {
    macro_rules! of {
        ($($name:ident)*) => {
            match key {
                $(stringify!($name) => law.$name.as_ref().map(|v| (v.get_ref().si(), v.span())),)*
                _ => None,
            }
        };
    }
    of!(mu mu_s mu_k d_c cohesion v_cut_state c mu_w v_w)
}
