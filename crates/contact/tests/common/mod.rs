//! Scenes and laws for the tests of this crate.
#![allow(dead_code, clippy::unwrap_used)]

pub mod curved;

use asperity_contact::{
    Enforcement, Interface, InterfaceSpec, MeasureKind, Segment, SegmentKind, SlavePoint, Sliding,
    SurfaceNode,
};
use asperity_fem::term::{ForwardTerm, Instant, Linearized, Term};
use asperity_friction::Failure;
use asperity_friction::law::{
    Increments, Law, Limit, LimitKind, PresentStates, RateBounds, Rates, Regime, Responses, Trials,
};
use std::sync::Arc;

/// Coulomb friction, implemented independently of the friction crate.
#[derive(Debug)]
pub struct Mu(pub f64);

impl Law for Mu {
    fn name(&self) -> &'static str {
        "coulomb"
    }
    fn states(&self) -> usize {
        0
    }
    fn initial(&self, _states: &mut [f64]) {}
    fn coefficient(
        &self,
        _normal: &[f64],
        _rate: &[f64],
        _states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        mu.fill(self.0);
        Ok(())
    }
    fn respond(&self, t: Trials<'_>, _old: &[f64], out: Responses<'_>) -> Result<(), Failure> {
        for i in 0..t.normal.len() {
            let strength = self.0 * t.normal[i];
            let slips = t.trial[i] > strength;
            out.traction[i] = if slips { strength } else { t.trial[i] };
            out.slip[i] = (t.trial[i] - out.traction[i]) / t.stiffness;
            out.rate[i] =
                t.lag.map_or(out.slip[i] / t.dt, |l| l.weight[i] * out.slip[i] / t.dt - l.offset[i]);
            out.regime[i] = if slips { Regime::Slip } else { Regime::Stick };
            out.d_trial[i] = if slips { 0.0 } else { 1.0 };
            out.d_normal[i] = if slips { self.0 } else { 0.0 };
        }
        Ok(())
    }
    fn rates(&self, p: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        for i in 0..p.normal.len() {
            let slips = p.regime[i] == Regime::Slip;
            out.along[i] = if slips { 0.0 } else { 1.0 };
            out.coupling[i] = if slips { self.0 } else { 0.0 };
            out.constant[i] = if slips { self.0 * p.normal[i] - p.traction[i] } else { 0.0 };
        }
        Ok(())
    }
    fn limit(&self, p: PresentStates<'_>, s: Increments<'_>, _bounds: RateBounds) -> Option<Limit> {
        let mut best: Option<Limit> = None;
        for i in 0..p.normal.len() {
            if p.regime[i] == Regime::Slip {
                continue;
            }
            // Linear in r on each branch of |τ + r Δτ| = μ (f + r Δf); finds the first root that leaves the cone.
            for sign in [1.0, -1.0] {
                let (slack, closing) = (
                    self.0 * p.normal[i] - sign * p.traction[i],
                    sign * s.traction[i] - self.0 * s.normal[i],
                );
                if closing > 0.0 && slack < closing {
                    let fraction = (slack / closing).max(0.0);
                    if best.is_none_or(|b| fraction < b.fraction) {
                        best = Some(Limit { fraction, point: i, kind: LimitKind::StickToSlip });
                    }
                }
            }
        }
        best
    }
    fn stands(&self, p: PresentStates<'_>, k: usize) -> bool {
        p.traction[k].abs() >= self.0 * p.normal[k] * (1.0 - 1e-9)
    }
}

/// Rate law mu = a asinh(V/(2 Vref) exp(mu0/a)), solved by bisection in V followed by Newton steps.
#[derive(Debug)]
pub struct ViscousLaw {
    pub mu0: f64,
    pub a: f64,
    pub v_ref: f64,
}

impl ViscousLaw {
    fn mu(&self, v: f64) -> (f64, f64) {
        let c = (self.mu0 / self.a).exp() / (2.0 * self.v_ref);
        (self.a * (c * v).asinh(), self.a * c / (1.0 + (c * v).powi(2)).sqrt())
    }
}

