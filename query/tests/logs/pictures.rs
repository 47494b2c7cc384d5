//! Tests plots of residuals.

use robot_query::Robots;
use robot_query::log::Log;
use robot_query::residual::figure;
use tokio::runtime::Runtime;

use super::support::{files, generation, log, robot, session};

#[test]
fn a_joint_with_a_wrong_model_is_seen() {
    let path = robot("planar_2r");
    let mut how = generation(&path, 4000);
    how.noise = vec![0.5, 0.01];
    let folder = log(&path, &how);
    let model = Robots::new().model(&path).unwrap();
    let drawn = Runtime::new().unwrap().block_on(async {
        let session = session(1);
        let table = session.table(&Log::open(&files(folder.path())).unwrap()).await.unwrap();
        session.context.register_table("log", table.into_view()).unwrap();
        // The torque of the second joint is too large by 0.3 N m from the middle of each episode on.
        let tau = "CASE WHEN t < 5 THEN tau ELSE make_array(tau[1], tau[2] + 0.3) END";
        let query = format!("SELECT residual('{path}', q, qd, qdd, {tau}) AS r, t FROM log");
        figure(session.context.sql(&query).await.unwrap(), &model).await.unwrap()
    });
    assert_eq!((drawn.panels.len(), drawn.t.len()), (2, 300));
    let curve = |joint: usize, name: &str| {
        let curves = &drawn.panels[joint].curves;
        curves.iter().find(|curve| curve.name == name).unwrap().values.clone()
    };
    let rms = curve(0, "rms");
    let mean = rms.iter().sum::<f64>() / 300.0;
    assert!((mean - 0.5).abs() < 0.05, "{mean}");
    let (means, largest) = (curve(1, "mean"), curve(1, "largest"));
    for part in 0..300 {
        let wanted = if part < 150 { 0.0 } else { 0.3 };
        // An interval has 13 or 14 rows.
        assert!((means[part] - wanted).abs() < 0.02, "{part}: {}", means[part]);
        assert!(largest[part] >= means[part]);
    }
    let svg = drawn.svg().unwrap();
    assert!(svg.contains("Residuals of planar_2r") && svg.matches("<polyline").count() >= 8);
    assert_eq!(drawn.svg().unwrap(), svg);
}
