//! `identify` as an aggregate of SQL.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use datafusion::arrow::array::{Array, ArrayRef, AsArray};
use datafusion::arrow::compute::cast;
use datafusion::arrow::datatypes::{DataType, Field, FieldRef, Float64Type};
use datafusion::common::ScalarValue;
use datafusion::error::Result;
use datafusion::logical_expr::function::{AccumulatorArgs, StateFieldsArgs};
use datafusion::logical_expr::{Accumulator, AggregateUDFImpl, Signature, Volatility};
use datafusion::physical_expr::PhysicalExpr;
use datafusion::physical_expr::expressions::Literal;

use super::answer::{answer_type, null_answer};
use super::measurements::{Measurements, Scratch};
use super::prior::Prior;
use crate::columns::{Columns, doubles};
use crate::error::Error;
use crate::functions::text_of;
use crate::robots::Robots;

/// `identify(robot, q, qd, qdd, tau [, noise] [, prior])`: the base parameters that explain the torques best.
/// `noise` is the standard deviation of all torques or of each torque, a number or a list; without it, that of each
/// joint is estimated. `prior` is a literal text, see [`Prior`].
#[derive(Debug)]
pub(super) struct Identify {
    robots: Arc<Robots>,
    signature: Signature,
}

impl Identify {
    pub(super) fn new(robots: Arc<Robots>) -> Identify {
        Identify { robots, signature: Signature::variadic_any(Volatility::Immutable) }
    }
}

impl PartialEq for Identify {
    fn eq(&self, other: &Identify) -> bool {
        Arc::ptr_eq(&self.robots, &other.robots)
    }
}

impl Eq for Identify {}

impl Hash for Identify {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name().hash(state);
    }
}

impl AggregateUDFImpl for Identify {
    fn name(&self) -> &str {
        "identify"
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        Ok(answer_type())
    }

    fn accumulator(&self, arguments: AccumulatorArgs) -> Result<Box<dyn Accumulator>> {
        let literal = |argument: &Arc<dyn PhysicalExpr>| {
            let literal = argument.downcast_ref::<Literal>()?;
            text_of(literal.value()).map(str::to_owned)
        };
        let [first, others @ ..] = arguments.exprs else {
            return Err(no_robot().into());
        };
        let last = arguments.expr_fields.last().filter(|_| !others.is_empty());
        let has_prior = last.is_some_and(|field| field.data_type().is_string());
        let text = others.last().filter(|_| has_prior).map(literal);
        let text = text.map(|text| text.ok_or_else(no_prior)).transpose()?;
        Ok(Box::new(Identification {
            robots: self.robots.clone(),
            literal: literal(first),
            prior: text.map(|text| text.parse()).transpose()?.unwrap_or_default(),
            has_prior,
            robot: None,
            scratch: Scratch::default(),
        }))
    }

    fn state_fields(&self, arguments: StateFieldsArgs) -> Result<Vec<FieldRef>> {
        let name = |part: &str| format!("{}[{part}]", arguments.name);
        let measurements = DataType::List(doubles());
        Ok(vec![
            Arc::new(Field::new(name("robot"), DataType::Utf8, true)),
            Arc::new(Field::new(name("prior"), DataType::Utf8, true)),
            Arc::new(Field::new(name("measurements"), measurements, true)),
        ])
    }
}

/// The measurements of one group.
struct Identification {
    robots: Arc<Robots>,
    /// The robot of all rows, if the query names it in a literal.
    literal: Option<String>,
    prior: Prior,
    /// Whether the last argument is the prior.
    has_prior: bool,
    /// The robot as named in the query, once there are rows.
    robot: Option<(String, Measurements)>,
    scratch: Scratch,
}

impl fmt::Debug for Identification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Identification").field("robot", &self.robot).finish_non_exhaustive()
    }
}