impl Law for ViscousLaw {
    fn name(&self) -> &'static str {
        "rate"
    }
    fn states(&self) -> usize {
        0
    }
    fn initial(&self, _states: &mut [f64]) {}
    fn coefficient(
        &self,
        _normal: &[f64],
        rate: &[f64],
        _states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        for (m, v) in mu.iter_mut().zip(rate) {
            *m = self.mu(*v).0;
        }
        Ok(())
    }
    fn respond(&self, t: Trials<'_>, _old: &[f64], out: Responses<'_>) -> Result<(), Failure> {
        for i in 0..t.normal.len() {
            let (weight, offset) = t.lag.map_or((1.0, 0.0), |l| (l.weight[i], l.offset[i]));
            let rate = |s: f64| weight * s / t.dt - offset;
            let f = |s: f64| t.trial[i] - t.stiffness * s - t.normal[i] * self.mu(rate(s)).0;
            let (mut lo, mut hi) = (0.0, t.trial[i] / t.stiffness);
            for _ in 0..200 {
                let m = 0.5 * (lo + hi);
                if f(m) > 0.0 { lo = m } else { hi = m }
            }
            let s = 0.5 * (lo + hi);
            let (mu, slope) = self.mu(rate(s));
            let h = t.normal[i] * slope * weight / t.dt;
            out.slip[i] = s;
            out.rate[i] = rate(s);
            out.traction[i] = t.trial[i] - t.stiffness * s;
            out.regime[i] = Regime::Slip;
            out.d_trial[i] = h / (t.stiffness + h);
            out.d_normal[i] = mu * t.stiffness / (t.stiffness + h);
        }
        Ok(())
    }
    fn rates(&self, p: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        for i in 0..p.normal.len() {
            let v = p.rate[i].max(p.rate_floor);
            let (mu, slope) = self.mu(v);
            let h = p.normal[i] * slope / p.dt;
            let kappa = p.stiffness / (p.stiffness + h);
            out.along[i] = 1.0 - kappa;
            out.coupling[i] = kappa * mu;
            out.constant[i] = -kappa * p.normal[i] * slope * v;
        }
        Ok(())
    }
    fn limit(&self, _p: PresentStates<'_>, _s: Increments<'_>, _bounds: RateBounds) -> Option<Limit> {
        None
    }
}

pub fn coulomb() -> Option<Arc<dyn Law>> {
    Some(Arc::new(Mu(0.5)))
}

pub fn viscous() -> Option<Arc<dyn Law>> {
    Some(Arc::new(ViscousLaw { mu0: 0.4, a: 0.05, v_ref: 0.1 }))
}

pub const AT: Instant = Instant { time: 1.0, dt: 0.1 };

/// Rotation about the axis (1, 2, 3) in three dimensions and in the plane in two.
pub fn rotate<const D: usize>(x: &[f64; D], angle: f64) -> [f64; D] {
    let (s, c) = angle.sin_cos();
    let mut y = [0.0; D];
    if D == 2 {
        y[0] = c * x[0] - s * x[1];
        y[1] = s * x[0] + c * x[1];
        return y;
    }
    let k = [1.0, 2.0, 3.0].map(|v: f64| v / 14.0f64.sqrt());
    let along: f64 = (0..3).map(|i| k[i] * x[i]).sum();
    for i in 0..3 {
        let (j, l) = ((i + 1) % 3, (i + 2) % 3);
        y[i] = c * x[i] + s * (k[j] * x[l] - k[l] * x[j]) + (1.0 - c) * along * k[i];
    }
    y
}

/// Deterministic numbers in [-1, 1].
pub struct Noise(u64);

impl Noise {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        #[allow(clippy::cast_precision_loss)]
        let x = (self.0 >> 11) as f64 / (1u64 << 53) as f64;
        2.0 * x - 1.0
    }
    pub fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}

