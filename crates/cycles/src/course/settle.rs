//! Slip rates of faults that return to equilibrium: with given states, `τ = η V + f_n a m` at each point.

use crate::problem::{Components, Fault, PerPoint};
use asperity_friction::fault::Unknowns;

/// Halvings of m: they reach its rounding.
const HALVINGS: usize = 80;

/// m of all points, component by component, at which friction and radiation damping balance the shear tractions `shear`
/// \[Pa\] under the normal tractions `normal` \[Pa\]. m and V have the direction of the traction.
pub(crate) fn settled(
    fault: &Fault,
    shear: Components<&[f64]>,
    normal: &[f64],
    states: PerPoint<&[f64]>,
) -> Vec<f64> {
    let n = normal.len();
    let size: Vec<f64> = (0..n).map(|p| shear.size(p)).collect();
    let shear = shear.all();
    let stiff = |p: usize| normal[p] * fault.law.scale(p);
    let mut below = vec![0.0; n];
    let mut above: Vec<f64> = (0..n).map(|p| size[p] / stiff(p)).collect();
    let (mut m, mut rate) = (vec![0.0; shear.len()], vec![0.0; shear.len()]);
    for _ in 0..HALVINGS {
        let middle = |p: usize| 0.5 * (below[p] + above[p]);
        along(&mut m, shear, &size, middle);
        let now = Unknowns { m: Components::new(&m, n), states };
        fault.law.slip_rates(now, Components::new(&mut rate, n));
        let rate = Components::new(rate.as_slice(), n);
        for p in 0..n {
            let middle = 0.5 * (below[p] + above[p]);
            let rest = size[p] - fault.damping[p] * rate.size(p) - stiff(p) * middle;
            if rest > 0.0 { below[p] = middle } else { above[p] = middle }
        }
    }
    along(&mut m, shear, &size, |p| below[p]);
    m
}

/// Vectors of the given sizes along the tractions.
fn along(vectors: &mut [f64], shear: &[f64], size: &[f64], length: impl Fn(usize) -> f64) {
    let n = size.len();
    for (i, (vector, shear)) in vectors.iter_mut().zip(shear).enumerate() {
        let p = i % n;
        *vector = if size[p] > 0.0 { shear / size[p] * length(p) } else { 0.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operator::Dense;
    use crate::problem::Processes;
    use asperity_friction::evolution::ageing::Ageing;
    use asperity_friction::fault::Points;
    use asperity_friction::rate::RateLaw;
    use asperity_friction::strength::{Parameters, regularised::Regularised};

    fn fault(points: usize) -> Fault {
        let law = || {
            let form = Regularised(Parameters::new(0.6, 0.01, 1e-6).unwrap());
            RateLaw::new(form, Ageing::new(0.015, 0.008, 1e-6).unwrap(), 1e-9, None).unwrap()
        };
        Fault {
            operator: Box::new(Dense::new(points, vec![0.0; points * points], None)),
            law: Box::new(Points::new((0..points).map(|_| law()).collect())),
            damping: vec![4.6e6; points],
            normal: vec![50e6; points],
            processes: Processes::default(),
        }
    }

    #[test]
    fn friction_and_damping_balance_tractions_of_either_sign() {
        let fault = fault(3);
        let (shear, normal, states) = ([40e6, -26e6, 0.0], [50e6; 3], [1.0, 12.0, 5.0]);
        let states = PerPoint::new(states.as_slice(), 1);
        let m = settled(&fault, Components::new(&shear, 3), &normal, states);
        let mut rate = [0.0; 3];
        let now = Unknowns { m: Components::new(&m, 3), states };
        fault.law.slip_rates(now, Components::new(&mut rate, 3));
        for p in 0..3 {
            let held = fault.damping[p] * rate[p] + normal[p] * fault.law.scale(p) * m[p];
            assert!((held - shear[p]).abs() < 1e-6, "{p}: {held}");
        }
        assert!(rate[0] > 0.1 && rate[1] < 0.0 && rate[2] == 0.0, "{rate:?}");
    }
}
