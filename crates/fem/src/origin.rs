//! A point near a set of nodes, from which their positions are counted where differences of positions matter.
//!
//! A displaced position `X + u` keeps the digits of u down to the spacing of floating-point numbers at X. Far from the origin of
//! the coordinates (UTM northings are 4e6 m) that spacing is 1e-9 m, which stiff contact turns into pressure. Relative to a
//! point nearby it is that of the size of the set, wherever the set lies.

/// Point in whose neighbourhood the nodes lie: a multiple of a power of two that exceeds twice their largest extent. Positions
/// relative to it are exact, so that adding it again gives the same numbers. It is zero for a set that lies within twice its
/// extent of the origin.
#[must_use]
pub fn near<'a, const D: usize>(positions: impl Iterator<Item = &'a [f64; D]>) -> [f64; D] {
    let none = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    let (low, high) = positions.fold(none, |(low, high), x| {
        (std::array::from_fn(|c| x[c].min(low[c])), std::array::from_fn(|c| x[c].max(high[c])))
    });
    let extent = (0..D).map(|c| high[c] - low[c]).fold(0.0, f64::max);
    if !(extent > 0.0 && extent.is_finite()) {
        return [0.0; D];
    }
    let step = (extent.log2().ceil() + 1.0).exp2();
    std::array::from_fn(|c| (0.5 * (low[c] + high[c]) / step).trunc() * step)
}

#[cfg(test)]
mod tests {
    use super::near;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn relative_positions_are_exact_and_small(
            far in prop::array::uniform2(-1e7..1e7),
            offsets in prop::collection::vec(prop::array::uniform2(0.0..40.0), 2..20),
        ) {
            let nodes: Vec<[f64; 2]> = offsets.iter().map(|o| [far[0] + o[0], far[1] + o[1]]).collect();
            let origin = near(nodes.iter());
            let extent = |c: usize| {
                let each = || nodes.iter().map(|x| x[c]);
                each().fold(f64::NEG_INFINITY, f64::max) - each().fold(f64::INFINITY, f64::min)
            };
            let most = extent(0).max(extent(1));
            for x in &nodes {
                for c in 0..2 {
                    let relative = x[c] - origin[c];
                    prop_assert_eq!(relative + origin[c], x[c]);
                    prop_assert!(relative.abs() <= 4.5 * most, "{} over {}", relative, most);
                }
            }
        }
    }

    #[test]
    fn nodes_beside_the_origin_stay_where_they_are() {
        assert_eq!(near([[0.0, 0.1], [0.05, 0.1]].iter()), [0.0; 2]);
        assert_eq!(near([[7.0, 7.0]].iter()), [0.0; 2]);
    }
}
