use withy::beams::*; use withy::geometry::*; use withy::integrators::*; use withy::loads::*; use withy::model::*; use withy::newton::Tolerance;
fn run(label:&str, mesh: Mesh, ea: f64, method: Method, dt: f64, t_end: f64) {
    let mut scene = Scene::new("s");
    let section = Section{axial_stiffness:ea,shear_stiffness:ea,bending_stiffness:100.0,mass:1.0,rotary_inertia:10.0};
    let rod = scene.add_beam(BeamDefinition{name:"rod".into(),axis:Curve::line(Vec2::new(0.,8.),Vec2::new(6.,0.)).unwrap(),mesh,section,motion:StartMotion::default()}).unwrap();
    let end = scene.station(rod,10.0).unwrap();
    scene.add_load(LoadKind::Force{station:end,force:Vec2::new(8.,0.),frame:Frame::Dead},Schedule::hold_for(2.5).unwrap());
    scene.add_load(LoadKind::Moment{station:end,moment:-80.},Schedule::hold_for(2.5).unwrap());
    let mut model = Model::assemble(&scene).unwrap();
    let mut integrator = method.build(&model, Tolerance::default());
    let n=(t_end/dt).round() as usize;
    let (mut its,mut max)=(0,0);
    let mut e0=0.0; let (mut emin,mut emax)=(f64::MAX,f64::MIN); let mut ewmax:f64=0.0; let mut lmax:f64=0.0;let mut pmax:f64=0.0;
    let mut line=String::new();
    let start=std::time::Instant::now();
    for i in 0..n {
        let r = match integrator.step(&mut model, Interval{start:i as f64*dt,end:(i+1) as f64*dt}) {Ok(r)=>r,Err(e)=>{println!("{label}: {e}");return}};
        its+=r.iterations; max=max.max(r.iterations);
        let m=model.measure();
        let t=m.time;
        if (t-2.5).abs()<1e-9 { e0=m.energy.total(); line+=&format!(" E(2.5)={:.8} L={:.6}",e0,m.angular_momentum); }
        if t>2.5-1e-9 {emin=emin.min(m.energy.total());emax=emax.max(m.energy.total());}
        ewmax=ewmax.max((m.energy.total()-m.work).abs()); pmax=pmax.max((m.momentum-m.impulse).norm()); lmax=lmax.max((m.angular_momentum-m.angular_impulse).abs());
    }
    let p=model.ends();
    println!("{label}: its {:.2} max {max} {line} range [{emin:.4},{emax:.4}] E-W {:.1e} p {:.1e} L {:.1e} ends {:.8?} {:.1?}",its as f64/n as f64, ewmax/e0,pmax/20.,lmax/229.,p,start.elapsed());
}
fn main(){
    let b=|n,c| Mesh::bspline(n,3,c).unwrap();
    let em=Method::EnergyMomentum;
    run("C1 7", b(7,1),1e4,em,0.1,7.5);
    run("trap C1 7", b(7,1),1e4,Method::Trapezoidal,0.1,7.5);
    for ea in [1e2,1e4,1e6,1e8,1e10] { run(&format!("C2 14 EA={ea:e}"), b(14,2),ea,em,0.1,7.5); }
    for dt in [0.05,0.1,0.25] { run(&format!("C2 14 dt={dt:e}"), b(14,2),1e4,em,dt,1000.0); }
    run("C2 14 EA=1e8 dt .25", b(14,2),1e8,em,0.25,7.5);
}