pub fn spec<const D: usize>(
    positions: &[[f64; D]],
    slaves: &[usize],
    master: Vec<Segment>,
    sliding: Sliding,
    law: Option<Arc<dyn Law>>,
) -> InterfaceSpec<D> {
    InterfaceSpec {
        name: "fault".to_owned(),
        nodes: positions
            .iter()
            .enumerate()
            .map(|(i, p)| SurfaceNode { position: *p, dof: D * i, label: 100 + i })
            .collect(),
        slave: slaves
            .iter()
            .enumerate()
            .map(|(k, &node)| SlavePoint { node, area: 0.5 + 0.1 * k as f64 })
            .collect(),
        master,
        measure: MeasureKind::NodeToPoint,
        sliding,
        smoothing: None,
        fixed_normal: None,
        enforcement: Enforcement::Penalty,
        normal_penalty: 1000.0,
        tangential_penalty: 700.0,
        young_per_size: 10.0,
        law,
        scale: 1.0,
        rate_floor: 1e-12,
        rate_bounds: RateBounds { zeta: 0.1, log_rate: 0.5 },
        label_rate: None,
    }
}

/// Three segments with outward normal +y (then rotated), nodes 0..4, and slaves above them at nodes 4..8.
pub fn line(angle: f64, sliding: Sliding, law: Option<Arc<dyn Law>>) -> Interface<2> {
    Interface::new(line_spec(angle, sliding, law)).unwrap()
}

pub fn line_spec(angle: f64, sliding: Sliding, law: Option<Arc<dyn Law>>) -> InterfaceSpec<2> {
    let mut x = vec![[3.0, 0.0], [1.9, 0.02], [1.0, 0.0], [0.0, 0.05]];
    x.extend([[2.4, 0.03], [1.7, 0.02], [1.2, 0.02], [0.35, 0.04]]);
    let x: Vec<_> = x.iter().map(|p| rotate(p, angle)).collect();
    let master = (0..3).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] }).collect();
    spec(&x, &[4, 5, 6, 7], master, sliding, law)
}

/// A slightly irregular 3 x 3 grid of nodes with outward normal +z (then rotated), as quadrilaterals or triangles, with slaves
/// above it.
pub fn plate_spec(
    angle: f64,
    kind: SegmentKind,
    sliding: Sliding,
    law: Option<Arc<dyn Law>>,
) -> InterfaceSpec<3> {
    let mut noise = Noise::new(7);
    let mut x = Vec::new();
    for j in 0..3 {
        for i in 0..3 {
            let z = 0.02 * noise.next();
            x.push([f64::from(i) + 0.05 * noise.next(), f64::from(j) + 0.05 * noise.next(), z]);
        }
    }
    x.extend([[0.4, 0.3, 0.0], [1.55, 0.45, 0.01], [0.6, 1.6, 0.0], [1.4, 1.35, 0.01], [0.8, 0.75, 0.0]]);
    let x: Vec<_> = x.iter().map(|p| rotate(p, angle)).collect();
    let mut master = Vec::new();
    for j in 0..2 {
        for i in 0..2 {
            let a = 3 * j + i;
            let quad = [a, a + 1, a + 4, a + 3];
            if kind == SegmentKind::Quad4 {
                master.push(Segment { kind, nodes: quad.to_vec() });
            } else {
                master.push(Segment { kind, nodes: vec![quad[0], quad[1], quad[2]] });
                master.push(Segment { kind, nodes: vec![quad[0], quad[2], quad[3]] });
            }
        }
    }
    spec(&x, &[9, 10, 11, 12, 13], master, sliding, law)
}

