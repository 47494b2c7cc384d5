//! The code blocks on the pages of the book, for tests.

use std::path::{Path, PathBuf};

/// A fenced block of code.
#[derive(Debug)]
pub struct Block {
    /// The words after the fence: the language, followed by marks.
    pub words: Vec<String>,
    /// The index of the line after the fence, from 0.
    pub line: usize,
    /// The text; every line ends with a newline.
    pub text: String,
}

impl Block {
    /// The language of the block.
    pub fn language(&self) -> &str {
        self.words.first().map_or("", String::as_str)
    }

    /// Whether the block has the given mark.
    pub fn is(&self, mark: &str) -> bool {
        self.words.iter().skip(1).any(|word| word == mark)
    }

    /// The value of a mark of the form `name=value`.
    pub fn value(&self, name: &str) -> Option<&str> {
        let value = |word: &'_ String| word.strip_prefix(name)?.strip_prefix('=').map(str::len);
        let (word, length) =
            self.words.iter().skip(1).find_map(|word| Some((word, value(word)?)))?;
        word.get(word.len() - length..)
    }
}

/// The blocks of a page, in order.
pub fn blocks(page: &str) -> Vec<Block> {
    let (mut blocks, mut open): (Vec<Block>, Option<Block>) = (vec![], None);
    for (line, text) in page.lines().enumerate() {
        match (text.strip_prefix("```"), &mut open) {
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (Some(info), None) => {
                let words = info.split([' ', ',']).map(str::to_owned).collect();
                open = Some(Block { words, line: line + 1, text: String::new() });
            }
            (None, Some(block)) => block.text += &format!("{text}\n"),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block has no end");
    blocks
}

/// The Markdown files in a folder and its subfolders, in order.
pub fn pages_in(folder: &Path) -> Vec<PathBuf> {
    let mut pages = vec![];
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages
}
