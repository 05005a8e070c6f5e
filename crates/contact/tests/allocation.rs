//! Residual, tangent and commit of small sliding, and of mortar in finite sliding, allocate no memory.
//!
//! The counting allocator needs `unsafe`. It only increments a counter before it forwards the call to the system's allocator.
#![allow(clippy::unwrap_used, unsafe_code)]

mod common;
use asperity_contact::{Interface, MeasureKind, Segment, SegmentKind, Sliding};
use asperity_fem::term::{Linearized, Term};
use common::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

struct CountingAllocator;

static COUNT: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

fn count<const D: usize>(interface: &mut Interface<D>, u: &[f64]) -> usize {
    let mut r = vec![0.0; u.len()];
    let mut values = vec![0.0; interface.pattern().values()];
    let before = COUNT.load(Ordering::Relaxed);
    for _ in 0..3 {
        interface.prepare(u).unwrap();
        interface.residual(u, AT, &mut r).unwrap();
        interface.tangent(&mut values);
        interface.accept();
    }
    COUNT.load(Ordering::Relaxed) - before
}

/// A single test, since the counter covers the whole process.
#[test]
fn nothing_is_allocated_after_construction() {
    // Threads of the pool allocate as they start. This must not be counted.
    rayon::broadcast(|_| ());
    small_sliding_allocates_nothing();
    mortar_allocates_nothing_while_its_pairing_stays();
}

fn small_sliding_allocates_nothing() {
    let spec = line_spec(0.4, Sliding::Small, viscous());
    let u = moved(&spec, 0.4, &[[0.1, -0.1], [0.2, -0.1], [-0.3, -0.1], [0.0, 0.1]], 1e-3, 1);
    let mut line = Interface::new(spec).unwrap();
    let spec = plate_spec(0.4, SegmentKind::Quad4, Sliding::Small, coulomb());
    let v = moved(&spec, 0.4, &[[0.1, 0.0, -0.1]; 5], 1e-3, 1);
    let mut plate = Interface::new(spec).unwrap();
    assert_eq!(count(&mut line, &u), 0);
    assert_eq!(count(&mut plate, &v), 0);
}

fn mortar_allocates_nothing_while_its_pairing_stays() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        let mut spec = line_spec(0.4, sliding, coulomb());
        let faces = (4..7).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k + 1, k] }).collect();
        spec.measure = MeasureKind::Mortar { faces, axisymmetric: false, mirrors: Vec::new() };
        let u = moved(&spec, 0.4, &[[0.01, -0.1], [0.02, -0.1], [-0.03, -0.1], [0.0, 0.1]], 1e-3, 1);
        let mut line = Interface::new(spec).unwrap();
        line.prepare(&u).unwrap();
        assert_eq!(count(&mut line, &u), 0, "{sliding:?}");
        let mut spec = plate_spec(0.4, SegmentKind::Quad4, sliding, coulomb());
        let faces = vec![Segment { kind: SegmentKind::Quad4, nodes: vec![9, 11, 12, 10] }];
        spec.slave.truncate(4);
        spec.measure = MeasureKind::Mortar { faces, axisymmetric: false, mirrors: Vec::new() };
        let u = moved(&spec, 0.4, &[[0.01, 0.0, -0.1]; 4], 1e-3, 1);
        let mut plate = Interface::new(spec).unwrap();
        plate.prepare(&u).unwrap();
        assert_eq!(count(&mut plate, &u), 0, "{sliding:?}");
    }
}
