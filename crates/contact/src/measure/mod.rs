//! Measures of gaps and slip, and the action of tractions on the nodes of an interface.
//!
//! A measure is called once per operation for the whole interface, through `dyn`. The interface stores tangential history as
//! two components in an orthonormal frame that is carried with the master surface. Only the frame is affected by rotation.

mod bound;
pub mod fixed_measure;
pub mod measure_state;
pub mod mortar;
pub mod node_to_point;

use asperity_fem::relative::RelativeDisplacements;
use asperity_fem::term::Pattern;
use measure_state::MeasureState;
use std::fmt;

/// Present geometry of all slave points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry<const D: usize> {
    /// True if the point has a partner on the master side.
    pub paired: Vec<bool>,
    /// Gap g_n = n·(x_s - x_c) \[m\]; infinite if unpaired.
    pub gap: Vec<f64>,
    /// Outward unit normal n of the master.
    pub normal: Vec<[f64; D]>,
    /// Orthonormal tangents: the frame of the last commit, carried to the present configuration. In two dimensions the first is
    /// `e_1 = (-n_y, n_x)` and the second is zero.
    pub frame: Vec<[[f64; D]; 2]>,
    /// Tangential displacement of the slave relative to the master since the last commit \[m\], as components in `frame`.
    pub increment: Vec<[f64; 2]>,
}

impl<const D: usize> Geometry<D> {
    /// Geometry of `n` points, all unpaired.
    #[must_use]
    pub fn new(n: usize) -> Self {
        Self {
            paired: vec![false; n],
            gap: vec![f64::INFINITY; n],
            normal: vec![[0.0; D]; n],
            frame: vec![[[0.0; D]; 2]; n],
            increment: vec![[0.0; 2]; n],
        }
    }

    /// Vector with components `c` in the frame of point `p`.
    #[inline]
    #[must_use]
    pub fn tangential(&self, p: usize, c: &[f64; 2]) -> [f64; D] {
        let f = &self.frame[p];
        std::array::from_fn(|i| c[0] * f[0][i] + c[1] * f[1][i])
    }
}

/// Contribution of a point's normal traction to the tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NormalPoint {
    /// True if the point is closed. An open point has no traction and no stiffness.
    pub closed: bool,
    /// Normal traction f_n \[Pa\].
    pub traction: f64,
    /// Stiffness -∂f_n/∂g_n \[Pa/m\].
    pub stiffness: f64,
}

/// Contribution of a point's shear traction to the tangent, as components in the carried frame:
/// `dt = ratio (I - η⊗η) dt^e + η (d_trial η·dt^e + d_normal df_n)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShearPoint {
    /// Shear traction t \[Pa\].
    pub traction: [f64; 2],
    /// Direction η = t^e/|t^e|, zero at t^e = 0.
    pub direction: [f64; 2],
    /// Ratio τ/|t^e| \[-\].
    pub ratio: f64,
    /// Derivative ∂τ/∂|t^e| \[-\].
    pub d_trial: f64,
    /// Derivative ∂τ/∂f_n \[-\].
    pub d_normal: f64,
}

/// Tractions of all points and their derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Tractions<'a> {
    /// Normal part.
    pub normal: &'a [NormalPoint],
    /// Tangential part, if there is friction.
    pub shear: Option<&'a [ShearPoint]>,
    /// Tangential penalty E_t \[Pa/m\], used if there is friction.
    pub stiffness: f64,
}

/// Increments of a forward step, by the linearised geometry.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slides {
    /// Gap increment dg_n \[m\].
    pub gap: Vec<f64>,
    /// Convected tangential increment `e_m dξ_m` \[m\], as components in the frame.
    pub increment: Vec<[f64; 2]>,
}

/// A point leaving its segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exit {
    /// Fraction of the increment at which it leaves.
    pub fraction: f64,
    /// Index of the point.
    pub point: usize,
}

