//! The specification of an interface, as plain values.

pub use crate::measure::mortar::Mirror;
use asperity_friction::law::{Law, RateBounds};
use std::sync::Arc;

/// Methods of enforcing the contact constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Enforcement {
    /// Tractions proportional to the penetration and to the elastic part of the tangential motion.
    #[default]
    Penalty,
    /// Penalty tractions about multipliers. The multipliers are set to the tractions found until these no longer change
    /// (Uzawa's method; Hestenes 1969, Powell 1969; with friction Simo and Laursen 1992).
    Uzawa {
        /// Largest admissible penetration, and largest admissible elastic part of the tangential motion of a step \[m\].
        tolerance: f64,
        /// Most augmentations per step.
        most: usize,
    },
    /// Multipliers that are unknowns of the system (Alart and Curnier 1991). The constraints hold to rounding, and the
    /// penalties only decide on which side of a kink an iterate lies.
    AugmentedLagrangian {
        /// First degree of freedom of the unknowns. Each slave point has one unknown, or D with a law, one point after another.
        first: usize,
        /// Stiffness that scales tractions to lengths of the size of displacements: Young's modulus over the element size
        /// \[Pa/m\].
        unit: f64,
    },
}

/// A node of the slave or master side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceNode<const D: usize> {
    /// Reference position \[m\].
    pub position: [f64; D],
    /// First of its `D` consecutive degrees of freedom in the system vector.
    pub dof: usize,
    /// Mesh node number, for messages.
    pub label: usize,
}

/// A slave node with its tributary area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlavePoint {
    /// Index into the nodes of the interface.
    pub node: usize,
    /// Tributary area \[m²; m per unit of thickness in two dimensions\], positive. A mortar measure computes its own areas
    /// instead.
    pub area: f64,
}

/// A segment of a surface. In two dimensions its nodes are ordered so that the outward normal is `(e_y, -e_x)/|e|` with
/// `e = x_2 - x_1` (the body lies to the left of the edge). In three dimensions the normal is along `e_1 × e_2`
/// (counter-clockwise seen from outside).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segment {
    /// Kind of the segment.
    pub kind: crate::SegmentKind,
    /// Indices into the nodes of the interface, in the order of the kind.
    pub nodes: Vec<usize>,
}

/// Sliding: small, with fixed pairing and normals, or finite, with both following the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sliding {
    /// Pairing, normals, tangents and weights fixed in the reference configuration.
    Small,
    /// Pairing and normals that follow the motion.
    Finite,
}

/// Measure of gaps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeasureKind {
    /// Slave nodes against their closest points on the master.
    NodeToPoint,
    /// Overlaps of slave and master facets, with the gap averaged to slave nodes.
    Mortar {
        /// Slave facets, oriented as master segments are (outward of the slave body). Points at their nodes take their areas
        /// from the overlap. Facet nodes that are not slave points (the tip of a split surface) leave their share to the
        /// others.
        faces: Vec<Segment>,
        /// True if the first coordinate is the radius of a body of revolution. Areas are then those of the full circle.
        axisymmetric: bool,
        /// Planes of symmetry of both sides through each slave point; empty: none through any.
        mirrors: Vec<Mirror>,
    },
}

/// Smoothing of a master surface of first-order segments by cubic patches that share a tangent plane at their nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothing {
    /// Edges across which the reference normals turn by more than this angle stay sharp \[rad\].
    pub crease: f64,
}

impl Default for Smoothing {
    /// 45 degrees: a circle of nine facets is smoothed, and the corner of a block is not.
    fn default() -> Self {
        Self { crease: std::f64::consts::FRAC_PI_4 }
    }
}

/// Time rule for the slip rate of implicit steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeRule {
    /// V = Δλ/Δt.
    #[default]
    BackwardEuler,
    /// Two-step backward difference with variable step. The first step of a law is backward Euler.
    Bdf2,
}

/// Complete specification of an interface.
#[derive(Clone, Debug)]
pub struct InterfaceSpec<const D: usize> {
    /// Name for reports.
    pub name: String,
    /// Nodes of both sides.
    pub nodes: Vec<SurfaceNode<D>>,
    /// Slave side.
    pub slave: Vec<SlavePoint>,
    /// Master side.
    pub master: Vec<Segment>,
    /// Measure of gaps.
    pub measure: MeasureKind,
    /// Small or finite sliding.
    pub sliding: Sliding,
    /// Smoothing of the master surface; `None` leaves the segments as they are.
    pub smoothing: Option<Smoothing>,
    /// Normal of every pair in place of the segments' own, outward of the master, of any nonzero length (small sliding only).
    pub fixed_normal: Option<[f64; D]>,
    /// Enforcement of the constraints.
    pub enforcement: Enforcement,
    /// Normal penalty E_n \[Pa/m\].
    pub normal_penalty: f64,
    /// Tangential penalty E_t \[Pa/m\]; unused without a law.
    pub tangential_penalty: f64,
    /// Young's modulus over the element size of the softer side \[Pa/m\], which weighs motions against tractions in iterations.
    pub young_per_size: f64,
    /// Friction; `None` = frictionless.
    pub law: Option<Arc<dyn Law>>,
    /// Size of the scene \[m\], which scales the closure tolerance.
    pub scale: f64,
    /// Forward steps: slip rates below this value count as rest \[m/s\].
    pub rate_floor: f64,
    /// Forward steps: bounds of limit r8.
    pub rate_bounds: RateBounds,
    /// For laws without an elastic domain: the largest prescribed rate \[m/s\]. A point slower than 1e-6 of it is labelled
    /// stick. `None` for yield-surface laws, whose regime is the label.
    pub label_rate: Option<f64>,
}
