//! Sines and cosines of the angles of one state, several in a wide value.

use super::{Home, Id, Instruction, Step, WIDE, Writer};

impl Writer<'_> {
    /// Sines and cosines of angles, in their order; a function has so many entries of inputs.
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

    /// A wide value that has some values side by side, and the place of the first.
    fn packed(&mut self, values: &[Id], inputs: u32) -> (Id, usize) {
        if let Some(first) = self.neighbors(values).filter(|_| inputs >= WIDE as u32) {
            // A window of the inputs that has them: it may begin before the first, never end behind the last input.
            let start = first.min(inputs - WIDE as u32);
            self.wide = true;
            let packed = self.home(Home::Input(start));
            self.wide = false;
            return (packed, (first - start) as usize);
        }
        self.wide = true;
        let mut pairs = values.chunks(2).map(|pair| match *pair {
            [a, b] => self.value(Instruction::Pair(a, b)),
            // A number next to itself: what is computed of it is not used.
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

    /// The first entry of the inputs, if values are entries one after the other.
    fn neighbors(&self, values: &[Id]) -> Option<u32> {
        let entry = |value: Id| match self.list.steps[value.index()] {
            Step::Value(Instruction::Home(Home::Input(entry))) => Some(entry),
            _ => None,
        };
        let first = entry(*values.first()?)?;
        let mut expected = first..;
        values.iter().all(|value| entry(*value) == expected.next()).then_some(first)
    }

    /// The numbers of a wide value; those that nothing uses cost nothing.
    fn lanes(&mut self, value: Id) -> [Id; WIDE] {
        self.wide = true;
        let upper = self.value(Instruction::Upper(value));
        self.wide = false;
        let second = self.value(Instruction::Second(value));
        let fourth = self.value(Instruction::Second(upper));
        // The first number is where an instruction on one number takes it from.
        [value, second, upper, fourth]
    }
}
