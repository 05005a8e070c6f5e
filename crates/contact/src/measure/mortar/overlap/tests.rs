//! Integrals and derivatives of overlaps against numbers that carry derivatives.

use super::*;
use crate::measure::mortar::cell::{ReferenceFacet, Sums, integrate};
use crate::measure::mortar::centre::Centres;
use crate::measure::mortar::facet::facets;
use crate::measure::mortar::rule::Rules;
use crate::measure::mortar::scalar::Dual;
use crate::spec::Segment;
use proptest::prelude::*;

type Number = Dual<54>;

/// A unit face at height `above` over the plane, perturbed by `noise`, facing down for the slave.
fn face(kind: SegmentKind, above: f64, size: f64, noise: &[f64]) -> (Segment, Vec<[f64; 3]>) {
    let at = |k: usize| -> [f64; 2] {
        let [a, b] = crate::measure::mortar::facet::node_at(kind, k);
        if matches!(kind, SegmentKind::Tri3 | SegmentKind::Tri6) {
            [a, b]
        } else {
            [0.5 + 0.5 * a, 0.5 + 0.5 * b]
        }
    };
    // The coordinates of a face of second order must not fold.
    let share = if kind.first_order() { 1.0 } else { 0.15 };
    let x: Vec<[f64; 3]> = noise
        .chunks(3)
        .enumerate()
        .take(kind.nodes())
        .map(|(k, n)| {
            let [mut a, mut b] = at(k);
            if above > 0.0 {
                std::mem::swap(&mut a, &mut b);
            }
            [size * a + share * n[0], size * b + share * n[1], above + share * n[2]]
        })
        .collect();
    (Segment { kind, nodes: (0..kind.nodes()).collect() }, x)
}

fn at(facet: &Facet, x: &[[f64; 3]]) -> Vec<[f64; 3]> {
    facet.movers().map(|n| x[n]).collect()
}

/// The integrals and derivatives of `cell`, by forward differentiation.
fn forward(facets: &Facets<'_>) -> Option<Sums<Number, 9>> {
    let (slave, master) = (facets.slave, facets.master);
    let frozen = ReferenceFacet { facet: slave.facet, reference: facets.reference, axisymmetric: false };
    let seeded = |x: &[[f64; 3]], first: usize| -> Vec<[Number; 3]> {
        let number = |k: usize, i: usize| {
            let mut d = [0.0; 54];
            d[3 * (first + k) + i] = 1.0;
            Dual { v: x[k][i], d }
        };
        (0..x.len()).map(|k| std::array::from_fn(|i| number(k, i))).collect()
    };
    let mut sums = Sums::zero();
    let (x, y) = (seeded(slave.x, 0), seeded(master.x, MOST));
    integrate(frozen, &x, master.facet, &y, facets.rule, &mut sums).then_some(sums)
}

fn kind() -> impl Strategy<Value = SegmentKind> {
    use SegmentKind::{Quad4, Quad8, Quad9, Tri3, Tri6};
    prop_oneof![3 => Just(Tri3), 3 => Just(Quad4), 1 => Just(Tri6), 1 => Just(Quad8), 1 => Just(Quad9)]
}

fn noise(by: f64) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-by..by, 27)
}

