//! Engines in C and C++, behind the one interface of `native/peer.h`, which these declarations mirror.

#![allow(unsafe_code, reason = "foreign functions; each call below upholds what `native/peer.h` says")]

use super::Peer;
use crate::scene::{self, DISCS, DT, FluidBlock, Platelet, PlateletField, Pusher, SATELLITES};
use microsim_core::glam::Vec2;
use std::ffi::c_void;

/// Kinds of discs.
const NUCLEUS: u32 = 0;
const INTERLAYER: u32 = 1;
const SATELLITE: u32 = 2;
const PUSHER: u32 = 3;

/// Kinds of links.
const ROD: u32 = 0;
const SPRING: u32 = 1;
const PIN: u32 = 2;
const ANCHOR: u32 = 3;

#[repr(C)]
#[derive(Clone, Copy)]
pub(super) struct Vector {
    x: f32,
    y: f32,
}

#[repr(C)]
struct Motion {
    position: Vector,
    velocity: Vector,
}

#[repr(C)]
struct Disc {
    position: Vector,
    mass: f32,
    radius: f32,
    part: u32,
    owner: u32,
}

#[repr(C)]
#[derive(Clone, Copy)]
struct Link {
    kind: u32,
    a: u32,
    b: u32,
    length: f32,
    stiffness: f32,
    max_length: f32,
}

#[repr(C)]
struct Field {
    discs: *const Disc,
    disc_count: usize,
    links: *const Link,
    link_count: usize,
    pusher_count: usize,
    size: Vector,
    dt: f32,
    friction: f32,
    damping: f32,
    damping_ratio: f32,
}

#[repr(C)]
struct Block {
    points: *const Vector,
    point_count: usize,
    size: Vector,
    dt: f32,
    spacing: f32,
    gravity: f32,
}

#[repr(C)]
pub(super) struct CrowdDescription {
    pub(super) centres: *const Vector,
    pub(super) cell_count: usize,
    pub(super) ring: *const Vector,
    pub(super) ring_count: usize,
    pub(super) cytoplasm: *const Vector,
    pub(super) cytoplasm_count: usize,
    pub(super) size: Vector,
    pub(super) dt: f32,
    pub(super) disc_radius: f32,
    pub(super) spacing: f32,
    pub(super) friction: f32,
    pub(super) damping: f32,
    pub(super) max_speed: f32,
}

#[repr(C)]
pub(super) struct Functions {
    create_field: Option<unsafe extern "C" fn(*const Field) -> *mut c_void>,
    create_block: Option<unsafe extern "C" fn(*const Block) -> *mut c_void>,
    step: unsafe extern "C" fn(*mut c_void, *const Vector),
    motion: unsafe extern "C" fn(*mut c_void, usize) -> Motion,
    destroy: unsafe extern "C" fn(*mut c_void),
    pub(super) create_crowd: Option<unsafe extern "C" fn(*const CrowdDescription) -> *mut c_void>,
    drive: Option<unsafe extern "C" fn(*mut c_void, usize, Vector)>,
}

unsafe extern "C" {
    static BOX2D: Functions;
    pub(super) static LIQUIDFUN: Functions;
    #[cfg(has_chipmunk)]
    static CHIPMUNK: Functions;
}

/// A world of such an engine.
pub(super) struct Native {
    pub(super) functions: &'static Functions,
    pub(super) world: *mut c_void,
    pub(super) count: usize,
    pub(super) pushers: usize,
}

/// Box2D 3.
pub(super) fn box2d(field: &PlateletField) -> Box<dyn Peer> {
    // SAFETY: a constant table of the linked library.
    Native::field(unsafe { &BOX2D }, field)
}

/// LiquidFun, that is, Box2D 2.3.
pub(super) fn liquidfun(field: &PlateletField) -> Box<dyn Peer> {
    // SAFETY: a constant table of the linked library.
    Native::field(unsafe { &LIQUIDFUN }, field)
}

/// Chipmunk 7.
#[cfg(has_chipmunk)]
pub(super) fn chipmunk(field: &PlateletField) -> Box<dyn Peer> {
    // SAFETY: a constant table of the linked library.
    Native::field(unsafe { &CHIPMUNK }, field)
}

/// LiquidFun's particles.
pub(super) fn liquidfun_fluid(block: &FluidBlock) -> Box<dyn Peer> {
    // SAFETY: a constant table of the linked library.
    Native::block(unsafe { &LIQUIDFUN }, block)
}

impl Native {
    fn field(functions: &'static Functions, field: &PlateletField) -> Box<dyn Peer> {
        let (discs, links) = (discs(field), links(field.centres.len() as u32));
        let description = Field {
            discs: discs.as_ptr(),
            disc_count: discs.len(),
            links: links.as_ptr(),
            link_count: links.len(),
            pusher_count: field.sweeps.len(),
            size: vector(field.size),
            dt: DT,
            friction: scene::FRICTION,
            damping: scene::DAMPING,
            damping_ratio: scene::SPOKE_DAMPING_RATIO,
        };
        let create = functions.create_field.expect("the engine has platelets");
        // SAFETY: pointers and counts are those of living arrays; the engine keeps none of them.
        let world = unsafe { create(&raw const description) };
        Box::new(Self { functions, world, count: discs.len(), pushers: field.sweeps.len() })
    }

