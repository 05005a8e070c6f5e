//! Fluid that diffuses along a line whose permeability and storage vary.
//!
//! The pressure p of fluid along a fault obeys, with the permeability k, the viscosity η, the storage S (porosity times the
//! compressibility of fluid and pores) and wells of the flux q at the positions x_w,
//!
//! ```text
//! S ∂p/∂t = ∂/∂x (k/η ∂p/∂x) + Σ q(t) δ(x - x_w),   p = 0 at the start,
//! ```
//!
//! J. Bear, "Dynamics of Fluids in Porous Media" (1972), section 6.3. The ends of the fault are closed or drained. In space
//! these are finite volumes, see [`chain`].
//!
//! Pressure does not depend on slip, and the equation is linear with constant coefficients. The pressure is therefore a sum
//! over the jumps of the fluxes: each adds the response of the fault to a unit flux of its well at the time since then, times the
//! jump. Responses are computed once, by implicit steps of their own, see [`response`]. Steps of the run may be years or milliseconds
//! and see the same pressure, which needs no memory: a resumed run has it as well. A decomposition into modes would be
//! exact in time, but its slow modes are lost to rounding where permeabilities differ by many orders.

mod chain;
mod response;

pub use chain::Line;

use super::fluid::{ActingFluid, PorePressure};
use crate::problem::{Acting, Host, Phase, PointTractions, Process, ProcessRecord, Time};
use response::Response;

/// A well.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Position along the line \[m\].
    pub at: f64,
    /// Times \[s\] from which the volume of fluid per cross-sectional area of the fault and time has a value \[m/s\], in ascending order;
    /// before the first nothing flows.
    pub flux: Vec<(f64, f64)>,
}

/// A well and the pressures that it causes.
#[derive(Clone, Debug, PartialEq)]
struct Well {
    /// Index of the first point of its fault.
    first: usize,
    /// Number of points of its fault.
    points: usize,
    /// Times at which its flux jumps \[s\], and by how much \[m/s\].
    jumps: Vec<(f64, f64)>,
    response: Response,
}

/// Fluid along faults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diffusion {
    wells: Vec<Well>,
}

impl Diffusion {
    /// Adds wells on a line whose points are `first` and those that follow, in a run that ends at `end` \[s\].
    pub fn add(&mut self, first: usize, line: &Line, wells: &[Source], end: f64) {
        let (chain, points) = (line.chain(), line.positions.len());
        self.wells.extend(wells.iter().map(|well| {
            let before = std::iter::once(0.0).chain(well.flux.iter().map(|step| step.1));
            let jumps = well.flux.iter().zip(before).map(|(&(at, flux), before)| (at, flux - before));
            let jumps: Vec<_> = jumps.filter(|jump| jump.1 != 0.0).collect();
            let longest = end - jumps.first().map_or(end, |jump| jump.0);
            Well { first, points, jumps, response: Response::new(&chain, &line.inlet(well.at), longest) }
        }));
    }

    /// True if a well is on the fault of a point.
    #[must_use]
    pub fn reaches(&self, point: usize) -> bool {
        self.wells.iter().any(|w| (w.first..w.first + w.points).contains(&point))
    }

    /// Description, for people.
    #[must_use]
    pub fn words(&self) -> String {
        let steps = self.wells.iter().map(|well| well.response.steps()).max().unwrap_or(0);
        let wells =
            if self.wells.len() == 1 { "a well".into() } else { format!("{} wells", self.wells.len()) };
        format!(
            "fluid from {wells} diffuses along the fault; its pressure follows from {steps} implicit steps"
        )
    }

    /// Size of the responses \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.wells.iter().map(|well| well.response.bytes()).sum()
    }
}

impl PorePressure for Diffusion {
    fn add_to(&self, time: f64, until: f64, sum: &mut [[f64; 2]]) {
        for well in &self.wells {
            let points = &mut sum[well.first..well.first + well.points];
            let seen = well.jumps.iter().filter(|jump| jump.0 < until && jump.0 <= time);
            seen.for_each(|(at, flux)| well.response.add(*flux, time - at, points));
        }
    }
}

