use subcert::bound::{constant::*,nets::Against,prover::Prover};
use subcert::scheme::LoopWeights;
fn main(){
    let a:Vec<String>=std::env::args().collect();
    let w=if a[1]=="o"{LoopWeights::Original}else{LoopWeights::Warren};
    for n in a[2].parse::<u32>().unwrap()..=a[3].parse().unwrap(){
        let mut p=Prover::new(w,n);
        for k in 0..4 { for c in [Constant::Rate(k),Constant::MeshRate(k),Constant::Distance(Against::Control,k),Constant::Distance(Against::Limit,k)] {
            if k==0 && matches!(c,Constant::Rate(_)|Constant::MeshRate(_)){continue}
            let t=std::time::Instant::now();
            let r=p.prove(c,1e-6);
            match r { None=>println!("{n} {c:?} FAILED {:?}",t.elapsed()),
              Some(r)=>{ let (st,ce)=match &r.conclusion{Conclusion::Cover{steps,cells,..}=>(*steps,cells.len()),_=>(0,0)};
                println!("{n} {c:?} lo {} hi {} gap {:.1e} exact {} lemma {:?} steps {st} cells {ce} at {:?} {:.1} ms",r.lo,r.hi,(r.hi-r.lo)/r.hi,p.closed_form(&r).map_or("-".into(),|x|x.to_string()),r.lemma.as_ref().map(|l|(l.depth,l.steps,l.order,l.cells.len())),r.at,t.elapsed().as_secs_f64()*1e3)}}
        }}
    }
}
