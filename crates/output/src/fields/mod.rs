//! Fields for ParaView.

pub mod vtu;
