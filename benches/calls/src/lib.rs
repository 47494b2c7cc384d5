//! Every function of every robot, called: for the benchmark (`cargo bench`) and for the comparison with
//! other programs (`benches/peers/run`).

use robot_numeric::random;

mod standard {
    include!(concat!(env!("OUT_DIR"), "/standard/robots.rs"));
}

mod polynomial {
    include!(concat!(env!("OUT_DIR"), "/polynomial/robots.rs"));
}

/// Inverse dynamics with the options that nobody chose.
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

/// A robot, where sines come from, and a function.
pub type Name = (&'static str, &'static str, &'static str);

/// What is done with the calls.
pub trait Calls {
    /// A function: how random inputs are made, the call, and the input that is made to wait for the
    /// first number of the result of the call before.
    fn call<I: Copy, R>(
        &mut self,
        name: Name,
        inputs: impl Fn(&mut Random) -> I,
        call: impl Fn(&I) -> R,
        waits: impl Fn(&mut I) -> &mut [f64],
        first: impl Fn(&R) -> f64,
    );

    /// A function of many states at once: positions, velocities, accelerations, and room for results.
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
    /// Numbers between −3 and 3: positions, velocities, accelerations, torques, loads.
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

/// How many states every function is called at.
pub const STATES: usize = 64;

/// States of a batch.
pub const BATCH: usize = 512;