/// Compares integrals and derivatives with those of numbers that carry derivatives.
fn compare<const F: usize>(cell: &Facets<'_>) -> Result<(), TestCaseError> {
    let expected = forward(cell);
    let found = integrals::<F>(cell);
    let mut slopes = Derivatives::<F>::zero();
    prop_assert_eq!(found.is_some(), expected.is_some());
    prop_assert_eq!(derivatives::<F>(cell, &mut slopes), expected.is_some());
    let (Some(found), Some(expected)) = (found, expected) else { return Ok(()) };
    let (slave, master) = (cell.slave.facet, cell.master.facet);
    let sides = [
        (&expected.own, &found.own, slave.face.nodes.len(), true),
        (&expected.other, &found.other, master.face.nodes.len(), false),
    ];
    let movers = [cell.slave.x.len(), cell.master.x.len()];
    for (expected, values, functions, own) in sides {
        for b in 0..slave.nodes.len() {
            let row = &expected[b][..functions];
            let largest = row.iter().flat_map(|n| n.d).fold(0.0f64, |m, d| m.max(d.abs()));
            // Natural coordinates of bent facets amplify rounding.
            let bound = 1e-11 * (1.0 + largest);
            for (k, number) in row.iter().enumerate() {
                prop_assert!((values[b][k] - number.v).abs() < bound, "{} {}", b, k);
                for (side, movers) in movers.into_iter().enumerate() {
                    for j in 0..movers {
                        for (l, by) in slopes.by[side][j].iter().enumerate() {
                            let f = if own { by.own[b][k] } else { by.other[b][k] };
                            let e = number.d[3 * (side * MOST + j) + l];
                            prop_assert!(
                                (f - e).abs() < bound,
                                "{} {} by {} {} {}: {} {}",
                                b,
                                k,
                                side,
                                j,
                                l,
                                f,
                                e
                            );
                        }
                    }
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn integrals_do_not_depend_on_the_corner_that_comes_first(
        noises in (noise(0.2), noise(0.5)),
        by in 1..4_usize,
    ) {
        let (segment, own) = face(SegmentKind::Quad4, 0.2, 1.0, &noises.0);
        let other = face(SegmentKind::Quad4, 0.0, 1.2, &noises.1).1;
        let turned = |x: &[[f64; 3]]| -> Vec<[f64; 3]> { (0..4).map(|k| x[(k + by) % 4]).collect() };
        let rules = Rules::new();
        let of = |own: &[[f64; 3]], other: &[[f64; 3]]| {
            let facet = facets(&segment, None, own).remove(0);
            let side = |x| Side { facet: &facet, x };
            let cell = Facets { slave: side(own), reference: own, master: side(other), rule: rules.rule(3) };
            integrals::<NODES>(&cell)
        };
        let (first, second) = (of(&own, &other), of(&turned(&own), &turned(&other)));
        prop_assert_eq!(first.is_some(), second.is_some());
        let (Some(first), Some(second)) = (first, second) else { return Ok(()) };
        for b in 0..4 {
            for k in 0..4 {
                for (first, second) in [(first.own, second.own), (first.other, second.other)] {
                    let (a, c) = (first[(b + by) % 4][(k + by) % 4], second[b][k]);
                    prop_assert!((a - c).abs() < 1e-12, "{} {}: {} {}", b, k, a, c);
                }
            }
        }
    }

    #[test]
    fn integrals_and_derivatives_are_those_of_numbers_that_carry_derivatives(
        kinds in (kind(), kind()),
        noises in (noise(0.2), noise(0.4), noise(0.1)),
        points in 1..5_usize,
    ) {
        let (own_face, own) = face(kinds.0, 0.2, 1.0, &noises.0);
        let (other_face, other) = face(kinds.1, 0.0, 1.2, &noises.1);
        let reference: Vec<[f64; 3]> =
            own.iter().zip(noises.2.chunks(3)).map(|(x, n)| std::array::from_fn(|i| x[i] + n[i])).collect();
        let rules = Rules::new();
        let divided = |face: &Segment, x: &[[f64; 3]]| {
            let (mut centres, mut x) = (Centres::new(x.len()), x.to_vec());
            let middle = centres.add(face, &mut x);
            (facets(face, middle, &x), x)
        };
        let (slaves, own) = (divided(&own_face, &reference).0, divided(&own_face, &own).1);
        let (masters, other) = divided(&other_face, &other);
        for slave in &slaves {
            for master in &masters {
                let (x, y) = (at(slave, &own), at(master, &other));
                let cell = Facets {
                    slave: Side { facet: slave, x: &x },
                    reference: &reference,
                    master: Side { facet: master, x: &y },
                    rule: rules.rule(points),
                };
                if [slave, master].iter().all(|facet| facet.face.kind.first_order()) {
                    compare::<NODES>(&cell)?;
                }
                compare::<MOST>(&cell)?;
            }
        }
    }
}
