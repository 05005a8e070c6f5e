//! Geometry of a slave point in the present configuration, and the change of its traction with the geometry.

use super::mirror::Mirror;
use crate::measure::{NormalPoint, ShearPoint};
use crate::vector::{add, axpy, cross, dot, norm, scaled, unit};
use asperity_fem::vector::tangent;

/// Normal, frame and averaged distances of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local<const D: usize> {
    /// Normal n, outward from the master.
    pub n: [f64; D],
    /// Length of the sum of facet normals.
    length: f64,
    /// Vector m_1 + m_2 × n, which the frame is aligned with. m_1 and m_2 are material tangent vectors, perpendicular at the
    /// start. The frame then turns with the mean rotation of the surface (the polar rotation), whichever vectors are chosen.
    e: [f64; D],
    /// Material vector m_2.
    second: [f64; D],
    /// Length of the projection of `e` on the tangent plane.
    projected: f64,
    pub frame: [[f64; D]; 2],
    mirror: Mirror,
    /// Averaged distance x_s - x_c: `Σ_k s_k x_k`.
    pub d: [f64; D],
    /// Averaged distance of the material points that faced each other at the last commit: `Σ_k (s_k of the last commit) x_k`.
    pub v: [f64; D],
    /// Its components along the frame at the last commit.
    then: [f64; 2],
}

/// Averaged distances of a point \[m\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Distances<const D: usize> {
    /// Distance of points that face each other now.
    pub d: [f64; D],
    /// Distance of points that faced each other at the last commit.
    pub v: [f64; D],
    /// Components of the latter along the frame at the last commit.
    pub then: [f64; 2],
}

/// Changes of the geometry of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change<const D: usize> {
    pub n: [f64; D],
    pub frame: [[f64; D]; 2],
    pub d: [f64; D],
    pub v: [f64; D],
}

impl<const D: usize> Change<D> {
    pub(super) fn none() -> Self {
        Self { n: [0.0; D], frame: [[0.0; D]; 2], d: [0.0; D], v: [0.0; D] }
    }
}

/// Tractions of a point and their derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct Traction<'a> {
    pub normal: &'a NormalPoint,
    pub shear: Option<&'a ShearPoint>,
    /// Tangential penalty E_t \[Pa/m\].
    pub stiffness: f64,
}

impl<const D: usize> Local<D> {
    /// Constructs the geometry from the sum of the outward slave normals and two material tangent vectors (unused in two
    /// dimensions).
    pub(super) fn new(normals: &[f64; D], material: [[f64; D]; 2], distances: Distances<D>) -> Self {
        let Distances { d, v, then } = distances;
        let length = norm(normals);
        let n = scaled(normals, -length.recip());
        let [e, second] = material;
        if D == 2 {
            let frame = [tangent(&n), [0.0; D]];
            return Self {
                n,
                length,
                e,
                second,
                projected: 1.0,
                frame,
                mirror: Mirror::default(),
                d,
                v,
                then,
            };
        }
        let e = add(&e, &cross(&second, &n));
        let mut q = e;
        axpy(&mut q, -dot(&n, &e), &n);
        let first = unit(&q);
        let frame = [first, cross(&n, &first)];
        Self { n, length, e, second, projected: norm(&q), frame, mirror: Mirror::default(), d, v, then }
    }

    /// Constructs the geometry of a point on planes of symmetry, whose frame follows from the normal alone.
    pub(super) fn mirrored(normals: &[f64; D], mirror: Mirror, distances: Distances<D>) -> Self {
        let Distances { d, v, then } = distances;
        let flat = mirror.flattened(*normals);
        let length = norm(&flat);
        let n = scaled(&flat, -length.recip());
        let none = [0.0; D];
        let frame = mirror.frame(&n);
        Self { n, length, e: none, second: none, projected: 1.0, frame, mirror, d, v, then }
    }

    /// Gap g_n.
    pub(super) fn gap(&self) -> f64 {
        dot(&self.n, &self.d)
    }

    /// Tangential displacement since the last commit \[m\], in the frame.
    pub(super) fn increment(&self) -> [f64; 2] {
        std::array::from_fn(|j| dot(&self.frame[j], &self.v) - self.then[j])
    }

    /// Components of the averaged distance along the frame \[m\].
    pub(super) fn apart(&self) -> [f64; 2] {
        self.frame.map(|e| dot(&e, &self.d))
    }

    /// Computes δn and δframe from the changes of the sum of normals and of the tangent vectors.
    pub(super) fn turn(&self, normals: &[f64; D], [first, second]: &[[f64; D]; 2], out: &mut Change<D>) {
        let mut dn = scaled(&self.mirror.flattened(*normals), -self.length.recip());
        let out_of_plane = dot(&self.n, &dn);
        axpy(&mut dn, -out_of_plane, &self.n);
        out.n = dn;
        if self.mirror.any() {
            out.frame = self.mirror.frame(&dn);
            return;
        }
        if D == 2 {
            out.frame[0] = tangent(&dn);
            return;
        }
        let along = dot(&self.n, &self.e);
        let e = add(&add(first, &cross(second, &self.n)), &cross(&self.second, &dn));
        let mut dq = e;
        axpy(&mut dq, -along, &dn);
        axpy(&mut dq, -(dot(&dn, &self.e) + dot(&self.n, &e)), &self.n);
        let first = &self.frame[0];
        let lengthening = dot(first, &dq);
        axpy(&mut dq, -lengthening, first);
        let first_change = scaled(&dq, self.projected.recip());
        out.frame = [first_change, add(&cross(&dn, first), &cross(&self.n, &first_change))];
    }

    /// Force per area on the slave \[Pa\].
    pub(super) fn force(&self, t: &Traction<'_>) -> [f64; D] {
        let mut f = scaled(&self.n, t.normal.traction);
        if let Some(s) = t.shear {
            axpy(&mut f, -s.traction[0], &self.frame[0]);
            axpy(&mut f, -s.traction[1], &self.frame[1]);
        }
        f
    }

    /// Change of the force per area.
    pub(super) fn force_change(&self, t: &Traction<'_>, c: &Change<D>) -> [f64; D] {
        let df_n = -t.normal.stiffness * (dot(&c.n, &self.d) + dot(&self.n, &c.d));
        let mut df = scaled(&self.n, df_n);
        axpy(&mut df, t.normal.traction, &c.n);
        let Some(s) = t.shear else { return df };
        let trial: [f64; 2] =
            std::array::from_fn(|j| t.stiffness * (dot(&c.frame[j], &self.v) + dot(&self.frame[j], &c.v)));
        let radial = (s.d_trial - s.ratio) * dot(&s.direction, &trial) + s.d_normal * df_n;
        for (j, dt) in trial.iter().enumerate() {
            axpy(&mut df, -(s.ratio * dt + radial * s.direction[j]), &self.frame[j]);
            axpy(&mut df, -s.traction[j], &c.frame[j]);
        }
        df
    }
}
