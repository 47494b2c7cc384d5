//! Checks that batches on several threads give the same bytes as batches on one thread.

robot_macros::include_robot!(
    "robots/ur5.toml",
    functions = ["inverse_dynamics", "mass_matrix"],
    trigonometry = "polynomial",
    batch = 8,
    parallel = true
);

use ur5::Model;

/// States whose entries differ for every state and joint.
fn states(count: usize, seed: f64) -> Vec<[f64; 6]> {
    let entry = |state: usize, joint: usize| (seed + state as f64 * 0.37 + joint as f64).sin();
    (0..count).map(|state| std::array::from_fn(|joint| 3.0 * entry(state, joint))).collect()
}

fn bits<const N: usize>(values: &[[f64; N]]) -> Vec<u64> {
    values.as_flattened().iter().map(|value| value.to_bits()).collect()
}

#[test]
fn threads_give_the_same_bytes() {
    let model = Model::NOMINAL;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    for count in [0, 1, 7, 256, 257, 511, 513, 5001] {
        let [q, qd, qdd] = [0.1, 0.2, 0.3].map(|seed| states(count, seed));
        let (mut one, mut several) = (vec![[0.0; 6]; count], vec![[1.0; 6]; count]);
        assert_eq!(model.inverse_dynamics_batch(&q, &qd, &qdd, &mut one), count);
        let computed =
            pool.install(|| model.inverse_dynamics_batch_parallel(&q, &qd, &qdd, &mut several));
        assert_eq!(computed, count);
        assert_eq!(bits(&one), bits(&several));
        // The shortest slice determines the count; entries beyond it are not changed.
        let (mut one, mut several) =
            (vec![[[7.0; 6]; 6]; count + 3], vec![[[7.0; 6]; 6]; count + 3]);
        assert_eq!(model.mass_matrix_batch(&q, &mut one), count);
        let computed = pool.install(|| model.mass_matrix_batch_parallel(&q, &mut several));
        assert_eq!(computed, count);
        assert_eq!(bits(one.as_flattened()), bits(several.as_flattened()));
        assert_eq!(several.split_off(count), [[[7.0; 6]; 6]; 3]);
    }
}