impl Process for Diffusion {
    fn name(&self) -> &'static str {
        "diffusion"
    }

    fn phase(&self) -> Phase {
        Phase::Fluid
    }

    fn begin<'a>(&'a self, host: Host<'a>, _: Option<&ProcessRecord>) -> Box<dyn Acting + 'a> {
        Box::new(ActingFluid::new(self, host.law.points()))
    }

    fn presses(&self) -> bool {
        true
    }

    fn breaks(&self) -> Vec<f64> {
        self.wells.iter().flat_map(|well| well.jumps.iter().map(|jump| jump.0)).collect()
    }

    fn fluid(&self, time: Time, _: &PointTractions, sum: &mut [[f64; 2]]) {
        self.add_to(time.at, time.until, sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::processes::Injection;

    /// A uniform line of this many cells over 4 km, like the layer of [`injection`].
    fn line(cells: i32) -> Line {
        let (n, size) = (cells as usize, 4000.0 / f64::from(cells));
        Line {
            positions: (0..cells).map(|i| (f64::from(i) + 0.5) * size).collect(),
            lengths: vec![size; n],
            mobility: vec![1e-10; n],
            storage: vec![1e-9; n],
            drained: false,
        }
    }

    fn injection(flux: &[(f64, f64)]) -> Injection {
        Injection { flux: flux.to_vec(), diffusivity: 0.1, porosity: 0.1, compressibility: 1e-8 }
    }

    fn diffusion(line: &Line, wells: &[(f64, &[(f64, f64)])]) -> Diffusion {
        let mut all = Diffusion::default();
        let sources = wells.iter().map(|(at, flux)| Source { at: *at, flux: flux.to_vec() });
        all.add(0, line, &sources.collect::<Vec<_>>(), 1e7);
        all
    }

    fn felt(diffusion: &Diffusion, points: usize, time: f64, until: f64) -> Vec<[f64; 2]> {
        let mut sum = vec![[0.0; 2]; points];
        diffusion.add_to(time, until, &mut sum);
        sum
    }

    /// Fluid that has not reached the ends, from wells with fluxes that change. Errors fall with the square of the cells.
    #[test]
    fn wells_in_a_uniform_line_have_the_pressure_of_the_closed_form_with_second_order() {
        let wells: [(f64, &[(f64, f64)]); 2] =
            [(2000.0, &[(0.0, 1e-6), (6e5, 0.0)]), (2400.0, &[(2e5, -5e-7), (5e5, 2e-6)])];
        let error = |cells: i32| {
            let line = line(cells);
            let all = felt(&diffusion(&line, &wells), line.positions.len(), 1e6, f64::INFINITY);
            let exact =
                |x: f64| wells.iter().map(|(at, flux)| injection(flux).pressure(x - at, 1e6).0).sum::<f64>();
            line.positions.iter().zip(all).map(|(x, p)| (p[0] - exact(*x)).abs()).fold(0.0, f64::max)
        };
        let errors = [100, 200, 400].map(error);
        let orders = [0, 1].map(|k| (errors[k] / errors[k + 1]).log2());
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.1), "{errors:?} {orders:?}");
    }

    #[test]
    fn nothing_is_felt_before_a_well_begins_nor_of_a_change_at_the_end_of_a_leg() {
        let line = line(40);
        let begun = diffusion(&line, &[(2000.0, &[(10.0, 1e-6)])]);
        assert!(felt(&begun, 40, 9.0, f64::INFINITY).iter().all(|p| *p == [0.0; 2]));
        assert!(felt(&begun, 40, 10.0, 10.0).iter().all(|p| *p == [0.0; 2]));
        // Half of the fluid enters each of the two cells beside the well.
        let rate = felt(&begun, 40, 10.0, f64::INFINITY)[19][1];
        assert!((rate / (0.5e-6 / (1e-9 * 100.0)) - 1.0).abs() < 1e-14, "{rate}");
        assert_eq!(begun.breaks(), [10.0]);
        let at_the_end = diffusion(&line, &[(2000.0, &[(1e7, 1e-6)])]);
        assert_eq!(felt(&at_the_end, 40, 1e7, f64::INFINITY)[19], [0.0, rate]);
    }

    #[test]
    fn a_fault_without_a_well_has_no_pressure() {
        let mut both = diffusion(&line(40), &[(2000.0, &[(0.0, 1e-6)])]);
        both.add(50, &line(40), &[], 1e7);
        assert!(both.reaches(39) && !both.reaches(40) && !both.reaches(60));
        let all = felt(&both, 90, 1e6, f64::INFINITY);
        assert!(all[19][0] > 0.0 && all[40..].iter().all(|p| *p == [0.0; 2]));
    }
}
