//! Reads `sensor_msgs/msg/JointState` as ROS 2 serializes it: plain CDR, version 1.

/// The state of the joints at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct JointState {
    /// The seconds and nanoseconds of the header.
    pub(super) stamp: (i32, u32),
    pub(super) name: Vec<String>,
    pub(super) position: Vec<f64>,
    pub(super) velocity: Vec<f64>,
    pub(super) effort: Vec<f64>,
}

/// Reads a message; `None` if the bytes are not a message.
pub(super) fn joint_state(bytes: &[u8]) -> Option<JointState> {
    let (header, body) = bytes.split_at_checked(4)?;
    let little = match header {
        [0, 1, ..] => true,
        [0, 0, ..] => false,
        _ => return None,
    };
    let mut reader = Reader { body, place: 0, little };
    let stamp = (reader.word()? as i32, reader.word()?);
    let _frame = reader.text()?;
    let count = reader.count(4)?;
    let name = (0..count).map(|_| reader.text()).collect::<Option<Vec<String>>>()?;
    let [position, velocity, effort] = [reader.numbers()?, reader.numbers()?, reader.numbers()?];
    Some(JointState { stamp, name, position, velocity, effort })
}

/// A position in a message; values are aligned to multiples of their size.
struct Reader<'b> {
    body: &'b [u8],
    place: usize,
    little: bool,
}

impl Reader<'_> {
    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let start = self.place.next_multiple_of(N);
        let found = self.body.get(start..start.checked_add(N)?)?;
        self.place = start + N;
        found.try_into().ok()
    }

    fn word(&mut self) -> Option<u32> {
        let bytes = self.bytes()?;
        Some(if self.little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) })
    }

    /// Reads the number of elements of a sequence, which must have at least this many bytes for each.
    fn count(&mut self, size: usize) -> Option<usize> {
        let count = self.word()? as usize;
        (count <= self.body.len() / size).then_some(count)
    }

    fn text(&mut self) -> Option<String> {
        let length = self.count(1)?;
        let found = self.body.get(self.place..self.place.checked_add(length)?)?;
        self.place += length;
        let found = found.strip_suffix(&[0]).unwrap_or(found);
        Some(String::from_utf8_lossy(found).into_owned())
    }

    fn numbers(&mut self) -> Option<Vec<f64>> {
        let count = self.count(8)?;
        let number =
            |bytes| if self.little { f64::from_le_bytes(bytes) } else { f64::from_be_bytes(bytes) };
        let mut found = Vec::with_capacity(count);
        for _ in 0..count {
            let start = self.place.next_multiple_of(8);
            let bytes = self.body.get(start..start + 8)?;
            self.place = start + 8;
            found.push(number(bytes.try_into().ok()?));
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A message of one joint with position and effort, byte by byte.
    fn message() -> Vec<u8> {
        let mut bytes = vec![0, 1, 0, 0];
        bytes.extend(3_i32.to_le_bytes());
        bytes.extend(500_000_000_u32.to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
        bytes.push(0);
        bytes.extend([0; 3]);
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend(6_u32.to_le_bytes());
        bytes.extend(b"elbow\0");
        bytes.extend([0; 2]);
        bytes.extend(1_u32.to_le_bytes());
        // The body has 36 bytes so far, so doubles begin at 40.
        bytes.extend([0; 4]);
        bytes.extend(1.5_f64.to_le_bytes());
        bytes.extend(0_u32.to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend((-2.0_f64).to_le_bytes());
        bytes
    }

    #[test]
    fn a_message_is_read() {
        let found = joint_state(&message()).unwrap();
        let wanted = JointState {
            stamp: (3, 500_000_000),
            name: vec!["elbow".to_owned()],
            position: vec![1.5],
            velocity: vec![],
            effort: vec![-2.0],
        };
        assert_eq!(found, wanted);
    }

    #[test]
    fn every_cut_message_is_refused() {
        let message = message();
        for length in 0..message.len() {
            assert_eq!(joint_state(&message[..length]), None, "{length}");
        }
    }
}
