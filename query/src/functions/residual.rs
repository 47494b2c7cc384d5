//! The residuals of measured torques.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use datafusion::arrow::array::FixedSizeListArray;
use datafusion::arrow::array::Float64Array;
use datafusion::arrow::datatypes::{DataType, Field, FieldRef};
use datafusion::common::internal_err;
use datafusion::error::Result;
use datafusion::logical_expr::{
    ColumnarValue, ReturnFieldArgs, ScalarFunctionArgs, ScalarUDFImpl, Signature, Volatility,
};
use robot_build::{Effects, FunctionKind};

use super::dynamics::{Call, compute, function};
use super::literal::robot_of;
use crate::columns::{BLOCK, doubles};
use crate::robots::{Model, Robots};

/// `residual(robot, q, qd, qdd, tau)`: τ minus the torques of the model, with the friction of the robot file, as a
/// list with an entry for each joint.
#[derive(Debug)]
pub(super) struct Residual {
    robots: Arc<Robots>,
    signature: Signature,
}

/// The inverse dynamics with all effects of the robot file except wrenches.
#[must_use]
pub fn torques_of(model: &Model) -> FunctionKind {
    let friction = model.robot.has_friction();
    FunctionKind::InverseDynamics(if friction { Effects::FRICTION } else { Effects::NONE })
}

impl Residual {
    pub(super) fn new(robots: Arc<Robots>) -> Residual {
        Residual { robots, signature: Signature::variadic_any(Volatility::Immutable) }
    }
}

impl PartialEq for Residual {
    fn eq(&self, other: &Residual) -> bool {
        Arc::ptr_eq(&self.robots, &other.robots)
    }
}

impl Eq for Residual {}

impl Hash for Residual {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name().hash(state);
    }
}

impl ScalarUDFImpl for Residual {
    fn name(&self) -> &str {
        "residual"
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        internal_err!("the type of residual depends on the robot")
    }

    fn return_field_from_args(&self, arguments: ReturnFieldArgs) -> Result<FieldRef> {
        let first = arguments.scalar_arguments.first().copied().flatten();
        let model = robot_of(self.name(), first, &self.robots)?;
        let size = i32::try_from(model.joints()).unwrap_or(i32::MAX);
        Ok(Arc::new(Field::new(self.name(), DataType::FixedSizeList(doubles(), size), true)))
    }

    fn invoke_with_args(&self, arguments: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let call = Call::new(self.name(), arguments, &self.robots)?;
        let model = &call.model;
        let joints = model.joints();
        let columns = call.columns(4 * joints)?;
        let kind = torques_of(model);
        let compiled = model.compiled(kind)?;
        let handle = function(&compiled.executable, kind)?;
        let mut values = vec![0.0; columns.rows() * joints];
        let mut given = vec![0.0; columns.entries() * BLOCK];
        let mut found = vec![0.0; joints * BLOCK];
        for start in (0..columns.rows()).step_by(BLOCK) {
            let rows = columns.read(start, &mut given);
            compute(handle, &given, &mut found, rows)?;
            let measured = given[3 * joints * BLOCK..].chunks_exact(BLOCK);
            for (joint, (measured, model)) in measured.zip(found.chunks_exact(BLOCK)).enumerate() {
                let places = values[start * joints + joint..].iter_mut().step_by(joints);
                let differences = measured.iter().zip(model).map(|(tau, model)| tau - model);
                places.zip(differences).take(rows).for_each(|(place, value)| *place = value);
            }
        }
        let values = Arc::new(Float64Array::new(values.into(), None));
        let size = i32::try_from(joints).unwrap_or(i32::MAX);
        let valid = columns.valid().cloned();
        let lists = FixedSizeListArray::try_new(doubles(), size, values, valid)?;
        Ok(ColumnarValue::Array(Arc::new(lists)))
    }
}
