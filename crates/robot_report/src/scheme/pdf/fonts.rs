//! The standard fonts and the widths of their characters.

/// A font.
pub(super) struct Font {
    /// The name within the file.
    pub(super) key: &'static [u8],
    /// The name in the PDF standard.
    pub(super) name: &'static [u8],
    /// Whether it has Latin letters.
    pub(super) is_latin: bool,
    /// The widths of the characters from the space to the tilde, in thousandths of the font size.
    widths: &'static [u16; 95],
}

pub(super) const SANS: usize = 0;
pub(super) const BOLD: usize = 1;
pub(super) const UPRIGHT: usize = 2;
pub(super) const ITALIC: usize = 3;
pub(super) const GREEK: usize = 4;

/// The standard fonts that are used.
pub(super) const FONTS: [Font; 5] = [
    Font { key: b"S", name: b"Helvetica", is_latin: true, widths: &HELVETICA },
    Font { key: b"B", name: b"Helvetica-Bold", is_latin: true, widths: &HELVETICA_BOLD },
    Font { key: b"R", name: b"Times-Roman", is_latin: true, widths: &TIMES_ROMAN },
    Font { key: b"I", name: b"Times-Italic", is_latin: true, widths: &TIMES_ITALIC },
    Font { key: b"G", name: b"Symbol", is_latin: false, widths: &SYMBOL },
];

/// The multiplication sign, the root and the dot in the font Symbol. The font's minus sign has the code of `-`.
pub(super) const TIMES: u8 = 0xb4;
pub(super) const ROOT: u8 = 0xd6;
pub(super) const DOT: u8 = 0xd7;

impl Font {
    /// The width of a character, in units of the font size.
    pub(super) fn width(&self, code: u8) -> f64 {
        let place = usize::from(code).checked_sub(32);
        let width = match (self.is_latin, code) {
            (false, TIMES | ROOT) => 549,
            (false, DOT) => 250,
            // Most accented letters are about as wide as `n`.
            _ => place.and_then(|place| self.widths.get(place)).copied().unwrap_or(self.widths[78]),
        };
        f64::from(width) / 1000.0
    }
}

// The widths are from Adobe's font metrics (AFM) of the 14 standard fonts: version 001.008 of Symbol and 002.000 of the
// others. The Latin fonts use WinAnsiEncoding, whose codes 39 and 96 are the straight quote and the grave accent; Symbol
// has its own encoding.

#[rustfmt::skip]
const HELVETICA: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556,
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556,
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556,
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

#[rustfmt::skip]
const HELVETICA_BOLD: [u16; 95] = [
    278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278,
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 333, 333, 584, 584, 584, 611,
    975, 722, 722, 722, 722, 667, 611, 778, 722, 278, 556, 722, 611, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 333, 278, 333, 584, 556,
    333, 556, 611, 556, 611, 556, 333, 611, 611, 278, 278, 556, 278, 889, 611, 611,
    611, 611, 389, 556, 333, 611, 556, 778, 556, 556, 500, 389, 280, 389, 584,
];

#[rustfmt::skip]
const TIMES_ROMAN: [u16; 95] = [
    250, 333, 408, 500, 500, 833, 778, 180, 333, 333, 500, 564, 250, 333, 250, 278,
    500, 500, 500, 500, 500, 500, 500, 500, 500, 500, 278, 278, 564, 564, 564, 444,
    921, 722, 667, 667, 722, 611, 556, 722, 722, 333, 389, 722, 611, 889, 722, 722,
    556, 722, 667, 556, 611, 722, 722, 944, 722, 722, 611, 333, 278, 333, 469, 500,
    333, 444, 500, 444, 500, 444, 333, 500, 500, 278, 278, 500, 278, 778, 500, 500,
    500, 500, 333, 389, 278, 500, 500, 722, 500, 500, 444, 480, 200, 480, 541,
];

#[rustfmt::skip]
const TIMES_ITALIC: [u16; 95] = [
    250, 333, 420, 500, 500, 833, 778, 214, 333, 333, 500, 675, 250, 333, 250, 278,
    500, 500, 500, 500, 500, 500, 500, 500, 500, 500, 333, 333, 675, 675, 675, 500,
    920, 611, 611, 667, 722, 611, 611, 722, 722, 333, 444, 667, 556, 833, 667, 722,
    611, 722, 611, 500, 556, 722, 611, 833, 611, 556, 556, 389, 278, 389, 422, 500,
    333, 500, 500, 444, 500, 444, 278, 500, 500, 278, 278, 444, 278, 722, 500, 500,
    500, 500, 389, 389, 278, 500, 444, 667, 444, 444, 389, 400, 275, 400, 541,
];

#[rustfmt::skip]
const SYMBOL: [u16; 95] = [
    250, 333, 713, 500, 549, 833, 778, 439, 333, 333, 500, 549, 250, 549, 250, 278,
    500, 500, 500, 500, 500, 500, 500, 500, 500, 500, 278, 278, 549, 549, 549, 444,
    549, 722, 667, 722, 612, 611, 763, 603, 722, 333, 631, 722, 686, 889, 722, 722,
    768, 741, 556, 592, 611, 690, 439, 768, 645, 795, 611, 333, 863, 333, 658, 500,
    500, 631, 549, 549, 494, 439, 521, 411, 603, 329, 603, 549, 549, 576, 521, 549,
    549, 521, 549, 603, 439, 576, 713, 686, 493, 686, 494, 480, 200, 480, 549,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_font_has_its_own_widths() {
        let width = |font: usize, text: &[u8]| {
            let widths = text.iter().map(|code| FONTS[font].width(*code) * 1000.0);
            widths.sum::<f64>().round()
        };
        // α θ Ω minus · × √
        let greek = [&b"a"[..], b"q", b"W", b"-", &[DOT], &[TIMES], &[ROOT]];
        assert_eq!(
            greek.map(|text| width(GREEK, text)),
            [631.0, 521.0, 768.0, 549.0, 250.0, 549.0, 549.0]
        );
        assert_eq!([SANS, BOLD].map(|font| width(font, b"base 7")), [3002.0, 3113.0]);
        assert_eq!([UPRIGHT, ITALIC].map(|font| width(font, b"Al")), [1000.0, 889.0]);
        assert_eq!([UPRIGHT, ITALIC, SANS].map(|font| width(font, &[0xe9])), [500.0, 500.0, 556.0]);
    }
}
