//! Reads ROS 2 recordings in MCAP, in bounded memory.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use mcap::parse_record;
use mcap::records::{Channel, MessageHeader, Record};
use mcap::sans_io::{LinearReadEvent, LinearReader};

use super::cdr::{JointState, joint_state};
use super::episodes::Episodes;
use super::{Conversion, Converted, places};
use crate::error::Error;
use crate::robots::Model;

/// The type of the messages with joint states.
const TYPE: &str = "sensor_msgs/msg/JointState";

/// Converts a recording to a log.
///
/// # Errors
///
/// A file that cannot be read; no joint states, or joint states in several topics; messages without positions.
pub(super) fn convert(
    model: &Model,
    input: &Path,
    how: &Conversion,
    output: &Path,
) -> Result<Converted, Error> {
    let mut recording = Recording {
        model,
        input,
        how,
        output,
        schemas: HashMap::new(),
        channel: None,
        topics: vec![],
        places: None,
        log: None,
        first: None,
        messages: 0,
    };
    let mut file = File::open(input).map_err(|error| Error::file(input, error))?;
    let mut reader = LinearReader::new();
    let failed = |error: mcap::McapError| {
        let reason = match error {
            mcap::McapError::UnsupportedCompression(name) => {
                format!(
                    "its chunks are compressed by {name}, which is neither zstd nor lz4; decompress them with \
                     `mcap decompress`"
                )
            }
            error => format!("it cannot be read ({error}); `mcap recover` may repair it"),
        };
        Error::file(input, reason)
    };
    while let Some(event) = reader.next_event() {
        match event.map_err(failed)? {
            LinearReadEvent::ReadRequest(need) => {
                let read =
                    file.read(reader.insert(need)).map_err(|error| Error::file(input, error))?;
                reader.notify_read(read);
            }
            LinearReadEvent::Record { data, opcode } => {
                recording.take(parse_record(opcode, data).map_err(failed)?)?;
            }
        }
    }
    recording.finish()
}

/// The state while a recording is read.
struct Recording<'a> {
    model: &'a Model,
    input: &'a Path,
    how: &'a Conversion,
    output: &'a Path,
    /// The names of message types.
    schemas: HashMap<u16, String>,
    /// The channel that is converted.
    channel: Option<u16>,
    /// The topics of joint states.
    topics: Vec<String>,
    /// The places of the robot's joints in messages.
    places: Option<(Vec<String>, Vec<usize>)>,
    log: Option<Episodes>,
    /// The time of the first message, ns.
    first: Option<i128>,
    messages: u64,
}

impl Recording<'_> {
    fn take(&mut self, record: Record<'_>) -> Result<(), Error> {
        match record {
            Record::Schema { header, .. } => {
                self.schemas.insert(header.id, header.name);
                Ok(())
            }
            Record::Channel(channel) => self.channel(&channel),
            Record::Message { header, data } => self.message(&header, &data),
            _ => Ok(()),
        }
    }

    fn channel(&mut self, channel: &Channel) -> Result<(), Error> {
        let is_wanted = |topic: &String| *topic == channel.topic;
        if self.schemas.get(&channel.schema_id).is_none_or(|name| name != TYPE)
            || self.topics.iter().any(is_wanted)
        {
            return Ok(());
        }
        self.topics.push(channel.topic.clone());
        match &self.how.topic {
            Some(topic) if *topic != channel.topic => return Ok(()),
            None if self.channel.is_some() => {
                let topics = self.topics.join(", ");
                let reason =
                    format!("several topics have joint states, {topics}; choose one with --topic");
                return Err(Error::file(self.input, reason));
            }
            _ => {}
        }
        if channel.message_encoding != "cdr" {
            let reason =
                format!("{} is encoded as {}, not as cdr", channel.topic, channel.message_encoding);
            return Err(Error::file(self.input, reason));
        }
        self.channel = Some(channel.id);
        Ok(())
    }

    fn message(&mut self, header: &MessageHeader, data: &[u8]) -> Result<(), Error> {
        if self.channel != Some(header.channel_id) {
            return Ok(());
        }
        self.messages += 1;
        let place = format!("{}, message {}", self.input.display(), self.messages);
        let wrong = |reason: &str| Error::Columns(format!("{place}: {reason}"));
        let message = joint_state(data).ok_or_else(|| wrong("it is not a joint state in CDR"))?;
        let JointState { stamp, name, position, effort, .. } = &message;
        let is_known = self.places.as_ref().is_some_and(|(known, _)| known == name);
        if !is_known {
            let found = places(self.model, self.how, name, self.input)?;
            self.places = Some((name.clone(), found));
        }
        if position.len() != name.len() {
            return Err(wrong("it does not have a position for every joint"));
        }
        let has_torques = effort.len() == name.len();
        let log = match &mut self.log {
            Some(log) => log,
            log => log.insert(Episodes::new(
                self.output,
                self.model.joints(),
                has_torques,
                self.how.window,
            )?),
        };
        if log.has_torques() != has_torques {
            return Err(wrong("only some messages have efforts"));
        }
        let now = i128::from(stamp.0) * 1_000_000_000 + i128::from(stamp.1);
        let time = (now - *self.first.get_or_insert(now)) as f64 * 1e-9;
        let places = self.places.iter().flat_map(|(_, places)| places.iter().copied());
        let unit = if self.how.degrees { 1_f64.to_radians() } else { 1.0 };
        let positions = places.clone().map(|place| position[place] * unit);
        let torques = places.filter_map(|place| effort.get(place).copied());
        log.push(time, positions, torques, &|| place.clone())
    }

    fn finish(self) -> Result<Converted, Error> {
        let Some(mut log) = self.log else {
            let topics = match self.topics.as_slice() {
                [] => format!("no topic has messages of {TYPE}"),
                topics => format!("topics with joint states are {}", topics.join(", ")),
            };
            return Err(Error::file(
                self.input,
                format!("it has no joint states to convert: {topics}"),
            ));
        };
        log.end()?;
        log.finish()
    }
}
