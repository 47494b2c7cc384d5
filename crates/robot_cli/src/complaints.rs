//! Messages, of which there can be one for each line of a long input.

/// The most messages that are shown; further ones are only counted.
const MAX_SHOWN: usize = 20;

/// The first messages, and how many there are.
#[derive(Debug, Default)]
pub(crate) struct Complaints {
    first: Vec<String>,
    count: usize,
}

impl Complaints {
    pub(crate) fn push(&mut self, message: String) {
        self.count += 1;
        if self.first.len() < MAX_SHOWN {
            self.first.push(message);
        }
    }

    /// Appends other messages.
    pub(crate) fn and(mut self, others: Complaints) -> Complaints {
        let count = self.count + others.count;
        self.extend(others.first);
        Complaints { count, ..self }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// A line for each shown message, then one with the number of the others.
    pub(crate) fn lines(&self) -> Vec<String> {
        let mut lines: Vec<String> =
            self.first.iter().map(|message| format!("error: {message}")).collect();
        if let Some(more @ 1..) = self.count.checked_sub(self.first.len()) {
            lines.push(format!("({more} more not shown)"));
        }
        lines
    }
}

impl Extend<String> for Complaints {
    fn extend<T: IntoIterator<Item = String>>(&mut self, messages: T) {
        messages.into_iter().for_each(|message| self.push(message));
    }
}

impl FromIterator<String> for Complaints {
    fn from_iter<T: IntoIterator<Item = String>>(messages: T) -> Complaints {
        let mut complaints = Complaints::default();
        complaints.extend(messages);
        complaints
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_are_shown_and_the_others_counted() {
        let some = |range: std::ops::Range<usize>| -> Complaints {
            range.map(|number| number.to_string()).collect()
        };
        assert!(some(0..0).is_empty() && some(0..0).lines().is_empty());
        assert_eq!(some(0..20).lines().len(), 20);
        let parts = some(0..7).and(some(7..1000)).and(some(1000..1001));
        assert_eq!(parts.lines(), some(0..1001).lines());
        assert_eq!(parts.lines()[19..], ["error: 19", "(981 more not shown)"]);
    }
}
