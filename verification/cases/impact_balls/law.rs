//! Impact of two equal elastic balls: Hertz's law of force, and that of balls instead of half-spaces.

use super::ball;
use std::f64::consts::PI;

/// Radius of the balls \[m\].
pub const RADIUS: f64 = 0.01;
pub const YOUNG: f64 = 200e9;
pub const POISSON: f64 = 0.3;
const DENSITY: f64 = 7800.0;
/// Duration of Hertz's impact over the time δ/V: twice the integral of (1 - s^(5/2))^(-1/2) from 0 to 1.
const DURATION: f64 = 2.943_275_184;
/// Steps of the integration in time.
const STEPS: u32 = 20_000;

/// Unit of force, R² E/(1 - ν²) \[N\].
fn unit() -> f64 {
    RADIUS * RADIUS * YOUNG / (1.0 - POISSON * POISSON)
}

fn mass() -> f64 {
    4.0 / 3.0 * PI * RADIUS.powi(3) * DENSITY
}

/// Impact of a ball on an equal one at rest.
#[derive(Clone, Copy, Debug)]
pub struct Impact {
    /// Speed of the ball that moves \[m/s\].
    pub speed: f64,
}

impl Impact {
    /// Momentum of the ball that moves \[N s\].
    pub fn momentum(self) -> f64 {
        mass() * self.speed
    }

    /// Kinetic energy before the impact \[J\].
    pub fn energy(self) -> f64 {
        0.5 * mass() * self.speed * self.speed
    }

    /// Largest radius of contact by Hertz, over that of the balls: a quarter of the kinetic energy in either ball.
    pub fn contact(self) -> f64 {
        (15.0 / 8.0 * 0.25 * self.energy() / (unit() * RADIUS)).powf(0.2)
    }

    /// Duration by Hertz \[s\].
    pub fn duration(self) -> f64 {
        DURATION * 2.0 * self.contact().powi(2) * RADIUS / self.speed
    }

    /// Force over time from the first touch on \[s, N\], somewhat beyond the duration by Hertz.
    pub fn course(self, law: &Law) -> Course {
        let step = 1.1 * self.duration() / f64::from(STEPS);
        let pull = step * unit() / (mass() * RADIUS);
        let (mut d, mut speed, mut force) = (0.0, 0.5 * self.speed / RADIUS, 0.0);
        let rows = (0..=STEPS).map(|k| {
            let row = (f64::from(k) * step, force * unit());
            speed -= 0.5 * pull * force;
            d += step * speed;
            force = law.force(d);
            speed -= 0.5 * pull * force;
            row
        });
        Course(rows.collect())
    }
}

/// Law of force of a ball on the plane between both, in units of R and E/(1 - ν²). With the radius a of Hertz's pressure under
/// the force f = 4 a³/3, a ball has the elastic energy 8 a^5/15 (1 + a (A + B ln a)).
pub struct Law {
    constant: f64,
    slope: f64,
}

impl Law {
    /// Law of half-spaces.
    pub const HERTZ: Law = Law { constant: 0.0, slope: 0.0 };

    /// Law of balls about a radius of contact: Hertz's pressure on each, which to first order in a has the least energy.
    pub fn balls(contact: f64) -> Self {
        let [whole, half] = [contact, 0.5 * contact].map(ball::excess);
        let slope = (whole - half) / 2.0_f64.ln();
        Self { constant: whole - slope * contact.ln(), slope }
    }

    /// Approach of the centre of mass to the plane, d = a² + f'(energy beyond Hertz), and its derivative by a.
    fn approach(&self, a: f64) -> [f64; 2] {
        let excess = self.constant + self.slope * a.ln();
        let d = a * a + a.powi(3) * (0.8 * excess + 2.0 / 15.0 * self.slope);
        [d, 2.0 * a + a * a * (2.4 * excess + 1.2 * self.slope)]
    }

    /// Force at an approach, by Newton's method for the radius.
    fn force(&self, d: f64) -> f64 {
        const ITERATIONS: usize = 5;
        if d <= 0.0 {
            return 0.0;
        }
        let mut a = d.sqrt();
        for _ in 0..ITERATIONS {
            let [approach, slope] = self.approach(a);
            a -= (approach - d) / slope;
        }
        4.0 / 3.0 * a.powi(3)
    }
}

/// Force over time \[s, N\].
pub struct Course(pub Vec<(f64, f64)>);

impl Course {
    /// Largest force \[N\].
    pub fn peak(&self) -> f64 {
        self.0.iter().map(|row| row.1).fold(0.0, f64::max)
    }

    /// Time for which a force is exceeded \[s\].
    pub fn duration_above(&self, force: f64) -> f64 {
        let above = |w: &[(f64, f64)]| {
            let [(t, f), (next, g)] = [w[0], w[1]];
            let share = (f.max(g) - force) / (f - g).abs();
            (next - t) * share.clamp(0.0, 1.0)
        };
        self.0.windows(2).map(above).sum()
    }

    /// Integral over time \[N s\].
    pub fn impulse(&self) -> f64 {
        self.0.windows(2).map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0)).sum()
    }

    /// Force at a time; zero outside.
    pub fn at(&self, time: f64) -> f64 {
        let after = self.0.partition_point(|row| row.0 <= time);
        match (after.checked_sub(1).map(|k| self.0[k]), self.0.get(after)) {
            (Some((t, f)), Some((next, g))) => f + (g - f) * (time - t) / (next - t),
            _ => 0.0,
        }
    }

    /// Distance from another in L2, over the norm of the latter.
    pub fn distance(&self, exact: &Course) -> f64 {
        let (mut error, mut norm) = (0.0, 0.0);
        for &(t, f) in &self.0 {
            let exact = exact.at(t);
            error += (f - exact).powi(2);
            norm += exact * exact;
        }
        (error / norm).sqrt()
    }
}
