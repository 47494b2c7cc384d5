//! Wrong data and wrong arguments cause errors, all reported at once, and never panics.

use nalgebra::{Matrix3, Vector3};
use robot_numeric::random::{Random, Recipe};
use robot_numeric::{
    Frame, Friction, Joint, Link, Loads, Mechanism, Mismatch, NumericError, Pose, Sign, Wrench,
};

use crate::measure::cases;

fn sound() -> Link {
    let joint = Joint::revolute(Vector3::z(), 0);
    Link::new(None, Pose::identity(), joint, 1.0, Vector3::zeros(), Matrix3::identity())
}

fn reasons(links: Vec<Link>, frames: Vec<Frame>) -> Vec<String> {
    match Mechanism::new(Vector3::zeros(), links, frames) {
        Err(NumericError::Mechanism(faults)) => faults.iter().map(ToString::to_string).collect(),
        other => panic!("{other:?}"),
    }
}

fn reason(spoil: impl Fn(&mut Link)) -> String {
    let mut link = sound();
    spoil(&mut link);
    let reasons = reasons(vec![link], vec![]);
    assert_eq!(reasons.len(), 1, "{reasons:?}");
    reasons[0].clone()
}

#[test]
fn every_fault_of_a_link_is_named() {
    assert!(Mechanism::new(Vector3::zeros(), vec![sound()], vec![]).is_ok());
    assert_eq!(reason(|l| l.parent = Some(0)), "link 0: parent 0 must come before its child");
    assert_eq!(reason(|l| l.joint.axis *= 2.0), "link 0: the axis must have length 1, not 2");
    assert_eq!(
        reason(|l| l.joint.coordinate = usize::MAX),
        format!("link 0: coordinate {} must be less than the number of links, 1", usize::MAX)
    );
    let finite = ": every number must be finite";
    assert_eq!(reason(|l| l.mass = f64::NAN), format!("link 0: mass{finite}"));
    assert_eq!(reason(|l| l.joint.offset = f64::INFINITY), format!("link 0: joint{finite}"));
    assert_eq!(
        reason(|l| l.center_of_mass.x = f64::NAN),
        format!("link 0: center of mass{finite}")
    );
    assert_eq!(reason(|l| l.inertia[(0, 1)] = f64::NAN), format!("link 0: inertia{finite}"));
    assert_eq!(reason(|l| l.rotor_inertia = f64::NAN), format!("link 0: rotor inertia{finite}"));
    assert_eq!(reason(|l| l.friction.viscous = f64::NAN), format!("link 0: friction{finite}"));
    assert_eq!(
        reason(|l| l.friction = Friction { sign: Sign::Smooth(0.0), ..l.friction }),
        "link 0: the smoothing width must be positive"
    );
    assert_eq!(reason(|l| l.inertia[(0, 1)] = 0.1), "link 0: the inertia tensor must be symmetric");
    let rotation = "link 0: the rotation must be an orthonormal matrix of determinant +1";
    assert_eq!(reason(|l| l.placement.rotation *= -1.0), rotation);
    assert_eq!(reason(|l| l.placement.rotation[(0, 1)] = 1e-6), rotation);
}

#[test]
fn all_faults_are_reported_at_once() {
    let mut second = sound();
    second.parent = Some(7);
    second.mass = f64::NAN;
    second.joint.coordinate = 2;
    let third = Link { parent: Some(1), ..sound() };
    let frame = Frame { link: Some(3), placement: Pose::identity() };
    let found = reasons(vec![sound(), second, third], vec![frame]);
    let expected = [
        "link 1: parent 7 must come before its child",
        "link 1: mass: every number must be finite",
        "frame 0: link 3 does not exist: there are 3",
        "coordinates: coordinate 1 moves no joint: number them from 0",
    ];
    assert_eq!(found, expected);
}

