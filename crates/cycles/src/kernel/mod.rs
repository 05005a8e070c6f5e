//! Dislocations in a homogeneous elastic whole-space or half-space, in closed form.
//!
//! # Axes
//! The third axis z points up. The free surface of a half-space is z = 0 and its rock is z ≤ 0. In the plane, positions are
//! (x, z), and the axis out of the plane is the direction of antiplane motion. Lengths are in metres, angles in radians.
//!
//! # Signs
//! A patch has a unit normal n, which points from its minus side to its plus side. Slip is the displacement of the plus side
//! less that of the minus side. Its part along n is opening. Stress is positive in tension.
//!
//! * A [`Segment`] of the plane runs from its first end to its second along t. Its normal is n = (t_z, -t_x), so that t is n
//!   turned by a right angle, as NOTATION.md says of faults in the plane.
//! * The normal of a [`Rectangle`] is the cross product of the direction of strike and the direction up dip.
//! * The vertices of a [`Triangle`] run anticlockwise as seen from its plus side.
//!
//! # Singular points
//! Stress is infinite at the edge of a patch, and results there are infinite or not a number. Results are finite at all
//! other points, also on the continuations of sides and in the plane of a patch. On the patch itself, the displacement
//! is the mean of both sides. A half-space has no rock above its surface, where results are not a number.
//!
//! # Sources
//! The rectangle follows Okada (1992). The triangle is the artefact-free one of Nikkhoo and Walter (2015), written as
//! line integrals along its sides.

mod edge;
mod error;
mod field;
mod jet;
mod leg;
mod okada;
mod rectangle;
mod screw;
mod segment;
mod side;
mod space;
mod surface;
mod triangle;

pub use edge::Inplane;
pub use error::KernelError;
pub use field::Field;
pub use rectangle::{Placement, Rectangle};
pub use screw::Antiplane;
pub use segment::Segment;
pub use space::Space;
pub use triangle::Triangle;