/// Displacement that moves every slave node of `spec` by its own vector (in unrotated axes) and all other nodes by noise.
pub fn moved<const D: usize>(
    spec: &InterfaceSpec<D>,
    angle: f64,
    moves: &[[f64; D]],
    noise: f64,
    seed: u64,
) -> Vec<f64> {
    let mut source = Noise::new(seed);
    let mut u: Vec<f64> = source.vector(D * spec.nodes.len()).into_iter().map(|v| noise * v).collect();
    for (s, m) in spec.slave.iter().zip(moves) {
        let m = rotate(m, angle);
        for i in 0..D {
            u[D * s.node + i] += m[i];
        }
    }
    u
}

pub fn residual<const D: usize>(interface: &mut Interface<D>, u: &[f64]) -> Vec<f64> {
    let mut r = vec![0.0; u.len()];
    interface.residual(u, AT, &mut r).unwrap();
    r
}

/// Product K v from the blocks of the present tangent.
pub fn apply<const D: usize>(interface: &mut Interface<D>, v: &[f64]) -> Vec<f64> {
    let pattern = interface.pattern().clone();
    let mut values = vec![f64::NAN; pattern.values()];
    interface.tangent(&mut values);
    product(&pattern, &values, v)
}

pub fn product(pattern: &asperity_fem::term::Pattern, values: &[f64], v: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; v.len()];
    let mut at = 0;
    for block in pattern.blocks() {
        for &i in block {
            for &j in block {
                out[i] += values[at] * v[j];
                at += 1;
            }
        }
    }
    out
}

pub fn size(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Asserts that |r(u + h v) - r(u) - h K v| falls with the square of h (or stays at rounding throughout).
pub fn assert_taylor<const D: usize>(interface: &mut Interface<D>, u: &[f64], seed: u64) {
    let v = Noise::new(seed).vector(u.len());
    let r0 = residual(interface, u);
    let kv = apply(interface, &v);
    let floor = 1e-12 * size(&kv);
    let mut errors = Vec::new();
    for k in 0..3 {
        let h = 1e-4 * 0.1f64.powi(k);
        let w: Vec<f64> = u.iter().zip(&v).map(|(a, b)| a + h * b).collect();
        let r = residual(interface, &w);
        let e: Vec<f64> = (0..u.len()).map(|i| r[i] - r0[i] - h * kv[i]).collect();
        errors.push(size(&e));
    }
    for w in errors.windows(2) {
        let slope = (w[0] / w[1]).log10();
        assert!(w[1] < floor || slope > 1.9, "Taylor remainders {errors:?}, slope {slope}, floor {floor}");
    }
}

/// Largest |K - K'| relative to the largest entry.
fn asymmetry(pattern: &asperity_fem::term::Pattern, values: &[f64]) -> f64 {
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let (mut worst, mut at) = (0.0_f64, 0);
    for block in pattern.blocks() {
        let n = block.len();
        for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
            worst = worst.max((values[at + i * n + j] - values[at + j * n + i]).abs());
        }
        at += n * n;
    }
    worst / largest
}

/// Asymmetries of the consistent tangent at `u` and of the rate tangent after the step is accepted.
pub fn asymmetries<const D: usize>((mut interface, u): (Interface<D>, Vec<f64>)) -> [f64; 2] {
    residual(&mut interface, &u);
    let pattern = interface.pattern().clone();
    let mut values = vec![f64::NAN; pattern.values()];
    interface.tangent(&mut values);
    let consistent = asymmetry(&pattern, &values);
    interface.accept();
    interface.prepare(&u).unwrap();
    let pattern = interface.pattern().clone();
    let mut rate = vec![f64::NAN; pattern.values()];
    interface.rate(AT, &mut rate, &mut vec![0.0; u.len()]).unwrap();
    [consistent, asymmetry(&pattern, &rate)]
}

/// Interface after a first step to the displacements `first`, prepared for `second`, which are also returned.
pub fn second_step<const D: usize>(
    mut interface: Interface<D>,
    first: &[f64],
    second: Vec<f64>,
) -> (Interface<D>, Vec<f64>) {
    interface.prepare(first).unwrap();
    residual(&mut interface, first);
    interface.accept();
    interface.prepare(&second).unwrap();
    (interface, second)
}