    fn block(functions: &'static Functions, block: &FluidBlock) -> Box<dyn Peer> {
        let points: Vec<Vector> = block.points.iter().map(|&point| vector(point)).collect();
        let description = Block {
            points: points.as_ptr(),
            point_count: points.len(),
            size: vector(block.tank),
            dt: DT,
            spacing: FluidBlock::SPACING,
            gravity: FluidBlock::GRAVITY,
        };
        let create = functions.create_block.expect("the engine has fluid");
        // SAFETY: as above.
        let world = unsafe { create(&raw const description) };
        Box::new(Self { functions, world, count: points.len(), pushers: 0 })
    }

    fn motion(&self, index: usize) -> Motion {
        debug_assert!(index < self.count);
        // SAFETY: the world lives, and the index is one of its bodies'.
        unsafe { (self.functions.motion)(self.world, index) }
    }

    pub(super) fn position(&self, index: usize) -> Vec2 {
        glam(self.motion(index).position)
    }

    /// Sets the velocity of a ring's disc.
    pub(super) fn drive(&mut self, index: usize, velocity: Vec2) {
        debug_assert!(index < self.count);
        let drive = self.functions.drive.expect("the engine has crowds");
        // SAFETY: the world lives, and the index is one of its discs'.
        unsafe { drive(self.world, index, vector(velocity)) };
    }
}

impl Peer for Native {
    fn step(&mut self, goals: &[Vec2]) {
        let pushers = self.count - self.pushers..self.count;
        let force = |(pusher, &goal): (usize, &Vec2)| {
            let motion = self.motion(pusher);
            vector(Pusher::force(glam(motion.position), glam(motion.velocity), goal))
        };
        let forces: Vec<Vector> = pushers.zip(goals).map(force).collect();
        assert_eq!(forces.len(), self.pushers, "one goal for each pusher");
        // SAFETY: the world lives, and there is one force for each pusher.
        unsafe { (self.functions.step)(self.world, forces.as_ptr()) };
    }

    fn positions(&self) -> Vec<Vec2> {
        (0..self.count).map(|index| self.position(index)).collect()
    }
}

impl Drop for Native {
    fn drop(&mut self) {
        // SAFETY: the world lives, and nothing uses it after this.
        unsafe { (self.functions.destroy)(self.world) };
    }
}

pub(super) fn vector(v: Vec2) -> Vector {
    Vector { x: v.x, y: v.y }
}

fn glam(v: Vector) -> Vec2 {
    Vec2::new(v.x, v.y)
}

/// The discs of all platelets, then the pushers.
fn discs(field: &PlateletField) -> Vec<Disc> {
    let disc = |at: Vec2, mass, radius, part, owner| Disc { position: vector(at), mass, radius, part, owner };
    let mut discs = Vec::new();
    for (&centre, owner) in field.centres.iter().zip(0..) {
        discs.push(disc(centre, scene::CORE_MASS, 0.4 * scene::OUTER_RADIUS, NUCLEUS, owner));
        discs.push(disc(centre, scene::CORE_MASS, Platelet::interlayer_radius(), INTERLAYER, owner));
        let satellite = |offset| disc(centre + offset, 1.0, Platelet::satellite_radius(), SATELLITE, owner);
        discs.extend(Platelet::ring().map(satellite));
    }
    discs.extend(field.sweeps.iter().map(|sweep| disc(sweep.start(), Pusher::MASS, Pusher::RADIUS, PUSHER, u32::MAX)));
    discs
}

/// What holds the platelets together.
fn links(platelets: u32) -> Vec<Link> {
    let rod =
        Link { kind: ROD, a: 0, b: 0, length: 2.0 * Platelet::satellite_radius(), stiffness: 0.0, max_length: 0.0 };
    let mut links = Vec::new();
    for platelet in 0..platelets {
        let nucleus = platelet * DISCS as u32;
        let satellite = |k: usize| nucleus + 2 + (k % SATELLITES) as u32;
        links.push(Link { kind: PIN, a: nucleus, b: nucleus + 1, ..rod });
        let (stiffness, max_length) = (1.0 / scene::ANCHOR_COMPLIANCE, scene::ROPE_LENGTH * scene::OUTER_RADIUS);
        links.push(Link { kind: ANCHOR, a: nucleus, b: nucleus, length: 0.0, stiffness, max_length });
        for k in 0..SATELLITES {
            links.push(Link { a: satellite(k), b: satellite(k + 1), ..rod });
            let (length, stiffness) = (Platelet::ring_radius(), 1.0 / scene::SPOKE_COMPLIANCE);
            links.push(Link { kind: SPRING, a: satellite(k), b: nucleus, length, stiffness, max_length: 0.0 });
        }
    }
    links
}
