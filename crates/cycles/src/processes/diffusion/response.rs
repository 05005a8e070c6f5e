//! Pressure after a well has begun to inject at a unit flux, by implicit steps.
//!
//! Pressures obey `C dp/dt = -K p + q` with constant coefficients. Pressure and its rate v follow over a step h from
//!
//! ```text
//! v(t + h) = r(h A) v(t),   p(t + h) = p(t) + h (r(h A) - 1)/(h A) v(t),   A = -C⁻¹ K,
//! ```
//!
//! where r is the stability function of the Radau IIA method of order five, the (2,3) Padé approximant of exp:
//!
//! ```text
//! r(z) = (1 + 2z/5 + z²/20)/(1 - 3z/5 + 3z²/20 - z³/60) = Σ ρ_j/(z - z_j)
//! ```
//!
//! (E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed. (1996), section IV.3). It is L-stable: modes
//! that are fast beside h vanish. Each z_j asks for one solution of a tridiagonal system. As r(0) = 1, the steps conserve fluid.
//!
//! A response to a step of the flux varies with the logarithm of time. Steps therefore double with the time that has
//! passed: there are [`STEPS`] of them from each time to twice that time, whatever the run. Between their ends pressures
//! are polynomials of degree five through p, v and dv/dt.

use super::chain::{C, Chain};

/// Number of steps in which time doubles.
const STEPS: usize = 8;
/// First step times the fastest rate of decay. Its error is that of the steps of the fastest mode, z⁶/7200 of its amplitude.
const FIRST: f64 = 0.25;

/// Pressure, its rate and the rate of this one at all points, at the end of a step.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    /// Time since the well has begun \[s\].
    time: f64,
    /// Per unit flux \[Pa s/m\].
    pressure: Vec<f64>,
    /// \[Pa/m\].
    rate: Vec<f64>,
    /// \[Pa/(m s)\].
    bend: Vec<f64>,
}

/// Pressures at all points per flux of a well that has begun.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Response {
    nodes: Vec<Node>,
}

impl Response {
    /// Response up to the time `end` \[s\] to a unit flux with these shares of the cells. Its steps do not depend on `end`.
    pub fn new(chain: &Chain, inlet: &[f64], end: f64) -> Self {
        let rate: Vec<f64> = inlet.iter().zip(chain.capacity()).map(|(q, c)| q / c).collect();
        let bend = chain.relaxation(&rate);
        let mut nodes = vec![Node { time: 0.0, pressure: vec![0.0; rate.len()], rate, bend }];
        let fastest = chain.fastest();
        // Where nothing flows, pressure is linear in time and every step exact.
        let mut length = if fastest > 0.0 { FIRST / fastest } else { 1.0 };
        let poles = Poles::new();
        loop {
            for _ in 0..STEPS {
                nodes.push(poles.step(chain, &nodes[nodes.len() - 1], length));
            }
            if nodes[nodes.len() - 1].time >= end {
                return Self { nodes };
            }
            if nodes.len() > 2 * STEPS {
                length *= 2.0;
            }
        }
    }

    /// Number of its steps.
    pub fn steps(&self) -> usize {
        self.nodes.len() - 1
    }

    /// Size \[bytes\].
    pub fn bytes(&self) -> usize {
        self.nodes.iter().map(|node| 3 * size_of::<f64>() * node.rate.len()).sum()
    }

    /// Adds pressures \[Pa\] and their rates \[Pa/s\] a time after the flux has changed by `flux` \[m/s\].
    pub fn add(&self, flux: f64, time: f64, sum: &mut [[f64; 2]]) {
        let k = self.nodes.partition_point(|node| node.time <= time).clamp(1, self.nodes.len() - 1);
        let [start, end] = [&self.nodes[k - 1], &self.nodes[k]];
        let h = end.time - start.time;
        let [value, slope] = weights((time - start.time) / h);
        let scale = [1.0, h, h * h, 1.0, h, h * h].map(|scale| flux * scale);
        let value: [f64; 6] = std::array::from_fn(|i| value[i] * scale[i]);
        let slope: [f64; 6] = std::array::from_fn(|i| slope[i] * scale[i] / h);
        for (i, [pressure, rate]) in sum.iter_mut().enumerate() {
            let ends =
                [start.pressure[i], start.rate[i], start.bend[i], end.pressure[i], end.rate[i], end.bend[i]];
            *pressure += dot(&value, &ends);
            *rate += dot(&slope, &ends);
        }
    }
}