/// A node on which a point acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// Index into the nodes of the interface.
    pub node: usize,
    /// Weight s_k: the share of the point's force that acts on the node, negative for the reaction on the master.
    pub weight: f64,
    /// True if the node belongs to the slave side.
    pub slave: bool,
}

/// A measure of contact. `u` holds the displacements of the interface's nodes \[m\], not the system vector.
pub trait Measure<const D: usize>: Send + Sync + fmt::Debug {
    /// Blocks of degrees of freedom, one for each paired point.
    fn pattern(&self) -> &Pattern;

    /// Relative displacements through which points act, if nodes and weights are fixed.
    fn relative(&self) -> Option<&RelativeDisplacements> {
        None
    }

    /// Adds the slave point of each block of the pattern to `out`.
    fn block_points(&self, out: &mut Vec<usize>);

    /// Updates the pairing at `u`. Pairing and pattern change nowhere else. Counts projections in `projections` and returns
    /// true if a search was made.
    fn search(&mut self, u: &[[f64; D]], projections: &mut u64) -> bool;

    /// Evaluates gaps, normals, frames and tangential increments at `u`.
    fn measure(&mut self, u: &[[f64; D]], out: &mut Geometry<D>);

    /// Writes to `out` the gaps at the configuration last measured, whose differences are those of `geometry` \[m\]; infinite
    /// without a partner. Gaps at the start, which may be large beside what they change by, are left out if they are constants.
    fn partings(&self, geometry: &Geometry<D>, out: &mut Vec<f64>) {
        out.clone_from(&geometry.gap);
    }

    /// Adds the nodal residual of the tractions (force per area on the slave) at the configuration last measured.
    fn spread(&self, force: &[[f64; D]], residual: &mut [f64]);

    /// Writes the consistent tangent of `spread(measure(u))` at the configuration last measured.
    fn tangent(&self, geometry: &Geometry<D>, tractions: Tractions<'_>, values: &mut [f64]);

    /// Linearised increments for displacement increments `du` of the interface's nodes at the configuration last measured.
    fn slides(&self, geometry: &Geometry<D>, du: &[[f64; D]], out: &mut Slides);

    /// Limit r7: the first point to leave its segment for the increment `du`; `None` if the pairing is fixed.
    fn exit(&self, du: &[[f64; D]]) -> Option<Exit>;

    /// Commits the configuration last measured. The caller must transform tangential components from the frame of `geometry` to
    /// the new frame. For each point whose frame is replaced, `reframe` receives the point and the new frame (in the present
    /// configuration).
    fn commit(&mut self, geometry: &Geometry<D>, reframe: &mut dyn FnMut(usize, &[[f64; D]; 2]));

    /// Restores the pairing of the last commit. The pattern keeps its blocks until the next search.
    fn revert(&mut self);

    /// Writes to `out` (cleared first) the nodes of both sides on which point `p` acts at the configuration last measured; none
    /// if it is unpaired.
    fn attachments(&self, p: usize, out: &mut Vec<Attachment>);

    /// Writes to `out` (cleared first) points, with the shares of their tractions in the mean around point `p`; none if tractions are
    /// values at points. A point may appear several times.
    fn averages(&self, _p: usize, out: &mut Vec<(usize, f64)>) {
        out.clear();
    }

    /// Writes the tributary areas of the points at the configuration last measured \[m², m in two dimensions\].
    fn areas(&self, out: &mut [f64]);

    /// True if a point's force acts on its slave node and on the closest master point, so that the arm of the couple is
    /// `g_n n`. Otherwise both forces act on averages over facets, and the arm is the averaged `x_s - x_c`.
    fn collocated(&self) -> bool;

    /// True if forces act on the current configuration. Moments are then taken there.
    fn follows(&self) -> bool;

    /// Committed history, pairing, and the range of the last search.
    fn save(&self) -> MeasureState;

    /// Restores the saved state of a measure of the same interface. Returns false and changes nothing if it does not fit.
    fn restore(&mut self, saved: &MeasureState) -> bool;
}
