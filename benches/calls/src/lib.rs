//! Calls of every function of every robot, for the benchmark (`cargo bench`) and for the comparison with other
//! programs (`benches/peers/run`).

use robot_numeric::random;

mod standard {
    include!(concat!(env!("OUT_DIR"), "/standard/robots.rs"));
}

mod polynomial {
    include!(concat!(env!("OUT_DIR"), "/polynomial/robots.rs"));
}

/// Inverse dynamics with the default options.
mod default {
    include!(concat!(env!("OUT_DIR"), "/default/robots.rs"));
}

/// Inverse dynamics of the UR5 over many states.
pub mod double {
    include!(concat!(env!("OUT_DIR"), "/double/ur5.rs"));
}

/// The same in single precision.
pub mod single {
    include!(concat!(env!("OUT_DIR"), "/single/ur5.rs"));
}

/// Single functions of larger robots.
mod large {
    include!(concat!(env!("OUT_DIR"), "/large/quadruped.rs"));
    include!(concat!(env!("OUT_DIR"), "/large/humanoid.rs"));
    include!(concat!(env!("OUT_DIR"), "/large/chain.rs"));
}

include!(concat!(env!("OUT_DIR"), "/list.rs"));

/// The name of a robot, the source of sines and cosines, and the name of a function.
pub type Name = (&'static str, &'static str, &'static str);

/// A use of the calls, such as a measurement.
pub trait Calls {
    /// Receives a function: how to make random inputs, the call, the input that is made to depend on the previous
    /// result, and the first number of a result.
    fn call<I: Copy, R>(
        &mut self,
        name: Name,
        inputs: impl Fn(&mut Random) -> I,
        call: impl Fn(&I) -> R,
        waits: impl Fn(&mut I) -> &mut [f64],
        first: impl Fn(&R) -> f64,
    );

    /// Receives a function of many states at once; its arguments are positions, velocities, accelerations, and the
    /// array for the results.
    fn batch<const N: usize>(
        &mut self,
        name: Name,
        call: impl Fn(&[[f64; N]], &[[f64; N]], &[[f64; N]], &mut [[f64; N]]),
    );
}

/// Random inputs, the same in every run.
pub struct Random(random::Random);

impl Default for Random {
    fn default() -> Random {
        Random(random::Random::new(1))
    }
}

impl Random {
    /// Random numbers between −3 and 3, for positions, velocities, accelerations, torques and wrenches.
    pub fn array<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.0.uniform(-3.0, 3.0))
    }
}

/// The first number of a result.
pub trait First {
    /// The first number.
    fn first(&self) -> f64;
}

impl First for f64 {
    fn first(&self) -> f64 {
        *self
    }
}

impl<T: First, const N: usize> First for [T; N] {
    fn first(&self) -> f64 {
        self[0].first()
    }
}

/// The number of states at which every function is called.
pub const STATES: usize = 64;

/// The number of states of a batch.
pub const BATCH: usize = 512;