#[test]
fn wrong_lengths_are_errors_and_all_named() {
    let mut random = Random::new(5);
    let mechanism = random.mechanism(&Recipe::serial(3));
    let loads = Loads { wrenches: vec![Wrench::zero()], friction: true };
    let error =
        mechanism.inverse_dynamics_with(&[0.0; 2], &[0.0; 3], &[0.0; 9], &loads).unwrap_err();
    let expected = [("q", 3, 2), ("qdd", 3, 9), ("wrenches", 2, 1)]
        .map(|(argument, expected, found)| Mismatch { argument, expected, found });
    assert_eq!(error, NumericError::Lengths(expected.to_vec()));
    assert_eq!(
        error.to_string(),
        "`q` must have 3 entries, not 2; `qdd` must have 3 entries, not 9; \
         `wrenches` must have 2 entries, not 1"
    );
}

#[test]
fn no_function_takes_a_wrong_length_or_index() {
    let mut random = Random::new(5);
    let mechanism = random.mechanism(&Recipe::serial(3));
    let (one, three) = ([0.0], [0.0; 3]);
    let lengths = |result: Result<(), NumericError>| {
        assert!(matches!(result, Err(NumericError::Lengths(_))), "{result:?}");
    };
    lengths(mechanism.forward_kinematics(&one).map(drop));
    lengths(mechanism.center_of_mass(&one).map(drop));
    lengths(mechanism.gravity_torques(&one).map(drop));
    lengths(mechanism.bias(&three, &one).map(drop));
    lengths(mechanism.mass_matrix(&one).map(drop));
    lengths(mechanism.inverse_mass_matrix(&one).map(drop));
    lengths(mechanism.mass_matrix_derivatives(&one).map(drop));
    lengths(mechanism.christoffel_symbols(&one).map(drop));
    lengths(mechanism.coriolis_matrix(&three, &one).map(drop));
    lengths(mechanism.forward_dynamics(&three, &three, &one, &[]).map(drop));
    lengths(mechanism.articulated_body(&three, &three, &one, &[]).map(drop));
    lengths(mechanism.energies(&three, &one).map(drop));
    lengths(mechanism.regressor(&three, &three, &one).map(drop));
    lengths(mechanism.drive_regressor(&three, &one).map(drop));
    lengths(mechanism.friction_torques(&three, &one, &three, &[]).map(drop));
    lengths(mechanism.inverse_dynamics_derivatives(&one, &three, &three, &[]).map(drop));
    lengths(mechanism.forward_dynamics_derivatives(&one, &three, &three, &[]).map(drop));
    lengths(mechanism.frame_jacobian(&one, 0).map(drop));
    lengths(mechanism.link_jacobian_dot_qd(&three, &one, 0).map(drop));
    lengths(mechanism.wrench_torques(&three, &[]).map(drop));
    let error = mechanism.frame_jacobian(&three, 2).unwrap_err();
    assert_eq!(error.to_string(), "frame 2 does not exist: the mechanism has 2, counted from 0");
    assert!(mechanism.link_jacobian_dot_qd(&three, &three, 3).is_err());
}

#[test]
fn singular_and_shared_are_errors() {
    let mut light = sound();
    (light.mass, light.inertia) = (0.0, Matrix3::zeros());
    let mechanism = Mechanism::new(Vector3::zeros(), vec![light], vec![]).unwrap();
    let error = NumericError::NotPositiveDefinite;
    assert_eq!(mechanism.forward_dynamics(&[0.0], &[0.0], &[1.0], &[]), Err(error.clone()));
    assert_eq!(mechanism.articulated_body(&[0.0], &[0.0], &[1.0], &[]), Err(error.clone()));
    assert_eq!(mechanism.inverse_mass_matrix(&[f64::NAN]), Err(error));
    let follower = Link { parent: Some(0), ..sound() };
    let mechanism = Mechanism::new(Vector3::zeros(), vec![sound(), follower], vec![]).unwrap();
    let error = mechanism.articulated_body(&[0.0], &[0.0], &[1.0], &[]).unwrap_err();
    assert_eq!(error, NumericError::SharedCoordinate { coordinate: 0 });
    assert!(mechanism.forward_dynamics(&[0.0], &[0.0], &[1.0], &[]).is_ok());
}

