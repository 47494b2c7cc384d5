//! Compares the functions with the numeric solver, over all kinds of columns.

use std::path::Path;
use std::sync::Arc;

use datafusion::arrow::array::{
    Array, ArrayRef, AsArray, FixedSizeListArray, Float32Array, Float64Array, ListArray,
    RecordBatch, StructArray,
};
use datafusion::arrow::buffer::{NullBuffer, OffsetBuffer};
use datafusion::arrow::compute::cast;
use datafusion::arrow::datatypes::{DataType, Field, Float64Type};
use robot_build::FunctionKind;
use robot_model::variable::JointVariable;
use robot_numeric::random::Random;
use robot_query::Robots;
use robot_query::motion::Layout;
use robot_testing::solver::{expected, state};
use tokio::runtime::Runtime;

use super::support::{difference, files, generation, log, robot, rows, session};

const ROWS: usize = 300;

/// The result of a query over one batch.
fn answered(columns: Vec<(String, ArrayRef)>, query: &str) -> ArrayRef {
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    Runtime::new().unwrap().block_on(async {
        let session = session(1);
        session.context.register_batch("log", batch).unwrap();
        let found = session.context.sql(query).await.unwrap().collect().await.unwrap();
        assert_eq!(found.len(), 1);
        found[0].column(0).clone()
    })
}

/// The numbers of a result, nested in any way.
fn numbers(answer: &ArrayRef) -> Vec<f64> {
    match answer.data_type() {
        DataType::Float64 => answer.as_primitive::<Float64Type>().values().to_vec(),
        DataType::FixedSizeList(..) => numbers(answer.as_fixed_size_list().values()),
        DataType::Struct(_) => {
            let parts: Vec<Vec<f64>> = answer.as_struct().columns().iter().map(numbers).collect();
            let row = |row: usize| {
                let size = |part: &Vec<f64>| part.len() / answer.len();
                let own = |part: &Vec<f64>| part[row * size(part)..(row + 1) * size(part)].to_vec();
                parts.iter().flat_map(own).collect::<Vec<f64>>()
            };
            (0..answer.len()).flat_map(row).collect()
        }
        other => panic!("{other}"),
    }
}

fn list(values: Vec<f64>, size: usize) -> ArrayRef {
    let field = Arc::new(Field::new_list_field(DataType::Float64, true));
    let values = Arc::new(Float64Array::from(values));
    Arc::new(FixedSizeListArray::try_new(field, size as i32, values, None).unwrap())
}

#[test]
fn every_function_is_that_of_the_solver() {
    for name in ["ur5", "trttr1"] {
        let model = Robots::new().model(&robot(name)).unwrap();
        let solver = robot_numeric::Mechanism::from_robot(&model.robot, &|name| {
            model.robot.nominal_value(name)
        })
        .unwrap();
        let mut random = Random::new(11);
        let states: Vec<_> = (0..ROWS).map(|_| state(&mut random, &solver, &model.robot)).collect();
        // These functions are tested elsewhere or not with columns of joint variables only. Wrenches of tips are
        // further inputs, and Jacobians are functions of frames. The solver has no base parameters; identification
        // tests their regressor, because it recovers the true parameters from torques of inverse dynamics. The
        // solver also has no columns for friction.
        let others = [
            FunctionKind::Regressor,
            FunctionKind::RegressorBase,
            FunctionKind::BaseParameters,
            FunctionKind::LinkWrenches,
            FunctionKind::Jacobian,
            FunctionKind::JacobianDotQd,
        ];
        let kinds = FunctionKind::of_robot(&model.robot).into_iter();
        let kinds = kinds.filter(|kind| !kind.effects().wrench && !others.contains(kind));
        for kind in kinds {
            let column = |variable: &JointVariable| {
                let values = states.iter().flat_map(|state| match variable {
                    JointVariable::Position => state.q.clone(),
                    JointVariable::Velocity => state.qd.clone(),
                    JointVariable::Acceleration => state.qdd.clone(),
                    JointVariable::Torque => state.tau.clone(),
                });
                (variable.name().to_owned(), list(values.collect(), model.joints()))
            };
            let mut columns: Vec<_> = kind.inputs().iter().map(column).collect();
            let arguments = kind.inputs().iter().map(|variable| format!(", {}", variable.name()));
            let arguments: String = arguments.collect();
            columns.push(("row".to_owned(), Arc::new(Float64Array::from(vec![0.0; ROWS]))));
            let query = format!("SELECT {}('{}'{arguments}) FROM log", kind.name(), robot(name));
            let found = numbers(&answered(columns, &query));
            let wanted: Vec<f64> = states
                .iter()
                .flat_map(|state| expected(&model.robot, &solver, kind, state))
                .collect();
            let error = difference(&found, &wanted);
            assert!(error < 1e-9, "{name}: {}: {error}", kind.name());
        }
    }
}

