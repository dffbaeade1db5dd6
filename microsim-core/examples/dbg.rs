use microsim_core::geometry::polygon::*;
use microsim_core::glam::Vec2;
use microsim_core::*;
fn main() {
    let damping: f32 = std::env::args().nth(1).unwrap().parse().unwrap();
    let substeps = std::env::args().nth(2).unwrap().parse().unwrap();
    let dt: f32 = std::env::args().nth(3).unwrap().parse().unwrap();
    let rad: f32 = std::env::args().nth(4).unwrap().parse().unwrap();
    let rady: f32 = std::env::args().nth(5).unwrap().parse().unwrap();
    let sp: f32 = std::env::args().nth(6).unwrap().parse().unwrap();
    let mut world = World::new(WorldConfig { damping, substeps, dt, ..Default::default() }).unwrap();
    let c = world
        .spawn(
            &AmoeboidCellSpec { radii: Vec2::new(rad, rady), cytoplasm_spacing: sp, ..Default::default() }.into(),
            Placement::at(80.0, 45.0),
        )
        .unwrap();
    let n = (20.0 / dt) as u32;
    for s in 0..n {
        if s < 4 || s % (n / 5) == 0 {
            let v = world.view();
            let o = v.organism(c).unwrap();
            let q: Vec<Vec2> = o.particles().filter(|q| q.role == Role::Cytoplasm).map(|q| q.position).collect();
            let ring: Vec<Vec2> = o.outline().collect();
            let closest = (0..q.len())
                .map(|i| (0..i).map(|j| (q[i] - q[j]).length()).fold(9.0f32, f32::min))
                .fold(9.0f32, f32::min)
                / 1.287;
            println!(
                "{:.2} area {:+.2}% perim {:+.2}% n {} comp {:.3}% closest {closest:.3} farthest {:.3}",
                s as f32 * dt,
                100. * (signed_area(&ring) / (std::f32::consts::PI * (rad - 0.78) * (rady - 0.78)) - 1.),
                100. * (perimeter(&ring) / (std::f32::consts::TAU * ((rad - 0.78) * (rady - 0.78)).sqrt()) - 1.),
                q.len(),
                100. * world.quality().fluid_compression_mean,
                q.iter().map(|p| (*p - Vec2::new(80., 45.)).length()).fold(0., f32::max)
            );
        }
        world.step(&Inputs::new());
    }
}
