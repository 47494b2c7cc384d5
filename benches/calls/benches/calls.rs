//! Times every function of every robot: `RUSTFLAGS="-C target-cpu=native" cargo bench -- panda/polynomial`.
//!
//! "throughput" measures calls at independent states. In "latency" each call waits for a result of the one before,
//! as in a control loop. A round covers 64 states, a batch has 512.

use std::hint::black_box;
use std::time::Duration;

use calls::{BATCH, Calls, Name, Random, STATES};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

struct Benchmarks<'c>(&'c mut Criterion);

impl Calls for Benchmarks<'_> {
    fn call<I: Copy, R>(
        &mut self,
        (robot, sine, function): Name,
        inputs: impl Fn(&mut Random) -> I,
        call: impl Fn(&I) -> R,
        waits: impl Fn(&mut I) -> &mut [f64],
        first: impl Fn(&R) -> f64,
    ) {
        let mut random = Random::default();
        let states: Vec<I> = (0..STATES).map(|_| inputs(&mut random)).collect();
        let mut group = self.0.benchmark_group(format!("{robot}/{sine}/{function}"));
        group.throughput(Throughput::Elements(STATES as u64));
        group.bench_function("throughput", |bencher| {
            bencher.iter(|| {
                for state in &states {
                    black_box(call(black_box(state)));
                }
            });
        });
        group.bench_function("latency", |bencher| {
            bencher.iter(|| {
                let mut previous = 0.0;
                for state in &states {
                    let mut state = *state;
                    waits(&mut state).iter_mut().for_each(|number| *number += previous * 0.0);
                    previous = first(&black_box(call(&state)));
                }
                previous
            });
        });
        group.finish();
    }

    fn batch<const N: usize>(
        &mut self,
        (robot, sine, function): Name,
        call: impl Fn(&[[f64; N]], &[[f64; N]], &[[f64; N]], &mut [[f64; N]]),
    ) {
        let mut random = Random::default();
        let [q, qd, qdd, mut tau] =
            [(); 4].map(|()| (0..BATCH).map(|_| random.array()).collect::<Vec<_>>());
        let mut group = self.0.benchmark_group(format!("{robot}/{sine}/{function}"));
        group.throughput(Throughput::Elements(BATCH as u64));
        group.bench_function("throughput", |bencher| {
            bencher.iter(|| call(black_box(&q), black_box(&qd), black_box(&qdd), &mut tau));
        });
        group.finish();
    }
}

fn benchmark(criterion: &mut Criterion) {
    calls::all(&mut Benchmarks(criterion));
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
        .without_plots();
    targets = benchmark
}
criterion_main!(benches);