/// The name of a form, the columns of a log in it, and the argument of a function.
type Form = (&'static str, Vec<(String, ArrayRef)>, String);

/// The positions of the UR5 in every form that a log can have.
fn forms(values: &[f64]) -> Vec<Form> {
    let rows = values.len() / 6;
    let field = || Arc::new(Field::new_list_field(DataType::Float64, true));
    let numbers: ArrayRef = Arc::new(Float64Array::from(values.to_vec()));
    let offsets = OffsetBuffer::from_lengths(vec![6; rows]);
    let lists: ArrayRef = Arc::new(ListArray::try_new(field(), offsets, numbers, None).unwrap());
    let joint = |joint: usize| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(values.iter().skip(joint).step_by(6).copied()))
    };
    let columns: Vec<(String, ArrayRef)> =
        (0..6).map(|place| (format!("q{place}"), joint(place))).collect();
    let names: Vec<&str> = columns.iter().map(|(name, _)| name.as_str()).collect();
    let names = names.join(", ");
    let fields = columns.iter().map(|(name, column)| {
        (Arc::new(Field::new(name, DataType::Float64, false)), column.clone())
    });
    let structs: ArrayRef = Arc::new(StructArray::from(fields.collect::<Vec<_>>()));
    let large = cast(&lists, &DataType::LargeList(field())).unwrap();
    let one = |column: ArrayRef| vec![("q".to_owned(), column)];
    vec![
        ("fixed", one(list(values.to_vec(), 6)), "q".to_owned()),
        ("list", one(lists), "q".to_owned()),
        ("large list", one(large), "q".to_owned()),
        ("struct", one(structs), "q".to_owned()),
        ("columns", columns.clone(), names.clone()),
        ("made", columns, format!("make_array({names})")),
    ]
}

#[test]
fn columns_of_every_form_give_the_same() {
    let mut random = Random::new(7);
    let values: Vec<f64> = (0..6 * ROWS).map(|_| random.uniform(-3.0, 3.0)).collect();
    let mut wanted: Option<Vec<f64>> = None;
    for (form, columns, argument) in forms(&values) {
        let query = format!("SELECT gravity('{}', {argument}) FROM log", robot("ur5"));
        let found = numbers(&answered(columns, &query));
        assert_eq!(found, *wanted.get_or_insert(found.clone()), "{form}");
    }
    let single: Vec<f32> = values.iter().map(|value| *value as f32).collect();
    let field = Arc::new(Field::new_list_field(DataType::Float32, true));
    let single = FixedSizeListArray::try_new(field, 6, Arc::new(Float32Array::from(single)), None);
    let query = format!("SELECT gravity('{}', q) FROM log", robot("ur5"));
    let columns = vec![("q".to_owned(), Arc::new(single.unwrap()) as ArrayRef)];
    assert!(difference(&numbers(&answered(columns, &query)), &wanted.unwrap()) < 1e-6);
}

#[test]
fn null_gives_null_and_nothing_else_does() {
    let mut entries = vec![Some(0.5); 6 * 5];
    entries[6 + 2] = None;
    entries[4 * 6 + 1] = Some(f64::NAN);
    let field = Arc::new(Field::new_list_field(DataType::Float64, true));
    let valid = NullBuffer::from(vec![true, true, true, false, true]);
    let values = Arc::new(Float64Array::from(entries));
    let lists = FixedSizeListArray::try_new(field, 6, values, Some(valid)).unwrap();
    let columns = vec![("q".to_owned(), Arc::new(lists) as ArrayRef)];
    let query = format!("SELECT gravity('{}', q) FROM log", robot("ur5"));
    let found = answered(columns, &query);
    let nulls: Vec<bool> = (0..5).map(|row| found.is_null(row)).collect();
    assert_eq!(nulls, [false, true, false, true, false]);
    assert!(found.as_fixed_size_list().value(4).as_primitive::<Float64Type>().value(1).is_nan());
}

#[test]
fn the_robot_may_be_a_text() {
    let text = std::fs::read_to_string(robot("ur5")).unwrap();
    let columns = || vec![("q".to_owned(), list(vec![0.3; 12], 6))];
    let of_text = answered(columns(), &format!("SELECT gravity('{text}', q) FROM log"));
    let of_path = answered(columns(), &format!("SELECT gravity('{}', q) FROM log", robot("ur5")));
    assert!(difference(&numbers(&of_text), &numbers(&of_path)) < 1e-13);
}

#[test]
fn residuals_are_torques_less_those_of_the_model() {
    let columns = |more: Vec<f64>| {
        let one = |name: &str, value: f64| (name.to_owned(), list(vec![value; 6 * 9], 6));
        vec![one("q", 0.3), one("qd", -0.2), one("qdd", 0.1), ("tau".to_owned(), list(more, 6))]
    };
    let query = format!("SELECT inverse_dynamics('{}', q, qd, qdd) FROM log", robot("ur5"));
    let torques = numbers(&answered(columns(vec![0.0; 6 * 9]), &query));
    let more: Vec<f64> = torques.iter().enumerate().map(|(i, tau)| tau + i as f64).collect();
    let query = format!("SELECT residual('{}', q, qd, qdd, tau) FROM log", robot("ur5"));
    let found = numbers(&answered(columns(more), &query));
    let wanted: Vec<f64> = (0..6 * 9).map(|i| i as f64).collect();
    assert!(difference(&found, &wanted) < 1e-13);
}

#[test]
fn numbers_in_single_precision_are_taken_as_they_are() {
    let path = robot("planar_2r");
    let mut how = generation(&path, 2000);
    how.single = true;
    let lists = log(&path, &how);
    how.layout = Layout::Columns;
    let columns = log(&path, &how);
    let torques = |folder: &Path, arguments: &str| {
        let query = format!("SELECT inverse_dynamics('{path}', {arguments}) FROM log");
        numbers(rows(1, &files(folder), &query).unwrap().column(0))
    };
    let names = ["q_1", "q_2", "qd_1", "qd_2", "qdd_1", "qdd_2"];
    let wanted = names.map(|name| format!("CAST({name} AS DOUBLE)")).join(", ");
    let wanted = torques(columns.path(), &wanted);
    assert_eq!(torques(columns.path(), &names.join(", ")), wanted);
    assert_eq!(torques(lists.path(), "q, qd, qdd"), wanted);
    how.single = false;
    let doubles = log(&path, &how);
    assert_ne!(torques(doubles.path(), &names.join(", ")), wanted);
}
