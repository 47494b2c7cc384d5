//! Sines and cosines of the angles of one state, several at a time in a wide value.

use super::{Home, Id, Instruction, Step, WIDE, Writer};

impl Writer<'_> {
    /// Appends the sines and cosines of angles, in their order. `inputs` is the number of entries of the function's
    /// inputs.
    pub(super) fn side_by_side(&mut self, angles: &[Id], inputs: u32) -> Vec<(Id, Id)> {
        let mut pairs = vec![];
        for chunk in angles.chunks(WIDE) {
            if let [angle] = chunk {
                pairs.push(self.sin_cos(*angle));
                continue;
            }
            let (packed, first) = self.packed(chunk, inputs);
            self.wide = true;
            let (sines, cosines) = self.sin_cos(packed);
            self.wide = false;
            let lanes = first..first + chunk.len();
            let (sines, cosines) = (self.lanes(sines), self.lanes(cosines));
            pairs.extend(lanes.map(|lane| (sines[lane], cosines[lane])));
        }
        pairs
    }

    /// Appends a wide value that contains these values in consecutive lanes; returns it and the lane of the first.
    fn packed(&mut self, values: &[Id], inputs: u32) -> (Id, usize) {
        if let Some(first) = self.neighbors(values).filter(|_| inputs >= WIDE as u32) {
            // Load a window of the inputs that contains them. It can start before the first, but must not end after the
            // last input.
            let start = first.min(inputs - WIDE as u32);
            self.wide = true;
            let packed = self.home(Home::Input(start));
            self.wide = false;
            return (packed, (first - start) as usize);
        }
        self.wide = true;
        let mut pairs = values.chunks(2).map(|pair| match *pair {
            [a, b] => self.value(Instruction::Pair(a, b)),
            // The number is repeated; the results of the second lane are not used.
            _ => self.value(Instruction::Pair(pair[0], pair[0])),
        });
        let (lower, upper) = (pairs.next(), pairs.next());
        drop(pairs);
        let packed = match (lower, upper) {
            (Some(lower), Some(upper)) => self.value(Instruction::Join(lower, upper)),
            (lower, _) => lower.unwrap_or(values[0]),
        };
        self.wide = false;
        (packed, 0)
    }

    /// Returns the first entry of the inputs, if the values are consecutive entries.
    fn neighbors(&self, values: &[Id]) -> Option<u32> {
        let entry = |value: Id| match self.list.steps[value.index()] {
            Step::Value(Instruction::Home(Home::Input(entry))) => Some(entry),
            _ => None,
        };
        let first = entry(*values.first()?)?;
        let mut expected = first..;
        values.iter().all(|value| entry(*value) == expected.next()).then_some(first)
    }

    /// Splits a wide value into its numbers; unused ones cost nothing.
    fn lanes(&mut self, value: Id) -> [Id; WIDE] {
        self.wide = true;
        let upper = self.value(Instruction::Upper(value));
        self.wide = false;
        let second = self.value(Instruction::Second(value));
        let fourth = self.value(Instruction::Second(upper));
        // Instructions on one number read the first lane, so the wide value itself stands for its first number.
        [value, second, upper, fourth]
    }
}
