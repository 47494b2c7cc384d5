//! Pages that reload themselves while the robot file is being edited, from disk and without a server.

use robot_build::MARKER;

/// The stamp of a page, which is written to a file that the page's script reads to find out whether there is a newer
/// page.
///
/// It consists of two numbers, the width and height of a picture, because the script of a page opened from a file can
/// only read the size of a picture beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Stamp {
    width: u16,
    height: u16,
}

impl Stamp {
    /// The stamp of a page with this text.
    pub(crate) fn of(text: &str) -> Stamp {
        let side = |[high, low]: [u8; 2]| 1 + u16::from_be_bytes([high, low]) % 4096;
        let [a, b, c, d, ..] = hmac_sha256::Hash::hash(text.as_bytes());
        Stamp { width: side([a, b]), height: side([c, d]) }
    }

    /// The stamp in the page, for example `640 480`.
    pub(crate) fn words(self) -> String {
        format!("{} {}", self.width, self.height)
    }

    /// The picture beside the page.
    pub(crate) fn picture(self) -> String {
        let Stamp { width, height } = self;
        format!(
            "<!-- {MARKER} -->\n\
             <svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\"/>\n"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_page_has_another_stamp() {
        let [one, other] = ["a page", "another page"].map(Stamp::of);
        assert_ne!(one, other);
        assert_eq!(one, Stamp::of("a page"));
        let picture = one.picture();
        let picture = roxmltree::Document::parse(&picture).unwrap();
        let side = |name| picture.root_element().attribute(name).unwrap().to_owned();
        assert_eq!(format!("{} {}", side("width"), side("height")), one.words());
    }
}
