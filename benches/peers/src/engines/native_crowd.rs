//! The crowd for engines in C and C++.

#![allow(unsafe_code, reason = "foreign functions; each call below upholds what `native/peer.h` says")]

use super::Peer;
use super::native::{CrowdDescription, Functions, LIQUIDFUN, Native, Vector, vector};
use crate::scene::crowd::{Crowd, DISC_RADIUS, FRICTION, MAX_SPEED, SPACING, drive};
use crate::scene::{DAMPING, DT};
use microsim_core::glam::Vec2;

struct NativeCrowd {
    native: Native,
    /// Discs of a ring, and discs and particles of a cell.
    ring: usize,
    bodies: usize,
}

/// LiquidFun's filled chain, as the thesis has it.
pub(super) fn liquidfun(crowd: &Crowd) -> Box<dyn Peer> {
    // SAFETY: a constant table of the linked library.
    Box::new(NativeCrowd::new(unsafe { &LIQUIDFUN }, crowd))
}

impl NativeCrowd {
    fn new(functions: &'static Functions, crowd: &Crowd) -> Self {
        let vectors = |points: &[Vec2]| points.iter().map(|&point| vector(point)).collect::<Vec<Vector>>();
        let (centres, ring) = (vectors(&crowd.centres), vectors(&crowd.cell.ring));
        let cytoplasm = vectors(&crowd.cell.cytoplasm);
        let description = CrowdDescription {
            centres: centres.as_ptr(),
            cell_count: centres.len(),
            ring: ring.as_ptr(),
            ring_count: ring.len(),
            cytoplasm: cytoplasm.as_ptr(),
            cytoplasm_count: cytoplasm.len(),
            size: vector(crowd.size),
            dt: DT,
            disc_radius: DISC_RADIUS,
            spacing: SPACING,
            friction: FRICTION,
            damping: DAMPING,
            max_speed: MAX_SPEED,
        };
        let create = functions.create_crowd.expect("the engine has crowds");
        // SAFETY: pointers and counts are those of living arrays; the engine keeps none of them.
        let world = unsafe { create(&raw const description) };
        let bodies = crowd.cell.bodies();
        let native = Native { functions, world, count: centres.len() * bodies, pushers: 0 };
        Self { native, ring: ring.len(), bodies }
    }
}

impl Peer for NativeCrowd {
    fn step(&mut self, directions: &[Vec2]) {
        let mut ring = Vec::with_capacity(self.ring);
        for (cell, &direction) in directions.iter().enumerate() {
            let first = cell * self.bodies;
            ring.clear();
            ring.extend((first..first + self.ring).map(|disc| self.native.position(disc)));
            for (k, velocity) in drive(&ring, direction) {
                self.native.drive(first + k, velocity);
            }
        }
        self.native.step(&[]);
    }

    fn positions(&self) -> Vec<Vec2> {
        self.native.positions()
    }
}