#[test]
fn numbers_that_are_not_finite_do_not_panic() {
    let mut random = Random::new(6);
    let recipe = Recipe { drives: true, ..Recipe::tree(4) };
    let mechanism = random.mechanism(&recipe);
    for number in [f64::NAN, f64::INFINITY, -f64::INFINITY, f64::MAX, f64::MIN_POSITIVE] {
        let x = [number; 4];
        let tau = mechanism.inverse_dynamics(&x, &x, &x).unwrap();
        assert!(tau.len() == 4 && (number.abs() < 1.0 || tau.iter().any(|t| !t.is_finite())));
        let _ = mechanism.forward_dynamics_derivatives(&x, &x, &x, &[]);
        let _ = mechanism.articulated_body(&x, &x, &x, &[]);
        assert!(mechanism.coriolis_matrix(&x, &x).is_ok());
    }
}

#[test]
fn a_mechanism_without_coordinates_has_empty_answers() {
    let fixed = Link { joint: Joint::fixed(), ..sound() };
    for links in [vec![], vec![fixed]] {
        let frame = Frame { link: None, placement: Pose::identity() };
        let mechanism = Mechanism::new(Vector3::z(), links, vec![frame]).unwrap();
        assert_eq!(mechanism.coordinates(), 0);
        assert!(mechanism.inverse_dynamics(&[], &[], &[]).unwrap().is_empty());
        assert!(mechanism.mass_matrix(&[]).unwrap().is_empty());
        assert!(mechanism.coriolis_matrix(&[], &[]).unwrap().is_empty());
        assert!(mechanism.forward_dynamics(&[], &[], &[], &[]).unwrap().is_empty());
        assert!(mechanism.articulated_body(&[], &[], &[], &[]).unwrap().is_empty());
        assert!(mechanism.regressor(&[], &[], &[]).unwrap().is_empty());
        assert_eq!(mechanism.frame_jacobian(&[], 0).unwrap().shape(), (6, 0));
        assert_eq!(mechanism.forward_kinematics(&[]).unwrap().frames, [Pose::identity()]);
    }
}

#[test]
fn random_mechanisms_are_sound_and_the_same_for_one_seed() {
    // The first numbers of the reference implementation of SplitMix64 for this seed.
    let mut random = Random::new(1_234_567);
    assert_eq!(random.bits(), 6_457_827_717_110_365_317);
    assert_eq!(random.bits(), 3_203_168_211_198_807_973);
    let (mut joints, mut shared, mut fixed, mut branched) = (0, 0, 0, 0);
    for (case, again) in cases(120).zip(cases(120)) {
        let mechanism = &case.mechanism;
        assert_eq!(mechanism, &again.mechanism);
        assert_eq!(case.state, again.state);
        let (links, frames) = (mechanism.links().to_vec(), mechanism.frames().to_vec());
        let rebuilt = Mechanism::new(*mechanism.gravity(), links, frames);
        assert_eq!(rebuilt.as_ref(), Ok(mechanism), "{}", case.name);
        let moving = mechanism.links().iter().filter(|link| link.joint.driver().is_some());
        assert_eq!(moving.clone().count(), case.recipe.joints);
        joints += moving.count();
        shared += case.recipe.joints - mechanism.coordinates();
        fixed += mechanism.links().len() - case.recipe.joints;
        let parents = mechanism.links().iter().enumerate();
        branched += parents.filter(|(index, link)| link.parent != index.checked_sub(1)).count();
        for link in mechanism.links() {
            let moments = link.inertia.symmetric_eigenvalues();
            assert!(link.mass > 0.0 && moments.min() > 0.0, "{}", case.name);
            assert!(moments.sum() > 2.0 * moments.max(), "{}: triangle inequality", case.name);
        }
    }
    assert!(joints == 780 && shared > 20 && fixed > 20 && branched > 100);
}