/// Weights of value, slope and curvature at 0 and at 1 in the polynomial of degree five through them, and in its derivative.
fn weights(u: f64) -> [[f64; 6]; 2] {
    let (s, bump) = (1.0 - u, 30.0 * u * u * (1.0 - u) * (1.0 - u));
    let value = |u: f64| u * u * u * (10.0 - u * (15.0 - 6.0 * u));
    let slope = |u: f64, s: f64| u * s * s * s * (1.0 + 3.0 * u);
    let curvature = |u: f64, s: f64| 0.5 * u * u * s * s * s;
    let slope_rate = |u: f64, s: f64| s * s * (1.0 + 2.0 * u - 15.0 * u * u);
    let curvature_rate = |u: f64, s: f64| 0.5 * u * s * s * (2.0 - 5.0 * u);
    [
        [value(s), slope(u, s), curvature(u, s), value(u), -slope(s, u), curvature(s, u)],
        [-bump, slope_rate(u, s), curvature_rate(u, s), bump, slope_rate(s, u), -curvature_rate(s, u)],
    ]
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Poles z_j of r and its residues ρ_j there: a real one and one of a complex pair.
#[derive(Debug)]
struct Poles([[C; 2]; 2]);

impl Poles {
    /// The roots of `z³ - 9 z² + 36 z - 60`, in closed form: `z = 3 + y` with `y³ + 9 y - 6 = 0`.
    fn new() -> Self {
        let [nine, three] = [9.0, 3.0].map(f64::cbrt);
        let pair = C::new(3.0 - 0.5 * (nine - three), 0.5 * 3.0_f64.sqrt() * (nine + three));
        Self([C::from(3.0 + nine - three), pair].map(|z| {
            let numerator = z * (z / 20.0 + 0.4) + 1.0;
            let slope = z * (0.3 - z / 20.0) - 0.6;
            [z, numerator / slope]
        }))
    }

    /// The end of a step of length h \[s\] from a node.
    fn step(&self, chain: &Chain, from: &Node, h: f64) -> Node {
        let mut pressure = from.pressure.clone();
        let mut rate = vec![0.0; pressure.len()];
        // z r(z) tends to -3.
        let mut bend: Vec<f64> = from.rate.iter().map(|v| -3.0 * v / h).collect();
        for (number, [z, residue]) in self.0.into_iter().enumerate() {
            let both = if number == 0 { 1.0 } else { 2.0 };
            let weights = [residue / z, residue / h, residue * z / (h * h)].map(|w| -both * w);
            for (i, x) in chain.solve(z / h, &from.rate).into_iter().enumerate() {
                let [own, fast, fastest] = weights.map(|w| (w * x).re);
                pressure[i] += own;
                rate[i] += fast;
                bend[i] += fastest;
            }
        }
        Node { time: from.time + h, pressure, rate, bend }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Line;
    use super::*;

    const END: f64 = 1e9;

    fn response(line: &Line, at: f64) -> Response {
        Response::new(&line.chain(), &line.inlet(at), END)
    }

    fn felt(response: &Response, points: usize, time: f64) -> Vec<[f64; 2]> {
        let mut sum = vec![[0.0; 2]; points];
        response.add(1.0, time, &mut sum);
        sum
    }

    /// Times from a to b, thirty a decade.
    fn times(a: f64, b: f64) -> impl Iterator<Item = f64> {
        let n = (30.0 * (b / a).log10()) as i32;
        (0..=n).map(move |k| a * (b / a).powf(f64::from(k) / f64::from(n)))
    }

    #[test]
    fn two_cells_respond_as_exponentials_at_all_times() {
        for ratio in [1.0, 1e-6, 1e6] {
            let line = Line {
                positions: vec![0.5, 1.5],
                lengths: vec![1.0; 2],
                mobility: vec![1e-9, 1e-9 * ratio],
                storage: vec![1e-9, 3e-9],
                drained: false,
            };
            let (a, b) = (1e-9, 3e-9);
            let conductance = 1.0 / (0.5 / line.mobility[0] + 0.5 / line.mobility[1]);
            let decay = conductance * (1.0 / a + 1.0 / b);
            let response = response(&line, 0.5);
            for t in times(1e-9, END) {
                let own = -(-decay * t).exp_m1() / decay;
                let exact = [t / (a + b) + b / (a * (a + b)) * own, (t - own) / (a + b)];
                let faded = (-decay * t).exp();
                let rates = [(1.0 + b / a * faded) / (a + b), (1.0 - faded) / (a + b)];
                for (i, [p, rate]) in felt(&response, 2, t).into_iter().enumerate() {
                    assert!((p - exact[i]).abs() <= 1e-7 * exact[0], "{t}: {p} {}", exact[i]);
                    assert!((rate - rates[i]).abs() <= 1e-6 * rates[0], "{t}: {rate} {}", rates[i]);
                }
            }
        }
    }

    /// Cells over fifteen orders of diffusivity.
    fn steep() -> Line {
        let n = 60;
        Line {
            positions: (0..n).map(|i| f64::from(i) + 0.5).collect(),
            lengths: vec![1.0; 60],
            mobility: (0..n).map(|i| 10.0_f64.powf(-4.0 - f64::from(i) * 0.25)).collect(),
            storage: vec![1e-9; 60],
            drained: false,
        }
    }

    #[test]
    fn closed_ends_keep_all_fluid_whatever_the_permeabilities() {
        let line = steep();
        for at in [0.5, 30.2, 59.5] {
            let response = response(&line, at);
            for t in times(1e-6, END) {
                let felt = felt(&response, 60, t);
                let stored: [f64; 2] = [0, 1].map(|k| felt.iter().map(|p| 1e-9 * p[k]).sum());
                assert!((stored[0] / t - 1.0).abs() < 1e-12, "{at} {t}: {}", stored[0] / t);
                assert!((stored[1] - 1.0).abs() < 1e-12, "{at} {t}: {}", stored[1]);
            }
        }
    }

    #[test]
    fn rates_are_the_derivatives_of_pressures() {
        let response = response(&steep(), 30.2);
        for t in times(1e-3, 1e8) {
            // The second-order error of the difference is a millionth of the pressure.
            let step = 1e-3 * t;
            let [before, now, after] = [t - step, t, t + step].map(|t| felt(&response, 60, t));
            let most = now.iter().fold(0.0_f64, |m, p| m.max(p[0]));
            for i in 0..60 {
                let difference = (after[i][0] - before[i][0]) / (2.0 * step);
                assert!((difference - now[i][1]).abs() <= 1e-5 * most / t, "{t} {i}");
            }
        }
    }

    #[test]
    fn the_steps_do_not_depend_on_how_long_the_run_is() {
        let line = steep();
        let (chain, inlet) = (line.chain(), line.inlet(3.0));
        let [short, long] = [1e5, 1e9].map(|end| Response::new(&chain, &inlet, end));
        assert!(short.nodes.len() < long.nodes.len());
        assert_eq!(short.nodes, long.nodes[..short.nodes.len()]);
    }
}
