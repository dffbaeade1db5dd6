//! x
mod engines; mod scene;
fn main() {
 let f = scene::PlateletField::new(200);
 for e in engines::ENGINES { if let Some(b)=e.platelets { let mut w=b(&f); 
  let t=std::time::Instant::now(); for s in 0..60 { w.step(&f.goals(s)); } eprintln!("{} {:.2} ms {:?}", e.name, t.elapsed().as_secs_f64()*1000./60., w.positions()[3]); } }
 let f = scene::FluidBlock::new(10000);
 for e in engines::ENGINES { if let Some(b)=e.fluid { let mut w=b(&f); 
  let t=std::time::Instant::now(); for _ in 0..60 { w.step(&[]); } eprintln!("{} {:.2} ms {:?}", e.name, t.elapsed().as_secs_f64()*1000./60., w.positions()[3]); } }
}
