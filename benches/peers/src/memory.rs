//! Peak memory of an engine with a scene: in a process of its own, from what Linux remembers of it.

use crate::Scene;
use crate::engines::{ENGINES, Peer};
use crate::measure::Row;
use crate::scene::crowd::Crowd;
use crate::scene::{FluidBlock, PlateletField};
use microsim_core::glam::Vec2;
use std::hint::black_box;
use std::process::{Command, Stdio};

/// Steps that the process takes: by then engines have what they need.
const STEPS: u64 = 60;

/// Adds it to the rows; where the system does not tell, or the process fails, nothing is added.
pub(crate) fn measure(rows: &mut [Row]) {
    for row in rows {
        row.bytes_per_body = in_child(row).map(|bytes| bytes / row.bodies as f64);
    }
}

/// Runs this program again for one engine, with the hidden arguments that [`report`] answers.
fn in_child(row: &Row) -> Option<f64> {
    let program = std::env::current_exe().ok()?;
    let mut child = Command::new(program);
    child.args(["--memory-of", &row.engine, "--scene", row.scene.name(), "--count", &row.count.to_string()]);
    let output = child.stderr(Stdio::inherit()).output().ok()?;
    output.status.success().then(|| String::from_utf8(output.stdout).ok()?.trim().parse().ok())?
}

/// Prints by how many bytes the peak of this process rose for the scene.
///
/// # Errors
/// When there is no such engine, or the system does not tell.
pub(crate) fn report(engine: &str, scene: Scene, count: usize) -> Result<(), String> {
    let engine = ENGINES.iter().find(|other| other.name == engine).ok_or("no such engine")?;
    let bytes = match scene {
        Scene::Platelets => {
            let (field, build) = (PlateletField::new(count), engine.platelets.ok_or("it has no platelets")?);
            rise(|| build(&field), |step| field.goals(step))
        }
        Scene::Fluid => {
            let (block, build) = (FluidBlock::new(count), engine.fluid.ok_or("it has no fluid")?);
            rise(|| build(&block), |_| Vec::new())
        }
        Scene::Crowd => {
            let (crowd, build) = (Crowd::new(count), engine.crowd.ok_or("it has no crowd")?);
            rise(|| build(&crowd), |step| crowd.directions(step))
        }
    };
    println!("{}", bytes?);
    Ok(())
}

/// By how much the peak rises while a world is made and takes its steps.
fn rise(build: impl FnOnce() -> Box<dyn Peer>, goals: impl Fn(u64) -> Vec<Vec2>) -> Result<u64, String> {
    let before = peak()?;
    let mut peer = build();
    (0..STEPS).for_each(|step| peer.step(&goals(step)));
    black_box(peer);
    Ok(peak()? - before)
}

/// Most memory that this process ever held, bytes.
fn peak() -> Result<u64, String> {
    let status = std::fs::read_to_string("/proc/self/status").map_err(|error| error.to_string())?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).ok_or("no VmHWM")?;
    let kibibytes: u64 = line.trim().trim_end_matches(" kB").parse().map_err(|_| "VmHWM is no number")?;
    Ok(kibibytes * 1024)
}
