//! What can be put into the room of a simulation.

use crate::words::{self, Key};
use microsim_core::{
    AgarSpec, AmoeboidCellSpec, BacillusSpec, CoccusSpec, Controller, Error, ErrorKind, FluidBlockSpec, OrganismSpec,
    PlateletSpec, ProbeSpec, RedCellSpec, RigidCellSpec,
};

/// Makes what a tool puts into the world.
pub(super) type Make = fn() -> OrganismSpec;

/// What can be put into the room.
pub(super) const SPAWNS: [(Key, Make); 9] = [
    (Key::KindAgar, || AgarSpec::default().into()),
    (Key::SpawnCoccus, || CoccusSpec::default().into()),
    (Key::SpawnBacillus, || BacillusSpec::default().into()),
    (Key::SpawnRigidCell, || RigidCellSpec::default().into()),
    (Key::SpawnAmoeboid, || AmoeboidCellSpec::default().into()),
    (Key::SpawnPlatelet, || PlateletSpec::default().into()),
    (Key::SpawnRedCell, || RedCellSpec::default().into()),
    (Key::SpawnProbe, || ProbeSpec::default().into()),
    (Key::SpawnFluid, || FluidBlockSpec::default().into()),
];

/// Why something is not put in, for people.
pub(super) fn refusal(name: Key, error: &Error) -> String {
    let name = words::text(name);
    let told = |key| words::text_with(key, &[("what", name.into())]);
    match error.kind() {
        ErrorKind::Overlap { .. } => told(Key::SandboxOverlap),
        ErrorKind::OutsideWorld { .. } => told(Key::SandboxOutside),
        ErrorKind::TooMany { .. } => words::text(Key::SandboxCrowded).to_owned(),
        _ => told(Key::SandboxRefused),
    }
}

/// How something moves that was put in: animals wander, things lie still.
pub(super) fn controller(name: Key) -> Controller {
    match name {
        Key::SpawnRigidCell | Key::SpawnAmoeboid => Controller::wander([1.0, 5.0], 0.2),
        Key::SpawnCoccus | Key::SpawnBacillus => Controller::wander([0.05, 0.3], 0.0),
        _ => Controller::Still,
    }
}
