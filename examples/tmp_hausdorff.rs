#[path = "author_proofs/hausdorff.rs"]
mod hausdorff;
fn main() {
    for (name, c) in hausdorff::all().unwrap() {
        let mut t = Vec::new();
        c.write(&mut t).unwrap();
        let s = std::time::Instant::now();
        let v = subcert_check::check(&t);
        println!(
            "{name} {} bytes, {:?}: {:?} {:?}",
            t.len(),
            s.elapsed(),
            v.claim.map(|c| c
                .chars()
                .rev()
                .take(230)
                .collect::<String>()
                .chars()
                .rev()
                .collect::<String>()),
            v.outcome
        );
    }
}