impl Identification {
    /// The measurements of the robot of that name.
    fn of(&mut self, literal: &str) -> Result<&mut Measurements, Error> {
        if self.robot.as_ref().is_some_and(|(known, _)| known != literal) {
            return Err(Error::Query(
                "identify takes one robot; use GROUP BY for several".to_owned(),
            ));
        }
        match &mut self.robot {
            Some((_, measurements)) => Ok(measurements),
            robot => {
                let mut measurements = Measurements::new(self.robots.model(literal)?)?;
                measurements.prior = self.prior.clone();
                Ok(&mut robot.insert((literal.to_owned(), measurements)).1)
            }
        }
    }
}

impl Accumulator for Identification {
    fn update_batch(&mut self, values: &[ArrayRef]) -> Result<()> {
        let (literals, arguments) = values.split_first().ok_or_else(no_robot)?;
        let arguments = &arguments[..arguments.len() - usize::from(self.has_prior)];
        let rows = literals.len();
        if rows == 0 {
            return Ok(());
        }
        let literal = match &self.literal {
            Some(literal) => literal.clone(),
            None => the_only(literals)?,
        };
        let literal = literal.as_str();
        let mut scratch = std::mem::take(&mut self.scratch);
        let measurements = self.of(literal)?;
        let joints = measurements.model.joints();
        let name = &measurements.model.robot.name;
        let wanted = format!("identify of {name}, with q, qd, qdd and tau of {joints} joints,");
        let sizes = [4 * joints, 4 * joints + 1, 5 * joints];
        let columns = Columns::new(arguments, rows, &sizes, &wanted)?;
        measurements.push(&columns, &mut scratch)?;
        self.scratch = scratch;
        Ok(())
    }

    fn evaluate(&mut self) -> Result<ScalarValue> {
        match &self.robot {
            Some((_, measurements)) => Ok(measurements.estimate()?.scalar()?),
            None => null_answer(),
        }
    }

    fn size(&self) -> usize {
        size_of::<Identification>()
            + self.robot.as_ref().map_or(0, |(name, measurements)| name.len() + measurements.size())
    }

    fn state(&mut self) -> Result<Vec<ScalarValue>> {
        let numbers = self.robot.as_ref().map(|(_, measurements)| {
            let numbers: Vec<ScalarValue> =
                measurements.numbers().into_iter().map(ScalarValue::from).collect();
            ScalarValue::new_list(&numbers, &DataType::Float64, true)
        });
        let null = ScalarValue::try_from(&DataType::List(doubles()))?;
        Ok(vec![
            ScalarValue::Utf8(self.robot.as_ref().map(|(literal, _)| literal.clone())),
            ScalarValue::Utf8(Some(self.prior.to_string())),
            numbers.map_or(null, ScalarValue::List),
        ])
    }

    fn merge_batch(&mut self, states: &[ArrayRef]) -> Result<()> {
        let [literals, priors, numbers] = states else {
            return Err(no_robot().into());
        };
        let [literals, priors] = [cast(literals, &DataType::Utf8)?, cast(priors, &DataType::Utf8)?];
        let texts = literals.as_string::<i32>().iter().zip(priors.as_string::<i32>().iter());
        for ((literal, prior), numbers) in texts.zip(numbers.as_list::<i32>().iter()) {
            if let (Some(literal), Some(prior), Some(numbers)) = (literal, prior, numbers) {
                self.prior = prior.parse()?;
                self.of(literal)?.merge(numbers.as_primitive::<Float64Type>().values())?;
            }
        }
        Ok(())
    }
}

/// The robot of all rows of a batch.
fn the_only(literals: &ArrayRef) -> Result<String> {
    let literals = cast(literals, &DataType::Utf8)?;
    let literals = literals.as_string::<i32>();
    let literal = literals.iter().next().flatten().ok_or_else(no_robot)?;
    if literals.iter().any(|other| other != Some(literal)) {
        return Err(
            Error::Query("identify takes one robot; use GROUP BY for several".to_owned()).into()
        );
    }
    Ok(literal.to_owned())
}

fn no_prior() -> Error {
    Error::Query(
        "the prior is the last argument of identify, a literal text such as 'ridge=0.01, ZZR_2=1.2:0.1'"
            .to_owned(),
    )
}

fn no_robot() -> Error {
    Error::Query(
        "the first argument of identify is the robot: its name, its path or its text".to_owned(),
    )
}
