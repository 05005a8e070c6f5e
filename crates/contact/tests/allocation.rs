//! Residual, tangent and commit of small sliding allocate nothing.
//!
//! A counting allocator needs `unsafe`: it only adds one to a counter before handing on to the system's.
#![allow(clippy::unwrap_used, unsafe_code)]

mod common;
use asperity_contact::{Interface, SegmentKind, Sliding};
use asperity_fem::term::{Linearized, Term};
use common::*;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

struct Counting;

static COUNT: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

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

#[test]
fn small_sliding_allocates_nothing_after_construction() {
    let spec = line_spec(0.4, Sliding::Small, viscous());
    let u = moved(&spec, 0.4, &[[0.1, -0.1], [0.2, -0.1], [-0.3, -0.1], [0.0, 0.1]], 1e-3, 1);
    let mut line = Interface::new(spec).unwrap();
    let spec = plate_spec(0.4, SegmentKind::Quad4, Sliding::Small, coulomb());
    let v = moved(&spec, 0.4, &[[0.1, 0.0, -0.1]; 5], 1e-3, 1);
    let mut plate = Interface::new(spec).unwrap();
    assert_eq!(count(&mut line, &u), 0);
    assert_eq!(count(&mut plate, &v), 0);
}
